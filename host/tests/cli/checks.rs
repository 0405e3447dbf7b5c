//! Commands that check and measure.

use std::path::Path;

use crate::program::{Folder, has_device, json};

#[test]
fn verify_compares_words_on_every_device() {
    if !has_device() {
        return;
    }
    let report = json(
        "verify --json --queries 3000 --scene street --seed 7 --frames 0..3 --frame-queries 64 --refits 2",
    );
    assert_eq!(report["different"], 0);
    assert_eq!(report["cpu_different"], 0);
    assert_eq!(report["frames"], serde_json::json!({ "start": 0, "end": 3 }));
    assert_eq!(report["importances"], serde_json::json!(["moments", "eq4"]));
    for device in report["devices"].as_array().expect("devices") {
        assert_eq!(device["different"], 0, "{device}");
        assert_eq!(device["exact"], true, "{device}");
        // Six methods with a light BVH over three frames.
        let queries = 3000 + 6 * 3 * 64;
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

/// Three widths: the default is one of them, and some choice is on the front. What is printed is what is written.
#[test]
fn trade_measures_each_choice() {
    let folder = Folder::new("trade");
    let report = json(&format!(
        "trade --json --quick --axes width --out {}",
        folder.file("")
    ));
    let page = std::fs::read_to_string(folder.file("trade.html")).expect("a page");
    assert!(page.starts_with("<!doctype html>") && page.trim_end().ends_with("</html>"));
    let written = std::fs::read(folder.file("trade.json")).expect("JSON");
    let mut written: serde_json::Value = serde_json::from_slice(&written).expect("JSON");
    let made = written
        .as_object_mut()
        .and_then(|all| all.remove("made"))
        .expect("the machine");
    assert!(
        made["command"]
            .as_str()
            .is_some_and(|line| line.starts_with("lightbvh trade ")),
        "{made}"
    );
    assert_eq!(written, report);
    let points = report["points"].as_array().expect("points");
    assert_eq!(points.len(), 3);
    let defaults: Vec<bool> = points.iter().map(|point| point["default"] == true).collect();
    assert_eq!(defaults, [true, false, false]);
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
        // One candidate has the variance of the tree; the image's error is that of unbiased samples.
        assert!(
            point["variance"].as_f64().is_some_and(|variance| variance < 5.0),
            "{point}"
        );
        let bias = point["bias"]["mean"].as_f64().expect("several images");
        assert!(bias.abs() < 0.2, "{point}");
        let [low, high] = ["low", "high"].map(|end| point["time_ratio"][end].as_f64().expect("an interval"));
        assert!(low <= high && low > 0.0);
    }
    // Each choice of the front is in some sentence.
    let steps = report["steps"].to_string();
    let front: Vec<&serde_json::Value> = points.iter().filter(|point| point["pareto"] == true).collect();
    for point in &front {
        let choice = point["choice"].as_str().expect("a name");
        assert!(front.len() == 1 || steps.contains(choice), "{choice}: {steps}");
    }
}

/// ReSTIR beside the default: unbiased, by whole histories of six rays.
#[test]
fn trade_measures_restir() {
    let report = json("trade --json --quick --axes integrator --size 48x27 --frame 12");
    let points = report["points"].as_array().expect("points");
    let restir: Vec<_> = points
        .iter()
        .filter(|point| point["config"]["integrator"] == "restir")
        .collect();
    let sources: Vec<_> = restir.iter().map(|point| &point["config"]["levels"]).collect();
    assert_eq!(sources, ["power", "two-level"]);
    for point in restir {
        assert!(point["error"].as_f64() > Some(0.0), "{point}");
        assert!(point["error_equal_time"].as_f64() > Some(0.0), "{point}");
        let bias = point["bias"]["mean"].as_f64().expect("several images");
        assert!(bias.abs() < 0.3, "{point}");
    }
}

/// More time, less error; less error, more time.
#[test]
fn trade_picks_within_a_budget() {
    let pick = |budget: &str| {
        let line = format!("trade --json --scene street --axes candidates --size 48x27 --frame 3 {budget}");
        let report = json(&line);
        let pick = &report["pick"][0];
        assert_eq!(pick["scene"], "street");
        assert!(pick["config"]["importance"].is_string(), "{pick}");
        assert!(pick["sentence"].is_string());
        ["frame_ms", "error"].map(|figure| pick[figure].as_f64().expect("a figure"))
    };
    // The machine says itself what several images take: in milliseconds that are the same everywhere, a fast one reaches the most
    // images that are tried by both budgets, and what is left between them is noise.
    let wanted = 0.06;
    let [time, reached] = pick(&format!("--error {wanted}"));
    assert_eq!(reached, wanted);
    let [little, coarse] = pick(&format!("--time {}", 2.0 * time));
    let [_, fine] = pick(&format!("--time {}", 50.0 * time));
    assert!(
        little <= 2.0 * time && fine < coarse,
        "{time} ms: {little} ms, {coarse} {fine}"
    );
    let none = json("trade --json --scene street --axes width --size 48x27 --frame 3 --time 1e-6");
    assert!(none["pick"][0].is_null(), "{none}");
}

#[test]
fn bench_reports_every_case() {
    let report = json("bench --json --lights 2000 --queries 5000 --no-trade");
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
            ("build", "preset", "fast"),
            ("build", "preset", "balanced"),
            ("build", "preset", "best"),
            ("refit", "passes", "levels"),
            ("sample", "variant", "one"),
            ("sample", "variant", "batch"),
        ] {
            let is_it = |case: &serde_json::Value| case["what"] == what && case[key] == value;
            assert!(cases.iter().any(is_it), "no {what} by {value} of {structure}");
        }
    }
}

#[test]
fn bench_follows_moving_lights() {
    let report = json("bench --json --dynamic --instances 200 --mesh-triangles 20 --largest 1000");
    assert_eq!(report["left_out"], serde_json::json!([]));
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
    // What little changes costs little: no more than its paths to the root.
    assert!(nodes(of("move", 200, 2)) * 4 < nodes(all), "{all}");
    assert!(nodes(of("shine", 200, 2)) * 4 < nodes(all), "{all}");
    of("move", 200, 20);
    of("move", 20, 2);
    assert_eq!(of("deform", 1, 4000)["triangles"], 4000);
}

#[test]
fn bench_tells_how_lone_edits_grow() {
    let report = json("bench --json --dynamic --quick --largest 10000");
    let rows = report["rows"].as_array().expect("rows");
    let has = |what: &str, over: &str, unit: &str| {
        let of = |size: u64| {
            rows.iter().any(|row| {
                let found = row[over].as_u64().expect("a size");
                row["what"] == what && row["over"] == over && row["unit"] == unit && found == size
            })
        };
        assert!(of(1_000) && of(10_000), "{what} {over} {unit}");
    };
    for what in ["add", "remove", "move", "dim", "deform", "adopt"] {
        for unit in ["ns", "nodes", "bytes"] {
            has(what, "instances", unit);
        }
    }
    for what in ["begin-frame", "end-frame"] {
        has(what, "instances", "ns");
        has(what, "triangles", "ns");
    }
    for unit in ["ns", "nodes", "bytes"] {
        has("deform", "triangles", unit);
        has("adopt", "triangles", unit);
    }
    for row in rows {
        let [median, p99, most] = ["median", "p99", "most"].map(|key| row[key].as_f64().expect("a number"));
        assert!(median <= p99 && p99 <= most && most > 0.0, "{row}");
    }
    // Moving one of ten times as many computes a level more at most.
    let growth = report["growth"].as_array().expect("growth");
    let moves = growth
        .iter()
        .find(|row| row["what"] == "move" && row["unit"] == "nodes")
        .expect("moves");
    assert!(moves["exponent"].as_f64() < Some(0.3), "{moves}");
    assert!(!report["left_out"].as_array().expect("a list").is_empty());
    assert!(report["dynamic"].is_null());
    let quality = &report["quality"];
    assert!(quality["edited"].as_f64() > Some(0.0), "{quality}");
    // The bound, a tenth, is of a full run; here fewer edits are made.
    assert!(quality["ratio"].as_f64() < Some(1.2), "{quality}");
}

#[test]
fn validate_finds_the_scenes_valid() {
    for scene in ["street", "square", "carousel"] {
        for importance in ["moments", "eq4"] {
            let report = json(&format!("validate {scene} --importance {importance} --json"));
            assert_eq!(report["valid"], true, "{report}");
            assert_eq!(report["importance"], importance);
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
        // Four frames of all nodes, 100,000 samples of two words, and pixels of three.
        let least = 4 * (2 * 100_000 + 3 * 96 * 54);
        assert!(row["compared"].as_u64() > Some(least), "{row}");
    }
    for image in report["images"].as_array().expect("images") {
        assert!(Path::new(image.as_str().expect("a path")).exists());
    }
}
