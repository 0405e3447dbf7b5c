//! A short soak: as long a one as a test may be.

use crate::program::{refused, run};

/// Parts of frames that other tests beside this one may bring beyond their bound in time, one in a hundred: alone on slow
/// machines 0 to 2 are, beside the other tests 12 were. A full soak allows none; what is counted in place of timed allows none
/// here either.
const DISTURBED: u64 = 80;

#[test]
fn a_soak_finds_nothing() {
    let output = run("soak --json --frames 2000 --instances 100 --mesh-triangles 20000 --seed 5");
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("one JSON object");
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
        "adopted",
    ] {
        assert!(edits[what].as_u64() > Some(50), "{what}: {edits}");
    }
    assert_eq!(edits["checked"], 2);
    for device in report["devices"].as_array().expect("devices") {
        assert!(device["compared"].as_u64() > Some(10_000), "{device}");
        assert_eq!(device["different"], 0, "{device}");
    }
    assert_eq!(edits["inline"], 0, "threads build, no frame");
    let copied = edits["copied"].as_u64();
    assert!(copied > Some(0) && copied <= report["bytes"].as_u64(), "{edits}");
    let rows = report["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 8, "four parts by two clocks");
    assert!(
        report["beyond"].as_u64() <= Some(DISTURBED),
        "{}",
        report["first_beyond"]
    );
    assert_eq!(report["parts"], 8000);
    for memory in ["memory", "process"] {
        assert_eq!(report[memory]["flat"], true, "{memory}: {}", report[memory]);
    }
}

#[test]
fn a_soak_of_nothing_is_refused() {
    for line in ["--frames 0", "--instances 0", "--mesh-triangles 0", "--late 1001"] {
        let said = refused(&format!("soak {line}"));
        assert!(said.contains(line), "{said}");
    }
}
