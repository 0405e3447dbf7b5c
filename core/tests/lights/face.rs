//! Empty trees, lights that are followed.

use lightbvh::device::bvh::follow;
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
        bvh.view().validate().expect("valid");
        assert_eq!(bvh.view().depth(), 1, "its empty root");
        assert_eq!(bvh.sample(&POINT, 7_u32), None);
        let sampled = bvh.tree().sample(&POINT, 7_u32);
        assert_eq!(
            (sampled.light, sampled.instance, sampled.pmf),
            (INVALID, INVALID, 0.0)
        );
        assert_eq!(bvh.tree().pmf(&POINT, 0, 0), 0.0);
        assert_eq!(bvh.view().light(0, 0), None);
        assert!(bvh.view().world_lights().is_empty() && bvh.view().light_count() == 0);
        follow(bvh, &lights).expect("as empty as before");
        let again = LightBvh::from_words(&bvh.to_words()).expect("its own words");
        assert_eq!(
            (again.to_words(), again.view().is_single_level()),
            (bvh.to_words(), bvh.view().is_single_level())
        );
    }
    for bvh in trees.iter_mut().filter(|bvh| !bvh.view().is_single_level()) {
        let mesh = bvh.add_mesh(vec![lamp(0)]).expect("a lamp");
        bvh.add_instance(mesh, Transform::at([1.0, 0.0, 0.0]))
            .expect("a mesh");
        bvh.refit();
        bvh.view().validate().expect("valid");
        assert_eq!(bvh.tree().sample(&POINT, 7_u32).light, 0);
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
    assert_eq!(follow(&mut two, &lights(&[0, 0, 1])), Ok(()));
    assert_eq!(follow(&mut two, &lights(&[0, 0, 1, 1])), count(1, 1, 2));
    assert_eq!(follow(&mut two, &lights(&[0, 0, 1, 2])), count(2, 0, 1));
    assert_eq!(follow(&mut two, &lights(&[0, 0])), count(1, 1, 0));
    let mut single = LightBvh::single_level(&lights(&[0, 0, 1]), &params);
    assert_eq!(follow(&mut single, &lights(&[0, 1, 2])), Ok(()));
    assert_eq!(follow(&mut single, &lights(&[0])), count(0, 3, 1));
    let mut none = LightBvh::single_level(&lights(&[]), &params);
    assert_eq!(follow(&mut none, &lights(&[0])), count(0, 0, 1));
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
    let mesh = bvh.view().mesh_id(0).expect("a mesh");
    let half = lightbvh::light::MAX_COORDINATE * 0.5;
    let second = Transform::at([half, 0.0, 0.0]);
    let second = bvh.add_instance(mesh, second).expect("within the domain");
    bvh.refit();
    let before = bvh.to_words();
    let error = follow(&mut bvh, &lights(half * 0.5)).expect_err("beyond the domain");
    assert!(
        error.mesh == 0 && matches!(error.reason, EditReason::Transform(_)),
        "{error}"
    );
    assert!(bvh.to_words() == before, "as before");
    bvh.remove(second).expect("there");
    follow(&mut bvh, &lights(half * 0.25)).expect("the others may");

    let gone = bvh.view().instance_id(1).expect("of the second mesh");
    bvh.remove(gone).expect("there");
    let second = bvh.view().mesh_id(1).expect("a mesh");
    bvh.apply(vec![Edit::RemoveMesh(second)]).expect("not in use");
    assert_eq!(bvh.view().mesh_lights(second), None);
    assert!(bvh.view().mesh_lights(mesh).is_some());
    assert_eq!(bvh.clone().view().mesh_lights(mesh), None, "an id of another");
    let reason = EditReason::Count {
        expected: 0,
        found: 1,
    };
    assert_eq!(
        follow(&mut bvh, &lights(1.0)),
        Err(FollowError { mesh: 1, reason })
    );
    let first = Lights::new(vec![lamp(0), lamp(0)]).expect("lamps");
    assert_eq!(follow(&mut bvh, &first), Ok(()));
}

/// Of a batch with two wrong edits the others are applied, and each edit has its own result.
#[test]
fn each_sound_edit_is_applied() {
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(vec![lamp(0)]).expect("a lamp");
    let gone = bvh.add_instance(mesh, Transform::IDENTITY).expect("a mesh");
    bvh.remove(gone).expect("it is there");
    let made = bvh.apply_each(vec![
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
    let instances = made
        .iter()
        .map(|own| own.as_ref().map_or(0, |added| added.instances.len()));
    assert_eq!(instances.collect::<Vec<_>>(), [0, 1, 0, 1]);
    assert_eq!(made[0], Err(EditReason::UnknownInstance(gone)));
    assert!(matches!(made[2], Err(EditReason::Transform(_))));
    bvh.refit();
    bvh.view().validate().expect("valid");
}
