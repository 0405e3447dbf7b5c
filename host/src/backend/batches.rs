//! Images of many samples as the mean of images of few.
//!
//! One invocation takes all samples of its pixel, and llvmpipe leaves the loops of an invocation after 65,536 turns in all,
//! silently: a device would return an image of fewer samples than were asked for. Both processors therefore share samples
//! out alike, so that images of any number of samples keep equal words.

use std::time::Duration;

use lightbvh::exact::hash;
use lightbvh_kernels::render::RenderParams;
use lightbvh_kernels::shading::direct::MAX_CANDIDATES;

use super::Timed;

/// Most light samples of a pixel in one invocation. A sample walks a ray BVH: some hundred turns.
const MAX_SAMPLES_PER_INVOCATION: u32 = 8;
/// Most candidates of them all, but always one sample's. A candidate walks a light BVH: about ten turns.
const MAX_CANDIDATES_PER_INVOCATION: u32 = 64;
/// Most surfaces that the paths of a pixel meet in one invocation, but always one path: each surface costs two rays, a
/// sampled light and a pmf.
const MAX_SURFACES_PER_INVOCATION: u32 = 16;

/// The light that is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Integrator {
    /// Reflected once.
    Direct,
    /// Reflected up to `bounces` times.
    Path {
        /// At most [`MAX_BOUNCES`](lightbvh_kernels::shading::path::MAX_BOUNCES).
        bounces: u32,
    },
}

impl Integrator {
    /// Most light samples of `candidates` each, or paths, of a pixel in one invocation.
    pub fn samples_per_invocation(self, candidates: u32) -> u32 {
        match self {
            Self::Direct => (MAX_CANDIDATES_PER_INVOCATION / candidates.clamp(1, MAX_CANDIDATES))
                .clamp(1, MAX_SAMPLES_PER_INVOCATION),
            Self::Path { bounces } => (MAX_SURFACES_PER_INVOCATION / bounces.saturating_add(1)).max(1),
        }
    }
}

/// The image of `params` from images of at most `most` samples each, which take the samples of a pixel one after another or, of
/// paths, differ in their seed. Up to `most` samples it is `image` itself; beyond, the mean of all.
pub(super) fn in_batches<E>(
    params: &RenderParams,
    integrator: Integrator,
    mut image: impl FnMut(&RenderParams) -> Result<Timed<Vec<[f32; 3]>>, E>,
) -> Result<Timed<Vec<[f32; 3]>>, E> {
    let most = integrator.samples_per_invocation(params.candidates);
    if params.samples <= most {
        return image(params);
    }
    let count = params.samples.div_ceil(most);
    let mut first = params.first;
    let parts = (0..count).map(|part| {
        let samples = params.samples / count + u32::from(part < params.samples % count);
        let mut own = RenderParams { samples, ..*params };
        match integrator {
            Integrator::Direct => {
                own.first = first;
                own.all = if params.all == 0 {
                    params.samples
                } else {
                    params.all
                };
            }
            Integrator::Path { .. } => own.seed = hash(hash(params.seed).wrapping_add(part)),
        }
        first = first.wrapping_add(samples);
        own
    });
    mean_image(parts, image)
}

/// The mean over all samples of images of one size, added in order in `f64` and rounded once, and their times together.
pub(crate) fn mean_image<E>(
    parts: impl Iterator<Item = RenderParams>,
    mut image: impl FnMut(&RenderParams) -> Result<Timed<Vec<[f32; 3]>>, E>,
) -> Result<Timed<Vec<[f32; 3]>>, E> {
    let (mut sum, mut all, mut time) = (Vec::new(), 0.0, Duration::ZERO);
    for params in parts {
        let (part, samples) = (image(&params)?, f64::from(params.samples));
        sum.resize(part.value.len(), [0.0; 3]);
        for (sum, pixel) in sum.iter_mut().flatten().zip(part.value.iter().flatten()) {
            *sum += f64::from(*pixel) * samples;
        }
        all += samples;
        time += part.time;
    }
    let value = sum
        .iter()
        .map(|pixel| pixel.map(|sum| (sum / all) as f32))
        .collect();
    Ok(Timed { value, time })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    fn params(samples: u32) -> RenderParams {
        RenderParams {
            width: 1,
            height: 1,
            samples,
            first: 0,
            all: 0,
            candidates: 1,
            part: 0,
            parts: 1,
            seed: 5,
            jitter: 3,
            background: [0.0; 3],
        }
    }

    /// The parts of an image of `samples` samples in parts of 8, each of which returns its share as its pixel.
    fn asked(samples: u32, integrator: Integrator) -> (Vec<RenderParams>, [f32; 3]) {
        let mut asked = Vec::new();
        let image = in_batches(&params(samples), integrator, |part| {
            asked.push(*part);
            Ok::<_, ()>(Timed {
                value: vec![[1.0, part.samples as f32, asked.len() as f32]],
                time: Duration::ZERO,
            })
        });
        (asked, image.expect("no error").value[0])
    }

    /// One surface each, so that eight paths are one part, as of direct light.
    const PATHS: Integrator = Integrator::Path { bounces: 1 };

    #[test]
    fn long_paths_go_alone() {
        let paths = [0, 1, 5, 7, 15, 64, u32::MAX].map(|bounces| Integrator::Path { bounces });
        assert_eq!(
            paths.map(|paths| paths.samples_per_invocation(1)),
            [16, 8, 2, 2, 1, 1, 1]
        );
        let direct =
            [0, 1, 2, 8, 9, 256].map(|candidates| Integrator::Direct.samples_per_invocation(candidates));
        assert_eq!(direct, [8, 8, 8, 8, 7, 1]);
    }

    #[test]
    fn all_samples_are_taken_and_count_alike() {
        for (samples, integrator) in [1, 8, 9, 16, 17, 1000, 4099]
            .into_iter()
            .flat_map(|n| [(n, Integrator::Direct), (n, PATHS)])
        {
            let (asked, pixel) = asked(samples, integrator);
            assert!(asked.iter().all(|part| (1..=8).contains(&part.samples)));
            assert_eq!(asked.iter().map(|part| part.samples).sum::<u32>(), samples);
            let number = |p: &RenderParams, k| (p.seed, p.first + k);
            let numbers: BTreeSet<_> = asked
                .iter()
                .flat_map(|p| (0..p.samples).map(move |k| number(p, k)))
                .collect();
            assert_eq!(numbers.len(), samples as usize, "no sample is taken twice");
            if integrator == Integrator::Direct {
                // Whatever their number, they are spread as those of one image would be.
                let all = if asked.len() > 1 { samples } else { 0 };
                assert!(asked.iter().all(|part| part.all == all && part.part == 0));
                assert_eq!(numbers.last(), Some(&(5, samples - 1)));
            }
            assert!(asked.iter().all(|part| part.jitter == 3));
            assert_eq!(pixel[0], 1.0);
            let squares: u32 = asked.iter().map(|part| part.samples * part.samples).sum();
            assert_eq!(pixel[1], (f64::from(squares) / f64::from(samples)) as f32);
        }
    }
}
