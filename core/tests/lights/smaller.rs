//! Models with less in them say the same: two-sided moments.

use bytemuck::cast_slice;
use lightbvh::exact::{self, hash, pow2};
use lightbvh::{
    BuildParams, Bvh, Defensive, Edit, EmissiveTriangle, InstanceId, LightNode, MomentNode, Moments, Node,
    ShadingPoint, Transform, TwoSidedMomentNode,
};

use crate::kit::Random;

type D = Defensive<Moments, 6>;

/// Triangles of sizes and fluxes far apart, some without area or radiance, in a cube of 2 `size`; `flags` as given.
fn mesh(random: &mut Random, size: f32, count: u32, flags: u32) -> Vec<EmissiveTriangle> {
    let triangle = |_| {
        let at = random.within(size);
        let edge = size * pow2(-(random.below(20) as i32));
        let vertex = |random: &mut Random| {
            let away = random.within(edge);
            [0, 1, 2].map(|k| at[k] + away[k])
        };
        let b = vertex(random);
        let c = if random.below(12) == 0 { b } else { vertex(random) };
        let radiance = match random.below(8) {
            0 => 0.0,
            _ => pow2(random.below(70) as i32 - 35),
        };
        // So thin that no normal is known of it: as good as two-sided.
        let needle = flags != 0 && random.below(10) == 0;
        EmissiveTriangle {
            p: if needle { thin(edge) } else { [at, b, c] },
            radiance: [radiance; 3],
            mesh: 0,
            flags: if needle { 0 } else { flags },
        }
    };
    (0..count).map(triangle).collect()
}

/// A cross product of 2^-70 of the longer edge squared.
fn thin(edge: f32) -> [[f32; 3]; 3] {
    [[0.0; 3], [edge, 0.0, 0.0], [0.0, edge * pow2(-70), 0.0]]
}

fn transform(random: &mut Random, size: f32) -> Transform {
    let columns = match random.below(3) {
        0 => Transform::IDENTITY.columns,
        // Any map, flat ones too.
        1 => [0; 3].map(|_| random.within(2.0)),
        _ => [random.within(1.0), [0.0; 3], random.within(1.0)],
    };
    Transform {
        columns,
        translation: random.within(4.0 * size),
    }
}

/// The same meshes, instances and moves in any light BVH.
fn scene<N: LightNode<W>, I, const W: usize>(seed: u32, flags: u32, params: BuildParams) -> Bvh<N, I, W> {
    let random = &mut Random(seed.wrapping_mul(7919));
    let size = pow2(random.below(60) as i32 - 30);
    let mut bvh = Bvh::new(params);
    let mut instances: Vec<InstanceId> = Vec::new();
    for _ in 0..1 + random.below(3) {
        let count = 1 + random.below(60);
        let own = bvh
            .add_mesh(mesh(random, size, count, flags))
            .expect("within the domain");
        for _ in 0..1 + random.below(4) {
            let edit = Edit::AddInstance {
                mesh: own,
                transform: transform(random, size),
                radiance: [[1.0, 0.25, 0.0][random.below(3) as usize]; 3],
                mask: u32::MAX,
            };
            instances.extend(bvh.apply(vec![edit]).expect("an instance").instances);
        }
    }
    bvh.refit();
    // Refits, and a top level that edits have patched.
    for id in instances {
        if random.below(3) == 0 {
            bvh.set_transform(id, transform(random, size))
                .expect("within the domain");
        }
    }
    bvh.refit();
    bvh
}

fn points(seed: u32, lights: &[EmissiveTriangle]) -> Vec<ShadingPoint> {
    let random = &mut Random(seed.wrapping_mul(104_729));
    let point = |_| {
        let near = lights[random.below(lights.len() as u32) as usize].p[0];
        let size = near.into_iter().map(exact::abs).fold(pow2(-30), exact::max);
        let away = random.within(size);
        let mut point = random.point(0.0);
        point.p = [0, 1, 2].map(|k| near[k] + away[k]);
        point.checked().expect("a shading point")
    };
    (0..24).map(point).collect()
}

/// Every word but those of the row of normals, of which one constant is known; every pmf, every sample.
fn equal_words<const W: usize>(seed: u32, params: BuildParams) {
    let full = scene::<MomentNode<W>, D, W>(seed, EmissiveTriangle::TWO_SIDED, params);
    let less = scene::<TwoSidedMomentNode<W>, D, W>(seed, EmissiveTriangle::TWO_SIDED, params);
    assert_eq!(full.nodes().len(), less.nodes().len());
    assert_eq!(full.top_nodes().len(), less.top_nodes().len());
    let of_full = full.nodes().iter().chain(full.top_nodes());
    for (full, less) in of_full.zip(less.nodes().iter().chain(less.top_nodes())) {
        let a: &[u32] = cast_slice(std::slice::from_ref(full));
        let b: &[u32] = cast_slice(std::slice::from_ref(less));
        assert_eq!((a.len(), b.len()), (6 * W, 5 * W));
        assert_eq!(a[..3 * W], b[..3 * W]);
        assert_eq!(a[4 * W..], b[3 * W..]);
        for (slot, &normal) in a[3 * W..4 * W].iter().enumerate() {
            let shines = full.summary(slot).phi > 0.0;
            assert_eq!(normal, if shines { !0 } else { 0 }, "{seed}, slot {slot}");
            if shines {
                assert_eq!(full.summary(slot), less.summary(slot));
            }
        }
    }
    assert_eq!(full.instances(), less.instances());
    let roots = |words: &[lightbvh::refit::BlasRoot]| cast_slice::<_, u32>(words).to_vec();
    assert_eq!(roots(full.roots()), roots(less.roots()));
    less.validate()
        .unwrap_or_else(|violation| panic!("{seed}: {violation}"));
    let world = full.world_lights();
    for (k, point) in (0..).zip(points(seed, &world)) {
        for (light, triangle) in (0..).zip(&world) {
            let a = full.pmf(&point, light, triangle.mesh);
            let b = less.pmf(&point, light, triangle.mesh);
            assert_eq!(
                a.to_bits(),
                b.to_bits(),
                "{seed}, {point:?}, light {light}: {a:e} and {b:e}"
            );
        }
        for number in 0..20_u32 {
            let number = hash(seed ^ hash(1000 * k + number));
            assert_eq!(full.sample(&point, number), less.sample(&point, number));
        }
    }
}

#[test]
fn two_sided_moments_have_the_bits_of_moments() {
    for seed in 0..60 {
        let params = BuildParams::BALANCED;
        equal_words::<8>(seed, params);
        equal_words::<4>(seed + 1000, params);
        equal_words::<16>(seed + 2000, params);
    }
}

/// Lights that shine from one side lose nothing but variance.
#[test]
fn two_sided_moments_lose_no_light() {
    for seed in 0..20 {
        let bvh = scene::<TwoSidedMomentNode<8>, Moments, 8>(seed, 0, BuildParams::BALANCED);
        bvh.validate()
            .unwrap_or_else(|violation| panic!("{seed}: {violation}"));
        let world = bvh.world_lights();
        for point in points(seed, &world) {
            let mut sum = 0.0;
            for (light, triangle) in (0..).zip(&world) {
                let pmf = bvh.pmf(&point, light, triangle.mesh);
                let shines = lightbvh::LightBounds::of_triangle(triangle).phi > 0.0;
                // World triangles round away area; what a mesh has of it, its tree holds.
                assert!(pmf > 0.0 || !shines, "{seed}, {point:?}, light {light}");
                sum += f64::from(pmf);
            }
            let dark = bvh.summary().phi == 0.0;
            assert!((sum - f64::from(u8::from(!dark))).abs() < 1e-6, "{seed}: {sum}");
        }
    }
}
