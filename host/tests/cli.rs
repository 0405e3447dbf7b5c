//! Whole commands: what they print, what they write, and how they refuse.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

/// A folder of its own for each test, removed at its end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("lightbvh-cli-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a folder in the temporary directory");
        Self(path)
    }

    fn file(&self, name: &str) -> String {
        self.0.join(name).to_str().expect("a path of text").to_owned()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn run(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_lightbvh"))
        .args(args)
        .output()
        .expect("the program starts")
}

fn json(args: &[&str]) -> Value {
    let output = run(args);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{args:?}: {errors}");
    serde_json::from_slice(&output.stdout).expect("one JSON object")
}

/// Runs what must be refused and returns what it said.
fn refused(args: &[&str]) -> String {
    let output = run(args);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{args:?} said {said}");
    assert!(!said.contains("panicked"), "{said}");
    said
}

/// Whether there is a device; where one is required, there must be.
fn has_device() -> bool {
    let devices = json(&["info", "--json"]);
    let found = devices["devices"].as_array().is_some_and(|list| !list.is_empty());
    if !found {
        eprintln!("skipped: no Vulkan device");
    }
    found
}

#[test]
fn verify_compares_words_on_every_device() {
    if !has_device() {
        return;
    }
    let report = json(&[
        "verify",
        "--json",
        "--queries",
        "3000",
        "--scene",
        "street",
        "--seed",
        "7",
        "--frames",
        "0..3",
        "--frame-queries",
        "64",
        "--refits",
        "2",
    ]);
    assert_eq!(report["different"], 0);
    assert_eq!(report["cpu_different"], 0);
    assert_eq!(report["frames"], serde_json::json!({ "start": 0, "end": 3 }));
    for device in report["devices"].as_array().expect("devices") {
        assert_eq!(device["different"], 0, "{device}");
        assert_eq!(device["exact"], true, "{device}");
        // Four methods with a light BVH over three frames.
        let queries = 3000 + 4 * 3 * 64;
        assert!(device["samples"].as_u64() >= Some(queries));
        assert!(device["pmfs"].as_u64() >= Some(queries));
        let words = device["words"].as_object().expect("words by kind");
        for kind in ["nodes", "samples", "pmfs", "pixels", "surfaces", "reservoirs"] {
            assert!(words[kind]["compared"].as_u64() > Some(0), "{kind}: {device}");
            assert_eq!(words[kind]["different"], 0, "{kind}: {device}");
        }
        let all: u64 = words.values().filter_map(|kind| kind["compared"].as_u64()).sum();
        assert_eq!(device["compared"], all);
        assert!(device["nodes"].as_u64() > Some(0));
        assert!(device["pixels"].as_u64() > Some(0));
        assert!(device["name"].is_string() && device["driver"].is_string());
    }
}

#[test]
fn render_gives_the_same_file_on_both_processors() {
    if !has_device() {
        return;
    }
    let folder = Folder::new("render");
    let exported = folder.file("carousel.glb");
    assert!(run(&["export", "carousel", "-o", &exported]).status.success());
    for scene in ["carousel", exported.as_str()] {
        let mut files = Vec::new();
        for backend in ["cpu", "vulkan"] {
            let file = folder.file(&format!("{backend}.exr"));
            let report = json(&[
                "render",
                scene,
                "--frame",
                "20",
                "--width",
                "64",
                "--height",
                "36",
                "--spp",
                "2",
                "--backend",
                backend,
                "-o",
                &file,
                "--json",
            ]);
            assert_eq!(report["width"], 64);
            files.push(std::fs::read(&file).expect("an image"));
        }
        assert!(files[0] == files[1], "{scene}: the images differ");
        assert!(files[0].len() > 64 * 36 * 3);
    }
}

#[test]
fn paths_render_and_add_what_is_reflected_again() {
    let folder = Folder::new("paths");
    let small = [
        "--width", "48", "--height", "27", "--spp", "8", "--frame", "3", "--json",
    ];
    let mut images = Vec::new();
    for bounces in ["1", "4"] {
        let file = folder.file(&format!("{bounces}.exr"));
        let own = [
            "render",
            "street",
            "--integrator",
            "path",
            "--bounces",
            bounces,
            "-o",
            &file,
        ];
        let report = json(&[&own[..], &small[..]].concat());
        assert_eq!(report["integrator"], "path");
        assert_eq!(report["bounces"].to_string(), bounces);
        images.push(std::fs::read(&file).expect("an image"));
    }
    assert!(images[0] != images[1], "more reflections, another image");
    let file = folder.file("direct.exr");
    let report = json(&[&["render", "street", "-o", &file][..], &small[..]].concat());
    assert_eq!(
        (&report["integrator"], &report["bounces"]),
        (&"direct".into(), &1.into())
    );
}

#[test]
fn every_sampler_and_heuristic_renders() {
    let folder = Folder::new("samplers");
    for sampler in [
        "uniform",
        "power",
        "single-level",
        "single-level-rebuilt",
        "two-level",
        "restir",
        "bvh-restir",
    ] {
        for heuristic in ["sah", "saoh"] {
            let file = folder.file(&format!("{sampler}-{heuristic}.png"));
            let output = run(&[
                "render",
                "street",
                "--frame",
                "3",
                "--width",
                "48",
                "--height",
                "27",
                "--spp",
                "1",
                "--sampler",
                sampler,
                "--heuristic",
                heuristic,
                "--backend",
                "cpu",
                "-o",
                &file,
            ]);
            assert!(
                output.status.success(),
                "{}",
                String::from_utf8_lossy(&output.stderr)
            );
            assert!(Path::new(&file).exists());
        }
    }
}

#[test]
fn restir_says_what_it_is_and_gives_the_same_file_on_both_processors() {
    let folder = Folder::new("restir");
    let device = has_device();
    for (sampler, mode) in [
        ("restir", Some("biased")),
        ("restir", Some("unbiased")),
        ("bvh-restir", None),
    ] {
        let mut files = Vec::new();
        for backend in ["cpu", "vulkan"] {
            if backend == "vulkan" && !device {
                continue;
            }
            let file = folder.file(&format!("{backend}.exr"));
            let mut args = vec![
                "render",
                "carousel",
                "--frame",
                "2",
                "--width",
                "48",
                "--height",
                "27",
                "--spp",
                "2",
                "--sampler",
                sampler,
                "--backend",
                backend,
                "-o",
                &file,
                "--json",
            ];
            args.extend(mode.into_iter().flat_map(|mode| ["--restir-mode", mode]));
            let report = json(&args);
            let restir = &report["restir"];
            assert_eq!(report["sampler"], sampler);
            assert_eq!(restir["mode"], mode.unwrap_or("unbiased"));
            assert_eq!(restir["unbiased"], mode != Some("biased"));
            let rays = report["shadow_rays_per_pixel"].as_f64().expect("rays");
            let most = 2.0 * restir["most_shadow_rays_per_sample"].as_f64().expect("rays");
            assert!(rays > 0.0 && rays <= most, "{rays} {most}");
            files.push(std::fs::read(&file).expect("an image"));
        }
        assert!(
            files.windows(2).all(|pair| pair[0] == pair[1]),
            "{sampler}: the images differ"
        );
    }
    let help = String::from_utf8(run(&["render", "--help"]).stdout).expect("text");
    assert!(help.contains("biased (darker"), "{help}");
}

#[test]
fn sequences_are_numbered_and_hold_what_single_frames_do() {
    let folder = Folder::new("animate");
    let small = [
        "--width",
        "32",
        "--height",
        "18",
        "--spp",
        "2",
        "--backend",
        "cpu",
        "--json",
    ];
    for sampler in ["power", "single-level-rebuilt", "two-level", "bvh-restir"] {
        let out = folder.file(&format!("{sampler}.exr"));
        let args = [
            "render",
            "street",
            "--sampler",
            sampler,
            "--animate",
            "0..3",
            "-o",
            &out,
        ];
        let report = json(&[&args[..], &small].concat());
        let frames = report["frames"].as_array().expect("frames");
        assert_eq!(frames.len(), 3);
        for (number, frame) in (0..).zip(frames) {
            assert_eq!(frame["frame"], number);
            assert_eq!(
                frame["output"],
                folder.file(&format!("{sampler}-000{number}.exr"))
            );
            assert!(Path::new(frame["output"].as_str().expect("a path")).exists());
        }
        assert!(!Path::new(&out).exists());
        // Nothing is carried from frame to frame without a tree or with a new one, and the same history where it starts at frame 0.
        if sampler != "two-level" {
            let single = folder.file("single.exr");
            let args = [
                "render",
                "street",
                "--sampler",
                sampler,
                "--frame",
                "2",
                "-o",
                &single,
            ];
            json(&[&args[..], &small].concat());
            let last = std::fs::read(folder.file(&format!("{sampler}-0002.exr"))).expect("an image");
            assert!(last == std::fs::read(&single).expect("an image"), "{sampler}");
        }
    }
    let image = folder.file("refused.png");
    for wrong in ["3", "3..3", "4..3", "a..b"] {
        let said = refused(&["render", "street", "--animate", wrong, "-o", &image]);
        assert!(said.contains("--animate"), "{said}");
    }
    refused(&[
        "render",
        "street",
        "--animate",
        "0..2",
        "--frame",
        "1",
        "-o",
        &image,
    ]);
    let said = refused(&["render", "street", "--restir-mode", "biased", "-o", &image]);
    assert!(said.contains("--sampler restir"), "{said}");
    let said = refused(&[
        "render",
        "street",
        "--sampler",
        "restir",
        "--spp",
        "65",
        "-o",
        &image,
    ]);
    assert!(said.contains("--spp 65"), "{said}");
}

#[test]
fn animations_of_moving_lights_give_the_same_files_on_both_processors() {
    let folder = Folder::new("moving");
    let device = has_device();
    // 17 samples are more than one invocation takes, and not a multiple of what it takes.
    for (sampler, spp) in [
        ("single-level-rebuilt", "17"),
        ("two-level", "17"),
        ("bvh-restir", "1"),
    ] {
        let mut files = Vec::new();
        for backend in ["cpu", "vulkan"] {
            if backend == "vulkan" && !device {
                continue;
            }
            let out = folder.file(&format!("{sampler}-{backend}.exr"));
            json(&[
                "render",
                "square",
                "--sampler",
                sampler,
                "--animate",
                "8..11",
                "--width",
                "16",
                "--height",
                "9",
                "--spp",
                spp,
                "--backend",
                backend,
                "-o",
                &out,
                "--json",
            ]);
            let frames = (8..11).map(|n| {
                let file = folder.file(&format!("{sampler}-{backend}-{n:04}.exr"));
                std::fs::read(file).expect("an image")
            });
            files.push(frames.collect::<Vec<_>>());
        }
        assert!(
            files[0][0] != files[0][1] && files[0][1] != files[0][2],
            "{sampler}: nothing moves"
        );
        assert!(
            files.windows(2).all(|pair| pair[0] == pair[1]),
            "{sampler}: the images differ"
        );
    }
}

#[test]
fn bench_reports_every_case() {
    let small = ["--lights", "2000", "--queries", "5000", "--no-trade"];
    let report = json(&[&["bench", "--json"][..], &small[..]].concat());
    let cases = report["cases"].as_array().expect("cases");
    for structure in ["single-level", "two-level"] {
        for what in ["build", "refit", "sample", "pmf"] {
            let found = cases.iter().find(|case| {
                case["what"] == what && case["structure"] == structure && case["backend"] == "cpu"
            });
            let case = found.unwrap_or_else(|| panic!("no {what} of {structure}"));
            assert_eq!(case["lights"], 2000);
            assert!(case["ns_per_item"].as_f64() > Some(0.0));
            assert!(case["bytes_per_light"].as_f64() > Some(0.0));
            assert!(case["threads"].is_u64());
        }
    }
}

#[test]
fn bench_follows_moving_lights() {
    let size = ["--instances", "200", "--mesh-triangles", "20"];
    let report = json(&[&["bench", "--json", "--dynamic"], &size[..]].concat());
    let report = &report["dynamic"];
    assert!(report["single_level_refit_ms"]["median"].as_f64() > Some(0.0));
    let rows = report["rows"].as_array().expect("rows");
    let of = |change: &str, instances: u32, changed: u32| {
        let found = rows.iter().find(|row| {
            row["change"] == change
                && row["backend"] == "cpu"
                && row["threads"] == 1
                && row["instances"] == instances
                && row["changed"] == changed
        });
        found.unwrap_or_else(|| panic!("no {change} of {changed} among {instances}"))
    };
    let nodes = |row: &serde_json::Value| row["nodes"].as_u64().expect("nodes");
    let all = of("move", 200, 200);
    assert!(all["frames"].as_u64() >= Some(20), "{all}");
    assert!(all["refit_ms"]["least"].as_f64() <= all["refit_ms"]["most"].as_f64());
    for swapped in ["rebuild_ms", "swap_ms", "refit_after_swap_ms"] {
        assert!(all[swapped]["median"].as_f64() > Some(0.0), "{all}");
    }
    // What little changes costs little: no more than its ways to the root.
    assert!(nodes(of("move", 200, 2)) * 4 < nodes(all), "{all}");
    assert!(nodes(of("shine", 200, 2)) * 4 < nodes(all), "{all}");
    of("move", 200, 20);
    of("move", 20, 2);
    assert_eq!(of("deform", 1, 4000)["triangles"], 4000);
}

#[test]
fn validate_finds_the_scenes_valid() {
    for scene in ["street", "square", "carousel"] {
        let report = json(&["validate", scene, "--json"]);
        assert_eq!(report["valid"], true, "{report}");
    }
}

#[test]
fn demo_ends_with_no_word_different() {
    let folder = Folder::new("demo");
    let images = folder.file("images");
    let small = ["--width", "96", "--height", "54"];
    let report = json(&[&["demo", "--json", "--out", &images][..], &small[..]].concat());
    let rows = report["rows"].as_array().expect("rows");
    assert_eq!(rows[0]["backend"], "cpu");
    for row in &rows[1..] {
        assert_eq!(row["different"], 0, "{row}");
        // Four frames of all nodes, 100,000 samples of two words, and pixels of three.
        let least = 4 * (2 * 100_000 + 3 * 96 * 54);
        assert!(row["compared"].as_u64() > Some(least), "{row}");
    }
    for image in report["images"].as_array().expect("images") {
        assert!(Path::new(image.as_str().expect("a path")).exists());
    }
}

#[test]
fn bad_input_is_refused_with_what_where_and_what_to_do() {
    let folder = Folder::new("refused");
    let image = folder.file("image.png");
    let said = refused(&["render", "streets", "-o", &image]);
    assert!(
        said.contains("streets") && said.contains("street, square, carousel"),
        "{said}"
    );
    let said = refused(&["render", "no/such/file.glb", "-o", &image]);
    assert!(said.contains("no/such/file.glb"), "{said}");
    let said = refused(&["render", "street", "--spp", "0", "-o", &image]);
    assert!(said.contains("--spp 0"), "{said}");
    let said = refused(&["render", "street", "--width", "100000", "-o", &image]);
    assert!(said.contains("--width 100000"), "{said}");
    let said = refused(&["render", "street", "--bounces", "65", "-o", &image]);
    assert!(
        said.contains("--bounces 65") && said.contains("1 to 64"),
        "{said}"
    );
    let said = refused(&["demo", "--height", "0", "--out", &folder.file("images")]);
    assert!(
        said.contains("--height 0") && !folder.0.join("images").exists(),
        "{said}"
    );
    for option in ["--lights", "--queries"] {
        let said = refused(&["bench", option, "0"]);
        assert!(said.contains(&format!("{option} 0")), "{said}");
    }
    let said = refused(&["bench", "--dynamic", "--instances", "0"]);
    assert!(said.contains("--instances 0"), "{said}");
    let said = refused(&["bench", "--dynamic", "--mesh-triangles", "100000"]);
    assert!(said.contains("1000000000") && said.contains("10000000"), "{said}");
    refused(&["render", "street", "--sampler", "best", "-o", &image]);
    refused(&["verify", "--queries", "many"]);
    assert!(!Path::new(&image).exists());

    let small = ["--width", "16", "--height", "9", "--spp", "1"];
    for output in [folder.file("no/such/folder/image.png"), folder.file("image.gif")] {
        let said = refused(&[&["render", "street", "-o", &output], &small[..]].concat());
        assert!(said.contains(&output), "{said}");
    }
    if has_device() {
        let said = refused(&["verify", "--queries", "1", "--device", "no such device"]);
        assert!(said.contains("no such device"), "{said}");
    }
}

#[test]
fn broken_scene_files_are_refused() {
    let folder = Folder::new("broken");
    let whole = folder.file("whole.glb");
    assert!(run(&["export", "street", "-o", &whole]).status.success());
    let bytes = std::fs::read(&whole).expect("the exported scene");
    let broken = folder.file("broken.glb");
    for length in [0, 3, 11, 12, 19, 20, 500, bytes.len() / 2, bytes.len() - 1] {
        std::fs::write(&broken, &bytes[..length]).expect("a file");
        let said = refused(&["render", &broken, "-o", &folder.file("image.png")]);
        assert!(said.contains("broken.glb"), "{length} bytes: {said}");
    }
    // A scene without any light is a scene, but there is nothing to sample.
    let dark = folder.file("dark.gltf");
    let document = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
        "bufferViews":[{"buffer":0,"byteLength":36}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}]}"#;
    std::fs::write(&dark, document).expect("a file");
    let said = refused(&["render", &dark, "-o", &folder.file("image.png")]);
    assert!(said.contains("emissive"), "{said}");
}
