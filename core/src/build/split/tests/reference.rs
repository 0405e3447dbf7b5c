//! Eq. 2 and Eq. 3 of the paper, by angles, and all planes tried.

extern crate std;

use core::f64::consts::{FRAC_PI_2, PI};
use std::vec::Vec;

use crate::LightBounds;
use crate::build::cost::Heuristic;

/// A light: its box, the box of its normals, its flux.
#[derive(Clone, Copy)]
pub struct Light {
    min: [f64; 3],
    max: [f64; 3],
    least_normal: [f64; 3],
    greatest_normal: [f64; 3],
    phi: f64,
}

impl Light {
    pub fn of(b: &LightBounds) -> Self {
        let axis = b.axis.to_array().map(f64::from);
        let theta_o = f64::from(b.cos_theta_o).acos();
        // The farthest that a direction within θ_o of the axis reaches.
        let reach = |a: f64| (a.clamp(-1.0, 1.0).acos() - theta_o).max(0.0).cos();
        Self {
            min: b.min.to_array().map(f64::from),
            max: b.max.to_array().map(f64::from),
            least_normal: axis.map(|a| -reach(-a)),
            greatest_normal: axis.map(reach),
            phi: b.phi.into(),
        }
    }
}

/// What the costs ask of a group of lights.
pub struct Exact {
    sides: [f64; 3],
    normals: [[f64; 3]; 2],
    phi: f64,
    count: f64,
}

impl Exact {
    pub fn of<'a>(lights: impl Iterator<Item = &'a Light> + Clone) -> Self {
        let least = |of: fn(&Light, usize) -> f64, k: usize| {
            lights.clone().map(|l| of(l, k)).fold(f64::INFINITY, f64::min)
        };
        let greatest = |of: fn(&Light, usize) -> f64, k: usize| {
            lights.clone().map(|l| of(l, k)).fold(f64::NEG_INFINITY, f64::max)
        };
        Self {
            sides: [0, 1, 2].map(|k| greatest(|l, k| l.max[k], k) - least(|l, k| l.min[k], k)),
            normals: [
                [0, 1, 2].map(|k| least(|l, k| l.least_normal[k], k)),
                [0, 1, 2].map(|k| greatest(|l, k| l.greatest_normal[k], k)),
            ],
            phi: lights.clone().map(|l| l.phi).sum(),
            count: lights.count() as f64,
        }
    }

    fn longest(&self) -> f64 {
        self.sides.iter().fold(0.0, |a: f64, &b| a.max(b))
    }

    /// Half the surface, and 1/1024 of the sides' sum, in units of the node's longest side.
    fn area(&self, node: &Self) -> f64 {
        let [x, y, z] = self.sides.map(|s| s / node.longest());
        x * y + y * z + z * x + (x + y + z) / 1024.0
    }

    /// θ_o of the cone around the middle m of the box of normals: a unit vector within ρ of m has x·m ≥ (1 + |m|² − ρ²)/2.
    /// The cosine is `off` by that much of it.
    fn theta_o(&self, off: f64) -> f64 {
        let [low, high] = self.normals;
        let m = [0, 1, 2].map(|k| (low[k] + high[k]) / 2.0);
        let rho = [0, 1, 2].map(|k| (high[k] - low[k]) / 2.0);
        let squared = |v: [f64; 3]| v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
        if squared(m) < 1e-6 {
            return PI;
        }
        let cos = (1.0 + squared(m) - squared(rho)) / (2.0 * squared(m).sqrt());
        (cos * (1.0 + off)).clamp(-1.0, 1.0).acos()
    }

    /// M_Ω of Conty Estevez & Kulla 2018, Eq. 2, for θ_e = π/2.
    fn orientation(&self, off: f64) -> f64 {
        let o = self.theta_o(off);
        let w = (o + FRAC_PI_2).min(PI);
        let rest = 2.0 * w * o.sin() - (o - 2.0 * w).cos() - 2.0 * o * o.sin() + o.cos();
        2.0 * PI * (1.0 - o.cos()) + FRAC_PI_2 * rest
    }

    /// A term of the numerator: n·a of Eq. 2, or Φ·a·M_Ω of Eq. 3, where 1/1024 of the share of lights counts as flux. The cone's
    /// cosine is `off` by that much of it.
    pub fn cost(&self, heuristic: Heuristic, node: &Self, off: f64) -> f64 {
        let count = self.count / node.count;
        let phi = if node.phi > 0.0 { self.phi / node.phi } else { 0.0 };
        match heuristic {
            Heuristic::Sah => count * self.area(node),
            _ => (phi + count / 1024.0) * self.area(node) * self.orientation(off),
        }
    }

    /// k_r of Eq. 3: the longest side over that along `axis`, a millionth of the longest at least; 1 in Eq. 2.
    pub fn regularization(&self, heuristic: Heuristic, axis: usize) -> f64 {
        match heuristic {
            Heuristic::Sah => 1.0,
            _ => self.longest() / self.sides[axis].max(1e-6 * self.longest()),
        }
    }
}

/// The bin, of `bins` equal ones from `low` to `high`, of a centre at `x`.
fn bin(x: f64, low: f64, high: f64, bins: usize) -> usize {
    // The last centre belongs to the last bin.
    (((x - low) / (high - low) * bins as f64 * (1.0 - 1e-6)) as usize).min(bins - 1)
}

/// Least cost of all planes between bins, on all axes, for which `allowed` holds of who is left of it.
pub fn least_cost(
    lights: &[Light],
    heuristic: Heuristic,
    bins: usize,
    allowed: impl Fn(&[bool]) -> bool,
) -> Option<f64> {
    let node = Exact::of(lights.iter());
    let mut least = None;
    for axis in 0..3 {
        let center = |l: &Light| (l.min[axis] + l.max[axis]) / 2.0;
        let low = lights.iter().map(center).fold(f64::INFINITY, f64::min);
        let high = lights.iter().map(center).fold(f64::NEG_INFINITY, f64::max);
        if high <= low {
            continue;
        }
        for plane in 1..bins {
            let left: Vec<bool> = lights
                .iter()
                .map(|l| bin(center(l), low, high, bins) < plane)
                .collect();
            let one_sided = left.iter().all(|&l| l == left[0]);
            if one_sided || !allowed(&left) {
                continue;
            }
            let side = |wanted: bool| {
                let part = lights.iter().zip(&left).filter(move |(_, l)| **l == wanted);
                Exact::of(part.map(|(light, _)| light)).cost(heuristic, &node, 0.0)
            };
            let cost = (side(true) + side(false)) * node.regularization(heuristic, axis);
            least = Some(least.map_or(cost, |least: f64| least.min(cost)));
        }
    }
    least
}
