//! What is noted of top levels.

use super::*;
use crate::bvh::RebuildParams;
use crate::kit::triangle;
use crate::{CompactNode, Edit, Transform};
use alloc::vec;

/// What a rebuild knows of its tree is what walking it finds.
#[test]
fn rebuilt_trees_are_noted_as_walked_ones() {
    let triangle = triangle([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let mut scene = Bvh::<CompactNode<4>, crate::Eq4, 4>::default();
    let triangles = vec![triangle];
    let mesh = scene
        .apply(vec![Edit::AddMesh { triangles }])
        .expect("a mesh")
        .meshes[0];
    for count in [0u16, 1, 2, 3, 50, 300] {
        let add = (0..count).map(|k| Edit::AddInstance {
            mesh,
            transform: Transform::at([f32::from(k * 37 % 97), f32::from(k % 7), f32::from(k)]),
            radiance: 1.0,
        });
        let added = scene.apply(add.collect()).expect("instances").instances;
        // Gaps among the indices.
        let gone = added
            .iter()
            .skip(1)
            .step_by(3)
            .map(|&id| Edit::RemoveInstance(id));
        scene.apply(gone.collect()).expect("they are there");
        scene.refit();
        let rebuilt = scene.rebuild(&RebuildParams::default()).run();
        scene.install(rebuilt).expect("its own");
        let (noted, instances) = (
            alloc::format!("{:?}{:?}", scene.top, scene.placed),
            scene.instances.clone(),
        );
        scene.index_top();
        assert!(
            noted == alloc::format!("{:?}{:?}", scene.top, scene.placed),
            "{count}"
        );
        assert_eq!(instances, scene.instances, "{count}");
        scene.refit();
        scene.validate().expect("valid");
    }
}
