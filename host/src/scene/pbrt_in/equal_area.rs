//! pbrt's equal-area squares (Clarberg 2008, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD"): the sphere on an
//! octahedron, whose faces keep areas.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_4};

/// The place in [0, 1]² of a unit direction: its middle is +z, its edges lead to −z.
pub(super) fn square_of([x, y, z]: [f64; 3]) -> [f64; 2] {
    let r = (1.0 - z.abs()).max(0.0).sqrt();
    let (a, b) = (x.abs().max(y.abs()), x.abs().min(y.abs()));
    let phi = FRAC_2_PI * if a == 0.0 { 0.0 } else { libm::atan(b / a) };
    let phi = if x.abs() < y.abs() { 1.0 - phi } else { phi };
    let v = phi * r;
    let mut uv = [r - v, v];
    if z < 0.0 {
        uv = [1.0 - uv[1], 1.0 - uv[0]];
    }
    [0.5 * (uv[0].copysign(x) + 1.0), 0.5 * (uv[1].copysign(y) + 1.0)]
}

/// The unit direction of a place.
pub fn direction_of(square: [f64; 2]) -> [f64; 3] {
    let [u, v] = square.map(|x| 2.0 * x - 1.0);
    let (up, vp) = (u.abs(), v.abs());
    let distance = 1.0 - (up + vp);
    let r = 1.0 - distance.abs();
    let phi = FRAC_PI_4 * if r == 0.0 { 1.0 } else { (vp - up) / r + 1.0 };
    let z = (1.0 - r * r).copysign(distance);
    let (sine, cosine) = libm::sincos(phi);
    let across = r * (2.0 - r * r).max(0.0).sqrt();
    [cosine.copysign(u) * across, sine.copysign(v) * across, z]
}
