//! The two ways to count the reservoirs that a sample was chosen among.

use lightbvh::EmissiveTriangle;
use lightbvh::reservoir::{LightSample, Resampling, Reservoir};

use super::super::emitter::Emitter;
use super::super::emitters::Emitters;
use super::super::material::Material;
use super::super::trace::Surfaces;
use super::surface::Surface;
use super::target::{lit, visible};

/// What a receiver has to say about a sample.
#[derive(Clone, Copy, Debug)]
pub struct Answer {
    /// Its target, or zero.
    pub target: f32,
    /// Shadow rays that it took to know.
    pub shadow_rays: u32,
}

/// How reservoirs of several receivers are counted, and the frame that the other receivers are asked in.
#[derive(Clone, Copy)]
pub struct Combine<'a, L: Emitter = EmissiveTriangle> {
    /// Whether the expectation is kept, for which the other receivers are asked: Algorithm 6 with the weights of ReSTIR section 4.3,
    /// a shadow ray for each. Otherwise Algorithm 4, 1 / M: **biased**, darker where receivers do not see the same lights; no ray.
    pub is_unbiased: bool,
    /// What shadow rays met in the receivers' frame.
    pub surfaces: Surfaces<'a, L::Skin<'a>>,
    /// The lights of the receivers' frame.
    pub emitters: Emitters<'a, L>,
}

impl<L: Emitter> Combine<'_, L> {
    /// The target of `sample` at another receiver: zero where that receiver could not have produced it. `known_visible`
    /// spares the ray.
    #[inline]
    pub fn ask(
        &self,
        materials: &[Material],
        receiver: &Surface,
        sample: &LightSample,
        known_visible: bool,
    ) -> Answer {
        let arriving = lit(materials, &self.emitters, receiver, sample);
        let mut answer = Answer {
            target: arriving.target,
            shadow_rays: 0,
        };
        if arriving.target > 0.0 && !known_visible {
            answer.shadow_rays = 1;
            if !visible(&self.surfaces, receiver, arriving.end, sample.light) {
                answer.target = 0.0;
            }
        }
        answer
    }

    /// The reservoir that is left of `stream`.
    #[inline]
    pub fn finish(&self, stream: &Resampling, balance: &Balance) -> Reservoir {
        if self.is_unbiased {
            stream.finish_balanced(balance.own, balance.sum)
        } else {
            stream.finish_equal()
        }
    }
}

/// Targets of the chosen sample at the receivers that were merged.
#[derive(Clone, Copy, Debug)]
pub struct Balance {
    /// That of the receiver which the sample came from.
    pub own: f32,
    /// The sum over all receivers of M times target.
    pub sum: f32,
}

impl Balance {
    /// Before the first receiver.
    pub const ZERO: Self = Self { own: 0.0, sum: 0.0 };

    /// Adds receiver `source`, whose reservoir stands for `count` samples (at most 2^16) and whose target at the chosen
    /// sample is `target`.
    #[inline]
    pub fn add(&mut self, stream: &Resampling, source: u32, count: u32, target: f32) {
        self.sum += target * (count as i32 as f32);
        self.own = if stream.source == source { target } else { self.own };
    }
}
