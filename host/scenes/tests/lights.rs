//! Lights without area.

use lightbvh::BuildParams;
use lightbvh::light::{AnyLight, SpotLight};
use lightbvh_kernels::bvh::AnyNode;
use lightbvh_scenes::{AnalyticKind, Instances};
use serde_json::json;

use crate::files::{read, read_json, triangle};

fn near(a: [f32; 3], b: [f32; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-5)
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
    assert_eq!(said("nodes[6], nodes[9]"), 1, "{warnings:?}");
    assert_eq!(warnings.len(), 5, "{warnings:?}");
    let back = read(&scene.to_glb().expect("written")).expect("read back");
    assert_eq!(back.data().analytic, *all);
}

/// A spot under a node that is turned by a right angle about x: its scale neither turns nor moves it; where it leaves no
/// directions, it shines along the world's -Z.
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
        let followed = Instances::<AnyLight>::new::<(AnyNode, ()), 8>(&scene, 0, BuildParams::default());
        let (lights, mut instances) = followed.unwrap_or_else(|error| panic!("{scale:?}: {error}"));
        let world = lights.view().world_lights();
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
