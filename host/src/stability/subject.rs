//! What is checked: lights, points to light, and trees over the lights.

use lightbvh::{
    Defensive, EmissiveTriangle, Eq4, INVALID, ImportanceModel, LightNode, LightTree, Moments, Random64,
    SampledLight, ShadingPoint,
};

/// A tree to be walked, whatever its nodes and importance.
pub trait Subject: Sync {
    /// The lights, in the world.
    fn lights(&self) -> &[EmissiveTriangle];
    /// Greatest number of nodes on a path from the root to a light.
    fn depth(&self) -> u32;
    /// Chooses a light.
    fn sample(&self, point: &ShadingPoint, random: u32) -> SampledLight;
    /// Evaluates the probability of a light.
    fn pmf(&self, point: &ShadingPoint, light: u32) -> f32;
    /// The same by weights alone, without a uniform share.
    fn pmf_by_weights(&self, point: &ShadingPoint, light: u32) -> f32;
}

/// An importance, and what it is without a uniform share.
pub trait Weighted: Sync {
    /// The weights alone.
    type Weights: Sync;
}

impl Weighted for Eq4 {
    type Weights = Self;
}

impl Weighted for Moments {
    type Weights = Self;
}

impl<I: Sync, const HALVINGS: u32> Weighted for Defensive<I, HALVINGS> {
    type Weights = I;
}

/// A light tree of any layout, walked by importance `I`.
pub struct Walked<'a, N, I, const W: usize> {
    tree: LightTree<'a, N, I, W>,
    lights: &'a [EmissiveTriangle],
}

impl<'a, N: LightNode<W>, I, const W: usize> Walked<'a, N, I, W> {
    /// A tree over `lights`, which are in the world.
    pub fn new(tree: LightTree<'a, N, I, W>, lights: &'a [EmissiveTriangle]) -> Self {
        Self { tree, lights }
    }

    fn pmf_by<J: ImportanceModel<N, W>>(&self, point: &ShadingPoint, light: u32) -> f32 {
        let instance = match self.lights.get(light as usize) {
            Some(triangle) if self.tree.live > 0 => triangle.mesh,
            Some(_) => INVALID,
            None => return 0.0,
        };
        self.tree.by::<J>().pmf(point, light, instance)
    }
}

impl<N: LightNode<W>, I: ImportanceModel<N, W> + Weighted, const W: usize> Subject for Walked<'_, N, I, W>
where
    I::Weights: ImportanceModel<N, W>,
{
    fn lights(&self) -> &[EmissiveTriangle] {
        self.lights
    }

    fn depth(&self) -> u32 {
        self.tree.depth
    }

    fn sample(&self, point: &ShadingPoint, random: u32) -> SampledLight {
        self.tree.sample(point, Random64::from(random))
    }

    fn pmf(&self, point: &ShadingPoint, light: u32) -> f32 {
        self.pmf_by::<I>(point, light)
    }

    fn pmf_by_weights(&self, point: &ShadingPoint, light: u32) -> f32 {
        self.pmf_by::<I::Weights>(point, light)
    }
}
