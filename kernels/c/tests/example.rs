//! `lights.c`, compiled by the C compiler of the machine, prints the words that Rust computes.
#![cfg(unix)]

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use lightbvh::bvh::{RebuilderParams, Swap};
use lightbvh::importance::LinkedPoint;
use lightbvh::light::{
    AnyLight, DiscLight, Light, PointLight, RectangleLight, SphereLight, SpotLight, TWO_SIDED, mis_weight,
};
use lightbvh::{Edit, EmissiveTriangle, MaskedLights, Rebuilder, ShadingPoint, Transform};

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

/// Lamp `k` of the example.
fn lamp(k: u16) -> AnyLight {
    let x = f32::from(k);
    let (p, mesh, emission) = ([x, 3.0, 0.0], 0, [9.0, 8.0, 0.5 * f32::from(k % 8)]);
    let (half, flags) = ([[0.25, 0.0, 0.0], [0.0, 0.0, 0.5]], TWO_SIDED);
    match k % 6 {
        0 => triangle(x, emission),
        1 => AnyLight::from(PointLight {
            p,
            intensity: emission,
            range: 25.0,
            mesh,
        }),
        2 => {
            let (axis, range, intensity) = ([0.0, -1.0, 0.0], 15.0, emission);
            let spot = SpotLight {
                p,
                intensity,
                axis,
                range,
                ..SpotLight::DARK
            };
            spot.with_cone(0.25, 0.75).into()
        }
        3 => AnyLight::from(SphereLight {
            p,
            radius: 0.125,
            radiance: emission,
            mesh,
        }),
        4 => AnyLight::from(RectangleLight {
            p,
            half,
            radiance: emission,
            mesh,
            flags,
        }),
        _ => AnyLight::from(DiscLight {
            p,
            half,
            radiance: emission,
            mesh,
            flags,
        }),
    }
}

fn triangle(x: f32, radiance: [f32; 3]) -> AnyLight {
    AnyLight::from(EmissiveTriangle {
        p: [[x, 3.0, 0.0], [x + 0.25, 3.0, 0.0], [x, 3.0, 0.25]],
        radiance,
        mesh: 0,
        flags: 0,
    })
}

/// What `lights.c` does, in Rust.
fn expected() -> String {
    let mut bvh = MaskedLights::default();
    let add = |k| Edit::AddLight {
        light: lamp(k),
        mask: if k % 3 == 0 { 1 } else { u32::MAX },
    };
    let mut lamps = bvh.apply((0..99).map(add).collect()).unwrap().instances;
    lamps.push(bvh.add_light(lamp(99)).unwrap());
    bvh.refit();
    bvh.set_transform(lamps[40], Transform::at([0.0, 2.0, 0.0]))
        .unwrap();
    bvh.set_radiance(lamps[41], [0.5, 0.25, 0.125]).unwrap();
    bvh.set_mask(lamps[43], 2).unwrap();
    bvh.set_light(lamps[44], lamp(1)).unwrap();
    bvh.remove(lamps[42]).unwrap();
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
    let arrange = |frame: u16| -> Vec<AnyLight> {
        let place = |k: u16| triangle(0.5 * f32::from(k * frame % 199), [9.0, 8.0, 0.0]);
        (0..200).map(place).collect()
    };
    let mesh = bvh.add_mesh(arrange(1)).unwrap();
    let panel = bvh.add_instance(mesh, Transform::at([0.0, 1.0, 4.0])).unwrap();
    bvh.add_instance(mesh, Transform::at([0.0, 0.0, -4.0])).unwrap();
    for frame in 1..=30 {
        let start = rebuilder.begin_frame(&mut bvh).unwrap();
        trees += u32::from(start.swapped) + start.meshes;
        meshes += start.meshes;
        let lights = arrange(frame);
        bvh.apply(vec![Edit::SetLightRange {
            mesh,
            first: 0,
            lights,
        }])
        .unwrap();
        bvh.refit();
        rebuilder.end_frame(&bvh);
    }
    assert!(meshes > 0 && trees > meshes, "both kinds of trees");
    writeln!(text, "{trees} trees were built").unwrap();
    let lights = bvh.view().lights_of(panel).unwrap();
    let count = lights.len();
    writeln!(
        text,
        "the panel has lights from {} on, {count} of them",
        lights.start
    )
    .unwrap();
    bvh.rebuild();
    for k in 0..1000_u16 {
        let point = ShadingPoint {
            p: [0.125 * f32::from(k), 0.0, 0.5],
            n: [0.0, 1.0, 0.0],
        };
        let receiver = LinkedPoint {
            point,
            mask: u32::from(k % 3 + 1),
        };
        let random = 0x9e37_79b9_7f4a_7c15_u64.wrapping_mul(u64::from(k) + 1);
        let own = bvh.sample_light(&receiver, random, [0.25, 0.5]).unwrap();
        let met = bvh.pdf_of_hit(&receiver, own.instance, own.part, own.point.p);
        let light = bvh.view().lights_of(own.instance).unwrap().start + own.part;
        let weight = mis_weight(own.pdf, 0.25);
        let words = [own.pmf, met.unwrap(), own.pdf, weight, own.irradiance[0]].map(f32::to_bits);
        let [pmf, met, pdf, weight, irradiance] = words;
        let index = own.instance.index();
        writeln!(
            text,
            "{light} {index} {pmf:08x} {met:08x} {pdf:08x} {weight:08x} {irradiance:08x}"
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
        .arg(here.join("examples/lights.c"))
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
        include_str!("../src/kernel.rs"),
        include_str!("../src/mirror.rs"),
        include_str!("../src/query.rs"),
        include_str!("../src/rebuilder.rs"),
        include_str!("../src/scene.rs"),
    );
    let name = |text: &str| format!("lightbvh_{}", text.split('(').next().unwrap_or_default());
    let mut in_rust: Vec<String> = source.split("fn lightbvh_").skip(1).map(name).collect();
    let mut in_c: Vec<String> = header
        .lines()
        .filter(|line| line.contains("lightbvh_") && line.contains('(') && !line.starts_with(['/', ' ', '#']))
        .filter(|line| !line.starts_with("static"))
        .filter_map(|line| line.split('(').next()?.split([' ', '*']).next_back())
        .filter(|name| name.starts_with("lightbvh_"))
        .map(str::to_owned)
        .collect();
    in_rust.sort();
    in_c.sort();
    assert_eq!(in_rust, in_c);
    let calls = concat!(
        include_str!("../examples/lights.c"),
        include_str!("../examples/vulkan.cpp"),
        include_str!("devices.rs"),
    );
    for name in in_c {
        assert!(calls.contains(&format!("{name}(")), "no example calls {name}");
    }
}
