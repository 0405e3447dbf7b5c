//! Requirements of scenes, on small files that differ in one thing each.

use serde_json::{Value, json};

use crate::model::{self, Clip};
use crate::program::{Folder, json as report, refused, run};

/// Writes a floor of two triangles and twelve lamps of two triangles each above it, which emit so much on both sides; returns the
/// path.
fn room(folder: &Folder, name: &str, emits: f32, clips: &[Clip]) -> String {
    model::write(folder, name, 12, clips, |root| {
        root["scenes"][0]["nodes"] = json!([0, 1]);
        root["nodes"][0]["translation"] = json!([0, -3, 0]);
        root["nodes"][1] = json!({ "mesh": 1, "name": "lamps" });
        let emissive = [emits; 3];
        root["materials"][1] = json!({ "emissiveFactor": emissive, "doubleSided": true });
    })
}

fn fact<'a>(report: &'a Value, name: &str) -> &'a Value {
    let facts = report["facts"].as_array().expect("facts");
    let fact = facts.iter().find(|fact| fact["name"] == name);
    &fact.unwrap_or_else(|| panic!("no fact {name}"))["found"]
}

fn step<'a>(report: &'a Value, part: &str) -> &'a Value {
    let steps = report["steps"].as_array().expect("steps");
    let step = steps.iter().find(|step| step["part"] == part);
    step.unwrap_or_else(|| panic!("no step {part} in {steps:?}"))
}

/// Everything that is said of costs is a number, and bits are equal where that is promised.
fn assert_sound(report: &Value) {
    assert_eq!(report["holds"], true);
    for step in report["steps"].as_array().expect("steps") {
        if step["promise"] != "variance" {
            assert_eq!(step["different"], 0, "{step}");
        }
        if step["part"] == "layout" || step["part"] == "levels" {
            assert!(step["compared"].as_u64() > Some(0), "{step}");
        }
        for figure in ["variance", "bytes_per_light", "memory_per_light"] {
            let found = step[figure].as_f64();
            assert!(found.is_some_and(|x| x >= 0.0), "{figure}: {step}");
        }
    }
}

#[test]
fn built_in_scenes_are_checked_still_and_moving() {
    let moving = report("inspect street --json --points 16");
    assert_sound(&moving);
    assert_eq!(fact(&moving, "two-sided only"), "no");
    assert_eq!(fact(&moving, "one mesh"), "no");
    assert_eq!(moving["checked_frame"], 1);
    assert_eq!(moving["kernels"]["committed"], true);
    let still = report("inspect street --json --points 16 --static");
    assert_sound(&still);
    assert_eq!(still["checked_frame"], 0);
    // Nothing is left out where anything may change.
    let anything = report("inspect street --json --points 16 --changes triangles,meshes");
    assert_eq!(anything["steps"], json!([]));
    assert_eq!(anything["saved"]["memory_per_light"], 0.0);
}

#[test]
fn one_mesh_of_two_sided_lamps_needs_neither_normals_nor_a_top_level() {
    let folder = Folder::new("inspect");
    let path = room(&folder, "room", 1.0, &[]);
    let found = report(&format!("inspect {path} --json"));
    assert_sound(&found);
    assert_eq!(fact(&found, "two-sided only"), "yes");
    assert_eq!(fact(&found, "one mesh"), "yes");
    assert_eq!(
        found["model"]["type"],
        "Bvh<(TwoSidedMomentNode<8>, DefaultImportance)>"
    );
    assert_eq!(found["model"]["levels"], 1);
    assert_eq!(step(&found, "layout")["promise"], "bits");
    assert_eq!(step(&found, "levels")["promise"], "bits-below-instance");
    let command = found["kernels"]["command"].as_str().expect("a command");
    assert!(
        command.contains("--model '(TwoSidedMomentNode<8>, DefaultImportance)' --width 8"),
        "{command}"
    );
    let output = run(&format!("inspect {path} --points 16"));
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    for words in [
        "of 24 triangles 0 shine from one side",
        "  levels: one, because one mesh",
        "kernels for devices: not committed",
        "saved against the default: ",
        "model, as chosen: ",
    ] {
        assert!(said.contains(words), "{words} in\n{said}");
    }
}

/// The file does not say which of animations that move the same lamp is meant.
#[test]
fn first_animation_of_a_lamp_is_shown() {
    let folder = Folder::new("clips");
    let moves = [[0.0; 3], [1.0, 0.5, 0.0]];
    let path = room(&folder, "clips", 1.0, &[("Idle", &moves), ("Walk", &moves)]);
    let report = report(&format!("inspect {path} --points 16 --json"));
    assert_eq!(report["motion"], json!({ "moving": 1 }));
    assert_eq!(report["animations"], json!([{ "number": 0, "name": "Idle" }]));
    let dark = room(&folder, "dark", 0.0, &[]);
    let said = refused(&format!("inspect {dark}"));
    assert!(said.contains("dark"), "{said}");
}
