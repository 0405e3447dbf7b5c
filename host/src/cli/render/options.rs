//! Values of `lightbvh render`'s options.

use std::path::{Path, PathBuf};

use crate::backend::{CandidateSource, Combination, RestirOptions, Sampler};

use super::images::{Integrator, Method};
use crate::error::HostError;

/// An integrator on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum IntegratorName {
    /// Light reflected once.
    Direct,
    /// Light along whole paths.
    Path,
}

/// A sampler on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum SamplerName {
    /// Every light alike.
    Uniform,
    /// In proportion to flux.
    Power,
    /// A light BVH over all triangles, refitted from frame to frame.
    SingleLevel,
    /// A light BVH over all triangles, built anew every frame.
    SingleLevelRebuilt,
    /// A light BVH over mesh lights over one over the triangles of each.
    TwoLevel,
    /// ReSTIR with candidates in proportion to flux.
    Restir,
    /// ReSTIR with candidates from the two-level light BVH.
    BvhRestir,
}

impl SamplerName {
    /// The method that the name stands for, with `integrator`; `combination` is that of ReSTIR.
    ///
    /// # Errors
    /// [`HostError::Usage`] where ReSTIR is given an integrator, or another sampler a way to combine.
    pub(super) fn method(
        self,
        combination: Option<Combination>,
        integrator: Integrator,
    ) -> Result<Method, HostError> {
        let independent = |sampler| match combination {
            None => Ok(Method::Independent {
                sampler,
                rebuilt: self == Self::SingleLevelRebuilt,
                integrator,
            }),
            Some(_) => Err(HostError::Usage {
                option: "--restir-mode",
                needs: "--sampler restir or --sampler bvh-restir",
            }),
        };
        let restir = |source| {
            let combination = combination.unwrap_or(Combination::Unbiased);
            match integrator {
                Integrator::Direct => Ok(Method::Restir(RestirOptions::new(source, combination))),
                Integrator::Path { .. } => Err(HostError::Usage {
                    option: "--integrator path",
                    needs: "--sampler uniform, power, single-level, single-level-rebuilt or two-level",
                }),
            }
        };
        match self {
            Self::Uniform => independent(Sampler::Uniform),
            Self::Power => independent(Sampler::Power),
            Self::SingleLevel | Self::SingleLevelRebuilt => independent(Sampler::SingleLevel),
            Self::TwoLevel => independent(Sampler::TwoLevel),
            Self::Restir => restir(CandidateSource::Power),
            Self::BvhRestir => restir(CandidateSource::LightBvh),
        }
    }

    /// Whether it walks a light BVH.
    pub(super) fn needs_bvh(self) -> bool {
        !matches!(self, Self::Uniform | Self::Power | Self::Restir)
    }

    /// As on the command line.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Uniform => Sampler::Uniform.name(),
            Self::Power => Sampler::Power.name(),
            Self::SingleLevel => Sampler::SingleLevel.name(),
            Self::SingleLevelRebuilt => "single-level-rebuilt",
            Self::TwoLevel => Sampler::TwoLevel.name(),
            Self::Restir => "restir",
            Self::BvhRestir => "bvh-restir",
        }
    }
}

/// `path/name.png` as `path/name-0007.png`.
pub(super) fn numbered(path: &Path, frame: u32) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let mut name = format!("{stem}-{frame:04}");
    if let Some(extension) = path.extension() {
        name.push('.');
        name.push_str(&extension.to_string_lossy());
    }
    path.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_numbered_before_their_extension() {
        let path = Path::new("some/street.night.png");
        assert_eq!(numbered(path, 7), Path::new("some/street.night-0007.png"));
        assert_eq!(numbered(path, 12345), Path::new("some/street.night-12345.png"));
    }
}
