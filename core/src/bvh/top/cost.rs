//! Ward's criterion (Ward 1963), as in the builder: a set of lights costs its flux times the variance of their positions; a tree
//! costs the sum over the children of all its nodes. Merging two sets adds δ = φ₁ φ₂ / (φ₁ + φ₂) · |c₁ − c₂|².
//! On the CPU alone, in `f64`: positions up to 2^40 m squared, times flux, are within its range.

use crate::summary::Summary;

/// A subtree in the cost function.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Cluster {
    /// Flux, W.
    pub phi: f64,
    /// Metres.
    pub center: [f64; 3],
    /// Variance of position, m².
    pub spread: f64,
}

impl Cluster {
    pub fn new<S: Summary>(summary: &S) -> Self {
        let c = summary.center();
        Self {
            phi: f64::from(summary.phi()),
            center: [c.x, c.y, c.z].map(f64::from),
            spread: f64::from(summary.spread()),
        }
    }

    /// The set and another one, which adds nothing without flux.
    pub fn and(self, other: &Self) -> Self {
        if other.phi > 0.0 { self.with(other) } else { self }
    }

    /// Cost of the set by itself.
    pub fn cost(&self) -> f64 {
        self.phi * self.spread
    }

    /// Cost that merging the sets, of positive flux, adds.
    pub fn merging(&self, other: &Self) -> f64 {
        let [x, y, z] = [0, 1, 2].map(|k| self.center[k] - other.center[k]);
        let reduced = self.phi * other.phi / (self.phi + other.phi);
        reduced * ((x * x + y * y) + z * z)
    }

    /// Cost of the merged set as a child, with both sets one level further down.
    pub fn pairing(&self, other: &Self) -> f64 {
        self.merging(other) + self.cost() + other.cost()
    }

    /// The merged set; both are of positive flux.
    pub fn with(&self, other: &Self) -> Self {
        let phi = self.phi + other.phi;
        let center = [0, 1, 2].map(|k| (self.phi * self.center[k] + other.phi * other.center[k]) / phi);
        Self {
            phi,
            center,
            spread: self.pairing(other) / phi,
        }
    }
}
