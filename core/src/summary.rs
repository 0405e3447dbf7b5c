//! Summaries: a few numbers of the lights below a child that can be merged.

mod bounds;
mod world;

use core::fmt::Debug;

use glam::Vec3;

use crate::bounds::LightBounds;
use crate::instance::Instance;
use crate::light::Light;
use crate::unroll::each;

/// Words of a summary in full, as [`BlasRoot`](crate::refit::BlasRoot) keeps them.
pub const SUMMARY_WORDS: usize = 12;

/// The summary of a set of lights: [`LightBounds`] for the paper's importance,
/// [`LightMoments`](crate::moments::LightMoments) for the default one.
pub trait Summary: Copy + PartialEq + Debug + Send + Sync + 'static {
    /// The summary of no light at all.
    const EMPTY: Self;

    /// Of one light.
    fn of_light<L: Light>(light: &L) -> Self;
    /// Of the lights of a node's slots. A slot without one gets [`EMPTY`](Self::EMPTY), or numbers without flux that mean
    /// nothing.
    fn of_lights<L: Light, const W: usize>(lights: &L::Slots<W>, summaries: &mut Lanes<W>);
    /// Of all the children of a node; the order of the slots is part of the result's bits.
    fn merged<const W: usize>(children: &Lanes<W>) -> Self;
    /// Of the lights of a bottom level that `instance` puts into the world.
    fn to_world(&self, instance: &Instance) -> Self;

    /// Radiant flux Φ, W; zero, or in [`MIN_PHI`](crate::bounds::MIN_PHI)`..=2^126`.
    fn phi(&self) -> f32;
    /// The centre that stands for all lights, metres.
    fn center(&self) -> Vec3;
    /// Variance of the lights' positions about the centre, all axes together, m².
    fn spread(&self) -> f32;
    /// A box and a cone around the lights, as far as they are known: what the paper's heuristics look at.
    fn bounds(&self) -> LightBounds;

    /// The numbers in full.
    fn to_words(&self) -> [f32; SUMMARY_WORDS];
    /// The summary of these numbers.
    fn from_words(words: &[f32; SUMMARY_WORDS]) -> Self;
}

/// The summaries of a node's children word by word, each an array over the slots: so processors compute several children at a
/// time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lanes<const W: usize>(pub(crate) [[f32; W]; SUMMARY_WORDS]);

impl<const W: usize> Lanes<W> {
    /// The same summary in all slots.
    #[inline(always)]
    #[must_use]
    pub fn all<S: Summary>(summary: &S) -> Self {
        let mut lanes = Self([[0.0; W]; SUMMARY_WORDS]);
        lanes.fill(summary);
        lanes
    }

    /// Puts `summary` into all slots.
    #[inline(always)]
    pub fn fill<S: Summary>(&mut self, summary: &S) {
        let words = summary.to_words();
        each!(k, SUMMARY_WORDS, {
            each!(slot, W, {
                self.0[k][slot] = words[k];
            });
        });
    }

    /// These summaries.
    #[inline(always)]
    #[must_use]
    pub fn of<S: Summary>(summaries: &[S; W]) -> Self {
        let mut lanes = Self([[0.0; W]; SUMMARY_WORDS]);
        each!(slot, W, {
            lanes.set(slot, &summaries[slot]);
        });
        lanes
    }

    /// The summary in `slot`.
    #[inline(always)]
    #[must_use]
    pub fn get<S: Summary>(&self, slot: usize) -> S {
        let mut words = [0.0; SUMMARY_WORDS];
        each!(k, SUMMARY_WORDS, {
            words[k] = self.0[k][slot];
        });
        S::from_words(&words)
    }

    /// Puts `summary` into `slot`.
    #[inline(always)]
    pub fn set<S: Summary>(&mut self, slot: usize, summary: &S) {
        let words = summary.to_words();
        each!(k, SUMMARY_WORDS, {
            self.0[k][slot] = words[k];
        });
    }
}
