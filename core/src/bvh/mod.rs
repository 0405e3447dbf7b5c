//! The light BVH that owns its arrays: meshes shared by instances, changed by edits, refitted where they changed.
//!
//! Bottom levels (BLAS) lie in the space of their mesh and serve all its instances;
//! the top level (TLAS) lies in the world, its leaves are instances (paper section 3.2, with the instancing that it leaves
//! out). A frame is
//!
//! 1. [`apply`](Bvh::apply) with what changed, checked as a whole before any of it is done;
//! 2. [`refit`](Bvh::refit), which computes just the nodes that this touches (paper section 3.4) and inserts instances that were
//!    added or moved far where they cost least; a device computes the same nodes by the lists of [`plan`](Cursor::plan).
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
mod edit;
mod follow;
mod frame;
mod lights;
mod log;
mod mesh;
mod ranges;
#[cfg(feature = "std")]
mod rebuilder;
mod records;
mod refit;
mod sampled;
mod serial;
mod top;
mod validate;
mod view;

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::marker::PhantomData;
use core::ops::Range;

pub use apply::Added;
#[cfg(test)]
pub(crate) use edit::RADIANCE_FACTORS;
pub use edit::{Edit, EditError, EditReason, InstanceId, MeshId};
pub use follow::{FollowError, follow};
pub use log::{Cursor, RefitPlan};
#[cfg(feature = "std")]
pub use rebuilder::{FrameStart, RebuildError, Rebuilder, RebuilderParams, Swap};
pub use sampled::{Owner, Sampled};
pub use serial::{FORMAT, ReadError};
pub use validate::Violation;
pub use view::View;

pub use crate::levels::Levels;
#[doc(inline)]
pub use crate::transform::Transform;

use self::log::Log;
use self::ranges::Ranges;
use self::records::{InstanceState, Mesh, TreeId};
use self::top::{Batch, Top};
use crate::build::BuildParams;
use crate::instance::Instance;
use crate::model::{AnyKind, Masked, Model, Triangles};
use crate::refit::BlasRoot;

/// A light BVH that owns its arrays: two levels over instances of emissive meshes, made as the model `M` says. `W` is 2 to 16 for layouts of
/// bounds, 4 to 16 for packed moments; another does not compile.
///
/// A clone is another light BVH: each refuses the other's ids. Get the clone's by index
/// ([`mesh_id`](View::mesh_id), [`instance_id`](View::instance_id)).
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
    /// Numbers of removed lights that the caller has not taken yet.
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
///
/// A receiver without a mask does not compile, nor does one with a mask for [`LightBvh`] and [`AnyLights`]:
/// ```compile_fail,E0277
/// # use lightbvh::{MaskedLights, ShadingPoint};
/// let sampled = MaskedLights::default().sample(&ShadingPoint { p: [0.0; 3], n: [0.0; 3] }, 1_u32);
/// ```
/// ```compile_fail,E0277
/// # use lightbvh::{AnyLights, ShadingPoint, importance::LinkedPoint};
/// let receiver = LinkedPoint { point: ShadingPoint { p: [0.0; 3], n: [0.0; 3] }, mask: 1 };
/// let sampled = AnyLights::default().sample(&receiver, 1_u32);
/// ```
pub type MaskedLights = Bvh<Masked>;

impl<M: Model<W>, const W: usize> Default for Bvh<M, W> {
    fn default() -> Self {
        Self::new(BuildParams::default())
    }
}

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    /// The arrays that [`validate`](View::validate) checks, for tests that put wrong words into them.
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

    /// The instance of an id, if it is there.
    fn live(&self, id: InstanceId) -> Option<&InstanceState> {
        self.placed
            .get(id.index as usize)
            .filter(|placed| placed.live && id.tree == self.id.0 && placed.generation == id.generation)
    }
}
