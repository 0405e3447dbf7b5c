//! Sequences of pictures.

use std::path::Path;

use crate::model::{self, Keys, LAMP};
use crate::program::{Folder, json, refused};

#[test]
fn sequences_are_numbered_and_hold_what_single_frames_do() {
    let folder = Folder::new("animate");
    // Nothing is carried from frame to frame without a tree.
    let small = "--sampler power --width 32 --height 18 --spp 2 --json";
    let out = folder.file("image.exr");
    let report = json(&format!("render street --animate 0..3 -o {out} {small}"));
    let frames = report["frames"].as_array().expect("frames");
    assert_eq!(frames.len(), 3);
    for (number, frame) in (0..).zip(frames) {
        let file = folder.file(&format!("image-000{number}.exr"));
        assert_eq!(
            (&frame["frame"], &frame["output"]),
            (&number.into(), &file.as_str().into())
        );
        assert!(Path::new(&file).exists());
    }
    assert!(!Path::new(&out).exists());
    json(&format!("render street --frame 2 -o {out} {small}"));
    let [last, single] =
        [&folder.file("image-0002.exr"), &out].map(|file| std::fs::read(file).expect("an image"));
    assert!(last == single);
    json(&format!("render street --frame 4294967295 -o {out} {small}"));
    for wrong in ["--animate 3", "--animate 0..2 --frame 1"] {
        let said = refused(&format!("render street {wrong} -o {out}"));
        assert!(said.contains("--animate"), "{said}");
    }
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
    let single = single["frames"][0]["exposure"].as_f64().expect("a number");
    assert_eq!(exposure(0), 1000.0);
    assert!(single < 1000.0, "{single}");
    assert!(
        (exposure(2) / single - 1.0).abs() < 0.05,
        "{single}: {}",
        exposure(2)
    );
    assert_eq!(exposure(3), exposure(2));
}
