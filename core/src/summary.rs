//! What a node stores of each child: a few numbers of the lights below it that can be merged.

use core::fmt::Debug;

use glam::Vec3;

use crate::bounds::LightBounds;
use crate::instance::Instance;
use crate::light::EmissiveTriangle;

/// Words of a summary in full, as [`BlasRoot`](crate::refit::BlasRoot) keeps them.
pub const SUMMARY_WORDS: usize = 12;

/// What is known of a set of lights: [`LightBounds`] for the paper's importance,
/// [`LightMoments`](crate::moments::LightMoments) for the default one.
pub trait Summary: Copy + PartialEq + Debug + Send + Sync + 'static {
    /// The summary of no light at all.
    const EMPTY: Self;
    /// Names of the words of [`to_words`](Self::to_words), for messages.
    const NAMES: [&'static str; SUMMARY_WORDS];

    /// Of one emissive triangle.
    fn of_triangle(triangle: &EmissiveTriangle) -> Self;
    /// Of all the children of a node; the order of the slots is part of the result's bits.
    fn merged<const W: usize>(children: &[Self; W]) -> Self;
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
    /// The index among [`NAMES`](Self::NAMES) of a component in which `child` reaches out of `self`, its parent; `None` where
    /// there is none, or where parents need not contain their children.
    fn uncontained(&self, child: &Self) -> Option<usize>;

    /// The numbers in full.
    fn to_words(&self) -> [f32; SUMMARY_WORDS];
    /// The summary of these numbers.
    fn from_words(words: &[f32; SUMMARY_WORDS]) -> Self;
}
