//! Scenes without emissive triangles: points and spots alone, directional lights alone.

use serde_json::{Value, json};

use crate::model::{self, FLOOR};
use crate::program::{Folder, json_on_cpu as report, refused};

const NAME: &str = "KHR_lights_punctual";

/// A floor, and lights of these kinds over it that shine down.
fn stage(folder: &Folder, name: &str, lights: &[Value]) -> String {
    model::write(folder, name, 1, &[], |root| {
        let nodes = root["nodes"].as_array_mut().expect("a list");
        let mut shown = vec![json!(FLOOR)];
        for k in 0..lights.len() {
            shown.push(json!(nodes.len()));
            // The axes of spots are turned downward: a rotation by a right angle, as its quaternion stands before it is
            // made a unit.
            nodes.push(json!({
                "translation": [k as f32 - 3.0, 2.0 + k as f32, 2.0], "rotation": [-1, 0, 0, 1],
                "extensions": { NAME: { "light": k } }
            }));
        }
        root["scenes"][0]["nodes"] = json!(shown);
        root["extensionsUsed"] = json!([NAME]);
        root["extensions"] = json!({ NAME: { "lights": lights } });
    })
}

fn points(folder: &Folder, name: &str) -> String {
    let lights = [
        json!({ "type": "point", "intensity": 5 }),
        json!({ "type": "point", "intensity": 2 }),
        json!({ "type": "spot", "intensity": 9, "spot": { "outerConeAngle": 0.5 } }),
    ];
    stage(folder, name, &lights)
}

#[test]
fn scenes_of_points_and_spots_are_verified_and_inspected() {
    let folder = Folder::new("kinds");
    let path = points(&folder, "points");
    let found = report(&format!(
        "verify --scene {path} --queries 64 --frames 0..1 --json"
    ));
    assert_eq!(found["valid"], true);
    let rows = found["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 2);
    assert!(rows.iter().all(|row| row["lights"] == 3), "{rows:?}");

    let found = report(&format!("inspect {path} --json"));
    assert_eq!(found["kinds"]["said"], "2 PointLight, 1 SpotLight");
    assert_eq!(found["kinds"]["node"], "SpotMomentNode<8, AnyLight>");
}

#[test]
fn directional_lights_alone_are_refused() {
    let folder = Folder::new("directional");
    let sun = json!({ "type": "directional", "intensity": 3 });
    let path = stage(&folder, "directional", &[sun]);
    let said = refused(&format!("inspect {path}"));
    for part in ["it is directional", "no emissive triangle"] {
        assert!(said.contains(part), "{said}");
    }
}

#[test]
fn commands_for_triangles_say_which_commands_take_other_lights() {
    let folder = Folder::new("refused-kinds");
    let path = points(&folder, "points");
    for command in [
        format!("trade --quick --scene {path}"),
        format!("compare --quick --scene {path}"),
    ] {
        let said = refused(&command);
        for part in ["3 lights of other kinds", "`render`", "`inspect`"] {
            assert!(said.contains(part), "{command}: {said}");
        }
    }
}
