//! The passes, timed.

use std::hint::black_box;
use std::time::{Duration, Instant};

use lightbvh::{Random64, SampledLight, ShadingPoint};
use lightbvh_kernels::query::Query;
use rayon::prelude::*;

use crate::backend::{Backend, BackendError, Bvh, Timed};
use crate::error::HostError;

/// Samples of a batch that one thread takes.
const BATCH: usize = 4096;
/// Runs of each measurement; the median counts.
const RUNS: usize = 5;
/// Time of runs before them: a device compiles at the first dispatch, and one that was idle has slow clocks for a while (an
/// NVIDIA H100 a fifth of its full ones).
const WARM: Duration = Duration::from_secs(1);

/// Times of several runs of refit, sample and pmf on a backend; `refit` refits all of it, and returns its time.
pub(super) fn passes<B: Backend>(
    backend: &mut B,
    mut refit: impl FnMut(&mut B) -> Result<Duration, BackendError>,
    queries: &[Query],
) -> Result<[Vec<Duration>; 3], HostError> {
    let mut times: [Vec<Duration>; 3] = Default::default();
    let start = Instant::now();
    let mut is_warm = false;
    while times[0].len() < RUNS {
        let refit = refit(backend)?;
        let sampled = backend.sample(queries)?;
        let asked: Vec<Query> = queries
            .iter()
            .zip(&sampled.value)
            .map(|(query, sampled)| Query {
                words: [sampled.light, sampled.instance],
                ..*query
            })
            .collect();
        let pmf = backend.pmf(&asked)?.time;
        if is_warm {
            for (list, time) in times.iter_mut().zip([refit, sampled.time, pmf]) {
                list.push(time);
            }
        }
        is_warm |= start.elapsed() >= WARM;
    }
    Ok(times)
}

/// Samples in batches, by the threads of the current pool.
pub(super) fn batches(bvh: &Bvh, queries: &[Query]) -> Vec<Duration> {
    let points: Vec<ShadingPoint> = queries.iter().map(|query| query.point).collect();
    let number = |query: &Query| Random64 {
        high: query.words[0],
        low: query.words[1],
    };
    let randoms: Vec<Random64> = queries.iter().map(number).collect();
    let mut sampled = vec![SampledLight::NONE; queries.len()];
    let times = measure(|| {
        let of_points = points.par_chunks(BATCH).zip(randoms.par_chunks(BATCH));
        let parts = of_points.zip(sampled.par_chunks_mut(BATCH));
        parts.for_each(|((points, randoms), sampled)| {
            bvh.tree().sample_batch(points, randoms, sampled);
        });
    });
    black_box(&sampled);
    times
}

pub(super) fn measure(mut work: impl FnMut()) -> Vec<Duration> {
    (0..RUNS).map(|_| Timed::of(&mut work).time).collect()
}
