//! Instances: bounds in the world hold what is there, and no light that can contribute loses its importance on the way into
//! the mesh's space, however coarse the numbers are there.

use glam::DVec3;
use lightbvh::exact::pow2;
use lightbvh::importance::ImportanceModel;
use lightbvh::node::kind;
use lightbvh::{
    CompactNode, EmissiveTriangle, Eq4, FullNode, Instance, LightBounds, LightNode, MeshLeaf, Scene,
    ShadingPoint, Transform,
};
use lightbvh_tests::edits::{add_instance, add_mesh};
use lightbvh_tests::generate::{self, Random};
use lightbvh_tests::oracle::{Triangle, angle, can_contribute, half_angle, vector};
use lightbvh_tests::placing::{self, Kind};
use proptest::prelude::*;

/// What rounding of the input may decide, as a part of the distance.
const MARGIN: f64 = 1e-6;

/// A triangle about the origin of a mesh, of any size from centimetres to a metre.
fn local_triangle(random: &mut Random) -> EmissiveTriangle {
    let size = generate::log_uniform(random, -7, 0);
    let mut triangle = generate::small_triangles(1, 1, 1.0, size, random.below(4) == 0, random.bits())[0];
    let at = random.direction().map(|x| x * random.unit());
    let corner = triangle.p[0];
    triangle.p = triangle
        .p
        .map(|p| std::array::from_fn(|k| p[k] - corner[k] + at[k]));
    triangle
}

/// The triangle as a mesh of its own, placed by the scene; `None` where it was given a bottom level of its own.
fn placed(triangle: &EmissiveTriangle, transform: Transform) -> Option<(Instance, EmissiveTriangle)> {
    let mut scene = Scene::<CompactNode<2>, 2>::default();
    let mesh = add_mesh(&mut scene, vec![*triangle]);
    let id = add_instance(&mut scene, mesh, transform);
    scene.refit();
    let stats = scene.validate().expect("valid");
    let light = scene.lights_of(id).expect("there").start;
    let world = scene.light(light, id).expect("there");
    (stats.blases == 1).then(|| (scene.instances()[id.index() as usize], world))
}

/// A point that sees the triangle at a grazing angle, and whose horizon passes close below its highest corner; or any point.
fn point(random: &mut Random, world: &EmissiveTriangle) -> ShadingPoint {
    let triangle = Triangle::new(world);
    let normal = triangle.normal.normalize();
    let size = triangle.normal.length().sqrt();
    let from = triangle.p[random.below(3) as usize];
    let any = vector(random.direction());
    let along = (any - normal * any.dot(normal)).normalize();
    let distance = size * f64::from(generate::log_uniform(random, -6, 12));
    let rise = f64::from(generate::log_uniform(random, -20, 0));
    let p = from + along * distance + normal * (distance * rise);
    let p32 = p.to_array().map(|x| x as f32);
    let p = vector(p32);
    // A horizon through a corner, tipped so that the corner is just above it.
    let corner = triangle.p[random.below(3) as usize] - p;
    let side = vector(random.direction());
    let level = corner.cross(side).normalize();
    let tip = f64::from(generate::log_uniform(random, -20, 0));
    let n = (level + corner.normalize() * tip).normalize();
    ShadingPoint {
        p: p32,
        n: if random.below(8) == 0 || !n.is_finite() {
            [0.0; 3]
        } else {
            n.to_array().map(|x| x as f32)
        },
    }
}

fn importance<N: LightNode<2>>(instance: &Instance, local: &EmissiveTriangle, point: &ShadingPoint) -> f32 {
    let mut node = N::EMPTY;
    node.set_child(0, kind::LIGHT, 0);
    node.set_bounds(0, &LightBounds::of_triangle(local));
    Eq4::importance(&node.cluster(0), &instance.inside(point)).significand
}

/// Tests one triangle in one place; returns how many points could be lit.
fn check(random: &mut Random, exponent: i32) -> u32 {
    let local = local_triangle(random);
    let kind = if random.below(2) == 0 {
        Kind::Rigid
    } else {
        Kind::Similar
    };
    let transform = placing::transform(random, kind, pow2(exponent));
    let Some((instance, world)) = placed(&local, transform) else {
        return 0;
    };

    let bounds = instance.to_world(&LightBounds::of_triangle(&local));
    let own = Triangle::new(&world);
    for p in own.p {
        let (low, high) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
        assert!(
            low.cmple(p).all() && p.cmple(high).all(),
            "{world:?} reaches out of {bounds:?}"
        );
    }
    if own.normal != DVec3::ZERO && bounds.phi > 0.0 {
        let off = angle(bounds.axis.as_dvec3(), own.normal) - half_angle(bounds.cos_theta_o);
        assert!(
            bounds.cos_theta_o <= -1.0 || off <= 1e-12,
            "the normal of {world:?} is {off} rad out of {bounds:?}"
        );
    }
    let phi = LightBounds::of_triangle(&world).phi;
    assert!(
        (f64::from(bounds.phi) / f64::from(phi) - 1.0).abs() < 0.5 || phi == 0.0,
        "{} and {phi}",
        bounds.phi
    );

    let mut lit = 0;
    for _ in 0..40 {
        let point = point(random, &world);
        if can_contribute(&world, &point, MARGIN) {
            lit += 1;
            for found in [
                importance::<CompactNode<2>>(&instance, &local, &point),
                importance::<FullNode<2>>(&instance, &local, &point),
            ] {
                assert!(
                    found > 0.0,
                    "{world:?} has no importance at {point:?}: {instance:?}"
                );
            }
        }
    }
    lit
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_light_is_lost_on_the_way(seed: u32, exponent in 0..22) {
        check(&mut Random::new(seed), exponent);
    }
}

#[test]
fn the_points_are_hard_enough() {
    let random = &mut Random::new(1);
    let lit: u32 = (0..500).map(|i| check(random, i % 14)).sum();
    assert!(lit > 2000, "only {lit} of 20,000 points can be lit");
}

#[test]
fn an_instance_in_world_space_is_exact() {
    let random = &mut Random::new(2);
    for _ in 0..2000 {
        let instance = Instance::world(0, 0);
        let point = generate::point(random, 1e6);
        let bounds = LightBounds::of_triangle(&generate::extreme_triangle(random));
        if bounds.phi > 0.0 {
            assert_eq!(instance.to_world(&bounds), bounds);
        }
        let mut node = FullNode::<2>::EMPTY;
        node.set_child(0, kind::LIGHT, 0);
        node.set_bounds(0, &bounds);
        let (local, world) = (
            Eq4::importance(&node.cluster(0), &instance.inside(&point)),
            Eq4::importance(&node.cluster(0), &point),
        );
        assert_eq!(local, world);
    }
}
