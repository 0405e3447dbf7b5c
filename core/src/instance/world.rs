//! Bounds of a mesh's lights in the world.

use glam::Vec3;

use super::{Instance, flushed};
use crate::bounds::{LightBounds, MAX_PHI, MAX_SUM, MIN_PHI};
use crate::cone::{normalized, widened};
use crate::exact::{self, exponent, pow2, significand};

/// Least angle by which a cone is widened on its way into the world, 2^-11 rad: cosines near 1 resolve no less.
const LEAST_TURN: f32 = pow2(-11);

const _: () = assert!(MAX_PHI < MAX_SUM);

/// Bounds in the world of what has the bounds `local` in the space of the mesh of `instance`.
#[inline(always)]
pub(super) fn to_world(instance: &Instance, local: &LightBounds) -> LightBounds {
    let center = flushed((local.min + local.max) * 0.5);
    let reach = |k: usize| {
        let (low, high, c) = (
            component(local.min, k),
            component(local.max, k),
            component(center, k),
        );
        exact::max(high - c, c - low)
    };
    let half = flushed(Vec3::new(reach(0), reach(1), reach(2)));
    let absolute = |v: Vec3| Vec3::new(exact::abs(v.x), exact::abs(v.y), exact::abs(v.z));
    let (a, b, c) = (
        absolute(instance.column(0)),
        absolute(instance.column(1)),
        absolute(instance.column(2)),
    );
    let middle = instance.turn(center) + instance.origin();
    let extent = (a * half.x + b * half.y) + c * half.z;
    // Rounding of the map and of the sums here, 2^-22 of what goes into them; and what the vertices may be off.
    let from = absolute(center);
    let terms = (a * from.x + b * from.y) + (c * from.z + absolute(instance.origin()));
    let grown = extent * (1.0 + 4.0 * pow2(-22)) + terms * pow2(-21);
    let outward = Vec3::new(
        grown.x + instance.error,
        grown.y + instance.error,
        grown.z + instance.error,
    );
    let axis = normalized(instance.turn(flushed(local.axis)) * instance.per_scale);
    let turn = exact::max(instance.tilt, LEAST_TURN);
    let cos_theta_o = widened(local.cos_theta_o, turn, turn * turn);

    // Φ with its exponents apart, so that no product leaves the range.
    let scale = exponent(local.phi) + exponent(instance.flux);
    let bounded = if scale < -110 {
        -110
    } else if scale > 124 {
        124
    } else {
        scale
    };
    let phi = significand(local.phi) * significand(instance.flux) * pow2(bounded);
    let shines = local.phi > 0.0 && instance.flux > 0.0;
    // Exact where nothing moves: a bottom level in world space has the same bounds there.
    let moved = instance.error > 0.0;
    LightBounds {
        min: if moved { middle - outward } else { local.min },
        max: if moved { middle + outward } else { local.max },
        axis: if moved { axis } else { local.axis },
        cos_theta_o: if moved { cos_theta_o } else { local.cos_theta_o },
        cos_theta_e: local.cos_theta_e,
        phi: if shines {
            exact::clamp(phi, MIN_PHI, MAX_SUM)
        } else {
            0.0
        },
    }
}

#[inline(always)]
fn component(v: Vec3, k: usize) -> f32 {
    if k == 0 {
        v.x
    } else if k == 1 {
        v.y
    } else {
        v.z
    }
}
