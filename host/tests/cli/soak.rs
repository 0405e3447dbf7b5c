//! A short soak: as long a one as a test may be.

use crate::program::json;

#[test]
fn a_soak_finds_nothing() {
    let report = json("verify --json --soak 2000 --instances 100 --mesh-triangles 20000 --seed 5");
    let report = &report["soak"];
    assert_eq!(report["invalid"], serde_json::Value::Null);
    assert_eq!(report["frames"], 2000);
    let edits = &report["edits"];
    for what in [
        "added",
        "removed",
        "moved",
        "dimmed",
        "deformed",
        "exchanged",
        "swapped",
        "rebuilt",
    ] {
        assert!(edits[what].as_u64() > Some(50), "{what}: {edits}");
    }
    assert_eq!(edits["checked"], 2);
    for device in report["devices"].as_array().expect("devices") {
        assert!(device["compared"].as_u64() > Some(10_000), "{device}");
        assert_eq!(device["different"], 0, "{device}");
    }
    assert_eq!(edits["inline"], 0, "threads build, no frame");
    let rows = report["rows"].as_array().expect("rows");
    let parts: Vec<_> = rows.iter().map(|row| &row["what"]).collect();
    assert_eq!(parts, ["begin-frame", "apply", "refit", "end-frame"]);
    for row in rows {
        assert!(
            row["us"]["median"].as_f64() <= row["us"]["most"].as_f64(),
            "{row}"
        );
    }
    for memory in ["memory", "process"] {
        assert_eq!(report[memory]["flat"], true, "{memory}: {}", report[memory]);
    }
}
