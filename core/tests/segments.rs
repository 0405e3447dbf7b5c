//! A piece of a ray through a volume, against integrals along it in `f64`.

#![allow(clippy::disallowed_methods, reason = "nothing here is shared with devices")]

use glam::Vec3;
use lightbvh::exact::{hash, pow2, unit_f32};
use lightbvh::importance::{ImportanceModel, Linked, LinkedPoint, RaySegment, Receiver, Subtended};
use lightbvh::light::LinkedTriangle;
use lightbvh::node::{LinkedMomentNode, Lit, kind};
use lightbvh::{
    BuildParams, Bvh, CompactNode, Defensive, EmissiveTriangle, Eq4, FullMomentNode, FullNode, LightMoments,
    LightNode, Lights, MomentNode, Moments, Node, ShadingPoint, Transform,
};

type Wide = [f64; 3];

struct Random(u32);

impl Random {
    fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(1);
        unit_f32(hash(self.0))
    }

    fn vector(&mut self, scale: f32) -> [f32; 3] {
        core::array::from_fn(|_| (2.0 * self.unit() - 1.0) * scale)
    }

    fn unit_vector(&mut self) -> [f32; 3] {
        loop {
            let v = self.vector(1.0);
            let squared: f32 = v.iter().map(|x| x * x).sum();
            if (0.01..=1.0).contains(&squared) {
                return v.map(|x| x / squared.sqrt());
            }
        }
    }

    /// About `length` long, within about `reach` of the origin.
    fn segment(&mut self, reach: f32, length: f32) -> RaySegment {
        let (from, along) = (self.vector(reach), self.unit_vector());
        RaySegment {
            from,
            to: core::array::from_fn(|k| from[k] + along[k] * length),
        }
    }
}

fn wide(v: [f32; 3]) -> Wide {
    v.map(f64::from)
}

fn minus(a: Wide, b: Wide) -> Wide {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: Wide, b: Wide) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn length(v: Wide) -> f64 {
    dot(v, v).sqrt()
}

fn cross(a: Wide, b: Wide) -> Wide {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn at(segment: &RaySegment, part: f64) -> Wide {
    let (from, to) = (wide(segment.from), wide(segment.to));
    core::array::from_fn(|k| from[k] + (to[k] - from[k]) * part)
}

/// The mean of `f` over the segment, steps even in the angle that `center` sees: parts of the segment, by the tangent.
fn mean_along(segment: &RaySegment, center: Wide, steps: u32, f: impl Fn(Wide) -> f64) -> f64 {
    let (from, to) = (wide(segment.from), wide(segment.to));
    let chord = minus(to, from);
    let len = length(chord);
    let along = chord.map(|x| x / len);
    let foot = dot(minus(center, from), along);
    let across: Wide = core::array::from_fn(|k| center[k] - from[k] - along[k] * foot);
    let d = length(across).max(1e-6 * len);
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

/// Sets with and without size and normals, in `FullMomentNode`s: the weights are the means along the segment.
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
        let mut node = FullMomentNode::<4>::EMPTY;
        for slot in 0..4 {
            node.set_child(slot, kind::LIGHT, slot as u32);
        }
        node.set_summaries(&sets);
        let found = Subtended::<Moments>::weights(&node, &segment);
        let expected = sets.map(|set| {
            let (c, m) = (wide(set.c.to_array()), wide(set.m.to_array()));
            let (across, along) = (f64::from(set.across), f64::from(set.along));
            let mean = mean_along(&segment, c, 400, |p| {
                let to = minus(p, c);
                let d2 = dot(to, to);
                // The soft cosine of `docs/walk.md`, section 2.
                let y = 1.0 / (d2 + 2.5 * across * across).sqrt();
                let depth = 2f64.sqrt() * along * y;
                let spread = (1.0 - dot(m, m)).max(0.0).sqrt();
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
    assert!(worst < 3.0 && total / count < 1.05, "{worst}, {}", total / count);
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

/// 200 triangles of up to half a metre in a room of 10 m, in four meshes.
fn room(random: &mut Random) -> Lights {
    let triangle = |k: u32| {
        let at = random.vector(5.0);
        let mut corner = || {
            let edge = random.vector(0.5);
            [at[0] + edge[0], at[1] + edge[1], at[2] + edge[2]]
        };
        EmissiveTriangle {
            p: [at, corner(), corner()],
            radiance: [0.1 + 2.0 * unit_f32(hash(k)); 3],
            mesh: k / 50,
            flags: u32::from(k % 5 == 2) * EmissiveTriangle::TWO_SIDED,
        }
    };
    Lights::new((0..200).map(triangle).collect()).expect("in the domain")
}

/// What the segment receives of a triangle, W/m: the fluence over all directions along it, from `N`² pieces of the triangle.
fn received<const N: usize>(triangle: &EmissiveTriangle, segment: &RaySegment, steps: u32) -> f64 {
    let v = triangle.p.map(wide);
    let (a, b) = (minus(v[1], v[0]), minus(v[2], v[0]));
    let across = cross(a, b);
    let mut sum = 0.0;
    for i in 0..N {
        for j in 0..N {
            let (mut s, mut t) = ((i as f64 + 0.4) / N as f64, (j as f64 + 0.5) / N as f64);
            if s + t > 1.0 {
                (s, t) = (1.0 - s, 1.0 - t);
            }
            let place: Wide = core::array::from_fn(|k| v[0][k] + a[k] * s + b[k] * t);
            sum += mean_along(segment, place, steps, |p| {
                let to = minus(p, place);
                let d2 = dot(to, to);
                let emitted = 0.5 * dot(across, to) / d2.sqrt();
                let emitted = if triangle.is_two_sided() {
                    emitted.abs()
                } else {
                    emitted.max(0.0)
                };
                f64::from(triangle.radiance[0]) * emitted / d2
            });
        }
    }
    sum / (N * N) as f64 * length(minus(wide(segment.to), wide(segment.from)))
}

/// Mean relative variance of one sample, by enumeration of all lights.
fn variance<N: LightNode<W>, I, P, const W: usize>(
    two: bool,
    long: f32,
    told: impl Fn(&RaySegment) -> P,
) -> f64
where
    P: Receiver,
    I: ImportanceModel<N, W, P>,
{
    const SEGMENTS: u32 = 40;
    let random = &mut Random(4);
    let lights = room(random);
    let bvh: Bvh<N, I, W> = if two {
        Bvh::two_level(&lights, &BuildParams::default())
    } else {
        Bvh::single_level(&lights, &BuildParams::default())
    };
    let mut all = 0.0;
    for _ in 0..SEGMENTS {
        let segment = random.segment(5.0, long);
        let query = told(&segment);
        let (mut mean, mut square, mut sum) = (0.0, 0.0, 0.0);
        for (light, triangle) in (0..).zip(lights.triangles()) {
            let pmf = f64::from(
                bvh.tree()
                    .pmf_for(&query, light, if two { triangle.mesh } else { 0 }),
            );
            let f = received::<3>(triangle, &segment, 24);
            assert!(pmf > 0.0 || f == 0.0, "{light} is lost at {segment:?}");
            mean += f;
            square += if f > 0.0 { f * f / pmf } else { 0.0 };
            sum += pmf;
        }
        assert!((sum - 1.0).abs() < 1e-5, "{sum}");
        all += square / (mean * mean) - 1.0;
    }
    all / f64::from(SEGMENTS)
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
    let full = variance::<FullNode<4>, Subtended<Eq4>, _, 4>(false, 6.0, |s| *s);
    assert!((full / with - 1.0).abs() < 0.2, "{full} and {with}");
}

/// Steps even in `u` have that much of the density between them, and the density is nearly that of the angle.
#[test]
fn places_have_their_density() {
    const STEPS: u32 = 64;
    let random = &mut Random(5);
    let (mut least, mut most) = (1.0_f64, 1.0_f64);
    for trial in 0..400 {
        let scale = pow2((trial % 21) - 10);
        let segment = random.segment(scale, scale * pow2(trial % 7 - 3));
        let part = random.unit();
        let near = segment.at(part);
        // Some close by the segment.
        let center = if trial % 3 == 0 {
            let off = random.vector(scale * 1e-2);
            core::array::from_fn(|k| near[k] + off[k])
        } else {
            random.vector(scale)
        };
        let center = Vec3::from_array(center);
        let c = wide(center.to_array());
        let (from, to) = (wide(segment.from), wide(segment.to));
        let chord = minus(to, from);
        let len = length(chord);
        let d = length(cross(minus(c, from), chord)) / len;
        let [a, b] = [minus(from, c), minus(to, c)];
        let angle = length(cross(a, b)).atan2(dot(a, b));
        let foot = dot(minus(c, from), chord) / len;
        let angle_at = |part: f64| ((part * len - foot) / d).atan();
        let mut before = 0.0;
        for k in 1..=STEPS {
            let u = k as f32 / STEPS as f32;
            let sample = segment.sample(center, u.min(1.0 - pow2(-24)));
            assert!((0.0..=1.0).contains(&sample.part) && f64::from(sample.part) >= before);
            assert_eq!(
                sample.density.to_bits(),
                segment.density(center, sample.part).to_bits()
            );
            // Simpson's rule over the angle of the step, over which the density has hardly a slope.
            let end = f64::from(sample.part);
            let (first, last) = (angle_at(before), angle_at(end));
            let mut sum = 0.0;
            for piece in 0..64 {
                let [x, y] = [0, 1].map(|i| first + (last - first) * f64::from(piece + i) / 64.0);
                let at = |angle: f64| {
                    let tangent = angle.tan();
                    let part = ((tangent * d + foot) / len) as f32;
                    f64::from(segment.density(center, part)) * d * (1.0 + tangent * tangent)
                };
                sum += (at(x) + 4.0 * at(0.5 * (x + y)) + at(y)) * (y - x) / 6.0;
            }
            let found = sum * f64::from(STEPS);
            // Parts are numbers of 24 bits, and those between them are rounded.
            let rounding = 1e-6 / (end - before);
            assert!(
                (found - 1.0).abs() < 2e-3 + rounding,
                "{found} of step {k} in {segment:?} about {center}"
            );
            before = end;
            let place = minus(at(&segment, end), c);
            let exact = d / (angle * dot(place, place));
            if d > 1e-3 * f64::from(scale) {
                let ratio = f64::from(sample.density) / exact;
                least = least.min(ratio);
                most = most.max(ratio);
            }
        }
        assert_eq!(segment.sample(center, 0.0).part, 0.0);
    }
    println!("density over the equiangular one: {least:.4} to {most:.4}");
    // Θ/sin Θ and Θ/2 over tan Θ/2 of a quarter of a half turn are 1.111 and 0.948.
    assert!(least > 0.94 && most < 1.12, "{least} {most}");
    assert!(least < 0.96 && most > 1.1, "no angle is wide: {least} {most}");
}

/// The inverse square along segments, by 256 places each: no bias, and hardly any variance.
#[test]
fn distances_integrate_the_inverse_square() {
    let random = &mut Random(6);
    let mut spread = 0.0;
    for trial in 0..200 {
        let segment = random.segment(1.0, 4.0);
        let center = random.vector(1.0);
        let c = wide(center);
        let exact = mean_along(&segment, c, 20_000, |p| {
            let to = minus(p, c);
            1.0 / dot(to, to)
        }) * length(minus(wide(segment.to), wide(segment.from)));
        let (mut mean, mut square) = (0.0, 0.0);
        for k in 0..256 {
            let u = (k as f32 + 0.5) / 256.0;
            let sample = segment.sample(Vec3::from_array(center), u);
            let to = minus(at(&segment, f64::from(sample.part)), c);
            let f = 1.0 / dot(to, to) / f64::from(sample.density) / exact;
            mean += f / 256.0;
            square += f * f / 256.0;
        }
        // A stratified sum of a smooth function.
        assert!((mean - 1.0).abs() < 1e-3, "{mean} at {trial}");
        spread += (square - mean * mean) / 200.0;
    }
    println!("relative variance of 1/d² over the density: {spread:.5}");
    assert!(spread < 0.003, "{spread}");
}

/// Lights on the segment or at its ends, segments without length, great and small scales: places within, densities finite.
#[test]
fn places_of_degenerate_segments_are_sound() {
    let random = &mut Random(7);
    for exponent in [-100, -60, -20, 0, 30, 40] {
        let scale = pow2(exponent);
        for trial in 0..300 {
            let from = random.vector(scale);
            let to = if trial % 3 == 0 {
                from
            } else {
                random.vector(scale)
            };
            let segment = RaySegment { from, to };
            let part = random.unit();
            let center = match trial % 5 {
                0 => from,
                1 => to,
                2 => segment.at(part),
                3 => random.vector(pow2(40)),
                _ => random.vector(scale),
            };
            let u = random.unit();
            let sample = segment.sample(Vec3::from_array(center), u);
            assert!((0.0..=1.0).contains(&sample.part), "{sample:?}");
            assert!(
                sample.density.is_finite() && sample.density >= 0.0,
                "{sample:?} of {segment:?}"
            );
            if trial % 3 == 0 {
                assert_eq!(sample.density, 0.0);
            } else if exponent > -30 && trial % 5 != 3 {
                assert!(sample.density > 0.0, "{segment:?} about {center:?}");
            }
        }
    }
}

/// A light by the segment, a point on it, a distance for that point: the mean is the integral over all of them. Through instances that
/// turn, stretch and mirror.
#[test]
fn estimates_converge() {
    const SAMPLES: u32 = 60_000;
    let random = &mut Random(8);
    let mut bvh: Bvh<MomentNode<8>, Defensive<Subtended<Moments>, 6>, 8> = Bvh::default();
    let own = room(random);
    let mesh = bvh
        .add_mesh(own.triangles()[..40].to_vec())
        .expect("in the domain");
    for k in 0..3 {
        let s = if k % 2 == 0 { 1.0 } else { -1.0 };
        let map = Transform {
            columns: [[0.0, 1.5, 0.0], [-0.7, 0.0, 0.2], [0.0, 0.1, s]],
            translation: random.vector(6.0),
        };
        bvh.add_instance(mesh, map).expect("in the domain");
    }
    bvh.refit();
    let world = bvh.world_lights();
    for long in [0.7, 5.0, 25.0] {
        let segment = random.segment(5.0, long).checked().expect("in the domain");
        let expected: f64 = world
            .iter()
            .map(|light| received::<16>(light, &segment, 48))
            .sum();
        let (mut mean, mut square) = (0.0, 0.0);
        for _ in 0..SAMPLES {
            random.0 = random.0.wrapping_add(1);
            let sampled = bvh.sample_for(&segment, hash(random.0));
            let pmf = bvh.tree().pmf_for(&segment, sampled.light, sampled.instance);
            assert_eq!(sampled.pmf.to_bits(), pmf.to_bits());
            let light = bvh.triangle(sampled.light, sampled.instance).expect("a light");
            let on = light.point([random.unit(), random.unit()]);
            let along = segment.sample(Vec3::from_array(on.p), random.unit());
            let to = minus(at(&segment, f64::from(along.part)), wide(on.p));
            let d2 = dot(to, to);
            let cosine = dot(wide(on.normal), to) / d2.sqrt();
            let cosine = if light.is_two_sided() {
                cosine.abs()
            } else {
                cosine.max(0.0)
            };
            let density = f64::from(pmf) * f64::from(on.density) * f64::from(along.density);
            let f = f64::from(on.radiance[0]) * cosine / d2 / density;
            mean += f / f64::from(SAMPLES);
            square += f * f / f64::from(SAMPLES);
        }
        let deviation = ((square - mean * mean) / f64::from(SAMPLES)).sqrt();
        println!("{long} m: {mean:.5}, expected {expected:.5}, deviation {deviation:.5}");
        // The sum over all lights is one of pieces of them.
        assert!(
            (mean - expected).abs() < 5.0 * deviation + 0.01 * expected,
            "{mean}, expected {expected} within {deviation}"
        );
        assert!(
            deviation < 0.03 * expected,
            "nothing is tested: {deviation} of {expected}"
        );
    }
}

/// Masks and segments together.
#[test]
fn masks_go_with_it() {
    type Tree = Bvh<Lit<LinkedMomentNode<8>, LinkedTriangle>, Linked<Subtended<Moments>>, 8>;
    let random = &mut Random(9);
    let own = room(random);
    let linked = own.triangles().iter().zip(0..).map(|(&light, k)| LinkedTriangle {
        light,
        mask: 1 << (k % 3),
    });
    let linked = Lights::new(linked.collect()).expect("in the domain");
    let bvh = Tree::two_level(&linked, &BuildParams::default());
    let receiver = LinkedPoint {
        point: random.segment(5.0, 4.0),
        mask: 0b100,
    };
    let mut sum = 0.0;
    for (light, own) in (0..).zip(own.triangles()) {
        let pmf = bvh.tree().pmf_for(&receiver, light, own.mesh);
        assert_eq!(pmf > 0.0, light % 3 == 2);
        sum += f64::from(pmf);
    }
    assert!((sum - 1.0).abs() < 1e-5, "{sum}");
}

#[test]
fn segments_are_checked() {
    let tiny = f32::from_bits(1);
    let segment = RaySegment {
        from: [1.0, tiny, -0.0],
        to: [2.0, 3.0, 4.0],
    };
    let checked = segment.checked().expect("in the domain");
    assert_eq!(checked.from.map(f32::to_bits), [1.0_f32.to_bits(), 0, 0]);
    assert_eq!(checked.to, segment.to);
    for broken in [f32::NAN, f32::INFINITY, 2e12] {
        for end in 0..2 {
            let mut ends = [segment.from, segment.to];
            ends[end][1] = broken;
            let [from, to] = ends;
            assert!(RaySegment { from, to }.checked().is_err());
        }
    }
}
