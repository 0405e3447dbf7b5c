//! Tokuyoshi's importance: lights as spherical Gaussians.

mod curves;

pub(super) use curves::{clamped_cosine, exp_minus, less_exp_over};

use glam::Vec3;

use super::sight::{FLOOR, in_volume};
use super::{ImportanceModel, Scaled, on_one_scale};
use crate::exact::{self, exponent, pow2, recip, rsqrt, significand};
use crate::moments::LightMoments;
use crate::node::MomentLayout;
use crate::point::ShadingPoint;
use crate::vector::{dot, greatest_exponent, length_squared};

/// The importance for diffuse receivers of Tokuyoshi, Ikeda, Kulkarni & Harada, Hierarchical Light Sampling with Accurate Spherical
/// Gaussian Lighting (SIGGRAPH Asia 2024), section 4, as the author's shaders have it (`VSGL/Shaders/LightingPS.hlsl`,
/// `SphericalGaussian.hlsli` and `VSGLGenerationCS.hlsli` of yusuketokuyoshi/VSGL). On the layouts that hold moments.
///
/// Φ / (σ² · (1 − e^−2κ) / 2κ) · e^(Λ − κ − λ) · C(c, Λ), where
/// - the lights lie about their centre as a Gaussian of the variance σ², half of the total one as of lights in a plane, at least
///   2^-31 d²; so from the point they are a spherical Gaussian of sharpness λ = d²/σ² about the centre's direction l;
/// - they shine as one of sharpness κ about their mean direction, whose length is 2/3 |m| for diffuse emitters of mean normal m:
///   κ = ℓ (3 − ℓ²) / (1 − ℓ²), ℓ = 2/3 |m| (Banerjee et al. 2005);
/// - the product of both is one of sharpness Λ = |λ l − κ m/|m||, and c the cosine between its axis and the receiver's normal;
/// - C is the integral of a spherical Gaussian times the receiver's clamped cosine, over π, by the supplement's listings 5 to 7.
///
/// The exponential function is 2^−f by a polynomial of degree 5 and a power of two, within 1e-5; erfc is
/// 1 / (a polynomial of degree 6)^16 (Abramowitz & Stegun 7.1.28), within 1e-5 absolute; so the whole product is within 1 % where the
/// floor does not count.
///
/// Departures: in a volume the receiver's integral is that over the whole sphere; and the weight is at least 2^-8 of Φ/(d² + σ²). Below
/// the horizon the published integral falls as e^−Λ, which is zero in `f32` from Λ = 104 on, though a light that is far from the mean may
/// stand above it.
#[derive(Clone, Copy, Debug)]
pub struct SphericalGaussian;

impl<N: MomentLayout<W>, const W: usize> ImportanceModel<N, W> for SphericalGaussian {
    const UNIFORM_HALVINGS: u32 = 0;

    #[inline(always)]
    fn weights(node: &N, point: &ShadingPoint) -> [f32; W] {
        let mut scaled = [Scaled {
            significand: 0.0,
            exponent: -1024,
        }; W];
        for slot in 0..W {
            scaled[slot] = weight(&node.summary(slot), point);
        }
        on_one_scale(&scaled)
    }
}

/// σ² is at least this share of d²: `VARIANCE_THRESHOLD`.
const LEAST_VARIANCE: f32 = pow2(-31);
/// Squared distances, in units of the scale, are at least this: it absorbs whatever devices flush.
const LEAST_DISTANCE: f32 = pow2(-50);
/// Least squared sharpness of a product.
const LEAST_SHARPNESS: f32 = pow2(-40);
/// ℓ² / |m|², the mean direction of a diffuse emitter being 2/3 of its normal.
const LENGTH_SQUARED: f32 = 0.444_444_45;
/// ℓ / |m|.
const LENGTH: f32 = 0.666_666_7;

/// The weight, exponents apart; lengths are about 1 by a power of two.
#[inline(always)]
fn weight(lights: &LightMoments, point: &ShadingPoint) -> Scaled {
    let away = lights.c - point.position();
    let scale = greatest_exponent(away, exponent(exact::max(lights.across, lights.along)));
    let to_one = pow2(-scale);
    let x = away * to_one;
    let (across, along) = (lights.across * to_one, lights.along * to_one);
    let d_squared = length_squared(x) + LEAST_DISTANCE;
    let half = across * across + 0.5 * (along * along);
    let variance = exact::max(half, d_squared * LEAST_VARIANCE);
    let seen = seen(lights.m, x, d_squared, variance);
    let received = if in_volume(point.normal()) {
        4.0 * less_exp_over(2.0 * seen.sharpness)
    } else {
        let cosine = exact::clamp(dot(point.normal(), seen.axis), -1.0, 1.0);
        clamped_cosine(cosine, seen.sharpness)
    };
    // The square of what they are apart: with it for σ², a product without any cosine is about 1.
    let squared = d_squared + variance;
    let factor = 0.25 * (squared * recip(variance)) * (seen.amplitude * received);
    let value = significand(lights.phi) * recip(squared) * exact::max(factor, FLOOR);
    // The comparison also turns the NaN of hostile words into "no importance".
    let shines = (lights.phi > 0.0) & (value > 0.0);
    Scaled {
        significand: if shines { value } else { 0.0 },
        exponent: if shines {
            exponent(lights.phi) - scale - scale
        } else {
            -1024
        },
    }
}

/// The product of where the lights are, as seen from the point, and where they shine.
#[derive(Clone, Copy, Debug)]
struct Product {
    axis: Vec3,
    /// Λ.
    sharpness: f32,
    /// Its greatest value e^(Λ − κ − λ), over (1 − e^−2κ) / 2κ.
    amplitude: f32,
}

#[inline(always)]
fn seen(m: Vec3, x: Vec3, d_squared: f32, variance: f32) -> Product {
    let length_squared_m = exact::min(length_squared(m), 1.0);
    let l_squared = LENGTH_SQUARED * length_squared_m;
    // κ / ℓ, and the lobe's axis, towards the emitters, times κ.
    let per_length = (3.0 - l_squared) * recip(1.0 - l_squared);
    let lobe = m * -(LENGTH * per_length);
    let kappa = exact::sqrt(length_squared(lobe));
    let direction = x * rsqrt(d_squared);
    let lambda = d_squared * recip(variance);
    let product = lobe + direction * lambda;
    let inverse = rsqrt(exact::max(length_squared(product), LEAST_SHARPNESS));
    let sharpness = exact::max(length_squared(product), LEAST_SHARPNESS) * inverse;
    // Λ − κ − λ without its cancellation.
    let apart = exact::max(kappa - dot(lobe, direction), 0.0);
    let below = 2.0 * (lambda * apart) * recip(sharpness + kappa + lambda);
    Product {
        axis: product * inverse,
        sharpness,
        amplitude: exp_minus(below) * recip(less_exp_over(2.0 * kappa)),
    }
}
