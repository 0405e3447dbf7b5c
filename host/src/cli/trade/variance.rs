//! The exact variance of one sample by every choice that has a tree of its own, scene by scene: no image, no time.

use std::time::Instant;

use serde::Serialize;
use serde_json::json;

use super::Args;
use super::choices::all;
use super::structure::{Arriving, Variances};
use super::subject::{Axis, Config};
use crate::cli::measure::{NOT_MEASURED, points};
use crate::cli::table::{self, news};
use crate::cli::{Context, Outcome};
use crate::error::HostError;
use crate::method::Step;
use crate::scene::Scene;
use crate::workload::{arrays_at, lights_at};

/// Axes that differ in the probabilities of lights, of trees as they are built.
const AXES: [Axis; 5] = [
    Axis::Importance,
    Axis::Builder,
    Axis::Levels,
    Axis::Candidates,
    Axis::Arithmetic,
];

#[derive(Debug, Serialize)]
struct Row {
    scene: String,
    choice: String,
    config: Config,
    #[serde(flatten)]
    variances: Variances,
}

pub(super) fn run(context: &Context, args: &Args, scenes: &[String]) -> Result<Outcome, HostError> {
    let mut rows = Vec::new();
    for name in scenes {
        let start = Instant::now();
        let scene = args.reading.open(name)?;
        for warning in scene.warnings().iter().chain(&scene.unknown_lights()) {
            news!("{name}: {warning}");
        }
        let own = of_scene(&scene, args.frame, args.points, |axis| args.measures(axis))?;
        if own.iter().all(|row| row.variances.variance.is_none()) {
            news!("{name}: {NOT_MEASURED}");
        }
        rows.extend(own);
        news!("{name}: {:.1} s", start.elapsed().as_secs_f64());
    }
    if context.json {
        table::print_json(&json!({ "points": args.points, "frame": args.frame, "rows": rows }))?;
    } else {
        table::print(&rows, COLUMNS)?;
    }
    Ok(Outcome::Good)
}

/// Of trees built in `frame`.
fn of_scene(
    scene: &Scene,
    frame: u32,
    count: u32,
    is_wanted: impl Fn(Axis) -> bool,
) -> Result<Vec<Row>, HostError> {
    let lights = lights_at(scene, frame)?;
    let points = points::on_surfaces(scene, frame, count);
    let arrays = arrays_at(scene, frame, 16, 9)?;
    let arriving = Arriving::new(&lights, &points, &arrays.rays.surfaces());
    let built = Step::new(scene, frame, &lights);
    let subjects = all(&built, |axis| AXES.contains(&axis) && is_wanted(axis))?;
    let rows = subjects.iter().map(|subject| Row {
        scene: scene.name().to_owned(),
        choice: subject.config().to_string(),
        config: subject.config(),
        variances: arriving.variances(&**subject),
    });
    Ok(rows.collect())
}

const COLUMNS: &[table::Column<Row>] = &[
    ("scene", |r| r.scene.clone()),
    ("choice", |r| r.choice.clone()),
    ("mean", |r| table::known(r.variances.variance, 3)),
    ("median", |r| table::known(r.variances.variance_median, 3)),
    ("shadowed, mean", |r| {
        table::known(r.variances.shadowed_variance, 2)
    }),
    ("median", |r| {
        table::known(r.variances.shadowed_variance_median, 2)
    }),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::measure::tests::room;

    #[test]
    fn what_is_not_measured_has_no_figure() {
        for is_lit in [false, true] {
            for row in of_scene(&room(is_lit), 0, 32, |axis| axis == Axis::Importance).expect("lights") {
                let figures = [row.variances.variance, row.variances.variance_median];
                assert_eq!(figures.map(|figure| figure.is_some()), [is_lit; 2], "{row:?}");
            }
        }
    }
}
