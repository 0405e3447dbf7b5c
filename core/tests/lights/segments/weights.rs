//! Importances of a segment: means along it, positive everywhere, and what they save.

use super::*;
use glam::Vec3;
use lightbvh::exact::{hash, pow2};
use lightbvh::importance::{ImportanceModel, RaySegment, Receiver, Subtended};
use lightbvh::node::kind;
use lightbvh::{
    CompactNode, Defensive, Eq4, LightMoments, LightNode, MomentNode, Moments, Node, ShadingPoint,
};

/// Sets with and without size and normals: the weights are the means along the segment.
#[test]
fn weights_are_means_along_the_segment() {
    let random = &mut Random(1);
    let (mut worst_plain, mut worst, mut total, mut count) = (1.0_f64, 1.0_f64, 0.0, 0.0);
    for trial in 0..4000 {
        let scale = pow2((hash(trial) % 41) as i32 - 20);
        let segment = random.segment(scale, scale * pow2((trial % 9) as i32 - 4));
        let sets: [LightMoments; 4] = core::array::from_fn(|slot| {
            // The first is a point alike in all directions, to compare with.
            let plain = slot < 2;
            let away = Vec3::from_array(random.vector(2.0 * scale));
            let across = if plain { 0.0 } else { scale * 0.3 * random.unit() };
            LightMoments {
                phi: 0.5 + random.unit(),
                c: away,
                across,
                along: across * random.unit(),
                m: if plain {
                    Vec3::ZERO
                } else {
                    Vec3::from_array(random.unit_vector()) * random.unit()
                },
                h: Vec3::ZERO,
            }
        });
        let mut node = MomentNode::<4>::EMPTY;
        for slot in 0..4 {
            node.set_child(slot, kind::LIGHT, slot as u32);
        }
        node.set_summaries(&sets);
        // As the words are read; the spread of normals is stored beside their mean, in units of 1/255.
        let spreads = sets.map(|set| {
            let m = wide(set.m.to_array());
            ((1.0 - dot(m, m)).max(0.0).sqrt() * 255.0).round() / 255.0
        });
        let sets = [0, 1, 2, 3].map(|slot| (node.summary(slot), spreads[slot]));
        let found = Subtended::<Moments>::weights(&node, &segment);
        let expected = sets.map(|(set, spread)| {
            let (c, m) = (wide(set.c.to_array()), wide(set.m.to_array()));
            let (across, along) = (f64::from(set.across), f64::from(set.along));
            let mean = mean_along(&segment, c, 400, |p| {
                let to = minus(p, c);
                let d2 = dot(to, to);
                // The soft cosine of `docs/walk.md`, section 2.
                let y = 1.0 / (d2 + 2.5 * across * across).sqrt();
                let depth = 2f64.sqrt() * along * y;
                let s = 0.031_622_78 + depth + spread * (0.5 - depth);
                let a = y * dot(m, to);
                let soft = 2.0 * a.max(0.0) + s * s / (2.0 * a.abs() + s);
                soft / (d2 + across * across)
            });
            f64::from(set.phi) * mean
        });
        for slot in 1..4 {
            let ratio = f64::from(found[slot]) / f64::from(found[0]) * expected[0] / expected[slot];
            assert!(found[slot] > 0.0);
            let off = ratio.max(1.0 / ratio);
            if slot == 1 {
                worst_plain = worst_plain.max(off);
            } else {
                worst = worst.max(off);
                total += off;
                count += 1.0;
            }
        }
    }
    println!(
        "points: off by a factor of {worst_plain:.4} at most; sets: {:.4} in the mean, {worst:.3} at most",
        total / count
    );
    assert!(worst_plain < 1.03, "{worst_plain}");
    // The worst is a narrow set that most of the segment sees from behind.
    assert!(worst < 6.0 && total / count < 1.05, "{worst}, {}", total / count);
}

/// A segment without length, a light on the segment, far and large ones: weights are finite and positive.
#[test]
fn weights_are_positive_everywhere() {
    let random = &mut Random(2);
    for exponent in [-90, -40, 0, 20, 39] {
        let scale = pow2(exponent);
        for trial in 0..200 {
            let from = random.vector(scale);
            let to = match trial % 4 {
                0 => from,
                1 => random.vector(scale),
                2 => random.vector(scale * pow2(-30)),
                _ => random.vector(pow2(40)),
            };
            let segment = RaySegment { from, to }.checked().expect("in the domain");
            let mut node = MomentNode::<4>::EMPTY;
            let sets: [LightMoments; 4] = core::array::from_fn(|slot| {
                node.set_child(slot, kind::LIGHT, 0);
                let part = random.unit();
                let c = match slot {
                    0 => segment.at(part),
                    1 => from,
                    2 => to,
                    _ => random.vector(scale),
                };
                let across = if trial % 3 == 0 {
                    0.0
                } else {
                    scale * random.unit()
                };
                LightMoments {
                    phi: pow2((trial % 60) - 30),
                    c: Vec3::from_array(c),
                    across,
                    along: across,
                    m: Vec3::from_array(random.unit_vector()),
                    h: Vec3::splat(across),
                }
            });
            node.set_summaries(&sets);
            for weight in Subtended::<Moments>::weights(&node, &segment) {
                assert!(
                    (pow2(-120)..=pow2(120)).contains(&weight),
                    "{weight} at {segment:?} of {sets:?}"
                );
            }
        }
    }
}

/// Mean relative variance of one sample by `I`, for segments.
fn variance<N: LightNode<W>, I: ImportanceModel<N, W, P>, P: Receiver, const W: usize>(
    two: bool,
    long: f32,
    told: impl Fn(&RaySegment) -> P,
) -> f64 {
    kit::variance::<N, I, P, _, W>(two, 40, |random| {
        let segment = random.segment(5.0, long);
        let of = move |light: &EmissiveTriangle| received::<3>(light, &segment, 24);
        (told(&segment), of)
    })
}

fn middle(segment: &RaySegment) -> ShadingPoint {
    ShadingPoint {
        p: segment.at(0.5),
        n: [0.0; 3],
    }
}

/// Against the point in a volume in the middle of the segment, which is what could be asked for before.
#[test]
fn segments_pay() {
    type D = Defensive<Moments, 6>;
    type S = Defensive<Subtended<Moments>, 6>;
    for two in [false, true] {
        for (long, most) in [(0.5, 1.05), (3.0, 0.7), (12.0, 0.3)] {
            let without = variance::<MomentNode<8>, D, _, 8>(two, long, middle);
            let with = variance::<MomentNode<8>, S, _, 8>(two, long, |s| *s);
            println!("two levels {two}, {long} m: {without:.3} by the middle, {with:.3} by the segment");
            assert!(with < most * without, "{with} of {without} at {long}");
        }
    }
    let without = variance::<CompactNode<4>, Eq4, _, 4>(false, 6.0, middle);
    let with = variance::<CompactNode<4>, Subtended<Eq4>, _, 4>(false, 6.0, |s| *s);
    println!("Eq. 4, 6 m: {without:.3} by the middle, {with:.3} by the segment");
    assert!(with < without, "{with} of {without}");
}
