//! Affine maps of instances.

use glam::{Affine3A, Quat, Vec3};

use crate::domain::DomainError;
use crate::emission::luminance_of;
use crate::exact;
use crate::instance::Instance;
use crate::light::{Light, MAX_COORDINATE, MIN_COORDINATE};
use crate::vector;

/// Entries of the maps below this count as zero: 2^-60.
const TINY_ENTRY: f32 = exact::pow2(-60);
/// Greatest entry of an inverse: 2^60.
const MOST_ENTRY: f64 = 1_152_921_504_606_846_976.0;
/// Greatest and least mean factor on flux that is not zero.
const FLUX: [f32; 2] = [exact::pow2(-100), exact::pow2(100)];
/// Least determinant, as a share of the cube of the greatest entry, that is divided by: 2^-60. Flatter maps have no inverse.
const FLAT: f64 = 1.0 / 1_152_921_504_606_846_976.0;

/// Squared sine below which the cross product of two unit vectors is rounding: 2^-30.
const NEARLY_PARALLEL: f32 = exact::pow2(-30);

/// Names of the entries, by column.
const ENTRIES: [[&str; 3]; 4] = [
    ["columns[0][0]", "columns[0][1]", "columns[0][2]"],
    ["columns[1][0]", "columns[1][1]", "columns[1][2]"],
    ["columns[2][0]", "columns[2][1]", "columns[2][2]"],
    ["translation[0]", "translation[1]", "translation[2]"],
];

/// An affine map `x ↦ A x + t` from a mesh's space to the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// The columns of A; each entry of magnitude at most 2^40.
    pub columns: [[f32; 3]; 3],
    /// t, metres; each entry of magnitude at most 2^40.
    pub translation: [f32; 3],
}

impl From<Affine3A> for Transform {
    fn from(map: Affine3A) -> Self {
        Self {
            columns: map.matrix3.to_cols_array_2d(),
            translation: map.translation.to_array(),
        }
    }
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

    /// The three columns of A, then t: `VkTransformMatrixKHR` and DXR's matrix have [rows](Self::from_rows).
    #[must_use]
    pub const fn from_cols([a, b, c, translation]: [[f32; 3]; 4]) -> Self {
        Self {
            columns: [a, b, c],
            translation,
        }
    }

    /// The rows of A, each followed by its component of t.
    #[must_use]
    pub const fn from_rows([x, y, z]: [[f32; 4]; 3]) -> Self {
        Self::from_cols([
            [x[0], y[0], z[0]],
            [x[1], y[1], z[1]],
            [x[2], y[2], z[2]],
            [x[3], y[3], z[3]],
        ])
    }

    /// Scales along the mesh's axes, then turns by the unit quaternion `rotation` (x, y, z, w), then moves by `translation` metres.
    #[must_use]
    pub fn from_trs(translation: [f32; 3], rotation: [f32; 4], scale: [f32; 3]) -> Self {
        Affine3A::from_scale_rotation_translation(
            scale.into(),
            Quat::from_array(rotation),
            translation.into(),
        )
        .into()
    }

    /// Puts the mesh's origin at `p`, metres, and turns its −Z to `direction`, of any length, and its +Y as near to `up` as may be: as cameras
    /// and spots look in glTF. Where the two are parallel, or one is zero, any turn about the direction is taken. Where one is not finite, so
    /// is the map, which edits refuse.
    #[must_use]
    pub fn look_along(p: [f32; 3], direction: [f32; 3], up: [f32; 3]) -> Self {
        let [direction, up] = [direction, up].map(Vec3::from);
        if !(direction.is_finite() && up.is_finite()) {
            return Self::at([f32::NAN; 3]);
        }
        // Scaled, so that no square overflows or becomes zero.
        let within = |v: Vec3| {
            let [x, y, z] = vector::abs3(v).to_array();
            v / exact::max(exact::max(exact::max(x, y), z), f32::MIN_POSITIVE)
        };
        let back = -within(direction).normalize_or(Vec3::NEG_Z);
        let across = vector::cross(within(up).normalize_or(Vec3::ZERO), back);
        let across = match vector::length_squared(across) > NEARLY_PARALLEL {
            true => across.normalize_or(Vec3::X),
            false => back.any_orthonormal_vector(),
        };
        Self {
            columns: [across, vector::cross(back, across), back].map(|v| v.to_array()),
            translation: p,
        }
    }

    /// `light` as it stands in the world where this map puts its mesh, as part of mesh light `mesh`: what a light BVH over
    /// instances makes of it, to the bit, but for the instance's factor on radiance.
    #[must_use]
    pub fn place<L: Light>(&self, light: &L, mesh: u32) -> L {
        light.in_world(&self.instance_by([1.0; 3], true), mesh)
    }

    /// Whether every entry is a number within the domain, and a mesh of which no coordinate is beyond `reach` stays within it.
    pub(crate) fn check(&self, reach: f32) -> Result<(), DomainError> {
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
                        return Err(DomainError::number(
                            ENTRIES[column][row],
                            value,
                            "a finite number of magnitude at most 2^40 (1.1e12); repair the animation",
                        ));
                    }
                }
            }
        }
        let farthest = |row: usize| {
            let entry = |column: &[f32; 3]| f64::from(exact::abs(column[row]));
            ((entry(a) + entry(b)) + entry(c)) * f64::from(reach) + entry(&self.translation)
        };
        let farthest = greatest(greatest(farthest(0), farthest(1)), farthest(2));
        if farthest > f64::from(MAX_COORDINATE) {
            let what = "a place as far as a transform moves a mesh";
            let expected = "at most 2^40 m (1.1e12); scale the scene or move its origin";
            return Err(DomainError::number(what, farthest as f32, expected));
        }
        Ok(())
    }

    /// Image of the origin, as in an instance's words, metres.
    pub(crate) fn origin(&self) -> [f32; 3] {
        self.translation.map(|t| exact::flush(t, MIN_COORDINATE))
    }

    fn column(&self, k: usize) -> [f64; 3] {
        let [x, y, z] = self.columns[k];
        [f64::from(x), f64::from(y), f64::from(z)]
    }

    /// The instance of a bottom level under this map; its links are not set.
    ///
    /// The inverse is computed in `f64` from the cofactors. Where the map is flat the cofactors take its place, as large as
    /// `f32` products allow: weights then mean little, and stay positive.
    #[cfg(test)]
    pub(crate) fn instance(&self, radiance: f32) -> Instance {
        self.instance_by([radiance; 3], true)
    }

    /// The same of a mesh whose flux grows with area, or not at all.
    pub(crate) fn instance_by(&self, radiance: [f32; 3], is_by_area: bool) -> Instance {
        let columns = [self.column(0), self.column(1), self.column(2)];
        // Entries of about 1, so that products of three stay in range.
        let entry = columns
            .iter()
            .flatten()
            .fold(0.0, |most, &x| greatest(most, magnitude(x)));
        let per_entry = if entry > 0.0 { 1.0 / entry } else { 0.0 };
        let [a, b, c] = columns.map(|column| column.map(|x| x * per_entry));
        let cofactors = [cross(b, c), cross(c, a), cross(a, b)];
        let determinant = dot(a, cofactors[0]);
        let divisor = if magnitude(determinant) > FLAT {
            determinant
        } else {
            FLAT
        };
        // Rows of the inverse are the cofactors' columns over the determinant.
        let per_divisor = per_entry / divisor;
        let mut inverse = [[0.0f32; 3]; 3];
        for (row, cofactor) in cofactors.iter().enumerate() {
            for (column, &x) in cofactor.iter().enumerate() {
                let bounded = -greatest(-greatest(x * per_divisor, -MOST_ENTRY), -MOST_ENTRY);
                inverse[column][row] = exact::flush(bounded as f32, TINY_ENTRY);
            }
        }
        let squares = |m: &[[f64; 3]; 3]| dot(m[0], m[0]) + dot(m[1], m[1]) + dot(m[2], m[2]);
        // Roots of numbers from 2^-120 to 2^124.
        let norm = exact::sqrt(squares(&inverse.map(|column| column.map(f64::from))) as f32);
        let per_inverse = if norm > 0.0 { SQRT_3 / f64::from(norm) } else { 0.0 };
        let area = f64::from(exact::sqrt(squares(&cofactors) as f32)) / SQRT_3 * (entry * entry);
        let luminance = luminance_of(&radiance);
        let factor = if is_by_area { area } else { 1.0 };
        let not_by_area = if is_by_area { 0 } else { Instance::IS_NOT_BY_AREA };
        let flux = (factor * f64::from(luminance)) as f32;
        Instance {
            columns: self
                .columns
                .map(|column| column.map(|x| exact::flush(x, TINY_ENTRY))),
            translation: self.origin(),
            inverse,
            per_inverse: per_inverse as f32,
            flux: if luminance > 0.0 {
                exact::clamp(flux, FLUX[0], FLUX[1])
            } else {
                0.0
            },
            radiance,
            mirrored: u32::from(determinant < 0.0) | not_by_area,
            ..Instance::IDENTITY
        }
    }
}

/// √3.
const SQRT_3: f64 = 1.732_050_807_568_877_2;

/// Greatest magnitude of a coordinate that one of these lights reaches, metres.
pub(crate) fn reach_of<L: Light>(lights: &[L]) -> f32 {
    lights.iter().map(Light::reach).fold(0.0, exact::max)
}

// Vectors of `f64`, without the standard library: transforms are measured with more digits than they are applied with.

fn magnitude(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & !(1 << 63))
}

fn greatest(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[cfg(test)]
mod tests;
