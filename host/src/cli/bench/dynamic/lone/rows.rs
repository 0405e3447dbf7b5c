//! Rows of lone edits: how they are distributed, and how they grow.

use std::collections::BTreeMap;
use std::io;
use std::time::Duration;

use serde::Serialize;

use super::scene::{Sample, Scene};
use crate::cli::table;
use crate::cli::table::say;

/// One quantity of one kind of frame.
#[derive(Clone, Debug, Serialize)]
pub(in crate::cli::bench) struct Row {
    pub what: &'static str,
    /// Which kind of it.
    pub case: &'static str,
    /// What grows from row to row: `instances`, or the `triangles` of a mesh.
    pub over: &'static str,
    pub instances: u32,
    /// Of the mesh where that is what grows, or else in the world.
    pub triangles: u64,
    pub unit: &'static str,
    pub median: f64,
    pub p99: f64,
    pub most: f64,
    /// Number of frames.
    pub frames: usize,
}

impl Row {
    /// What grows from row to row.
    fn size(&self) -> f64 {
        match self.over {
            "triangles" => self.triangles as f64,
            _ => f64::from(self.instances),
        }
    }

    /// Whether there were frames enough for one of a hundred.
    fn tells_99(&self) -> bool {
        self.frames >= 100
    }
}

/// Bound of the start and the end of a frame, ns.
const BOUND: f64 = 300_000.0;

/// How many rows of starts and ends of frames and of adoptions are within their bound, 99 frames of 100 (all, where there were
/// fewer), and those that are not.
fn bounded(rows: &[Row]) -> (usize, Vec<&Row>) {
    let of_frames = rows
        .iter()
        .filter(|row| row.unit == "ns" && matches!(row.what, "begin-frame" | "end-frame" | "adopt"));
    let (within, beyond): (Vec<_>, Vec<_>) = of_frames.partition(|row| row.p99 <= BOUND);
    (within.len(), beyond)
}

/// How the medians of rows grow: `size` to the power of `exponent`.
#[derive(Clone, Debug, Serialize)]
pub(in crate::cli::bench) struct Growth {
    pub what: &'static str,
    pub case: &'static str,
    pub over: &'static str,
    pub unit: &'static str,
    /// By least squares over the logarithms of sizes and medians.
    pub exponent: f64,
}

/// What rows of one kind of frame have in common.
#[derive(Clone, Copy)]
pub(super) struct Kind {
    pub what: &'static str,
    pub case: &'static str,
    pub over: &'static str,
    pub instances: u32,
    pub triangles: u64,
}

impl Kind {
    /// Frames of a scene whose number of instances grows.
    pub fn of_instances(scene: &Scene, what: &'static str, case: &'static str) -> Self {
        Self {
            what,
            case,
            over: "instances",
            instances: scene.instances.len() as u32 + 1,
            triangles: scene.bvh.light_count() as u64,
        }
    }

    /// Frames of a scene whose mesh grows.
    pub fn of_mesh(scene: &Scene, what: &'static str, case: &'static str) -> Self {
        Self {
            over: "triangles",
            triangles: scene.triangles.len() as u64,
            ..Self::of_instances(scene, what, case)
        }
    }

    /// Rows of times, nodes and bytes.
    pub fn rows(self, samples: &[Sample]) -> Vec<Row> {
        if samples.is_empty() {
            return Vec::new();
        }
        let of = |unit, value: fn(&Sample) -> f64| self.row(unit, samples.iter().map(value).collect());
        vec![
            of("ns", |sample| sample.time.as_nanos() as f64),
            of("nodes", |sample| sample.nodes as f64),
            of("bytes", |sample| sample.bytes as f64),
        ]
    }

    /// The row of times; none where there were no such frames.
    pub fn times(self, times: &[Duration]) -> Option<Row> {
        let ns = times.iter().map(|time| time.as_nanos() as f64);
        (!times.is_empty()).then(|| self.row("ns", ns.collect()))
    }

    fn row(self, unit: &'static str, mut values: Vec<f64>) -> Row {
        values.sort_by(f64::total_cmp);
        let last = values.len().saturating_sub(1);
        let part = |share: f64| values[(last as f64 * share).ceil() as usize];
        Row {
            what: self.what,
            case: self.case,
            over: self.over,
            instances: self.instances,
            triangles: self.triangles,
            unit,
            median: part(0.5),
            p99: part(0.99),
            most: part(1.0),
            frames: values.len(),
        }
    }
}

/// How the medians grow, kind by kind, where there are two sizes at least.
pub(super) fn growth(rows: &[Row]) -> Vec<Growth> {
    let mut kinds: BTreeMap<_, Vec<(f64, f64)>> = BTreeMap::new();
    for row in rows {
        // What is nothing at all does not grow.
        let point = (row.size().ln(), row.median.max(1.0).ln());
        let kind = (row.over, row.what, row.case, row.unit);
        kinds.entry(kind).or_default().push(point);
    }
    let several = kinds.into_iter().filter(|(_, points)| points.len() > 1);
    several
        .map(|((over, what, case, unit), points)| Growth {
            what,
            case,
            over,
            unit,
            exponent: slope(&points),
        })
        .collect()
}

/// Slope of the line through the points by least squares.
fn slope(points: &[(f64, f64)]) -> f64 {
    let count = points.len() as f64;
    let mean = |value: fn(&(f64, f64)) -> f64| points.iter().map(value).sum::<f64>() / count;
    let (x, y) = (mean(|point| point.0), mean(|point| point.1));
    let across: f64 = points.iter().map(|point| (point.0 - x) * (point.1 - y)).sum();
    let along: f64 = points.iter().map(|point| (point.0 - x).powi(2)).sum();
    across / along
}

/// Prints the tables.
pub(in crate::cli::bench) fn print(report: &super::Report) -> io::Result<()> {
    table::print(
        &report.rows,
        &[
            ("what", |r| r.what.to_owned()),
            ("case", |r| r.case.to_owned()),
            ("over", |r| r.over.to_owned()),
            ("instances", |r| r.instances.to_string()),
            ("triangles", |r| r.triangles.to_string()),
            ("unit", |r| r.unit.to_owned()),
            ("median", |r| format!("{:.0}", r.median)),
            ("99 %", |r| match r.tells_99() {
                true => format!("{:.0}", r.p99),
                false => "–".to_owned(),
            }),
            ("most", |r| format!("{:.0}", r.most)),
            ("frames", |r| r.frames.to_string()),
        ],
    )?;
    let (within, beyond) = bounded(&report.rows);
    say!(
        "\nstarts and ends of frames, and adoptions, of which 99 % take 0.3 ms at most on the wall: {within} rows"
    )?;
    for row in beyond {
        let (size, over) = (row.size(), row.over);
        say!(
            "beyond: {}, {}, {size:.0} {over}: 99 % within {:.0} µs",
            row.what,
            row.case,
            row.p99 * 1e-3
        )?;
    }
    say!("")?;
    table::print(
        &report.growth,
        &[
            ("what", |g| g.what.to_owned()),
            ("case", |g| g.case.to_owned()),
            ("over", |g| g.over.to_owned()),
            ("unit", |g| g.unit.to_owned()),
            ("exponent", |g| format!("{:.2}", g.exponent)),
        ],
    )?;
    let quality = &report.quality;
    say!(
        "\nvariance after {} edits of {} instances, without a rebuild: {:.4}; of a top level built over the same: {:.4}; ratio at a point {:.3} (geometric mean), \
         {:.3} (median), at most {:.2} at nine in ten points, {:.2} at the worst",
        quality.edits,
        quality.instances,
        quality.edited,
        quality.fresh,
        quality.ratio,
        quality.median_ratio,
        quality.ninth_ratio,
        quality.most_ratio
    )?;
    for left_out in &report.left_out {
        say!("left out: {left_out}")?;
    }
    say!("")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_has_its_exponent() {
        let row = |instances, median| Row {
            what: "add",
            case: "",
            over: "instances",
            instances,
            triangles: 0,
            unit: "ns",
            median,
            p99: 0.0,
            most: 0.0,
            frames: 1,
        };
        let rows = [row(1_000, 3e3), row(10_000, 3e4), row(100_000, 3e5)];
        let growth = growth(&rows);
        assert!((growth[0].exponent - 1.0).abs() < 1e-9, "{growth:?}");
        assert!((slope(&[(0.0, 5.0), (1.0, 5.0), (2.0, 5.0)])).abs() < 1e-9);
    }

    #[test]
    fn rows_beyond_the_bound_are_named() {
        let row = |what, unit, p99, frames| Row {
            what,
            case: "",
            over: "triangles",
            instances: 1,
            triangles: 5,
            unit,
            median: 0.0,
            p99,
            most: p99,
            frames,
        };
        let rows = [
            row("adopt", "ns", 3e5, 100),
            row("end-frame", "ns", 3.1e5, 99),
            row("begin-frame", "ns", 1.0, 100),
            row("adopt", "bytes", 1e9, 100),
            row("deform", "ns", 1e9, 100),
        ];
        let (within, beyond) = bounded(&rows);
        assert_eq!((within, beyond.len()), (2, 1));
        assert_eq!((beyond[0].what, beyond[0].size()), ("end-frame", 5.0));
        assert!(rows[0].tells_99() && !rows[1].tells_99());
    }

    #[test]
    fn the_99th_part_is_not_the_most() {
        let kind = Kind {
            what: "add",
            case: "",
            over: "instances",
            instances: 1,
            triangles: 1,
        };
        let row = kind.row("ns", (0..1001).rev().map(f64::from).collect());
        assert_eq!([row.median, row.p99, row.most], [500.0, 990.0, 1000.0]);
    }
}
