//! What ReSTIR gains, in figures: mean squared errors on the built-in scenes at the same number of shadow rays.

use std::sync::Arc;

use lightbvh::{BuildParams, LightBvh};
use lightbvh_host::backend::{
    Backend, Bvh, Combination, CpuBackend, Integrator, Restir, RestirFrame, RestirOptions, Sampler,
    SceneArrays,
};
use lightbvh_host::render::Film;
use lightbvh_host::scene::Scene;
use lightbvh_host::workload::{RenderSettings, arrays_at};
use lightbvh_kernels::bvh::{Standard, WIDTH as WIDE};

const WIDTH: u32 = 128;
const HEIGHT: u32 = 72;
const HISTORY: u32 = 8;
const SEEDS: u32 = 4;

struct Case {
    frames: Vec<(Arc<SceneArrays>, Bvh)>,
    background: [f32; 3],
    reference: Vec<[f32; 3]>,
    exposure: f32,
}

fn independent(case: &Case, sampler: Sampler, samples: u32, seed: u32) -> Vec<[f32; 3]> {
    let (arrays, bvh) = case.frames.last().expect("frames");
    let settings = RenderSettings {
        frame: 0,
        width: WIDTH,
        height: HEIGHT,
        samples,
        seed,
    };
    let mut cpu = CpuBackend::<Standard, WIDE>::new(bvh.clone());
    let params = settings.params(case.background);
    cpu.render(arrays, &params, sampler, Integrator::Direct)
        .expect("an image")
        .value
}

fn restir(case: &Case, options: RestirOptions, seed: u32) -> (Vec<[f32; 3]>, f64) {
    let mut restir = Restir::new(options);
    let mut image = Vec::new();
    for (number, (scene, bvh)) in (0..).zip(&case.frames) {
        let frame = RestirFrame {
            scene,
            width: WIDTH,
            height: HEIGHT,
            seed: seed * 1000 + number,
            jitter: 0,
            background: case.background,
            remap: None,
        };
        let mut cpu = CpuBackend::<Standard, WIDE>::new(bvh.clone());
        image = cpu.restir(&mut restir, &frame).expect("a frame").value;
    }
    let rays = restir.shadow_rays() as f64 / f64::from(WIDTH * HEIGHT);
    (image, rays)
}

/// Mean squared error of linear radiance times exposure, and of what a display shows of it (cut at 1).
fn errors(case: &Case, image: &[[f32; 3]]) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for (a, b) in image.iter().flatten().zip(case.reference.iter().flatten()) {
        let [a, b] = [a, b].map(|x| f64::from(*x) * f64::from(case.exposure));
        sums[0] += (a - b) * (a - b);
        sums[1] += (a.min(1.0) - b.min(1.0)).powi(2);
    }
    sums.map(|sum| sum / (3.0 * image.len() as f64))
}

fn case(name: &str, frame: u32) -> Case {
    let scene = Scene::open(name).expect("a built-in scene");
    let frames: Vec<_> = (frame - HISTORY..=frame)
        .map(|n| {
            let arrays = arrays_at(&scene, n, WIDTH, HEIGHT).expect("a frame");
            let bvh: Bvh = LightBvh::two_level(&arrays.lights, &BuildParams::default());
            (Arc::new(arrays), bvh)
        })
        .collect();
    let mut case = Case {
        frames,
        background: scene.frame(frame).background,
        reference: Vec::new(),
        exposure: 1.0,
    };
    let samples = std::env::var("SAMPLES").map_or(2048, |s| s.parse().expect("a number"));
    case.reference = independent(&case, Sampler::TwoLevel, samples, 12345);
    let film = Film::new(WIDTH, HEIGHT, case.reference.clone()).expect("an image");
    case.exposure = film.auto_exposure();
    case
}

/// What a method costs and how far off it is, over [`SEEDS`] images.
struct Row {
    linear: f64,
    shown: f64,
}

fn row(case: &Case, what: &str, most: u32, one: impl Fn(u32) -> (Vec<[f32; 3]>, f64)) -> Row {
    let mut sums = [0.0; 2];
    let (mut rays, mut light) = (0.0, 0.0);
    let total = |image: &[[f32; 3]]| -> f64 { image.iter().flatten().map(|&x| f64::from(x)).sum() };
    let start = std::time::Instant::now();
    for seed in 1..=SEEDS {
        let (image, traced) = one(seed);
        let found = errors(case, &image);
        sums[0] += found[0];
        sums[1] += found[1];
        rays += traced;
        light += total(&image) / total(&case.reference);
    }
    let n = f64::from(SEEDS);
    let row = Row {
        linear: sums[0] / n,
        shown: sums[1] / n,
    };
    println!(
        "{what:40} rays {most} ({:.2} traced)  mse {:.3e}  cut at 1 {:.3e}  light {:.3}  {:.0} ms",
        rays / n,
        row.linear,
        row.shown,
        light / n,
        start.elapsed().as_secs_f64() * 1e3 / n,
    );
    row
}

/// `SCENE=street FRAME=50 cargo test --release -p lightbvh-tests restir_error -- --ignored --nocapture`
#[test]
#[ignore = "a measurement: minutes"]
fn candidates_from_the_light_bvh_have_less_error_at_equal_rays() {
    let wanted = std::env::var("SCENE").ok();
    let number = std::env::var("FRAME").map_or(50, |n| n.parse().expect("a frame's number"));
    for name in ["street", "square", "carousel"] {
        if wanted.as_deref().is_some_and(|wanted| wanted != name) {
            continue;
        }
        let case = case(name, number);
        for samples in [2, 6] {
            for sampler in [Sampler::Power, Sampler::TwoLevel] {
                let what = format!("{name} {number} {}", sampler.name());
                row(&case, &what, samples, |seed| {
                    (independent(&case, sampler, samples, seed), f64::NAN)
                });
            }
        }
        for combination in [Combination::Unbiased, Combination::Biased] {
            let of = |source, candidates| {
                let options = RestirOptions {
                    candidates,
                    ..RestirOptions::new(source, combination)
                };
                let what = format!("{name} {number} {} {source:?} {candidates}", combination.name());
                row(&case, &what, options.most_shadow_rays(), |seed| {
                    restir(&case, options, seed)
                })
            };
            let by_power = of(Sampler::Power, 32);
            let by_tree = of(Sampler::TwoLevel, 8);
            of(Sampler::TwoLevel, 32);
            // A few pixels of huge value make the error of the biased combination, and its linear error, hard to repeat.
            if combination == Combination::Unbiased {
                assert!(by_tree.linear < 0.75 * by_power.linear, "{name}: linear");
                assert!(by_tree.shown < 0.85 * by_power.shown, "{name}: as shown");
            }
        }
    }
}
