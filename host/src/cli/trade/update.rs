//! How trees follow the animation: built at its first frame, brought to each one after that by a policy, and timed.

use std::time::{Duration, Instant};

use lightbvh::{BuildParams, Bvh, LightNode, Lights};
use serde::Serialize;
use strum::IntoStaticStr;

use crate::backend::{BackendError, Sampler};
use crate::cli::measure::interval::Interval;
use crate::cli::measure::times::ms;
use crate::error::HostError;
use crate::scene::{Instances, Scene};
use crate::workload::build;

/// Frames from one rebuild to the next of [`Update::EveryEighth`].
const EVERY: u32 = 8;

/// What is done to a tree between two frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub(super) enum Update {
    /// New bounds in the tree of the first frame.
    Refit,
    /// The same in trees of the frame before, whose top level a [`Rebuilder`](lightbvh::Rebuilder) builds in the background.
    TopRebuild,
    /// A new tree.
    Rebuild,
    /// A new tree in every eighth frame, new bounds in the others.
    EveryEighth,
}

impl Update {
    /// What a user of `levels` does unless there is a reason not to.
    pub fn usual(levels: Sampler) -> Self {
        match levels {
            Sampler::TwoLevel => Self::TopRebuild,
            _ => Self::Refit,
        }
    }

    pub fn name(self) -> &'static str {
        self.into()
    }

    fn rebuilds_in(self, frame: u32) -> bool {
        match self {
            Self::Refit | Self::TopRebuild => false,
            Self::Rebuild => true,
            Self::EveryEighth => frame.is_multiple_of(EVERY),
        }
    }
}

/// A frame of the animation.
pub(super) struct Frame<'a> {
    pub scene: &'a Scene,
    pub number: u32,
    pub lights: &'a Lights,
}

impl<'a> Frame<'a> {
    pub fn new(scene: &'a Scene, number: u32, lights: &'a Lights) -> Self {
        Self {
            scene,
            number,
            lights,
        }
    }
}

/// Time of an update, by what was done.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Spent {
    /// Edits and new bounds; nothing where the tree is new.
    pub refit: Option<Duration>,
    /// A new tree, for which the frame waits.
    pub rebuild: Option<Duration>,
    /// A new top level, for which no frame waits.
    pub beside: Option<Duration>,
}

/// A tree that follows the animation.
pub(super) struct Followed {
    levels: Sampler,
    update: Update,
    params: BuildParams,
    /// Of two levels.
    instances: Option<Instances>,
}

impl Followed {
    /// The tree of `first`.
    pub fn build<N: LightNode<W>, I, const W: usize>(
        first: &Frame<'_>,
        levels: Sampler,
        update: Update,
        params: BuildParams,
    ) -> Result<(Bvh<N, I, W>, Self), HostError> {
        let mut followed = Self {
            levels,
            update,
            params,
            instances: None,
        };
        let bvh = followed.rebuilt(first)?;
        Ok((bvh, followed))
    }

    /// The tree of `frame`, anew.
    pub fn rebuilt<N: LightNode<W>, I, const W: usize>(
        &mut self,
        frame: &Frame<'_>,
    ) -> Result<Bvh<N, I, W>, HostError> {
        if self.levels != Sampler::TwoLevel {
            return Ok(build(frame.lights, self.levels, &self.params));
        }
        let (bvh, instances) = Instances::new(frame.scene, frame.number, self.params)
            .map_err(|source| HostError::in_frame(frame.scene.name(), frame.number, source))?;
        self.instances = Some(instances);
        Ok(bvh)
    }

    /// Brings `bvh` from the frame before to `frame`.
    pub fn advance<N: LightNode<W>, I, const W: usize>(
        &mut self,
        bvh: &mut Bvh<N, I, W>,
        frame: &Frame<'_>,
    ) -> Result<Spent, HostError> {
        let mut spent = Spent::default();
        let start = Instant::now();
        if self.update.rebuilds_in(frame.number) {
            *bvh = self.rebuilt(frame)?;
            spent.rebuild = Some(start.elapsed());
            return Ok(spent);
        }
        if self.update == Update::TopRebuild {
            bvh.rebuild();
            spent.beside = Some(start.elapsed());
        }
        // Where nodes of the scene stand is the animation's business, not the tree's.
        let edits = self
            .instances
            .as_mut()
            .map(|i| i.edits(frame.scene, frame.number));
        let start = Instant::now();
        match edits {
            Some(edits) => {
                bvh.apply(edits)
                    .map_err(|source| HostError::in_frame(frame.scene.name(), frame.number, source))?;
                bvh.refit();
            }
            None => bvh.follow(frame.lights).map_err(BackendError::from)?,
        }
        spent.refit = Some(start.elapsed());
        Ok(spent)
    }
}

/// Times of the updates of one configuration over the animation.
#[derive(Clone, Debug, Default)]
pub(super) struct Updates {
    refit: Vec<f64>,
    rebuild: Vec<f64>,
    beside: Vec<f64>,
    frames: usize,
}

impl Updates {
    /// Of one more frame.
    pub fn push(&mut self, spent: Spent) {
        self.frames += 1;
        self.refit.extend(spent.refit.map(ms));
        self.rebuild.extend(spent.rebuild.map(ms));
        self.beside.extend(spent.beside.map(ms));
    }

    /// The median of the refits.
    pub fn refit_ms(&self) -> f64 {
        median_or_zero(&self.refit)
    }

    /// What frames wait for: the mean over them, of medians by what was done, so that an interrupted one does not count.
    pub fn mean_ms(&self) -> f64 {
        let of = |times: &[f64]| median_or_zero(times) * times.len() as f64;
        (of(&self.refit) + of(&self.rebuild)) / self.frames.max(1) as f64
    }

    /// What is built beside a frame: the median.
    pub fn beside_ms(&self) -> f64 {
        median_or_zero(&self.beside)
    }
}

fn median_or_zero(times: &[f64]) -> f64 {
    match times {
        [] => 0.0,
        _ => Interval::of(times.to_vec()).median,
    }
}
