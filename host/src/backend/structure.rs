//! What lights are chosen by.

use lightbvh_kernels::bvh::{BvhPicker, Tree};

use super::{Bvh, LightScene};

/// A light BVH over triangles in the world, or moving lights.
#[derive(Clone, Debug)]
pub enum Structure {
    /// One or two levels over triangles in the world.
    Bvh(Box<Bvh>),
    /// Two levels over instances.
    Scene(Box<LightScene>),
}

impl Structure {
    /// The arrays as traversal takes them.
    #[must_use]
    pub fn tree(&self) -> Tree<'_> {
        match self {
            Self::Bvh(bvh) => bvh.tree(),
            Self::Scene(scene) => scene.tree(),
        }
    }

    /// Whether there is a top level.
    #[must_use]
    pub fn is_two_level(&self) -> bool {
        match self {
            Self::Bvh(bvh) => bvh.is_two_level(),
            Self::Scene(_) => true,
        }
    }
}

impl Structure {
    /// Picks lights by it.
    #[must_use]
    pub fn picker(&self) -> BvhPicker<'_> {
        BvhPicker {
            tree: self.tree(),
            two_level: self.is_two_level(),
        }
    }
}

/// Picks lights by a BVH.
#[must_use]
pub fn picker(bvh: &Bvh) -> BvhPicker<'_> {
    BvhPicker {
        tree: bvh.tree(),
        two_level: bvh.is_two_level(),
    }
}

impl From<Bvh> for Structure {
    fn from(bvh: Bvh) -> Self {
        Self::Bvh(Box::new(bvh))
    }
}

impl From<LightScene> for Structure {
    fn from(scene: LightScene) -> Self {
        Self::Scene(Box::new(scene))
    }
}
