//! The light BVH that owns its arrays: meshes shared by instances, changed by edits, refitted where they changed.
//!
//! Bottom levels (BLAS) lie in the space of their mesh and serve all its instances;
//! the top level (TLAS) lies in the world, its leaves are instances (paper section 3.2, with the instancing that it leaves
//! out). A frame is
//!
//! 1. [`apply`](Bvh::apply) with what changed, checked as a whole before any of it is done;
//! 2. [`refit`](Bvh::refit), which computes just the nodes that this touches (paper section 3.4) and inserts instances that were
//!    added or moved far where they cost least; a device computes the same nodes by the lists of [`plan`](Bvh::plan).
//!
//! A [`Rebuilder`] (feature `std`) builds whole trees in the background (paper section 3.5).
//!
//! | change | costs |
//! |---|---|
//! | any affine motion, brightness | the instance's leaf and the nodes above it; if far from its siblings, it is inserted again |
//! | vertices or emission of a mesh | its bottom level, and the leaves of its instances |
//! | those of some of its lights | the paths to them in the bottom level, and the leaves of its instances |
//! | removed instance | its leaf and the nodes above it |
//! | added instance | one node of each level on the path to where it costs least |
//! | more than a quarter of the instances are added, removed or move far | the whole top level |

mod apply;
mod area;
mod check;
mod construct;
mod edit;
mod follow;
mod lights;
mod log;
mod mesh;
mod one;
mod query;
mod ranges;
#[cfg(feature = "std")]
mod rebuilder;
mod records;
mod refit;
mod sampled;
mod serial;
mod top;
mod validate;

use crate::node::Node;
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::marker::PhantomData;
use core::ops::Range;

pub use apply::Added;
#[cfg(test)]
pub(crate) use edit::RADIANCE_FACTORS;
pub use edit::{Edit, EditError, EditReason, InstanceId, MeshId};
pub use follow::FollowError;
pub use log::{Cursor, RefitPlan};
#[cfg(feature = "std")]
pub use rebuilder::{FrameStart, RebuildError, Rebuilder, RebuilderParams, Swap};
pub use sampled::{Sampled, mis_weight};
pub use serial::{FORMAT, ReadError};
pub use validate::Violation;

pub use crate::levels::Levels;
#[doc(inline)]
pub use crate::transform::Transform;

use self::log::Log;
use self::ranges::Ranges;
use self::records::{InstanceState, Mesh, TreeId};
use self::top::{Batch, Top};
use crate::build::BuildParams;
use crate::instance::Instance;
use crate::model::{AnyKind, Masked, Model, SummaryOf, Triangles};
use crate::refit::BlasRoot;
use crate::tree::LightTree;

/// A light BVH that owns its arrays: two levels over instances of emissive meshes, made as the model `M` says. `W` is 2 to 16 for layouts of
/// bounds, 4 to 16 for packed moments; another does not compile.
///
/// A clone is another light BVH: each refuses the other's ids. Get the clone's by index
/// ([`mesh_id`](Self::mesh_id), [`instance_id`](Self::instance_id)).
#[derive(Clone, Debug)]
pub struct Bvh<M: Model<W> = Triangles, const W: usize = 8> {
    /// Owner of its ids.
    id: TreeId,
    params: BuildParams,
    /// Nodes of the bottom levels.
    nodes: Vec<M::Node>,
    node_ranges: Ranges,
    /// In the space of their meshes, grouped by mesh.
    lights: Vec<M::Light>,
    light_ranges: Ranges,
    trails: Vec<u32>,
    trail_words: u32,
    /// By mesh.
    roots: Vec<BlasRoot>,
    meshes: Vec<Mesh>,
    mesh_ranges: Ranges,
    placed: Vec<InstanceState>,
    placed_ranges: Ranges,
    instances: Vec<Instance>,
    /// Indices of the instances in use.
    live: Vec<u32>,
    numbers: Ranges,
    top: Top<M::Node>,
    /// Instances whose leaves are to be computed, each once.
    stale: Vec<u32>,
    /// Meshes whose lights changed since the last refit, and which; none for all.
    dirty: BTreeMap<u32, Vec<Range<u32>>>,
    /// Meshes that changed since their trees were built.
    reshaped: BTreeSet<u32>,
    /// Batches that the top level has not applied yet.
    unapplied: Vec<Arc<Batch>>,
    /// Batches of refits, for a rebuilder.
    outbox: Outbox,
    log: Log,
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
    /// Whether it is one mesh alone, walked from the root of its bottom level.
    single: bool,
    model: PhantomData<M>,
}

/// Batches that a rebuilder has not taken yet.
#[derive(Clone, Debug, Default)]
struct Outbox {
    /// Number of the first of them.
    first: u64,
    batches: Vec<Arc<Batch>>,
    /// Changes in them.
    len: usize,
    /// Number of the rebuilder that takes them; 0 if none does.
    rebuilder: u32,
}

/// Arrays of a [`Bvh`], open to any change.
#[doc(hidden)]
#[derive(Debug)]
pub struct Parts<'a, N> {
    pub nodes: &'a mut [N],
    pub top: &'a mut [N],
    pub instances: &'a mut [Instance],
    pub trails: &'a mut [u32],
    pub places: &'a mut [u32],
    pub above: &'a mut [u32],
}

/// The light BVH with what measured best for its time: moments on packed nodes of 8 children, 1/64 of uniform choice.
pub type LightBvh = Bvh<Triangles>;

/// [`LightBvh`] over lights of every kind, whose nodes know cones and ranges.
pub type AnyLights = Bvh<AnyKind>;

/// [`AnyLights`] with masks: an instance lights the receivers, [`LinkedPoint`](crate::importance::LinkedPoint)s, of which its mask has a bit, and no
/// others. In place of a share of uniform choice each child with such a light keeps about 1/2048 of its node.
pub type MaskedLights = Bvh<Masked>;

impl<M: Model<W>, const W: usize> Default for Bvh<M, W> {
    fn default() -> Self {
        Self::new(BuildParams::default())
    }
}

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    /// A BVH without lights, whose trees will be built by `params`.
    #[must_use]
    pub fn new(params: BuildParams) -> Self {
        let mut scene = Self {
            id: TreeId::next(),
            params,
            nodes: Vec::new(),
            node_ranges: Ranges::default(),
            lights: Vec::new(),
            light_ranges: Ranges::default(),
            trails: Vec::new(),
            trail_words: 1,
            roots: Vec::new(),
            meshes: Vec::new(),
            mesh_ranges: Ranges::default(),
            placed: Vec::new(),
            placed_ranges: Ranges::default(),
            instances: Vec::new(),
            live: Vec::new(),
            numbers: Ranges::default(),
            top: Top::default(),
            stale: Vec::new(),
            dirty: BTreeMap::new(),
            reshaped: BTreeSet::new(),
            unapplied: Vec::new(),
            outbox: Outbox::default(),
            log: Log::default(),
            removed_lights: Vec::new(),
            waiting_lights: 0,
            forgotten: false,
            light_count: 0,
            bottom_depth: 0,
            single: false,
            model: PhantomData,
        };
        scene.top.build(&scene.params);
        scene
    }

    /// The same tree, walked by another importance.
    #[must_use]
    pub fn by<J>(&self) -> LightTree<'_, M::Node, J, W> {
        self.tree().by()
    }

    /// The arrays that [`validate`](Self::validate) checks, for tests that put wrong words into them.
    #[doc(hidden)]
    pub fn parts_mut(&mut self) -> Parts<'_, M::Node> {
        Parts {
            nodes: &mut self.nodes,
            top: &mut self.top.nodes,
            instances: &mut self.instances,
            trails: &mut self.trails,
            places: &mut self.top.places,
            above: &mut self.top.above,
        }
    }

    /// The arrays as traversal takes them.
    #[must_use]
    pub fn tree(&self) -> LightTree<'_, M::Node, M::Importance, W> {
        let mut tree = LightTree {
            nodes: &self.nodes,
            top: &self.top.nodes,
            first: 0,
            root: self.top.root,
            instances: &self.instances,
            trails: &self.trails,
            links: self.top.links(),
            trail_words: self.trail_words,
            live: self.live.len() as u32,
            lights: 0,
            depth: self.depth(),
            importance: PhantomData,
        };
        if self.single && !self.roots.is_empty() {
            tree.top = &self.nodes;
            tree.root = self.roots[0].node;
            tree.live = 0;
            tree.lights = self.numbers.end();
        }
        tree
    }

    /// The nodes of the bottom levels, those not in use included.
    #[must_use]
    pub fn nodes(&self) -> &[M::Node] {
        &self.nodes
    }

    /// The nodes of the top level, those not in use included.
    #[must_use]
    pub fn top_nodes(&self) -> &[M::Node] {
        &self.top.nodes
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

    /// The lights of all meshes, in their own spaces; the instances of a mesh say where its own begin.
    #[must_use]
    pub fn lights(&self) -> &[M::Light] {
        &self.lights
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
        let top = &self.top;
        size_of_val(&*self.nodes)
            + size_of_val(&*self.instances)
            + size_of_val(&*self.trails)
            + size_of_val(&*top.nodes)
            + size_of_val(&*top.above)
            + size_of_val(&*top.places)
            + size_of_val(&*top.parts)
    }

    /// Bytes of all its arrays: what sampling reads, the lights, and what edits and refits need. Lists of changes are not
    /// counted, nor the copy that a rebuilder has: as much as the top level again.
    #[must_use]
    pub fn memory(&self) -> usize {
        let users = self.meshes.iter().map(|mesh| size_of_val(&*mesh.users));
        size_of_val(&*self.nodes)
            + size_of_val(&*self.instances)
            + size_of_val(&*self.trails)
            + size_of_val(&*self.lights)
            + size_of_val(&*self.roots)
            + size_of_val(&*self.meshes)
            + users.sum::<usize>()
            + size_of_val(&*self.placed)
            + size_of_val(&*self.live)
            + self.top.memory()
    }

    /// Greatest number of nodes on a path from the root to a light.
    #[must_use]
    pub fn depth(&self) -> u32 {
        if self.single && !self.meshes.is_empty() {
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

    /// The merged summary of all lights, as of the last refit.
    #[must_use]
    pub fn summary(&self) -> SummaryOf<M, W> {
        let tree = self.tree();
        Node::<W>::merged(&tree.top[tree.root as usize])
    }
}
