//! Pictures: paths and cameras.

use crate::program::{Folder, run};

#[test]
fn paths_add_what_is_reflected_again() {
    let folder = Folder::new("paths");
    let image = |integrator: &str| {
        let file = folder.file(&format!("{integrator}.exr"));
        let small = "--width 48 --height 27 --spp 8 --frame 3";
        let line = format!("render street --integrator {integrator} {small} -o {file}");
        assert!(run(&line).status.success());
        std::fs::read(&file).expect("an image")
    };
    assert!(
        image("direct") != image("path"),
        "more reflections, another image"
    );
}

/// A camera of one's own: another picture; half of one is refused.
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
        "--fov 40",
        "--look-from nan,2,3 --look-at 0,0,0",
    ] {
        let output = run(&format!(
            "render street {wrong} -o {} {small}",
            folder.file("no.png")
        ));
        assert_eq!(output.status.code(), Some(2), "{wrong}");
    }
}
