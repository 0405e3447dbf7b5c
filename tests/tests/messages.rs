//! Refusals say what was found, what was expected, and what to do.

use std::error::Error;

use lightbvh::error::{EditError, EditReason, FollowError};
use lightbvh::light::{MAX_RADIANCE, TWO_SIDED};
use lightbvh::point::MAX_REACH;
use lightbvh::transform::TransformError;
use lightbvh::{
    Bvh, CompactNode, Edit, EmissiveTriangle, LightError, Lights, LightsError, RebuildError, ShadingPoint,
    Transform,
};

#[track_caller]
fn says(error: &dyn Error, words: &[&str]) {
    let text = error.to_string();
    for word in words {
        assert!(text.contains(word), "{text:?} without {word:?}");
    }
}

const LAMP: EmissiveTriangle = EmissiveTriangle {
    p: [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
    radiance: [1.0; 3],
    mesh: 0,
    flags: 0,
};

#[test]
fn lights() {
    let far = |vertex: usize, axis: usize| {
        let mut lamp = LAMP;
        lamp.p[vertex][axis] = 1e20;
        lamp.checked().expect_err("beyond the domain")
    };
    assert_eq!(
        far(2, 1),
        LightError::Place {
            what: "third vertex of a triangle",
            axis: 1,
            value: 1e20
        }
    );
    says(
        &far(0, 0),
        &[
            "coordinate x of the first vertex",
            "1e20",
            "2^40",
            "scale the scene",
        ],
    );
    says(&far(1, 2), &["coordinate z of the second vertex"]);
    for (channel, name) in ["red", "green", "blue"].into_iter().enumerate() {
        let mut lamp = LAMP;
        lamp.radiance[channel] = -3.0;
        let error = lamp.checked().expect_err("negative");
        let what = "radiance of a triangle";
        let value = -3.0;
        assert_eq!(error, LightError::Emission { what, channel, value });
        says(&error, &[name, "-3", "2^-100 to 2^100", "repair"]);
        lamp.radiance[channel] = 2.0 * MAX_RADIANCE;
        lamp.checked().expect_err("too bright");
    }
    let mut lamp = LAMP;
    for flags in [0, TWO_SIDED] {
        lamp.flags = flags;
        assert_eq!(lamp.checked(), Ok(lamp));
    }
    for flags in [2, 3, 1 << 31, u32::MAX] {
        lamp.flags = flags;
        let error = lamp.checked().expect_err("a bit that means nothing");
        assert_eq!(error, LightError::Flags { flags });
        says(&error, &["flags", &format!("{flags:#x}"), "TWO_SIDED (1)"]);
    }

    says(
        &LightsError::TooMany { count: 5 << 30 },
        &["5368709120", "2^30", "split"],
    );
    let mut lamps = vec![LAMP; 4];
    lamps[2].p[0][0] = f32::NAN;
    says(
        &Lights::new(lamps).expect_err("NaN"),
        &["emissive triangle 2", "coordinate x", "NaN"],
    );
    let mut lamps = vec![LAMP; 4];
    lamps[3].mesh = 7;
    says(
        &Lights::new(lamps).expect_err("a gap"),
        &[
            "emissive triangle 3",
            "mesh light 7",
            "expected 1 or the one before",
        ],
    );
}

#[test]
fn edits() {
    let mut scene = Bvh::<CompactNode<4>, (), 4>::default();
    let mesh = scene.add_mesh(vec![LAMP; 3]).expect("a mesh");
    let add = |transform, radiance| Edit::AddInstance {
        mesh,
        transform,
        radiance,
    };
    let here = Transform::IDENTITY;
    let instance = scene.apply(vec![add(here, 1.0)]).expect("an instance").instances[0];
    let mut refused = |edit: Edit, words: &[&str]| {
        // After one that is sound, so that its index shows.
        let error = scene.apply(vec![add(here, 1.0), edit]).expect_err("refused");
        assert_eq!(error.edit, 1);
        says(&error, &["edit 1: "]);
        says(&error, words);
        error.reason
    };
    refused(
        Edit::AddMesh {
            triangles: Vec::new(),
        },
        &["without lights"],
    );
    let mut triangles = vec![LAMP; 3];
    triangles[1].radiance[2] = f32::NAN;
    refused(Edit::AddMesh { triangles }, &["light 1", "blue", "NaN"]);
    let triangles = vec![LAMP; 2];
    let count = refused(
        Edit::SetTriangles { mesh, triangles },
        &["2 lights for a mesh of 3"],
    );
    assert_eq!(
        count,
        EditReason::Count {
            expected: 3,
            found: 2
        }
    );
    let (first, triangles) = (2, vec![LAMP; 2]);
    refused(
        Edit::SetTriangleRange {
            mesh,
            first,
            triangles,
        },
        &["lights 2 to 4 of a mesh of 3", "within it"],
    );
    refused(
        add(here, 2.0f32.powi(61)),
        &["factor on radiance", "2^-60 to 2^60"],
    );
    refused(add(here, 2.0f32.powi(-61)), &["factor on radiance"]);
    refused(Edit::RemoveMesh(mesh), &["still has 2 instances"]);
    let mut tall = here;
    tall.columns[1][2] = f32::INFINITY;
    refused(add(tall, 1.0), &["columns[1][2]", "inf", "2^40"]);
    refused(add(Transform::at([0.0, 1.1e12, 0.0]), 1.0), &["translation[1]"]);
    // All within 2^40, but not what they make together.
    let mut far = Transform::at([1.0e12, 0.0, 0.0]);
    far.columns[0][0] = 1.0e12;
    let reason = refused(add(far, 1.0), &["as far as", "2^40 m", "scale the scene"]);
    let EditReason::Transform(TransformError::TooFar { metres }) = reason else {
        panic!("{reason:?}");
    };
    assert!((metres - 2.0e12).abs() < 1e7, "{metres}");

    let mut scene = Bvh::<CompactNode<4>, (), 4>::default();
    let error = scene.apply(vec![Edit::RemoveMesh(mesh)]).expect_err("no mesh");
    assert_eq!(
        error,
        EditError {
            edit: 0,
            reason: EditReason::UnknownMesh(mesh)
        }
    );
    says(&error, &["edit 0: mesh 0 is not there"]);
    let error = scene
        .apply(vec![Edit::RemoveInstance(instance)])
        .expect_err("no instance");
    says(&error, &["instance 0 is not there"]);
    says(
        &EditError {
            edit: 7,
            reason: EditReason::TooMany,
        },
        &["edit 7: more than 2^30"],
    );
}

#[test]
fn lights_that_cannot_be_followed() {
    let lights = |count| Lights::new(vec![LAMP; count]).expect("lamps of one mesh light");
    let mut bvh = lightbvh::LightBvh::two_level(&lights(2), &lightbvh::BuildParams::default());
    let error = bvh.follow(&lights(3)).expect_err("one more");
    assert_eq!(
        error,
        FollowError {
            mesh: 0,
            reason: EditReason::Count {
                expected: 2,
                found: 3
            }
        }
    );
    says(
        &error,
        &["mesh light 0: 3 triangles, expected 2", "build it anew"],
    );
    // What is refused by itself names no batch.
    let mesh = bvh.mesh_id(0).expect("the first");
    let error = bvh.remove_mesh(mesh).expect_err("in use");
    assert!(
        error.to_string().starts_with("the mesh still has 1 instance;"),
        "{error}"
    );
}

#[test]
fn files() {
    let words = lightbvh::LightBvh::default().to_words();
    let read = |change: &dyn Fn(&mut Vec<u32>)| {
        let mut words = words.clone();
        change(&mut words);
        lightbvh::LightBvh::from_words(&words).expect_err("damaged")
    };
    says(&read(&|words| words[0] = 7), &["0x00000007", "to_words"]);
    says(&read(&|words| words.clear()), &["0 words", "expected", "damaged"]);
    says(&read(&|words| words.push(0)), &["words", "cut or damaged"]);
    let error = Bvh::<CompactNode<4>, (), 4>::from_words(&words).expect_err("another layout");
    says(&error, &["another layout", "as what was written"]);
    says(
        &read(&|words| words[1] = 9),
        &["format 9, expected", "build the light BVH anew"],
    );
    says(
        &read(&|words| words[4] = 16),
        &["nodes of 16 children, expected 8"],
    );
    says(
        &read(&|words| words[5] = 99),
        &["word 5, flags, is 99", "damaged"],
    );
    says(
        &read(&|words| words[15] = 5),
        &["places of the top level's root", "damaged"],
    );
    says(
        &EditReason::Radiance { value: 1e30 },
        &["factor on radiance 1e30", "put the rest into the mesh"],
    );
    let nothing = EditReason::Radiance { value: f32::NAN }.to_string();
    assert!(nothing.ends_with("(8.7e-19 to 1.2e18)"), "{nothing}");
}

#[test]
fn violations() {
    let lights = Lights::new(vec![LAMP; 4]).expect("lights");
    let bvh = lightbvh::LightBvh::single_level(&lights, &lightbvh::BuildParams::default());
    let broken = |change: fn(&mut [u32])| {
        let mut bvh = bvh.clone();
        change(bvh.parts_mut().trails);
        bvh.validate().expect_err("broken")
    };
    let text = broken(|trails| trails[3] = 7).to_string();
    assert!(
        text.starts_with("node 0, slot ") && text.ends_with(", found 7"),
        "{text}"
    );
    assert!(text.contains("low trail word: expected "), "{text}");
    says(
        &RebuildError::Panicked {
            message: String::from("out of luck"),
        },
        &["panicked: out of luck", "keeps its trees"],
    );
}

/// Points that no guarantee covers stop a debug build.
#[cfg(debug_assertions)]
#[test]
fn points_beyond_all_bounds() {
    let lights = Lights::new(vec![LAMP; 4]).expect("lights");
    let bvh = lightbvh::LightBvh::two_level(&lights, &lightbvh::BuildParams::default());
    let up = [0.0, 1.0, 0.0];
    for (p, n) in [
        ([f32::NAN, 0.0, 0.0], up),
        ([0.0, f32::INFINITY, 0.0], up),
        ([0.0, 0.0, MAX_REACH.next_up()], up),
        ([0.0; 3], [0.0, 0.5, 0.0]),
        ([0.0; 3], [f32::NAN; 3]),
    ] {
        let point = ShadingPoint { p, n };
        assert!(point.checked().is_err());
        let stops = |f: &dyn Fn() -> f32| {
            let message = std::panic::catch_unwind(std::panic::AssertUnwindSafe(f)).expect_err("a panic");
            let message = message.downcast_ref::<String>().expect("a message").clone();
            assert!(message.starts_with("not a shading point"), "{message}");
        };
        stops(&|| bvh.sample(&point, 1u32).pmf);
        stops(&|| bvh.pmf(&point, 0, 0));
    }
}
