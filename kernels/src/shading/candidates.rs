//! One light out of several candidates, in proportion to what each would contribute if nothing were between: resampled importance
//! sampling (J. Talbot, D. Cline, P. Egbert, "Importance Resampling for Global Illumination", 2005; ReSTIR Algorithm 3).

use lightbvh::exact::hash;
use lightbvh::reservoir::{LightSample, Resampling, Reservoir};

use super::emitters::Emitters;
use super::material::Material;
use super::pick::PickLight;
use super::picks::Picks;
use super::restir::surface::Surface;
use super::restir::target::lit;

/// The candidates of a pixel that one of its samples is chosen from: `count` from `first` on. They follow each other in the order of
/// lights, so a sample's ray goes where its part of the lights is, and together the rays go everywhere.
#[derive(Clone, Copy, Debug)]
pub struct Candidates {
    /// The first.
    pub first: u32,
    /// How many.
    pub count: u32,
}

/// One of the candidates of `picker` for `surface`. `picks` are all of the pixel, `seed` draws the one among these.
///
/// Each candidate's own distribution is that of a single pick, and the expectation of a sum does not ask how its terms depend on
/// each other, so the weight is that of independent candidates.
#[inline]
#[must_use]
pub fn resampled<P: PickLight>(
    materials: &[Material],
    emitters: &Emitters<'_>,
    picker: &P,
    surface: &Surface,
    picks: &mut Picks,
    which: Candidates,
    seed: u32,
) -> Reservoir {
    let mut stream = Resampling::EMPTY;
    for candidate in 0..which.count {
        let k = which.first.wrapping_add(candidate);
        let picked = picks.next(picker, &surface.point, k);
        let sample = LightSample {
            light: picked.light,
            instance: picked.instance,
            uv: picks.uv(k),
        };
        let arriving = lit(materials, emitters, surface, &sample);
        let random = hash(seed.wrapping_add(candidate));
        stream.candidate(sample, arriving.target, picked.pmf, random);
    }
    stream.finish_equal()
}
