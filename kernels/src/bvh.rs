//! The light BVHs that the kernels are compiled for, and their picker for the renderer.

use core::fmt::Debug;

use lightbvh::light::AnyLight;
use lightbvh::node::{DefaultNode, Node as Layout, SpotMomentNode};
pub use lightbvh::tree::{AnyKind, Model, Paper, Triangles};
use lightbvh::{
    CompactNode, EmissiveTriangle, ImportanceModel, LightTree, Random64, SampledLight, ShadingPoint,
};

use crate::shading::emitter::Emitter;
use crate::shading::pick::PickLight;

/// A model that a set of kernels is compiled for.
pub trait Compiled<const W: usize>:
    Model<W, Light: Emitter, Importance: ImportanceModel<Self::Node, W> + Debug + Send + Sync + 'static>
    + Copy
    + Send
    + Sync
    + 'static
{
    /// Name for tables and options.
    const NAME: &'static str;
    /// What the names of its kernels end in.
    const SUFFIX: &'static str;
}

/// One over emissive triangles alone.
pub trait TriangleModel<const W: usize>: Compiled<W> + Model<W, Light = EmissiveTriangle> {}

impl<C: Compiled<W> + Model<W, Light = EmissiveTriangle>, const W: usize> TriangleModel<W> for C {}

impl Compiled<4> for Paper {
    const NAME: &'static str = "eq4";
    const SUFFIX: &'static str = "_eq4";
}

impl Compiled<WIDTH> for Triangles {
    const NAME: &'static str = "moments";
    const SUFFIX: &'static str = "";
}

impl Compiled<WIDTH> for AnyKind {
    const NAME: &'static str = "moments with beams";
    const SUFFIX: &'static str = "_any";
}

/// Children per node of [`Triangles`].
pub const WIDTH: usize = 8;
/// Node of [`Triangles`].
pub type Node = DefaultNode;
/// Node of [`Paper`].
pub type PaperNode = CompactNode<4>;
/// Node over lights of any kind, spots among them: the words of [`Node`], and beams.
pub type AnyNode = SpotMomentNode<8, AnyLight>;

/// The tree of a model.
pub type TreeOf<'a, C, const W: usize> = LightTree<'a, <C as Model<W>>::Node, <C as Model<W>>::Importance, W>;
/// The tree of [`Triangles`].
pub type StandardTree<'a> = TreeOf<'a, Triangles, WIDTH>;
/// The tree of [`Paper`].
pub type PaperTree<'a> = TreeOf<'a, Paper, 4>;
/// The tree of [`AnyKind`].
pub type AnyTree<'a> = TreeOf<'a, AnyKind, WIDTH>;

impl<N: Layout<W>, I: ImportanceModel<N, W>, const W: usize> PickLight for LightTree<'_, N, I, W> {
    #[inline]
    fn pick(&self, point: &ShadingPoint, random: Random64) -> SampledLight {
        self.sample(point, random)
    }

    #[inline]
    fn pmf(&self, point: &ShadingPoint, light: u32, instance: u32) -> f32 {
        LightTree::pmf(self, point, light, instance)
    }

    #[cfg(not(target_arch = "spirv"))]
    fn pick_spaced(
        &self,
        point: &ShadingPoint,
        random: Random64,
        first: u32,
        count: u32,
        picked: &mut [SampledLight],
    ) {
        self.sample_spaced(point, random, first, count, picked);
    }
}
