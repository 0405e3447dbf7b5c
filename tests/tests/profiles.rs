//! Photometric lights: what they send by every way to render, from files and back.

use lightbvh_host::scene::{
    AnalyticKind, AnalyticLight, Material, Photometry, Profile, Scene, SceneData, Transform,
};
use lightbvh_tests::gltf_files::{changed, embedded, push, read_json, triangle};
use serde_json::json;

use crate::kinds_render::node;
use crate::textures::{along, plain_floor, reflects};

/// A file of a luminaire that shines to one side: a beam about 40° down, none above 80°.
fn uneven() -> Vec<u8> {
    let vertical: Vec<f64> = (0..=18).map(|k| 5.0 * f64::from(k)).collect();
    let horizontal: Vec<f64> = (0..=24).map(|k| 15.0 * f64::from(k)).collect();
    let list = |numbers: &[f64]| numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
    let mut text = format!(
        "IES:LM-63-2019\nTILT=NONE\n1 -1 1 19 25 1 2 0 0 0\n1 1 20\n{}\n{}\n",
        list(&vertical),
        list(&horizontal)
    );
    for h in &horizontal {
        let row: Vec<f64> = vertical
            .iter()
            .map(|v| {
                let side = 1.0 + 0.8 * h.to_radians().cos() + 0.1 * h.to_radians().sin();
                let beam = (-(v - 40.0) * (v - 40.0) / 800.0).exp() + 0.2;
                if *v > 80.0 {
                    0.0
                } else {
                    (6.0 * side * beam * 1000.0).round() / 1000.0
                }
            })
            .collect();
        text += &list(&row);
        text += "\n";
    }
    text.into_bytes()
}

fn profile() -> Profile {
    Profile::read(String::from("uneven"), uneven()).expect("a sound file")
}

/// Adds two lamps with a profile, one of them turned and mirrored.
pub fn hang(data: &mut SceneData) {
    let index = data.profiles.len() as u32;
    data.profiles.push(profile());
    for (translation, scale) in [([0.3, 2.8, 0.5], [1.0; 3]), ([-1.4, 2.2, -0.8], [0.5, -0.7, 0.4])] {
        let half = std::f32::consts::FRAC_1_SQRT_2;
        let place = Transform::Trs {
            translation,
            rotation: [-half, 0.0, 0.0, half],
            scale,
        };
        data.nodes.push(node(place, None));
        data.analytic.push(AnalyticLight {
            name: String::from("measured"),
            node: data.nodes.len() as u32 - 1,
            kind: AnalyticKind::profile(index, &data.profiles[index as usize]),
            color: [1.0, 0.7, 0.5],
            intensity: 0.6,
            range: None,
        });
    }
}

/// At several places beneath a lamp that is turned, all ways to render find the candela of the table.
#[test]
fn floors_get_what_the_table_says() {
    let table = Photometry::read(&uneven()).expect("a sound file");
    for [aim, height] in [[0.0_f64, 2.0], [1.3, 2.0], [-1.1, 1.5], [9.0, 1.0]] {
        let mut data = plain_floor([aim as f32, 12.0]);
        data.profiles.push(profile());
        // Above the origin; its -Z leans.
        let lean = [3.0_f64, -9.0, 2.0].map(|x| x / 94.0_f64.sqrt());
        let Transform::Matrix([x, y, z, _]) = along(lean) else {
            unreachable!("a matrix");
        };
        let place = Transform::Matrix([x, y, z, [0.0, height as f32, 0.0]]);
        data.nodes.push(node(place, None));
        data.analytic.push(AnalyticLight {
            name: String::from("measured"),
            node: data.nodes.len() as u32 - 1,
            kind: AnalyticKind::profile(0, &data.profiles[0]),
            color: [1.0, 0.5, 0.25],
            intensity: 2.0,
            range: None,
        });
        let d = [aim, -height, 0.0];
        let squared: f64 = d.iter().map(|x| x * x).sum();
        let component =
            |axis: [f32; 3]| axis.iter().zip(d).map(|(a, d)| f64::from(*a) * d).sum::<f64>() / squared.sqrt();
        let candela = table.candela([component(x), component(y), -component(z)]);
        let light = 2.0 * candela * height / squared.powf(1.5);
        // Pictures are of bytes and of means over texels: two hundredths of what is there.
        reflects(data, [light, 0.5 * light, 0.25 * light], [0.5; 3], 0.022);
    }
}

/// `EXT_lights_ies`: profiles by uri, lights by node, what is wrong left out with a note.
#[test]
fn files_name_profiles() {
    let mut root = triangle();
    root["extensionsUsed"] = json!(["EXT_lights_ies"]);
    root["extensionsRequired"] = json!(["EXT_lights_ies"]);
    root["extensions"] = json!({ "EXT_lights_ies": { "lights": [
        { "name": "uneven", "uri": embedded(&uneven()) },
        { "name": "broken", "uri": embedded(b"IESNA:LM-63-2002\nTILT=NONE\n1 2") },
        { "name": "empty" },
    ] } });
    let lit =
        |extension| json!({ "translation": [0.0, 1.0, 0.0], "extensions": { "EXT_lights_ies": extension } });
    for extension in [
        json!({ "light": 0 }),
        json!({ "light": 0, "multiplier": 2.5, "color": [1.0, 0.5, 0.0] }),
        json!({ "light": 1 }),
        json!({ "light": 1 }),
        json!({ "light": 2 }),
        json!({ "light": 3 }),
        json!({ "light": 0, "multiplier": -1.0 }),
    ] {
        let at = root["nodes"].as_array().expect("nodes").len();
        push(&mut root["nodes"], lit(extension));
        push(&mut root["scenes"][0]["nodes"], json!(at));
    }
    let scene = read_json(&root).expect("a sound file");
    let data = scene.data();
    assert_eq!(data.profiles.len(), 1);
    let found: Vec<_> = data
        .analytic
        .iter()
        .map(|own| (own.intensity, own.color))
        .collect();
    assert_eq!(found, [(1.0, [1.0; 3]), (2.5, [1.0, 0.5, 0.0])]);
    let warned = |part: &str| scene.warnings().iter().filter(|own| own.contains(part)).count();
    assert_eq!(
        warned("profile 1 (EXT_lights_ies) is left out"),
        1,
        "{:?}",
        scene.warnings()
    );
    assert_eq!(warned("profile 2 (EXT_lights_ies) is left out"), 1);
    assert_eq!(warned("profile 3 (EXT_lights_ies) is left out"), 1);
    assert_eq!(warned("negative or not finite"), 1);
    // A required extension that cannot be read is an error.
    let wrong = changed(
        "/nodes/0/extensions",
        json!({ "EXT_lights_ies": { "light": "first" } }),
    );
    assert!(read_json(&wrong).is_ok(), "it is not required there");
}

/// A scene with profiles that is written and read again has the same lights and pictures.
#[test]
fn profiles_survive_a_file() {
    let mut data = SceneData {
        materials: vec![Material::default()],
        ..plain_floor([0.0, 12.0])
    };
    hang(&mut data);
    let scene = Scene::new(data).expect("a sound scene");
    assert!(scene.has_kinds());
    let back =
        Scene::read_gltf_slice("back.glb", &scene.to_glb().expect("written"), None).expect("read back");
    assert_eq!(scene.data().profiles, back.data().profiles);
    let lights = |scene: &Scene| scene.frame(3).lights::<lightbvh::light::AnyLight>();
    assert_eq!(lights(&scene), lights(&back));
    // Without textures, profiles stay.
    let plain = scene.clone().unpainted();
    assert_eq!(plain.frame(0).paint, scene.frame(0).paint);
}
