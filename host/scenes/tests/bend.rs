//! Meshes that bend, and lights without area.

use glam::Vec3;
use lightbvh::light::{AnyLight, SpotLight};
use lightbvh::{BuildParams, Edit};
use lightbvh_kernels::bvh::{AnyNode, Node, WIDTH};
use lightbvh_scenes::{
    AnalyticKind, Influence, Instances, Interpolation, Primitive, Property, Scene, SceneData,
};
use serde_json::{Value, json};

use crate::files::{add_view, bending, broken, changed, push, read, read_json, refused, triangle};

fn near(a: [f32; 3], b: [f32; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-5)
}

/// Vertices 0 to 3 of the second mesh: it has the triangles 0 2 1, 0 1 3, 0 3 2, 1 2 3.
fn skinned(scene: &Scene, frame: u32) -> [[f32; 3]; 4] {
    let triangles = scene.frame(frame).triangles;
    let ([a, c, b], [_, _, d]) = (triangles[4].p, triangles[5].p);
    [a, b, c, d]
}

#[test]
fn joints_take_vertices_along() {
    let scene = Scene::new(bending()).expect("a sound scene");
    // At rest each vertex is where it is modelled, moved by the first joint's place; the node's own does not matter.
    let at_rest = [[0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0], [0.0, 0.0, 3.0]];
    assert_eq!(skinned(&scene, 0), at_rest);
    // A quarter turn about (0, 1): (1, 0) is wholly taken to (1, 2), (0, 1) half to itself, the others stay.
    let turned = skinned(&scene, 25);
    let expected = [[0.0, 0.0, 2.0], [1.0, 2.0, 2.0], [0.0, 1.0, 2.0], [0.0, 0.0, 3.0]];
    for (found, expected) in turned.iter().zip(expected) {
        assert!(near(*found, expected), "{turned:?}");
    }
}

#[test]
fn weights_of_targets_follow_gltf() {
    let height = |scene: &Scene, frame: u32| scene.frame(frame).triangles[0].p[0][2];
    let scene = |interpolation, values: &[f32]| {
        let mut data = bending();
        data.animations[0].channels[1].interpolation = interpolation;
        data.animations[0].channels[1].values = values.to_vec();
        Scene::new(data).expect("a sound scene")
    };
    let linear = scene(Interpolation::Linear, &[0.0, 0.0, 3.0, 1.0]);
    assert!((height(&linear, 10) - 0.6).abs() < 1e-6);
    let step = scene(Interpolation::Step, &[1.0, 0.0, 3.0, 1.0]);
    assert_eq!(height(&step, 49), 1.0);
    // In-tangents, values, out-tangents of both keys; in the middle 1/2 (v0 + v1) + 2 s / 8 (out0 - in1).
    let spline = [9.0, 9.0, 1.0, 0.0, 2.0, 0.0, 1.0, 0.0, 3.0, 0.0, 9.0, 9.0];
    assert!((height(&scene(Interpolation::CubicSpline, &spline), 25) - 2.25).abs() < 1e-6);
    // Without animation the node's own weights hold.
    let mut data = bending();
    data.animations.clear();
    assert_eq!(height(&Scene::new(data).expect("a sound scene"), 0), 0.5);
}

#[test]
fn light_bvhs_follow_what_bends() {
    let scene = Scene::new(bending()).expect("a sound scene");
    let (mut lights, mut instances) =
        Instances::new::<Node, (), WIDTH>(&scene, 0, BuildParams::default()).expect("sound");
    let mut bent = 0;
    for frame in [0, 7, 25, 26, 49] {
        let edits = instances.edits(&scene, frame);
        for edit in &edits {
            bent += u32::from(matches!(edit, Edit::SetTriangles { .. }));
        }
        lights.apply(edits).expect("sound");
        lights.refit();
        lights
            .validate()
            .unwrap_or_else(|violation| panic!("{violation}"));
        let (expected, found) = (scene.frame(frame).emissive, lights.world_lights());
        assert_eq!(expected.len(), found.len());
        for (e, f) in expected.iter().zip(&found) {
            assert_eq!((e.mesh, e.radiance), (f.mesh, f.radiance), "frame {frame}");
            assert!((0..3).all(|i| near(e.p[i], f.p[i])), "frame {frame}: {e:?} {f:?}");
        }
    }
    // The targets in frames 7, 25, 26 and 49, the skin in frame 25.
    assert_eq!(bent, 5);
}

#[test]
fn a_mirrored_skin_keeps_its_front() {
    let mut data = bending();
    data.skins[0].inverse_bind[0][0][0] = -1.0;
    data.skins[0].inverse_bind[1][0][0] = -1.0;
    let scene = Scene::new(data).expect("a sound scene");
    let plain = Scene::new(bending()).expect("a sound scene");
    let volume = |scene: &Scene| {
        let triangles = scene.frame(0).triangles;
        let corners = triangles[4..8].iter().map(|own| own.p.map(Vec3::from));
        let of = |[a, b, c]: [Vec3; 3]| (a - 2.0 * Vec3::Z).dot((b - 2.0 * Vec3::Z).cross(c - 2.0 * Vec3::Z));
        corners.map(of).sum::<f32>()
    };
    assert!(volume(&plain) > 0.9 && volume(&scene) > 0.9, "{}", volume(&scene));
    let (lights, _) = Instances::new::<Node, (), WIDTH>(&scene, 0, BuildParams::default()).expect("sound");
    let placed: Vec<_> = lights.world_lights().iter().map(|light| light.p).collect();
    let expected: Vec<_> = scene.frame(0).emissive.iter().map(|light| light.p).collect();
    assert_eq!(placed, expected);
}

#[test]
fn what_cannot_bend_is_named() {
    fn part(data: &mut SceneData, mesh: usize) -> &mut Primitive {
        &mut data.meshes[mesh].primitives[0]
    }
    fn influence(data: &mut SceneData) -> &mut Influence {
        &mut part(data, 1).influences[0][2]
    }
    fn weights(data: &mut SceneData, targets: u32) {
        data.animations[0].channels[1].property = Property::Weights(targets);
    }
    type Case = (fn(&mut SceneData), &'static str);
    let cases: [Case; 13] = [
        (|data| data.nodes[1].skin = Some(1), "skin of node 1"),
        (|data| data.skins[0].joints[1] = 9, "joint of skin 0"),
        (
            |data| data.skins[0].inverse_bind.truncate(1),
            "matrices of skin 0",
        ),
        (
            |data| data.skins[0].inverse_bind[1][3][0] = f32::NAN,
            "bind matrix",
        ),
        (|data| data.skins[0].inverse_bind[0][3][0] = 1e20, "2^40"),
        (
            |data| influence(data).joints[3] = 2,
            "a joint of the mesh of node 1",
        ),
        (|data| influence(data).weights[0] = -1.0, "weight of a joint"),
        (
            |data| part(data, 1).influences[0].truncate(3),
            "influences of mesh 1",
        ),
        (|data| part(data, 0).targets[0].truncate(3), "target 0 of mesh 0"),
        (
            |data| part(data, 0).targets[0][1][1] = f32::INFINITY,
            "target 0 of",
        ),
        (|data| data.nodes[0].weights[0] = f32::NAN, "a weight of node 0"),
        (|data| weights(data, 3), "value list"),
        (|data| weights(data, 0), "number of targets"),
    ];
    for (change, expected) in cases {
        let message = broken(bending(), change);
        assert!(message.contains(expected), "{expected}: {message}");
    }
}

/// [`triangle`], its vertices moved by joint 1 alone, told in bytes.
fn jointed() -> Value {
    let mut root = changed("/nodes/0", json!({ "mesh": 0, "skin": 0, "children": [1, 2] }));
    push(&mut root["nodes"], json!({}));
    push(&mut root["nodes"], json!({ "translation": [0.0, 0.0, 7.0] }));
    root["skins"] = json!([{ "joints": [1, 2] }]);
    let mut bytes = [[1_u8, 0, 0, 0]; 3].as_flattened().to_vec();
    bytes.extend([[100_u8, 0, 0, 0]; 3].as_flattened());
    add_view(&mut root, &bytes);
    let accessor = |at, normalized| json!({ "bufferView": 2, "byteOffset": at, "componentType": 5121, "count": 3, "type": "VEC4", "normalized": normalized });
    push(&mut root["accessors"], accessor(0, false));
    push(&mut root["accessors"], accessor(12, true));
    let attributes = &mut root["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = json!(2);
    attributes["WEIGHTS_0"] = json!(3);
    root
}

#[test]
fn joints_and_weights_in_bytes() {
    let scene = read_json(&jointed());
    let expected = [[0.0, 0.0, 7.0], [1.0, 0.0, 7.0], [0.0, 1.0, 7.0]];
    assert_eq!(scene.frame(0).triangles[0].p, expected);
    let attributes = "/meshes/0/primitives/0/attributes/";
    for (pointer, value, expected) in [
        (&*format!("{attributes}WEIGHTS_0"), json!(99), "accessor 99"),
        ("/accessors/2/count", json!(2), "has 2 elements, fewer"),
        ("/accessors/2/normalized", json!(true), "as a joint"),
        ("/skins/0/joints", json!([1]), "a joint of the mesh"),
        ("/skins/0/joints", json!([1, 9]), "node 9"),
        ("/skins/0/inverseBindMatrices", json!(0), "expected 16"),
        ("/nodes/0/skin", json!(3), "skin 3"),
    ] {
        let mut root = jointed();
        let (parent, key) = pointer.rsplit_once('/').expect("a pointer");
        root.pointer_mut(parent).expect("there")[key] = value;
        let error = refused(&root);
        assert!(error.contains(expected), "{pointer}: {error}");
    }
    // Joints outside of the scene: the mesh stays where its node is.
    let mut root = jointed();
    root["nodes"][0]["children"] = json!([1]);
    let scene = read_json(&root);
    assert_eq!(scene.frame(0).triangles[0].p[0], [0.0; 3]);
    assert!(scene.warnings()[0].contains("skins[0] is ignored"));
}

/// The range of what exporters write for none is none.
#[test]
fn lights_without_area_are_read() {
    let mut root = triangle();
    root["extensions"] = json!({ "KHR_lights_punctual": { "lights": [
        { "type": "point", "intensity": 800.0, "color": [1.0, 0.5, 0.25], "range": 9.0 },
        { "type": "spot", "spot": { "innerConeAngle": 0.25, "outerConeAngle": 0.5 }, "range": 1e-9 },
        { "type": "directional", "intensity": 3.0 },
        { "type": "spot", "spot": { "innerConeAngle": 0.5, "outerConeAngle": 0.25 }, "range": 3e38 },
        { "type": "point", "intensity": -1.0 },
        { "type": "moon" },
        { "type": "point", "range": 0.0 },
    ] } });
    root["extensionsRequired"] = json!(["KHR_lights_punctual"]);
    // The moon on two nodes.
    let places = (0..8)
        .chain([5])
        .map(|light| json!({ "extensions": { "KHR_lights_punctual": { "light": light } } }));
    root["nodes"].as_array_mut().expect("a list").extend(places);
    root["scenes"][0]["nodes"] = (0..10).collect();
    let scene = read_json(&root);
    let all = &scene.data().analytic;
    let spot = |inner, outer| AnalyticKind::Spot { inner, outer };
    let found: Vec<_> = all.iter().map(|own| (own.kind, own.range)).collect();
    let expected = [
        (AnalyticKind::Point, Some(9.0)),
        (spot(0.25, 0.5), Some(2.0_f32.powi(-20))),
        // The cone of exporters whose edge is sharp.
        (spot(0.25, 0.25), None),
    ];
    assert_eq!(found, expected);
    assert!(scene.has_kinds() && scene.analytic_count() == 3);
    assert_eq!((all[0].intensity, all[0].color[1], all[0].node), (800.0, 0.5, 1));
    let warnings = scene.warnings();
    let said = |word: &str| warnings.iter().filter(|warning| warning.contains(word)).count();
    // Once for each light, whatever the number of its nodes.
    assert_eq!(said("is left out"), 5, "{warnings:?}");
    assert_eq!(said("it is directional"), 1, "{warnings:?}");
    assert_eq!(said("nodes[6], nodes[9]"), 1, "{warnings:?}");
    assert_eq!(warnings.len(), 5, "{warnings:?}");
    let back = read(&scene.to_glb().expect("written")).expect("read back");
    assert_eq!(back.data().analytic, *all);
}

/// A spot under a node that is turned by a right angle about x: its scale neither turns nor moves it; where it leaves no
/// directions, the spot shines along the world's -Z.
#[test]
fn scales_do_not_turn_lights() {
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let lamp = json!({ "extensions": { "KHR_lights_punctual": { "light": 0 } } });
    for (scale, down) in [
        ([1.0; 3], [0.0, -1.0, 0.0]),
        ([0.5, 4.0, 2.0], [0.0, -1.0, 0.0]),
        ([0.0; 3], [0.0, 0.0, -1.0]),
        ([1e30; 3], [0.0, 0.0, -1.0]),
        ([2.0, 3.0, 0.0], [0.0, 0.0, -1.0]),
    ] {
        let mut root = triangle();
        root["extensions"] = json!({ "KHR_lights_punctual": { "lights": [{ "type": "spot" }] } });
        root["nodes"] = json!([
            { "mesh": 0 },
            { "translation": [1, 2, 3], "rotation": [-half, 0.0, 0.0, half], "scale": scale, "children": [2] },
            lamp
        ]);
        root["scenes"][0]["nodes"] = json!([0, 1]);
        let scene = read_json(&root);
        let lit = scene.frame(30);
        let spot = SpotLight::try_from(lit.others[0]).expect("a spot");
        let followed = Instances::<AnyLight>::new::<AnyNode, (), 8>(&scene, 0, BuildParams::default());
        let (lights, mut instances) = followed.unwrap_or_else(|error| panic!("{scale:?}: {error}"));
        let world = lights.world_lights();
        let placed = world.iter().find_map(|&light| SpotLight::try_from(light).ok());
        for (found, expected) in [
            (spot.axis, down),
            (placed.expect("a spot").axis, down),
            (spot.p, [1.0, 2.0, 3.0]),
        ] {
            assert!(
                near(found, expected),
                "{scale:?}: {found:?}, expected {expected:?}"
            );
        }
        assert!(instances.edits(&scene, 9).is_empty());
    }
}
