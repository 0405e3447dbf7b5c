//! `lightbvh bench --dynamic`: thread time of frames of moving lights, and the variance of their trees relative to trees built
//! over the same lights.

mod scenes;
mod world;

use std::f32::consts::TAU;
use std::time::{Duration, Instant};

use lightbvh::{EmissiveTriangle, Rebuilder, ShadingPoint};
use lightbvh_gpu::{Mirror, Step};
use serde::Serialize;
use serde_json::json;

use self::scenes::Scene;
use self::world::World;
use crate::backend::Bvh;
use crate::cli::measure::{self, times::Spread};
use crate::cli::table::{self, news};
use crate::cli::{Context, Outcome};
use crate::error::HostError;
use crate::stability::random::Random;

/// Frames begin at 60 Hz, so that the worker thread has as much time as with a renderer.
const PACE: Duration = Duration::from_micros(16_667);

/// Results of a scene.
#[derive(Clone, Debug, Serialize)]
struct Row {
    scene: &'static str,
    instances: usize,
    /// Thread time of begin, apply, refit and end, µs.
    frame_us: Spread,
    /// Thread time of begin and end, µs.
    begin_end_us: Spread,
    variance: Option<Variance>,
    /// Bytes that a device copies, the median of frames in which no top level was swapped in; none if there are none.
    bytes: Option<f64>,
}

/// Relative variance of one sample, divided by that of a tree built over the same lights.
#[derive(Clone, Copy, Debug, Serialize)]
struct Variance {
    /// Over frames, the mean of ratios of the means over points.
    mean: f64,
    /// The geometric mean of the ratios at points.
    geometric: f64,
    /// Greatest ratio of means of a frame.
    most: f64,
}

pub(super) fn run(context: &Context) -> Result<Outcome, HostError> {
    let rows = scenes::scenes().into_iter().map(row);
    let rows = rows.collect::<Result<Vec<_>, _>>()?;
    match context.json {
        true => table::print_json(&json!({ "scenes": rows }))?,
        false => print(&rows)?,
    }
    Ok(Outcome::Good)
}

fn row(mut scene: Scene) -> Result<Row, HostError> {
    news!("{}, {}", scene.name, scene.lamps.len());
    // A refit that builds uses all threads of its pool; with one thread, all of it counts as thread time.
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let one = one.expect("a pool of one thread");
    let mut world = World::new();
    for (at, radiance) in std::mem::take(&mut scene.lamps) {
        world.add(at, radiance);
    }
    let mut rebuilder = Rebuilder::default();
    world.start();
    let mut instances = world.count();
    let mut mirror = Mirror::default();
    mirror.frame(&world.bvh);
    let mut random = Random::new(12);
    let (mut times, mut bytes, mut looks) = (Vec::new(), Vec::new(), Vec::new());
    for frame in 0..scene.frames {
        let began = Instant::now();
        (scene.step)(frame, &mut world);
        let spent = one.install(|| world.frame(&mut rebuilder))?;
        instances = instances.max(world.count());
        let copied: usize = mirror
            .frame(&world.bvh)
            .steps()
            .map(|step| match step {
                Step::Upload { bytes, .. } => bytes.len(),
                _ => 0,
            })
            .sum();
        if frame >= scene.warm {
            times.push(spent);
            bytes.extend((!spent.has_swapped).then_some(copied as f64));
            if times.len().is_multiple_of(scene.look) {
                looks.extend(look(&world, &scene, &mut random));
            }
        }
        std::thread::sleep(PACE.saturating_sub(began.elapsed()));
    }
    let mean = |of: fn(&[f64; 2]) -> f64| looks.iter().map(of).sum::<f64>() / looks.len() as f64;
    Ok(Row {
        scene: scene.name,
        instances,
        frame_us: Spread::of(times.iter().map(|spent| spent.frame)),
        begin_end_us: Spread::of(times.iter().map(|spent| spent.begin_end)),
        variance: (!looks.is_empty()).then(|| Variance {
            mean: mean(|look| look[0]),
            geometric: mean(|look| look[1]),
            most: looks.iter().map(|look| look[0]).fold(0.0, f64::max),
        }),
        bytes: (!bytes.is_empty()).then(|| Spread::of(bytes).median),
    })
}

/// The ratio of means, and the geometric mean of ratios, of the variance now and with a new tree; none without light.
fn look(world: &World, scene: &Scene, random: &mut Random) -> Option<[f64; 2]> {
    let lights = world.bvh.view().world_lights();
    let lit: Vec<&EmissiveTriangle> = lights.iter().filter(|light| light.luminance() > 0.0).collect();
    if lit.is_empty() {
        return None;
    }
    let points = (0..scene.points).map(|_| {
        let light = lit[random.below(lit.len() as u32) as usize];
        point(light, scene.side, random)
    });
    let points: Vec<ShadingPoint> = points.collect();
    let now = variances(&world.bvh, &lights, &points);
    let fresh = world.fresh();
    let pairs = now
        .into_iter()
        .zip(variances(&fresh, &fresh.view().world_lights(), &points));
    let pairs: Vec<(f64, f64)> = pairs.filter(|&(now, fresh)| now > 0.0 && fresh > 0.0).collect();
    let sum = |of: fn(&(f64, f64)) -> f64| pairs.iter().map(of).sum::<f64>();
    let geometric = (sum(|(now, fresh)| (now / fresh).ln()) / pairs.len() as f64).exp();
    (!pairs.is_empty()).then(|| [sum(|pair| pair.0) / sum(|pair| pair.1), geometric])
}

/// A point near the floor that looks about upward: in the square of side `side`, or else below a light.
fn point(light: &EmissiveTriangle, side: Option<f32>, random: &mut Random) -> ShadingPoint {
    let [x, z] = match side {
        Some(side) => [(); 2].map(|()| random.between(0.0, side)),
        None => [0, 2].map(|axis| light.p[0][axis] + random.between(-2.0, 2.0)),
    };
    let (up, (s, c)) = (random.between(0.6, 1.0), random.between(0.0, TAU).sin_cos());
    let flat = (1.0 - up * up).sqrt();
    ShadingPoint {
        p: [x, 0.3, z],
        n: [flat * c, up, flat * s],
    }
}

/// Exact relative variance of one sample at each point: by all lights, which have their instance's index; zero in the dark.
fn variances(bvh: &Bvh, lights: &[EmissiveTriangle], points: &[ShadingPoint]) -> Vec<f64> {
    let pmf = |k: usize, light: u32| bvh.tree().pmf(&points[k], light, lights[light as usize].mesh);
    let all = measure::variances(lights, points, pmf);
    all.into_iter().map(Option::unwrap_or_default).collect()
}

fn print(rows: &[Row]) -> std::io::Result<()> {
    fn ratio(row: &Row, of: fn(&Variance) -> f64) -> String {
        table::known(row.variance.as_ref().map(of), 2)
    }
    table::print(
        rows,
        &[
            ("scene", |r| r.scene.to_owned()),
            ("instances", |r| r.instances.to_string()),
            ("µs", |r| format!("{:.0}", r.frame_us.median)),
            ("99 %", |r| format!("{:.0}", r.frame_us.p99)),
            ("most", |r| format!("{:.0}", r.frame_us.most)),
            ("begin + end", |r| format!("{:.0}", r.begin_end_us.median)),
            ("99 %", |r| format!("{:.0}", r.begin_end_us.p99)),
            ("variance", |r| ratio(r, |it| it.mean)),
            ("geometric", |r| ratio(r, |it| it.geometric)),
            ("most", |r| ratio(r, |it| it.most)),
            ("kB", |r| table::known(r.bytes.map(|bytes| bytes * 1e-3), 1)),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_frames_are_as_good_as_fresh_builds() {
        let scenes = scenes::scenes().into_iter();
        for mut scene in scenes.filter(|scene| (1..50_000).contains(&scene.lamps.len())) {
            (scene.frames, scene.warm, scene.look) = (3, 0, 3);
            let row = row(scene).expect("no build panics");
            assert!(
                row.begin_end_us.median > 0.0 && row.frame_us.most > row.begin_end_us.median,
                "{row:?}"
            );
            let variance = row.variance.expect("there is light");
            assert!((0.5..2.0).contains(&variance.geometric), "{row:?}");
        }
    }
}
