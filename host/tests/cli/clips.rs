//! Clips: how they are named, and what is said of those that cannot be shown.

use serde_json::{Value, json};

use crate::model::{self, FLOOR, Keys, LAMP, OUTSIDE};
use crate::program::{Folder, json as report, refused, run};

const SMALL: &str = "--width 16 --height 12 --spp 1";

fn moved(node: usize, to: f32) -> Vec<Keys> {
    vec![Keys::new(
        node,
        "translation",
        &[(0.0, [0.0, 2.0, 0.0]), (1.0, [to, 2.0, 0.0])],
    )]
}

fn said(line: &str) -> String {
    let output = run(line);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{line}: {said}");
    said
}

/// One jump, which lasts a frame, of the last of many long clips.
#[test]
fn a_lamp_that_jumps_once_in_one_of_many_clips_is_found() {
    let folder = Folder::new("jump");
    let still = || {
        vec![Keys::new(
            FLOOR,
            "translation",
            &[(0.0, [0.0; 3]), (4.0, [0.0, 0.1, 0.0])],
        )]
    };
    let mut clips: Vec<model::Clip> = (0..100).map(|k| (format!("clip {k}"), still())).collect();
    let low = [0.0, 2.0, 0.0];
    let jump = [
        (0.0, low),
        (0.1, low),
        (0.12, [0.0, 3.0, 0.0]),
        (0.14, low),
        (4.0, low),
    ];
    clips[99].1.push(Keys::new(LAMP, "translation", &jump));
    let path = model::write(&folder, "jump", &clips, |_| ());
    let found = report(&format!("inspect {path} --json --points 4"));
    assert_eq!(found["motion"]["moving"], 1, "{}", found["motion"]);
    assert_eq!(found["model"]["updates"], "instances");
}

#[test]
fn clips_that_are_not_looked_at_are_told() {
    let folder = Folder::new("not-looked-at");
    let mut clips: Vec<model::Clip> = (0..253)
        .map(|k| (format!("clip {k}"), moved(FLOOR, 0.1)))
        .collect();
    // The third of those that are left out goes back in time.
    clips[3].0 = String::from("\u{1b}[31mbad");
    clips[3].1[0].keys.reverse();
    let path = model::write(&folder, "many", &clips, |_| ());
    let output = run(&format!("inspect {path} --points 4"));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{text}");
    assert!(
        text.contains("2 animations beyond the first 250 were not looked at"),
        "{text}"
    );
    assert!(
        text.contains(r#"animation 3 "\u{1b}[31mbad" is left out"#),
        "{text}"
    );
    let found = report(&format!("inspect {path} --json --points 4"));
    assert_eq!(found["motion"]["beyond"], 2);
    let all = found["animations"].as_array().expect("animations");
    assert_eq!((all.len(), &all[3]["number"]), (253, &json!(3)));
    assert_eq!(
        (&all[0]["shown"], &all[1]["shown"]),
        (&json!(true), &json!(false))
    );
    // More keys of lamps than are looked at.
    let keys: Vec<(f32, [f32; 3])> = (0..9000_u16)
        .map(|k| (0.1 * f32::from(k), [0.0, 2.0, 0.0]))
        .collect();
    let clips = [0, 1].map(|k| (format!("clip {k}"), vec![Keys::new(LAMP, "translation", &keys)]));
    let path = model::write(&folder, "long", &clips, |_| ());
    let output = run(&format!("inspect {path} --points 4"));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.contains("were not all looked at"), "{text}");
}

#[test]
fn a_clip_outside_of_the_scene_is_named() {
    let folder = Folder::new("outside");
    let clips = [
        (String::from("walk"), moved(OUTSIDE, 1.0)),
        (String::from("left"), moved(LAMP, -3.0)),
        (String::from("right"), moved(LAMP, 3.0)),
    ];
    let path = model::write(&folder, "outside", &clips, |_| ());
    let told = said(&format!("export {path} -o {}", folder.file("out.glb")));
    assert!(
        told.contains(r#"animation 0 "walk" moves nothing of the scene"#),
        "{told}"
    );
    let image = folder.file("a.png");
    for word in ["walk", "0"] {
        let said = refused(&format!("render {path} {SMALL} --animation {word} -o {image}"));
        assert!(said.contains("moves nothing of the scene"), "{word}: {said}");
    }
    // What is named again is accepted.
    let twice = "--animation left --animation left --animation 1";
    said_nothing_of(
        &said(&format!("render {path} {SMALL} {twice} -o {image}")),
        "names nothing",
    );
}

fn said_nothing_of(said: &str, what: &str) {
    assert!(!said.contains(what), "{said}");
}

#[test]
fn a_broken_clip_is_named_by_its_number_in_the_file() {
    let folder = Folder::new("broken-clip");
    let mut clips = [
        (String::from("base"), moved(LAMP, 1.0)),
        (String::from("good"), moved(LAMP, 2.0)),
        (String::from("\u{1b}[31mbad"), moved(LAMP, 3.0)),
    ];
    clips[2].1[0].keys.reverse();
    let path = model::write(&folder, "broken", &clips, |_| ());
    let image = folder.file("a.png");
    let said = refused(&format!("render {path} {SMALL} --animation 2 -o {image}"));
    assert!(
        said.contains("animation 2 ") && !said.contains('\u{1b}'),
        "{said}"
    );
}

#[test]
fn long_names_are_cut_in_texts() {
    let folder = Folder::new("long-names");
    let clips = [0, 1].map(|k| (format!("{k}{}", "x".repeat(5000)), moved(LAMP, 1.0)));
    let path = model::write(&folder, "long", &clips, |_| ());
    let told = said(&format!("render {path} {SMALL} -o {}", folder.file("a.png")));
    assert!(
        told.contains("animation 1") && told.len() < 2000,
        "{} letters",
        told.len()
    );
}

/// What a file says may hold what a terminal obeys.
#[test]
fn what_a_terminal_obeys_is_not_printed() {
    let folder = Folder::new("terminal");
    let image = folder.file("a.png");
    let path = model::write(&folder, "extension", &[], |root: &mut Value| {
        root["extensionsUsed"] = json!(["\u{1b}[31mEXT\u{7}\u{202e}"]);
    });
    let told = said(&format!("render {path} {SMALL} -o {image}"));
    assert!(told.contains("EXT"), "{told}");
    let is_obeyed = |c: char| c.is_control() && c != '\n' || c == '\u{202e}';
    assert!(!told.contains(is_obeyed), "{told:?}");
    let object = folder.file("a.obj");
    let text = "mtllib \u{1b}[31mx.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl \u{1b}[31mzz\nf 1 2 3\n";
    std::fs::write(&object, text).expect("a file");
    for line in [
        format!("render {object} {SMALL} -o {image}"),
        format!("render \u{1b}[31mno.glb {SMALL} -o {image}"),
    ] {
        let told = String::from_utf8_lossy(&run(&line).stderr).into_owned();
        assert!(told.contains("[31m") && !told.contains(is_obeyed), "{told:?}");
    }
}
