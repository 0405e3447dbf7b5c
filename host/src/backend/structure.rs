//! What lights are chosen by.

use lightbvh::{LightBvh, LightTree, Scene};
use lightbvh_kernels::bvh::{BvhPicker, Choice, Standard, WIDTH};

use super::{Bvh, LightScene};

/// A light BVH over triangles in the world, or moving lights.
#[derive(Clone, Debug)]
pub enum Structure<C: Choice<W> = Standard, const W: usize = WIDTH> {
    /// One or two levels over triangles in the world.
    Bvh(Box<Bvh<C, W>>),
    /// Two levels over instances.
    Scene(Box<LightScene<C, W>>),
}

impl<C: Choice<W>, const W: usize> Structure<C, W> {
    /// The arrays as traversal takes them.
    #[must_use]
    pub fn tree(&self) -> LightTree<'_, C::Node> {
        match self {
            Self::Bvh(bvh) => bvh.tree(),
            Self::Scene(scene) => scene.tree(),
        }
    }

    /// Picks lights by it.
    #[must_use]
    pub fn picker(&self) -> BvhPicker<'_, C, W> {
        BvhPicker::new(self.tree())
    }
}

impl<C: Choice<W>, const W: usize> From<LightBvh<C::Node, W>> for Structure<C, W> {
    fn from(bvh: LightBvh<C::Node, W>) -> Self {
        Self::Bvh(Box::new(bvh))
    }
}

impl<C: Choice<W>, const W: usize> From<Scene<C::Node, W>> for Structure<C, W> {
    fn from(scene: Scene<C::Node, W>) -> Self {
        Self::Scene(Box::new(scene))
    }
}
