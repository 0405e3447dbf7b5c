//! Lone edits: what one frame costs in which one of many things changes, by how many there are.
//!
//! Every row is a frame of an otherwise still scene, with all that its user pays for: the edit, the refit that it causes, and
//! beside it what a device must copy. Instances are scattered, and which of them changes is drawn anew in each frame.

mod edits;
mod frames;
mod handed;
mod meshes;
mod quality;
mod rows;
mod scene;

use std::time::{Duration, Instant};

use serde::Serialize;

use self::quality::Quality;
pub(in crate::cli::bench) use self::rows::print;
use self::rows::{Growth, Row, growth};
use self::scene::Scene;
use crate::cli::table::news;

/// Least and greatest number of instances, or of triangles of a mesh.
pub(in crate::cli::bench) const SIZES: [u32; 2] = [1_000, 1_000_000];

/// Most that a quick run takes: what would go on for longer is left out.
const QUICK: Duration = Duration::from_secs(45);

/// Edits after which variance is taken.
const EDITS: u32 = 100_000;

/// How long, and how often, a row is measured.
#[derive(Clone, Copy)]
struct Patience {
    time: Duration,
    least: usize,
    most: usize,
}

impl Patience {
    const FULL: Self = Self {
        time: Duration::from_millis(1500),
        least: 20,
        most: 20_000,
    };
    const QUICK: Self = Self {
        time: Duration::from_millis(250),
        least: 4,
        most: 2_000,
    };

    /// Calls `frame`, which gets the number of frames before it, until there were enough.
    fn frames(self, mut frame: impl FnMut(usize)) {
        let began = Instant::now();
        let mut done = 0;
        while done < self.least || (done < self.most && began.elapsed() < self.time) {
            frame(done);
            done += 1;
        }
    }
}

/// All rows.
#[derive(Clone, Debug, Serialize)]
pub(in crate::cli::bench) struct Report {
    pub rows: Vec<Row>,
    pub growth: Vec<Growth>,
    /// What edits leave of a tree.
    pub quality: Quality,
    /// What a quick run does not measure.
    pub left_out: Vec<String>,
}

/// Measures at each power of ten from the least size to `largest`.
pub(in crate::cli::bench) fn report(largest: u32, is_quick: bool) -> Report {
    let patience = if is_quick { Patience::QUICK } else { Patience::FULL };
    let sizes: Vec<u32> = std::iter::successors(Some(SIZES[0]), |size| size.checked_mul(10))
        .take_while(|&size| size <= largest)
        .collect();
    let mut rows = Vec::new();
    let mut left_out = Vec::new();
    let began = Instant::now();
    let edits = if is_quick { EDITS / 10 } else { EDITS };
    news!("{edits} edits");
    let quality = quality::measure(edits);
    let mut last = Duration::ZERO;
    for &size in &sizes {
        // Ten times as many take about ten times as long.
        if is_quick && size > 100_000 && began.elapsed() + 10 * last > QUICK {
            left_out.push(format!("sizes from {size} on, for which there is no time left"));
            break;
        }
        let start = Instant::now();
        news!("one of {size} instances");
        let mut scene = Scene::of_instances(size);
        rows.extend(edits::rows(&mut scene, patience));
        rows.extend(frames::rows(&mut scene, patience));
        drop(scene);
        news!("a mesh of {size} instances");
        let mut scene = Scene::of_users(size);
        rows.extend(handed::rows(&mut scene, patience));
        drop(scene);
        news!("a mesh of {size} triangles");
        let mut scene = Scene::of_mesh(size);
        rows.extend(meshes::rows(&mut scene, patience));
        last = start.elapsed();
    }
    if is_quick {
        left_out
            .push("frames in which much moves, and devices (`bench --dynamic` without `--quick`)".to_owned());
        left_out.push(format!(
            "{} of {EDITS} edits before variance is taken",
            EDITS - edits
        ));
        left_out.push(format!(
            "long series: a row has {} ms or {} frames, where a full run has {} ms or {} frames",
            Patience::QUICK.time.as_millis(),
            Patience::QUICK.least,
            Patience::FULL.time.as_millis(),
            Patience::FULL.least
        ));
    }
    Report {
        growth: growth(&rows),
        rows,
        quality,
        left_out,
    }
}
