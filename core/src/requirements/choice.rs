//! Models: a light BVH's parts, and which of them a scene can do without.

use alloc::format;
use alloc::string::String;
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
}

impl Layout {
    /// Name for tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        ["moments", "two-sided"][self as usize]
    }
}

/// A light BVH's parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Choice {
    /// What nodes store.
    pub layout: Layout,
    /// One tree over triangles that stand in the world ([`Bvh::single_level`](crate::Bvh::single_level)), instead of one over instances
    /// and one over the triangles of each mesh.
    pub single_level: bool,
}

impl Choice {
    /// What serves any scene: [`LightBvh`](crate::LightBvh) in two levels.
    pub const DEFAULT: Self = Self {
        layout: Layout::Moments,
        single_level: false,
    };

    /// The type of a node, as Rust has it.
    #[must_use]
    pub const fn node_type(&self) -> &'static str {
        match self.layout {
            Layout::Moments => "MomentNode<8>",
            Layout::TwoSidedMoments => "TwoSidedMomentNode<8>",
        }
    }

    /// The type of the light BVH, as Rust has it.
    #[must_use]
    pub fn type_name(&self) -> String {
        format!("Bvh<({}, DefaultImportance)>", self.node_type())
    }
}

/// The type, and how it is built.
impl fmt::Display for Choice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let levels = if self.single_level {
            "one level"
        } else {
            "two levels"
        };
        write!(f, "{}, {levels}", self.type_name())
    }
}

impl Requirements {
    /// The smallest model that is sufficient. The layout keeps the bits of probabilities. One level in place of
    /// several, or of a mesh that stands elsewhere than at the identity, is another tree: what that does to the variance
    /// depends on the scene, and `lightbvh inspect` measures it.
    #[must_use]
    pub fn model(&self) -> Choice {
        let d = self.declared;
        Choice {
            layout: if self.one_sided == 0 && !d.meshes {
                Layout::TwoSidedMoments
            } else {
                Layout::Moments
            },
            // Of one mesh that stays where it is, or of several that stay as they are, without another copy of a triangle.
            single_level: !(d.transforms || d.radiance || d.instances || d.meshes)
                && (!d.triangles || self.meshes.max(self.instances) < 2)
                && self.most_instances < 2,
        }
    }
}
