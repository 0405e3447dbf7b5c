//! Scenes without emissive triangles: points and spots alone, suns alone, glass alone.

use serde_json::{Value, json};

use crate::program::{Folder, json as report, refused, run};

const NAME: &str = "KHR_lights_punctual";

/// A floor of one triangle, and lights over it.
struct Stage {
    lights: Value,
    material: Value,
}

impl Default for Stage {
    fn default() -> Self {
        Self {
            lights: json!([
                { "type": "point", "intensity": 5 },
                { "type": "point", "intensity": 2 },
                { "type": "spot", "intensity": 9, "spot": { "outerConeAngle": 0.5 } }
            ]),
            material: json!({}),
        }
    }
}

impl Stage {
    /// Writes it as glTF beside its buffer and returns its path.
    fn write(&self, folder: &Folder, name: &str) -> String {
        let floor = [-5.0_f32, 0.0, -5.0, -5.0, 0.0, 5.0, 5.0, 0.0, 5.0];
        let bytes: Vec<u8> = floor.iter().flat_map(|x| x.to_le_bytes()).collect();
        std::fs::write(folder.file(&format!("{name}.bin")), &bytes).expect("a buffer");
        let lights = self.lights.as_array().expect("a list");
        let mut nodes = vec![json!({ "mesh": 0 })];
        // The axes of spots and suns are turned downward: a rotation by a right angle, as its quaternion stands before it is
        // made a unit.
        nodes.extend((0..lights.len()).map(|k| {
            json!({
                "translation": [k as f32 - 3.0, 2.0 + k as f32, 2.0], "rotation": [-1, 0, 0, 1],
                "extensions": { NAME: { "light": k } }
            })
        }));
        let all: Vec<usize> = (0..nodes.len()).collect();
        let root = json!({
            "asset": { "version": "2.0" },
            "extensionsUsed": [NAME, "KHR_materials_transmission"],
            "extensions": { NAME: { "lights": self.lights } },
            "scene": 0,
            "scenes": [{ "nodes": all }],
            "nodes": nodes,
            "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "material": 0 }] }],
            "materials": [self.material],
            "accessors": [{
                "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-5, 0, -5], "max": [5, 0, 5]
            }],
            "bufferViews": [{ "buffer": 0, "byteLength": 36 }],
            "buffers": [{ "uri": format!("{name}.bin"), "byteLength": 36 }]
        });
        let path = folder.file(&format!("{name}.gltf"));
        std::fs::write(&path, root.to_string()).expect("a scene");
        path
    }
}

#[test]
fn scenes_of_points_and_spots_are_validated_inspected_and_measured() {
    let folder = Folder::new("kinds");
    let path = Stage::default().write(&folder, "points");
    let found = report(&format!("validate {path} --json"));
    assert_eq!(found["valid"], true);
    let rows = found["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 8);
    assert!(rows.iter().all(|row| row["lights"] == 3), "{rows:?}");

    let found = report(&format!("inspect {path} --points 40 --json"));
    assert_eq!(found["holds"], true);
    assert_eq!(found["kinds"]["said"], "2 points, 1 spot");
    assert_eq!(found["kinds"]["node"], "Lit<SpotMomentNode<8>, AnyLight>");
    assert_eq!(found["checked"]["probabilities"], 120);
    assert_eq!(found["checked"]["unreached"], 0);
    let said = run(&format!("inspect {path} --points 40"));
    let said = String::from_utf8_lossy(&said.stdout).into_owned();
    assert!(said.contains("every invariant holds"), "{said}");

    let found = report(&format!("variance --scene {path} --points 40 --json"));
    let rows = found["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 4);
    for row in rows {
        // Some points choose a light that does not send them what the tree thinks.
        assert!(
            row["mean"].as_f64().is_some_and(|mean| mean > 0.0 && mean < 1.0),
            "{row}"
        );
    }
}

#[test]
fn suns_alone_leave_trees_empty() {
    let folder = Folder::new("sun");
    let sun = Stage {
        lights: json!([{ "type": "directional", "intensity": 3 }]),
        ..Stage::default()
    };
    let path = sun.write(&folder, "sun");
    let found = report(&format!("validate {path} --json"));
    assert_eq!(
        (&found["valid"], &found["rows"][0]["lights"]),
        (&json!(true), &json!(0))
    );
    assert_eq!(
        found["rows"][0]["bytes_per_light"].as_f64().map(f64::is_finite),
        Some(true)
    );
    let found = report(&format!("inspect {path} --json"));
    assert_eq!((&found["holds"], &found["suns"]), (&json!(true), &json!(1)));
    assert_eq!((&found["tree"], &found["checked"]), (&json!(null), &json!(null)));
    // It told of "0 probabilities" and of bytes per light of no light.
    let said = run(&format!("inspect {path}"));
    let said = String::from_utf8_lossy(&said.stdout).into_owned();
    assert!(
        said.contains("none; what lights the scene stands beside trees"),
        "{said}"
    );
    assert!(
        !said.contains("probabilities") && !said.contains("per light"),
        "{said}"
    );
}

#[test]
fn commands_for_triangles_say_which_commands_take_other_lights() {
    let folder = Folder::new("refused-kinds");
    let path = Stage::default().write(&folder, "points");
    let out = folder.file("out");
    for command in [
        format!("trade --quick --scene {path}"),
        format!("compare --quick --scene {path} --out {out}"),
        format!("variance --gloss --scene {path}"),
    ] {
        let said = refused(&command);
        for part in [
            "3 lights of other kinds",
            "`lightbvh render`",
            "`inspect`",
            "`validate`",
        ] {
            assert!(said.contains(part), "{command}: {said}");
        }
    }
    let said = refused(&format!("validate {path} --importance eq4"));
    assert!(said.contains("triangles alone"), "{said}");
    let said = refused(&format!("inspect {path} --layout full"));
    assert!(said.contains("--layout"), "{said}");
}

/// What is there is shown, though it is glass: a tint before the sky, or nothing but a note.
#[test]
fn glass_alone_is_rendered() {
    let folder = Folder::new("glass");
    let glass = |color: Value| {
        json!({
            "pbrMetallicRoughness": { "baseColorFactor": color },
            "extensions": { "KHR_materials_transmission": { "transmissionFactor": 1 } }
        })
    };
    let veil =
        json!({ "alphaMode": "BLEND", "pbrMetallicRoughness": { "baseColorFactor": [1, 0.2, 0.2, 0.12] } });
    for (name, material, is_noted) in [
        ("clear", glass(json!([1, 1, 1, 1])), true),
        ("tinted", glass(json!([1, 0.2, 0.2, 1])), false),
        ("veil", veil, false),
    ] {
        let stage = Stage {
            material,
            ..Stage::default()
        };
        let path = stage.write(&folder, name);
        let image = folder.file(&format!("{name}.png"));
        let output = run(&format!("render {path} --width 16 --height 9 --spp 1 -o {image}"));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{name}: {said}");
        assert!(std::path::Path::new(&image).exists(), "{name}");
        assert_eq!(
            said.contains("note: 1 triangle is clear glass, which shows nothing by itself"),
            is_noted,
            "{name}: {said}"
        );
    }
}
