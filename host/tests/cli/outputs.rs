//! Files that are written: through links, into pipes, and after an interrupt.
#![cfg(unix)]

use std::ffi::OsStr;
use std::fs;
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::{FileTypeExt, symlink};
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::program::{Folder, refused, run};

const SMALL: &str = "--width 16 --height 9 --spp 1";

#[test]
fn links_are_followed_and_pipes_are_written_directly() {
    let folder = Folder::new("outputs");
    let [file, link, pipe, lost] =
        ["file.exr", "link.exr", "pipe.exr", "lost.exr"].map(|name| folder.file(name));
    let render = |to: &str| assert!(run(&format!("render street {SMALL} -o {to}")).status.success());
    render(&file);
    let expected = fs::read(&file).expect("an image");
    fs::write(&file, "older").expect("a file");
    symlink(&file, &link).expect("a link");
    render(&link);
    assert!(fs::symlink_metadata(&link).expect("a link").is_symlink());
    assert!(fs::read(&file).expect("an image") == expected);

    make_pipe(&pipe);
    let reader = std::thread::spawn({
        let pipe = pipe.clone();
        move || fs::read(pipe).expect("an image")
    });
    render(&pipe);
    assert!(reader.join().expect("no panic") == expected);
    assert!(fs::metadata(&pipe).expect("a pipe").file_type().is_fifo());

    symlink(folder.file("nothing"), &lost).expect("a link");
    let said = refused(&format!("render street {SMALL} -o {lost}"));
    assert!(said.contains(&lost) && said.contains("remove the link"), "{said}");
}

#[test]
fn paths_need_not_be_text() {
    let folder = Folder::new("bytes");
    for (line, name) in [
        (format!("render street {SMALL} -o"), &b"\xff.exr"[..]),
        (String::from("demo --width 16 --height 9 --out"), b"\xff"),
    ] {
        for json in [None, Some("--json")] {
            let output = Command::new(env!("CARGO_BIN_EXE_lightbvh"))
                .args(line.split(' '))
                .arg(folder.0.join(OsStr::from_bytes(name)))
                .args(json)
                .output()
                .expect("the program starts");
            let said = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success(), "{line}: {said}");
        }
    }
}

fn make_pipe(path: &str) {
    let made = Command::new("mkfifo").arg(path).status();
    assert!(made.expect("mkfifo is part of POSIX").success());
}

/// At several times: between files, and while one is written.
#[test]
fn an_interrupt_leaves_no_temporary_file() {
    for milliseconds in [0, 2, 8] {
        let folder = Folder::new(&format!("interrupt-{milliseconds}"));
        // Nobody reads the last file: the program does not end by itself.
        make_pipe(&folder.file("street-150.png"));
        let line = format!("demo --width 192 --height 108 --out {}", folder.file(""));
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
