//! Requirements of scenes, on small files that differ in one thing each.

use serde_json::{Value, json};

use crate::model::{self, Clip, Keys, LAMP};
use crate::program::{Folder, json as report, refused, run};

/// Writes a floor of two triangles and twelve lamps of two triangles each above it, which emit so much on both sides; returns the
/// path.
fn room(folder: &Folder, name: &str, emits: f32, clips: &[Clip]) -> String {
    model::write_lamps(folder, name, 12, clips, |root| {
        root["scenes"][0]["nodes"] = json!([0, 1]);
        root["nodes"][0]["translation"] = json!([0, -3, 0]);
        root["nodes"][1] = json!({ "mesh": 1, "name": "lamps" });
        let emissive = [emits; 3];
        root["materials"][1] = json!({ "emissiveFactor": emissive, "doubleSided": true });
    })
}

/// A clip that moves the lamps for a second.
fn moving(name: &str) -> Clip {
    let keys = [(0.0, [0.0; 3]), (1.0, [1.0, 0.5, 0.0])];
    (name.to_owned(), vec![Keys::new(LAMP, "translation", &keys)])
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
    // One for each part of the model, and what follows from the wet road.
    let reasons = moving["reasons"].as_array().expect("reasons");
    assert_eq!(reasons.len(), 3);
    assert!(
        reasons[2]
            .as_str()
            .is_some_and(|reason| reason.starts_with("glossy surfaces"))
    );
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
        "Bvh<TwoSidedMomentNode<8>, Defensive<Moments, 6>, 8>"
    );
    assert_eq!(found["model"]["levels"], 1);
    assert_eq!(step(&found, "layout")["promise"], "bits");
    assert_eq!(step(&found, "levels")["promise"], "bits-below-instance");
    let command = found["kernels"]["command"].as_str().expect("a command");
    assert!(
        command.contains("--layout two-sided --width 8 --share 6"),
        "{command}"
    );
}

#[test]
fn points_without_light_have_no_figure() {
    let folder = Folder::new("inspect-unlit");
    // Lamps that shine up, where nothing is.
    let path = model::write(&folder, "unlit", &[], |root| {
        root["scenes"][0]["nodes"] = json!([0, 1]);
        root["nodes"][1]["rotation"] = json!([1, 0, 0, 0]);
    });
    let found = report(&format!("inspect {path} --json"));
    assert_eq!(
        (&found["holds"], &found["default"]["variance"]),
        (&json!(true), &Value::Null)
    );
    assert!(!found["steps"].as_array().expect("steps").is_empty());
}

#[test]
fn words_are_for_people() {
    let folder = Folder::new("inspect-words");
    let path = room(&folder, "room", 1.0, &[]);
    let output = run(&format!("inspect {path} --points 16"));
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{said}");
    for words in [
        "of 24 triangles 0 shine from one side",
        "  layout: ",
        "  levels: one, because one mesh",
        "kernels for devices: not committed",
        "saved against the default: ",
        "model, as chosen: ",
    ] {
        assert!(said.contains(words), "{words} in\n{said}");
    }
}

/// The same animation twice, and before them one of the same name that keeps all where it is.
fn with_clips(folder: &Folder) -> String {
    let still = vec![Keys::new(LAMP, "translation", &[(0.0, [0.0; 3])])];
    let clips = [("Idle".to_owned(), still), moving("Walk"), moving("Idle")];
    room(folder, "clips", 1.0, &clips)
}

/// A file does not say which of its animations is shown: a lamp that a later one moves does move.
#[test]
fn each_animation_is_looked_at() {
    let folder = Folder::new("clips");
    let path = with_clips(&folder);
    let report = report(&format!("inspect {path} --points 16 --json"));
    assert_eq!(report["motion"], json!({ "moving": 1, "bending": 0 }));
    let shown: Vec<&Value> = report["animations"]
        .as_array()
        .expect("animations")
        .iter()
        .map(|own| &own["shown"])
        .collect();
    assert_eq!(shown, [true, false, false]);
    let dark = room(&folder, "dark", 0.0, &[]);
    let said = refused(&format!("inspect {dark}"));
    assert!(said.contains("dark"), "{said}");
}

/// As many and in the order as the file has them.
#[test]
fn written_file_keeps_all_animations() {
    let folder = Folder::new("chosen");
    let path = with_clips(&folder);
    let written = folder.file("written.glb");
    assert!(run(&format!("export {path} -o {written}")).status.success());
    let bytes = std::fs::read(&written).expect("a scene");
    let length = u32::from_le_bytes(bytes[12..16].try_into().expect("four")) as usize;
    let root: Value = serde_json::from_slice(&bytes[20..20 + length]).expect("JSON");
    let clips = root["animations"].as_array().expect("a list");
    let names: Vec<&Value> = clips.iter().map(|clip| &clip["name"]).collect();
    assert_eq!(names, ["Idle", "Walk", "Idle"]);
}
