//! Clips: how they are named, and what is said of those that cannot be shown.

use serde_json::{Value, json};

use crate::model::{self, Keys, LAMP, OUTSIDE};
use crate::program::{Folder, refused, run};

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

#[test]
fn a_clip_outside_of_the_scene_is_named() {
    let folder = Folder::new("outside");
    let clips = [
        (String::from("walk"), moved(OUTSIDE, 1.0)),
        (String::from("left"), moved(LAMP, -3.0)),
        (String::from("right"), moved(LAMP, 3.0)),
    ];
    let path = model::write(&folder, "outside", &clips, |_| ());
    let image = folder.file("a.png");
    for word in ["walk", "0"] {
        let said = refused(&format!("render {path} {SMALL} --animation {word} -o {image}"));
        assert!(said.contains("names nothing that moves"), "{word}: {said}");
    }
    // An animation may be named again.
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

/// Texts of a file may hold control characters.
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
