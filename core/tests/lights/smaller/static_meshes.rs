//! Instances of meshes that stay: the same words frame after frame, without the triangles.

use lightbvh::bvh::{EditReason, Swap};
use lightbvh::exact::hash;
use lightbvh::{
    BuildParams, Bvh, Defensive, Edit, InstanceId, MeshId, MomentNode, Moments, Rebuilder, RebuilderParams,
};

use super::scenes::{mesh, points, scene, transform};
use crate::kit::Random;

type Default8 = Bvh<MomentNode<8>, Defensive<Moments, 6>, 8>;

/// Swaps that do not depend on how fast a thread is.
const PARAMS: RebuilderParams = RebuilderParams {
    after: 1,
    swap: Swap::Deterministic,
    idle: 0.0,
    bytes: 1 << 19,
};

fn whole(seed: u32) -> Default8 {
    scene(seed, seed % 2, BuildParams::BALANCED)
}

/// The first mesh, which each scene has.
fn first_mesh(bvh: &Default8) -> MeshId {
    bvh.mesh_id(0).expect("the first mesh")
}

/// Every instance.
fn ids(bvh: &Default8) -> Vec<InstanceId> {
    let all = 0..bvh.instances().len() as u32;
    all.filter_map(|index| bvh.instance_id(index)).collect()
}

/// What may happen to instances in a frame, by the ids of two light BVHs.
fn edits(random: &mut Random, ids: &mut Vec<[InstanceId; 2]>, meshes: [MeshId; 2]) -> [Vec<Edit>; 2] {
    let mut edits = [Vec::new(), Vec::new()];
    for pair in &*ids {
        let (what, transform) = (random.below(4), transform(random, 1.0));
        let radiance = [0.0, 0.5, 3.0][random.below(3) as usize];
        for (own, &instance) in edits.iter_mut().zip(pair) {
            match what {
                0 => own.push(Edit::SetTransform { instance, transform }),
                1 => own.push(Edit::SetRadiance { instance, radiance }),
                _ => {}
            }
        }
    }
    if ids.len() > 1 && random.below(3) == 0 {
        let pair = ids.swap_remove(random.below(ids.len() as u32) as usize);
        let removed = pair.map(Edit::RemoveInstance);
        edits
            .iter_mut()
            .zip(removed)
            .for_each(|(own, edit)| own.push(edit));
    }
    if random.below(3) == 0 {
        let transform = transform(random, 1.0);
        for (own, mesh) in edits.iter_mut().zip(meshes) {
            own.push(Edit::AddInstance {
                mesh,
                transform,
                radiance: 1.0,
            });
        }
    }
    edits
}

#[test]
fn frames_are_those_of_the_whole() {
    let mut swapped = 0;
    for seed in 0..20 {
        let random = &mut Random(seed * 77);
        let mut whole = whole(seed);
        // The ids of a clone are its own.
        let copy = whole.clone();
        let meshes = [first_mesh(&whole), first_mesh(&copy)];
        let mut pairs: Vec<_> = ids(&whole)
            .into_iter()
            .zip(ids(&copy))
            .map(|(a, b)| [a, b])
            .collect();
        let mut less = copy.into_static_meshes();
        assert!(less.memory() + 56 * whole.triangles().len() <= whole.memory());
        assert_eq!(less.bytes(), whole.bytes());
        let [mut of_whole, mut of_less]: [Rebuilder; 2] = [0; 2].map(|_| Rebuilder::new(PARAMS));
        for frame in 0..6 {
            assert_eq!(whole.take_removed_lights(), less.take_removed_lights());
            let swaps = of_whole.begin_frame(&mut whole).expect("a frame").swapped;
            assert_eq!(less.begin_frame(&mut of_less).expect("a frame").swapped, swaps);
            swapped += usize::from(swaps);
            let [of_one, of_other] = edits(random, &mut pairs, meshes);
            let added = whole.apply(of_one).expect("edits of instances").instances;
            let as_well = less.apply(of_other).expect("edits of instances").instances;
            pairs.extend(added.into_iter().zip(as_well).map(|(a, b)| [a, b]));
            whole.refit();
            less.refit();
            of_whole.end_frame(&whole);
            less.end_frame(&mut of_less);
            assert!(whole.nodes() == less.tree().nodes, "{seed}, {frame}");
            assert!(whole.top_nodes() == less.tree().top, "{seed}, {frame}");
            assert_eq!(whole.instances(), less.tree().instances, "{seed}, {frame}");
            for point in points(seed + frame, &whole.world_lights()) {
                let number = hash(random.below(1 << 24));
                let sampled = less.sample(&point, number);
                assert_eq!(whole.sample(&point, number), sampled);
                let pmf = less.pmf(&point, sampled.light, sampled.instance);
                assert_eq!(pmf.to_bits(), sampled.pmf.to_bits());
            }
        }
        for [id, as_well] in pairs {
            assert_eq!(whole.lights_of(id), less.lights_of(as_well));
        }
    }
    assert!(swapped > 20, "{swapped}");
}

#[test]
fn edits_of_meshes_are_refused_whole() {
    let bvh = whole(3);
    let (own, ids) = (first_mesh(&bvh), ids(&bvh));
    let triangles = bvh.mesh_triangles(own).expect("the first mesh").to_vec();
    let mut less = bvh.into_static_meshes();
    let before = less.tree().instances.to_vec();
    let first = Edit::SetRadiance {
        instance: ids[0],
        radiance: 7.0,
    };
    for refused in [
        Edit::AddMesh {
            triangles: triangles.clone(),
        },
        Edit::SetTriangles { mesh: own, triangles },
    ] {
        let error = less
            .apply(vec![first.clone(), refused])
            .expect_err("no triangles");
        assert_eq!((error.edit, error.reason), (1, EditReason::StaticMeshes));
    }
    assert_eq!(less.tree().instances, before);
    // A mesh may go.
    let mut lone = Default8::default();
    let gone = lone
        .add_mesh(mesh(&mut Random(1), 1.0, 9, 0))
        .expect("within the domain");
    let mut lone = lone.into_static_meshes();
    lone.apply(vec![Edit::RemoveMesh(gone)])
        .expect("no instance has it");
    lone.refit();
}

/// A mesh's tree is being built when its triangles are dropped; also a mesh that has changed since the build began.
#[test]
fn builds_under_way_end_without_triangles() {
    let mut swapped = [0; 2];
    for seed in 0..20 {
        let mut bvh = whole(seed);
        let own = first_mesh(&bvh);
        let mut triangles = bvh.mesh_triangles(own).expect("the first mesh").to_vec();
        let mut rebuilder = Rebuilder::new(PARAMS);
        // The top level is built first.
        for _ in 0..2 {
            rebuilder.begin_frame(&mut bvh).expect("a frame");
            triangles.reverse();
            bvh.set_triangles(own, triangles.clone()).expect("as many");
            bvh.refit();
            rebuilder.end_frame(&bvh);
        }
        let is_changed = seed % 2 == 0;
        if is_changed {
            triangles.reverse();
            bvh.set_triangles(own, triangles).expect("as many");
            bvh.refit();
        }
        let world = bvh.world_lights();
        let point = points(seed, &world)[0];
        let all = (0..).zip(&world);
        let shining: Vec<_> = all
            .map(|(light, own)| (light, own.mesh))
            .filter(|&(light, instance)| bvh.pmf(&point, light, instance) > 0.0)
            .collect();
        let mut less = bvh.into_static_meshes();
        for _ in 0..4 {
            let start = less.begin_frame(&mut rebuilder).expect("a frame");
            swapped[usize::from(is_changed)] += start.meshes;
            less.refit();
            less.end_frame(&mut rebuilder);
            let mut again = less.clone();
            again.rebuild();
            for bvh in [&less, &again] {
                let pmfs = shining
                    .iter()
                    .map(|&(light, instance)| bvh.pmf(&point, light, instance));
                assert!(pmfs.clone().all(|pmf| pmf > 0.0), "{seed}");
                let sum: f64 = pmfs.map(f64::from).sum();
                assert!(shining.is_empty() || (sum - 1.0).abs() < 1e-6, "{seed}: {sum}");
            }
        }
    }
    assert!(swapped[0] > 0, "{swapped:?}");
}
