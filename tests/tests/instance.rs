//! Instances under any affine map: bounds in the world, and points in the mesh's space. Normals and cones are in core's own tests;
//! that no light is lost is the fuzz target `edits`.

use glam::DMat3;
use lightbvh::exact::pow2;
use lightbvh::light::Light;
use lightbvh::{Bvh, CompactNode, Instance, LightBounds, ShadingPoint, Summary, Transform};
use lightbvh_tests::generate::{self, Random};
use lightbvh_tests::oracle::vector;
use lightbvh_tests::placing::{self, Kind};

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
    let triangles = generate::small_triangles(1, 1, 1.0, 0.1, false, 1);
    let mesh = scene.add_mesh(triangles).expect("a mesh");
    let id = scene.add_instance(mesh, transform).expect("within the domain");
    scene.instances()[id.index() as usize]
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

/// Bounds in the world hold what is there, within the rounding of the map, and under a similarity the flux is that of the lights there.
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
        let world = local.in_world(&instance, 0);
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
