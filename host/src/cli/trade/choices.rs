//! The configurations that are measured: by importance, builder, levels, update, candidates and arithmetic, one
//! axis at a time from the default.

use lightbvh::importance::{DefaultImportance, NativeMath};
use lightbvh::{Defensive, Eq4, Flux, FluxOverDistance, Moments};
use lightbvh_peers::{Falcor, Pbrt};

use super::built::With;
use super::subject::{Axis, Subject};
use super::update::{Frame, Update};
use crate::backend::Sampler;
use crate::error::HostError;
use crate::method::Builder;

/// All configurations over the lights of the `first` frame of the animation that `is_wanted`, the default first.
pub(super) fn all(
    first: &Frame<'_>,
    is_wanted: impl Fn(Axis) -> bool,
) -> Result<Vec<Box<dyn Subject>>, HostError> {
    use Axis as A;
    type D = DefaultImportance;
    let with = |axis| With {
        first,
        axis,
        levels: Sampler::TwoLevel,
        builder: Builder::Ward,
        update: Update::usual(Sampler::TwoLevel),
        candidates: 1,
    };
    let levels = |axis, levels| With {
        levels,
        update: Update::usual(levels),
        ..with(axis)
    };
    let update = |levels_of, update| With {
        update,
        ..levels(A::Update, levels_of)
    };
    let builder = |axis, builder| With {
        builder,
        ..with(axis)
    };
    let (one, two, saoh) = (Sampler::SingleLevel, Sampler::TwoLevel, Builder::Saoh);
    let paper = || builder(A::Importance, saoh);
    let mut subjects: Vec<Box<dyn Subject>> = vec![with(A::Default).of::<D>(DEFAULT)?];
    if is_wanted(A::Importance) {
        subjects.extend([
            with(A::Importance).of::<Moments>("moments")?,
            paper().of_paper::<Eq4>("eq4")?,
            paper().of_paper::<FluxOverDistance>("flux/d²")?,
            with(A::Importance).of::<FluxOverDistance>("flux/d²")?,
            with(A::Importance).of::<Flux>("flux")?,
            paper().of_paper::<Pbrt>("pbrt")?,
            paper().of_paper::<Falcor>("falcor")?,
        ]);
    }
    if is_wanted(A::Builder) {
        subjects.push(builder(A::Builder, saoh).of::<D>(DEFAULT)?);
    }
    if is_wanted(A::Levels) {
        let of_paper = With {
            builder: saoh,
            ..levels(A::Levels, one)
        };
        subjects.extend([
            levels(A::Levels, one).of::<D>(DEFAULT)?,
            of_paper.of_paper::<Eq4>("eq4")?,
        ]);
    }
    if is_wanted(A::Update) {
        for (of, own) in [
            (two, Update::Refit),
            (two, Update::Rebuild),
            (two, Update::EveryEighth),
            (one, Update::Rebuild),
            (one, Update::EveryEighth),
        ] {
            subjects.push(update(of, own).of::<D>(DEFAULT)?);
        }
    }
    if is_wanted(A::Candidates) {
        for candidates in [2, 4, 8, 16] {
            let own = With {
                candidates,
                ..with(A::Candidates)
            };
            subjects.push(own.of::<D>(DEFAULT)?);
        }
    }
    if is_wanted(A::Arithmetic) {
        type Native = Defensive<Moments<NativeMath>, 6>;
        subjects.push(with(A::Arithmetic).of::<Native>("moments+1/64, native")?);
    }
    Ok(subjects)
}

/// The name of [`DefaultImportance`].
const DEFAULT: &str = "moments+1/64";
