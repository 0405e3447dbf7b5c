//! What edits, plans and rebuilds in any order leave to be done: all that is needed, and no more than in proportion.

extern crate std;

use std::vec::Vec;

use crate::bvh::{EditReason, InstanceId, Rebuild, RebuildParams};
use crate::lights::MAX_LIGHTS;
use crate::{Edit, EmissiveTriangle, LightBvh, Transform};

fn lamp() -> EmissiveTriangle {
    EmissiveTriangle {
        p: [[0.0; 3], [0.5, 0.0, 0.0], [0.0, 0.0, 0.5]],
        radiance: [1.0; 3],
        mesh: 0,
        flags: 0,
    }
}

/// Lamps in a square, refitted, below a top level that was built.
fn lamps(count: u32) -> (LightBvh, Vec<InstanceId>) {
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(std::vec![lamp()]).expect("a mesh");
    let edits = (0..count).map(|i| Edit::AddInstance {
        mesh,
        transform: Transform::at([(i % 32) as f32, 0.0, (i / 32) as f32]),
        radiance: 1.0,
    });
    let ids = bvh.apply(edits.collect()).expect("lamps").instances;
    bvh.refit();
    (bvh, ids)
}

fn up(instance: InstanceId, y: f32) -> Edit {
    Edit::SetTransform {
        instance,
        transform: Transform::at([0.0, y, 0.0]),
    }
}

#[test]
fn an_older_rebuild_costs_what_changed_since() {
    let (mut bvh, ids) = lamps(1000);
    let rebuild: Rebuild<_, 8> = bvh.rebuild(&RebuildParams::eager());
    bvh.set_transform(ids[17], Transform::at([0.0, 9.0, 0.0]))
        .expect("there");
    bvh.set_radiance(ids[400], 0.5).expect("there");
    bvh.refit();
    bvh.remove_instance(ids[900]).expect("there");
    bvh.install(rebuild.run()).expect("its own");
    bvh.refit();
    // Paths, and what is built anew around the one that was removed.
    let computed = bvh.work().top.nodes().len();
    assert!((2..bvh.top.len() / 2).contains(&computed), "{computed} nodes");
    bvh.validate().expect("valid");
}

/// Added instances are put in again; what is refitted stays what changed.
#[test]
fn instances_added_since_a_rebuild_cost_their_paths() {
    let (mut bvh, _) = lamps(1000);
    let mesh = bvh.mesh_id(0).expect("there");
    let rebuild: Rebuild<_, 8> = bvh.rebuild(&RebuildParams::eager());
    for k in 0..4_u8 {
        bvh.add_instance(mesh, Transform::at([f32::from(k), 50.0, 0.0]))
            .expect("one more");
        if k == 3 {
            break;
        }
        bvh.refit();
    }
    bvh.install(rebuild.run()).expect("its own");
    bvh.refit();
    let computed = bvh.work().top.nodes().len();
    assert!(computed < bvh.top.len() / 2, "{computed} of {}", bvh.top.len());
    bvh.validate().expect("valid");
}

/// Where as many instances are added as there are, the top level is built anew, which a plan tells together with what it has
/// not told yet.
#[test]
fn a_top_level_built_anew_is_told_as_a_whole() {
    let (mut bvh, _) = lamps(1000);
    let mesh = bvh.mesh_id(0).expect("there");
    bvh.plan();
    bvh.add_instance(mesh, Transform::IDENTITY).expect("one more");
    bvh.refit();
    let add = |k: usize| Edit::AddInstance {
        mesh,
        transform: Transform::at([k as f32, 50.0, 0.0]),
        radiance: 1.0,
    };
    bvh.apply((0..bvh.live.len()).map(add).collect())
        .expect("instances");
    assert!(bvh.changes.new.whole_top && !bvh.changes.unplanned.is_empty());
    assert_eq!(bvh.plan().top.nodes().len(), bvh.top.len());
    bvh.refit();
    bvh.validate().expect("valid");
}

#[test]
fn a_deformed_mesh_is_told_to_an_older_rebuild() {
    let (mut bvh, _) = lamps(100);
    let mesh = bvh.mesh_id(0).expect("there");
    for refit_first in [true, false] {
        let rebuild: Rebuild<_, 8> = bvh.rebuild(&RebuildParams::eager());
        let mut triangle = lamp();
        triangle.p[1][0] = if refit_first { 3.0 } else { 4.0 };
        bvh.set_triangles(mesh, std::vec![triangle]).expect("as many");
        if refit_first {
            bvh.refit();
        }
        bvh.install(rebuild.run()).expect("its own");
        bvh.refit();
        bvh.validate().expect("valid");
    }
}

#[test]
fn edits_without_end_before_a_refit_take_no_more_room_than_the_arrays() {
    let (mut bvh, ids) = lamps(200);
    let mesh = bvh.mesh_id(0).expect("there");
    for round in 0..200 {
        let y = round as f32;
        bvh.apply(ids.iter().map(|&id| up(id, y)).collect())
            .expect("moved");
        bvh.set_triangles(mesh, std::vec![lamp()]).expect("as many");
        let one = bvh.add_instance(mesh, Transform::IDENTITY).expect("one more");
        bvh.remove_instance(one).expect("there");
        bvh.take_removed_lights();
        let new = &bvh.changes.new;
        let indices = new.instances.len() + new.written_instances.len() + new.top_nodes.len();
        let ranges = new.written_nodes.len() + new.written_triangles.len() + new.written_trails.len();
        assert!(indices + ranges <= 2 * (3 * 201 + 300) + 64, "{indices} {ranges}");
    }
    bvh.refit();
    bvh.validate().expect("valid");
    // The next edit costs as much as ever.
    bvh.set_radiance(ids[3], 2.0).expect("there");
    bvh.refit();
    assert!(bvh.work().top.nodes().len() <= bvh.depth() as usize);
    bvh.validate().expect("valid");
}

/// A plan without refits, and a refit without plans, cost what is new.
#[test]
fn what_only_one_side_does_stays_short() {
    let (mut bvh, ids) = lamps(500);
    let moved = |bvh: &mut LightBvh, y| {
        let edits = ids.iter().map(|&id| up(id, y)).collect();
        bvh.apply(edits).expect("moved");
    };
    for round in 0..100 {
        moved(&mut bvh, round as f32);
        assert_eq!(bvh.plan().written_instances.len(), 1);
        assert!(bvh.changes.unrefitted.instances.len() <= 2 * 1000 + 64);
    }
    bvh.refit();
    bvh.validate().expect("valid");
    for round in 0..100 {
        moved(&mut bvh, 0.5 + round as f32);
        bvh.refit();
        assert!(bvh.changes.unplanned.instances.len() <= 2 * 1000 + 64);
    }
    // One mirror takes all of it at once.
    let told = bvh.plan();
    assert!(told.written_instances.iter().eq([&(0..500)]));
    assert!(!told.top.nodes().is_empty());
    bvh.refit();
    bvh.validate().expect("valid");
}

/// Refits count what changed, whether they gather their lists themselves or take those of a plan: what is written to a file is
/// the same, and so what a rebuilder does.
#[test]
fn plans_change_nothing_of_what_refits_count() {
    let (mut bvh, ids) = lamps(600);
    let words = bvh.to_words();
    let mut planned = LightBvh::from_words(&words).expect("sound words");
    for round in 0..20_u32 {
        for (k, bvh) in [&mut bvh, &mut planned].into_iter().enumerate() {
            let some = ids.iter().skip(round as usize).step_by(7 + round as usize);
            let edits = some.map(|id| {
                let id = bvh.instance_id(id.index()).expect("there");
                up(id, round as f32 + 0.1 * (id.index() % 9) as f32)
            });
            let edits = edits.collect();
            bvh.apply(edits).expect("moved");
            (0..k).for_each(|_| _ = bvh.plan());
            bvh.refit();
        }
        assert!(bvh.to_words() == planned.to_words(), "round {round}");
    }
    assert!(bvh.top.changes.iter().any(|&changes| changes > 0));
}

#[test]
fn a_copy_has_ids_and_rebuilds_of_its_own() {
    let (mut bvh, ids) = lamps(20);
    let mut copy = bvh.clone();
    let error = copy.set_radiance(ids[3], 2.0).expect_err("not its own");
    assert_eq!(error, EditReason::UnknownInstance(ids[3]));
    let own = copy.instance_id(ids[3].index()).expect("there");
    copy.set_radiance(own, 2.0).expect("its own");
    bvh.set_radiance(ids[4], 0.0).expect("its own");
    copy.refit();
    bvh.refit();
    copy.install(bvh.rebuild(&RebuildParams::eager()).run())
        .expect_err("another's");
    let (one, other) = (bvh.add_mesh(std::vec![lamp()]), copy.add_mesh(std::vec![lamp()]));
    assert_ne!(one, other);
    copy.refit();
    copy.validate().expect("valid");
}

#[test]
fn numbers_that_are_free_again_make_room() {
    let (mut bvh, ids) = lamps(1);
    let mesh = bvh.mesh_id(0).expect("there");
    // As if a great mesh had been there: all numbers but one are free, and the end is at the limit.
    let rest = MAX_LIGHTS as u32 - 1;
    let (lights, triangles) = (bvh.lights.take(rest), bvh.triangle_ranges.take(rest));
    bvh.add_instance(mesh, Transform::IDENTITY)
        .expect_err("none is free");
    assert_eq!(
        bvh.add_mesh(std::vec![lamp()]).expect_err("none is free"),
        EditReason::TooMany
    );
    bvh.lights.give(lights);
    let two = || Edit::AddInstance {
        mesh,
        transform: Transform::IDENTITY,
        radiance: 1.0,
    };
    bvh.apply(std::vec![two(), two()]).expect("room");
    // Not done, for the array would be of that length.
    bvh.triangle_ranges.give(triangles);
    let mut edits = [Edit::AddMesh {
        triangles: std::vec![lamp()],
    }];
    assert!(bvh.check(&mut edits).is_ok());
    assert!(bvh.lights_of(ids[0]).is_some());
}

#[test]
fn small_and_far_lights_are_in_the_world_what_they_are_in_their_mesh() {
    let small = crate::exact::pow2(-90);
    let light = EmissiveTriangle {
        p: [[small, 0.0, 0.0], [0.0, small, 0.0], [0.0, 0.0, small]],
        mesh: 0,
        ..lamp()
    };
    let lights = crate::Lights::new(std::vec![light]).expect("in the domain");
    let bvh = LightBvh::single_level(&lights, &crate::BuildParams::default());
    assert_eq!(bvh.triangle(0, crate::INVALID).expect("there").p, light.p);

    // Its reach is 2^40 m at most, which rounding must not pass.
    let e = 385_757_540_000.0;
    let far = EmissiveTriangle {
        p: [[e; 3], [e, e, 0.0], [0.0, e, e]],
        ..lamp()
    };
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(std::vec![far]).expect("in the domain");
    let transform = Transform {
        columns: [
            [0.944_021_64, 0.0, 0.0],
            [0.849_532_4, 1.0, 0.0],
            [0.885_961_65, 0.0, 1.0],
        ],
        translation: [65_868_220_000.0, 0.0, 0.0],
    };
    let instance = bvh.add_instance(mesh, transform).expect("within reach");
    let world = bvh.triangle(0, instance.index()).expect("there");
    world.checked().expect("in the domain");
}

/// Triangles that change one by one are told one by one, be they every second one of a mesh: all would be twice as much to copy.
#[test]
fn separate_triangles_are_told_by_themselves() {
    const COUNT: u32 = 20_000;
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(std::vec![lamp(); COUNT as usize]).expect("a mesh");
    bvh.add_instance(mesh, Transform::IDENTITY).expect("one");
    bvh.plan();
    bvh.refit();
    let mut brighter = lamp();
    brighter.radiance = [2.0; 3];
    let every_second = (0..COUNT / 2).map(|k| Edit::SetTriangleRange {
        mesh,
        first: 2 * k,
        triangles: std::vec![brighter],
    });
    // And two more, on the other places.
    let more = [1, 5001].map(|first| Edit::SetTriangleRange {
        mesh,
        first,
        triangles: std::vec![brighter],
    });
    bvh.apply(every_second.chain(more).collect()).expect("its own");
    let plan = bvh.plan();
    let written: usize = plan.written_triangles.iter().map(ExactSizeIterator::len).sum();
    assert_eq!(written, COUNT as usize / 2 + 2);
}

#[test]
fn what_is_gone_is_in_no_list() {
    let (mut bvh, ids) = lamps(60);
    // A mesh that came and went.
    let mesh = bvh.add_mesh(std::vec![lamp(); 5]).expect("a mesh");
    bvh.apply(std::vec![Edit::RemoveMesh(mesh)]).expect("unused");
    // Nodes that lost children, of a top level that is no more.
    bvh.apply(ids[9..].iter().map(|&id| Edit::RemoveInstance(id)).collect())
        .expect("there");
    let rebuild: Rebuild<_, 8> = bvh.rebuild(&RebuildParams::eager());
    bvh.remove_instance(ids[7]).expect("there");
    bvh.install(rebuild.run()).expect("its own");
    bvh.refit();
    assert!(bvh.work().roots.is_empty() && bvh.work().bottom.nodes().is_empty());
    let own: Vec<u32> = bvh.top.in_use().collect();
    assert!(own.len() <= 3 && bvh.work().top.nodes().iter().all(|node| own.contains(node)));
    bvh.validate().expect("valid");
}

/// What was built for a mesh or an instance that has gone is not for those which have its place since.
#[test]
fn rebuilds_are_not_for_newcomers() {
    let (mut bvh, ids) = lamps(40);
    let soup = |seed: u16| -> Vec<_> {
        let at = |k: u16| f32::from((k * 37 + seed) % 101);
        let lamps = (0..60).map(|k| {
            let mut one = lamp();
            one.p = one.p.map(|v| [v[0] + at(k), v[1] + at(k + 5), v[2]]);
            one
        });
        lamps.collect()
    };
    let mesh = bvh.add_mesh(soup(0)).expect("a mesh");
    let user = bvh.add_instance(mesh, Transform::IDENTITY).expect("one");
    bvh.refit();
    let all = RebuildParams { top: 1.0, drift: 0.0 };
    bvh.set_triangles(mesh, soup(3)).expect("as many");
    bvh.refit();
    let rebuild: Rebuild<_, 8> = bvh.rebuild(&all);
    let index = bvh.meshes[mesh.index() as usize].blas;
    assert!(rebuild.bottoms().any(|blas| blas == index));
    let rebuilt = rebuild.run();
    bvh.remove_instance(user).expect("there");
    bvh.apply(std::vec![Edit::RemoveMesh(mesh)]).expect("unused");
    let newcomer = bvh.add_mesh(soup(50)).expect("a mesh");
    bvh.remove_instance(ids[0]).expect("there");
    // Its parts take more places, so that the second stands behind them.
    for (x, index) in [(80.0, ids[0].index()), (90.0, user.index() + 8)] {
        let one = bvh
            .add_instance(newcomer, Transform::at([x, 0.0, 0.0]))
            .expect("one");
        assert_eq!(one.index(), index);
    }
    bvh.refit();
    let index = bvh.meshes[newcomer.index() as usize].blas as usize;
    let own = bvh.blases[index].nodes.clone();
    let before = bvh.nodes()[own.start as usize..own.end as usize].to_vec();
    bvh.install(rebuilt).expect("its own");
    assert_eq!(bvh.blases[index].nodes, own);
    assert_eq!(
        bytemuck::cast_slice::<_, u8>(&before),
        bytemuck::cast_slice::<_, u8>(&bvh.nodes()[own.start as usize..own.end as usize])
    );
    bvh.refit();
    bvh.validate().expect("valid");
}

#[test]
fn removed_lights_wait_as_long_as_is_said() {
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(std::vec![lamp(); 1000]).expect("a mesh");
    let add = Edit::AddInstance {
        mesh,
        transform: Transform::IDENTITY,
        radiance: 1.0,
    };
    let ids = bvh.apply(std::vec![add; 150]).expect("instances").instances;
    // More than 65,536, but fewer than there are.
    let last: Vec<_> = ids.into_iter().rev().collect();
    let (first, rest) = last.split_at(70);
    bvh.apply(first.iter().map(|&id| Edit::RemoveInstance(id)).collect())
        .expect("there");
    assert_eq!(bvh.removed_lights().len(), 70);
    // One more than are left, and then all but one.
    bvh.apply(rest[..10].iter().map(|&id| Edit::RemoveInstance(id)).collect())
        .expect("there");
    assert_eq!(bvh.removed_lights()[0], 0..150_000);
    let read = LightBvh::from_words(&bvh.to_words()).expect("its words");
    assert_eq!(read.removed_lights(), bvh.removed_lights());
    bvh.remove_instance(rest[10]).expect("there");
    let told = bvh.take_removed_lights();
    assert_eq!(told[0], 0..150_000);
    // Numbers of lights that live are not given again.
    let new = bvh.add_instance(mesh, Transform::IDENTITY).expect("one more");
    let new = bvh.lights_of(new).expect("there");
    for &id in &rest[11..] {
        let own = bvh.lights_of(id).expect("there");
        assert!(own.end <= new.start || new.end <= own.start, "{own:?} {new:?}");
    }
    bvh.refit();
    bvh.validate().expect("valid");
}

/// Trails of a shallow tree stay what they are where a deep one makes all of them wider.
#[test]
fn trails_become_wide_together() {
    let (mut bvh, ids) = lamps(3);
    let deep = (-58..38).map(|e| {
        let mut one = lamp();
        let size = crate::exact::pow2(e);
        one.p = one
            .p
            .map(|v| [size + v[0] * size * 0.01, v[1], v[2] * size * 0.01]);
        one
    });
    let more = std::vec![lamp(), lamp(), lamp()];
    let shallow = bvh.add_mesh(more).expect("a mesh");
    bvh.add_instance(shallow, Transform::IDENTITY).expect("one");
    bvh.add_mesh(deep.collect()).expect("a mesh");
    assert_eq!(bvh.trail_words, 2);
    bvh.refit();
    bvh.validate().expect("valid");
    let point = crate::ShadingPoint {
        p: [1.0, 5.0, 1.0],
        n: [0.0, -1.0, 0.0],
    };
    for light in bvh.lights_of(ids[2]).expect("there") {
        assert!(bvh.pmf(&point, light, ids[2].index()) > 1e-3);
    }
}

/// As if nearly all numbers were in use.
#[test]
fn removed_lights_wait_less_where_numbers_run_out() {
    let (mut bvh, _) = lamps(1);
    bvh.light_count = MAX_LIGHTS - 180_000;
    bvh.waiting_lights = 89_000;
    bvh.retire_lights(0..1);
    assert!(!bvh.forgotten);
    bvh.waiting_lights = 91_000;
    bvh.retire_lights(0..0);
    assert!(bvh.forgotten);
}

#[test]
fn removed_lights_that_were_taken_wait_no_more() {
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(std::vec![lamp(); 1000]).expect("a mesh");
    let add = Edit::AddInstance {
        mesh,
        transform: Transform::IDENTITY,
        radiance: 1.0,
    };
    let ids = bvh.apply(std::vec![add; 250]).expect("instances").instances;
    for few in ids.chunks(60).take(3) {
        bvh.apply(few.iter().map(|&id| Edit::RemoveInstance(id)).collect())
            .expect("there");
        assert_eq!(bvh.take_removed_lights().len(), 60);
    }
}

/// Forgotten twice, the second time with fewer numbers in use: those of the first time were never told, and new lights got them.
#[test]
fn what_was_forgotten_before_is_told() {
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(std::vec![lamp(); 1000]).expect("a mesh");
    let add = |count: usize| {
        let one = Edit::AddInstance {
            mesh,
            transform: Transform::IDENTITY,
            radiance: 1.0,
        };
        std::vec![one; count]
    };
    let remove = |ids: &[InstanceId]| ids.iter().map(|&id| Edit::RemoveInstance(id)).collect::<Vec<_>>();
    let ids = bvh.apply(add(201)).expect("instances").instances;
    bvh.apply(remove(&ids[1..])).expect("there");
    assert!(bvh.forgotten);
    let told = bvh.removed_lights()[0].end;
    assert!(told >= 66_000, "{told}");
    for _ in 0..2 {
        let ids = bvh.apply(add(70)).expect("instances").instances;
        bvh.apply(remove(&ids)).expect("there");
    }
    let read = LightBvh::from_words(&bvh.to_words()).expect("its own");
    assert_eq!(read.removed_lights(), bvh.removed_lights());
    let all = bvh.take_removed_lights();
    // Each number that went is in one of the ranges.
    assert!(
        (1000..201_000).all(|light| all.iter().any(|range| range.contains(&light))),
        "{all:?}"
    );
}
