//! Empty trees, lights that are followed.

use lightbvh::error::{EditReason, FollowError};
use lightbvh::{BuildParams, Edit, EmissiveTriangle, INVALID, LightBvh, Lights, ShadingPoint, Transform};

const POINT: ShadingPoint = ShadingPoint {
    p: [0.0; 3],
    n: [0.0, 1.0, 0.0],
};

/// A lamp that shines down.
fn lamp(mesh: u32) -> EmissiveTriangle {
    EmissiveTriangle {
        p: [[0.0, 3.0, 0.0], [0.5, 3.0, 0.0], [0.0, 3.0, 0.5]],
        radiance: [1.0; 3],
        mesh,
        flags: 0,
    }
}

#[test]
fn no_lights_are_a_tree_that_answers_none() {
    let lights = Lights::new(Vec::new()).expect("an empty set");
    let params = BuildParams::default();
    let mut trees = [
        LightBvh::default(),
        LightBvh::single_level(&lights, &params),
        LightBvh::two_level(&lights, &params),
    ];
    for bvh in &mut trees {
        bvh.refit();
        bvh.validate().expect("valid");
        assert_eq!(bvh.depth(), 1, "its empty root");
        let sampled = bvh.sample(&POINT, 7_u32);
        assert_eq!(
            (sampled.light, sampled.instance, sampled.pmf),
            (INVALID, INVALID, 0.0)
        );
        assert_eq!(bvh.pmf(&POINT, 0, 0), 0.0);
        assert_eq!(bvh.light(0, 0), None);
        assert!(bvh.world_lights().is_empty() && bvh.light_count() == 0);
        bvh.follow(&lights).expect("as empty as before");
        let again = LightBvh::from_words(&bvh.to_words()).expect("its own words");
        assert_eq!(
            (again.to_words(), again.is_single_level()),
            (bvh.to_words(), bvh.is_single_level())
        );
    }
    for bvh in trees.iter_mut().filter(|bvh| !bvh.is_single_level()) {
        let mesh = bvh.add_mesh(vec![lamp(0)]).expect("a lamp");
        bvh.add_instance(mesh, Transform::at([1.0, 0.0, 0.0]))
            .expect("a mesh");
        bvh.refit();
        bvh.validate().expect("valid");
        assert_eq!(bvh.sample(&POINT, 7_u32).light, 0);
    }
}

#[test]
fn lights_of_another_shape_are_not_followed() {
    let lights =
        |meshes: &[u32]| Lights::new(meshes.iter().map(|&mesh| lamp(mesh)).collect()).expect("lamps");
    let params = BuildParams::default();
    let count = |mesh, expected, found| {
        Err(FollowError {
            mesh,
            reason: EditReason::Count { expected, found },
        })
    };
    let mut two = LightBvh::two_level(&lights(&[0, 0, 1]), &params);
    assert_eq!(two.follow(&lights(&[0, 0, 1])), Ok(()));
    assert_eq!(two.follow(&lights(&[0, 0, 1, 1])), count(1, 1, 2));
    assert_eq!(two.follow(&lights(&[0, 0, 1, 2])), count(2, 0, 1));
    assert_eq!(two.follow(&lights(&[0, 0])), count(1, 1, 0));
    let mut single = LightBvh::single_level(&lights(&[0, 0, 1]), &params);
    assert_eq!(single.follow(&lights(&[0, 1, 2])), Ok(()));
    assert_eq!(single.follow(&lights(&[0])), count(0, 3, 1));
    let mut none = LightBvh::single_level(&lights(&[]), &params);
    assert_eq!(none.follow(&lights(&[0])), count(0, 0, 1));
}

/// Meshes that are gone have no triangles to follow, and each instance that has moved meanwhile must stay within the domain.
#[test]
fn lights_are_followed_after_edits() {
    let lights = |size: f32| {
        let of = |mesh: u32| {
            let mut one = lamp(mesh);
            one.p = one.p.map(|v| v.map(|x| x * size));
            one
        };
        Lights::new(vec![of(0), of(0), of(1)]).expect("lamps")
    };
    let params = BuildParams::default();
    let mut bvh = LightBvh::two_level(&lights(1.0), &params);
    let mesh = bvh.mesh_id(0).expect("a mesh");
    let half = lightbvh::light::MAX_COORDINATE * 0.5;
    let second = Transform::at([half, 0.0, 0.0]);
    let second = bvh.add_instance(mesh, second).expect("within the domain");
    bvh.refit();
    let before = bvh.to_words();
    let error = bvh.follow(&lights(half * 0.5)).expect_err("beyond the domain");
    assert!(
        error.mesh == 0 && matches!(error.reason, EditReason::Transform(_)),
        "{error}"
    );
    assert!(bvh.to_words() == before, "as before");
    bvh.remove_instance(second).expect("there");
    bvh.follow(&lights(half * 0.25)).expect("the others may");

    let gone = bvh.instance_id(1).expect("of the second mesh");
    bvh.remove_instance(gone).expect("there");
    let second = bvh.mesh_id(1).expect("a mesh");
    bvh.remove_mesh(second).expect("not in use");
    assert_eq!(bvh.mesh_lights(second), None);
    assert!(bvh.mesh_lights(mesh).is_some());
    assert_eq!(bvh.clone().mesh_lights(mesh), None, "an id of another");
    let reason = EditReason::Count {
        expected: 0,
        found: 1,
    };
    assert_eq!(bvh.follow(&lights(1.0)), Err(FollowError { mesh: 1, reason }));
    let first = Lights::new(vec![lamp(0), lamp(0)]).expect("lamps");
    assert_eq!(bvh.follow(&first), Ok(()));
}

/// Of a batch with two wrong edits the others are applied, and each error names its own.
#[test]
fn each_sound_edit_is_applied() {
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(vec![lamp(0)]).expect("a lamp");
    let gone = bvh.add_instance(mesh, Transform::IDENTITY).expect("a mesh");
    bvh.remove_instance(gone).expect("it is there");
    let (added, refused) = bvh.apply_each(vec![
        Edit::RemoveInstance(gone),
        Edit::AddLight {
            light: lamp(0),
            mask: u32::MAX,
        },
        Edit::AddInstance {
            mesh,
            transform: Transform::at([f32::NAN; 3]),
            radiance: [1.0; 3],
            mask: u32::MAX,
        },
        Edit::AddInstance {
            mesh,
            transform: Transform::at([3.0, 0.0, 0.0]),
            radiance: [1.0; 3],
            mask: u32::MAX,
        },
    ]);
    let edits: Vec<usize> = refused.iter().map(|error| error.edit).collect();
    assert_eq!((added.instances.len(), edits), (2, vec![0, 2]));
    assert!(matches!(refused[0].reason, EditReason::UnknownInstance(id) if id == gone));
    bvh.refit();
    bvh.validate().expect("valid");
}
