//! Sequences of pictures.

use std::path::Path;

use crate::model::{self, Keys, LAMP};
use crate::program::{Folder, json, refused, run};

#[test]
fn sequences_are_numbered_and_hold_what_single_frames_do() {
    let folder = Folder::new("animate");
    let small = "--width 32 --height 18 --spp 2 --backend cpu --json";
    for sampler in ["power", "two-level"] {
        let out = folder.file(&format!("{sampler}.exr"));
        let line = format!("render street --sampler {sampler} --animate 0..3 -o {out} {small}");
        let report = json(&line);
        let frames = report["frames"].as_array().expect("frames");
        assert_eq!(frames.len(), 3);
        for (number, frame) in (0..).zip(frames) {
            let file = folder.file(&format!("{sampler}-000{number}.exr"));
            assert_eq!(
                (&frame["frame"], &frame["output"]),
                (&number.into(), &file.as_str().into())
            );
            assert!(Path::new(&file).exists());
        }
        assert!(!Path::new(&out).exists());
        // Nothing is carried from frame to frame without a tree.
        if sampler == "power" {
            let single = folder.file("single.exr");
            json(&format!(
                "render street --sampler power --frame 2 -o {single} {small}"
            ));
            let last = std::fs::read(folder.file("power-0002.exr")).expect("an image");
            assert!(last == std::fs::read(&single).expect("an image"));
        }
    }
    let last = folder.file("last.exr");
    json(&format!("render street --frame 4294967295 -o {last} {small}"));
    let image = folder.file("refused.png");
    for wrong in ["--animate 3", "--animate 0..2 --frame 1"] {
        let said = refused(&format!("render street {wrong} -o {image}"));
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

/// The names of animations come from files: they are cut, and hold no control characters.
#[test]
fn animations_are_named_in_errors() {
    let folder = Folder::new("clips");
    let moved = |to: f32| {
        let keys = [(0.0, [0.0, 2.0, 0.0]), (1.0, [to, 2.0, 0.0])];
        vec![Keys::new(LAMP, "translation", &keys)]
    };
    let mut clips = [
        (String::from("base"), moved(1.0)),
        ("x".repeat(5000), moved(2.0)),
        (String::from("\u{1b}[31mbad"), moved(3.0)),
    ];
    let small = format!("--width 16 --height 12 --spp 1 -o {}", folder.file("a.png"));
    let path = model::write(&folder, "long", &clips[..2], |_| ());
    let output = run(&format!("render {path} {small}"));
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        output.status.success() && said.contains("animation 1 ") && said.len() < 2000,
        "{said}"
    );
    clips.swap(0, 2);
    clips[0].1[0].keys.reverse();
    let path = model::write(&folder, "broken", &clips, |_| ());
    let said = refused(&format!("render {path} {small}"));
    assert!(
        said.contains("animation 0 ") && !said.contains('\u{1b}'),
        "{said}"
    );
}
