//! Random affine maps for instances.

use glam::{DMat3, DQuat, DVec3};
use lightbvh::Transform;

use crate::generate::{self, Random};

/// What kind of map to make.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Rotation and translation.
    Rigid,
    /// And an even scale, mirrored half of the time.
    Similar,
    /// Different scales along the axes, and shear.
    Affine,
    /// One direction flattened.
    Flat,
    /// Two directions on one, or everything to a point.
    Singular,
    /// Entries of every magnitude from 2^-62 to 2^12, one column after the other.
    Extreme,
}

impl Kind {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::Rigid,
        Self::Similar,
        Self::Affine,
        Self::Flat,
        Self::Singular,
        Self::Extreme,
    ];
}

/// A map of `kind` to within `reach` metres of the origin.
pub fn transform(random: &mut Random, kind: Kind, reach: f32) -> Transform {
    let axis = DVec3::from(random.direction().map(f64::from));
    let turn = DMat3::from_quat(DQuat::from_axis_angle(
        axis.normalize(),
        f64::from(random.between(-3.2, 3.2)),
    ));
    let factor = |random: &mut Random| f64::from(random.between(-1.5, 1.5)).exp2();
    let matrix = match kind {
        Kind::Rigid => turn,
        Kind::Similar => {
            let sign = if random.below(2) == 0 { 1.0 } else { -1.0 };
            turn * (factor(random) * sign)
        }
        Kind::Affine => {
            let scale = DVec3::new(factor(random), factor(random), -factor(random));
            let shear = DMat3::from_cols(
                DVec3::X,
                DVec3::new(f64::from(random.between(-0.5, 0.5)), 1.0, 0.0),
                DVec3::Z,
            );
            turn * DMat3::from_diagonal(scale) * shear
        }
        Kind::Flat => turn * DMat3::from_diagonal(DVec3::new(1.0, 0.0, factor(random))),
        Kind::Singular => {
            let along = turn.x_axis;
            let mut column = || along * f64::from(random.below(5)) * 0.25;
            DMat3::from_cols(column(), column(), column())
        }
        Kind::Extreme => {
            let mut column = || {
                let size = f64::from(generate::log_uniform(random, -62, 11));
                DVec3::from(random.direction().map(f64::from)) * size
            };
            DMat3::from_cols(column(), column(), column())
        }
    };
    let columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    Transform {
        columns: columns.map(|c| c.to_array().map(|x| x as f32)),
        translation: std::array::from_fn(|_| random.between(-reach, reach)),
    }
}

/// A kind, the usual ones more often.
pub fn kind(random: &mut Random) -> Kind {
    match random.below(12) {
        0..=3 => Kind::Rigid,
        4..=6 => Kind::Similar,
        7..=8 => Kind::Affine,
        9 => Kind::Flat,
        10 => Kind::Singular,
        _ => Kind::Extreme,
    }
}
