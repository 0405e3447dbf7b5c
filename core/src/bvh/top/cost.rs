//! What it costs to put subtrees together: Ward's criterion, as the builder has it (Ward 1963).
//!
//! A set of lights costs its flux times the variance of their positions; what a tree costs is the sum over the children of all
//! its nodes. Two sets that become one cost δ = φ₁ φ₂ / (φ₁ + φ₂) · |c₁ − c₂|² more than before. On the CPU alone, in `f64`:
//! positions up to 2^40 m squared, times flux, are within its range.

use crate::summary::Summary;

/// Part of the mean flux of an instance that every instance counts for at least: lamps that are off are kept near those
/// around them.
const DARK: f64 = 1.0 / 1024.0;

/// What a subtree is to the cost.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cluster {
    /// Flux, W.
    pub phi: f64,
    pub center: [f64; 3],
    /// Variance of position, m².
    pub spread: f64,
    /// Instances.
    pub count: u32,
}

impl Cluster {
    pub fn new<S: Summary>(summary: &S, count: u32) -> Self {
        let c = summary.center();
        Self {
            phi: f64::from(summary.phi()),
            center: [f64::from(c.x), f64::from(c.y), f64::from(c.z)],
            spread: f64::from(summary.spread()),
            count,
        }
    }

    /// What the set costs by itself.
    pub fn cost(&self) -> f64 {
        self.phi * self.spread
    }

    /// What the sets cost more as one than as two.
    pub fn merging(&self, other: &Self) -> f64 {
        let [x, y, z] = [0, 1, 2].map(|k| self.center[k] - other.center[k]);
        let both = self.phi + other.phi;
        let reduced = if both > 0.0 {
            self.phi * other.phi / both
        } else {
            0.0
        };
        reduced * ((x * x + y * y) + z * z)
    }

    /// As a child of its own: merged, and one level further down.
    pub fn pairing(&self, other: &Self) -> f64 {
        self.merging(other) + self.cost() + other.cost()
    }
}

/// The least flux by which one instance of so many with flux `phi` counts.
pub(super) fn floor(phi: f64, count: u32) -> f64 {
    if phi > 0.0 && count > 0 {
        phi / f64::from(count) * DARK
    } else {
        1.0
    }
}
