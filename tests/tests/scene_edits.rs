//! Single edits of scenes: what they cost, what they leave, and what is refused.

use lightbvh::bvh::{EditReason, RebuildParams};
use lightbvh::{Bvh, CompactNode, Edit, Eq4, INVALID, InstanceId, Transform};
use lightbvh_tests::edits::{add_instance, add_mesh, mesh};
use lightbvh_tests::generate::{self, Random};
use lightbvh_tests::placing::{self, Kind};

type Tree = Bvh<CompactNode<4>, (), 4>;

/// Whatever the map, it is the instance's leaf and the nodes above it.
#[test]
fn motion_costs_one_way_up_and_no_bottom_level() {
    let random = &mut Random::new(5);
    let mut scene = Tree::default();
    let mesh = add_mesh(&mut scene, mesh(random));
    let add = |random: &mut Random| Edit::AddInstance {
        mesh,
        transform: placing::transform(random, Kind::Similar, 50.0),
        radiance: 1.0,
    };
    let batch = (0..1000).map(|_| add(random)).collect();
    let ids = scene.apply(batch).expect("instances").instances;
    scene.refit();
    let stats = scene.validate().expect("valid");
    assert_eq!(stats.blases, 1, "one bottom level serves all");

    scene.apply(Vec::new()).expect("nothing");
    scene.refit();
    assert_eq!(scene.work().computed(), 0, "nothing changed");

    let instance = ids[123];
    for kind in [
        Kind::Rigid,
        Kind::Similar,
        Kind::Affine,
        Kind::Flat,
        Kind::Singular,
        Kind::Extreme,
    ] {
        let transform = placing::transform(random, kind, 50.0);
        scene
            .apply(vec![Edit::SetTransform { instance, transform }])
            .expect("moved");
        scene.refit();
        let work = scene.work();
        assert!(work.bottom.nodes().is_empty() && work.roots.is_empty());
        assert!(work.written_triangles.is_empty() && work.written_trails.is_empty());
        // Far from where it was it is put in elsewhere, and at most the 512 instances around both places are built anew.
        let most = 2 * 512 + 4 * stats.depth as usize;
        let written: usize = work.written_instances.iter().map(ExactSizeIterator::len).sum();
        assert!(work.top.nodes().len() < most && written < 2 * most, "{kind:?}");
        assert_eq!(scene.validate().expect("valid").blases, 1);
    }
    for _ in 0..6 {
        let mut transform = scene_transform(&scene, instance);
        transform.translation[0] += 0.001;
        scene
            .apply(vec![Edit::SetTransform { instance, transform }])
            .expect("moved");
        scene.refit();
        let work = scene.work();
        assert!(work.bottom.nodes().is_empty() && work.roots.is_empty());
        assert_eq!(work.written_instances.len(), 1);
        assert!(work.written_instances[0].clone().eq([instance.index()]));
        assert!(
            work.top.nodes().len() <= stats.depth as usize + 2,
            "{} nodes",
            work.top.nodes().len()
        );
        assert!(
            work.written_nodes.is_empty()
                && work.written_triangles.is_empty()
                && work.written_trails.is_empty()
        );
    }
}

/// The map of an instance, as its record has it.
fn scene_transform(scene: &Tree, instance: InstanceId) -> Transform {
    let own = &scene.instances()[instance.index() as usize];
    Transform {
        columns: own.columns,
        translation: own.translation,
    }
}

/// The instances in use are listed without gaps, each once, whatever comes and goes: what a uniform choice relies on.
#[test]
fn instances_in_use_are_listed() {
    let random = &mut Random::new(11);
    let mut scene = Tree::default();
    let mesh = add_mesh(&mut scene, mesh(random));
    let mut ids = Vec::new();
    for round in 0..300 {
        let mut batch: Vec<Edit> = (0..random.below(6))
            .map(|_| Edit::AddInstance {
                mesh,
                transform: placing::transform(random, Kind::Rigid, 10.0),
                radiance: 1.0,
            })
            .collect();
        for _ in 0..random.below(6) {
            if !ids.is_empty() {
                batch.push(Edit::RemoveInstance(
                    ids.swap_remove(random.below(ids.len() as u32) as usize),
                ));
            }
        }
        ids.extend(scene.apply(batch).expect("sound edits").instances);
        scene.refit();
        let tree = scene.tree();
        assert_eq!(tree.live as usize, ids.len(), "round {round}");
        let mut listed: Vec<u32> = tree.instances[..ids.len()]
            .iter()
            .map(|record| record.listed)
            .collect();
        let mut expected: Vec<u32> = ids.iter().map(|id| id.index()).collect();
        listed.sort_unstable();
        expected.sort_unstable();
        assert_eq!(listed, expected, "round {round}");
    }
}

/// Who never takes the numbers of removed lights neither runs out of numbers nor misses one.
#[test]
fn numbers_that_nobody_takes_come_back_and_are_still_told() {
    let random = &mut Random::new(7);
    let mut scene = Tree::default();
    let triangles = mesh(random);
    let count = triangles.len() as u32;
    let mesh = add_mesh(&mut scene, triangles);
    let mut one = add_instance(&mut scene, mesh, Transform::IDENTITY);
    let mut forgot = 0;
    for _ in 0..300_000 / count {
        scene.apply(vec![Edit::RemoveInstance(one)]).expect("there");
        let told = scene.removed_lights();
        let gone = told.iter().any(|range| range.contains(&(scene.light_end() - 1)));
        forgot += u32::from(gone && told.len() == 1);
        assert!(told.len() as u32 <= 65_536 / count + 2);
        one = add_instance(&mut scene, mesh, Transform::IDENTITY);
        let own = scene.lights_of(one).expect("there");
        assert!(scene.light_end() <= 65_536 + 2 * count, "{own:?}");
        if !told_all(scene.removed_lights()) {
            let given_again = scene
                .removed_lights()
                .iter()
                .any(|gone| gone.contains(&own.start));
            assert!(!given_again, "{own:?} was not taken yet");
        }
    }
    assert!(forgot >= 3, "{forgot}");
    let told = scene.take_removed_lights();
    assert!(told_all(&told) && told[0].end >= 65_536, "{told:?}");
    assert!(scene.take_removed_lights().is_empty());
    // No number was lost: what is live and what comes next fill the numbers from 0.
    let all = (0..scene.light_end() / count).map(|_| add_instance(&mut scene, mesh, Transform::IDENTITY));
    let greatest = all
        .collect::<Vec<_>>()
        .into_iter()
        .map(|id| scene.lights_of(id).expect("there").end)
        .max();
    assert_eq!(greatest, Some(scene.light_end()));
    assert_eq!(scene.light_count() as u32, scene.light_end());
}

/// Whether all numbers were given back unasked.
fn told_all(told: &[std::ops::Range<u32>]) -> bool {
    told.first()
        .is_some_and(|range| range.start == 0 && range.end > 60_000)
}

#[test]
fn light_numbers_stay_and_removed_ones_are_told() {
    let random = &mut Random::new(6);
    let mut scene = Tree::default();
    let triangles = mesh(random);
    let count = triangles.len() as u32;
    let mesh = add_mesh(&mut scene, triangles);
    let add = Edit::AddInstance {
        mesh,
        transform: Transform::IDENTITY,
        radiance: 1.0,
    };
    let ids = scene
        .apply(vec![add.clone(), add.clone(), add.clone()])
        .expect("three")
        .instances;
    let lights: Vec<_> = ids
        .iter()
        .map(|&id| scene.lights_of(id).expect("there"))
        .collect();
    scene.apply(vec![Edit::RemoveInstance(ids[1])]).expect("removed");
    assert_eq!(scene.removed_lights().to_vec(), vec![lights[1].clone()]);
    assert_eq!(lights[1], count..2 * count);
    let again = scene.apply(vec![add]).expect("added").instances[0];
    // Numbers come back once they are taken, not before.
    assert_eq!(scene.lights_of(again), Some(3 * count..4 * count));
    assert_eq!(scene.take_removed_lights(), vec![lights[1].clone()]);
    assert!(scene.removed_lights().is_empty());
    scene.refit();
    scene
        .install(scene.rebuild(&RebuildParams::eager()).run())
        .expect("its own");
    scene.refit();
    scene.validate().expect("valid");
    assert_eq!(scene.lights_of(ids[0]), Some(lights[0].clone()));
    assert_eq!(scene.lights_of(ids[1]), None);
    assert_eq!(scene.lights_of(ids[2]), Some(lights[2].clone()));
    assert_eq!(scene.lights_of(again), Some(3 * count..4 * count));
    assert_eq!(
        scene
            .by::<Eq4>()
            .pmf(&generate::point(random, 1.0), lights[0].start, ids[1].index()),
        0.0
    );
}

#[test]
fn the_last_light_may_go() {
    let random = &mut Random::new(7);
    let mut scene = Tree::default();
    let point = generate::point(random, 1.0);
    assert_eq!(scene.by::<Eq4>().sample(&point, 1u32).light, INVALID);
    let mesh = add_mesh(&mut scene, mesh(random));
    let lamp = add_instance(&mut scene, mesh, Transform::IDENTITY);
    scene.refit();
    let flying = scene.rebuild(&RebuildParams::eager()).run();
    scene
        .apply(vec![Edit::RemoveInstance(lamp), Edit::RemoveMesh(mesh)])
        .expect("gone");
    scene.refit();
    assert_eq!(scene.by::<Eq4>().sample(&point, 1u32).light, INVALID);
    assert_eq!(scene.validate().expect("valid").lights, 0);
    scene.install(flying).expect("its own");
    scene.refit();
    assert_eq!(scene.by::<Eq4>().sample(&point, 1u32).light, INVALID);
    scene.validate().expect("valid");
}

#[test]
fn bad_edits_change_nothing() {
    let random = &mut Random::new(8);
    let mut scene = Tree::default();
    let mesh_id = add_mesh(&mut scene, mesh(random));
    let [instance, gone] = [0; 2].map(|_| add_instance(&mut scene, mesh_id, Transform::IDENTITY));
    scene.apply(vec![Edit::RemoveInstance(gone)]).expect("removed");
    scene.refit();
    let before = format!("{scene:?}");

    let mut nan = Transform::IDENTITY;
    nan.columns[1][2] = f32::NAN;
    let mut dark = mesh(random);
    dark[0].radiance[1] = -1.0;
    let far = Transform::at([1.0e12, 0.0, 1.099_6e12]);
    type Reason = fn(&EditReason) -> bool;
    let bad: Vec<(Edit, Reason)> = vec![
        (Edit::RemoveInstance(gone), |r| {
            matches!(r, EditReason::UnknownInstance(_))
        }),
        (
            Edit::SetTransform {
                instance,
                transform: nan,
            },
            |r| matches!(r, EditReason::Transform(_)),
        ),
        (
            Edit::SetTransform {
                instance,
                transform: far,
            },
            |r| matches!(r, EditReason::Transform(_)),
        ),
        (
            Edit::SetRadiance {
                instance,
                radiance: f32::INFINITY,
            },
            |r| matches!(r, EditReason::Radiance { .. }),
        ),
        (
            Edit::SetRadiance {
                instance,
                radiance: -1.0,
            },
            |r| matches!(r, EditReason::Radiance { .. }),
        ),
        (
            Edit::AddMesh {
                triangles: Vec::new(),
            },
            |r| matches!(r, EditReason::EmptyMesh),
        ),
        (Edit::AddMesh { triangles: dark }, |r| {
            matches!(r, EditReason::Light { index: 0, .. })
        }),
        (
            Edit::SetTriangles {
                mesh: mesh_id,
                triangles: vec![mesh(random)[0]; 40],
            },
            |r| matches!(r, EditReason::Count { found: 40, .. }),
        ),
        (Edit::RemoveMesh(mesh_id), |r| {
            matches!(r, EditReason::InUse { instances: 1 })
        }),
    ];
    for (edit, expected) in bad {
        let text = format!("{edit:?}");
        let good = Edit::SetRadiance {
            instance,
            radiance: 0.5,
        };
        let error = scene.apply(vec![good, edit]).expect_err(&text);
        assert_eq!(error.edit, 1, "{text}");
        assert!(expected(&error.reason), "{text}: {error}");
        assert_eq!(format!("{scene:?}"), before, "{text} was half done");
    }
    // Ids that an earlier edit of the batch removed.
    let twice = vec![Edit::RemoveInstance(instance), Edit::RemoveInstance(instance)];
    assert_eq!(scene.apply(twice).expect_err("gone by then").edit, 1);
    assert_eq!(format!("{scene:?}"), before);
}

/// A mesh may not reach out of the domain by any order of edits: also where an instance of the same batch is what is too far.
#[test]
fn deforming_a_mesh_counts_instances_of_the_same_batch() {
    let random = &mut Random::new(10);
    let mut scene = Tree::default();
    let triangles = mesh(random);
    let mut large = triangles.clone();
    for triangle in &mut large {
        triangle.p = triangle.p.map(|p| p.map(|x| x * 2f32.powi(30)));
    }
    let mesh = add_mesh(&mut scene, triangles);
    let far = Edit::AddInstance {
        mesh,
        transform: Transform::at([1.0995e12, 0.0, 0.0]),
        radiance: 1.0,
    };
    let deform = Edit::SetTriangles {
        mesh,
        triangles: large.clone(),
    };
    let near = Edit::AddInstance {
        mesh,
        transform: Transform::IDENTITY,
        radiance: 1.0,
    };
    scene.refit();
    let before = format!("{scene:?}");
    for batch in [
        vec![far.clone(), deform.clone()],
        vec![deform.clone(), far.clone()],
        vec![near.clone(), far.clone(), deform.clone()],
    ] {
        let last = batch.len() - 1;
        let error = scene.apply(batch).expect_err("it would reach beyond 2^40 m");
        assert_eq!(error.edit, last);
        assert!(matches!(error.reason, EditReason::Transform(_)), "{error}");
        assert_eq!(format!("{scene:?}"), before);
    }
    scene.apply(vec![near, deform]).expect("within 2^40 m");
    scene.refit();
    scene.validate().expect("valid");
}

#[test]
fn thousands_of_edits_in_one_frame() {
    let random = &mut Random::new(9);
    let mut scene = Tree::default();
    let meshes = (0..20).map(|_| Edit::AddMesh {
        triangles: mesh(random),
    });
    let meshes = scene.apply(meshes.collect()).expect("meshes").meshes;
    let mut ids = Vec::new();
    for round in 0..6 {
        let mut batch = Vec::new();
        for &instance in &ids {
            let transform = placing::transform(random, Kind::Rigid, 100.0);
            batch.push(Edit::SetTransform { instance, transform });
        }
        let gone = ids.len() / 2;
        batch.extend(ids.drain(..gone).map(Edit::RemoveInstance));
        for _ in 0..2000 {
            batch.push(Edit::AddInstance {
                mesh: meshes[random.below(20) as usize],
                transform: placing::transform(random, Kind::Similar, 100.0),
                radiance: 1.0,
            });
        }
        ids.extend(scene.apply(batch).expect("sound edits").instances);
        scene.refit();
        let stats = scene
            .validate()
            .unwrap_or_else(|violation| panic!("{round}: {violation}"));
        assert_eq!(stats.instances as usize, ids.len());
    }
}

/// Edits, plans, rebuilds and refits in every order of a frame lose no change, and a scene may be sampled at any time.
#[test]
fn plans_edits_and_rebuilds_come_in_any_order() {
    for n in [20u16, 500] {
        let mut scene = Tree::default();
        let random = &mut Random::new(91);
        let mesh = add_mesh(&mut scene, mesh(random));
        let place = |k: u16| Transform::at([f32::from(k * 37 % n), f32::from(k % 17), f32::from(k % 11)]);
        let add = (0..n).map(|k| Edit::AddInstance {
            mesh,
            transform: place(k),
            radiance: if k == n / 2 { 0.0 } else { 1.0 },
        });
        let ids = scene.apply(add.collect()).expect("instances").instances;
        scene.refit();
        let point = lightbvh::ShadingPoint {
            p: [0.0, 0.0, 30.0],
            n: [0.0; 3],
        };
        for order in 0..4 {
            let lamp = ids[usize::from(n) / 2];
            let rebuilt = scene.rebuild(&RebuildParams::eager()).run();
            let shine = |radiance| Edit::SetRadiance {
                instance: lamp,
                radiance,
            };
            scene.apply(vec![shine(1.0)]).expect("it is there");
            if order & 1 != 0 {
                scene.plan();
            }
            // Another edit after the plan, then a tree of before both.
            let moved = Edit::SetTransform {
                instance: ids[3],
                transform: place(7),
            };
            scene.apply(vec![moved]).expect("it is there");
            if order & 2 != 0 {
                scene.plan();
            }
            scene.install(rebuilt).expect("its own");
            scene.refit();
            scene.validate().expect("valid");
            let light = scene.lights_of(lamp).expect("it is there").start;
            assert!(
                scene.by::<Eq4>().pmf(&point, light, lamp.index()) > 0.0,
                "{n}, {order}"
            );

            let added = Edit::AddInstance {
                mesh,
                transform: place(5),
                radiance: 1.0,
            };
            let id = scene.apply(vec![added]).expect("an instance").instances[0];
            assert_ne!(
                scene.by::<Eq4>().sample(&point, 77_u32).light,
                INVALID,
                "before the refit"
            );
            scene.plan();
            scene
                .apply(vec![Edit::RemoveInstance(id), shine(0.0)])
                .expect("they are there");
            scene.refit();
            scene.validate().expect("valid");
        }
        // A mirror that takes plans without refits here sees every edit.
        for instance in [ids[0], ids[9]] {
            let transform = place(2);
            scene
                .apply(vec![Edit::SetTransform { instance, transform }])
                .expect("it is there");
            let written = scene.plan().written_instances.clone();
            assert!(written.iter().any(|range| range.contains(&instance.index())));
        }
    }
}
