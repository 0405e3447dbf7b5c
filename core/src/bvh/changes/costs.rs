//! Nothing is done, kept or built twice.

extern crate std;

use std::vec::Vec;

use crate::bvh::{Rebuild, RebuildParams};
use crate::kit::line;
use crate::{Edit, LightBvh, MeshId, Transform};

/// So many instances of a mesh of 200 triangles in a line.
fn lines(count: u16) -> (LightBvh, MeshId) {
    let mut bvh = LightBvh::default();
    let triangles = (0..200).map(|k| line(k, 1.0)).collect();
    let mesh = bvh.add_mesh(triangles).expect("a mesh");
    let all = (0..count).map(|k| Edit::AddInstance {
        mesh,
        transform: Transform::at([f32::from(k % 32), f32::from(k / 32), 0.0]),
        radiance: 1.0,
    });
    bvh.apply(all.collect()).expect("instances");
    bvh.refit();
    (bvh, mesh)
}

fn scramble(bvh: &mut LightBvh, mesh: MeshId) {
    let triangles = (0..200).map(|k| line(k * 77 % 200, 10.0));
    bvh.set_triangles(mesh, triangles.collect()).expect("as many");
    bvh.refit();
}

/// As many instances as there are, so that the top level is built anew.
fn as_many(bvh: &LightBvh, mesh: MeshId) -> Vec<Edit> {
    let add = |k: usize| Edit::AddInstance {
        mesh,
        transform: Transform::at([k as f32, 50.0, 0.0]),
        radiance: 1.0,
    };
    (0..bvh.live.len()).map(add).collect()
}

const TOP: RebuildParams = RebuildParams {
    top: 1.0,
    drift: f64::INFINITY,
};

fn of_meshes(drift: f64) -> RebuildParams {
    RebuildParams {
        top: f64::INFINITY,
        drift,
    }
}

#[test]
fn a_refit_after_a_plan_does_not_what_was_refitted() {
    let (mut bvh, _) = lines(1000);
    bvh.plan();
    let [one, other] = [3, 700].map(|index| bvh.instance_id(index).expect("there"));
    bvh.set_radiance(one, 2.0).expect("its own");
    bvh.refit();
    let own = bvh.work().top.nodes().len();
    bvh.set_radiance(other, 2.0).expect("its own");
    let told = bvh.plan().top.nodes().len();
    bvh.refit();
    assert!(own > 0 && bvh.work().top.nodes().len() < told);
    bvh.validate().expect("valid");
}

#[test]
fn what_no_plan_asks_for_is_not_kept() {
    let (mut bvh, _) = lines(10);
    let one = bvh.instance_id(3).expect("there");
    bvh.set_radiance(one, 2.0).expect("its own");
    bvh.refit();
    let plan = bvh.plan();
    assert!(plan.computed() == 0 && plan.written_instances.is_empty());
}

#[test]
fn installed_rebuilds_take_bounded_room() {
    let (mut bvh, _) = lines(1000);
    let mut most = 0;
    for _ in 0..300 {
        let rebuild: Rebuild<_, 8> = bvh.rebuild(&TOP);
        bvh.install(rebuild.run()).expect("its own");
        most = most.max(bvh.changes.new.len());
    }
    // Three times the instances and what is never too many, and what one writes beyond.
    assert!((1000..3 * 1000 + 8192 + 1500).contains(&most), "{most}");
}

/// The list of instances is in another order once one has gone.
#[test]
fn a_top_level_built_by_an_edit_is_that_of_a_rebuild() {
    let (mut bvh, mesh) = lines(1000);
    for k in [700, 10, 300] {
        let id = bvh.instance_id(k).expect("there");
        bvh.remove_instance(id).expect("its own");
    }
    bvh.refit();
    bvh.apply(as_many(&bvh, mesh)).expect("instances");
    assert!(bvh.changes.new.whole_top);
    bvh.refit();
    let before = bvh.instances().to_vec();
    let rebuild: Rebuild<_, 8> = bvh.rebuild(&TOP);
    bvh.install(rebuild.run()).expect("its own");
    assert!(before == bvh.instances());
}

#[test]
fn meshes_are_built_anew_by_their_own_cost() {
    let (mut bvh, mesh) = lines(2);
    let is_due = |bvh: &LightBvh, drift| !bvh.rebuild(&of_meshes(drift)).is_empty();
    assert!(!is_due(&bvh, 0.0), "as it was built");
    scramble(&mut bvh, mesh);
    assert!(is_due(&bvh, 1.5) && !is_due(&bvh, 1e30));
    let now = bvh.now();
    assert!(bvh.rebuild_since(&of_meshes(0.0), Some(now)).is_empty(), "seen");
    let rebuild: Rebuild<_, 8> = bvh.rebuild(&of_meshes(1.5));
    bvh.install(rebuild.run()).expect("its own");
    bvh.refit();
    assert!(!is_due(&bvh, 0.0), "as it was built");
    // What was seen of another says nothing of this one.
    let (mut other, mesh) = lines(1);
    scramble(&mut other, mesh);
    assert!(!other.rebuild_since(&of_meshes(1.5), Some(now)).is_empty());
}

/// Nodes of an instance that was just added are right before the next refit, as far as its own mesh and those above go.
#[test]
fn added_instances_shine_before_the_next_refit() {
    let (mut bvh, mesh) = lines(2);
    bvh.add_instance(mesh, Transform::at([0.0, 500.0, 0.0]))
        .expect("one more");
    let before = bvh.summary();
    bvh.refit();
    assert_eq!(before, bvh.summary());
}
