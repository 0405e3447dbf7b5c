//! Instances under any affine map: lights and bounds in the world, points in the mesh's space, and no light that is ever lost.

use glam::{DMat3, DVec3};
use lightbvh::exact::pow2;
use lightbvh::light::MAX_COORDINATE;
use lightbvh::{
    Bvh, CompactNode, Edit, EmissiveTriangle, ImportanceModel, Instance, LightBounds, LightNode,
    ShadingPoint, Summary, Transform,
};
use lightbvh_tests::each_layout;
use lightbvh_tests::edits::{add_instance, add_mesh};
use lightbvh_tests::generate::{self, Random, extreme_triangle};
use lightbvh_tests::oracle::{angle, assert_mapped, assert_sum_is_one, half_angle, vector};
use lightbvh_tests::placing::{self, Kind};
use proptest::prelude::*;

/// A map of `kind`, scaled by up to 2^±`exponent`.
fn map(random: &mut Random, kind: Kind, exponent: i32) -> Transform {
    let mut transform = placing::transform(random, kind, pow2(exponent));
    let scale = pow2(random.below(2 * exponent as u32 + 1) as i32 - exponent);
    transform.columns = transform.columns.map(|column| column.map(|x| x * scale));
    transform
}

/// The words of an instance, as a scene makes them.
fn placed(transform: Transform) -> Instance {
    let mut scene = Bvh::<CompactNode<2>, (), 2>::default();
    let mesh = add_mesh(&mut scene, generate::small_triangles(1, 1, 1.0, 0.1, false, 1));
    let id = add_instance(&mut scene, mesh, transform);
    scene.instances()[id.index() as usize]
}

/// Some lights as a mesh: extremes of the domain as far as the map leaves them in it, or small ones about the origin.
fn triangles(random: &mut Random) -> Vec<EmissiveTriangle> {
    let count = 1 + random.below(8);
    let mut triangles: Vec<_> = (0..count)
        .map(|_| {
            let mut triangle = extreme_triangle(random);
            let reach = triangle
                .p
                .as_flattened()
                .iter()
                .fold(0.0f32, |most, x| most.max(x.abs()));
            let scale = if reach > 256.0 { 256.0 / reach } else { 1.0 };
            triangle.p = triangle.p.map(|p| p.map(|x| x * scale));
            triangle.checked().expect("smaller")
        })
        .collect();
    if random.below(2) == 0 {
        triangles = generate::small_triangles(count, 4, 2.0, 0.5, true, random.bits());
    }
    triangles
}

/// Any point: about a light, somewhere, at the end of the domain, with a normal or in a volume.
fn point(random: &mut Random, lights: &[EmissiveTriangle]) -> ShadingPoint {
    let near = lights[random.below(lights.len() as u32) as usize].p[random.below(3) as usize];
    let by = random.direction();
    let distance = match random.below(4) {
        0 => 0.0,
        1 => generate::log_uniform(random, -100, -20),
        2 => generate::log_uniform(random, -20, 20),
        _ => generate::log_uniform(random, 20, 39),
    };
    let p = std::array::from_fn(|k| (near[k] + by[k] * distance).clamp(-MAX_COORDINATE, MAX_COORDINATE));
    let n = if random.below(4) == 0 {
        [0.0; 3]
    } else {
        random.direction()
    };
    ShadingPoint { p, n }.checked().expect("within the domain")
}

/// A light of an instance has a probability at any point wherever its triangle shines in the mesh and it is not turned off.
fn no_light_is_lost<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(seed: u32, kind: Kind) {
    let random = &mut Random::new(seed);
    let mut scene = Bvh::<N, (), W>::default();
    let mut expected = Vec::new();
    for _ in 0..1 + random.below(3) {
        let local = triangles(random);
        let mesh = add_mesh(&mut scene, local.clone());
        for _ in 0..1 + random.below(3) {
            let exponent = random.below(20) as i32;
            let transform = map(random, kind, exponent);
            let radiance = [0.0, 1.0, pow2(60), pow2(-60)][random.below(4) as usize];
            let add = Edit::AddInstance {
                mesh,
                transform,
                radiance,
            };
            let id = scene.apply(vec![add]).expect("within the domain").instances[0];
            expected.push((id, local.clone(), transform, radiance));
        }
    }
    scene.refit();
    let stats = scene.validate().unwrap_or_else(|violation| panic!("{violation}"));
    let meshes = expected.iter().filter(|(id, ..)| id.index() == 0).count();
    assert!(stats.blases >= meshes as u32);
    let world = scene.world_lights();
    for _ in 0..8 {
        let point = point(random, &world);
        let mut pmfs = vec![0.0; scene.light_end() as usize];
        let mut any = false;
        for (id, local, transform, radiance) in &expected {
            let lights = scene.lights_of(*id).expect("it is there");
            for (light, local) in lights.zip(local) {
                let pmf = scene.by::<I>().pmf(&point, light, id.index());
                let shines = *radiance > 0.0 && N::Summary::of_triangle(local).phi() > 0.0;
                assert_eq!(
                    pmf > 0.0,
                    shines || I::UNIFORM_HALVINGS > 0,
                    "{} {W}: light {light}, {local:?} under {transform:?} at {point:?}",
                    N::NAME
                );
                assert_mapped(transform, local, &world[light as usize]);
                any |= shines;
                pmfs[light as usize] = pmf;
            }
        }
        if any {
            assert_sum_is_one::<N, I, W>(pmfs.iter().copied(), &point);
            for _ in 0..8 {
                let sampled = scene.by::<I>().sample(&point, random.bits());
                assert_eq!(sampled.pmf.to_bits(), pmfs[sampled.light as usize].to_bits());
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_light_is_lost_on_the_way(seed: u32, kind in 0..6usize) {
        each_layout!(no_light_is_lost(seed, Kind::ALL[kind]));
    }
}

fn matrix(columns: &[[f32; 3]; 3]) -> DMat3 {
    let [x, y, z] = columns.map(vector);
    DMat3::from_cols(x, y, z)
}

fn norm(m: &DMat3) -> f64 {
    m.to_cols_array().iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// What the map brings into the mesh's space it brings back: off by 2^-24 for each of about eight roundings, of what the maps make
/// of a distance at most.
#[test]
fn points_come_back() {
    let random = &mut Random::new(3);
    for i in 0..20_000 {
        let kind = [Kind::Rigid, Kind::Similar, Kind::Affine][i % 3];
        let transform = map(random, kind, 18);
        let instance = placed(transform);
        let p = random
            .direction()
            .map(|x| x * generate::log_uniform(random, -10, 20));
        let n = random.direction();
        let point = ShadingPoint { p, n };
        let local = instance.to_local(&point);
        let back = vector(instance.vertex(local.p));
        let (forward, inverse) = (matrix(&transform.columns), matrix(&instance.inverse));
        let away = (vector(p) - vector(transform.translation)).length();
        let size = norm(&forward) * norm(&inverse) * away
            + vector(p).length()
            + vector(transform.translation).length();
        let off = (back - vector(p)).length();
        assert!(
            off <= size * 2f64.powi(-21),
            "{off} of {size}: {transform:?} {p:?}"
        );

        // The horizon goes with the point: heights above it are those above the local one, times one factor.
        let normal = vector(local.n);
        assert!((normal.length() - 1.0).abs() < 1.0 / 256.0, "{local:?}");
        let height = |to: DVec3| vector(n).dot(forward * to);
        let factor = height(normal) / normal.length_squared();
        for _ in 0..4 {
            let to = vector(random.direction());
            let off = height(to) - factor * normal.dot(to);
            assert!(
                off.abs() <= norm(&forward) * 2f64.powi(-18),
                "{} and {}: {transform:?}",
                height(to),
                factor * normal.dot(to)
            );
        }
    }
}

/// A volume stays one, and a map that loses the normal makes one: its lights then count on both sides of the horizon.
#[test]
fn normals_that_are_lost() {
    let flat = Transform {
        columns: [[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
        translation: [0.0, 2.0, 0.0],
    };
    let up = ShadingPoint {
        p: [3.0, 4.0, 5.0],
        n: [0.0, 1.0, 0.0],
    };
    assert_eq!(placed(flat).to_local(&up).n, [0.0; 3]);
    let slanted = ShadingPoint {
        n: [0.6, 0.8, 0.0],
        ..up
    };
    let n = placed(flat).to_local(&slanted).n;
    assert!(
        (n[0] - 1.0).abs() < 1.0 / 256.0 && n[1] == 0.0 && n[2] == 0.0,
        "{n:?}"
    );
    let volume = ShadingPoint { n: [0.0; 3], ..up };
    for kind in Kind::ALL {
        assert_eq!(
            placed(map(&mut Random::new(4), kind, 5)).to_local(&volume).n,
            [0.0; 3]
        );
    }
}

/// Bounds in the world hold what is there, within the rounding of the map; a similarity turns the cone with the normals, and the
/// flux is that of the lights there.
#[test]
fn bounds_in_the_world() {
    let random = &mut Random::new(5);
    for i in 0..20_000 {
        let kind = Kind::ALL[i % 6];
        let transform = map(random, kind, 12);
        let instance = placed(transform);
        let local = generate::small_triangles(1, 1, 2.0, 0.5, random.below(4) == 0, random.bits())[0];
        let known = LightBounds::of_triangle(&local);
        let bounds = known.to_world::<lightbvh::EmissiveTriangle>(&instance);
        let world = instance.triangle(&local, 0);
        let entries = norm(&matrix(&transform.columns));
        let reach = entries * 8.0 + vector(transform.translation).length();
        let rounding = reach * 2f64.powi(-20) + 2f64.powi(-50);
        for p in world.p.map(vector) {
            let (low, high) = (bounds.min.as_dvec3() - rounding, bounds.max.as_dvec3() + rounding);
            assert!(
                low.cmple(p).all() && p.cmple(high).all(),
                "{world:?} reaches out of {bounds:?}"
            );
        }
        if matches!(kind, Kind::Rigid | Kind::Similar) {
            // Of the map in full: rounded vertices far from the origin say little of a small triangle.
            let [a, b, c] = local.p.map(vector);
            let forward = matrix(&transform.columns);
            let normal = (forward * (b - a)).cross(forward * (c - a));
            let normal = if instance.mirrored == 1 { -normal } else { normal };
            let off = angle(bounds.axis.as_dvec3(), normal) - half_angle(bounds.cos_theta_o);
            assert!(
                off <= 1e-3,
                "the normal of {world:?} is {off} rad out of {bounds:?}"
            );
            let area = 0.5 * normal.length();
            let ratio = area / (0.5 * (b - a).cross(c - a).length());
            let found = f64::from(bounds.phi) / f64::from(known.phi);
            assert!(
                (found / ratio - 1.0).abs() < 1e-5,
                "{found} of {ratio}: {transform:?}"
            );
        }
    }
}

/// The identity changes nothing but the last bits of a box.
#[test]
fn an_instance_in_world_space() {
    let random = &mut Random::new(2);
    for _ in 0..2000 {
        let point = generate::point(random, 1e6);
        let local = Instance::IDENTITY.to_local(&point);
        assert_eq!(local.p, point.p);
        let off = (vector(local.n) - vector(point.n)).length();
        assert!(off < 1.0 / 256.0, "{off}");
        let triangle = extreme_triangle(random);
        let bounds = LightBounds::of_triangle(&triangle);
        if bounds.phi > 0.0 {
            let world = bounds.to_world::<lightbvh::EmissiveTriangle>(&Instance::IDENTITY);
            assert_eq!((world.phi, world.cos_theta_o), (bounds.phi, bounds.cos_theta_o));
            let size = bounds.max.abs().max(bounds.min.abs()).max_element();
            let off = (world.max - bounds.max).abs().max((world.min - bounds.min).abs());
            assert!(
                off.max_element() <= size * pow2(-22) + pow2(-59),
                "{off:?} of {size}"
            );
        }
    }
}
