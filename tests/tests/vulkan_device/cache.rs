//! Pipelines on disk: one file for a device, replaced where it is not whole, and never an error.

use std::fs;
use std::path::{Path, PathBuf};

use lightbvh_host::vulkan::{Device, DeviceInfo, Options};
use lightbvh_tests::devices::{devices, open};

use super::{expected, run, values};

/// An empty directory of its own.
fn directory(name: &str) -> &'static Path {
    let path = std::env::temp_dir().join(format!("lightbvh-{}-{name}", std::process::id()));
    let _ = fs::remove_dir_all(&path);
    Box::leak(path.into_boxed_path())
}

/// A device's life with pipelines in `directory`: it computes what it should.
fn live(info: &DeviceInfo, directory: &'static Path) {
    let device: Device = open(
        info,
        Options {
            pipeline_cache: Some(directory),
            ..Options::default()
        },
    );
    let input = values(100);
    assert_eq!(
        run(&device, &input, 3, 0),
        expected(&input, 3),
        "{}",
        device.name()
    );
    device.close().expect("a clean tear-down");
}

/// The files there are.
fn files(directory: &Path) -> Vec<PathBuf> {
    let found = fs::read_dir(directory).map_or_else(|_| Vec::new(), |all| all.flatten().collect());
    found.iter().map(|entry| entry.path()).collect()
}

#[test]
fn what_is_not_whole_is_replaced() {
    for info in &devices().devices {
        let directory = directory(&format!("broken-{}", info.index));
        live(info, directory);
        let [file] = files(directory).try_into().expect("one file, nothing beside it");
        let good = fs::read(&file).expect("a file");
        // A head, and the driver's, after which llvmpipe keeps nothing.
        assert!(good.len() >= 64, "{}", info.probe.name);
        // From what was there, which a driver may write down otherwise.
        live(info, directory);
        let again = fs::read(&file).expect("a file");
        assert!(again.len() >= good.len(), "{}", info.probe.name);
        let mut foreign = good.clone();
        // Vendor of the driver's header: whole, but of another device, if the hash were right.
        foreign[32 + 8] ^= 1;
        for broken in [&[][..], b"no cache", &good[..good.len() - 1], &foreign] {
            fs::write(&file, broken).expect("a file");
            live(info, directory);
            let now = fs::read(&file).expect("a file");
            assert!(
                now != broken && now.starts_with(b"lightbvh cache 1"),
                "{}",
                info.probe.name
            );
            assert_eq!(
                files(directory),
                std::slice::from_ref(&file),
                "nothing is left beside it"
            );
        }
        fs::remove_dir_all(directory).expect("removed");
    }
}

#[test]
fn a_place_that_cannot_be_written_is_no_error() {
    for info in &devices().devices {
        let directory = directory(&format!("taken-{}", info.index));
        fs::write(directory, "a file where a directory should be").expect("a file");
        live(info, directory);
        fs::remove_file(directory).expect("still a file");
        // Nor is a directory where the file should be.
        live(info, directory);
        let [file] = files(directory).try_into().expect("one file");
        fs::remove_file(&file).expect("removed");
        fs::create_dir(&file).expect("a directory");
        live(info, directory);
        assert_eq!(files(directory), [file], "nothing is left beside it");
        fs::remove_dir_all(directory).expect("removed");
    }
}
