//! Refusals and their words.

use std::path::Path;
use std::process::{Command, Stdio};

use crate::program::{Folder, has_device, refused};

#[test]
fn bad_input_is_refused_with_what_where_and_what_to_do() {
    let folder = Folder::new("refused");
    let image = folder.file("image.png");
    // A folder that cannot be made is found before anything is measured.
    let file = folder.file("file");
    std::fs::write(&file, "no folder").expect("a file");
    let (report, images) = (format!("{file}/report"), folder.file("images"));
    let finite = "no finite number above 0";
    for (line, words) in [
        ("render streets", ["streets", "street, square, carousel"]),
        ("render no/such/file.glb", ["no/such/file.glb", ""]),
        ("render street --spp 0", ["--spp", "1..=65536"]),
        ("render street --width 100000", ["--width", "100000"]),
        ("render street --sampler best", ["best", ""]),
        ("render street --exposure NaN", [finite, ""]),
        // Options without effect.
        ("render street --device 0", ["--backend vulkan", ""]),
        (
            "render street --look-from 1,1,1 --look-at 1,1,1",
            ["--look-at needs another place", ""],
        ),
        (
            "render street --sampler two-level-moments-resampled --integrator path",
            ["without candidates", ""],
        ),
        ("trade --quick --out REPORT", ["file/report", "--out"]),
        ("demo --height 0 --out IMAGES", ["--height", ""]),
        ("bench --lights 0", ["--lights", "0 is not in"]),
        ("bench --queries 0", ["--queries", "0 is not in"]),
        ("compare --frames 100001", ["100001 is not in", ""]),
        ("compare --reference-samples 1", ["--reference-samples", ""]),
        ("verify --frames 5..5", ["--frames", "0..150"]),
        ("inspect street --static --changes radiance", ["--changes", ""]),
        ("inspect street --points 0", ["--points", ""]),
    ] {
        let line = line.replace("REPORT", &report).replace("IMAGES", &images);
        let line = match line.starts_with("render") {
            true => format!("{line} -o {image}"),
            false => line,
        };
        let said = refused(&line);
        assert!(words.iter().all(|word| said.contains(word)), "{line}: {said}");
    }
    assert!(!Path::new(&image).exists() && !Path::new(&images).exists());

    // Before the scene is read, which is not there.
    std::fs::create_dir_all(folder.file("folder.png")).expect("a folder");
    std::fs::create_dir_all(folder.file("folder.glb")).expect("a folder");
    for (name, said_of) in [
        ("image.jpg", ".png or .exr"),
        ("no/such/image.png", "folder"),
        ("file/image.png", "folder"),
        ("folder.png", "folder"),
    ] {
        let output = folder.file(name);
        let said = refused(&format!("render no/such.glb -o {output}"));
        assert!(said.contains(&output) && said.contains(said_of), "{said}");
    }
    for (name, said_of) in [
        ("a.gltf", "that ends in .glb"),
        ("no/such/a.glb", "folder"),
        ("folder.glb", "folder"),
    ] {
        let output = folder.file(name);
        let said = refused(&format!("export no/such.glb -o {output}"));
        assert!(said.contains(&output) && said.contains(said_of), "{said}");
    }
    if has_device() {
        let said = refused("verify --queries 1 --device no-such-device");
        assert!(said.contains("no-such-device"), "{said}");
    }
}

/// `head` closes a table; an object that is cut is none.
#[test]
fn closed_output_fails_for_json_alone() {
    let code = |line: &str| {
        let mut child = Command::new(env!("CARGO_BIN_EXE_lightbvh"))
            .args(line.split(' '))
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("the program starts");
        drop(child.stdout.take());
        child.wait().expect("it ends").code()
    };
    assert_eq!((code("info"), code("info --json")), (Some(0), Some(2)));
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_is_an_error() {
    let full = std::fs::File::create("/dev/full").expect("a device that is always full");
    let mut program = Command::new(env!("CARGO_BIN_EXE_lightbvh"));
    let output = program
        .arg("info")
        .stdout(full)
        .output()
        .expect("the program starts");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("cannot write to standard output"), "{said}");
}

#[test]
fn options_are_taken_where_they_apply() {
    for (line, option) in [
        ("inspect street --device 0", "--device"),
        ("export street -o street.glb --json", "--json"),
        ("bench --dynamic --device 0", "--device"),
        ("trade --device 0", "--device"),
        ("verify --soak 0", "0 is not in 100..="),
        ("verify --soak 100 --instances 0", "--instances"),
        ("verify --soak 100 --mesh-triangles 0", "--mesh-triangles"),
        ("verify --instances 10", "--soak"),
        ("verify --soak 100 --queries 5", "cannot be used with"),
    ] {
        let said = refused(line);
        assert!(said.contains(option), "{line}: {said}");
    }
}
