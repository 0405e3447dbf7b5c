//! Receivers that say more than a shading point: weights against formulas and integrals in `f64`. How much less variance they have,
//! `lightbvh trade` measures.

use glam::Vec3;
use lightbvh::error::DomainError;
use lightbvh::exact::{self, hash, pow2};
use lightbvh::importance::{
    Flux, Glossy, ImportanceModel, Linked, LinkedPoint, RaySegment, Receiver, Subtended, Transmissive,
    TransmissivePoint,
};
use lightbvh::node::{LinkedSpotMomentNode, kind};
use lightbvh::tree::Model;
use lightbvh::{
    BuildParams, Bvh, CompactNode, EmissiveTriangle, Eq4, GlossyPoint, LightMoments, LightNode, MomentNode,
    Moments, Node, ShadingPoint, Transform,
};

use crate::kit::{Random, Wide, dot, minus, room, times, wide};

pub fn node(sets: &[LightMoments; 4]) -> MomentNode<4> {
    let mut node = MomentNode::EMPTY;
    (0..4).for_each(|slot| node.set_child(slot, kind::LIGHT, slot as u32));
    node.set_summaries(sets);
    node
}

/// A surface at the origin of a view `to` away from it.
fn glossy(p: [f32; 3], n: [f32; 3], to: [f64; 3], specular: f32, log2: u32) -> GlossyPoint {
    let normal = n.map(f64::from);
    let along = 2.0 * dot(normal, to);
    GlossyPoint {
        point: ShadingPoint { p, n },
        mirror: minus(times(normal, along), to).map(|x| x as f32),
        diffuse: 0.5 * (1.0 - specular),
        specular,
        exponent: exact::pow2(log2 as i32),
    }
}

/// Within a cube of twice `size`.
fn any_glossy(random: &mut Random, size: f32) -> GlossyPoint {
    let (p, n) = (random.within(size), random.unit_vector());
    let mut to = wide(random.unit_vector());
    if dot(to, wide(n)) < 0.0 {
        to = times(to, -1.0);
    }
    let specular = [0.0, 0.3, 1.0][random.below(3) as usize];
    let log2 = random.below(17);
    glossy(p, n, to, specular, log2)
}

#[test]
fn glossy_factors_are_their_formula() {
    let random = &mut Random(1);
    let (mut within, mut beside, mut wide_of) = (0, 0, 0);
    for _ in 0..20_000 {
        let size = random.power(-20, 20);
        let receiver = any_glossy(random, size);
        let sets = [0; 4].map(|_| {
            let to = if random.below(2) == 0 {
                Vec3::from_array(random.unit_vector())
            } else {
                Vec3::from_array(receiver.mirror) + Vec3::from_array(random.within(0.2))
            };
            LightMoments {
                phi: 1.0,
                c: receiver.point.position() + to * (size * random.power(-4, 4)),
                across: size * random.power(-8, 1),
                along: 0.0,
                m: Vec3::ZERO,
                h: Vec3::ZERO,
            }
        });
        let node = node(&sets);
        let sets = [0, 1, 2, 3].map(|slot| node.summary(slot));
        let found = Glossy::<Flux>::weights(&node, &receiver);
        for slot in 0..4 {
            let away = minus(wide(sets[slot].c.to_array()), wide(receiver.point.p));
            let d2 = dot(away, away);
            let k = f64::from(receiver.exponent);
            let spread = f64::from(sets[slot].across).powi(2) * 2.0 + f64::from(sets[slot].along).powi(2);
            let u2 = 0.5 * spread / d2.max(spread * 2f64.powi(-20));
            let widened = 1.0 + 0.25 * k * u2;
            let mirror = receiver.mirror.map(f64::from);
            let z = 0.25 * k / widened * (1.0 - dot(mirror, away) / d2.sqrt());
            let lobe = f64::from(receiver.specular) * (k + 6.0) / 8.0 / widened / (1.0 + z / 4.0).powi(4);
            let expected = (f64::from(receiver.diffuse) + lobe).max(2f64.powi(-20));
            assert!(
                (f64::from(found[slot]) / expected - 1.0).abs() < 1e-3,
                "{found:?}, {slot} expected {expected}: {sets:?} at {receiver:?}"
            );
            let lit = receiver.specular > 0.0 && k > 32.0;
            within += u32::from(lit && z < 1.0 && u2 < 0.1);
            beside += u32::from(lit && z > 5.0);
            wide_of += u32::from(lit && widened > 2.0);
        }
    }
    for seen in [within, beside, wide_of] {
        assert!(seen > 500, "{within} {beside} {wide_of}");
    }
}

/// An instance turned and scaled is chosen from as its triangles in the world are. The map takes axes to axes, so that boxes
/// stay boxes, and is not its own inverse. `least` pmfs must be high, so that the receiver decides.
fn turns_with_instances<I, P: Receiver>(least: u32, receiver: fn(&mut Random) -> P)
where
    I: ImportanceModel<MomentNode<8>, 8, P>,
{
    let mut map = Transform::at([3.0, -1.0, 2.0]);
    map.columns = [[0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [2.0, 0.0, 0.0]];
    let (mut sharp, mut off, mut count) = (0, 0.0, 0.0);
    for seed in 0..60 {
        let random = &mut Random(seed);
        let mut mesh = room(random).all()[..8].to_vec();
        for triangle in &mut mesh {
            triangle.mesh = 0;
        }
        let placed = |triangles: Vec<EmissiveTriangle>, transform| {
            let mut bvh = lightbvh::LightBvh::default();
            let mesh = bvh.add_mesh(triangles).expect("within the domain");
            bvh.add_instance(mesh, transform).expect("an instance");
            bvh.refit();
            bvh
        };
        let turned = placed(mesh, map);
        let world = placed(turned.view().world_lights(), Transform::IDENTITY);
        for _ in 0..8 {
            let receiver = receiver(random);
            for light in 0..8 {
                let [a, b] = [&turned, &world].map(|bvh| bvh.tree().by::<I>().pmf(&receiver, light, 0));
                off += f64::from(exact::abs(a - b));
                count += 1.0;
                sharp += u32::from(b > 0.7);
            }
        }
    }
    // Words of nodes are rounded in other places.
    assert!(off < 0.004 * count && sharp > least, "{} {sharp}", off / count);
}

#[test]
fn receivers_turn_with_instances() {
    turns_with_instances::<Glossy<Moments>, _>(30, |random| GlossyPoint {
        specular: 1.0,
        diffuse: 0.0,
        ..any_glossy(random, 5.0)
    });
    turns_with_instances::<Transmissive<Moments>, _>(30, |random| leaf(random, [0.1, 0.9]));
    turns_with_instances::<Subtended, _>(30, |random| random.segment(5.0, 3.0));
}

const PARTS: [[f32; 2]; 6] = [
    [0.3, 0.0],
    [0.0, 0.7],
    [0.5, 0.5],
    [0.8, 0.1],
    [0.02, 0.6],
    [0.0, 0.0],
];

fn leaf(random: &mut Random, [front, back]: [f32; 2]) -> TransmissivePoint {
    TransmissivePoint {
        point: ShadingPoint {
            p: random.within(5.0),
            n: random.unit_vector(),
        },
        front,
        back,
    }
}

/// A weight is the sum of those of both sides, to rounding, and positive where there is flux. A part of one side is that side, to the
/// bit; without any part both count alike.
fn weights_are_sums<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>() {
    let random = &mut Random(1);
    let lights = room(random);
    let bvh: Bvh<(N, ()), W> = Bvh::single_level(&lights, &BuildParams::default());
    let mut compared = 0;
    for parts in PARTS.repeat(60) {
        let receiver = leaf(random, parts);
        let turned = ShadingPoint {
            n: receiver.point.n.map(|x| -x),
            ..receiver.point
        };
        let greatest = parts[0].max(parts[1]);
        let [front, back] = parts.map(|part| match greatest {
            0.0 => 1.0,
            _ => f64::from(part) / f64::from(greatest),
        });
        let rounding = if front * back == 0.0 { 0.0 } else { 4e-7 };
        for node in bvh.view().nodes() {
            let found = Transmissive::<I>::weights(node, &receiver);
            let (w, v) = (I::weights(node, &receiver.point), I::weights(node, &turned));
            for slot in 0..W {
                assert_eq!(found[slot] > 0.0, node.kind(slot) != 0);
                let expected = front * f64::from(w[slot]) + back * f64::from(v[slot]);
                assert!(
                    (f64::from(found[slot]) - expected).abs() <= rounding * expected,
                    "{parts:?}: {} and {expected}",
                    found[slot]
                );
                compared += u32::from(expected > 0.0);
            }
        }
    }
    assert!(compared > 10_000, "{compared}");
}

#[test]
fn weights_are_the_sum_of_both_sides() {
    weights_are_sums::<MomentNode<8>, Moments, 8>();
    weights_are_sums::<CompactNode<4>, Eq4, 4>();
}

impl Random {
    /// About `length` long, within about `reach` of the origin.
    fn segment(&mut self, reach: f32, length: f32) -> RaySegment {
        let (from, along) = (self.within(reach), self.unit_vector());
        RaySegment {
            from,
            to: core::array::from_fn(|k| from[k] + along[k] * length),
        }
    }
}

fn at(segment: &RaySegment, part: f64) -> Wide {
    let (from, to) = (wide(segment.from), wide(segment.to));
    core::array::from_fn(|k| from[k] + (to[k] - from[k]) * part)
}

/// The mean of `f` over the segment, steps even in the angle that `center` sees: parts of the segment, by the tangent.
fn mean_along(segment: &RaySegment, center: Wide, steps: u32, f: impl Fn(Wide) -> f64) -> f64 {
    let (from, to) = (wide(segment.from), wide(segment.to));
    let chord = minus(to, from);
    let len = dot(chord, chord).sqrt();
    let along = chord.map(|x| x / len);
    let foot = dot(minus(center, from), along);
    let across: Wide = core::array::from_fn(|k| center[k] - from[k] - along[k] * foot);
    let d = dot(across, across).sqrt().max(1e-6 * len);
    let (first, last) = ((-foot / d).atan(), ((len - foot) / d).atan());
    let step = (last - first) / f64::from(steps);
    let mut sum = 0.0;
    for k in 0..steps {
        let t = (first + step * (f64::from(k) + 0.5)).tan();
        let part = (t * d + foot) / len;
        sum += f(at(segment, part)) * d * (1.0 + t * t) * step / len;
    }
    sum
}

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
            let away = Vec3::from_array(random.within(2.0 * scale));
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
        let node = node(&sets);
        // As the words are read; the spread of normals is stored beside their mean, in units of 1/255.
        let spreads = sets.map(|set| {
            let m = wide(set.m.to_array());
            ((1.0 - dot(m, m)).max(0.0).sqrt() * 255.0).round() / 255.0
        });
        let sets = [0, 1, 2, 3].map(|slot| (node.summary(slot), spreads[slot]));
        let found = Subtended::weights(&node, &segment);
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
    assert!(worst_plain < 1.03, "{worst_plain}");
    // The worst is a narrow set that most of the segment sees from behind.
    assert!(worst < 6.0 && total / count < 1.05, "{worst}, {}", total / count);
}

/// A segment without length, a light on the segment, far and large ones: weights are finite and positive.
#[test]
fn weights_of_segments_are_positive_everywhere() {
    let random = &mut Random(2);
    for exponent in [-90, -40, 0, 20, 39] {
        let scale = pow2(exponent);
        for trial in 0..200 {
            let from = random.within(scale);
            let to = match trial % 4 {
                0 => from,
                1 => random.within(scale),
                2 => random.within(scale * pow2(-30)),
                _ => random.within(pow2(40)),
            };
            let segment = RaySegment { from, to }.checked().expect("in the domain");
            let sets: [LightMoments; 4] = core::array::from_fn(|slot| {
                let part = random.unit();
                let c = match slot {
                    0 => segment.at(part),
                    1 => from,
                    2 => to,
                    _ => random.within(scale),
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
            for weight in Subtended::weights(&node(&sets), &segment) {
                assert!(
                    (pow2(-120)..=pow2(120)).contains(&weight),
                    "{weight} at {segment:?} of {sets:?}"
                );
            }
        }
    }
}

pub fn refused<T: core::fmt::Debug>(found: Result<T, DomainError>, what: &str) {
    let error = found.expect_err(what).to_string();
    assert!(error.starts_with(what), "{error}");
}

#[test]
fn receivers_are_checked() {
    let nowhere = ShadingPoint {
        p: [f32::NAN; 3],
        n: [0.0; 3],
    };
    let lost = "coordinate x of the shading point is NaN";
    let sound = glossy([1.0, 2.0, 3.0], [0.0, 0.0, 1.0], [0.6, 0.0, 0.8], 0.3, 6);
    let of = |change: &dyn Fn(&mut GlossyPoint)| {
        let mut own = sound;
        change(&mut own);
        own.checked()
    };
    assert_eq!(of(&|_| ()), Ok(sound));
    assert!(of(&|g| g.mirror = [0.0; 3]).is_ok());
    let clamped = of(&|g| (g.diffuse, g.specular, g.exponent) = (-1.0, 2.0, f32::INFINITY));
    assert_eq!(
        clamped.map(|g| [g.diffuse, g.specular, g.exponent]),
        Ok([0.0, 1.0, 65_536.0])
    );
    let mirror = "the mirror direction of a glossy point is (1, 1, 1)";
    refused(of(&|g| g.mirror = [1.0; 3]), mirror);
    let number = "a reflectance or exponent of a glossy point is NaN";
    refused(of(&|g| g.diffuse = f32::NAN), number);
    refused(of(&|g| g.specular = f32::NAN), number);
    refused(of(&|g| g.exponent = f32::NAN), number);
    refused(of(&|g| g.point = nowhere), lost);

    let sound = leaf(&mut Random(5), [0.25, 0.5]);
    let of = |point, front, back| TransmissivePoint { point, front, back }.checked();
    assert_eq!(sound.checked(), Ok(sound));
    let clamped = of(sound.point, 2.0, -1.0);
    assert_eq!(clamped.map(|t| [t.front, t.back]), Ok([1.0, 0.0]));
    let part = "a part of a transmissive point is NaN";
    refused(of(sound.point, 0.5, f32::NAN), part);
    refused(of(nowhere, 0.5, 0.5), lost);

    let (from, to) = ([1.0, f32::from_bits(1), -0.0], [2.0, 3.0, 4.0]);
    let checked = RaySegment { from, to }.checked().expect("in the domain");
    assert_eq!(checked.from.map(f32::to_bits), [1.0_f32.to_bits(), 0, 0]);
    for broken in [f32::NAN, f32::INFINITY, 2e12] {
        let wrong = [1.0, broken, 3.0];
        for [from, to] in [[wrong, to], [from, wrong]] {
            refused(
                RaySegment { from, to }.checked(),
                "coordinate y of the shading point",
            );
        }
    }
}

/// Whether a light is chosen for the receiver: samples and probabilities agree.
fn has_light<M: Model<8, Light = EmissiveTriangle>, P: Receiver>(receiver: &P) -> bool
where
    M::Importance: ImportanceModel<M::Node, 8, P>,
{
    let mut bvh = Bvh::<M>::default();
    let lamp = EmissiveTriangle {
        p: [[0.0, 3.0, 0.0], [0.0, 3.0, 1.0], [1.0, 3.0, 0.0]],
        radiance: [1.0; 3],
        mesh: 0,
        flags: 1,
    };
    let id = bvh.add_light(lamp).expect("in the domain");
    bvh.refit();
    let sampled = bvh.sample(receiver, 7_u32);
    let pmf = bvh.pmf(receiver, id, 0);
    assert_eq!(sampled.map(|own| own.pmf), pmf);
    assert_eq!(bvh.pmf(receiver, id, 1), None);
    pmf.is_some()
}

/// A light for each sound receiver, and none for one that is not finite, not normalized, or beyond its ranges.
#[test]
fn wrong_receivers_get_no_light() {
    type Of<I> = (MomentNode<8>, I);
    let (here, up) = ([0.0, 1.0, 0.0], [0.0, 1.0, 0.0]);
    let of = |p, n| ShadingPoint { p, n };
    let glossy = |point, mirror, [diffuse, specular, exponent]: [f32; 3]| {
        has_light::<Of<Glossy<Moments>>, _>(&GlossyPoint {
            point,
            mirror,
            diffuse,
            specular,
            exponent,
        })
    };
    let leaf = |point, [front, back]: [f32; 2]| {
        has_light::<Of<Transmissive<Moments>>, _>(&TransmissivePoint { point, front, back })
    };
    for (point, is_sound) in [
        (of(here, up), true),
        (of(here, [0.0; 3]), true),
        (of([f32::NAN, 0.0, 0.0], up), false),
        (of([0.0, f32::INFINITY, 0.0], up), false),
        (of([0.0, 0.0, -1.0e19], up), false),
        (of(here, [0.0, 1.1, 0.0]), false),
        (of(here, [f32::NAN; 3]), false),
    ] {
        let masked = LinkedPoint { point, mask: 1 };
        let found = [
            has_light::<Of<Moments>, _>(&point),
            has_light::<(LinkedSpotMomentNode<8>, Linked<Moments>), _>(&masked),
            glossy(point, up, [0.5, 0.5, 8.0]),
            leaf(point, [0.5; 2]),
        ];
        assert_eq!(found, [is_sound; 4], "{point:?}");
        // A segment has no normal.
        for [from, to] in [[point.p, here], [here, point.p]] {
            let found = has_light::<Of<Subtended>, _>(&RaySegment { from, to });
            assert_eq!(found, point.p == here, "{point:?}");
        }
    }
    for wrong in [f32::NAN, -1.0, f32::INFINITY] {
        assert!(!glossy(of(here, up), [wrong; 3], [0.5, 0.5, 8.0]));
        for k in 0..3 {
            let mut parts = [0.5, 0.5, 8.0];
            parts[k] = wrong;
            assert!(!glossy(of(here, up), up, parts), "{parts:?}");
        }
        assert!(!leaf(of(here, up), [wrong, 0.5]) && !leaf(of(here, up), [0.5, wrong]));
    }
}
