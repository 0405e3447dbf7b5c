//! The weight of [`Moments`] against the table of `docs/walk.md`, section 2.

use glam::Vec3;

use super::{Random, Wide, dot, minus, narrow, normalize, top, wide};
use crate::importance::{ImportanceModel, Moments};
use crate::node::{MomentNode, Node};
use crate::point::ShadingPoint;
use crate::{LightMoments, exact, vector};

/// A child as the table has it.
#[derive(Clone, Copy)]
struct Child {
    phi: f64,
    x: Wide,
    b: f64,
    ratio: f64,
    m: Wide,
    q: f64,
    /// Height of the box above its centre, along the receiver's normal.
    up: f64,
}

/// The soft cosine, doubled.
fn g(a: f64, s: f64, t: f64) -> f64 {
    2.0 * a.max(0.0) + s * t / (2.0 * a.abs() + s)
}

/// The weight, with the height of the box above its centre times `up_by`.
fn table(c: &Child, n: Wide, up_by: f64) -> f64 {
    // The table's 0.032 in full.
    let least = 0.001_f64.sqrt();
    let (d2, b2) = (dot(c.x, c.x), c.b * c.b);
    let y = 1.0 / (d2 + 1.25 * b2).sqrt();
    let near = d2 + 0.5 * b2;
    let u = c.b * y;
    let a = y * dot(n, c.x);
    let s = least + u * (1.0 + (c.ratio - 1.0) * dot(n, c.m).powi(2));
    let t = s.min((2.0 * y * (dot(n, c.x) + c.up * up_by)).max(1e-4));
    let received = g(a, s, t);
    let nearest = (d2 - 2.5 * b2).max(dot(c.m, c.x).powi(2));
    let y = 1.0 / (nearest + 1.25 * b2 * c.ratio.max(c.q).powi(2)).sqrt();
    let u = c.b * y;
    let s = least + u * c.ratio + c.q * (0.5 - u * c.ratio);
    let emitted = g(-y * dot(c.m, c.x), s, s);
    c.phi * received * emitted / near
}

/// The child that the words of a node stand for, as they are read or as they were given.
fn child(words: &LightMoments, q: f64, point: &ShadingPoint) -> Child {
    let n = wide(point.normal());
    let across = f64::from(words.across);
    let b = 2.0_f64.sqrt() * across;
    Child {
        phi: words.phi.into(),
        x: minus(wide(words.c), wide(point.position())),
        b,
        ratio: f64::from(words.along) / across,
        m: wide(words.m),
        q,
        up: top(wide(words.h), n),
    }
}

/// The spread of normals, which is stored beside them.
fn spread(m: Vec3) -> f64 {
    let rest = 1.0 - dot(wide(m), wide(m));
    // Rounding leaves a unit normal's rest at some 2^-20.
    if rest < 2.0_f64.powi(-18) {
        0.0
    } else {
        rest.sqrt()
    }
}

/// Which parts of the table decide a weight: the cut of the box, the least cut, emitters that face away, a set broader than it is far,
/// normals all alike, a volume. Each is to be seen often.
fn deciding(c: &Child, n: Wide) -> [bool; 6] {
    let d = dot(c.x, c.x).sqrt();
    let height = (dot(n, c.x) + c.up) / d;
    let in_volume = n == [0.0; 3];
    [
        !in_volume && height > 1e-3 && height < 0.03,
        !in_volume && height < 0.0,
        dot(c.m, c.x) > 0.1 * d,
        c.b > d,
        c.q == 0.0,
        in_volume,
    ]
}

/// Relative error of two weights' quotient. In each the rough root, within 6.6·10^-4, comes twice into either cosine, and the
/// reciprocal is within 2.7·10^-3.
const ROUGH: f64 = 2.0 * (4.0 * 6.6e-4 + 2.7e-3);
/// Relative error of a box's height in breadths, a rough reciprocal.
const REACH: f64 = 3e-3;

/// A set of lights of about `size`, near the point or far off.
fn set(random: &mut Random, point: &ShadingPoint, size: f32) -> LightMoments {
    let n = point.normal();
    let distance = size * random.power(-5, 6);
    let to = random.direction();
    // Half of them near the horizon.
    let to = if random.below(2) == 0 {
        to
    } else {
        let low = to - n * exact::clamp(vector::dot(to, n) + 0.2 * (random.unit() - 0.5), -1.0, 1.0);
        narrow(normalize(wide(low)))
    };
    let thin = if random.below(2) == 0 { 1.0 } else { 0.01 };
    LightMoments {
        phi: random.power(-6, 6),
        c: point.position() + to * distance,
        across: (0.02 + random.unit()) * size,
        along: random.unit() * random.unit() * size * 2.0,
        m: match random.below(4) {
            0 => random.direction(),
            1 => Vec3::ZERO,
            _ => random.vector() * 0.57,
        },
        h: random.extents(size * 3.0 * thin),
    }
}

/// Straight above the point, facing it, without any breadth to speak of.
fn known(point: &ShadingPoint, size: f32) -> LightMoments {
    let n = point.normal();
    let up = if n == Vec3::ZERO { Vec3::X } else { n };
    LightMoments {
        phi: 1.0,
        c: point.position() + up * size,
        across: 1e-5 * size,
        along: 0.0,
        m: -up,
        h: Vec3::ZERO,
    }
}

/// Weights are, within [`ROUGH`], those of the words as they are read; and within a twentieth, in the mean, those of the words as they
/// were given.
#[test]
fn weights_are_the_table_s() {
    let random = &mut Random(2);
    let (mut seen, mut off, mut high) = ([0; 6], 0.0, 0);
    for _ in 0..20_000 {
        let scale = random.power(-20, 20);
        let point = ShadingPoint {
            p: (random.vector() * scale).to_array(),
            n: if random.below(8) == 0 {
                [0.0; 3]
            } else {
                random.direction().to_array()
            },
        };
        let (n, size) = (wide(point.normal()), scale * random.power(-3, 3));
        let mut sets = [known(&point, size); 4];
        for slot in 1..4 {
            sets[slot] = set(random, &point, size);
        }
        let node: MomentNode<4> = crate::kit::node(&sets);
        let weights = Moments::weights(&node, &point).map(f64::from);
        let children = [0, 1, 2, 3].map(|i| {
            // Packed in units of 1/255.
            let q = (spread(sets[i].m) * 255.0).round() / 255.0;
            child(&node.summary(i), q, &point)
        });
        let one = table(&children[0], n, 1.0);
        for slot in 1..4 {
            let c = &children[slot];
            let found = weights[slot] / weights[0];
            let [least, most] = [1.0 - REACH, 1.0 + REACH].map(|by| table(c, n, by) / one);
            assert!(
                (least * (1.0 - ROUGH)..=most * (1.0 + ROUGH)).contains(&found),
                "{found}, expected {least} to {most}: {:?} at {point:?}",
                node.summary(slot)
            );
            let parts = deciding(c, n);
            (0..6).for_each(|k| seen[k] += u32::from(parts[k]));
            let taken = LightMoments {
                across: exact::max(sets[slot].across, 0.5 * sets[slot].along),
                ..sets[slot]
            };
            let given = child(&taken, spread(taken.m), &point);
            // A sixteenth of a breadth in the height of a low box changes much.
            if dot(n, given.x) + given.up >= 0.5 * given.b {
                off += (found / (table(&given, n, 1.0) / one)).ln().abs();
                high += 1;
            }
        }
    }
    off /= f64::from(high);
    assert!(off < 0.05, "{off} from the given value");
    assert!(seen.iter().all(|&count| count >= 500), "{seen:?}");
}

/// Down to 2^-40 of the distance a frame's unit is what it is.
#[test]
fn small_frames_far_away_keep_their_size() {
    for (below, kept) in [(0, 0), (20, 20), (39, 39), (40, 40), (41, 40), (90, 40)] {
        let far = Vec3::new(exact::pow2(50), 0.0, 0.0);
        let frame = crate::weight::frame(far, 50 - below, 50 - below, Vec3::ZERO);
        assert_eq!(frame.unit, exact::pow2(-kept), "{below}");
    }
}
