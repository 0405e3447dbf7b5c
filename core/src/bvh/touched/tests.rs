//! Triangles that change without the rest of their mesh.

extern crate std;

use std::vec::Vec;

use crate::bvh::EditReason;
use crate::exact::pow2;
use crate::kit::line;
use crate::{BuildParams, Bvh, Edit, LightNode, MeshId, MomentNode, Moments, Transform};

type Own = Bvh<MomentNode<8>, Moments, 8>;

/// A mesh of `count` triangles below two instances, refitted.
fn mesh<N: LightNode<8>, I>(count: u32) -> (Bvh<N, I, 8>, MeshId) {
    // Left whole: parts have roots of their own.
    let mut bvh = Bvh::new(BuildParams {
        opens: false,
        ..BuildParams::default()
    });
    let triangles = (0..count).map(|k| line((k * 77 % count) as u16, 1.0)).collect();
    let mesh = bvh.add_mesh(triangles).expect("a mesh");
    for x in [0.0, 9.0] {
        bvh.add_instance(mesh, Transform::at([x, 0.0, 0.0])).expect("one");
    }
    bvh.refit();
    (bvh, mesh)
}

fn words(bvh: &Own) -> (&[u32], &[u32]) {
    (
        bytemuck::cast_slice(bvh.nodes()),
        bytemuck::cast_slice(bvh.roots()),
    )
}

/// Its path alone is computed, its words alone are told, and both are those of a mesh given anew.
#[test]
fn a_triangle_costs_its_path() {
    for count in [1_u32, 9, 100, 1000, 10_000] {
        let (mut bvh, mesh) = mesh::<MomentNode<8>, Moments>(count);
        let mut whole = bvh.clone();
        bvh.plan();
        for first in [0, count / 3, count - 1] {
            let new = line(first as u16 + 3, 2.0);
            bvh.set_triangle_range(mesh, first, std::vec![new])
                .expect("its own");
            let mut all = whole
                .mesh_triangles(whole.mesh_id(0).expect("there"))
                .expect("there")
                .to_vec();
            all[first as usize] = new;
            whole
                .set_triangles(whole.mesh_id(0).expect("there"), all)
                .expect("as many");
            whole.refit();
            let plan = bvh.plan().clone();
            assert!(plan.written_triangles.iter().eq([&(first..first + 1)]));
            assert_eq!(plan.roots, [0]);
            let depth = bvh.blases[0].depth as usize;
            if count > 16 {
                assert!(plan.trees.is_empty() && plan.parts == plan.bottom);
                assert!(
                    plan.bottom.nodes().len() <= depth,
                    "{count}: {}",
                    plan.bottom.nodes().len()
                );
            }
            bvh.refit();
            assert!(words(&bvh) == words(&whole), "{count} {first}");
            bvh.validate().expect("valid");
        }
    }
}

#[test]
fn many_triangles_are_swept() {
    let (mut bvh, mesh) = mesh::<MomentNode<8>, Moments>(1600);
    for (count, is_swept) in [(100, false), (101, true)] {
        let new = (0..count).map(|k| line(k, 2.0)).collect();
        bvh.set_triangle_range(mesh, 800, new).expect("its own");
        let plan = bvh.plan();
        assert_eq!(plan.trees.is_empty(), !is_swept);
        assert_eq!(plan.parts.nodes().is_empty(), is_swept);
        bvh.refit();
        bvh.validate().expect("valid");
    }
    // What changed as a whole is not computed in part too, and none is nothing.
    let all = (0..1600).map(|k| line(k, 1.0)).collect();
    bvh.set_triangle_range(mesh, 3, std::vec![line(9, 2.0)])
        .expect("its own");
    bvh.set_triangles(mesh, all).expect("as many");
    bvh.set_triangle_range(mesh, 1600, Vec::new()).expect("none");
    let plan = bvh.plan();
    assert!(plan.parts.nodes().is_empty() && plan.trees.len() == 1);
    bvh.refit();
    bvh.validate().expect("valid");
    bvh.set_triangle_range(mesh, 1600, Vec::new()).expect("none");
    assert_eq!(bvh.plan().computed(), 0);
}

/// No trail leads to a triangle there, so all of the mesh is computed.
#[test]
fn without_trails_the_words_are_the_same() {
    let (mut bvh, mesh) = mesh::<MomentNode<8>, Moments>(1000);
    let mut bare = bvh.clone().without_trails();
    let same = bare.mesh_id(0).expect("there");
    bvh.set_triangle_range(mesh, 7, std::vec![line(70, 3.0)])
        .expect("its own");
    bare.set_triangle_range(same, 7, std::vec![line(70, 3.0)])
        .expect("its own");
    bvh.refit();
    bare.refit();
    assert!(bytemuck::cast_slice::<_, u32>(bvh.nodes()) == bytemuck::cast_slice::<_, u32>(bare.nodes()));
}

/// Those of a mesh that is no more, and whose place another has by now.
#[test]
fn what_is_gone_is_not_computed() {
    let (mut bvh, mesh) = mesh::<MomentNode<8>, Moments>(300);
    let second = bvh
        .add_mesh((0..300).map(|k| line(k, 1.0)).collect())
        .expect("a mesh");
    bvh.refit();
    bvh.set_triangle_range(second, 7, std::vec![line(70, 3.0)])
        .expect("its own");
    bvh.remove_mesh(second).expect("unused");
    let third = bvh
        .add_mesh((0..40).map(|k| line(k, 1.0)).collect())
        .expect("a mesh");
    bvh.set_triangle_range(mesh, 299, std::vec![line(70, 3.0)])
        .expect("its own");
    bvh.set_triangle_range(third, 0, std::vec![line(71, 3.0)])
        .expect("its own");
    bvh.refit();
    assert!(bvh.work().bottom.nodes().len() <= 10);
    bvh.validate().expect("valid");
}

#[test]
fn ranges_beyond_the_mesh_are_refused() {
    let (mut bvh, mesh) = mesh::<MomentNode<8>, Moments>(20);
    for (first, count) in [(20, 1), (0, 21), (19, 2), (u32::MAX, 1), (21, 0)] {
        let triangles = std::vec![line(0, 1.0); count];
        let reason = EditReason::Range {
            first,
            count,
            triangles: 20,
        };
        assert_eq!(bvh.set_triangle_range(mesh, first, triangles), Err(reason));
    }
    let mut wrong = line(0, 1.0);
    wrong.p[1][2] = f32::NAN;
    let error = bvh.set_triangle_range(mesh, 3, std::vec![line(0, 1.0), wrong]);
    assert!(
        matches!(error, Err(EditReason::Light { index: 1, .. })),
        "{error:?}"
    );
    assert!(bvh.changes.new.is_empty());
}

/// A triangle that reached far and is back hinders no instance, whatever else the batch does.
#[test]
fn extents_are_looked_up_where_they_matter() {
    let (mut bvh, mesh) = mesh::<MomentNode<8>, Moments>(100);
    let user = bvh.instance_id(0).expect("there");
    let far = |e: i32| {
        let mut one = line(0, 1.0);
        one.p[0][0] = pow2(e);
        std::vec![one]
    };
    let place = |instance, e: i32| Edit::SetTransform {
        instance,
        transform: Transform::at([pow2(e), 0.0, 0.0]),
    };
    // Beyond 2^40 m, all told, for the one that is at 2^39 m.
    bvh.apply(std::vec![place(user, 39)]).expect("within");
    let error = bvh.set_triangle_range(mesh, 5, far(40));
    assert!(matches!(error, Err(EditReason::Transform(_))), "{error:?}");
    bvh.set_triangle_range(mesh, 5, far(38)).expect("within");
    let extent = bvh.blases[0].extent;
    assert!(extent.is_exact && extent.coordinate == f64::from(pow2(38)));
    bvh.set_triangle_range(mesh, 6, far(37)).expect("within");
    assert!(bvh.blases[0].extent.is_exact, "the farthest is as it was");
    bvh.set_triangle_range(mesh, 5, std::vec![line(3, 1.0)])
        .expect("its own");
    bvh.set_triangle_range(mesh, 6, std::vec![line(4, 1.0)])
        .expect("its own");
    let extent = bvh.blases[0].extent;
    assert!(!extent.is_exact && extent.coordinate == f64::from(pow2(38)));
    let mut nearly = Transform::at([pow2(39), 0.0, 0.0]);
    nearly.columns[0][0] = 2.0;
    nearly.translation[0] = pow2(40) - pow2(39);
    bvh.set_transform(user, nearly).expect("within by what is known");
    nearly.translation[0] = pow2(40) - pow2(20);
    bvh.set_transform(user, nearly).expect("within by what is there");
    let error = bvh.set_triangle_range(mesh, 6, far(30));
    assert!(matches!(error, Err(EditReason::Transform(_))), "{error:?}");
    // Within one batch: there, back, and an instance that is right then alone.
    let mut batch = Vec::new();
    for (first, triangles) in [(7, far(19)), (7, std::vec![line(3, 1.0)])] {
        batch.push(Edit::SetTriangleRange {
            mesh,
            first,
            triangles,
        });
    }
    nearly.translation[0] = pow2(40) - pow2(18);
    let instance = user;
    batch.push(Edit::SetTransform {
        instance,
        transform: nearly,
    });
    bvh.apply(batch.clone()).expect("within");
    batch.swap(1, 2);
    bvh.apply(batch).expect_err("not yet");
    bvh.refit();
    bvh.validate().expect("valid");
    // Meshes that stay know it exactly.
    let mut still = bvh.into_static_meshes();
    nearly.translation[0] = pow2(40) - pow2(17);
    still
        .apply(std::vec![Edit::SetTransform {
            instance,
            transform: nearly
        }])
        .expect("within");
}
