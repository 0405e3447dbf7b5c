//! Affine maps of instances, and which of them a shared bottom level can serve.

mod error;
mod extent;
mod vector;

pub use error::TransformError;
pub(crate) use extent::Extent;

use crate::exact;
use crate::instance::Instance;
use crate::light::{EmissiveTriangle, MAX_COORDINATE, MIN_COORDINATE};
use crate::tree::MeshLeaf;
use vector::{cross, dot, greatest, length, magnitude};

/// Most that the columns' products may be off those of s times an orthogonal matrix, as a share of s²: 2^-21, what rounding
/// a rotation to `f32` leaves and some more.
const SIMILAR: f64 = 1.0 / 2_097_152.0;
/// Least and greatest scale that a shared bottom level can serve: 2^-19 and 2^19.
const SCALES: [f64; 2] = [1.0 / 524_288.0, 524_288.0];
/// Least extent of a mesh in the world that a shared bottom level can serve, metres: 2^-30.
const LEAST_EXTENT: f64 = 1.0 / 1_073_741_824.0;
/// Greatest angle by which rounding may turn a normal before a mesh needs triangles of its own, rad.
const MOST_TILT: f64 = 0.125;
/// Entries below this share of the scale count as zero: 2^-26.
const TINY_ENTRY: f64 = 1.0 / 67_108_864.0;
/// 2^-22: one rounding of 2^-24 for each of three products and three sums makes less than four of them.
const ROUNDING: f64 = 1.0 / 4_194_304.0;
/// What a similarity may turn a normal by itself, rad: 2^-18, for columns off by 2^-21 and the normalisation of axes.
const BASE_TILT: f64 = 1.0 / 262_144.0;

/// An affine map `x ↦ A x + t` from a mesh's space to the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// The columns of A; each entry of magnitude at most 2^40.
    pub columns: [[f32; 3]; 3],
    /// t, metres; each entry of magnitude at most 2^40.
    pub translation: [f32; 3],
}

impl Transform {
    /// Leaves everything where it is.
    pub const IDENTITY: Self = Self {
        columns: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        translation: [0.0; 3],
    };

    /// Moves by `translation` metres.
    #[must_use]
    pub const fn at(translation: [f32; 3]) -> Self {
        Self {
            translation,
            ..Self::IDENTITY
        }
    }

    /// Whether every entry is a number within the domain, and a mesh of that extent stays within it.
    pub(crate) fn check(&self, extent: &Extent) -> Result<(), TransformError> {
        let [a, b, c] = &self.columns;
        let columns = [a, b, c, &self.translation];
        // NaN is in no range.
        let within = |value: f32| exact::abs(value) <= MAX_COORDINATE;
        // Looked at together first: thousands may move in a frame, and all of them are within.
        let all = columns
            .iter()
            .fold(true, |all, c| all & within(c[0]) & within(c[1]) & within(c[2]));
        if !all {
            for (column, entries) in columns.iter().enumerate() {
                for (row, &value) in entries.iter().enumerate() {
                    if !within(value) {
                        return Err(TransformError::Entry { row, column, value });
                    }
                }
            }
        }
        let reach = |row: usize| {
            let entry = |column: &[f32; 3]| f64::from(exact::abs(column[row]));
            ((entry(a) + entry(b)) + entry(c)) * extent.radius + entry(&self.translation)
        };
        let farthest = greatest(greatest(reach(0), reach(1)), reach(2));
        if farthest > f64::from(MAX_COORDINATE) {
            return Err(TransformError::TooFar {
                metres: farthest as f32,
            });
        }
        Ok(())
    }

    fn column(&self, k: usize) -> [f64; 3] {
        let [x, y, z] = self.columns[k];
        [f64::from(x), f64::from(y), f64::from(z)]
    }

    fn determinant(&self) -> f64 {
        let [a, b, c] = [self.column(0), self.column(1), self.column(2)];
        a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1])
            + c[0] * (a[1] * b[2] - a[2] * b[1])
    }

    /// A point of the mesh in the world, rounded once.
    fn point(&self, p: [f32; 3]) -> [f32; 3] {
        let p = p.map(f64::from);
        core::array::from_fn(|row| {
            let across = f64::from(self.columns[0][row]) * p[0]
                + f64::from(self.columns[1][row]) * p[1]
                + f64::from(self.columns[2][row]) * p[2];
            exact::flush((across + f64::from(self.translation[row])) as f32, MIN_COORDINATE)
        })
    }

    /// A triangle of the mesh in the world; where the map mirrors, two vertices are swapped, so that the front stays in
    /// front.
    pub(crate) fn bake(&self, triangle: &EmissiveTriangle) -> EmissiveTriangle {
        let [a, b, c] = triangle.p.map(|p| self.point(p));
        let mirrors = self.determinant() < 0.0;
        EmissiveTriangle {
            p: if mirrors { [a, c, b] } else { [a, b, c] },
            ..*triangle
        }
    }

    /// `self ∘ baked⁻¹`: the map of what was baked to where it is to stand now. `None` where the baked map was singular.
    pub(crate) fn since(&self, baked: &Self) -> Option<Self> {
        let determinant = baked.determinant();
        let [a, b, c] = [baked.column(0), baked.column(1), baked.column(2)];
        let lengths = length(a) * length(b) * length(c);
        // Flat maps cannot be undone, nearly flat ones not precisely.
        if magnitude(determinant) <= 1e-9 * lengths {
            return None;
        }
        // Rows of the inverse: cross products of the columns over the determinant.
        let rows = [cross(b, c), cross(c, a), cross(a, b)].map(|row| row.map(|x| x / determinant));
        let mut columns = [[0.0f64; 3]; 3];
        for (k, column) in columns.iter_mut().enumerate() {
            for (row, entry) in column.iter_mut().enumerate() {
                *entry = (0..3).map(|j| f64::from(self.columns[j][row]) * rows[j][k]).sum();
            }
        }
        let translation: [f32; 3] = core::array::from_fn(|row| {
            let moved: f64 = (0..3)
                .map(|k| columns[k][row] * f64::from(baked.translation[k]))
                .sum();
            (f64::from(self.translation[row]) - moved) as f32
        });
        Some(Self {
            columns: columns.map(|column| column.map(|x| x as f32)),
            translation,
        })
    }

    /// The instance of a bottom level of that extent under this map, if it can be shared: the map is a similarity, and
    /// rounding is small against the mesh. Its flux and radiance are for a factor of `radiance`; its links are not set.
    pub(crate) fn similarity(&self, extent: &Extent, radiance: f32) -> Option<Instance> {
        let columns = [self.column(0), self.column(1), self.column(2)];
        let gram = |i: usize, j: usize| dot(columns[i], columns[j]);
        let (lengths, angles) = (
            [gram(0, 0), gram(1, 1), gram(2, 2)],
            [gram(0, 1), gram(0, 2), gram(1, 2)],
        );
        let squared = (lengths[0] + lengths[1] + lengths[2]) * (1.0 / 3.0);
        if !(SCALES[0] * SCALES[0]..=SCALES[1] * SCALES[1]).contains(&squared) {
            return None;
        }
        // One step from a root in f32 leaves nothing that f32 could show.
        let root = f64::from(exact::sqrt(squared as f32));
        let scale = 0.5 * (root + squared / root);
        let most = SIMILAR * squared;
        let even = (0..3).fold(true, |even, k| {
            even & (magnitude(lengths[k] - squared) <= most) & (magnitude(angles[k]) <= most)
        });
        if !even {
            return None;
        }
        let [x, y, z] = self.translation.map(|t| f64::from(exact::abs(t)));
        let farthest = greatest(greatest(x, y), z);
        let reach = scale * extent.radius;
        let error = ROUNDING * (2.0 * reach + farthest);
        let tilt = BASE_TILT + 4.0 * error / (scale * extent.finest);
        if reach < LEAST_EXTENT || tilt > MOST_TILT {
            return None;
        }
        let flux = f64::from(radiance) * squared;
        let tiny = scale * TINY_ENTRY;
        let mut entries = self.columns;
        for column in 0..3 {
            for row in 0..3 {
                let small = magnitude(columns[column][row]) < tiny;
                entries[column][row] = if small { 0.0 } else { entries[column][row] };
            }
        }
        Some(Instance {
            columns: entries,
            translation: self.translation.map(|t| exact::flush(t, MIN_COORDINATE)),
            per_scale: (1.0 / scale) as f32,
            flux: flux as f32,
            radiance,
            error: error as f32,
            tilt: tilt as f32,
            mirrored: u32::from(self.determinant() < 0.0),
            ..Instance::world(0, 0)
        })
    }
}

#[cfg(test)]
mod tests;
