//! `lightbvh compare`, whole: what it says.

use serde_json::Value;

use crate::program::{json, run};

fn report(options: &str) -> Value {
    json(&format!("compare --json {options}"))
}

const SMALL: &str =
    "--scene street --width 32 --height 18 --samples 1 --seeds 2 --reference-samples 4 --frames 9,0";
const TWO_METHODS: &str = "--method single-level-refit --method two-level-saoh --backend cpu";

fn rows(report: &Value) -> &Vec<Value> {
    report["rows"].as_array().expect("rows")
}

#[test]
fn the_report_has_every_measure() {
    let report = report(&format!("{SMALL} {TWO_METHODS}"));
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
    let output = run(&format!("compare {SMALL} {TWO_METHODS}"));
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        said.contains("street: errors") && said.contains("\ntwo-level-saoh "),
        "{said}"
    );
}
