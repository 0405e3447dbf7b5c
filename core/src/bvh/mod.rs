//! The light BVH that owns its arrays: meshes shared by instances, changed by edits, refitted where they changed.
//!
//! Bottom levels (BLAS) lie in the space of their mesh and serve all its instances;
//! the top level (TLAS) lies in the world, its leaves are instances (paper section 3.2, with the instancing that it leaves
//! out). A frame is
//!
//! 1. [`apply`](Bvh::apply) with what changed, checked as a whole before any of it is done;
//! 2. [`refit`](Bvh::refit), which computes just the nodes that this touches (paper section 3.4), or the same on a device
//!    by the lists of [`plan`](Bvh::plan), or both;
//! 3. [`rebuild`](Bvh::rebuild) for the next frame: a [`Rebuild`] is self-contained work for any thread, whose result
//!    [`install`](Bvh::install) swaps in (paper section 3.5). With the feature `std` a `Rebuilder` does so on a thread beside
//!    the frame.
//!
//! | change | costs |
//! |---|---|
//! | any affine motion, brightness | the instance's leaf and the nodes above it; far from its neighbours it is taken out and put in elsewhere |
//! | vertices or emission of a mesh | its bottom level, and the leaves of its instances |
//! | of some of its triangles | the paths to them in the bottom level, and the leaves of its instances |
//! | removed instance | its leaf and the nodes above it; the place is filled from below |
//! | added instance | one node of each level on the way to where it costs least, and their links |

mod apply;
mod blas;
mod changes;
mod check;
mod construct;
mod edit;
mod follow;
mod known_flux;
mod lights;
mod one;
mod opened;
mod powers;
mod quality;
mod query;
mod ranges;
mod rebuild;
mod records;
mod refit;
#[cfg_attr(
    not(feature = "std"),
    allow(dead_code, reason = "the `Rebuilder` asks for it")
)]
mod room;
mod serial;
#[cfg_attr(not(feature = "std"), allow(dead_code, reason = "the `Rebuilder` drives it"))]
mod stage;
mod static_bvh;
mod static_mesh;
#[cfg(test)]
mod tests;
mod top;
mod touched;
mod trails;
mod unsettled;
mod validate;

use alloc::vec::Vec;
use core::marker::PhantomData;
use core::ops::Range;

pub use apply::Added;
pub use edit::{Edit, EditError, EditReason, InstanceId, MeshId, RADIANCE_FACTORS};
pub use follow::{FollowError, MeshCounts};
#[cfg(feature = "std")]
pub(crate) use rebuild::Taken;
pub use rebuild::{Due, Foreign, Rebuild, RebuildParams, Rebuilt};
pub use refit::RefitPlan;
pub use serial::{FORMAT, ReadError};
#[cfg(feature = "std")]
pub(crate) use stage::{Builder, HANDED, MeshJob, MeshTree, StageId};
pub use static_bvh::StaticBvh;
pub use static_mesh::StaticMeshBvh;
#[cfg(feature = "std")]
pub(crate) use top::{Looked, Search};
pub use trails::{NoTrails, Trails, WithTrails};
pub use validate::Stats;

pub use crate::levels::Levels;
#[cfg(feature = "std")]
pub use crate::rebuilder::{FrameStart, RebuildError, RebuilderParams, Swap};
#[doc(inline)]
pub use crate::transform::Transform;

use self::blas::Blas;
use self::ranges::Ranges;
use self::records::{InstanceState, Mesh, TreeId};
use self::top::Top;
use crate::build::BuildParams;
use crate::importance::DefaultImportance;
use crate::instance::Instance;
use crate::node::{DefaultNode, Holds, Node};
use crate::refit::BlasRoot;
use crate::tree::LightTree;

/// A light BVH that owns its arrays: two levels over instances of emissive meshes, with nodes of layout `N` and width `W`, whose
/// children are chosen by `I`. `W` is 2 to 16 for layouts of bounds, 4 to 16 for packed moments; another does not compile.
///
/// A clone is another light BVH: ids and rebuilds of the one are refused by the other, which knows its own by index
/// ([`mesh_id`](Self::mesh_id), [`instance_id`](Self::instance_id)).
///
/// `T` says whether the probability of a given light can be asked for: [`WithTrails`] unless
/// [`without_trails`](Self::without_trails) gave them up.
#[derive(Clone, Debug)]
pub struct Bvh<N: Holds, I, const W: usize, T = WithTrails> {
    /// What its ids belong to.
    id: TreeId,
    params: BuildParams,
    nodes: Vec<N>,
    node_ranges: Ranges,
    /// By node: the node above it in the same tree, or [`INVALID`](crate::INVALID).
    parents: Vec<u32>,
    /// In the space of their meshes, grouped by bottom level.
    triangles: Vec<N::Light>,
    triangle_ranges: Ranges,
    trails: Vec<u32>,
    trail_words: u32,
    blases: Vec<Blas>,
    blas_ranges: Ranges,
    roots: Vec<BlasRoot>,
    meshes: Vec<Mesh>,
    mesh_ranges: Ranges,
    placed: Vec<InstanceState>,
    placed_ranges: Ranges,
    instances: Vec<Instance>,
    /// Indices of the instances in use.
    live: Vec<u32>,
    lights: Ranges,
    top: Top,
    /// The lists of the last plan.
    planned: RefitPlan,
    /// Those of the last refit, where they are others.
    done: Option<RefitPlan>,
    changes: changes::Changes,
    /// Numbers of lights that are no more, not yet taken by the caller nor given again.
    removed_lights: Vec<Range<u32>>,
    /// How many they are.
    waiting_lights: usize,
    /// Whether so many waited that all of them were given back: any number may then be another light's.
    forgotten: bool,
    /// How many lights there are.
    light_count: usize,
    /// Greatest number of levels of a bottom level so far.
    bottom_depth: u32,
    /// Counts what comes, goes, changes or is built, so that a rebuild can tell what did so after it began.
    epoch: u64,
    /// Whether it is one mesh alone, walked from the root of its bottom level.
    single: bool,
    /// By node: what is known of its subtree's quality; only those of bottom levels count.
    quality: Vec<quality::Quality>,
    /// Bottom levels whose trees are being put in place piece by piece.
    staging: Vec<u32>,
    /// Bottom levels that instances of their meshes are still to follow.
    handing: Vec<u32>,
    /// Lists that adopted trees replaced: giving their memory back takes longer than a frame may.
    retired: Vec<Levels>,
    /// Triangles and nodes of the largest bottom levels so far.
    largest: [usize; 2],
    /// When bottom levels were refitted, and which.
    refitted: quality::Refitted,
    /// Nodes of bottom levels that a search came by.
    marks: touched::Marks,
    importance: PhantomData<I>,
    asked: PhantomData<T>,
}

/// Arrays of a [`Bvh`], open to any change; `bottom` and `top` list the nodes of the first bottom level and of the top level.
#[doc(hidden)]
#[derive(Debug)]
pub struct Parts<'a, N> {
    pub nodes: &'a mut [N],
    pub instances: &'a mut [Instance],
    pub trails: &'a mut [u32],
    pub bottom: &'a mut [u32],
    pub top: &'a mut [u32],
}

/// The light BVH with what measured best for its time: moments on packed nodes of 8 children, 1/64 of uniform choice.
pub type LightBvh = Bvh<DefaultNode, DefaultImportance, 8>;

impl<N: Node<W>, I, const W: usize> Default for Bvh<N, I, W> {
    fn default() -> Self {
        Self::new(BuildParams::default())
    }
}

impl<N: Node<W>, I, const W: usize> Bvh<N, I, W> {
    /// A BVH without lights, whose trees will be built by `params`.
    #[must_use]
    pub fn new(params: BuildParams) -> Self {
        let mut scene = Self {
            id: TreeId::next(),
            params,
            nodes: Vec::new(),
            node_ranges: Ranges::default(),
            parents: Vec::new(),
            triangles: Vec::new(),
            triangle_ranges: Ranges::default(),
            trails: Vec::new(),
            trail_words: 1,
            blases: Vec::new(),
            blas_ranges: Ranges::default(),
            roots: Vec::new(),
            meshes: Vec::new(),
            mesh_ranges: Ranges::default(),
            placed: Vec::new(),
            placed_ranges: Ranges::default(),
            instances: Vec::new(),
            live: Vec::new(),
            lights: Ranges::default(),
            top: Top::default(),
            planned: RefitPlan::default(),
            done: None,
            changes: changes::Changes::default(),
            removed_lights: Vec::new(),
            waiting_lights: 0,
            forgotten: false,
            light_count: 0,
            bottom_depth: 0,
            epoch: 0,
            single: false,
            quality: Vec::new(),
            refitted: quality::Refitted::default(),
            staging: Vec::new(),
            handing: Vec::new(),
            retired: Vec::new(),
            largest: [0; 2],
            marks: touched::Marks::default(),
            importance: PhantomData,
            asked: PhantomData,
        };
        scene.empty_top();
        scene
    }

    /// The arrays as traversal takes them.
    #[must_use]
    pub fn tree(&self) -> LightTree<'_, N, I, W> {
        self.arrays()
    }

    /// The same tree, walked by another importance.
    #[must_use]
    pub fn by<J>(&self) -> LightTree<'_, N, J, W> {
        self.tree().by()
    }

    /// The arrays that [`validate`](Self::validate) checks, for tests that put wrong words into them.
    #[doc(hidden)]
    pub fn parts_mut(&mut self) -> Parts<'_, N> {
        Parts {
            nodes: &mut self.nodes,
            instances: &mut self.instances,
            trails: &mut self.trails,
            bottom: self
                .blases
                .first_mut()
                .map_or(&mut [], |blas| &mut blas.levels.nodes),
            top: &mut self.top.nodes,
        }
    }
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// The arrays as traversal takes them. Without trails, no probability may be asked of them.
    pub(super) fn arrays(&self) -> LightTree<'_, N, I, W> {
        let mut tree = LightTree {
            nodes: &self.nodes,
            root: self.top.root,
            instances: &self.instances,
            trails: &self.trails,
            trail_words: self.trail_words,
            live: self.live.len() as u32,
            lights: 0,
            depth: self.depth(),
            importance: PhantomData,
        };
        if self.single && !self.roots.is_empty() {
            tree.root = self.roots[0].node;
            tree.live = 0;
            tree.lights = self.lights.end();
        }
        tree
    }

    /// All nodes, those not in use included.
    #[must_use]
    pub fn nodes(&self) -> &[N] {
        &self.nodes
    }

    /// By node: the node above it in the same tree, or [`INVALID`](crate::INVALID).
    #[must_use]
    pub fn parents(&self) -> &[u32] {
        &self.parents
    }

    /// The bounds of the bottom levels.
    #[must_use]
    pub fn roots(&self) -> &[BlasRoot] {
        &self.roots
    }

    /// The instances by index; those not in use are in no leaf.
    #[must_use]
    pub fn instances(&self) -> &[Instance] {
        &self.instances
    }

    /// The triangles of all bottom levels, in the spaces of their meshes. Where those of a mesh begin may change with its tree; its
    /// instances tell.
    #[must_use]
    pub fn triangles(&self) -> &[N::Light] {
        &self.triangles
    }

    /// The instance of an id, if it is there.
    fn live(&self, id: InstanceId) -> Option<&InstanceState> {
        self.placed
            .get(id.index as usize)
            .filter(|placed| placed.live && id.tree == self.id.0 && placed.generation == id.generation)
    }

    /// Bytes that sampling and pmf read, unused parts included.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.nodes) + size_of_val(&*self.instances) + size_of_val(&*self.trails)
    }

    /// Bytes of all its arrays: what sampling reads, the triangles, and what edits and refits need. Lists of what has changed
    /// are not counted.
    #[must_use]
    pub fn memory(&self) -> usize {
        let levels = self.blases.iter().map(|blas| &blas.levels);
        let users = self.meshes.iter().map(|mesh| size_of_val(&*mesh.users));
        self.bytes()
            + size_of_val(&*self.parents)
            + size_of_val(&*self.triangles)
            + size_of_val(&*self.blases)
            + size_of_val(&*self.roots)
            + size_of_val(&*self.meshes)
            + users.sum::<usize>()
            + size_of_val(&*self.placed)
            + size_of_val(&*self.live)
            + levels.map(|levels| size_of_val(levels.nodes())).sum::<usize>()
            + self.top.memory()
            + self.marks.bytes()
            + size_of_val(&*self.quality)
            + self.refitted.memory()
    }

    fn blas_of(&self, placed: &InstanceState) -> &Blas {
        &self.blases[self.blas_index(placed) as usize]
    }

    fn blas_index(&self, placed: &InstanceState) -> u32 {
        self.meshes[placed.mesh as usize].blas
    }

    /// Greatest number of nodes on a path from the root to a light.
    #[must_use]
    pub fn depth(&self) -> u32 {
        if self.single && !self.blases.is_empty() {
            self.bottom_depth
        } else {
            self.top.depth() + self.bottom_depth
        }
    }

    /// Whether it has no top level: see [`single_level`](Self::single_level).
    #[must_use]
    pub fn is_single_level(&self) -> bool {
        self.single
    }

    /// What is known of all lights together, as of the last refit.
    #[must_use]
    pub fn summary(&self) -> N::Summary {
        self.nodes[self.arrays().root as usize].merged()
    }
}
