//! Models: a light BVH's parts, and which of them a scene can do without.

use alloc::format;
use alloc::string::{String, ToString};
use core::fmt;

use super::Requirements;

/// What nodes store of each child.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Layout {
    /// [`MomentNode`](crate::MomentNode), 24 bytes.
    Moments,
    /// [`TwoSidedMomentNode`](crate::TwoSidedMomentNode), 20 bytes: no mean normal.
    TwoSidedMoments,
    /// [`LeanMomentNode`](crate::LeanMomentNode), 20 bytes: no box and one deviation. No scene is told to take it.
    LeanMoments,
    /// [`FullMomentNode`](crate::FullMomentNode), 60 bytes. No scene is told to take it.
    FullMoments,
}

impl Layout {
    /// All layouts.
    pub const ALL: [Self; 4] = [
        Self::Moments,
        Self::TwoSidedMoments,
        Self::LeanMoments,
        Self::FullMoments,
    ];

    /// Name for options.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Moments => "moments",
            Self::TwoSidedMoments => "two-sided",
            Self::LeanMoments => "lean",
            Self::FullMoments => "full",
        }
    }
}

/// How many levels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Structure {
    /// One tree over triangles that stand in the world ([`Bvh::single_level`](crate::Bvh::single_level)).
    SingleLevel,
    /// A tree over instances, and one over the triangles of each mesh.
    TwoLevel,
}

/// What a light BVH keeps to be changed by. Each serves what the one before it does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Updates {
    /// Nothing: a [`StaticBvh`](crate::bvh::StaticBvh).
    Nothing,
    /// What instances are moved, dimmed, added and removed by: a [`StaticMeshBvh`](crate::bvh::StaticMeshBvh).
    Instances,
    /// Triangles too, and the lists by which bottom levels are refitted: a [`Bvh`](crate::Bvh).
    Meshes,
}

impl Updates {
    /// Name for options.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Nothing => "nothing",
            Self::Instances => "instances",
            Self::Meshes => "meshes",
        }
    }
}

/// A light BVH's parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Model {
    /// What nodes store.
    pub layout: Layout,
    /// How many levels.
    pub structure: Structure,
    /// Children of a node.
    pub width: usize,
    /// Share of uniform choice as the number of times that 1 is halved; 0 for none ([`Defensive`](crate::Defensive)).
    pub uniform_halvings: u32,
    /// Whether trails are kept, by which a given light's probability is found ([`NoTrails`](crate::bvh::NoTrails)).
    pub trails: bool,
    /// What may change.
    pub updates: Updates,
}

impl Model {
    /// What serves any scene: [`LightBvh`](crate::LightBvh) in two levels.
    pub const DEFAULT: Self = Self {
        layout: Layout::Moments,
        structure: Structure::TwoLevel,
        width: 8,
        uniform_halvings: 6,
        trails: true,
        updates: Updates::Meshes,
    };

    /// Says what of the model makes no sense or what is missing of what `requirements` ask for.
    ///
    /// # Errors
    /// [`ModelError`], the first.
    pub fn check(&self, requirements: &Requirements) -> Result<(), ModelError> {
        let declared = requirements.declared;
        if self.uniform_halvings > 0 && !self.trails {
            return Err(ModelError::UniformWithoutTrails);
        }
        if declared.pmf && !self.trails {
            return Err(ModelError::PmfWithoutTrails);
        }
        if self.updates < requirements.updates() {
            return Err(ModelError::Updates(requirements.updates()));
        }
        if self.structure == Structure::SingleLevel && !requirements.one_level_is_enough() {
            return Err(ModelError::SingleLevel);
        }
        Ok(())
    }

    /// The type of a node, as Rust has it.
    #[must_use]
    pub fn node_type(&self) -> String {
        let layout = match self.layout {
            Layout::Moments => "MomentNode",
            Layout::TwoSidedMoments => "TwoSidedMomentNode",
            Layout::LeanMoments => "LeanMomentNode",
            Layout::FullMoments => "FullMomentNode",
        };
        format!("{layout}<{}>", self.width)
    }

    /// The type of the importance, as Rust has it.
    #[must_use]
    pub fn importance_type(&self) -> String {
        match self.uniform_halvings {
            0 => "Moments".to_string(),
            halvings => format!("Defensive<Moments, {halvings}>"),
        }
    }

    /// The type of the light BVH, as Rust has it.
    #[must_use]
    pub fn type_name(&self) -> String {
        let owner = match self.updates {
            Updates::Nothing => "StaticBvh",
            Updates::Instances => "StaticMeshBvh",
            Updates::Meshes => "Bvh",
        };
        let trails = if self.trails { "" } else { ", NoTrails" };
        let (node, importance, width) = (self.node_type(), self.importance_type(), self.width);
        format!("{owner}<{node}, {importance}, {width}{trails}>")
    }
}

/// The type, and how it is built.
impl fmt::Display for Model {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let structure = match self.structure {
            Structure::SingleLevel => "one level",
            Structure::TwoLevel => "two levels",
        };
        write!(f, "{}, {structure}", self.type_name())
    }
}

/// Why a model is not sufficient.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ModelError {
    /// A share of uniform choice finds its lights by trails.
    UniformWithoutTrails,
    /// Probabilities of given lights are found by trails.
    PmfWithoutTrails,
    /// So much changes, and less is kept to change it by.
    Updates(Updates),
    /// Instances move, are dimmed, come, go or share meshes, or several meshes change.
    SingleLevel,
}

impl fmt::Display for ModelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::UniformWithoutTrails => {
                "a share of uniform choice finds its lights by trails; keep the trails or take no share"
            }
            Self::PmfWithoutTrails => {
                "probabilities of given lights are asked for, and found by trails; keep the trails or declare that none is asked for"
            }
            Self::Updates(Updates::Meshes) => {
                "meshes deform, vary in emission or come, which takes their triangles; keep updates of meshes or declare that meshes stay"
            }
            Self::Updates(_) => {
                "instances change, and nothing is kept to refit them by; keep updates of instances or declare that nothing changes"
            }
            Self::SingleLevel => {
                "instances move, are dimmed, come, go or share a mesh, or several meshes change, which one level cannot follow; take two \
                 levels"
            }
        })
    }
}

impl core::error::Error for ModelError {}
