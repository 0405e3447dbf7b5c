//! Instances: summaries brought into the world, points brought into the mesh's space, and weights there.

use lightbvh::{
    Bvh, CompactNode, Defensive, Eq4, FluxOverDistance, ImportanceModel, Instance, LightBounds, LightMoments,
    LightNode, MomentNode, Moments, ShadingPoint, Summary, exact,
};
use lightbvh_tests::generate::{self, Random, extreme_triangle};

use super::digest::Digest;
use super::place;

/// Instances of every scale and brightness.
fn instances(random: &mut Random) -> Vec<Instance> {
    let mut scene = Bvh::<CompactNode<2>, (), 2>::default();
    let triangles = generate::small_triangles(3, 3, 1.0, 0.3, true, 1);
    let mesh = scene.add_mesh(triangles).expect("a mesh");
    for _ in 0..200 {
        let mut transform = place(random);
        let scale = exact::pow2(random.below(90) as i32 - 60);
        transform.columns = transform.columns.map(|column| column.map(|x| x * scale));
        scene.add_instance(mesh, transform).expect("an instance");
    }
    let mut instances = scene.instances().to_vec();
    for instance in &mut instances {
        instance.first = random.below(100);
        instance.first_triangle = random.below(100);
        instance.flux = generate::log_uniform(random, -100, 98);
        instance.radiance = [0.0, 1.0, 1e-3, 1e9][random.below(4) as usize];
    }
    instances
}

#[test]
fn instances_of_every_kind() {
    let mut random = Random::new(53);
    let mut digest = Digest::new();
    let instances = instances(&mut random);
    digest.words(&instances);
    for i in 0..4000 {
        let instance = instances[i as usize % instances.len()];
        let triangle = extreme_triangle(&mut random);
        let mut local = LightBounds::of_triangle(&triangle);
        if i % 2 == 0 {
            local.phi = generate::log_uniform(&mut random, -100, 125);
        }
        digest.summary(&local.to_world::<lightbvh::EmissiveTriangle>(&instance));
        digest
            .summary(&LightMoments::of_triangle(&triangle).to_world::<lightbvh::EmissiveTriangle>(&instance));
        let small = generate::small_triangles(1, 1, 2.0, 0.4, false, i)[0];
        digest.words(&[instance.triangle(&small, i)]);
        digest.words(&instance.vertex(triangle.p[0]));
        digest.word(instance.light_of(i));
        digest.word(instance.triangle_of(i));
        let reach = exact::pow2(random.below(60) as i32 - 20);
        let point = generate::point(&mut random, reach);
        digest.words(&[instance.to_local(&point), Instance::IDENTITY.to_local(&point)]);
    }
    digest.is(0x116b_af1a_b6b1_e78d, "instances");
}

/// Nodes of lights about as far from the point as they are from each other.
fn weights<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(known: u64) {
    let mut random = Random::new(59);
    let mut digest = Digest::new();
    for i in 0..3000 {
        let scale = exact::pow2(random.below(60) as i32 - 30);
        let triangles = generate::small_triangles(W as u32, 99, 4.0, 1.0, i % 2 == 0, i);
        let mut node = N::EMPTY;
        node.set_summaries(&std::array::from_fn(|slot| {
            let mut triangle = triangles[slot];
            triangle.p = triangle.p.map(|p| p.map(|x| x * scale));
            triangle.flags = u32::from(slot % 4 == 3);
            if i % 5 == 0 {
                triangle = extreme_triangle(&mut random);
            }
            N::Summary::of_triangle(&triangle)
        }));
        digest.words(&[node]);
        for _ in 0..4 {
            let size = 4.0 * scale * generate::log_uniform(&mut random, -4, 4);
            let point = generate::point(&mut random, 1.0);
            let point = ShadingPoint {
                p: point.p.map(|x| x * size),
                ..point
            };
            I::weights(&node, &point)
                .into_iter()
                .for_each(|weight| digest.float(weight));
        }
    }
    digest.is(known, &format!("weights on {} {W}", N::NAME));
}

#[test]
fn weights_of_every_model() {
    weights::<CompactNode<4>, Eq4, 4>(0x637b_baa9_4562_534f);
    weights::<CompactNode<4>, FluxOverDistance, 4>(0x532e_60ab_6d97_9a9e);
    weights::<MomentNode<8>, Moments, 8>(0x6f89_8493_2e4c_83b8);
    weights::<MomentNode<8>, Defensive<Moments, 6>, 8>(0x6f89_8493_2e4c_83b8);
}
