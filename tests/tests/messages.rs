//! Refusals say what was found, what was expected, and what to do.

use std::error::Error;

use lightbvh::device::bvh::follow;
use lightbvh::device::point::MAX_REACH;
use lightbvh::error::{EditError, EditReason};
use lightbvh::light::{Light, MAX_RADIANCE, TWO_SIDED};
use lightbvh::{Bvh, CompactNode, Edit, EmissiveTriangle, Lights, LightsError, ShadingPoint, Transform};

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
    let wrong = |change: &dyn Fn(&mut EmissiveTriangle), words: &[&str]| {
        let mut lamp = LAMP;
        change(&mut lamp);
        says(&lamp.checked().expect_err("wrong"), words);
    };
    let far = [
        "coordinate x of the first vertex",
        "1e20",
        "2^40",
        "scale the scene",
    ];
    wrong(&|lamp| lamp.p[0][0] = 1e20, &far);
    wrong(
        &|lamp| lamp.p[1][2] = -1e20,
        &["coordinate z of the second vertex"],
    );
    for (channel, name) in ["red", "green", "blue"].into_iter().enumerate() {
        let negative = [name, "-3", "2^-100 to 2^100", "repair"];
        wrong(&|lamp| lamp.radiance[channel] = -3.0, &negative);
        wrong(&|lamp| lamp.radiance[channel] = 2.0 * MAX_RADIANCE, &[name]);
    }
    for flags in [2, 3, 1 << 31, u32::MAX] {
        let words = ["flags", &format!("{flags:#x}"), "TWO_SIDED (1)"];
        wrong(&|lamp| lamp.flags = flags, &words);
    }
    for flags in [0, TWO_SIDED] {
        let lamp = EmissiveTriangle { flags, ..LAMP };
        assert_eq!(lamp.checked(), Ok(lamp));
    }

    says(
        &LightsError::TooMany { count: 5 << 30 },
        &["5368709120", "2^30", "split"],
    );
    let refused = |change: &dyn Fn(&mut Vec<EmissiveTriangle>), words: &[&str]| {
        let mut lamps = vec![LAMP; 4];
        change(&mut lamps);
        says(&Lights::new(lamps).expect_err("wrong"), words);
    };
    let nan = ["light 2", "coordinate x", "NaN"];
    refused(&|lamps| lamps[2].p[0][0] = f32::NAN, &nan);
    let gap = ["light 3", "mesh light 7", "expected 1 or the one before"];
    refused(&|lamps| lamps[3].mesh = 7, &gap);
}

#[test]
fn edits() {
    let mut scene = Bvh::<(CompactNode<4>, ()), 4>::default();
    let mesh = scene.add_mesh(vec![LAMP; 3]).expect("a mesh");
    let add = |transform, radiance| Edit::AddInstance {
        mesh,
        transform,
        radiance: [radiance; 3],
        mask: u32::MAX,
    };
    let here = Transform::IDENTITY;
    let instance = scene.apply(vec![add(here, 1.0)]).expect("an instance").instances[0];
    let mut refused = |edit: Edit, words: &[&str]| {
        // After one that is sound, so that its index shows.
        let error = scene.apply(vec![add(here, 1.0), edit]).expect_err("refused");
        assert_eq!(error.edit, 1);
        says(&error, &["edit 1: "]);
        says(&error, words);
    };
    let triangles = |count| vec![LAMP; count];
    let none = Edit::AddMesh { lights: triangles(0) };
    refused(none, &["without lights"]);
    let mut lamps = triangles(3);
    lamps[1].radiance[2] = f32::NAN;
    refused(Edit::AddMesh { lights: lamps }, &["light 1", "blue", "NaN"]);
    let fewer = Edit::SetLights {
        mesh,
        lights: triangles(2),
    };
    refused(fewer, &["2 lights for a mesh of 3"]);
    let beyond = Edit::SetLightRange {
        mesh,
        first: 2,
        lights: triangles(2),
    };
    refused(beyond, &["lights 2 to 4 of a mesh of 3", "within it"]);
    let bright = ["factor on radiance", "2^-60 to 2^60"];
    refused(add(here, 2.0f32.powi(61)), &bright);
    refused(add(here, 2.0f32.powi(-61)), &bright);
    refused(Edit::RemoveMesh(mesh), &["still has 2 instances"]);
    let mut tall = here;
    tall.columns[1][2] = f32::INFINITY;
    refused(add(tall, 1.0), &["columns[1][2]", "inf", "2^40"]);
    refused(add(Transform::at([0.0, 1.1e12, 0.0]), 1.0), &["translation[1]"]);
    // All within 2^40, but not together.
    let mut far = Transform::at([1.0e12, 0.0, 0.0]);
    far.columns[0][0] = 1.0e12;
    refused(add(far, 1.0), &["as far as", "2^40 m", "scale the scene"]);

    let mut scene = Bvh::<(CompactNode<4>, ()), 4>::default();
    for (edit, words) in [
        (Edit::RemoveMesh(mesh), "edit 0: mesh 0 is not there"),
        (Edit::RemoveInstance(instance), "edit 0: instance 0 is not there"),
    ] {
        says(&scene.apply(vec![edit]).expect_err("nothing there"), &[words]);
    }
    let (edit, reason) = (7, EditReason::TooMany);
    says(&EditError { edit, reason }, &["edit 7: more than 2^30"]);
}

#[test]
fn lights_that_cannot_be_followed() {
    let lights = |count| Lights::new(vec![LAMP; count]).expect("lamps of one mesh light");
    let mut bvh = lightbvh::LightBvh::two_level(&lights(2), &lightbvh::BuildParams::default());
    let error = follow(&mut bvh, &lights(3)).expect_err("one more");
    says(&error, &["mesh light 0: 3 lights, expected 2", "rebuild it"]);
    // An edit by itself names no batch, and a light by itself no place in a mesh.
    let instance = bvh.view().instance_id(0).expect("the first");
    let error = bvh
        .set_radiance(instance, [-1.0; 3])
        .expect_err("negative")
        .to_string();
    assert!(error.starts_with("factor on radiance"), "{error}");
    let mut lamp = LAMP;
    lamp.radiance[2] = f32::NAN;
    let error = bvh.add_light(lamp).expect_err("single level or NaN").to_string();
    assert!(error.contains("blue") && !error.contains("light 0"), "{error}");
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
    says(
        &read(&|words| words[1] = 9),
        &["format 9, expected", "rebuild the light BVH"],
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

/// Points that no guarantee covers get no light.
#[test]
fn points_beyond_all_bounds() {
    let lights = Lights::new(vec![LAMP; 4]).expect("lights");
    let bvh = lightbvh::LightBvh::two_level(&lights, &lightbvh::BuildParams::default());
    let lamp = bvh.view().instance_id(0).expect("of the lights");
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
        assert_eq!(bvh.sample(&point, 1u32), None);
        assert_eq!(bvh.pmf(&point, lamp, 0), None);
    }
}
