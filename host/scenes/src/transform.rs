//! Node transforms: translation, rotation, scale or a matrix, composed in `f64`.

use glam::{DAffine3, DQuat};

use crate::vector::dot;

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

    /// The same as an affine map.
    pub(super) fn affine(&self) -> DAffine3 {
        match *self {
            Self::Trs {
                translation,
                rotation,
                scale,
            } => {
                let [translation, scale] = [translation, scale].map(|v| v.map(f64::from));
                trs(translation, normalized(rotation.map(f64::from)), scale)
            }
            Self::Matrix(columns) => affine(&columns),
        }
    }
}

/// Scaled, then turned by a unit quaternion, then moved.
pub(super) fn trs(translation: [f64; 3], rotation: [f64; 4], scale: [f64; 3]) -> DAffine3 {
    let rotation = DQuat::from_array(rotation);
    DAffine3::from_scale_rotation_translation(scale.into(), rotation, translation.into())
}

/// Of four columns of three rows.
pub(super) fn affine(columns: &[[f32; 3]; 4]) -> DAffine3 {
    DAffine3::from_cols_array_2d(&columns.map(|column| column.map(f64::from)))
}

/// Rounded to what a light BVH takes.
pub(super) fn to_light_bvh(place: &DAffine3) -> lightbvh::Transform {
    let [a, b, c, translation] = place.to_cols_array_2d().map(|column| column.map(|x| x as f32));
    lightbvh::Transform {
        columns: [a, b, c],
        translation,
    }
}

/// Whether a map turns left hands into right hands.
pub(super) fn mirrors(map: &DAffine3) -> bool {
    let m = &map.matrix3;
    m.x_axis.cross(m.y_axis).dot(m.z_axis) < 0.0
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
