//! A tree that is checked.

use lightbvh::{
    EmissiveTriangle, INVALID, ImportanceModel, LightTree, Lights, Moments, Random64, SampledLight,
    ShadingPoint,
};
use lightbvh_kernels::bvh::{Node, WIDTH};

use crate::backend::Bvh;

/// A tree of the default's nodes and importance.
pub struct Subject<'a> {
    bvh: &'a Bvh,
    /// The lights, in the world.
    pub lights: &'a [EmissiveTriangle],
}

impl<'a> Subject<'a> {
    /// A tree over `lights`.
    pub fn new(bvh: &'a Bvh, lights: &'a Lights) -> Self {
        let lights = lights.triangles();
        Self { bvh, lights }
    }

    /// Chooses a light.
    pub fn sample(&self, point: &ShadingPoint, random: Random64) -> SampledLight {
        self.bvh.tree().sample(point, random)
    }

    /// Evaluates the probability of a light.
    pub fn pmf(&self, point: &ShadingPoint, light: u32) -> f32 {
        self.pmf_by(&self.bvh.tree(), point, light)
    }

    /// The same by weights alone, without a uniform share.
    pub fn pmf_by_weights(&self, point: &ShadingPoint, light: u32) -> f32 {
        self.pmf_by(&self.bvh.tree().by::<Moments>(), point, light)
    }

    fn pmf_by<I: ImportanceModel<Node, WIDTH>>(
        &self,
        tree: &LightTree<'_, Node, I, WIDTH>,
        point: &ShadingPoint,
        light: u32,
    ) -> f32 {
        match self.lights.get(light as usize) {
            Some(triangle) if tree.live > 0 => tree.pmf(point, light, triangle.mesh),
            Some(_) => tree.pmf(point, light, INVALID),
            None => 0.0,
        }
    }
}
