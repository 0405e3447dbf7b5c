//! Node transforms: translation, rotation, scale or a matrix, composed in `f64`.

use crate::vector::{cross, dot};

/// A node's place relative to its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Transform {
    /// Scale first, then rotation, then translation (glTF 2.0, section 3.5.3).
    Trs {
        /// Metres.
        translation: [f32; 3],
        /// Quaternion `[x, y, z, w]`; normalised before use.
        rotation: [f32; 4],
        /// Factor per axis; negative factors mirror.
        scale: [f32; 3],
    },
    /// The upper three rows of a column-major 4x4 matrix: four columns of three rows.
    Matrix([[f32; 3]; 4]),
}

impl Default for Transform {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl Transform {
    /// Leaves everything where it is.
    pub const IDENTITY: Self = Self::Trs {
        translation: [0.0; 3],
        rotation: [0.0, 0.0, 0.0, 1.0],
        scale: [1.0; 3],
    };

    /// Moves by `translation` metres.
    pub fn at(translation: [f32; 3]) -> Self {
        Self::Trs {
            translation,
            rotation: [0.0, 0.0, 0.0, 1.0],
            scale: [1.0; 3],
        }
    }

    /// Its rotation and mirroring alone. Of an axis that a matrix takes to zero nothing is known: it stays.
    pub(super) fn turn(&self) -> Affine {
        match *self {
            Self::Trs { rotation, scale, .. } => Affine::from_trs(
                [0.0; 3],
                normalized(rotation.map(f64::from)),
                scale.map(|factor| if factor < 0.0 { -1.0 } else { 1.0 }),
            ),
            Self::Matrix(_) => {
                let mut turn = self.affine().of_unit_columns();
                turn.columns[3] = [0.0; 3];
                turn
            }
        }
    }

    /// The same as an affine map.
    pub(super) fn affine(&self) -> Affine {
        match *self {
            Self::Trs {
                translation,
                rotation,
                scale,
            } => Affine::from_trs(
                translation.map(f64::from),
                normalized(rotation.map(f64::from)),
                scale.map(f64::from),
            ),
            Self::Matrix(columns) => Affine {
                columns: columns.map(|column| column.map(f64::from)),
            },
        }
    }
}

/// An affine map in `f64`: three columns of the linear part, then the translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Affine {
    pub columns: [[f64; 3]; 4],
}

impl Affine {
    pub const IDENTITY: Self = Self {
        columns: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]],
    };

    /// `rotation` must be a unit quaternion `[x, y, z, w]`.
    pub fn from_trs(translation: [f64; 3], rotation: [f64; 4], scale: [f64; 3]) -> Self {
        let [x, y, z, w] = rotation;
        let axes = [
            [
                1.0 - 2.0 * (y * y + z * z),
                2.0 * (x * y + z * w),
                2.0 * (x * z - y * w),
            ],
            [
                2.0 * (x * y - z * w),
                1.0 - 2.0 * (x * x + z * z),
                2.0 * (y * z + x * w),
            ],
            [
                2.0 * (x * z + y * w),
                2.0 * (y * z - x * w),
                1.0 - 2.0 * (x * x + y * y),
            ],
        ];
        let scaled = |i: usize| axes[i].map(|component| component * scale[i]);
        Self {
            columns: [scaled(0), scaled(1), scaled(2), translation],
        }
    }

    /// First `inner`, then `self`.
    pub fn then_after(&self, inner: &Self) -> Self {
        let column = |i: usize| self.vector(inner.columns[i]);
        Self {
            columns: [column(0), column(1), column(2), self.point(inner.columns[3])],
        }
    }

    pub fn vector(&self, v: [f64; 3]) -> [f64; 3] {
        let [a, b, c, _] = &self.columns;
        [0, 1, 2].map(|row| (a[row] * v[0] + b[row] * v[1]) + c[row] * v[2])
    }

    pub fn point(&self, p: [f64; 3]) -> [f64; 3] {
        let v = self.vector(p);
        [0, 1, 2].map(|row| v[row] + self.columns[3][row])
    }

    /// Whether the lengths of all columns are such that their directions are exact in `f32`, and within the domain of a light
    /// BVH's transforms.
    pub fn keeps_directions(&self) -> bool {
        const LARGEST: f64 = (1_u64 << 40) as f64;
        let lengths = self.columns[..3].iter().map(|&v| dot(v, v).sqrt());
        lengths
            .into_iter()
            .all(|length| (1.0 / LARGEST..=LARGEST).contains(&length))
    }

    /// The same with columns of length one; those of length zero are the axes'.
    pub fn of_unit_columns(&self) -> Self {
        let [a, b, c, translation] = self.columns;
        let [x, y, z, _] = Self::IDENTITY.columns;
        Self {
            columns: [unit_or(a, x), unit_or(b, y), unit_or(c, z), translation],
        }
    }

    /// Whether the map turns left hands into right hands.
    pub fn mirrors(&self) -> bool {
        let [a, b, c, _] = self.columns;
        dot(cross(a, b), c) < 0.0
    }

    /// Frobenius norm of the linear part: no vector grows by more than this factor.
    pub fn stretch(&self) -> f64 {
        self.columns[..3]
            .iter()
            .flatten()
            .map(|x| x * x)
            .sum::<f64>()
            .sqrt()
    }
}

/// `v` at length one; `fallback` where it has no direction.
pub(super) fn unit_or(v: [f64; 3], fallback: [f64; 3]) -> [f64; 3] {
    // Scaling by the largest component first keeps the square from overflowing or vanishing.
    let largest = v.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if !(largest > 0.0 && largest.is_finite()) {
        return fallback;
    }
    let v = v.map(|x| x / largest);
    let length = dot(v, v).sqrt();
    v.map(|x| x / length)
}

/// The unit quaternion along `q`; the identity where `q` is zero.
pub(super) fn normalized(q: [f64; 4]) -> [f64; 4] {
    let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length > 0.0 && length.is_finite() {
        q.map(|x| x / length)
    } else {
        [0.0, 0.0, 0.0, 1.0]
    }
}

/// Spherical linear interpolation along the shorter arc (glTF 2.0, appendix C.4).
pub(super) fn slerp(a: [f64; 4], b: [f64; 4], t: f64) -> [f64; 4] {
    let (a, b) = (normalized(a), normalized(b));
    let cosine: f64 = (0..4).map(|i| a[i] * b[i]).sum();
    let sign = if cosine < 0.0 { -1.0 } else { 1.0 };
    let angle = libm::acos((cosine * sign).min(1.0));
    let (wa, wb) = if angle < 1e-6 {
        // Too close for the sines' quotient; the chord is the arc here.
        (1.0 - t, t)
    } else {
        let sine = libm::sin(angle);
        (libm::sin((1.0 - t) * angle) / sine, libm::sin(t * angle) / sine)
    };
    normalized([0, 1, 2, 3].map(|i| wa * a[i] + sign * wb * b[i]))
}
