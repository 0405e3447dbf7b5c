//! Requirements of scenes, on small files that differ in one thing each.

use serde_json::{Value, json};

use crate::model::{self, Clip, Keys, LAMP};
use crate::program::{Folder, json as report, refused, run};

/// A floor of two triangles, and lamps of two triangles each above it.
struct Room {
    lamps: usize,
    /// Whether the last of them shines from one side; it is a primitive, so a mesh light, of its own.
    has_one_sided: bool,
    /// Column-major, of the lamps' node.
    matrix: Option<[f32; 16]>,
    /// Whether the lamps' node moves.
    moves: bool,
    emits: f32,
}

impl Default for Room {
    fn default() -> Self {
        Self {
            lamps: 12,
            has_one_sided: false,
            matrix: None,
            moves: false,
            emits: 1.0,
        }
    }
}

impl Room {
    /// Writes the room as glTF and returns its path.
    fn write(&self, folder: &Folder, name: &str) -> String {
        let clips = match self.moves {
            true => vec![moving("")],
            false => Vec::new(),
        };
        self.write_with(folder, name, &clips)
    }

    fn write_with(&self, folder: &Folder, name: &str, clips: &[Clip]) -> String {
        model::write_lamps(folder, name, self.lamps, clips, |root| {
            root["scenes"][0]["nodes"] = json!([0, 1]);
            root["nodes"][0]["translation"] = json!([0, -3, 0]);
            root["nodes"][1] = json!({ "mesh": 1, "name": "lamps" });
            if let Some(matrix) = self.matrix {
                root["nodes"][1]["matrix"] = json!(matrix);
            }
            let emissive = [self.emits; 3];
            root["materials"][1] = json!({ "emissiveFactor": emissive, "doubleSided": true });
            if self.has_one_sided {
                let mut last = root["accessors"][1].clone();
                root["accessors"][1]["count"] = json!(6 * (self.lamps - 1));
                // Behind the floor and the other lamps, 72 bytes each.
                last["byteOffset"] = json!(72 * self.lamps);
                last["count"] = json!(6);
                let accessors = root["accessors"].as_array_mut().expect("a list");
                accessors.push(last);
                let primitive = json!({ "attributes": { "POSITION": accessors.len() - 1 }, "material": 2 });
                let primitives = root["meshes"][1]["primitives"].as_array_mut();
                primitives.expect("a list").push(primitive);
                let materials = root["materials"].as_array_mut();
                materials
                    .expect("a list")
                    .push(json!({ "emissiveFactor": emissive }));
            }
        })
    }
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
            assert!(step["compared"].as_u64() > Some(0), "{step}");
        }
        for figure in ["variance", "bytes_per_light", "memory_per_light"] {
            let found = step[figure].as_f64();
            assert!(found.is_some_and(|x| x >= 0.0), "{figure}: {step}");
        }
    }
}

#[test]
fn built_in_scenes_that_stay_keep_no_triangles() {
    let moving = report("inspect street --json --points 16");
    assert_sound(&moving);
    assert_eq!(fact(&moving, "orientation"), "present");
    assert_eq!(fact(&moving, "one mesh"), "no");
    assert_eq!(moving["model"]["updates"], "all");
    assert_eq!(moving["checked_frame"], 1);
    assert_eq!(moving["kernels"]["committed"], true);
    // One for each part of the model, and what follows from the wet road.
    let reasons = moving["reasons"].as_array().expect("reasons");
    assert_eq!(reasons.len(), 4);
    assert!(
        reasons[3]
            .as_str()
            .is_some_and(|reason| reason.starts_with("glossy surfaces"))
    );
    let saved = |report: &Value| report["saved"]["memory_per_light"].as_f64().expect("bytes");
    let still = report("inspect street --json --points 16 --static");
    assert_sound(&still);
    assert_eq!(still["model"]["updates"], "nothing");
    assert_eq!(still["checked_frame"], 0);
    assert!(saved(&still) > 5.0 && saved(&moving) == 0.0);
    // Nothing is left out where anything may change.
    let anything = report("inspect street --json --points 16 --changes triangles,meshes");
    assert_eq!(anything["steps"], json!([]));
    assert_eq!(anything["saved"]["memory_per_light"], 0.0);
}

#[test]
fn one_mesh_of_two_sided_lamps_needs_neither_normals_nor_a_top_level() {
    let folder = Folder::new("inspect");
    let path = Room::default().write(&folder, "room");
    let found = report(&format!("inspect {path} --json"));
    assert_sound(&found);
    assert_eq!(fact(&found, "two-sided only"), "yes");
    assert_eq!(fact(&found, "one mesh"), "yes");
    assert_eq!(
        found["model"]["type"],
        "StaticBvh<TwoSidedMomentNode<8>, Defensive<Moments, 6>, 8>"
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
fn each_difference_is_found() {
    let folder = Folder::new("inspect-differences");
    let of = |name: &str, room: Room| {
        let path = room.write(&folder, name);
        let found = report(&format!("inspect {path} --json --points 64"));
        assert_sound(&found);
        found
    };
    let default = Room::default;
    let found = of(
        "moves",
        Room {
            moves: true,
            ..default()
        },
    );
    assert_eq!(found["motion"]["moving"], 1);
    assert_eq!(found["model"]["levels"], 2);
    assert_eq!(
        found["model"]["type"],
        "Bvh<TwoSidedMomentNode<8>, Defensive<Moments, 6>, 8>"
    );
    let found = of(
        "all-but-one",
        Room {
            has_one_sided: true,
            ..default()
        },
    );
    assert_eq!(fact(&found, "orientation"), "present");
    assert_eq!(found["model"]["layout"], "moments");
    let reason = found["reasons"][0].as_str().expect("a sentence");
    assert!(
        reason.contains("2 of 24 triangles shine from one side"),
        "{reason}"
    );
    let mut sheared = [0.0; 16];
    for k in 0..4 {
        sheared[5 * k] = 1.0;
    }
    sheared[4] = 0.5;
    let found = of(
        "sheared",
        Room {
            matrix: Some(sheared),
            ..default()
        },
    );
    // Another tree: kept where variance allows it, else put back.
    let levels = step(&found, "levels");
    assert_eq!(levels["promise"], "variance");
    assert_eq!(levels["put_back"] == json!(true), found["model"]["levels"] == 2);
}

#[test]
fn words_are_for_people() {
    let folder = Folder::new("inspect-words");
    let path = Room::default().write(&folder, "room");
    let output = run(&format!("inspect {path} --points 16"));
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{said}");
    for words in [
        "24 of 24 triangles shine from both sides",
        "  layout: ",
        "  levels: one, because one mesh",
        "  updates: nothing changes",
        "kernels for devices: not committed",
        "saved against the default: ",
        "model, as chosen: ",
    ] {
        assert!(said.contains(words), "{words} in\n{said}");
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let folder = Folder::new("inspect-refused");
    let dark = Room {
        emits: 0.0,
        ..Room::default()
    };
    let dark = dark.write(&folder, "dark");
    let said = refused(&format!("inspect {dark}"));
    assert!(said.contains("dark"), "{said}");
    let broken = Room::default().write(&folder, "broken");
    let buffer = folder.file("broken.bin");
    let mut bytes = std::fs::read(&buffer).expect("the buffer");
    bytes[100..104].copy_from_slice(&f32::NAN.to_le_bytes());
    std::fs::write(&buffer, bytes).expect("the buffer");
    let said = refused(&format!("inspect {broken}"));
    assert!(said.contains("NaN"), "{said}");
    for (options, words) in [
        ("--static --changes radiance", "--changes"),
        ("--points 0", "--points"),
    ] {
        let said = refused(&format!("inspect street {options}"));
        assert!(said.contains(words), "{options}: {said}");
    }
}

/// The same animation twice, and before them one of the same name that keeps all where it is.
fn with_clips(folder: &Folder) -> String {
    let still = vec![Keys::new(LAMP, "translation", &[(0.0, [0.0; 3])])];
    let clips = [("Idle".to_owned(), still), moving("Walk"), moving("Idle")];
    Room::default().write_with(folder, "clips", &clips)
}

/// A file does not say which of its animations is shown: a lamp that a later one moves does move.
#[test]
fn each_animation_is_looked_at() {
    let folder = Folder::new("clips");
    let path = with_clips(&folder);
    let report = report(&format!("inspect {path} --points 16 --json"));
    assert_eq!(report["motion"], json!({ "moving": 1, "bending": 0 }));
    assert_eq!(report["model"]["updates"], "all");
    let shown: Vec<&Value> = report["animations"]
        .as_array()
        .expect("animations")
        .iter()
        .map(|own| &own["shown"])
        .collect();
    assert_eq!(shown, [true, false, false]);
}

/// By a name or by a number, and as many and in the order as the file has them in a file that is written.
#[test]
fn an_animation_is_chosen_and_all_are_kept() {
    let folder = Folder::new("chosen");
    let path = with_clips(&folder);
    let image = |options: &str| {
        let file = folder.file("image.exr");
        let small = "--width 48 --height 27 --spp 2 --frame 12 --look-from 0,4,9 --look-at 0,1,0";
        let output = run(&format!("render {path} {small} {options} -o {file}"));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{said}");
        (std::fs::read(&file).expect("an image"), said)
    };
    let (idle, said) = image("");
    assert!(said.contains("animations 1 \"Walk\", 2 \"Idle\""), "{said}");
    assert!(image("--animation Idle").0 == idle && image("--animation 0").0 == idle);
    let walks = image("--animation Walk").0;
    assert!(walks != idle && image("--animation 2").0 == walks);
    let said = refused(&format!(
        "render {path} --animation 3 -o {}",
        folder.file("no.png")
    ));
    assert!(said.contains("0 \"Idle\", 1 \"Walk\", 2 \"Idle\""), "{said}");

    for other in ["clips.gltf", "clips.png", "clips"] {
        let said = refused(&format!("export {path} -o {}", folder.file(other)));
        assert!(said.contains("ends in .glb"), "{said}");
    }
    let written = folder.file("written.glb");
    assert!(run(&format!("export {path} -o {written}")).status.success());
    let bytes = std::fs::read(&written).expect("a scene");
    let length = u32::from_le_bytes(bytes[12..16].try_into().expect("four")) as usize;
    let root: Value = serde_json::from_slice(&bytes[20..20 + length]).expect("JSON");
    let clips = root["animations"].as_array().expect("a list");
    let names: Vec<&Value> = clips.iter().map(|clip| &clip["name"]).collect();
    assert_eq!(names, ["Idle", "Walk", "Idle"]);
}
