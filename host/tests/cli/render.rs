//! Pictures: equal files on both processors, every sampler, numbered sequences.

use crate::model;
use crate::program::{Folder, run};

#[test]
fn paths_add_what_is_reflected_again() {
    let folder = Folder::new("paths");
    let image = |bounces: u32| {
        let file = folder.file(&format!("{bounces}.exr"));
        let path = format!("--integrator path --bounces {bounces} --width 48 --height 27 --spp 8 --frame 3");
        assert!(run(&format!("render street {path} -o {file}")).status.success());
        std::fs::read(&file).expect("an image")
    };
    assert!(image(1) != image(4), "more reflections, another image");
}

/// A camera of one's own: another picture, mirrored names refused, and half of one refused too.
#[test]
fn a_camera_of_ones_own() {
    let folder = Folder::new("look");
    let small = "--width 48 --height 27 --spp 2 --backend cpu";
    let image = |options: &str| {
        let file = folder.file("image.exr");
        let output = run(&format!("render street {options} -o {file} {small}"));
        assert!(output.status.success(), "{options}");
        std::fs::read(&file).expect("an image")
    };
    let own = image("");
    let looked = image("--look-from -6,3,12 --look-at 0,1,-2.5 --fov 30");
    assert!(own != looked);
    for wrong in [
        "--look-from 1,2,3",
        "--look-from 1,2 --look-at 1,2,3",
        "--look-from 1,2,3 --look-at 0,0,0 --camera 0",
        "--fov 40",
        "--camera first",
        "--look-from nan,2,3 --look-at 0,0,0",
    ] {
        let output = run(&format!(
            "render street {wrong} -o {} {small}",
            folder.file("no.png")
        ));
        assert_eq!(output.status.code(), Some(2), "{wrong}");
    }
}

#[test]
fn the_exposure_that_is_printed_gives_the_same_picture() {
    let folder = Folder::new("exposure");
    let path = model::write(&folder, "bright", &[], |root| {
        root["materials"][1]["extensions"] = serde_json::json!({
            "KHR_materials_emissive_strength": { "emissiveStrength": 12345.6 }
        });
        root["extensionsUsed"] = serde_json::json!(["KHR_materials_emissive_strength"]);
    });
    let (first, again) = (folder.file("first.png"), folder.file("again.png"));
    let small = "--width 32 --height 24 --spp 4";
    let output = run(&format!("render {path} {small} -o {first}"));
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    let exposure = said
        .lines()
        .next()
        .and_then(|line| line.split_once(", exposure "));
    let (_, exposure) = exposure.expect("an exposure");
    assert!(exposure.parse::<f32>().is_ok_and(|x| x < 0.01), "{said}");
    assert!(
        run(&format!("render {path} {small} --exposure {exposure} -o {again}"))
            .status
            .success()
    );
    assert!(
        std::fs::read(first).expect("a picture") == std::fs::read(again).expect("a picture"),
        "{exposure}"
    );
}
