//! How much a set of lights may matter to a point: what children are chosen by.
//!
//! A weight need not be accurate. It is positive wherever there is flux, so that no light is ever lost, and it has the same
//! bits on both processors. What is approximate about it costs variance.

mod eq4;
mod flux;
mod glossy;
mod leveled;
mod linked;
mod moments;
pub(crate) mod sight;
mod subtended;
#[cfg(test)]
mod tests;
mod transmissive;

pub use eq4::Eq4;
pub use flux::{Flux, FluxOverDistance};
pub use glossy::Glossy;
pub use leveled::Leveled;
pub use linked::Linked;
pub use moments::Moments;
pub use subtended::Subtended;
pub use transmissive::Transmissive;

pub use crate::beam::Space;
use crate::exact;
#[doc(hidden)]
pub use crate::node::Cluster;
use crate::point::ShadingPoint;
#[doc(inline)]
pub use crate::point::{Cell, GlossyPoint, LinkedPoint, RaySegment, Receiver, TransmissivePoint};

/// A measure of what the lights below each child of a node may contribute at a point. A type chooses it, so that kernels
/// contain one only.
///
/// `P`: the receiver type.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not weigh the children of `{N}`, of width {W}, for a `{P}`",
    note = "`MaskedLights` takes a `LinkedPoint`, `LightBvh` and `AnyLights` take a `ShadingPoint` or a `Cell`",
    note = "models for a `GlossyPoint`, a `TransmissivePoint` and a `RaySegment`: `(MomentNode<8>, Glossy<Moments>)`, \
            `(MomentNode<8>, Transmissive<Moments>)`, `(MomentNode<8>, Subtended)`"
)]
pub trait ImportanceModel<N, const W: usize, P = ShadingPoint> {
    /// Share of samples that choose among all lights alike, as the number of times that 1 is halved: 5 for 1/32. 0 is for none
    /// and costs nothing. See [`Defensive`].
    const UNIFORM_HALVINGS: u32 = 0;
    /// Whether lights with flux may have weight zero: such an importance takes no share of uniform choice.
    #[doc(hidden)]
    const IS_PARTIAL: bool = false;

    /// The weights of the children of `node` at `point`, a point in the node's space: each zero where the child has no flux,
    /// else positive and at most 2^120. Malformed nodes may give any value.
    ///
    /// `space` is that space, for the beams of a [`SpotMomentNode`](crate::node::SpotMomentNode). An importance made of others passes it on.
    fn weights_in(node: &N, point: &P, space: Space) -> [f32; W];

    /// [`weights_in`](Self::weights_in) the world.
    #[inline(always)]
    fn weights(node: &N, point: &P) -> [f32; W] {
        Self::weights_in(node, point, Space::WORLD)
    }
}

/// The importance `I` with a share of 2^-`HALVINGS` of samples that choose among all lights alike (a defensive mixture:
/// Hesterberg 1995). A light that `I` underrates then keeps that share of its uniform probability, and its contribution to the
/// variance stays bounded. `HALVINGS` is from 1 to 20; the kernels take 6
/// (`docs/walk.md` says what that costs).
#[derive(Clone, Copy, Debug)]
pub struct Defensive<I, const HALVINGS: u32>(core::marker::PhantomData<I>);

/// The importance of `LightBvh`: moments, and a share of 1/64 of uniform choice.
pub type DefaultImportance = Defensive<Moments, 6>;

impl<N, I: ImportanceModel<N, W, P>, P, const HALVINGS: u32, const W: usize> ImportanceModel<N, W, P>
    for Defensive<I, HALVINGS>
{
    const UNIFORM_HALVINGS: u32 = {
        assert!(
            1 <= HALVINGS && HALVINGS <= 20,
            "a share of uniform choice from 1/2 to 2^-20"
        );
        assert!(
            !I::IS_PARTIAL,
            "uniform choice goes to lights that this importance leaves out; `Leveled` takes its place"
        );
        HALVINGS
    };

    #[inline(always)]
    fn weights_in(node: &N, point: &P, space: Space) -> [f32; W] {
        I::weights_in(node, point, space)
    }
}

/// A weight `significand · 2^exponent`. The exponent is kept apart because Φ/d² of the accepted domain spans 2^±300.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scaled {
    /// Zero without any flux, else in `[2^-24, 8)`.
    pub significand: f32,
    /// Exponent of two; −1024 without any flux.
    pub exponent: i32,
}

impl Scaled {
    /// Of a child without flux.
    pub const ZERO: Self = Self {
        significand: 0.0,
        exponent: -1024,
    };

    /// `value` · 2^(exponent of `phi` + `exponent`), for a child of flux `phi`, W.
    #[inline(always)]
    pub(crate) fn of(phi: f32, value: f32, exponent: i32) -> Self {
        // The comparison also turns NaN of malformed nodes into zero.
        let shines = (phi > 0.0) & (value > 0.0);
        Self {
            significand: if shines { value } else { 0.0 },
            exponent: if shines {
                exact::exponent(phi) + exponent
            } else {
                -1024
            },
        }
    }
}

/// Brings the weights of a node's children to one scale: that of the greatest exponent. A weight below 2^-60 of the scale
/// counts as that much, so a positive weight stays positive.
#[doc(hidden)]
#[inline(always)]
#[must_use]
pub fn on_one_scale<const W: usize>(scaled: &[Scaled; W]) -> [f32; W] {
    let mut greatest = -1024;
    for slot in 0..W {
        let e = scaled[slot].exponent;
        greatest = if e > greatest { e } else { greatest };
    }
    let mut weights = [0.0; W];
    for slot in 0..W {
        let below = scaled[slot].exponent - greatest;
        let bounded = if below < -60 { -60 } else { below };
        weights[slot] = scaled[slot].significand * exact::pow2(bounded);
    }
    weights
}
