//! The cost of a group of lights: surface area, flux and orientation.

use core::f32::consts::{FRAC_PI_2, PI};

use super::primitive::Group;
use crate::exact::{max, min, rsqrt_rough};

/// How a tree is built: what a split is judged by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Heuristic {
    /// Surface area heuristic, paper Eq. 2: Σ n·a.
    Sah,
    /// Surface area orientation heuristic, paper Eq. 3: k_r · Σ Φ·a·M_Ω.
    Saoh,
    /// Ward's criterion: Σ Φ · variance of position (Ward 1963), wide nodes from the start.
    Ward,
}

/// Scales that make the costs within one node comparable and free of units: everything lies in about 0..1, so no scale
/// of scene or flux overflows, and scaling by powers of two changes no bit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scales {
    per_extent: f32,
    per_phi: f32,
    per_count: f32,
}

/// Share of a group's extent sum that is added to its area, so that lights on a line or a point are still told apart
/// (peers' costs all become zero there), and share of its count that is added to its flux, for lights without any.
const DEGENERATE: f32 = 1.0 / 1024.0;

impl Scales {
    pub fn of(node: &Group) -> Self {
        let extent = max(
            node.high[0] - node.low[0],
            max(node.high[1] - node.low[1], node.high[2] - node.low[2]),
        );
        Self {
            per_extent: if extent > 0.0 { 1.0 / extent } else { 0.0 },
            per_phi: if node.phi > 0.0 { 1.0 / node.phi } else { 0.0 },
            per_count: 1.0 / node.count as f32,
        }
    }

    /// Cost of making `group` a child, up to a factor common to all splits of the node.
    #[inline]
    pub fn cost(&self, heuristic: Heuristic, group: &Group) -> f32 {
        let count = group.count as f32 * self.per_count;
        match heuristic {
            Heuristic::Sah => count * self.area(group),
            // The wide builder never asks.
            Heuristic::Saoh | Heuristic::Ward => {
                let flux = group.phi * self.per_phi + DEGENERATE * count;
                flux * self.area(group) * orientation_measure(cos_theta_o(group))
            }
        }
    }

    /// k_r of Eq. 3: penalises a split across a thin side of the node. 0 along an axis without extent.
    #[inline]
    pub fn regularization(&self, heuristic: Heuristic, node: &Group, axis: usize) -> f32 {
        let extent = (node.high[axis] - node.low[axis]) * self.per_extent;
        match heuristic {
            Heuristic::Sah => 1.0,
            Heuristic::Saoh | Heuristic::Ward => 1.0 / max(extent, 1e-6),
        }
    }

    #[inline]
    fn area(&self, group: &Group) -> f32 {
        let x = (group.high[0] - group.low[0]) * self.per_extent;
        let y = (group.high[1] - group.low[1]) * self.per_extent;
        let z = (group.high[2] - group.low[2]) * self.per_extent;
        (x * y + y * z + z * x) + DEGENERATE * (x + y + z)
    }
}

/// cos θ_o of a cone around the group's normals, from the box that holds them.
///
/// A unit vector x within ρ of the box's centre m has x·m ≥ (1 + |m|² − ρ²)/2, so the cone around m with
/// cos θ_o = (1 + |m|² − ρ²)/(2|m|) holds them all.
#[inline]
fn cos_theta_o(group: &Group) -> f32 {
    let (mut m_squared, mut rho_squared) = (0.0, 0.0);
    for k in 4..7 {
        let m = 0.5 * (group.low[k] + group.high[k]);
        let r = 0.5 * (group.high[k] - group.low[k]);
        m_squared += m * m;
        rho_squared += r * r;
    }
    if m_squared < 1e-6 {
        return -1.0;
    }
    let cos = 0.5 * (1.0 + m_squared - rho_squared) * rsqrt_rough(m_squared);
    max(min(cos, 1.0), -1.0)
}

/// M_Ω for diffuse emitters (θ_e = π/2): Conty Estevez & Kulla 2018, Eq. 2, with θ_w = min(θ_o + π/2, π) put in.
///
/// For θ_o ≤ π/2 it becomes π(2 − cos θ_o) + π²/2 · sin θ_o, beyond that 2π(1 − cos θ_o) + π(π − θ_o) sin θ_o.
#[inline]
fn orientation_measure(cos: f32) -> f32 {
    let sin_squared = max(1.0 - cos * cos, 1e-12);
    let sin = sin_squared * rsqrt_rough(sin_squared);
    if cos >= 0.0 {
        PI * (2.0 - cos) + (PI * FRAC_PI_2) * sin
    } else {
        2.0 * PI * (1.0 - cos) + PI * arc_cosine(-cos) * sin
    }
}

/// acos on 0..=1 within 7e-5 (Abramowitz & Stegun 1964, 4.4.45).
#[inline]
fn arc_cosine(x: f32) -> f32 {
    let y = max(1.0 - x, 1e-12);
    let series = 1.570_728_8 + x * (-0.212_114_4 + x * (0.074_261 + x * -0.018_729_3));
    y * rsqrt_rough(y) * series
}
