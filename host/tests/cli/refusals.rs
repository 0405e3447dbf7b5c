//! What is refused, and in which words.

use std::path::Path;
use std::process::{Command, Stdio};

use crate::program::{Folder, has_device, refused};

#[test]
fn bad_input_is_refused_with_what_where_and_what_to_do() {
    let folder = Folder::new("refused");
    let image = folder.file("image.png");
    let said = refused(&format!("render streets -o {image}"));
    assert!(
        said.contains("streets") && said.contains("street, square, carousel"),
        "{said}"
    );
    let said = refused(&format!("render no/such/file.glb -o {image}"));
    assert!(said.contains("no/such/file.glb"), "{said}");
    let said = refused(&format!("render street --spp 0 -o {image}"));
    assert!(said.contains("--spp") && said.contains("1..=65536"), "{said}");
    let said = refused(&format!("render street --width 100000 -o {image}"));
    assert!(said.contains("--width") && said.contains("100000"), "{said}");
    let said = refused(&format!(
        "render street --integrator path --bounces 65 -o {image}"
    ));
    assert!(
        said.contains("--bounces") && said.contains("65 is not in 1..=64"),
        "{said}"
    );
    // A folder that cannot be made is found before anything is measured.
    let file = folder.file("file");
    std::fs::write(&file, "no folder").expect("a file");
    let said = refused(&format!("trade --quick --out {file}/report"));
    assert!(said.contains("file/report") && said.contains("--out"), "{said}");
    // What would have no effect.
    for (options, needs) in [
        ("--bounces 3", "--integrator path"),
        ("--device 0", "--backend vulkan"),
        (
            "--sampler two-level-moments-resampled --integrator path",
            "without candidates",
        ),
    ] {
        let said = refused(&format!("render street {options} -o {image}"));
        assert!(said.contains(needs), "{options}: {said}");
    }
    let said = refused(&format!("render street --candidates 257 -o {image}"));
    assert!(said.contains("257 is not in 1..=256"), "{said}");
    let said = refused(&format!("demo --height 0 --out {}", folder.file("images")));
    assert!(
        said.contains("--height") && !folder.0.join("images").exists(),
        "{said}"
    );
    for option in ["--lights", "--queries"] {
        let said = refused(&format!("bench {option} 0"));
        assert!(said.contains(option) && said.contains("0 is not in"), "{said}");
    }
    refused(&format!("render street --sampler best -o {image}"));
    for budget in ["--time 0", "--time nan", "--error -1"] {
        let said = refused(&format!("trade {budget}"));
        assert!(said.contains("no finite number above 0"), "{said}");
    }
    refused("trade --time 5 --error 0.1");
    for exposure in ["0", "NaN", "inf"] {
        let said = refused(&format!("render street --exposure {exposure} -o {image}"));
        assert!(said.contains("no finite number above 0"), "{said}");
    }
    refused("verify --queries many");
    assert!(!Path::new(&image).exists());

    for output in [folder.file("no/such/folder/image.png"), folder.file("image.gif")] {
        let said = refused(&format!(
            "render street -o {output} --width 16 --height 9 --spp 1"
        ));
        assert!(said.contains(&output), "{said}");
    }
    // Before the scene is read, which is not there.
    std::fs::create_dir_all(folder.file("folder.png")).expect("a folder");
    std::fs::create_dir_all(folder.file("folder.glb")).expect("a folder");
    for (name, said_of) in [
        ("image.jpg", ".png or .exr"),
        ("image", ".png or .exr"),
        ("no/such/image.png", "folder"),
        ("file/image.png", "folder"),
        ("folder.png", "folder"),
    ] {
        let output = folder.file(name);
        let said = refused(&format!("render no/such.glb -o {output}"));
        assert!(said.contains(&output) && said.contains(said_of), "{said}");
        let said = refused(&format!("render no/such.glb --animate 0..3 -o {output}"));
        assert!(name == "folder.png" || said.contains(said_of), "{said}");
    }
    for (name, said_of) in [
        ("a.gltf", "that ends in .glb"),
        ("no/such/a.glb", "folder"),
        ("folder.glb", "folder"),
    ] {
        let output = folder.file(name);
        let said = refused(&format!("export no/such.glb -o {output}"));
        assert!(said.contains(&output) && said.contains(said_of), "{said}");
        assert!(!said.contains("names nothing"), "{said}");
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

#[test]
fn options_are_taken_where_they_apply() {
    for (line, option) in [
        ("inspect street --device 0", "--device"),
        ("inspect street --validation", "--validation"),
        ("export street -o street.glb --json", "--json"),
        ("bench --dynamic --device 0", "--device"),
        ("trade --variance --validation", "--validation"),
        ("trade --points 5", "--variance"),
    ] {
        let said = refused(line);
        assert!(said.contains(option), "{line}: {said}");
    }
}
