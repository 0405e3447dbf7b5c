//! The configurations that are measured: by importance, builder, levels, update and candidates, one
//! axis at a time from the default.

use lightbvh::importance::DefaultImportance;
use lightbvh::{Eq4, Flux, FluxOverDistance, Moments};
use lightbvh_peers::{Falcor, Pbrt};

use super::subject::{Axis, Config, Subject, Update};
use crate::backend::Sampler;
use crate::error::HostError;
use crate::method::{Builder, Step};

/// All configurations over the lights of the `first` frame of the animation that `is_wanted`, the default first.
pub(super) fn all(
    first: &Step<'_>,
    is_wanted: impl Fn(Axis) -> bool,
) -> Result<Vec<Box<dyn Subject>>, HostError> {
    use Axis as A;
    let (one, two) = (Sampler::SingleLevel, Sampler::TwoLevel);
    let default = |config: Config| config.of::<DefaultImportance>(config.importance, first);
    let levels = |axis, levels| Config {
        levels,
        update: Update::usual(levels),
        ..Config::new(axis)
    };
    let mut subjects = vec![default(Config::new(A::Default))?];
    if is_wanted(A::Importance) {
        let own = Config::new(A::Importance);
        subjects.extend([
            own.of::<Moments>("moments", first)?,
            own.of_paper::<Eq4>("eq4", first)?,
            own.of_paper::<FluxOverDistance>("flux/d²", first)?,
            own.of::<FluxOverDistance>("flux/d²", first)?,
            own.of::<Flux>("flux", first)?,
            own.of_paper::<Pbrt>("pbrt", first)?,
            own.of_paper::<Falcor>("falcor", first)?,
        ]);
    }
    if is_wanted(A::Builder) {
        let builder = Builder::Saoh;
        subjects.push(default(Config {
            builder,
            ..Config::new(A::Builder)
        })?);
    }
    if is_wanted(A::Levels) {
        subjects.push(default(levels(A::Levels, one))?);
        subjects.push(levels(A::Levels, one).of_paper::<Eq4>("eq4", first)?);
    }
    if is_wanted(A::Update) {
        for (of, update) in [
            (two, Update::Refit),
            (two, Update::Rebuild),
            (two, Update::EveryEighth),
            (one, Update::Rebuild),
            (one, Update::EveryEighth),
        ] {
            let own = levels(A::Update, of);
            subjects.push(default(Config { update, ..own })?);
        }
    }
    if is_wanted(A::Candidates) {
        for candidates in [2, 4, 8, 16] {
            let own = Config::new(A::Candidates);
            subjects.push(default(Config { candidates, ..own })?);
        }
    }
    Ok(subjects)
}
