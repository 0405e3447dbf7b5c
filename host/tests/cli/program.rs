//! Running the program, and a folder for what it writes.

use std::path::PathBuf;
use std::process::{Command, Output};

use serde_json::Value;

/// Set where a device is required.
const REQUIRE: &str = "LIGHTBVH_REQUIRE_VULKAN";

/// A folder of its own for each test, removed at its end.
pub struct Folder(pub PathBuf);

impl Folder {
    pub fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("lightbvh-cli-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a folder in the temporary directory");
        Self(path)
    }

    pub fn file(&self, name: &str) -> String {
        self.0.join(name).to_str().expect("a path of text").to_owned()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Runs the program with the words of a command line.
pub fn run(line: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_lightbvh"))
        .args(line.split_whitespace())
        .output()
        .expect("the program starts")
}

/// The same without a device.
pub fn run_on_cpu(line: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_lightbvh"))
        .args(line.split_whitespace())
        .env("VK_DRIVER_FILES", "/nonexistent")
        .env_remove(REQUIRE)
        .output()
        .expect("the program starts")
}

pub fn json(line: &str) -> Value {
    object(line, &run(line))
}

pub fn json_on_cpu(line: &str) -> Value {
    object(line, &run_on_cpu(line))
}

fn object(line: &str, output: &Output) -> Value {
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{line}: {errors}");
    serde_json::from_slice(&output.stdout).expect("one JSON object")
}

/// Runs what must be refused and returns what it said.
pub fn refused(line: &str) -> String {
    let output = run(line);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{line} said {said}");
    assert!(!said.contains("panicked"), "{said}");
    said
}

/// Whether there is a device; where one is required, there must be.
pub fn has_device() -> bool {
    let devices = json("info --json");
    let found = devices["devices"].as_array().is_some_and(|list| !list.is_empty());
    if !found {
        eprintln!("skipped: no Vulkan device");
    }
    found
}
