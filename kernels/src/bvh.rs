//! The light BVHs that the kernels are compiled for, and their picker for the renderer.

use lightbvh::importance::DefaultImportance;
use lightbvh::light::AnyLight;
use lightbvh::node::{DefaultNode, Holds, Node as Layout, SpotMomentNode};
use lightbvh::{
    CompactNode, EmissiveTriangle, Eq4, ImportanceModel, LightTree, Random64, SampledLight, ShadingPoint,
};

use crate::shading::emitter::Emitter;
use crate::shading::pick::PickLight;

/// A layout with its importance: what one set of kernels is compiled for.
pub trait Choice<const W: usize>: Copy + Send + Sync + 'static {
    /// What the lights are.
    type Light: Emitter;
    /// The node layout.
    type Node: Layout<W> + Holds<Light = Self::Light> + core::fmt::Debug;
    /// What children are chosen by.
    type Importance: ImportanceModel<Self::Node, W> + Clone + core::fmt::Debug + Send + Sync + 'static;
    /// Name for tables and options.
    const NAME: &'static str;
    /// What the names of its kernels end in.
    const SUFFIX: &'static str;
}

/// A choice over emissive triangles alone.
pub trait TriangleChoice<const W: usize>: Choice<W, Light = EmissiveTriangle> {}

impl<C: Choice<W, Light = EmissiveTriangle>, const W: usize> TriangleChoice<W> for C {}

/// The paper's importance, Eq. 4, on quantised bounds, 4 children to a node.
#[derive(Clone, Copy, Debug)]
pub struct Paper;

impl Choice<4> for Paper {
    type Light = EmissiveTriangle;
    type Node = PaperNode;
    type Importance = Eq4;
    const NAME: &'static str = "eq4";
    const SUFFIX: &'static str = "_eq4";
}

/// The default: the layout and importance that measured best for their time, 8 children to a node, with a share of 1/64 of
/// uniform choice.
#[derive(Clone, Copy, Debug)]
pub struct Standard;

impl Choice<WIDTH> for Standard {
    type Light = EmissiveTriangle;
    type Node = Node;
    type Importance = DefaultImportance;
    const NAME: &'static str = "moments";
    const SUFFIX: &'static str = "";
}

/// The default over lights of any kind.
#[derive(Clone, Copy, Debug)]
pub struct Kinds;

impl Choice<WIDTH> for Kinds {
    type Light = AnyLight;
    type Node = AnyNode;
    type Importance = DefaultImportance;
    const NAME: &'static str = "moments with beams";
    const SUFFIX: &'static str = "_any";
}

/// Children per node of [`Standard`].
pub const WIDTH: usize = 8;
/// Node of [`Standard`].
pub type Node = DefaultNode;
/// Node of [`Paper`].
pub type PaperNode = CompactNode<4>;
/// Node over lights of any kind, spots among them: the words of [`Node`], and beams.
pub type AnyNode = SpotMomentNode<8, AnyLight>;

/// The tree of a choice.
pub type TreeOf<'a, C, const W: usize> =
    LightTree<'a, <C as Choice<W>>::Node, <C as Choice<W>>::Importance, W>;
/// The tree of [`Standard`].
pub type StandardTree<'a> = TreeOf<'a, Standard, WIDTH>;
/// The tree of [`Paper`].
pub type PaperTree<'a> = TreeOf<'a, Paper, 4>;
/// The tree of [`Kinds`].
pub type AnyTree<'a> = TreeOf<'a, Kinds, WIDTH>;

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
