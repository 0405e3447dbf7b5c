//! Light tiles: a grid of cells, each with lights chosen for its middle before the frame, from which points then draw instead
//! of walking the tree. After C. Wyman & A. Panteleev, "Rearchitecting Spatiotemporal Resampling for Production", HPG 2021
//! (section 5, tiles of presampled lights), and J. Boksansky et al., "Rendering Many Lights with Grid-Based Reservoirs", Ray
//! Tracing Gems II, 2021.
//!
//! `cargo run --release -p lightbvh --example light_tiles` (seconds). Checks that the mean over frames is the sum of all lights.

use lightbvh::exact::{hash, unit_f32};
use lightbvh::{BuildParams, EmissiveTriangle, LightBvh, Lights, Random64, SampledLight, ShadingPoint};

/// Candidates of a cell, and of a point.
const OF_CELL: usize = 128;
const OF_POINT: usize = 8;
/// Side of a cell, metres.
const CELL: f32 = 4.0;

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

    let point = ShadingPoint {
        p: [17.3, 0.0, 41.2],
        n: [0.0, 1.0, 0.0],
    };
    let cell = [0, 2].map(|axis| (point.p[axis] / CELL) as u16);
    // Points of a cell share its candidates, so that the mean over frames is what is right: each fills its tiles anew.
    let frames = 4000;
    let (mut sum, mut squares) = (0.0, 0.0);
    for frame in 0..frames {
        let tile = fill(&bvh, cell, hash(frame));
        // In strata over the tile, whose candidates lie in the order of lights.
        let within = OF_CELL / OF_POINT;
        let picked = (0..OF_POINT).map(|n| tile[n * within + hash(frame ^ hash(n as u32)) as usize % within]);
        let of = |sampled: SampledLight| {
            irradiance(&lights.triangles()[sampled.light as usize], &point) / f64::from(sampled.pmf)
        };
        let value = picked.map(of).sum::<f64>() / OF_POINT as f64;
        sum += value;
        squares += value * value;
    }
    let [mean, square] = [sum, squares].map(|s| s / f64::from(frames));
    let sure = 5.0 * ((square - mean * mean) / f64::from(frames)).sqrt();
    let right: f64 = lights.triangles().iter().map(|t| irradiance(t, &point)).sum();
    println!(
        "mean of {frames} frames over the sum of all lights: {:.4} ± {:.4}",
        mean / right,
        sure / right
    );
    assert!((mean - right).abs() < sure, "biased");
    Ok(())
}

/// Candidates for the middle of a cell. The point has no normal: it receives from everywhere, so no light of any point is left out.
fn fill(bvh: &LightBvh, cell: [u16; 2], random: u32) -> [SampledLight; OF_CELL] {
    let [x, z] = cell.map(|k| (f32::from(k) + 0.5) * CELL);
    let middle = ShadingPoint {
        p: [x, 0.0, z],
        n: [0.0; 3],
    };
    let mut tile = [SampledLight::NONE; OF_CELL];
    bvh.sample_spaced(&middle, Random64::from(random), 0, OF_CELL as u32, &mut tile);
    tile
}

/// Irradiance by a lamp, taken as a point; without shadows. Its shadow ray would go to one of the candidates, taken in
/// proportion to `irradiance / pmf`, and carry the mean of those.
fn irradiance(triangle: &EmissiveTriangle, point: &ShadingPoint) -> f64 {
    let [x, y, z] = std::array::from_fn(|axis| f64::from(triangle.p[0][axis] - point.p[axis]));
    let square = x * x + y * y + z * z;
    let area = 0.5 * 0.05 * 0.05;
    f64::from(triangle.radiance[0]) * area * (y * y) / (square * square)
}
