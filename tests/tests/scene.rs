//! Scenes under random edits: every invariant after every frame, against a scene built from scratch, and against the
//! geometry of the lights in the world.

use std::collections::BTreeMap;

use lightbvh::scene::{EditReason, RebuildParams, Rebuilt};
use lightbvh::{
    BuildParams, CompactNode, Edit, EmissiveTriangle, Eq4, INVALID, InstanceId, Scene, ShadingPoint,
    Transform,
};
use lightbvh_tests::edits::{Model, edits, mesh};
use lightbvh_tests::generate::{self, Random};
use lightbvh_tests::oracle::{can_contribute, sum_tolerance};
use lightbvh_tests::placing::{self, Kind};
use proptest::prelude::*;

type Tree = Scene<CompactNode<4>, 4>;

/// What rounding of the input may decide, as a part of the distance.
const MARGIN: f64 = 1e-6;

/// Points in the world, on and about the lights.
fn points(random: &mut Random, lights: &[EmissiveTriangle], reach: f32) -> Vec<ShadingPoint> {
    (0..6)
        .map(|i| {
            let mut point = generate::point(random, reach);
            if i % 2 == 0 && !lights.is_empty() {
                let near = lights[random.below(lights.len() as u32) as usize].p[0];
                let by = random.direction();
                let distance = generate::log_uniform(random, -10, 3);
                point.p = std::array::from_fn(|k| near[k] + by[k] * distance);
            }
            point
        })
        .collect()
}

/// Probabilities of all lights of all instances at a point, with the light's number.
fn pmfs(scene: &Tree, ids: &[InstanceId], point: &ShadingPoint) -> BTreeMap<u32, f32> {
    ids.iter()
        .flat_map(|&id| {
            scene
                .lights_of(id)
                .expect("it is there")
                .map(move |light| (light, id))
        })
        .map(|(light, id)| (light, scene.pmf::<Eq4>(point, light, id)))
        .collect()
}

fn check_sampling(scene: &Tree, ids: &[InstanceId], random: &mut Random, reach: f32) {
    let depth = scene.validate().expect("valid").depth;
    let world = scene.world_lights();
    let used: Vec<_> = world
        .iter()
        .copied()
        .filter(|light| light.mesh != INVALID)
        .collect();
    for point in points(random, &used, reach) {
        let pmfs = pmfs(scene, ids, &point);
        let sum: f64 = pmfs.values().map(|&p| f64::from(p)).sum();
        let reachable = pmfs.values().any(|&p| p > 0.0);
        assert!(pmfs.values().all(|p| p.is_finite() && *p >= 0.0));
        if reachable {
            assert!(
                (sum - 1.0).abs() <= sum_tolerance(depth),
                "sum {sum} at {point:?}"
            );
        }
        for (&light, &pmf) in &pmfs {
            let triangle = &world[light as usize];
            assert!(
                pmf > 0.0 || !can_contribute(triangle, &point, MARGIN),
                "no probability for light {light}, {triangle:?}, at {point:?}: {:?}",
                scene.instances()[triangle.mesh as usize]
            );
        }
        for _ in 0..16 {
            let sampled = scene.sample::<Eq4>(&point, random.bits());
            if reachable {
                assert!(sampled.light != INVALID, "a light can be reached at {point:?}");
                assert_eq!(sampled.pmf.to_bits(), pmfs[&sampled.light].to_bits(), "{point:?}");
            } else {
                assert_eq!(sampled.light, INVALID);
            }
        }
    }
}

/// A light by the exact map in f64, as long as its own instance's map may be off.
fn exact(triangle: &EmissiveTriangle, transform: &Transform, mirrored: bool) -> [[f64; 3]; 3] {
    let [a, b, c] = triangle.p.map(|p| {
        std::array::from_fn(|row| {
            (0..3)
                .map(|k| f64::from(transform.columns[k][row]) * f64::from(p[k]))
                .sum::<f64>()
                + f64::from(transform.translation[row])
        })
    });
    if mirrored { [a, c, b] } else { [a, b, c] }
}

fn check_lights(model: &Model, scene: &Tree, reach: f32) {
    for (&id, (mesh, transform, radiance)) in &model.instances {
        let lights = scene.lights_of(id).expect("it is there");
        assert_eq!(lights.len(), model.meshes[mesh].len());
        let [x, y, z] = transform.columns.map(|c| glam::DVec3::from(c.map(f64::from)));
        let mirrored = x.cross(y).dot(z) < 0.0;
        for (light, local) in lights.zip(&model.meshes[mesh]) {
            let found = scene.light(light, id).expect("one of its lights");
            let expected = exact(local, transform, mirrored);
            for (e, f) in expected.iter().flatten().zip(found.p.iter().flatten()) {
                assert!(
                    (e - f64::from(*f)).abs() <= f64::from(reach + 8.0) * 2f64.powi(-20),
                    "{e} {f}"
                );
            }
            let shine = local.radiance.map(|x| x * radiance);
            assert!(found.radiance == shine || found.radiance == [0.0; 3], "{found:?}");
            assert_eq!(found.mesh, id.index());
        }
    }
}

fn check(seed: u32, reach: f32) {
    let random = &mut Random::new(seed);
    let (mut scene, mut model) = (Tree::new(BuildParams::default()), Model::default());
    let mut flying: Option<(u32, Rebuilt<CompactNode<4>, 4>)> = None;
    for _ in 0..12 {
        // A rebuild that ends some frames after it began, before or after the edits of its last frame.
        let due = flying.take_if(|(frames, _)| {
            *frames = frames.saturating_sub(1);
            *frames == 0
        });
        let before = random.below(2) == 0;
        let (early, late) = if before { (due, None) } else { (None, due) };
        if let Some((_, rebuilt)) = early {
            scene.adopt(rebuilt);
        }
        edits(random, &mut model, &mut scene, reach);
        if let Some((_, rebuilt)) = late {
            scene.adopt(rebuilt);
        }
        scene.refit();
        let stats = scene.validate().unwrap_or_else(|violation| panic!("{violation}"));
        assert_eq!(stats.instances as usize, model.instances.len());
        assert_eq!(stats.lights as usize, scene.light_count());
        check_lights(&model, &scene, reach);
        if flying.is_none() && random.below(2) == 0 {
            let params = RebuildParams {
                top: random.below(4) != 0,
                drift: 1.0001,
            };
            flying = Some((1 + random.below(3), scene.rebuild(&params).run()));
        }
    }
    let ids: Vec<InstanceId> = model.instances.keys().copied().collect();
    check_sampling(&scene, &ids, random, reach);

    let (scratch, added) = model.from_scratch();
    let stats = scratch
        .validate()
        .unwrap_or_else(|violation| panic!("{violation}"));
    assert_eq!(stats.lights as usize, scene.light_count());
    check_sampling(&scratch, &added, random, reach);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 600, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn edits_leave_a_valid_scene(seed: u32) {
        check(seed, 10.0);
    }

    #[test]
    fn far_from_the_origin(seed: u32, exponent in 2..24) {
        check(seed, 2f32.powi(exponent));
    }
}

#[test]
fn rigid_motion_costs_one_way_up_and_no_bottom_level() {
    let random = &mut Random::new(5);
    let mut scene = Tree::default();
    let mesh = scene
        .update(vec![Edit::AddMesh {
            triangles: mesh(random),
        }])
        .expect("a mesh")
        .meshes[0];
    let add = |random: &mut Random| Edit::AddInstance {
        mesh,
        transform: placing::transform(random, Kind::Similar, 50.0),
        radiance: 1.0,
    };
    let batch = (0..1000).map(|_| add(random)).collect();
    let ids = scene.update(batch).expect("instances").instances;
    scene.refit();
    let stats = scene.validate().expect("valid");
    assert_eq!(stats.blases, 1, "one bottom level serves all");

    scene.update(Vec::new()).expect("nothing");
    scene.refit();
    assert_eq!(scene.work().computed(), 0, "nothing changed");

    let transform = placing::transform(random, Kind::Similar, 50.0);
    let instance = ids[123];
    scene
        .update(vec![Edit::Move { instance, transform }])
        .expect("moved");
    scene.refit();
    let work = scene.work();
    assert!(work.leaves.is_empty() && work.roots.is_empty());
    assert_eq!(work.instances.len(), 1);
    assert!(
        work.top.nodes().len() < stats.depth as usize,
        "{} nodes",
        work.top.nodes().len()
    );
    scene.validate().expect("valid");

    // Bent out of shape it gets triangles of its own, once; moved on, nothing below its leaf changes; back in shape, the
    // shared ones serve again.
    let bent = placing::transform(random, Kind::Affine, 50.0);
    scene
        .update(vec![Edit::Move {
            instance,
            transform: bent,
        }])
        .expect("bent");
    scene.refit();
    assert_eq!(scene.validate().expect("valid").blases, 2);
    let mut moved = bent;
    moved.translation[0] += 1.0;
    scene
        .update(vec![Edit::Move {
            instance,
            transform: moved,
        }])
        .expect("moved");
    scene.refit();
    assert!(scene.work().leaves.is_empty(), "its shape is the same");
    scene.validate().expect("valid");
    scene
        .update(vec![Edit::Move { instance, transform }])
        .expect("straight");
    scene.refit();
    assert_eq!(scene.validate().expect("valid").blases, 1);
}

#[test]
fn light_numbers_stay_and_removed_ones_are_told() {
    let random = &mut Random::new(6);
    let mut scene = Tree::default();
    let triangles = mesh(random);
    let count = triangles.len() as u32;
    let mesh = scene
        .update(vec![Edit::AddMesh { triangles }])
        .expect("a mesh")
        .meshes[0];
    let add = Edit::AddInstance {
        mesh,
        transform: Transform::IDENTITY,
        radiance: 1.0,
    };
    let ids = scene
        .update(vec![add.clone(), add.clone(), add.clone()])
        .expect("three")
        .instances;
    let lights: Vec<_> = ids
        .iter()
        .map(|&id| scene.lights_of(id).expect("there"))
        .collect();
    scene.update(vec![Edit::RemoveInstance(ids[1])]).expect("removed");
    assert_eq!(scene.removed_lights().to_vec(), vec![lights[1].clone()]);
    assert_eq!(lights[1], count..2 * count);
    let again = scene.update(vec![add]).expect("added").instances[0];
    assert!(scene.removed_lights().is_empty());
    scene.refit();
    scene.adopt(scene.rebuild(&RebuildParams::default()).run());
    scene.refit();
    scene.validate().expect("valid");
    assert_eq!(scene.lights_of(ids[0]), Some(lights[0].clone()));
    assert_eq!(scene.lights_of(ids[1]), None);
    assert_eq!(scene.lights_of(ids[2]), Some(lights[2].clone()));
    assert_eq!(scene.lights_of(again), Some(lights[1].clone()));
    assert_eq!(
        scene.pmf::<Eq4>(&generate::point(random, 1.0), lights[0].start, ids[1]),
        0.0
    );
}

#[test]
fn the_last_light_may_go() {
    let random = &mut Random::new(7);
    let mut scene = Tree::default();
    let point = generate::point(random, 1.0);
    assert_eq!(scene.sample::<Eq4>(&point, 1).light, INVALID);
    let mesh = scene
        .update(vec![Edit::AddMesh {
            triangles: mesh(random),
        }])
        .expect("a mesh")
        .meshes[0];
    let ids = scene
        .update(vec![Edit::AddInstance {
            mesh,
            transform: Transform::IDENTITY,
            radiance: 1.0,
        }])
        .expect("an instance")
        .instances;
    scene.refit();
    let flying = scene.rebuild(&RebuildParams::default()).run();
    scene
        .update(vec![Edit::RemoveInstance(ids[0]), Edit::RemoveMesh(mesh)])
        .expect("gone");
    scene.refit();
    assert_eq!(scene.sample::<Eq4>(&point, 1).light, INVALID);
    assert_eq!(scene.validate().expect("valid").lights, 0);
    scene.adopt(flying);
    scene.refit();
    assert_eq!(scene.sample::<Eq4>(&point, 1).light, INVALID);
    scene.validate().expect("valid");
}

#[test]
fn bad_edits_change_nothing() {
    let random = &mut Random::new(8);
    let mut scene = Tree::default();
    let mesh_id = scene
        .update(vec![Edit::AddMesh {
            triangles: mesh(random),
        }])
        .expect("a mesh")
        .meshes[0];
    let add = Edit::AddInstance {
        mesh: mesh_id,
        transform: Transform::IDENTITY,
        radiance: 1.0,
    };
    let instance = scene.update(vec![add.clone()]).expect("an instance").instances[0];
    let gone = scene.update(vec![add.clone()]).expect("an instance").instances[0];
    scene.update(vec![Edit::RemoveInstance(gone)]).expect("removed");
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
            Edit::Move {
                instance,
                transform: nan,
            },
            |r| matches!(r, EditReason::Transform(_)),
        ),
        (
            Edit::Move {
                instance,
                transform: far,
            },
            |r| matches!(r, EditReason::Transform(_)),
        ),
        (
            Edit::Shine {
                instance,
                radiance: f32::INFINITY,
            },
            |r| matches!(r, EditReason::Radiance { .. }),
        ),
        (
            Edit::Shine {
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
            Edit::Deform {
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
        let good = Edit::Shine {
            instance,
            radiance: 0.5,
        };
        let error = scene.update(vec![good, edit]).expect_err(&text);
        assert_eq!(error.edit, 1, "{text}");
        assert!(expected(&error.reason), "{text}: {error}");
        assert_eq!(format!("{scene:?}"), before, "{text} was half done");
    }
    // Ids that an earlier edit of the batch removed.
    let twice = vec![Edit::RemoveInstance(instance), Edit::RemoveInstance(instance)];
    assert_eq!(scene.update(twice).expect_err("gone by then").edit, 1);
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
    let mesh = scene
        .update(vec![Edit::AddMesh { triangles }])
        .expect("a mesh")
        .meshes[0];
    let far = Edit::AddInstance {
        mesh,
        transform: Transform::at([1.0995e12, 0.0, 0.0]),
        radiance: 1.0,
    };
    let deform = Edit::Deform {
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
        let error = scene.update(batch).expect_err("it would reach beyond 2^40 m");
        assert_eq!(error.edit, last);
        assert!(matches!(error.reason, EditReason::Transform(_)), "{error}");
        assert_eq!(format!("{scene:?}"), before);
    }
    scene.update(vec![near, deform]).expect("within 2^40 m");
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
    let meshes = scene.update(meshes.collect()).expect("meshes").meshes;
    let mut ids = Vec::new();
    for round in 0..6 {
        let mut batch = Vec::new();
        for &instance in &ids {
            let transform = placing::transform(random, Kind::Rigid, 100.0);
            batch.push(Edit::Move { instance, transform });
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
        ids.extend(scene.update(batch).expect("sound edits").instances);
        scene.refit();
        let stats = scene
            .validate()
            .unwrap_or_else(|violation| panic!("{round}: {violation}"));
        assert_eq!(stats.instances as usize, ids.len());
    }
}
