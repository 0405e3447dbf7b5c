//! The factor of a glossy receiver against its formula, and what it is worth.

use glam::Vec3;
use lightbvh::error::PointError;
use lightbvh::exact;
use lightbvh::importance::{Flux, Glossy, ImportanceModel, Receiver};
use lightbvh::node::kind;
use lightbvh::{
    BuildParams, Bvh, CompactNode, Defensive, EmissiveTriangle, Eq4, GlossyPoint, LightMoments, MomentNode,
    Moments, Node, Random64, SampledLight, ShadingPoint, Summary, Transform,
};

use crate::kit::{self, Random, Wide, cross, dot, length, minus, room, wide};

fn times(v: Wide, s: f64) -> Wide {
    v.map(|x| x * s)
}

/// From 2^`low` to 2^`high`, as often in each octave.
fn power(random: &mut Random, low: i32, high: i32) -> f32 {
    let octave = low + random.below((high - low) as u32) as i32;
    exact::pow2(octave) * (1.0 + random.unit())
}

/// A surface at the origin of a view `to` away from it.
fn surface(p: [f32; 3], n: [f32; 3], to: [f64; 3], specular: f32, log2: u32) -> GlossyPoint {
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
fn any_surface(random: &mut Random, size: f32) -> GlossyPoint {
    let (p, n) = (random.vector(size), random.unit_vector());
    let mut to = wide(random.unit_vector());
    if dot(to, wide(n)) < 0.0 {
        to = times(to, -1.0);
    }
    let specular = [0.0, 0.3, 1.0][random.below(3) as usize];
    let log2 = random.below(17);
    surface(p, n, to, specular, log2)
}

#[test]
fn the_factor_is_its_formula() {
    let random = &mut Random(1);
    let (mut within, mut beside, mut wide_of) = (0, 0, 0);
    for _ in 0..20_000 {
        let size = power(random, -20, 20);
        let receiver = any_surface(random, size);
        let sets = [0; 4].map(|_| {
            let to = if random.below(2) == 0 {
                Vec3::from_array(random.unit_vector())
            } else {
                Vec3::from_array(receiver.mirror) + Vec3::from_array(random.vector(0.2))
            };
            LightMoments {
                phi: 1.0,
                c: receiver.point.position() + to * (size * power(random, -4, 4)),
                across: size * power(random, -8, 1),
                along: 0.0,
                m: Vec3::ZERO,
                h: Vec3::ZERO,
            }
        });
        let mut node = MomentNode::<4>::EMPTY;
        for slot in 0..4 {
            node.set_child(slot, kind::LIGHT, slot as u32);
        }
        node.set_summaries(&sets);
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

/// The least and the greatest that an importance may give.
struct Extremes;

impl<N> ImportanceModel<N, 4> for Extremes {
    const UNIFORM_HALVINGS: u32 = 0;

    fn weights(_: &N, _: &ShadingPoint) -> [f32; 4] {
        [exact::pow2(120), exact::pow2(-120), f32::MIN_POSITIVE, 0.0]
    }
}

#[test]
fn weights_stay_in_their_range() {
    let lights = room(&mut Random(9));
    let bvh: Bvh<CompactNode<4>, Eq4, 4> = Bvh::single_level(&lights, &BuildParams::default());
    let tree = bvh.tree();
    let at = tree.nodes[0].summary(0).center().to_array();
    for (p, log2, specular) in [([9.0; 3], 0, 0.0), (at, 16, 1.0), ([0.0; 3], 16, 1.0)] {
        let receiver = surface(p, [0.0, 1.0, 0.0], [0.0, 1.0, 0.0], specular, log2);
        for mirror in [[0.0; 3], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0]] {
            let receiver = GlossyPoint {
                mirror,
                diffuse: 0.0,
                ..receiver
            };
            let [most, least, tiny, none] = Glossy::<Extremes>::weights(&tree.nodes[0], &receiver);
            let range = exact::pow2(-120)..=exact::pow2(120);
            assert!(
                [most, least, tiny].iter().all(|w| range.contains(w)),
                "{most} {least} {tiny}"
            );
            assert_eq!(none, 0.0);
        }
    }
}

/// Several lights are those that one walk after the other finds, of every owner that has walks.
#[test]
fn several_lights_for_lobes_are_those_one_at_a_time() {
    let random = &mut Random(3);
    let bvh: Bvh<MomentNode<8>, Glossy<Moments>, 8> = Bvh::two_level(&room(random), &BuildParams::default());
    let (lean, fixed, meshes) = (
        bvh.clone().without_trails(),
        bvh.clone().into_static(),
        bvh.clone().into_static_meshes(),
    );
    let tree = bvh.tree();
    let receivers: Vec<GlossyPoint> = (0..50).map(|_| any_surface(random, 5.0)).collect();
    let numbers: Vec<Random64> = (0..50).map(|k| exact::hash(k).into()).collect();
    let mut batch = [SampledLight::NONE; 50];
    tree.sample_batch(&receivers, &numbers, &mut batch);
    for ((receiver, &number), in_batch) in receivers.iter().zip(&numbers).zip(batch) {
        let one = tree.sample(receiver, number);
        assert_eq!(in_batch, one);
        let pmf = tree.pmf(receiver, one.light, one.instance);
        assert_eq!(one.pmf.to_bits(), pmf.to_bits());
        assert_eq!(lean.sample(receiver, number), one);
        assert_eq!(fixed.sample(receiver, number), one);
        assert_eq!(meshes.sample(receiver, number), one);
        let singly: [SampledLight; 40] =
            core::array::from_fn(|k| tree.sample(receiver, number.spaced(k as u32, 40)));
        assert_eq!(tree.sample_many::<_, 40>(receiver, number), singly);
        assert_eq!(bvh.sample_many::<_, 40>(receiver, number), singly);
        assert_eq!(lean.sample_many::<_, 40>(receiver, number), singly);
        assert_eq!(fixed.sample_many::<_, 40>(receiver, number), singly);
        assert_eq!(meshes.sample_many::<_, 40>(receiver, number), singly);
    }
}

/// What a triangle reflects from its centroid, unshadowed: diffuse and Blinn's lobe.
fn reflected(triangle: &EmissiveTriangle, receiver: &GlossyPoint) -> f64 {
    let p = triangle.p.map(|v| v.map(f64::from));
    let center = [0, 1, 2].map(|k| (p[0][k] + p[1][k] + p[2][k]) / 3.0);
    let across = cross(minus(p[1], p[0]), minus(p[2], p[0]));
    let v = minus(center, receiver.point.p.map(f64::from));
    let (n, d2) = (receiver.point.n.map(f64::from), dot(v, v));
    let received = dot(n, v).max(0.0);
    let emitted = kit::emitted(triangle, -dot(across, v));
    let mirror = receiver.mirror.map(f64::from);
    let view = minus(times(n, 2.0 * dot(n, mirror)), mirror);
    let to = times(v, 1.0 / d2.sqrt());
    let half = [0, 1, 2].map(|k| to[k] + view[k]);
    let k = f64::from(receiver.exponent);
    let lobe = (k + 6.0) / 8.0 * (dot(n, half) / length(half)).max(0.0).powf(k);
    let reflectance = f64::from(receiver.diffuse) + f64::from(receiver.specular) * lobe;
    f64::from(triangle.radiance[0]) * reflectance * received * emitted / (d2 * d2)
}

/// Mean relative variance of one sample by `I`, which is told `P` of a receiver.
fn variance<I, P, F>(two: bool, specular: f32, log2: u32, told: F) -> f64
where
    I: ImportanceModel<MomentNode<8>, 8, P>,
    P: Receiver,
    F: Fn(&GlossyPoint) -> P,
{
    kit::variance::<MomentNode<8>, I, P, _, 8>(two, 200, |random| {
        let receiver = GlossyPoint {
            diffuse: 0.5 * (1.0 - specular),
            specular,
            exponent: exact::pow2(log2 as i32),
            ..any_surface(random, 5.0)
        };
        let of = move |light: &EmissiveTriangle| reflected(light, &receiver);
        (told(&receiver), of)
    })
}

/// Less variance than of the importance that knows nothing of the lobe where it is sharp, about as much where it is broad, the
/// same without a lobe.
#[test]
fn the_lobe_pays() {
    type D = Defensive<Moments, 6>;
    type G = Defensive<Glossy<Moments>, 6>;
    for two in [false, true] {
        let mut ratios = Vec::new();
        for (specular, log2) in [(0.0, 4), (0.3, 4), (0.3, 8), (0.9, 6), (0.9, 10)] {
            let without = variance::<D, _, _>(two, specular, log2, |g| g.point);
            let with = variance::<G, _, _>(two, specular, log2, |g| *g);
            println!("two levels {two}: s {specular}, k 2^{log2}: {without:.3}, told of the lobe {with:.3}");
            ratios.push(with / without);
        }
        assert!((ratios[0] - 1.0).abs() < 1e-3, "{ratios:?}");
        let most = [1.001, 1.1, 0.85, 1.0, 0.6];
        assert!(
            ratios.iter().zip(most).all(|(ratio, most)| *ratio < most),
            "{ratios:?}"
        );
    }
}

/// An instance turned and scaled is chosen from as its triangles in the world are. The map takes axes to axes, so that boxes
/// stay boxes, and is not its own inverse.
#[test]
fn lobes_turn_with_instances() {
    type G = Glossy<Moments>;
    let mut map = Transform::at([3.0, -1.0, 2.0]);
    map.columns = [[0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [2.0, 0.0, 0.0]];
    let (mut compared, mut sharp) = (0, 0);
    for seed in 0..60 {
        let random = &mut Random(seed);
        let mut mesh = room(random).triangles()[..8].to_vec();
        for triangle in &mut mesh {
            triangle.mesh = 0;
        }
        let placed = |triangles: Vec<EmissiveTriangle>, transform| {
            let mut bvh: Bvh<MomentNode<8>, G, 8> = Bvh::default();
            let mesh = bvh.add_mesh(triangles).expect("within the domain");
            bvh.add_instance(mesh, transform).expect("an instance");
            bvh.refit();
            bvh
        };
        let turned = placed(mesh, map);
        let world = placed(turned.world_lights(), Transform::IDENTITY);
        for _ in 0..8 {
            let mut receiver = any_surface(random, 5.0);
            receiver.specular = 1.0;
            receiver.diffuse = 0.0;
            let pmf = |bvh: &Bvh<MomentNode<8>, G, 8>, light| bvh.tree().pmf(&receiver, light, 0);
            for light in 0..8 {
                let [a, b] = [pmf(&turned, light), pmf(&world, light)];
                // Words of nodes are rounded in other places.
                assert!(
                    exact::abs(a - b) < 0.02 + 0.1 * b,
                    "{a} and {b} of {light}: {receiver:?}"
                );
                compared += 1;
                sharp += u32::from(b > 0.9);
            }
        }
    }
    assert!(compared > 3000 && sharp > 20, "{compared} {sharp}");
}

#[test]
fn glossy_points_are_checked() {
    let sound = surface([1.0, 2.0, 3.0], [0.0, 0.0, 1.0], [0.6, 0.0, 0.8], 0.3, 6);
    assert_eq!(sound.checked(), Ok(sound));
    let without = GlossyPoint {
        mirror: [0.0; 3],
        ..sound
    };
    assert_eq!(without.checked(), Ok(without));
    let bent = GlossyPoint {
        mirror: [1.0; 3],
        ..sound
    };
    assert_eq!(bent.checked(), Err(PointError::Mirror { mirror: [1.0; 3] }));
    let beyond = GlossyPoint {
        diffuse: -1.0,
        specular: 2.0,
        exponent: f32::INFINITY,
        ..sound
    };
    let clamped = beyond.checked().map(|g| [g.diffuse, g.specular, g.exponent]);
    assert_eq!(clamped, Ok([0.0, 1.0, 65_536.0]));
    for broken in [
        GlossyPoint {
            diffuse: f32::NAN,
            ..sound
        },
        GlossyPoint {
            specular: f32::NAN,
            ..sound
        },
        GlossyPoint {
            exponent: f32::NAN,
            ..sound
        },
    ] {
        assert!(matches!(broken.checked(), Err(PointError::Reflectance { .. })));
    }
    let nowhere = GlossyPoint {
        point: ShadingPoint {
            p: [f32::NAN; 3],
            n: [0.0; 3],
        },
        ..sound
    };
    assert!(matches!(nowhere.checked(), Err(PointError::Coordinate { .. })));
}
