//! Files after an interrupt.
#![cfg(unix)]

use std::fs;
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::program::Folder;

/// At several times: between files, and while one is written.
#[test]
fn an_interrupt_leaves_no_temporary_file() {
    for milliseconds in [0, 2, 8] {
        let folder = Folder::new(&format!("interrupt-{milliseconds}"));
        let line = format!("demo --width 64 --height 36 --out {}", folder.file(""));
        let mut child = Command::new(env!("CARGO_BIN_EXE_lightbvh"))
            .args(line.split(' '))
            .stdout(Stdio::null())
            .spawn()
            .expect("the program starts");
        while !fs::exists(folder.file("street-000.png")).expect("a folder") {
            assert_eq!(child.try_wait().expect("a process"), None, "it ended by itself");
            std::thread::sleep(Duration::from_millis(1));
        }
        std::thread::sleep(Duration::from_millis(milliseconds));
        let sent = Command::new("kill")
            .args(["-INT", &child.id().to_string()])
            .status();
        assert!(sent.expect("kill is part of POSIX").success());
        assert_eq!(child.wait().expect("it ends").code(), Some(130));
        for file in fs::read_dir(&folder.0).expect("a folder") {
            let name = file.expect("a file").file_name().into_string().expect("text");
            assert!(name.starts_with("street-") && name.ends_with(".png"), "{name}");
        }
    }
}
