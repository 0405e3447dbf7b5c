use std::path::PathBuf;

use super::*;
use crate::scene::random::damaged;
use crate::scene::{AnalyticKind, Frame};
use crate::vector::{cross, dot, normal};

mod colors;
mod lights;
mod notes;
mod pictures;
mod shapes;
mod structure;

fn read(text: &str) -> Scene {
    Scene::read_pbrt_slice("x.pbrt", text.as_bytes(), None).unwrap_or_else(|error| panic!("{error}"))
}

fn refused(text: &str) -> String {
    let read = Scene::read_pbrt_slice("x.pbrt", text.as_bytes(), None);
    read.expect_err("is no scene").to_string()
}

/// A folder of its own with files in it, removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str, files: &[(&str, &[u8])]) -> Self {
        let folder = std::env::temp_dir().join(format!("lightbvh-pbrt-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder for files");
        for (file, bytes) in files {
            std::fs::write(folder.join(file), bytes).expect("a folder for files");
        }
        Self(folder)
    }

    fn read(&self, file: &str) -> Result<Scene, SceneError> {
        Scene::open(&self.0.join(file).display().to_string())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// A triangle in the plane z = 0, of 2 m², its front towards +z.
const TRIANGLE: &str =
    "Shape \"trianglemesh\" \"point3 P\" [0 0 0 2 0 0 0 2 0] \"integer indices\" [0 1 2]\n";

/// A camera whose space is right-handed, so that nothing is mirrored.
const UNMIRRORED: &str = "Scale -1 1 1\nCamera \"perspective\"\nWorldBegin\n";

fn near(found: [f32; 3], expected: [f64; 3], tolerance: f64) {
    for i in 0..3 {
        let error = (f64::from(found[i]) - expected[i]).abs();
        assert!(
            error <= tolerance * expected[i].abs().max(1e-3),
            "{found:?}, expected {expected:?}"
        );
    }
}

/// Units in the last place of numbers that are rounded to `f32` a few times.
const ROUNDED: f64 = 4.0 * f32::EPSILON as f64;
