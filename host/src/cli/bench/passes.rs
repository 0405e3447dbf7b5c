//! The passes, timed: through a backend, and by the library alone.

use std::hint::black_box;
use std::time::{Duration, Instant};

use lightbvh::{BuildParams, LightBvh, Lights, SampledLight};
use lightbvh_kernels::bvh::{Importance, Node, WIDTH};
use lightbvh_kernels::query::Query;

use crate::backend::{Backend, Sampler};
use crate::error::HostError;

/// Runs of each measurement; the median counts.
const RUNS: usize = 5;

/// Times of several runs of each pass.
pub(super) struct Times {
    pub refit: Vec<Duration>,
    pub refit_once: Vec<Duration>,
    pub sample: Vec<Duration>,
    pub pmf: Vec<Duration>,
}

pub(super) fn passes(
    backend: &mut dyn Backend,
    lights: &Lights,
    queries: &[Query],
) -> Result<Times, HostError> {
    let mut times = Times {
        refit: Vec::new(),
        refit_once: Vec::new(),
        sample: Vec::new(),
        pmf: Vec::new(),
    };
    // A device compiles at the first dispatch; that run is not counted.
    for run in 0..=RUNS {
        let refit = backend.refit(lights)?.time;
        let refit_once = backend.refit_once(lights)?.time;
        let sampled = backend.sample(queries)?;
        let asked: Vec<Query> = queries
            .iter()
            .zip(&sampled.value)
            .map(|(query, sampled)| Query {
                random_or_light: sampled.light,
                ..*query
            })
            .collect();
        let pmf = backend.pmf(&asked)?.time;
        if run > 0 {
            times.refit.push(refit);
            times.refit_once.push(refit_once);
            times.sample.push(sampled.time);
            times.pmf.push(pmf);
        }
    }
    Ok(times)
}

/// The passes by the library alone, on this thread.
pub(super) fn library_passes(structure: Sampler, lights: &Lights, queries: &[Query]) -> Times {
    let params = BuildParams::default();
    let mut bvh: LightBvh<Node, WIDTH> = match structure {
        Sampler::SingleLevel => LightBvh::single_level(lights, &params),
        _ => LightBvh::two_level(lights, &params),
    };
    let mut sampled = vec![SampledLight::NONE; queries.len()];
    let mut pmfs = vec![0.0; queries.len()];
    let refit = measure(|| bvh.refit(lights));
    let sample = measure(|| {
        for (query, out) in queries.iter().zip(&mut sampled) {
            *out = bvh.sample::<Importance>(&query.point, query.random_or_light);
        }
    });
    let pmf = measure(|| {
        for ((query, sampled), out) in queries.iter().zip(&sampled).zip(&mut pmfs) {
            *out = bvh.pmf::<Importance>(lights, &query.point, sampled.light);
        }
    });
    black_box((&sampled, &pmfs));
    Times {
        refit,
        refit_once: Vec::new(),
        sample,
        pmf,
    }
}

pub(super) fn measure(mut work: impl FnMut()) -> Vec<Duration> {
    (0..RUNS)
        .map(|_| {
            let start = Instant::now();
            work();
            start.elapsed()
        })
        .collect()
}

pub(super) fn median(times: &[Duration]) -> Duration {
    let mut sorted = times.to_vec();
    sorted.sort_unstable();
    sorted.get(sorted.len() / 2).copied().unwrap_or_default()
}
