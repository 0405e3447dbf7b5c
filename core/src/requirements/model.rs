//! The smallest model that is sufficient: what is kept of the default, and why the rest is not.

use alloc::string::{String, ToString};
use alloc::vec::Vec;
use alloc::{format, vec};
use core::fmt;

use super::{Changes, Orientation, Requirements};

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
    /// Whether triangles, parents and lists are kept, by which edits and refits work ([`StaticBvh`](crate::bvh::StaticBvh)).
    pub refit: bool,
}

impl Model {
    /// What serves any scene: [`LightBvh`](crate::LightBvh) in two levels.
    pub const DEFAULT: Self = Self {
        layout: Layout::Moments,
        structure: Structure::TwoLevel,
        width: 8,
        uniform_halvings: 6,
        trails: true,
        refit: true,
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
        if declared.changes.any() && !self.refit {
            return Err(ModelError::ChangesWithoutRefit);
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
        let owner = if self.refit { "Bvh" } else { "StaticBvh" };
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
    /// Something changes, and nothing is kept to refit it by.
    ChangesWithoutRefit,
    /// Instances move, come, go or share meshes.
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
            Self::ChangesWithoutRefit => {
                "lights change, and a static light BVH cannot be refitted; keep what refits need or declare that nothing changes"
            }
            Self::SingleLevel => {
                "instances move, come, go or share a mesh, or several meshes change, which one level cannot follow; take two levels"
            }
        })
    }
}

impl core::error::Error for ModelError {}

impl Requirements {
    /// The smallest model that is sufficient.
    #[must_use]
    pub fn model(&self) -> Model {
        let default = Model::DEFAULT;
        Model {
            layout: if self.normals_stay_absent() {
                Layout::TwoSidedMoments
            } else {
                default.layout
            },
            structure: if self.one_level_is_enough() {
                Structure::SingleLevel
            } else {
                default.structure
            },
            uniform_halvings: if self.declared.pmf {
                default.uniform_halvings
            } else {
                0
            },
            trails: self.declared.pmf,
            refit: self.declared.changes.any(),
            ..default
        }
    }

    /// Whether no light has a normal, now and later.
    fn normals_stay_absent(&self) -> bool {
        let changes = self.declared.changes;
        // A needle that moves or deforms may get a normal; of meshes that come nothing is known.
        self.orientation == Orientation::Absent
            && !changes.meshes
            && (self.needles == 0 || !(changes.vertices || changes.transforms))
    }

    /// Whether a tree over triangles in the world can follow what changes, without another copy of any triangle: of one mesh that stays
    /// where it is, or of several that stay as they are.
    pub(super) fn one_level_is_enough(&self) -> bool {
        let Changes {
            transforms,
            vertices,
            emission,
            instances,
            meshes,
        } = self.declared.changes;
        !(transforms || instances || meshes)
            && self.most_instances <= 1
            && (self.is_one_mesh() || !(vertices || emission))
    }

    /// Why [`model`](Self::model) is what it is: a sentence for each part that differs from the default, or one that says that none does.
    #[must_use]
    pub fn reasons(&self) -> Vec<String> {
        let model = self.model();
        let mut said = vec![];
        if model.layout == Layout::TwoSidedMoments {
            said.push(
                "no light has a normal: nodes without a row of normals hold the same, 20 bytes of each child for 24".to_string(),
            );
        }
        if model.structure == Structure::SingleLevel {
            said.push(if self.is_one_mesh() {
                "one mesh that stays in its place: its tree stands in the world, no top level chooses it".to_string()
            } else {
                format!(
                    "all {} meshes stay as they are, each in one place: one tree over all their triangles, no instances",
                    self.meshes
                )
            });
        }
        if !model.trails {
            said.push(
                "no probability of a given light is asked for: no trails, and no share of uniform choice, which needs them".to_string(),
            );
        }
        if !model.refit {
            said.push("nothing changes: no triangles, parents or lists for refits".to_string());
        }
        if said.is_empty() {
            said.push(
                "normals, motion and probabilities of given lights are all needed: the default has no part to spare".to_string(),
            );
        }
        said
    }
}
