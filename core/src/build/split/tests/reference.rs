//! Eq. 2 and Eq. 3 of the paper in `f64`, by angles.

use core::f64::consts::{FRAC_PI_2, PI};

use crate::build::cost::Heuristic;
use crate::build::primitive::Group;
use crate::kit::{Wide, dot};

/// Middle and half extents of the box of a group's lanes from `first` on.
fn box_of(group: &Group, first: usize) -> [Wide; 2] {
    let of = |sign: f64| {
        [0, 1, 2].map(|k| (f64::from(group.high[first + k]) + sign * f64::from(group.low[first + k])) / 2.0)
    };
    [of(1.0), of(-1.0)]
}

fn sides(group: &Group) -> Wide {
    box_of(group, 0)[1].map(|half| 2.0 * half)
}

fn longest(group: &Group) -> f64 {
    sides(group).into_iter().fold(0.0, f64::max)
}

/// Half the surface, and 1/1024 of the sides' sum, in units of the node's longest side.
fn area(group: &Group, node: &Group) -> f64 {
    let [x, y, z] = sides(group).map(|side| side / longest(node));
    x * y + y * z + z * x + (x + y + z) / 1024.0
}

/// θ_o of the cone around the middle m of the box of normals: a unit vector within ρ of m has x·m ≥ (1 + |m|² − ρ²)/2.
/// The cosine is `off` by that much of it.
fn theta_o(group: &Group, off: f64) -> f64 {
    let [m, rho] = box_of(group, 4);
    if dot(m, m) < 1e-6 {
        return PI;
    }
    let cos = (1.0 + dot(m, m) - dot(rho, rho)) / (2.0 * dot(m, m).sqrt());
    (cos * (1.0 + off)).clamp(-1.0, 1.0).acos()
}

/// M_Ω of Conty Estevez & Kulla 2018, Eq. 2, for θ_e = π/2.
fn orientation(o: f64) -> f64 {
    let w = (o + FRAC_PI_2).min(PI);
    let rest = 2.0 * w * o.sin() - (o - 2.0 * w).cos() - 2.0 * o * o.sin() + o.cos();
    2.0 * PI * (1.0 - o.cos()) + FRAC_PI_2 * rest
}

/// A term of the numerator: n·a of Eq. 2, or Φ·a·M_Ω of Eq. 3, where 1/1024 of the share of lights counts as flux. The cone's
/// cosine is `off` by that much of it.
pub fn cost(heuristic: Heuristic, group: &Group, node: &Group, off: f64) -> f64 {
    let count = f64::from(group.count) / f64::from(node.count);
    let phi = if node.phi > 0.0 {
        f64::from(group.phi) / f64::from(node.phi)
    } else {
        0.0
    };
    match heuristic {
        Heuristic::Sah => count * area(group, node),
        _ => (phi + count / 1024.0) * area(group, node) * orientation(theta_o(group, off)),
    }
}

/// k_r of Eq. 3: the longest side over that along `axis`, a millionth of the longest at least; 1 in Eq. 2.
pub fn regularization(heuristic: Heuristic, node: &Group, axis: usize) -> f64 {
    match heuristic {
        Heuristic::Sah => 1.0,
        _ => longest(node) / sides(node)[axis].max(1e-6 * longest(node)),
    }
}
