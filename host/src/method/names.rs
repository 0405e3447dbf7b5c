//! The methods by name: the one table that every command reads.

use lightbvh::{BuildParams, Heuristic};
use lightbvh_kernels::bvh::{Compiled, Paper, Triangles};
use serde::Serialize;
use strum::{IntoStaticStr, VariantArray};

use super::SampleBudget;
use crate::backend::{Integrator, Sampler};

/// Candidates of a resampled method.
const DEFAULT_CANDIDATES: u32 = 8;

/// A method of the paper's comparison, or a baseline.
#[derive(
    Clone,
    Copy,
    Debug,
    PartialEq,
    Eq,
    Hash,
    PartialOrd,
    Ord,
    clap::ValueEnum,
    Serialize,
    IntoStaticStr,
    VariantArray,
)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Method {
    /// Every light alike.
    Uniform,
    /// In proportion to flux.
    Power,
    /// One tree over all triangles by the paper's importance, built at the first frame and refitted ever after.
    SingleLevelRefit,
    /// The same, built anew every frame.
    SingleLevelRebuilt,
    /// One tree over all triangles by the default importance, built anew every frame.
    SingleLevelMomentsRebuilt,
    /// The paper's two levels and importance, split by the surface area heuristic.
    TwoLevelSah,
    /// The paper's two levels and importance, split by the surface area orientation heuristic.
    TwoLevelSaoh,
    /// Two levels by the default importance, built by the default criterion.
    #[value(alias = "two-level")]
    TwoLevelMoments,
    /// The same, with each sample one of several candidates, by what they would contribute.
    TwoLevelMomentsResampled,
}

/// The importance of a light BVH: a [`Compiled`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Importance {
    /// The default: moments of the lights, 8 children to a node.
    Moments,
    /// The paper's Eq. 4 on bounds, 4 children to a node.
    Eq4,
}

/// How light BVHs are built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Builder {
    /// The surface area heuristic.
    Sah,
    /// The surface area orientation heuristic.
    Saoh,
    /// Ward's criterion.
    Ward,
}

/// The parts of a method.
#[derive(Clone, Copy, Debug)]
pub struct Recipe {
    /// The method's name, for messages.
    pub name: &'static str,
    /// How lights are chosen.
    pub lights: Sampler,
    /// The importance of a light BVH.
    pub importance: Importance,
    /// How the light BVH is built.
    pub builder: Builder,
    /// Whether a single level is built anew by every frame, which waits for it.
    pub rebuilt: bool,
    /// Candidates that each sample of direct light is one of; 1 for lights as picked.
    pub candidates: u32,
    /// The light that is followed.
    pub integrator: Integrator,
    /// The unit of an image's samples.
    pub budget: SampleBudget,
}

impl Method {
    /// All methods, in the order of tables.
    pub const ALL: &[Self] = Self::VARIANTS;

    /// As on the command line.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The method where samples count shadow rays.
    pub fn recipe(self) -> Recipe {
        use Importance::{Eq4, Moments};
        use Sampler::{Power, SingleLevel, TwoLevel, Uniform};
        let by = |lights, importance: Importance| Recipe {
            name: self.name(),
            lights,
            importance,
            builder: importance.builder(),
            rebuilt: false,
            candidates: 1,
            integrator: Integrator::Direct,
            budget: SampleBudget::ShadowRays,
        };
        let rebuilt = |importance| Recipe {
            rebuilt: true,
            ..by(SingleLevel, importance)
        };
        match self {
            Self::Uniform => by(Uniform, Moments),
            Self::Power => by(Power, Moments),
            Self::SingleLevelRefit => by(SingleLevel, Eq4),
            Self::SingleLevelRebuilt => rebuilt(Eq4),
            Self::SingleLevelMomentsRebuilt => rebuilt(Moments),
            Self::TwoLevelSah => Recipe {
                builder: Builder::Sah,
                ..by(TwoLevel, Eq4)
            },
            Self::TwoLevelSaoh => by(TwoLevel, Eq4),
            Self::TwoLevelMoments => by(TwoLevel, Moments),
            Self::TwoLevelMomentsResampled => Recipe {
                candidates: DEFAULT_CANDIDATES,
                ..by(TwoLevel, Moments)
            },
        }
    }
}

impl Importance {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Moments, Self::Eq4];

    /// [`Compiled::NAME`].
    pub fn name(self) -> &'static str {
        match self {
            Self::Moments => Triangles::NAME,
            Self::Eq4 => Paper::NAME,
        }
    }

    /// How trees by this importance are built unless something else is asked for.
    pub fn builder(self) -> Builder {
        match self {
            Self::Moments => Builder::Ward,
            Self::Eq4 => Builder::Saoh,
        }
    }
}

impl Builder {
    /// As in reports.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Parameters of the build.
    pub fn params(self) -> BuildParams {
        match self {
            Self::Sah => BuildParams::paper(Heuristic::Sah),
            Self::Saoh => BuildParams::paper(Heuristic::Saoh),
            Self::Ward => BuildParams::BALANCED,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_the_command_line_and_of_results() {
        for &method in Method::ALL {
            let parsed = <Method as clap::ValueEnum>::from_str(method.name(), false);
            assert_eq!(parsed, Ok(method));
            assert_eq!(serde_json::to_value(method).expect("a name"), method.name());
        }
    }
}
