//! Sequences of pictures.

use std::path::Path;

use crate::model::{self, Keys, LAMP};
use crate::program::{Folder, json, refused, run};

#[test]
fn sequences_are_numbered_and_hold_what_single_frames_do() {
    let folder = Folder::new("animate");
    let small = "--width 32 --height 18 --spp 2 --backend cpu --json";
    for sampler in ["power", "single-level-rebuilt", "two-level"] {
        let out = folder.file(&format!("{sampler}.exr"));
        let line = format!("render street --sampler {sampler} --animate 0..3 -o {out} {small}");
        let report = json(&line);
        let frames = report["frames"].as_array().expect("frames");
        assert_eq!(frames.len(), 3);
        for (number, frame) in (0..).zip(frames) {
            assert_eq!(frame["frame"], number);
            assert_eq!(
                frame["output"],
                folder.file(&format!("{sampler}-000{number}.exr"))
            );
            assert!(Path::new(frame["output"].as_str().expect("a path")).exists());
        }
        assert!(!Path::new(&out).exists());
        // Nothing is carried from frame to frame without a tree or with a new one.
        if sampler != "two-level" {
            let single = folder.file("single.exr");
            json(&format!(
                "render street --sampler {sampler} --frame 2 -o {single} {small}"
            ));
            let last = std::fs::read(folder.file(&format!("{sampler}-0002.exr"))).expect("an image");
            assert!(last == std::fs::read(&single).expect("an image"), "{sampler}");
        }
    }
    let image = folder.file("refused.png");
    for wrong in ["3", "3..3", "4..3", "a..b"] {
        let said = refused(&format!("render street --animate {wrong} -o {image}"));
        assert!(said.contains("--animate"), "{said}");
    }
    refused(&format!("render street --animate 0..2 --frame 1 -o {image}"));
}

#[test]
fn a_sequence_is_exposed_as_its_first_frame_that_shows_something() {
    let folder = Folder::new("exposed");
    let keys = [(0.0, [1e-5; 3]), (0.04, [1e-5; 3]), (0.2, [1.0; 3])];
    let clip = (String::from("fade"), vec![Keys::new(LAMP, "scale", &keys)]);
    let path = model::write(&folder, "fade", &[clip], |root| {
        root["scenes"][0]["nodes"] = serde_json::json!([0, 1, 4]);
        root["materials"][1]["extensions"] = serde_json::json!({
            "KHR_materials_emissive_strength": { "emissiveStrength": 20 }
        });
        root["extensionsUsed"] = serde_json::json!(["KHR_materials_emissive_strength"]);
    });
    let small = "--width 32 --height 24 --spp 4 --json";
    let out = folder.file("fade.png");
    let report = json(&format!("render {path} --animate 0..4 -o {out} {small}"));
    let exposure = |frame: usize| report["frames"][frame]["exposure"].as_f64().expect("a number");
    let single = json(&format!("render {path} --frame 2 -o {out} {small}"));
    let single = single["exposure"].as_f64().expect("a number");
    assert_eq!(exposure(0), 1000.0);
    assert!(single < 1000.0, "{single}");
    assert!(
        (exposure(2) / single - 1.0).abs() < 0.05,
        "{single}: {}",
        exposure(2)
    );
    assert_eq!(exposure(3), exposure(2));
}

#[test]
fn the_last_frame_of_all_is_rendered() {
    let folder = Folder::new("last");
    let keys = [(0.0, [0.0, 2.0, 0.0]), (1.0, [1.0, 2.0, 0.0])];
    let clip = (String::from("move"), vec![Keys::new(LAMP, "translation", &keys)]);
    let path = model::write(&folder, "last", &[clip], |_| ());
    let out = folder.file("last.png");
    let small = "--width 16 --height 12 --spp 1";
    let output = run(&format!("render {path} --frame 4294967295 -o {out} {small}"));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && Path::new(&out).exists(), "{said}");
}
