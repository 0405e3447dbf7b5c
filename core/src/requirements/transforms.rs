//! What the maps of instances do.

use crate::transform::Transform;

/// The simplest kind that a map is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TransformKind {
    /// Every entry is that of the identity.
    Identity,
    /// The linear part is that of the identity.
    Translation,
    /// Lengths stay, up to [`TOLERANCE`].
    Rigid,
    /// All lengths grow alike, up to [`TOLERANCE`].
    Uniform,
    /// Lengths grow unlike in different directions.
    NonUniform,
}

/// How much the entries of AᵀA may differ from those of a multiple of the identity, in units of it: 2^-20. Rotations rounded to
/// `f32` are within 2^-22.
pub const TOLERANCE: f64 = 1.0 / 1_048_576.0;

impl TransformKind {
    /// Of `transform`. A mirroring map is of the kind that its lengths say.
    #[must_use]
    pub fn of(transform: &Transform) -> Self {
        if transform.columns == Transform::IDENTITY.columns {
            return if transform.translation == [0.0; 3] {
                Self::Identity
            } else {
                Self::Translation
            };
        }
        let columns = transform.columns.map(|column| column.map(f64::from));
        let gram = |i: usize, j: usize| -> f64 { (0..3).map(|k| columns[i][k] * columns[j][k]).sum() };
        let squared = (gram(0, 0) + gram(1, 1) + gram(2, 2)) / 3.0;
        let near = |found: f64, expected: f64, unit: f64| {
            let off = found - expected;
            off <= TOLERANCE * unit && -off <= TOLERANCE * unit
        };
        let alike =
            (0..3).all(|i| (0..3).all(|j| near(gram(i, j), if i == j { squared } else { 0.0 }, squared)));
        // A map onto one point has no scale.
        if !alike || squared <= 0.0 {
            Self::NonUniform
        } else if near(squared, 1.0, 1.0) {
            Self::Rigid
        } else {
            Self::Uniform
        }
    }
}
