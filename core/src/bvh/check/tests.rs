//! The limits of a batch, which no real scene comes near, and what edits of one batch know of each other.

use crate::light::EmissiveTriangle;
use alloc::vec;

use super::*;
use crate::kit::scenes::{moved, scattered};
use crate::kit::triangle;
use crate::{CompactNode, InstanceId};

type Tree = Bvh<(CompactNode<4>, crate::Eq4), 4>;

/// Lights of the one mesh.
const COUNT: usize = 1 << 12;

fn lights(count: usize, size: f32) -> Vec<EmissiveTriangle> {
    let corner = |i: usize| [(i % 64) as f32, (i / 64) as f32, 0.0];
    let lamp = |i| triangle([corner(i), [size, 0.0, 0.0], [0.0, size, 0.0]]);
    (0..count).map(lamp).collect()
}

fn scene(count: usize) -> (Tree, MeshId, InstanceId) {
    let (scene, ids): (Tree, _) = scattered(lights(count, 1.0), 1, |_| [0.0; 3]);
    let mesh = scene.view().mesh_of(ids[0]).expect("a mesh");
    (scene, mesh, ids[0])
}

fn add(mesh: MeshId) -> Edit {
    Edit::AddInstance {
        mesh,
        transform: Transform::IDENTITY,
        radiance: [1.0; 3],
        mask: u32::MAX,
    }
}

/// That the batch is just not too large, and too large with another of its last edit.
#[track_caller]
fn limit(scene: &Tree, mut edits: Vec<Edit>) {
    scene.check(&mut edits).expect("just not too many");
    let last = edits.len();
    edits.push(edits[last - 1].clone());
    let error = scene.check(&mut edits).expect_err("one too many");
    assert_eq!((error.edit, error.reason), (last, EditReason::TooMany));
}

/// The greatest number of lights does not fit a test's memory, so the test sets the count.
#[test]
fn triangles_are_limited() {
    let (scene, ..) = scene(COUNT);
    for (more, expected) in [(COUNT, Ok(())), (COUNT + 1, Err(EditReason::TooMany))] {
        let mut batch = Batch {
            lights: MAX_LIGHTS - COUNT,
            ..Batch::default()
        };
        let lights = lights(more, 1.0);
        let found = scene.check_one(&mut batch, &mut Edit::AddMesh { lights });
        assert_eq!(found, expected, "{more}");
    }
}

#[test]
fn lights_are_limited() {
    let (mut scene, mesh, _) = scene(COUNT);
    scene.numbers.take((MAX_LIGHTS - 4 * COUNT) as u32);
    limit(&scene, vec![add(mesh); 3]);
}

#[test]
fn edits_know_of_those_before() {
    let (scene, mesh, instance) = scene(2);
    let deform = |size| Edit::SetLights {
        mesh,
        lights: lights(2, size),
    };
    let check = |mut edits: Vec<Edit>| {
        scene
            .check(&mut edits)
            .map_err(|error| (error.edit, error.reason))
    };
    let too_far = |result: Result<Reaches, (usize, EditReason)>, edit: usize| matches!(result, Err((at, EditReason::Transform(_))) if at == edit);
    // Just within 2^40 m; 2^30 m more are not.
    let (far, large) = (1.099e12, 1.0e9);
    assert_eq!(
        check(vec![moved(instance, [far; 3]), deform(1.0)])
            .expect("small")
            .len(),
        1
    );
    let reaches = check(vec![deform(large), deform(1.0)]).expect("near");
    assert_eq!(reaches[&mesh], reach_of(&lights(2, 1.0)));
    assert!(too_far(check(vec![moved(instance, [far; 3]), deform(large)]), 1));
    assert!(too_far(check(vec![deform(large), moved(instance, [far; 3])]), 1));
    check(vec![deform(large), deform(1.0), moved(instance, [far; 3])]).expect("small again");
    let gone = Edit::RemoveInstance(instance);
    check(vec![moved(instance, [far; 3]), gone.clone(), deform(large)]).expect("nothing is there");

    assert_eq!(
        check(vec![gone.clone(), moved(instance, [1.0; 3])]),
        Err((1, EditReason::UnknownInstance(instance)))
    );
    assert_eq!(
        check(vec![add(mesh), Edit::RemoveMesh(mesh)]),
        Err((1, EditReason::InUse { instances: 2 }))
    );
    check(vec![gone.clone(), Edit::RemoveMesh(mesh)]).expect("not in use");
    assert_eq!(
        check(vec![gone, Edit::RemoveMesh(mesh), add(mesh)]),
        Err((2, EditReason::UnknownMesh(mesh)))
    );
}

/// The error names the first wrong light; sound lights are normalized.
#[test]
fn wrong_triangles_are_named_wherever_they_are() {
    let mut lights = lights(9, 1.0);
    lights[5].p[0][0] = 1e-40;
    lights[7].p[2][1] = f32::NAN;
    lights[8].radiance[0] = -1.0;
    let found = checked(&mut lights).expect_err("a wrong one");
    assert!(matches!(found, EditReason::Light { index: 7, .. }), "{found}");
    assert_eq!(lights[5].p[0][0].to_bits(), 0);
}

#[test]
fn factors_on_radiance() {
    let [least, most] = RADIANCE_FACTORS;
    for good in [0.0, -0.0, least, most, 1.0] {
        factor([1.0, good, good]).expect("within the range");
    }
    for bad in [-1.0, least * 0.5, most * 2.0, f32::NAN, f32::INFINITY, 1e-40] {
        for k in 0..3 {
            let mut radiance = [1.0; 3];
            radiance[k] = bad;
            factor(radiance).expect_err("beyond it");
        }
    }
}
