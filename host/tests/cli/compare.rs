//! `lightbvh compare`, whole: what it says, what it leaves in its folder, and how it refuses.

use serde_json::Value;

use crate::program::{Folder, json, refused};

fn report(folder: &Folder, options: &str) -> Value {
    json(&format!("compare --json --out {} {options}", folder.file("")))
}

const SMALL: &str =
    "--scene street --width 32 --height 18 --samples 1 --seeds 2 --reference-samples 4 --frames 9,0";
const TWO_METHODS: &str = "--method single-level-refit --method two-level-saoh --backend cpu";

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
    let report = report(&folder, "--quick --width 24 --height 16 --seeds 1 --backend cpu");
    // Three scenes, nine methods, three frames.
    assert_eq!(rows(&report).len(), 3 * 9 * 3);
}

#[test]
fn bad_input_is_refused() {
    let folder = Folder::new("compare-refused");
    let taken = folder.0.join("taken");
    std::fs::write(&taken, b"").expect("a file");
    for (options, expected) in [
        ("--scene streets", "streets"),
        ("--scene no/such/file.glb", "no/such/file.glb"),
        ("--frames 100001", "100001 is not in"),
        ("--samples 0", "--samples"),
        ("--reference-samples 1", "--reference-samples"),
        ("--method best", "best"),
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
