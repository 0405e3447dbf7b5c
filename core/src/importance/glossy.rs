//! Any importance times what a glossy receiver reflects.

use core::marker::PhantomData;

use glam::Vec3;

use super::sight::{MIN_DISTANCE_SQUARED, offset};
use super::{ImportanceModel, Space};
use crate::exact::{self, pow2, recip, rsqrt};
use crate::node::Node;
use crate::point::GlossyPoint;
use crate::summary::Summary;
use crate::vector::{length_squared, vector};

/// The importance `I`, which knows the receiver's cosine, times the reflectance of a [`GlossyPoint`] towards a child, as a mean over where
/// its lights are. On any layout.
///
/// ρ + s · (k + 6)/8 · q / (1 + κ u²), where
/// - ρ is the diffuse albedo, s the part of the lobe, k its exponent: the reflectance ρ/π + s (k + 6)/8π · (n·h)^k, times π;
/// - κ = k/4: about the mirror direction r the lobe is e^(−κ (1 − l·r)), l the direction of the child's centre;
/// - u² is half the variance of the lights' positions over d²: a Gaussian so wide, seen through the lobe, widens it to
///   κ' = κ / (1 + κ u²), and lowers it as much;
/// - q = 1 / (1 + z/4)^4 with z = κ' (1 − l·r), in place of e^−z. At most 2.2 e^−z for z ≤ 3; decays slowly, so the weight stays away from zero.
///
/// The factor is at least 2^-20, so that no light is lost. `Defensive<Glossy<Moments>, 6>` adds a share of uniform choice.
#[derive(Clone, Copy, Debug)]
pub struct Glossy<I>(PhantomData<I>);

impl<N: Node<W>, I: ImportanceModel<N, W>, const W: usize> ImportanceModel<N, W, GlossyPoint> for Glossy<I> {
    const UNIFORM_HALVINGS: u32 = I::UNIFORM_HALVINGS;
    const IS_PARTIAL: bool = I::IS_PARTIAL;

    #[inline(always)]
    fn weights_in(node: &N, receiver: &GlossyPoint, space: Space) -> [f32; W] {
        let mut weights = I::weights_in(node, &receiver.point, space);
        for slot in 0..W {
            let summary = node.summary(slot);
            let reflected = reflectance(summary.center(), summary.spread(), receiver);
            // A child without flux has no centre.
            weights[slot] = if weights[slot] > 0.0 {
                exact::clamp(weights[slot] * reflected, pow2(-MOST), pow2(MOST))
            } else {
                0.0
            };
        }
        weights
    }
}

/// Weights are within 2^-120 to 2^120: all that an importance may give, times a lobe, is in a wider range.
const MOST: i32 = 120;
/// Least factor.
const LEAST: f32 = pow2(-20);
/// Squared distances count as at least this share of the variance.
const NEAREST: f32 = pow2(-20);

/// The reflectance times π towards lights about `center` of the variance `spread`.
#[inline(always)]
fn reflectance(center: Vec3, spread: f32, receiver: &GlossyPoint) -> f32 {
    let away = offset(center, &receiver.point);
    let d_squared = exact::max(length_squared(away), MIN_DISTANCE_SQUARED);
    let kappa = 0.25 * receiver.exponent;
    let widened = 1.0 + kappa * (0.5 * spread * recip(exact::max(d_squared, spread * NEAREST)));
    let narrower = recip(widened);
    let mirror = vector(&receiver.mirror);
    // Half the squared chord: an error in the length of the direction counts squared only.
    let apart = 0.5 * length_squared(away * rsqrt(d_squared) - mirror);
    let rise = 1.0 + 0.25 * (kappa * narrower * apart);
    let tail = recip((rise * rise) * (rise * rise));
    let lobe = receiver.specular * (0.5 * kappa + 0.75) * (narrower * tail);
    exact::max(receiver.diffuse + lobe, LEAST)
}
