//! Lights as moments: what the default importance knows of a set of lights.
//!
//! A child is chosen by a *mean* of what its lights send, not by a bound on it: total flux, flux-weighted centre, standard
//! deviations of position across and along the mean normal, and the mean normal itself, whose length says how the normals
//! spread. Merging them is exact up to rounding: they are sums. The box serves for one thing: how much of the set can lie above
//! the receiver's horizon.

mod merge;
#[cfg(test)]
mod tests;

use glam::Vec3;

use crate::bounds::LightBounds;
pub use crate::bounds::LightMoments;
use crate::cone::Cone;
use crate::exact::{self, pow2};
use crate::instance::Instance;
use crate::light::{Light, LightSlots};
use crate::summary::{Lanes, SUMMARY_WORDS, Summary};
use crate::vector::dot;

pub(crate) use merge::{Frame, Framed};

/// Rows of [`Lanes`] of moments, as [`LightMoments::to_words`] orders them.
pub(crate) mod row {
    pub const PHI: usize = 0;
    pub const C: usize = 1;
    pub const ACROSS: usize = 4;
    pub const ALONG: usize = 5;
    pub const M: usize = 6;
    pub const H: usize = 9;
}

/// Lengths that are computed count as zero below this, metres: 2^-120. A device would flush some of them.
pub(crate) const LEAST_LENGTH: f32 = pow2(-120);

impl Summary for LightMoments {
    const EMPTY: Self = Self::EMPTY;

    #[inline(always)]
    fn of_light<L: Light>(light: &L) -> Self {
        light.moments()
    }

    #[inline(always)]
    fn of_lights<L: Light, const W: usize>(lights: &L::Slots<W>, summaries: &mut Lanes<W>) {
        for slot in 0..W {
            let mut moments = lights.get(slot).moments();
            moments.phi = exact::masked(lights.present(slot), moments.phi);
            summaries.set(slot, &moments);
        }
    }

    #[inline(always)]
    fn merged<const W: usize>(children: &Lanes<W>) -> Self {
        merge::framed(children).merged()
    }

    #[inline(always)]
    fn to_world(&self, instance: &Instance) -> Self {
        instance.moments_to_world(self)
    }

    #[inline(always)]
    fn phi(&self) -> f32 {
        self.phi
    }

    #[inline(always)]
    fn center(&self) -> Vec3 {
        self.c
    }

    /// Zero for lights nearer together than 2^-60 m.
    #[inline(always)]
    fn spread(&self) -> f32 {
        let (across, along) = (
            exact::flush(self.across, pow2(-60)),
            exact::flush(self.along, pow2(-60)),
        );
        2.0 * (across * across) + along * along
    }

    /// The box, and the cone of one direction where all normals are alike; else all directions.
    fn bounds(&self) -> LightBounds {
        let length_squared = dot(self.m, self.m);
        let alike = length_squared > 0.999;
        LightBounds {
            min: self.c - self.h,
            max: self.c + self.h,
            axis: if alike { self.m } else { Cone::SPHERE.axis },
            cos_theta_o: if alike { 1.0 } else { -1.0 },
            phi: self.phi,
        }
    }

    #[inline(always)]
    fn to_words(&self) -> [f32; SUMMARY_WORDS] {
        let (c, m, h) = (self.c, self.m, self.h);
        [
            self.phi,
            c.x,
            c.y,
            c.z,
            self.across,
            self.along,
            m.x,
            m.y,
            m.z,
            h.x,
            h.y,
            h.z,
        ]
    }

    #[inline(always)]
    fn from_words(words: &[f32; SUMMARY_WORDS]) -> Self {
        Self {
            phi: words[0],
            c: Vec3::new(words[1], words[2], words[3]),
            across: words[4],
            along: words[5],
            m: Vec3::new(words[6], words[7], words[8]),
            h: Vec3::new(words[9], words[10], words[11]),
        }
    }
}
