//! A surface that light reaches from both sides, against sums over all lights in `f64`.

use crate::kit::{self, Random, dot, minus, room, rooms, wide};
use lightbvh::error::PointError;
use lightbvh::exact::hash;
use lightbvh::importance::{ImportanceModel, Transmissive, TransmissivePoint};
use lightbvh::{
    BuildParams, Bvh, CompactNode, Defensive, EmissiveTriangle, Eq4, LightNode, MomentNode, Moments,
    Receiver, ShadingPoint,
};

/// Irradiance, W/m², of both sides of a surface at `p` by a triangle: the integral over it, by `N`² pieces.
fn irradiance<const N: usize>(triangle: &EmissiveTriangle, point: &ShadingPoint) -> [f64; 2] {
    let (across, places) = kit::pieces::<N>(triangle);
    let (p, n) = (wide(point.p), wide(point.n));
    let mut sides = [0.0; 2];
    for place in places {
        let to = minus(place, p);
        let d2 = dot(to, to);
        let emitted = kit::emitted(triangle, -dot(across, to));
        let received = dot(n, to);
        let sent = f64::from(triangle.radiance[0]) * 0.5 * emitted * received.abs() / (d2 * d2);
        sides[usize::from(received < 0.0)] += sent / (N * N) as f64;
    }
    sides
}

fn received<const N: usize>(triangle: &EmissiveTriangle, receiver: &TransmissivePoint) -> f64 {
    let [front, back] = irradiance::<N>(triangle, &receiver.point);
    f64::from(receiver.front) * front + f64::from(receiver.back) * back
}

const PARTS: [[f32; 2]; 5] = [[1.0, 0.0], [0.0, 1.0], [0.5, 0.5], [0.8, 0.1], [0.02, 0.6]];

fn surface(random: &mut Random, [front, back]: [f32; 2]) -> TransmissivePoint {
    TransmissivePoint {
        point: ShadingPoint {
            p: random.vector(5.0),
            n: random.unit_vector(),
        },
        front,
        back,
    }
}

/// A weight is the sum of those of both sides, to rounding, and positive where there is flux.
fn weights_are_sums<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>() {
    let random = &mut Random(1);
    let lights = room(random);
    let bvh: Bvh<N, I, W> = Bvh::single_level(&lights, &BuildParams::default());
    let mut compared = 0;
    for _ in 0..60 {
        for [front, back] in PARTS {
            let receiver = surface(random, [front, back]);
            let turned = ShadingPoint {
                n: receiver.point.n.map(|x| -x),
                ..receiver.point
            };
            for node in bvh.nodes() {
                let found = Transmissive::<I>::weights(node, &receiver);
                let (w, v) = (I::weights(node, &receiver.point), I::weights(node, &turned));
                let of = |slot: usize| {
                    f64::from(front) * f64::from(w[slot]) + f64::from(back) * f64::from(v[slot])
                };
                for (slot, &found) in found.iter().enumerate() {
                    assert_eq!(found > 0.0, node.kind(slot) != 0);
                    let scale = f64::from(front.max(back));
                    let expected = of(slot) / scale;
                    assert!(
                        (f64::from(found) - expected).abs() <= 4e-7 * expected,
                        "{found} and {expected}"
                    );
                    compared += u32::from(expected > 0.0);
                }
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

#[test]
fn a_part_of_one_side_is_that_side_to_the_bit() {
    let random = &mut Random(2);
    let lights = room(random);
    let bvh: Bvh<MomentNode<8>, Defensive<Transmissive<Moments>, 6>, 8> =
        Bvh::two_level(&lights, &BuildParams::default());
    let plain = bvh.by::<Defensive<Moments, 6>>();
    for k in 0..2000 {
        let mut receiver = surface(random, [0.3, 0.0]);
        let number = hash(k);
        assert_eq!(
            bvh.sample(&receiver, number),
            plain.sample(&receiver.point, number)
        );
        receiver.point.n = receiver.point.n.map(|x| -x);
        let behind = TransmissivePoint {
            point: ShadingPoint {
                n: receiver.point.n.map(|x| -x),
                ..receiver.point
            },
            front: 0.0,
            back: 0.7,
        };
        assert_eq!(bvh.sample(&behind, number), plain.sample(&receiver.point, number));
    }
}

/// A receiver that takes nothing still ends at lights, whose probabilities sum to one.
#[test]
fn no_part_at_all_counts_both_alike() {
    let random = &mut Random(3);
    let lights = room(random);
    let bvh: Bvh<MomentNode<8>, Transmissive<Moments>, 8> =
        Bvh::single_level(&lights, &BuildParams::default());
    let receiver = surface(random, [0.0, 0.0]);
    let alike = TransmissivePoint {
        front: 0.5,
        back: 0.5,
        ..receiver
    };
    for light in 0..200 {
        let pmf = bvh.tree().pmf(&receiver, light, 0);
        assert_eq!(pmf.to_bits(), bvh.tree().pmf(&alike, light, 0).to_bits());
        assert!(pmf > 0.0);
    }
}

/// Mean relative variance of one sample by `I`, for surfaces.
fn variance<N: LightNode<W>, I: ImportanceModel<N, W, P>, P: Receiver, const W: usize>(
    two: bool,
    parts: [f32; 2],
    told: impl Fn(&TransmissivePoint) -> P,
) -> f64 {
    kit::variance::<N, I, P, _, W>(two, 60, |random| {
        let receiver = surface(random, parts);
        let of = move |light: &EmissiveTriangle| received::<6>(light, &receiver);
        (told(&receiver), of)
    })
}

/// Against a point in a volume at the same place, which is all that could be said of such a surface before.
#[test]
fn both_sides_pay() {
    type D = Defensive<Moments, 6>;
    type T = Defensive<Transmissive<Moments>, 6>;
    let volume = |t: &TransmissivePoint| ShadingPoint {
        n: [0.0; 3],
        ..t.point
    };
    for two in [false, true] {
        for (parts, most) in PARTS.into_iter().zip([0.7, 0.7, 0.9, 0.8, 0.8]) {
            let without = variance::<MomentNode<8>, D, _, 8>(two, parts, volume);
            let with = variance::<MomentNode<8>, T, _, 8>(two, parts, |t| *t);
            println!("two levels {two}, parts {parts:?}: {without:.3} in a volume, {with:.3} told");
            assert!(with < most * without, "{with} of {without} at {parts:?}");
        }
    }
    let (without, with) = (
        variance::<CompactNode<4>, Eq4, _, 4>(false, [0.8, 0.1], volume),
        variance::<CompactNode<4>, Transmissive<Eq4>, _, 4>(false, [0.8, 0.1], |t| *t),
    );
    println!("Eq. 4: {without:.3} in a volume, {with:.3} told");
    assert!(with < without, "{with} of {without}");
}

/// Samples, through instances that turn, stretch and mirror, against the sum over all lights.
#[test]
fn estimates_converge() {
    const SAMPLES: u32 = 40_000;
    let random = &mut Random(6);
    let bvh: Bvh<MomentNode<8>, Defensive<Transmissive<Moments>, 6>, 8> = rooms(random, 60, 4);
    let world = bvh.world_lights();
    for parts in PARTS {
        let receiver = surface(random, parts).checked().expect("in the domain");
        let f: Vec<f64> = world
            .iter()
            .map(|light| received::<6>(light, &receiver))
            .collect();
        let expected: f64 = f.iter().sum();
        let mut square = 0.0;
        for ((light, own), f) in (0..).zip(&world).zip(&f) {
            let pmf = f64::from(bvh.tree().pmf(&receiver, light, own.mesh));
            assert!(pmf > 0.0);
            square += f * f / pmf;
        }
        let deviation = ((square - expected * expected) / f64::from(SAMPLES)).sqrt();
        let mut mean = 0.0;
        for _ in 0..SAMPLES {
            random.0 = random.0.wrapping_add(1);
            let sampled = bvh.sample(&receiver, hash(random.0));
            mean += f[sampled.light as usize] / f64::from(sampled.pmf) / f64::from(SAMPLES);
        }
        assert!(
            (mean - expected).abs() < 5.0 * deviation,
            "{mean}, expected {expected} within {deviation}: {parts:?}"
        );
    }
}

/// Masks and both sides together.
#[test]
fn masks_go_with_it() {
    kit::masks_go_with::<Transmissive<Moments>, _>(&mut Random(8), |random| surface(random, [0.4, 0.6]));
}

#[test]
fn points_are_checked() {
    let sound = surface(&mut Random(5), [0.25, 0.5]);
    assert_eq!(sound.checked(), Ok(sound));
    let beyond = TransmissivePoint {
        front: 2.0,
        back: -1.0,
        ..sound
    };
    assert_eq!(beyond.checked().map(|t| [t.front, t.back]), Ok([1.0, 0.0]));
    let broken = TransmissivePoint {
        back: f32::NAN,
        ..sound
    };
    let error = broken.checked().expect_err("no number");
    assert!(matches!(error, PointError::Part { .. }));
    assert!(error.to_string().contains("transmissive"));
    let nowhere = TransmissivePoint {
        point: ShadingPoint {
            p: [f32::INFINITY; 3],
            n: [0.0; 3],
        },
        ..sound
    };
    assert!(matches!(nowhere.checked(), Err(PointError::Coordinate { .. })));
}
