//! Candidates for cells in place of points: 32 for each of 40,000 cells of a metre below streets of lamps. A point of a cell is lit by one
//! lamp of eight out of its cell's 32, without a walk of its own.
//!
//! `cargo run --release -p lightbvh --example cells` (seconds). Prints the time, the squared error next to that of eight candidates walked
//! for each point, and checks that the means are right.

use std::time::Instant;

use lightbvh::exact::{hash, unit_f32};
use lightbvh::importance::Cell;
use lightbvh::reservoir::{Resampling, target};
use lightbvh::{EmissiveTriangle, LightBvh, SampledLight, ShadingPoint, Transform};

/// Along each side of the ground.
const CELLS: u32 = 200;
/// One cell in this many is tested, at 20 points.
const EVERY: usize = 40;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Twenty streets of a hundred lamps that shine down, 4 m high.
    let lamp = EmissiveTriangle {
        p: [[0.0, 4.0, 0.0], [0.3, 4.0, 0.0], [0.0, 4.0, 0.3]],
        radiance: [9.0; 3],
        mesh: 0,
        flags: 0,
    };
    let mut bvh = LightBvh::default();
    let mesh = bvh.add_mesh(vec![lamp])?;
    for k in 0..2000_u16 {
        let at = [f32::from(k % 100) * 2.0, 0.0, f32::from(k / 100) * 10.0];
        bvh.add_instance(mesh, Transform::at(at))?;
    }
    bvh.refit();

    // Cells of the ground, each from 16 of its points.
    let mut cells = Vec::new();
    for place in 0..CELLS * CELLS {
        let points: [ShadingPoint; 16] = core::array::from_fn(|k| point(place, k as u32));
        cells.push(Cell::around(&points).expect("points").checked()?);
    }
    let start = Instant::now();
    let fill = |(place, cell)| bvh.tree().sample_many(cell, hash(place));
    let filled: Vec<[SampledLight; 32]> = (0..).zip(&cells).map(fill).collect();
    let ms = start.elapsed().as_secs_f64() * 1e3;
    println!("{} cells of 32 candidates: {ms:.0} ms on one thread", cells.len());

    let all = bvh.view().world_lights();
    let (mut of_cells, mut of_points) = (Vec::new(), Vec::new());
    for (place, candidates) in (0..).zip(&filled).step_by(EVERY) {
        for k in 0..20 {
            // Points of the cell other than those that it was made from.
            let point = point(place, 16 + k);
            let right: f64 = all.iter().map(|light| sent(light, &point)).sum();
            let random = hash(place ^ (k << 16));
            // Every fourth: as even as all of them.
            let eight = candidates.iter().skip(random as usize % 4).step_by(4);
            of_cells.push(one_of(eight, &all, &point, random) / right);
            let own: [SampledLight; 8] = bvh.tree().sample_many(&point, random);
            of_points.push(one_of(&own, &all, &point, random) / right);
        }
    }
    report("one of eight of the cell's", &of_cells);
    report("one of eight of its own", &of_points);
    Ok(())
}

/// A point of the cell, by number.
fn point(place: u32, number: u32) -> ShadingPoint {
    let within = |axis: u32| unit_f32(hash(hash(place).wrapping_add(2 * number + axis)));
    ShadingPoint {
        p: [
            (place % CELLS) as f32 + within(0),
            0.0,
            (place / CELLS) as f32 + within(1),
        ],
        n: [0.0, 1.0, 0.0],
    }
}

/// What arrives from one of the candidates, chosen in proportion to what it sends over its probability: its shadow ray carries all.
fn one_of<'a>(
    candidates: impl IntoIterator<Item = &'a SampledLight>,
    all: &[EmissiveTriangle],
    point: &ShadingPoint,
    random: u32,
) -> f64 {
    let mut stream = Resampling::EMPTY;
    let mut chosen = 0.0;
    for (k, sampled) in (0..).zip(candidates) {
        let sent = sent(&all[sampled.light as usize], point);
        if stream.candidate(target(sent as f32), sampled.pmf, hash(random.wrapping_add(k))) {
            chosen = sent;
        }
    }
    chosen * f64::from(stream.weight())
}

/// Irradiance from the middle of a lamp over its density, without a shadow.
fn sent(light: &EmissiveTriangle, point: &ShadingPoint) -> f64 {
    light.point([0.5; 2]).irradiance(point)[0].into()
}

/// Prints mean and squared error. Points of a cell share candidates, so each cell's mean counts once.
fn report(name: &str, values: &[f64]) {
    let mean = |of: &[f64]| of.iter().sum::<f64>() / of.len() as f64;
    let squares = |of: &[f64]| mean(&of.iter().map(|value| (value - 1.0).powi(2)).collect::<Vec<_>>());
    let means: Vec<f64> = values.chunks(20).map(mean).collect();
    let sure = 5.0 * (squares(&means) / means.len() as f64).sqrt() + 1e-3;
    let (found, error) = (mean(values), squares(values));
    println!("{name}: squared error {error:.4}, mean {found:.4} ± {sure:.4}");
    assert!((found - 1.0).abs() < sure, "biased");
}
