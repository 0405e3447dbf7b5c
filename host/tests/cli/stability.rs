//! `lightbvh stability`: it passes, and it fails where it should.

use lightbvh::{BuildParams, LightBvh, Lights, Node};
use lightbvh_host::stability::cases::scattered;
use lightbvh_host::stability::row::{Check, Row};
use lightbvh_host::stability::{case, checks};

use crate::program::json_on_cpu;

#[test]
fn every_extreme_is_survived_on_the_cpu() {
    // Devices have a longer run of their own.
    let report = json_on_cpu("stability --quick --json");
    let rows = report["rows"].as_array().expect("rows");
    let failed: Vec<_> = rows.iter().filter(|row| row["pass"] != true).collect();
    assert!(failed.is_empty(), "{failed:#?}");
    assert!(rows.len() > 200, "only {} rows", rows.len());
    for row in rows {
        assert_eq!(row["device"], "cpu");
        assert!(
            row["name"].is_string() && row["worst"].as_f64() <= row["bound"].as_f64(),
            "{row}"
        );
    }
}

fn rows(break_it: impl Fn(&mut LightBvh)) -> Vec<Row> {
    let lights = Lights::new(scattered(100, 1)).expect("within the domain");
    let mut bvh = LightBvh::single_level(&lights, &BuildParams::default());
    break_it(&mut bvh);
    let points = case::Case::new("", lights.all().to_vec()).points;
    checks::check("broken", "single-level", (&bvh, &lights), &points, 20_000)
}

fn failed(rows: &[Row]) -> Vec<Check> {
    rows.iter().filter(|row| !row.pass).map(|row| row.check).collect()
}

#[test]
fn broken_trees_are_found() {
    assert_eq!(failed(&rows(|_| ())), []);

    // A child without flux: weights starve its lights.
    let dark = rows(|bvh| {
        let root = bvh.tree().root as usize;
        let node = &mut bvh.parts_mut().nodes[root];
        let mut summaries = std::array::from_fn(|slot| node.summary(slot));
        summaries[1].phi = 0.0;
        node.set_summaries(&summaries);
    });
    assert!(failed(&dark).contains(&Check::Starved), "{dark:#?}");
    assert!(dark.iter().filter(|row| !row.pass).all(|row| row.at.is_some()));

    // Two lights with each other's trails: what is sampled is not what is evaluated.
    let swapped = rows(|bvh| {
        let trails = bvh.parts_mut().trails;
        trails.swap(3, 60);
    });
    assert!(failed(&swapped).contains(&Check::Equal), "{swapped:#?}");
}
