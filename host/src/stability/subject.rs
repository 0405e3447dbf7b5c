//! A tree that is checked, whatever its nodes and importance.

use lightbvh::{
    Bvh, EmissiveTriangle, INVALID, ImportanceModel, LightNode, LightTree, Lights, Moments, Random64,
    SampledLight, ShadingPoint,
};

use crate::backend;

type Sample<'a> = Box<dyn Fn(&ShadingPoint, Random64) -> SampledLight + Sync + 'a>;
type Pmf<'a> = Box<dyn Fn(&ShadingPoint, u32) -> f32 + Sync + 'a>;

/// A tree, walked by its importance.
pub struct Subject<'a> {
    /// The lights, in the world.
    pub lights: &'a [EmissiveTriangle],
    /// Greatest number of nodes on a path from the root to a light.
    pub depth: u32,
    /// Chooses a light.
    pub sample: Sample<'a>,
    /// Evaluates the probability of a light.
    pub pmf: Pmf<'a>,
    /// The same by weights alone, without a uniform share.
    pub pmf_by_weights: Pmf<'a>,
}

impl<'a> Subject<'a> {
    /// A tree of the default's nodes and importance over `lights`.
    pub fn new(bvh: &'a backend::Bvh, lights: &'a Lights) -> Self {
        Self::by::<_, _, Moments, _>(bvh, lights)
    }

    /// A tree over `lights` by an importance whose weights are those of `J`.
    pub fn by<N, I, J, const W: usize>(bvh: &'a Bvh<N, I, W>, lights: &'a Lights) -> Self
    where
        N: LightNode<W>,
        I: ImportanceModel<N, W> + Sync,
        J: ImportanceModel<N, W> + Sync + 'a,
    {
        let (tree, lights) = (bvh.tree(), lights.triangles());
        Self {
            lights,
            depth: tree.depth,
            sample: Box::new(move |point, random| bvh.tree().sample(point, random)),
            pmf: pmf(bvh.tree(), lights),
            pmf_by_weights: pmf(tree.by::<J>(), lights),
        }
    }
}

fn pmf<'a, N: LightNode<W>, I: ImportanceModel<N, W> + Sync + 'a, const W: usize>(
    tree: LightTree<'a, N, I, W>,
    lights: &'a [EmissiveTriangle],
) -> Pmf<'a> {
    Box::new(move |point, light| match lights.get(light as usize) {
        Some(triangle) if tree.live > 0 => tree.pmf(point, light, triangle.mesh),
        Some(_) => tree.pmf(point, light, INVALID),
        None => 0.0,
    })
}
