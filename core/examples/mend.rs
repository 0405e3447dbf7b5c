//! How a top level whose instances move far gets as good as a new one: variance over a new tree's, frame by frame, and what the
//! frames cost meanwhile.
//!
//! ```sh
//! cargo run --release --example mend [-- MOTION INSTANCES FRAMES RESTING THRESHOLD LEAVES]
//! ```
//!
//! MOTION is `clusters` (64 of them change places), `mix` (each lamp goes its own way across the scene), `carousel` (rings of lamps
//! that turn at other speeds), or `all`. After FRAMES of motion come RESTING frames in which nothing moves.

#![allow(clippy::disallowed_methods, reason = "nothing here is shared with devices")]

use std::env;
use std::f32::consts::TAU;
use std::thread;
use std::time::Duration;

use lightbvh::bvh::{RebuildParams, RebuilderParams, Swap};
use lightbvh::exact::{hash, unit_f32};
use lightbvh::{Edit, EmissiveTriangle, InstanceId, LightBvh, Rebuilder, ShadingPoint, Transform};

const SIDE: f32 = 100.0;

/// A number in [0, 1).
fn draw(a: u32, b: u32) -> f32 {
    unit_f32(hash(hash(a ^ 0x51ed_270b).wrapping_add(b)))
}

/// Where lamp `i` is at time `t`, 0 to 1.
fn place(motion: &str, i: u32, t: f32) -> [f32; 3] {
    let within = [1, 2, 3].map(|k| draw(i, k));
    let between = |a: f32, b: f32| a + (b - a) * t;
    match motion {
        "clusters" => {
            let own = i % 64;
            let at = |k: u32| SIDE * between(draw(own, 100 + k), draw(own, 200 + k));
            [
                at(0) + 3.0 * (within[0] - 0.5),
                3.0 * within[1],
                at(1) + 3.0 * (within[2] - 0.5),
            ]
        }
        "carousel" => {
            let radius = SIDE * (0.05 + 0.45 * within[0].sqrt());
            let angle = TAU * (within[2] + 2.0 * t * (1.0 - within[0]));
            [
                SIDE / 2.0 + radius * angle.cos(),
                4.0 * within[1],
                SIDE / 2.0 + radius * angle.sin(),
            ]
        }
        _ => [
            SIDE * between(within[0], draw(i, 4)),
            4.0 * within[1],
            SIDE * between(within[2], draw(i, 5)),
        ],
    }
}

/// Unshadowed diffuse light of a lamp that shines downward on a point that faces up.
fn received(lamp: &EmissiveTriangle, p: [f32; 3]) -> f64 {
    let to: [f64; 3] = std::array::from_fn(|k| {
        let sum: f64 = lamp.p.iter().map(|v| f64::from(v[k])).sum();
        sum / 3.0 - f64::from(p[k])
    });
    let squared: f64 = to.iter().map(|x| x * x).sum();
    let up = (to[1] / squared.sqrt()).max(0.0);
    f64::from(lamp.radiance[0]) * up * up / squared
}

/// Variance of one sample over the square of the mean, at each of some points.
fn variances(bvh: &LightBvh, points: u32) -> Vec<f64> {
    let live: Vec<_> = (0..bvh.instances().len() as u32)
        .filter_map(|i| Some((i, bvh.lights_of(bvh.instance_id(i)?)?.start)))
        .collect();
    let of = |k: u32| {
        let p = [SIDE * draw(k, 301), -1.0, SIDE * draw(k, 302)];
        let point = ShadingPoint {
            p,
            n: [0.0, 1.0, 0.0],
        };
        let (mut mean, mut square) = (0.0, 0.0);
        for &(instance, light) in &live {
            let lamp = bvh.triangle(light, instance).expect("its own");
            let f = received(&lamp, p);
            if f > 0.0 {
                mean += f;
                square += f * f / f64::from(bvh.pmf(&point, light, instance));
            }
        }
        square / (mean * mean) - 1.0
    };
    let threads = thread::available_parallelism().map_or(1, usize::from) as u32;
    thread::scope(|scope| {
        let parts: Vec<_> = (0..threads)
            .map(|part| {
                scope.spawn(move || {
                    (part..points)
                        .step_by(threads as usize)
                        .map(of)
                        .collect::<Vec<_>>()
                })
            })
            .collect();
        parts
            .into_iter()
            .flat_map(|part| part.join().expect("no panic"))
            .collect()
    })
}

fn mean(list: &[f64]) -> f64 {
    list.iter().sum::<f64>() / list.len().max(1) as f64
}

/// Variance over that of a tree built anew over the same.
fn worse(bvh: &LightBvh, points: u32) -> f64 {
    let mut anew = bvh.clone();
    let built = anew
        .rebuild(&RebuildParams {
            top: 0.0,
            drift: f64::INFINITY,
        })
        .run();
    anew.install(built).expect("its own");
    anew.refit();
    mean(&variances(bvh, points)) / mean(&variances(&anew, points))
}

/// Processor time of this thread, so that other work on the machine does not count; the time on the wall where it cannot be told.
fn now() -> Duration {
    #[cfg(unix)]
    {
        let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
        Duration::new(time.tv_sec as u64, time.tv_nsec as u32)
    }
    #[cfg(not(unix))]
    {
        static START: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
        START.get_or_init(std::time::Instant::now).elapsed()
    }
}

fn spread(name: &str, mut times: Vec<Duration>) {
    times.sort_unstable();
    let at = |share: f64| times[((times.len() - 1) as f64 * share) as usize].as_secs_f64() * 1e6;
    let over = times.iter().filter(|time| time.as_micros() > 300).count();
    println!(
        "  {name}: median {:.1} us, 99 % {:.1} us, most {:.1} us; {over} of {} beyond 300 us",
        at(0.5),
        at(0.99),
        at(1.0),
        times.len()
    );
}

fn run(motion: &str, count: u32, frames: u32, resting: u32, threshold: f64, leaves: u32) {
    let points = if count > 200_000 { 16 } else { 40 };
    let mut bvh = LightBvh::default();
    let lamp = EmissiveTriangle {
        p: [[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.0, 0.1]],
        radiance: [9.0; 3],
        mesh: 0,
        flags: 0,
    };
    let mesh = bvh.add_mesh(vec![lamp]).expect("a mesh");
    let add = (0..count).map(|i| Edit::AddInstance {
        mesh,
        transform: Transform::at(place(motion, i, 0.0)),
        radiance: 1.0,
    });
    let ids: Vec<InstanceId> = bvh.apply(add.collect()).expect("instances").instances;
    bvh.refit();
    let mut params = RebuilderParams {
        swap: Swap::Deterministic,
        ..RebuilderParams::default()
    };
    params.rebuild.top = threshold;
    params.leaves = leaves;
    let mut rebuilder = Rebuilder::new(params);
    let (mut begins, mut ends, mut refits) = (vec![], vec![], vec![]);
    let (mut built, mut swaps, mut last) = (Duration::ZERO, 0, 0);
    println!(
        "{motion}, {count} lamps, threshold {threshold}, {leaves} leaves: {frames} frames of motion, {resting} at rest"
    );
    let mut over = vec![];
    for frame in 1..=frames + resting {
        let start = now();
        let began = rebuilder.begin_frame(&mut bvh).expect("no panic");
        begins.push(now() - start);
        built += began.built;
        if began.swapped {
            swaps += 1;
            last = frame;
        }
        if frame <= frames {
            let t = frame as f32 / frames as f32;
            let moves = (0..count).map(|i| Edit::SetTransform {
                instance: ids[i as usize],
                transform: Transform::at(place(motion, i, t)),
            });
            bvh.apply(moves.collect()).expect("there");
        }
        let start = now();
        bvh.refit();
        if frame > frames {
            refits.push(now() - start);
        }
        let start = now();
        rebuilder.end_frame(&bvh);
        ends.push(now() - start);
        let rested = frame.saturating_sub(frames);
        let is_told = frame >= frames && (rested == 0 || rested.is_power_of_two() && rested >= 16);
        if (frame < frames && frame % (frames / 4).max(1) == 0) || is_told || frame == frames + resting {
            let ratio = worse(&bvh, points);
            if frame <= frames {
                over.push(ratio);
            }
            println!(
                "  frame {frame}: {ratio:.3} of a new tree's variance, depth {}, {swaps} swapped in",
                bvh.depth()
            );
        }
    }
    bvh.validate().expect("valid");
    spread("begin_frame", begins);
    spread("end_frame", ends);
    spread("refit at rest", refits);
    println!(
        "  builder's thread {:.2} ms a frame, last swap in frame {last}, busy {}; variance in motion {:.3}",
        built.as_secs_f64() * 1e3 / f64::from(frames + resting),
        rebuilder.is_busy(),
        mean(&over)
    );
}

fn main() {
    let args: Vec<String> = env::args().skip(1).collect();
    let number = |k: usize, otherwise: f64| args.get(k).map_or(otherwise, |x| x.parse().expect("a number"));
    let motion = args.first().map_or("all", String::as_str);
    let motions = match motion {
        "all" => vec!["clusters", "mix", "carousel"],
        one => vec![one],
    };
    for motion in motions {
        run(
            motion,
            number(1, 64_000.0) as u32,
            number(2, 200.0) as u32,
            number(3, 256.0) as u32,
            number(4, RebuildParams::default().top),
            number(5, f64::from(RebuilderParams::default().leaves)) as u32,
        );
    }
}
