//! Points of the world in the space of a mesh.

use glam::Vec3;

use super::{Instance, flushed};
use crate::exact::{self, pow2};
use crate::point::{Receiver, ShadingPoint};

/// Share of a point's distance from the mesh's origin by which it may be off once it is in the mesh's space: 2^-20. Two
/// roundings of 2^-24 for each of three products and sums, as much for the map's own, and 2^-21 for its not being quite a
/// similarity (`Transform::similarity` allows no more).
const POINT_SLACK: f32 = pow2(-20);
/// Slack that turns a direction by 2^-11 rad at the distance of 2048 slacks.
const NEAR: f32 = 2048.0;
/// Greatest magnitude of a coordinate in a mesh's space, 2^60: only points farther off than any accepted one are cut there.
const FAR: f32 = pow2(60);

/// A point in the space of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct LocalPoint {
    p: Vec3,
    n: Vec3,
    slack: f32,
    near_squared: f32,
    tilt: f32,
}

impl Receiver for LocalPoint {
    const ROUNDED: bool = true;

    #[inline(always)]
    fn position(&self) -> Vec3 {
        self.p
    }

    #[inline(always)]
    fn normal(&self) -> Vec3 {
        self.n
    }

    #[inline(always)]
    fn slack(&self) -> f32 {
        self.slack
    }

    #[inline(always)]
    fn near_squared(&self) -> f32 {
        self.near_squared
    }

    #[inline(always)]
    fn tilt(&self) -> f32 {
        self.tilt
    }
}

impl LocalPoint {
    /// A point of the world as it is.
    #[inline(always)]
    pub(super) fn outside(point: &ShadingPoint) -> Self {
        Self {
            p: point.position(),
            n: point.normal(),
            slack: 0.0,
            near_squared: 0.0,
            tilt: 0.0,
        }
    }

    /// A point of the world in the space of the mesh of `instance`.
    #[inline(always)]
    pub(super) fn inside(instance: &Instance, point: &ShadingPoint) -> Self {
        let per_scale = instance.per_scale;
        let back =
            instance.turn_back(flushed(point.position() - instance.origin())) * (per_scale * per_scale);
        let p = Vec3::new(
            exact::clamp(back.x, -FAR, FAR),
            exact::clamp(back.y, -FAR, FAR),
            exact::clamp(back.z, -FAR, FAR),
        );
        let distance = (exact::abs(p.x) + exact::abs(p.y)) + exact::abs(p.z);
        let slack = distance * POINT_SLACK + instance.error * per_scale;
        let near = slack * NEAR;
        let moved = Self {
            p: flushed(p),
            n: flushed(instance.turn_back(point.normal()) * per_scale),
            slack,
            near_squared: near * near,
            tilt: instance.tilt,
        };
        // A bottom level in the world's own space is exact, and so are its points.
        if instance.error > 0.0 {
            moved
        } else {
            Self::outside(point)
        }
    }
}
