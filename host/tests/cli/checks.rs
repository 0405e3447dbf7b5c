//! Commands that check and measure.

use std::path::Path;

use serde_json::Value;

use crate::program::{Folder, json, json_on_cpu};

#[test]
fn verify_finds_trees_valid_and_compares_words_on_every_device() {
    let report = json("verify --json --queries 18000 --seed 7 --frames 0..2");
    assert_eq!(
        (&report["different"], &report["cpu_different"]),
        (&0.into(), &0.into())
    );
    assert_eq!(report["importances"], serde_json::json!(["moments", "eq4"]));
    assert_eq!(report["valid"], true, "{report}");
    let rows = report["rows"].as_array().expect("rows");
    // Three scenes, six methods with a light BVH, two frames.
    assert_eq!(rows.len(), 3 * 6 * 2);
    for row in rows {
        let is_there = |key: &str| row[key].as_u64() > Some(0);
        assert!(
            row["valid"] == true && is_there("nodes") && is_there("depth"),
            "{row}"
        );
    }
    for device in report["devices"].as_array().expect("devices") {
        assert_eq!(
            (&device["different"], &device["exact"]),
            (&0.into(), &true.into()),
            "{device}"
        );
        assert!(device["samples"].as_u64() >= Some(18000) && device["pmfs"].as_u64() >= Some(18000));
        let words = device["words"].as_object().expect("words by kind");
        for kind in ["nodes", "samples", "pmfs", "pixels"] {
            assert!(words[kind]["compared"].as_u64() > Some(0), "{kind}: {device}");
        }
        assert!(device["name"].is_string() && device["driver"].is_string());
    }
}

/// Eight importances: the default is one of them, and some choice is on the front. What is printed is what is written.
#[test]
fn trade_measures_each_choice() {
    let folder = Folder::new("trade");
    let report = json(&format!(
        "trade --json --quick --axes importance --frame 3 --time 1000 --out {}",
        folder.file("")
    ));
    let page = std::fs::read_to_string(folder.file("trade.html")).expect("a page");
    assert!(page.starts_with("<!doctype html>") && page.trim_end().ends_with("</html>"));
    let written = std::fs::read(folder.file("trade.json")).expect("JSON");
    let mut written: Value = serde_json::from_slice(&written).expect("JSON");
    let made = written.as_object_mut().and_then(|all| all.remove("made"));
    let made = made.expect("the machine");
    assert!(made["command"].to_string().contains("lightbvh trade "), "{made}");
    assert_eq!(written, report);
    let points = report["points"].as_array().expect("points");
    assert_eq!(points.len(), 8);
    let defaults = points.iter().filter(|point| point["default"] == true).count();
    assert_eq!(defaults, 1);
    // Moments without a uniform share differ a little, flux alone has far more variance.
    let of = |importance: &str, width: u64| {
        let is_it =
            |point: &&Value| point["config"]["importance"] == importance && point["config"]["width"] == width;
        let point = points.iter().find(is_it);
        point
            .and_then(|point| point["variance"].as_f64())
            .expect("a figure")
    };
    assert!(of("moments+1/64", 8) < 2.0 * of("moments", 8) && of("moments+1/64", 8) < of("flux", 8));
    assert!(of("moments+1/64", 8) < f64::min(5.0, of("eq4", 4)), "{report}");
    assert!(points.iter().any(|point| point["pareto"] == true));
    for point in points {
        for figure in [
            "variance",
            "error",
            "error_equal_time",
            "ns_per_sample",
            "build_ms",
            "refit_ms",
            "bytes_per_light",
        ] {
            assert!(
                point[figure].as_f64().is_some_and(|figure| figure > 0.0),
                "{figure}: {point}"
            );
        }
        // The image's error is that of unbiased samples.
        let [bias, ci95] = ["mean", "ci95"].map(|of| point["bias"][of].as_f64().expect("several images"));
        assert!(bias.abs() < f64::max(0.2, 3.0 * ci95), "{point}");
        let [low, high] = ["low", "high"].map(|end| point["time_ratio"][end].as_f64().expect("an interval"));
        assert!(low <= high && low > 0.0);
    }
    // Each choice of the front is in some sentence.
    let steps = report["steps"].to_string();
    assert!(steps.contains("least error in 1000 ms: "), "{steps}");
    let front: Vec<&Value> = points.iter().filter(|point| point["pareto"] == true).collect();
    for point in &front {
        let choice = point["choice"].as_str().expect("a name");
        assert!(front.len() == 1 || steps.contains(choice), "{choice}: {steps}");
    }
}

/// The default's mean is at most each peer's, and with two levels at most twice that with one. Exempt: `scattered` with two levels, whose
/// meshes' lights lie anywhere.
#[test]
fn variance_of_the_default_is_least() {
    let rows = json("variance --json --points 24");
    let rows = rows.as_array().expect("families");
    assert_eq!(rows.len(), 12);
    for row in rows {
        let mean = |choice: usize, levels: &str| {
            row["choices"][choice][levels]["mean"]
                .as_f64()
                .expect("lit points")
        };
        for levels in ["one", "two"] {
            let peers = [2, 3, 4].map(|choice| mean(choice, levels));
            let least = peers.into_iter().fold(f64::MAX, f64::min);
            let is_known = row["family"] == "scattered" && levels == "two";
            assert!(is_known || mean(0, levels) <= least, "{row}");
            assert!(is_known || mean(0, levels) <= 2.0 * mean(0, "one"), "{row}");
        }
    }
    let one = json("variance --json --points 3 --family hall --seed 2");
    assert_eq!(
        (one.as_array().map(Vec::len), &one[0]["family"]),
        (Some(1), &"hall".into())
    );
}

#[test]
fn bench_reports_every_case() {
    let report = json_on_cpu("bench --json --lights 2000 --queries 5000");
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
        for (what, key, value) in [
            ("build", "preset", "balanced"),
            ("refit", "passes", "levels"),
            ("sample", "variant", "one"),
            ("sample", "variant", "batch"),
        ] {
            let is_it = |case: &Value| case["what"] == what && case[key] == value;
            assert!(cases.iter().any(is_it), "no {what} by {value} of {structure}");
        }
    }
}

#[test]
fn demo_ends_with_no_word_different() {
    let folder = Folder::new("demo");
    let images = folder.file("images");
    let report = json(&format!("demo --json --out {images} --width 96 --height 54"));
    let rows = report["rows"].as_array().expect("rows");
    assert_eq!(rows[0]["backend"], "cpu");
    for row in &rows[1..] {
        assert_eq!(row["different"], 0, "{row}");
        // Four frames of all nodes, and pixels of three words.
        let least = 4 * 3 * 96 * 54;
        assert!(row["compared"].as_u64() > Some(least), "{row}");
    }
    for image in report["images"].as_array().expect("images") {
        assert!(Path::new(image.as_str().expect("a path")).exists());
    }
}
