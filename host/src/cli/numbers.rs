//! `lightbvh numbers`: what the order of the walk's number is worth: stratified and low-discrepancy numbers against independent
//! ones, as a table and as a picture.

mod sequences;

use std::path::PathBuf;

use lightbvh::exact::{hash, unit_f32};
use lightbvh::{
    BuildParams, Bvh, EmissiveTriangle, ImportanceModel, LightNode, Lights, Random64, ShadingPoint,
};
use lightbvh_kernels::bvh::{Paper, Standard, TriangleChoice};
use serde::Serialize;
use serde_json::json;
use strum::VariantArray;

use self::sequences::Sequence;
use super::variance::irradiance::irradiance;
use super::{Context, Outcome, table, target};
use crate::error::HostError;
use crate::plot::Canvas;
use crate::render::FilmError;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Write a picture to this PNG file: one number a pixel, by each sequence.
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Numbers for each point.
    #[arg(long, default_value_t = 64, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    numbers: u32,
}

/// Points of the table, and sequences for each.
const POINTS: u32 = 64;
const TRIALS: u32 = 64;
/// Pixels of a side of one picture, and how large each is drawn.
const SIDE: u32 = 96;
const ZOOM: u32 = 2;

#[derive(Clone, Debug, Serialize)]
struct Row {
    sequence: &'static str,
    importance: &'static str,
    /// Mean squared error of the mean of the estimates, over the squared mean: over points and trials.
    error: f64,
    /// Error of independent numbers over this one.
    gain: f64,
}

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    if let Some(path) = &args.output {
        target::check(path).map_err(|source| FilmError::Write {
            path: path.clone(),
            source,
        })?;
    }
    let lights = lamps();
    let mut rows = measure::<Standard, 8>(&lights, args.numbers);
    rows.extend(measure::<Paper, 4>(&lights, args.numbers));
    if let Some(path) = &args.output {
        picture::<Standard, 8>(&lights).write_png(path)?;
    }
    if context.json {
        table::print_json(
            &json!({ "numbers": args.numbers, "points": POINTS, "trials": TRIALS, "rows": rows }),
        )?;
    } else {
        table::print(
            &rows,
            &[
                ("numbers", |r| r.sequence.to_owned()),
                ("importance", |r| r.importance.to_owned()),
                ("squared error", |r| format!("{:.2e}", r.error)),
                ("times better", |r| format!("{:.1}", r.gain)),
            ],
        )?;
    }
    Ok(Outcome::Good)
}

/// 4096 small lamps of alike flux in a ceiling of 20 × 20 m: light varies smoothly over the floor, and from lamp to lamp.
fn lamps() -> Lights {
    let lamp = |i: u32| {
        let (x, z) = ((i % 64) as f32 * 0.3125, (i / 64) as f32 * 0.3125);
        EmissiveTriangle {
            p: [[x, 3.0, z], [x + 0.1, 3.0, z], [x, 3.0, z + 0.1]],
            radiance: [0.5 + unit_f32(hash(i)); 3],
            mesh: 0,
            flags: 0,
        }
    };
    Lights::new((0..4096).map(lamp).collect()).expect("the lamps are made within the domain")
}

fn floor(x: f32, z: f32) -> ShadingPoint {
    ShadingPoint {
        p: [x, 0.0, z],
        n: [0.0, 1.0, 0.0],
    }
}

/// The estimate of the light at `point` by one number.
fn estimate<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    bvh: &Bvh<N, I, W>,
    lights: &Lights,
    point: &ShadingPoint,
    number: Random64,
) -> f64 {
    let sampled = bvh.sample(point, number);
    match lights.triangles().get(sampled.light as usize) {
        Some(triangle) => irradiance(triangle, point) / f64::from(sampled.pmf),
        None => 0.0,
    }
}

fn measure<C: TriangleChoice<W>, const W: usize>(lights: &Lights, numbers: u32) -> Vec<Row> {
    let bvh = Bvh::<C::Node, C::Importance, W>::single_level(lights, &BuildParams::default());
    let mut errors = Vec::new();
    for &sequence in Sequence::VARIANTS {
        let mut sum = 0.0;
        for i in 0..POINTS {
            let point = floor(1.0 + 18.0 * unit_f32(hash(i)), 1.0 + 18.0 * unit_f32(hash(!i)));
            let all: f64 = lights.triangles().iter().map(|t| irradiance(t, &point)).sum();
            for trial in 0..TRIALS {
                let seed = hash(hash(i).wrapping_add(trial));
                let estimates = (0..numbers).map(|k| {
                    let number = Random64::from(sequence.number(k, numbers, seed));
                    estimate(&bvh, lights, &point, number)
                });
                let mean = estimates.sum::<f64>() / f64::from(numbers);
                sum += (mean / all - 1.0).powi(2);
            }
        }
        errors.push((sequence, sum / f64::from(POINTS * TRIALS)));
    }
    let independent = errors[0].1;
    errors
        .into_iter()
        .map(|(sequence, error)| Row {
            sequence: sequence.into(),
            importance: C::NAME,
            error,
            gain: independent / error,
        })
        .collect()
}

/// The floor by one number a pixel: independent numbers left, a blue-noise mask's right; below, the same smoothed as an eye
/// from afar does.
fn picture<C: TriangleChoice<W>, const W: usize>(lights: &Lights) -> Canvas {
    let bvh = Bvh::<C::Node, C::Importance, W>::single_level(lights, &BuildParams::default());
    let mut canvas = Canvas::new(2 * SIDE * ZOOM + 8, 2 * SIDE * ZOOM + 8, [255; 3]);
    for (column, blue) in [(0, false), (1, true)] {
        let pixels: Vec<f64> = (0..SIDE * SIDE)
            .map(|i| {
                let (x, y) = (i % SIDE, i / SIDE);
                let number = if blue {
                    sequences::blue_noise(x, y)
                } else {
                    hash(hash(i))
                };
                // A corner of the room: strong gradients.
                let point = floor(x as f32 * 0.05, y as f32 * 0.05);
                let all: f64 = lights.triangles().iter().map(|t| irradiance(t, &point)).sum();
                let one = estimate(&bvh, lights, &point, Random64::from(number));
                one / all
            })
            .collect();
        let smooth: Vec<f64> = (0..SIDE * SIDE)
            .map(|i| {
                let (x, y) = ((i % SIDE) as i32, (i / SIDE) as i32);
                let (mut sum, mut count) = (0.0, 0.0);
                for dy in -2..=2 {
                    for dx in -2..=2 {
                        let (u, v) = (x + dx, y + dy);
                        if (0..SIDE as i32).contains(&u) && (0..SIDE as i32).contains(&v) {
                            sum += pixels[(v * SIDE as i32 + u) as usize];
                            count += 1.0;
                        }
                    }
                }
                sum / count
            })
            .collect();
        for (row, (values, contrast)) in [(pixels, 1.0), (smooth, 3.0)].into_iter().enumerate() {
            let shown: Vec<[u8; 3]> = values
                .iter()
                .map(|&v| [(110.0 * (1.0 + contrast * (v - 1.0))).clamp(0.0, 255.0) as u8; 3])
                .collect();
            let at = (column * (SIDE * ZOOM + 8), row as u32 * (SIDE * ZOOM + 8));
            canvas.image(at, &shown, SIDE, ZOOM);
        }
    }
    canvas
}
