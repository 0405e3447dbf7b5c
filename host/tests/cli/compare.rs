//! `lightbvh compare`, whole: what it says, what it leaves in its folder, how it goes on and how it refuses.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

/// A folder of its own for each test, removed at its end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("lightbvh-compare-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a folder in the temporary directory");
        Self(path)
    }

    /// Files below the folder whose names end like this.
    fn results(&self, scene: &str, ending: &str) -> Vec<PathBuf> {
        let entries = std::fs::read_dir(self.0.join("results").join(scene)).expect("results");
        let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
        paths.retain(|path| path.to_str().is_some_and(|path| path.ends_with(ending)));
        paths.sort();
        paths
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Runs a comparison into `folder`.
fn compare(folder: &Path, options: &str) -> Output {
    let out = folder.to_str().expect("a path of text");
    Command::new(env!("CARGO_BIN_EXE_lightbvh"))
        .args(["compare", "--out", out, "--json"])
        .args(options.split(' '))
        .output()
        .expect("the program starts")
}

fn report(folder: &Path, options: &str) -> Value {
    let output = compare(folder, options);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{options}: {errors}");
    serde_json::from_slice(&output.stdout).expect("one JSON object")
}

const SMALL: &str =
    "--scene street --width 32 --height 18 --samples 1 --seeds 2 --reference-samples 4 --frames 9,0";
const TWO_METHODS: &str =
    "--method single-level-refit --method two-level-saoh --backend cpu --timed-frames 14";

fn rows(report: &Value) -> &Vec<Value> {
    report["rows"].as_array().expect("rows")
}

#[test]
fn the_report_has_every_measure_and_every_file() {
    let folder = Folder::new("report");
    let report = report(&folder.0, &format!("{SMALL} {TWO_METHODS}"));
    // Two methods at two frames.
    assert_eq!(rows(&report).len(), 4);
    for row in rows(&report) {
        assert_eq!(
            (&row["scene"], &row["backend"]),
            (&"street".into(), &"cpu".into())
        );
        let number = |key: &str| row[key].as_f64().unwrap_or_else(|| panic!("{key} of {row}"));
        assert!(number("mse") > 0.0 && number("linear_mse") > 0.0 && number("relative_mse") > 0.0);
        assert!(number("ssim") < 1.0 && number("psnr") > 0.0 && number("flip") > 0.0);
        assert!(number("mse_ci95") >= 0.0);
        assert!(number("refit_ms") >= 0.0 && number("rebuild_ms") >= 0.0 && number("wait_ms") >= 0.0);
        assert!(number("frame_ms") > 0.0);
        assert!([0, 9].contains(&row["frame"].as_u64().expect("a frame")));
    }
    let averages = report["averages"].as_array().expect("averages");
    for method in ["single-level-refit", "two-level-saoh"] {
        let own = averages.iter().find(|a| a["method"] == method).expect(method);
        let of_rows: Vec<f64> = rows(&report)
            .iter()
            .filter(|row| row["method"] == method)
            .map(|row| row["mse"].as_f64().expect("a number"))
            .collect();
        let mean = (of_rows[0] + of_rows[1]) / 2.0;
        assert!(
            (own["mse"].as_f64().expect("a number") - mean).abs() < 1e-9 * mean,
            "{own}"
        );
        // Frames 1 to 7 and 9: the first of each block of eight is left out.
        assert_eq!(own["timed_frames"], 8);
    }
    let change = &averages
        .iter()
        .find(|a| a["method"] == "two-level-saoh")
        .expect("it")["mse_change"][0];
    assert_eq!(change["from"], "single-level-refit");
    assert!(change["percent"].is_f64());
    let scene = &report["scenes"][0];
    let files = scene["figures"]
        .as_array()
        .expect("figures")
        .iter()
        .map(|file| file.as_str().expect("a name"));
    for file in files.chain(["compare.json", "compare.md"]) {
        assert!(folder.0.join(file).exists(), "{file}");
    }
    assert!(scene["references"][0]["linear_mse"].as_f64() > Some(0.0));
    let written: Value =
        serde_json::from_slice(&std::fs::read(folder.0.join("compare.json")).expect("a file")).expect("JSON");
    assert_eq!(written, report);
    assert!(image::open(folder.0.join("crops-street.png")).is_ok());
    assert!(!report["crops"].as_array().expect("crops").is_empty());
}

#[test]
fn an_interrupted_run_goes_on_and_changed_parameters_are_not_mixed_up() {
    let folder = Folder::new("resume");
    let options = format!("{SMALL} {TWO_METHODS}");
    let first = report(&folder.0, &options);
    // Images: two methods, two frames, two seeds. Times: two methods, two blocks.
    assert_eq!((&first["computed"], &first["reused"]), (&12.into(), &0.into()));
    let same = |other: &Value| {
        for part in ["rows", "averages", "crops", "scenes"] {
            assert_eq!(other[part], first[part], "{part}");
        }
    };
    let second = report(&folder.0, &options);
    assert_eq!((&second["computed"], &second["reused"]), (&0.into(), &12.into()));
    same(&second);

    // One result lost, one cut short, one image of a close-up lost: those three alone are made again, to the bit.
    let images = folder.results("street", ".json");
    let image = |part: &str| {
        images
            .iter()
            .find(|path| path.to_str().is_some_and(|p| p.contains(part)))
    };
    std::fs::remove_file(image("refit-cpu-f009-s01").expect("a result")).expect("it goes");
    std::fs::write(image("saoh-cpu-f000-s00").expect("a result"), b"{").expect("it is written");
    let close_ups = folder.results("street", ".exr");
    let close_up = close_ups
        .iter()
        .find(|path| path.to_str().is_some_and(|p| p.contains("saoh-cpu-f009-s00")));
    std::fs::remove_file(close_up.expect("an image")).expect("it goes");
    let third = report(&folder.0, &options);
    assert_eq!((&third["computed"], &third["reused"]), (&3.into(), &9.into()));
    same(&third);

    // Other parameters: nothing of the old serves, but for the references.
    let references = || -> Vec<(PathBuf, std::time::SystemTime)> {
        let mut all = folder.results("street", ".exr");
        all.retain(|path| path.to_str().is_some_and(|path| path.contains("reference")));
        let modified = |path: PathBuf| {
            let time = std::fs::metadata(&path)
                .and_then(|data| data.modified())
                .expect("a time");
            (path, time)
        };
        all.into_iter().map(modified).collect()
    };
    let before = references();
    assert_eq!(before.len(), 4);
    let changed = options.replace("--samples 1 ", "--samples 2 ");
    let other = report(&folder.0, &changed);
    assert_eq!((&other["computed"], &other["reused"]), (&12.into(), &0.into()));
    assert_eq!(references(), before);
    assert_ne!(other["rows"][0]["mse"], first["rows"][0]["mse"]);
}

#[test]
fn quick_compares_all_methods_on_all_scenes() {
    let folder = Folder::new("quick");
    let report = report(&folder.0, "--quick --width 24 --height 16 --backend cpu");
    for scene in ["street", "square", "carousel"] {
        for method in [
            "uniform",
            "power",
            "single-level-refit",
            "single-level-rebuilt",
            "single-level-moments-rebuilt",
            "two-level-sah",
            "two-level-saoh",
            "two-level-moments",
            "restir",
            "two-level-restir",
            "two-level-moments-restir",
        ] {
            let of_method = |row: &&Value| row["scene"] == scene && row["method"] == method;
            assert_eq!(
                rows(&report).iter().filter(of_method).count(),
                3,
                "{scene} {method}"
            );
        }
        for file in ["mse", "ssim"] {
            let svg = std::fs::read_to_string(folder.0.join(format!("{file}-{scene}.svg"))).expect("a graph");
            assert!(svg.contains("two-level-saoh") && svg.ends_with("</svg>\n"));
        }
    }
}

#[test]
fn devices_render_the_words_of_the_cpu() {
    let folder = Folder::new("devices");
    let methods = "--method single-level-refit --method single-level-rebuilt --method two-level-saoh \
                   --method two-level-moments";
    let report = report(&folder.0, &format!("{SMALL} {methods} --timed-frames 0"));
    assert_eq!(report["different"], 0);
    let cpu: Vec<&Value> = rows(&report)
        .iter()
        .filter(|row| row["backend"] == "cpu")
        .collect();
    assert_eq!(cpu.len(), 8);
    // No frame was timed.
    assert!(cpu[0]["frame_ms"].is_null());
    if rows(&report).len() == cpu.len() {
        eprintln!("skipped: no Vulkan device");
    }
    // One image of each frame on a device, two on the CPU; the words were compared above.
    for row in rows(&report).iter().filter(|row| row["backend"] != "cpu") {
        assert_eq!(row["seeds"], 1, "{row}");
    }
}

#[test]
fn bad_input_is_refused() {
    let folder = Folder::new("refused");
    let taken = folder.0.join("taken");
    std::fs::write(&taken, b"").expect("a file");
    for (options, expected) in [
        ("--scene streets", "streets"),
        ("--scene no/such/file.glb", "no/such/file.glb"),
        ("--frames 0,fifty", "fifty"),
        ("--frames 0,-1", "-1"),
        ("--frames ", "--frames"),
        ("--frames 100001", "--frames 100001"),
        ("--samples 0", "--samples 0"),
        ("--seeds 0", "--seeds 0"),
        ("--width 5000", "--width 5000"),
        ("--reference-samples 1", "--reference-samples 1"),
        ("--method best", "best"),
        ("--backend abacus", "abacus"),
    ] {
        let output = compare(&folder.0, &format!("{options} --quick"));
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{options} said {said}");
        assert!(
            said.contains(expected) && !said.contains("panicked"),
            "{options} said {said}"
        );
    }
    let output = compare(&taken, "--quick --backend cpu");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.code() == Some(2) && said.contains("taken"),
        "{said}"
    );
    assert!(!folder.0.join("results").exists());
}
