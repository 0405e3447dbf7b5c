//! `lightbvh compare`, whole: what it says, what it leaves in its folder, and how it refuses.

use serde_json::Value;

use crate::program::{Folder, json, refused};

fn report(folder: &Folder, options: &str) -> Value {
    json(&format!("compare --json --out {} {options}", folder.file("")))
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
    let folder = Folder::new("compare-report");
    let report = report(&folder, &format!("{SMALL} {TWO_METHODS}"));
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
    assert!(scene["references"][0]["linear_mse"].as_f64() > Some(0.0));
    let written: Value =
        serde_json::from_slice(&std::fs::read(folder.0.join("compare.json")).expect("a file")).expect("JSON");
    assert_eq!(written, report);
}

#[test]
fn quick_compares_all_methods_on_all_scenes() {
    let folder = Folder::new("compare-quick");
    let report = report(&folder, "--quick --width 24 --height 16 --backend cpu");
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
        ] {
            let of_method = |row: &&Value| row["scene"] == scene && row["method"] == method;
            assert_eq!(
                rows(&report).iter().filter(of_method).count(),
                3,
                "{scene} {method}"
            );
        }
    }
}

#[test]
fn devices_render_the_words_of_the_cpu() {
    let folder = Folder::new("compare-devices");
    let methods = "--method single-level-refit --method single-level-rebuilt --method two-level-saoh \
                   --method two-level-moments";
    let report = report(&folder, &format!("{SMALL} {methods} --timed-frames 0"));
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
    let folder = Folder::new("compare-refused");
    let taken = folder.0.join("taken");
    std::fs::write(&taken, b"").expect("a file");
    for (options, expected) in [
        ("--scene streets", "streets"),
        ("--scene no/such/file.glb", "no/such/file.glb"),
        ("--frames 0,fifty", "fifty"),
        ("--frames 0,-1", "-1"),
        ("--frames ", "--frames"),
        ("--frames 100001", "100001 is not in"),
        ("--samples 0", "--samples"),
        ("--seeds 0", "--seeds"),
        ("--width 5000", "5000 is not in 1..=4096"),
        ("--reference-samples 1", "--reference-samples"),
        ("--method best", "best"),
        ("--backend abacus", "abacus"),
    ] {
        let out = folder.file("");
        let said = refused(&format!("compare --out {out} {options} --quick"));
        assert!(said.contains(expected), "{options} said {said}");
    }
    let said = refused(&format!(
        "compare --out {} --quick --backend cpu",
        folder.file("taken")
    ));
    assert!(said.contains("taken"), "{said}");
    assert!(!folder.0.join("compare.json").exists());
}
