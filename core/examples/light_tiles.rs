//! Light tiles: a grid of cells, each with lights chosen for its middle before the frame, from which points then draw instead
//! of walking the tree. After C. Wyman & A. Panteleev, "Rearchitecting Spatiotemporal Resampling for Production", HPG 2021
//! (section 5, tiles of presampled lights), and J. Boksansky et al., "Rendering Many Lights with Grid-Based Reservoirs", Ray
//! Tracing Gems II, 2021.
//!
//! `cargo run --release -p lightbvh --example light_tiles` (seconds). Prints the error and the time of one resampled light for
//! a point, each from as many candidates, and checks that the means are right.

use std::time::Instant;

use lightbvh::exact::{hash, unit_f32};
use lightbvh::{BuildParams, EmissiveTriangle, LightBvh, Lights, Random64, SampledLight, ShadingPoint};

/// Candidates of a cell, and of a point.
const OF_CELL: usize = 128;
const OF_POINT: usize = 8;
/// Side of a cell, metres.
const CELL: f32 = 4.0;
const SIDE: usize = 16;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // 20,000 lamps that shine down from 2 to 6 m above a square of 64 m.
    let lamp = |k: u32| {
        let random = |n: u32| unit_f32(hash(hash(k).wrapping_add(n)));
        let [x, y, z] = [64.0 * random(0), 2.0 + 4.0 * random(1), 64.0 * random(2)];
        EmissiveTriangle {
            p: [[x, y, z], [x + 0.05, y, z], [x, y, z + 0.05]],
            radiance: [1000.0 * random(3); 3],
            mesh: 0,
            flags: 0,
        }
    };
    let lights = Lights::new((0..20_000).map(lamp).collect())?;
    let bvh = LightBvh::single_level(&lights, &BuildParams::default());

    let start = Instant::now();
    let mut tiles = vec![[SampledLight::NONE; OF_CELL]; SIDE * SIDE];
    for (tile, cell) in tiles.iter_mut().zip(0_u8..=255) {
        fill(&bvh, cell, 0, tile);
    }
    println!(
        "{} cells of {OF_CELL} candidates in {:.1} ms",
        tiles.len(),
        1e3 * start.elapsed().as_secs_f64()
    );

    let point = |k: u32| ShadingPoint {
        p: [64.0 * unit_f32(hash(k)), 0.0, 64.0 * unit_f32(hash(!k))],
        n: [0.0, 1.0, 0.0],
    };
    let walk = |k: u32| bvh.sample_many::<OF_POINT>(&point(k), hash(k ^ 0x5bd1_e995));
    let single = |k: u32| [bvh.sample(&point(k), hash(k ^ 0x5bd1_e995))];
    let of_tile = |tiles: &[[SampledLight; OF_CELL]], k: u32| {
        // In strata over the tile, whose candidates lie in the order of lights.
        let tile = &tiles[cell_of(&point(k))];
        std::array::from_fn::<_, OF_POINT, _>(|n| {
            let within = OF_CELL / OF_POINT;
            tile[n * within + hash(k.wrapping_add(hash(n as u32))) as usize % within]
        })
    };
    report("one walk, 1", &lights, point, single);
    report("one walk, 8", &lights, point, walk);
    report("tile of a cell, 8", &lights, point, |k| of_tile(&tiles, k));

    // Points of a cell share its candidates, so that the mean over frames is what is right: each fills its tiles anew.
    let at = point(7);
    let frames = 4000;
    let (mut sum, mut squares) = (0.0, 0.0);
    for frame in 0..frames {
        let mut tile = [SampledLight::NONE; OF_CELL];
        fill(&bvh, u8::try_from(cell_of(&at))?, frame + 1, &mut tile);
        let picked = std::array::from_fn::<_, OF_POINT, _>(|n| {
            tile[n * 16 + hash(frame ^ hash(n as u32)) as usize % 16]
        });
        let value = estimate(&lights, &at, &picked);
        sum += value;
        squares += value * value;
    }
    let [mean, square] = [sum, squares].map(|s| s / f64::from(frames));
    let sure = 5.0 * ((square - mean * mean) / f64::from(frames)).sqrt();
    let right = all(&lights, &at);
    println!(
        "mean of {frames} frames over the sum of all lights: {:.4} ± {:.4}",
        mean / right,
        sure / right
    );
    assert!((mean - right).abs() < sure, "biased");
    Ok(())
}

/// Candidates for the middle of a cell. The point has no normal: it receives from everywhere, so no light of any point is left out.
fn fill(bvh: &LightBvh, cell: u8, frame: u32, tile: &mut [SampledLight]) {
    let middle = |k: u8| (f32::from(k) + 0.5) * CELL;
    let point = ShadingPoint {
        p: [middle(cell % 16), 0.0, middle(cell / 16)],
        n: [0.0; 3],
    };
    let random = Random64::from(hash(hash(frame).wrapping_add(cell.into())));
    bvh.sample_spaced(&point, random, 0, OF_CELL as u32, tile);
}

fn cell_of(point: &ShadingPoint) -> usize {
    let of = |x: f32| ((x / CELL) as usize).min(SIDE - 1);
    of(point.p[0]) + SIDE * of(point.p[2])
}

/// Irradiance by a lamp, taken as a point; without shadows. Its shadow ray would go to one of the candidates, taken in
/// proportion to `irradiance / pmf`, and carry the mean of those.
fn irradiance(triangle: &EmissiveTriangle, point: &ShadingPoint) -> f64 {
    let [x, y, z] = std::array::from_fn(|axis| f64::from(triangle.p[0][axis] - point.p[axis]));
    let square = x * x + y * y + z * z;
    let area = 0.5 * 0.05 * 0.05;
    f64::from(triangle.radiance[0]) * area * (y * y) / (square * square)
}

fn all(lights: &Lights, point: &ShadingPoint) -> f64 {
    lights.triangles().iter().map(|t| irradiance(t, point)).sum()
}

fn estimate(lights: &Lights, point: &ShadingPoint, picked: &[SampledLight]) -> f64 {
    let of = |sampled: &SampledLight| {
        irradiance(&lights.triangles()[sampled.light as usize], point) / f64::from(sampled.pmf)
    };
    picked.iter().map(of).sum::<f64>() / picked.len() as f64
}

fn report<const COUNT: usize>(
    name: &str,
    lights: &Lights,
    point: impl Fn(u32) -> ShadingPoint,
    picked: impl Fn(u32) -> [SampledLight; COUNT],
) {
    let mut errors = Vec::new();
    for k in 0..2000 {
        let right = all(lights, &point(k));
        errors.push((estimate(lights, &point(k), &picked(k)) / right - 1.0).powi(2));
    }
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    errors.sort_by(f64::total_cmp);
    let start = Instant::now();
    let count = 200_000;
    let mut sum = 0.0;
    for k in 0..count {
        sum += picked(k)[0].pmf;
    }
    std::hint::black_box(sum);
    let ns = 1e9 * start.elapsed().as_secs_f64() / f64::from(count);
    println!(
        "{name}: squared relative error {mean:.4}, median {:.4}; candidates in {ns:.0} ns",
        errors[errors.len() / 2]
    );
}
