//! `example.c`, compiled by the C compiler of the machine, prints the words that Rust computes.
#![cfg(unix)]

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use lightbvh::bvh::{RebuilderParams, Swap};
use lightbvh::{Edit, EmissiveTriangle, LightBvh, Rebuilder, ShadingPoint, Transform};

/// The static library that Cargo made for this test: beside the test's own program.
fn library() -> PathBuf {
    let program = std::env::current_exe().expect("a test is a program");
    let made = program.parent().expect("it lies in a folder");
    let newest = made
        .read_dir()
        .expect("it can be read")
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            name.starts_with("liblightbvh_c") && name.ends_with(".a")
        })
        .max_by_key(|path| path.metadata().and_then(|data| data.modified()).ok());
    newest.unwrap_or_else(|| panic!("no static library in {}", made.display()))
}

fn run(command: &mut Command) -> String {
    let output = command
        .output()
        .unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {error}");
    String::from_utf8(output.stdout).expect("it prints ASCII")
}

/// What `example.c` does, in Rust.
fn expected() -> String {
    let mut lamp = EmissiveTriangle {
        p: [[0.0, 3.0, 0.0], [0.031_25, 3.0, 0.0], [0.0, 3.0, 0.031_25]],
        radiance: [900.0; 3],
        mesh: 0,
        flags: 0,
    };
    let first = lamp;
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(vec![lamp]).unwrap();
    let at = |k: u16| Transform::at([f32::from(k), 0.0, 0.0]);
    let add = |k| Edit::AddInstance {
        mesh,
        transform: at(k),
        radiance: [1.0; 3],
        mask: u32::MAX,
    };
    let mut lamps = bvh.apply((0..99).map(add).collect()).unwrap().instances;
    lamps.push(bvh.add_instance(mesh, at(99)).unwrap());
    bvh.refit();
    bvh.set_transform(lamps[40], Transform::at([40.0, 2.0, 0.0]))
        .unwrap();
    bvh.set_radiance(lamps[41], [0.5, 0.25, 0.125]).unwrap();
    bvh.remove(lamps[42]).unwrap();
    lamp.p[1][0] = 0.0625;
    bvh.apply(vec![Edit::SetLights {
        mesh,
        lights: vec![lamp],
    }])
    .unwrap();
    bvh.refit();
    let mut text = String::new();
    for range in bvh.take_removed_lights() {
        writeln!(text, "{} lights from {} on are no more", range.len(), range.start).unwrap();
    }
    let mut rebuilder = Rebuilder::new(RebuilderParams {
        after: 1,
        swap: Swap::Deterministic,
        ..RebuilderParams::default()
    });
    let (mut trees, mut meshes) = (0, 0);
    let arrange = |frame: u16| -> Vec<EmissiveTriangle> {
        let place = |k: u16| {
            let mut own = first;
            for p in &mut own.p {
                p[0] += 0.5 * f32::from(k * frame % 199);
            }
            own
        };
        (0..200).map(place).collect()
    };
    let mesh = bvh.add_mesh(arrange(1)).unwrap();
    let place = Transform::at([0.0, 1.0, 4.0]);
    let panel = Edit::AddInstance {
        mesh,
        transform: place,
        radiance: [0.25; 3],
        mask: u32::MAX,
    };
    bvh.apply(vec![panel]).unwrap();
    for frame in 1..=30 {
        let start = rebuilder.begin_frame(&mut bvh).unwrap();
        trees += u32::from(start.swapped) + start.meshes;
        meshes += start.meshes;
        bvh.apply(vec![Edit::SetLights {
            mesh,
            lights: arrange(frame),
        }])
        .unwrap();
        bvh.refit();
        rebuilder.end_frame(&bvh);
    }
    assert!(meshes > 0 && trees > meshes, "both kinds of trees");
    writeln!(text, "{trees} trees were built").unwrap();
    let lights = bvh.view().lights_of(lamps[40]).unwrap();
    writeln!(
        text,
        "lamp 40 has lights from {} on, {} of them",
        lights.start,
        lights.len()
    )
    .unwrap();
    for k in 0..1000_u16 {
        let point = ShadingPoint {
            p: [0.125 * f32::from(k), 0.0, 0.5],
            n: [0.0, 1.0, 0.0],
        };
        let random = 0x9e37_79b9_7f4a_7c15_u64.wrapping_mul(u64::from(k) + 1);
        let sample = bvh.tree().sample(&point, random);
        let triangle = bvh.view().light(sample.light, sample.instance).unwrap();
        let on = triangle.point([0.25, 0.5]);
        let [pmf, x, density] = [sample.pmf, on.p[0], on.density].map(f32::to_bits);
        writeln!(
            text,
            "{} {} {pmf:08x} {x:08x} {density:08x}",
            sample.light, sample.instance
        )
        .unwrap();
    }
    let error = bvh.apply(vec![Edit::RemoveMesh(mesh)]).unwrap_err().reason;
    writeln!(text, "{error}").unwrap();
    text
}

#[test]
fn c_prints_the_words_of_rust() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = std::env::temp_dir().join(format!("lightbvh-c-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let program = folder.join("example");
    run(Command::new("cc")
        .args(["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O1"])
        .arg("-I")
        .arg(here.join("include"))
        .arg(here.join("example.c"))
        .arg(library())
        .args(["-lpthread", "-ldl", "-lm", "-o"])
        .arg(&program));
    let printed = run(&mut Command::new(&program));
    let expected = expected();
    for (line, (c, rust)) in printed.lines().zip(expected.lines()).enumerate() {
        assert_eq!(c, rust, "line {}", line + 1);
    }
    assert_eq!(printed, expected);
    std::fs::remove_dir_all(&folder).unwrap();
}

/// Where there is a C++ compiler, it takes the header too.
#[test]
fn the_header_is_also_cpp() {
    if Command::new("c++").arg("--version").output().is_err() {
        println!("skipped: no C++ compiler");
        return;
    }
    let header = Path::new(env!("CARGO_MANIFEST_DIR")).join("include/lightbvh.h");
    run(Command::new("c++")
        .args([
            "-fsyntax-only",
            "-Wall",
            "-Wextra",
            "-Werror",
            "-x",
            "c++",
            "-include",
        ])
        .arg(header)
        .arg("/dev/null"));
}

/// Every function of the header is in the library, and the other way round.
#[test]
fn header_and_library_have_the_same_functions() {
    let header = include_str!("../include/lightbvh.h");
    let source = concat!(
        include_str!("../src/edit.rs"),
        include_str!("../src/error.rs"),
        include_str!("../src/held.rs"),
        include_str!("../src/query.rs"),
        include_str!("../src/rebuilder.rs"),
    );
    let name = |text: &str| text.split('(').next().unwrap_or_default().to_owned();
    let mut in_rust: Vec<String> = source.split("extern \"C\" fn ").skip(1).map(name).collect();
    let mut in_c: Vec<String> = header
        .lines()
        .filter(|line| line.contains("lightbvh_") && line.contains('(') && !line.starts_with(['/', ' ', '#']))
        .filter_map(|line| line.split('(').next()?.split([' ', '*']).next_back())
        .filter(|name| name.starts_with("lightbvh_"))
        .map(str::to_owned)
        .collect();
    in_rust.sort();
    in_c.sort();
    assert_eq!(in_rust, in_c);
    let example = include_str!("../example.c");
    for name in in_c {
        assert!(
            example.contains(&format!("{name}(")),
            "example.c leaves out {name}"
        );
    }
}
