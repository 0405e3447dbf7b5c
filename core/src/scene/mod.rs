//! Moving lights: meshes shared by instances, changed by edits, refitted where they changed.
//!
//! A [`Scene`] owns a two-level light BVH. Bottom levels (BLAS) lie in the space of their mesh and serve all its instances;
//! the top level (TLAS) lies in the world, its leaves are instances (paper section 3.2, with the instancing that it leaves
//! out). A frame is
//!
//! 1. [`update`](Scene::update) with what changed, checked as a whole before any of it is done;
//! 2. [`refit`](Scene::refit), which computes just the nodes that this touches (paper section 3.4), or the same on a device
//!    by the lists of [`plan`](Scene::plan);
//! 3. [`rebuild`](Scene::rebuild) for the next frame: a [`Rebuild`] is self-contained work for any thread, whose result
//!    [`adopt`](Scene::adopt) swaps in (paper section 3.5). With the feature `std` a `Rebuilder` does so on a thread beside
//!    the frame.
//!
//! | change | costs |
//! |---|---|
//! | any affine motion, brightness | the instance's leaf and the nodes above it |
//! | vertices or emission of a mesh | its bottom level, and the leaves of its instances |
//! | added or removed instance | a node on top of the top level, or an emptied slot, until the next rebuild |

mod blas;
mod check;
mod edit;
mod ranges;
mod rebuild;
mod refit;
mod top;
mod update;
mod validate;

use alloc::vec::Vec;
use core::ops::Range;

pub use edit::{Edit, EditError, EditReason, InstanceId, MeshId, RADIANCE_FACTORS};
pub use rebuild::{Rebuild, RebuildParams, Rebuilt};
pub use refit::Work;
pub use update::Updated;
pub use validate::SceneStats;

use self::blas::Blas;
use self::ranges::Ranges;
use self::top::Top;
use crate::build::BuildParams;
use crate::importance::ImportanceModel;
use crate::instance::Instance;
use crate::light::EmissiveTriangle;
use crate::node::LightNode;
use crate::point::ShadingPoint;
use crate::refit::BlasRoot;
use crate::transform::Transform;
use crate::traverse::{self, Random64, SampledLight};
use crate::tree::{INVALID, LightTree};

/// A two-level light BVH over instances of emissive meshes, with nodes of layout `N` and width `W`.
#[derive(Clone, Debug)]
pub struct Scene<N, const W: usize> {
    params: BuildParams,
    nodes: Vec<N>,
    node_ranges: Ranges,
    /// By node: the node above it in the same tree, or [`INVALID`].
    parents: Vec<u32>,
    /// In the space of their meshes, grouped by bottom level.
    triangles: Vec<EmissiveTriangle>,
    triangle_ranges: Ranges,
    trails: Vec<u32>,
    trail_words: u32,
    blases: Vec<Blas>,
    blas_ranges: Ranges,
    roots: Vec<BlasRoot>,
    meshes: Vec<Mesh>,
    mesh_ranges: Ranges,
    placed: Vec<Placed>,
    placed_ranges: Ranges,
    instances: Vec<Instance>,
    /// Indices of the instances in use.
    live: Vec<u32>,
    lights: Ranges,
    top: Top,
    work: Work,
    pending: refit::Pending,
    /// Whether `work` is what the next refit does.
    planned: bool,
    /// What `work` was planned from, until a refit has done it.
    taken: refit::Pending,
    /// Lights of the previous frame that are none, or others, now.
    removed_lights: Vec<Range<u32>>,
    /// Greatest number of levels of a bottom level so far.
    bottom_depth: u32,
    /// Counts what comes, goes or is built, so that a rebuild can tell who came after it began.
    clock: u64,
    /// Counts refits that changed something.
    refits: u64,
}

/// A mesh: the bottom level that its instances share.
#[derive(Clone, Debug)]
struct Mesh {
    live: bool,
    generation: u32,
    blas: u32,
    /// Indices of its instances.
    users: Vec<u32>,
}

/// An instance as the CPU knows it.
#[derive(Clone, Debug)]
struct Placed {
    live: bool,
    generation: u32,
    mesh: u32,
    /// Its place in the mesh's list of users.
    user: u32,
    transform: Transform,
    radiance: f32,
    /// Its place in the list of instances in use.
    listed: u32,
    lights: Range<u32>,
    /// Where in the top level it is a leaf.
    node: u32,
    slot: u32,
    /// When it came into the scene.
    born: u64,
}

fn live(placed: &[Placed], id: InstanceId) -> Option<&Placed> {
    placed
        .get(id.index as usize)
        .filter(|placed| placed.live && placed.generation == id.generation)
}

impl<N: LightNode<W>, const W: usize> Default for Scene<N, W> {
    fn default() -> Self {
        Self::new(BuildParams::default())
    }
}

impl<N: LightNode<W>, const W: usize> Scene<N, W> {
    /// A scene without lights, whose trees will be built by `params`.
    #[must_use]
    pub fn new(params: BuildParams) -> Self {
        let mut scene = Self {
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
            work: Work::default(),
            pending: refit::Pending::default(),
            planned: false,
            taken: refit::Pending::default(),
            removed_lights: Vec::new(),
            bottom_depth: 0,
            clock: 0,
            refits: 0,
        };
        scene.empty_top();
        scene
    }

    /// Chooses a light for `point`, which is within the domain of [`ShadingPoint::checked`]; see [`traverse::sample`]. Without
    /// lights none is chosen.
    #[must_use]
    pub fn sample<I: ImportanceModel<N, W>>(
        &self,
        point: &ShadingPoint,
        random: impl Into<Random64>,
    ) -> SampledLight {
        debug_assert!(point.is_within_reach(), "not a shading point: {point:?}");
        traverse::widest::sample::<N, I, W>(&self.tree(), point, random.into())
    }

    /// Chooses a light for each of `points`, points as for [`sample`](Self::sample); see [`traverse::sample_batch`].
    pub fn sample_batch<I: ImportanceModel<N, W>>(
        &self,
        points: &[ShadingPoint],
        randoms: &[Random64],
        sampled: &mut [SampledLight],
    ) {
        traverse::widest::sample_batch::<N, I, W>(&self.tree(), points, randoms, sampled);
    }

    /// Probability of `light` of `instance` at `point`, a point as for [`sample`](Self::sample); see [`traverse::pmf`]. 0 for an
    /// unknown instance, or a light of another one.
    #[must_use]
    pub fn pmf<I: ImportanceModel<N, W>>(
        &self,
        point: &ShadingPoint,
        light: u32,
        instance: InstanceId,
    ) -> f32 {
        debug_assert!(point.is_within_reach(), "not a shading point: {point:?}");
        match live(&self.placed, instance) {
            Some(placed) if placed.lights.contains(&light) => {
                traverse::widest::pmf::<N, I, W>(&self.tree(), point, light, instance.index)
            }
            _ => 0.0,
        }
    }

    /// The arrays as traversal takes them.
    #[must_use]
    pub fn tree(&self) -> LightTree<'_, N> {
        LightTree {
            nodes: &self.nodes,
            root: self.top.root,
            instances: &self.instances,
            trails: &self.trails,
            trail_words: self.trail_words,
            live: self.live.len() as u32,
            lights: 0,
            depth: self.depth(),
        }
    }

    /// All nodes, those not in use included.
    #[must_use]
    pub fn nodes(&self) -> &[N] {
        &self.nodes
    }

    /// By node: the node above it in the same tree, or [`INVALID`].
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

    /// The triangles of all bottom levels, in the spaces of their meshes.
    #[must_use]
    pub fn triangles(&self) -> &[EmissiveTriangle] {
        &self.triangles
    }

    /// The lights of an instance: numbered without gaps, triangle by triangle, the same as long as the instance lives.
    #[must_use]
    pub fn lights_of(&self, instance: InstanceId) -> Option<Range<u32>> {
        live(&self.placed, instance).map(|placed| placed.lights.clone())
    }

    /// One more than the greatest number of a light.
    #[must_use]
    pub fn light_end(&self) -> u32 {
        self.lights.end()
    }

    /// Light `light` of `instance` in the world; `None` where there is no such.
    #[must_use]
    pub fn light(&self, light: u32, instance: InstanceId) -> Option<EmissiveTriangle> {
        let placed = live(&self.placed, instance).filter(|placed| placed.lights.contains(&light))?;
        let own = &self.instances[instance.index as usize];
        let triangle = self.blas_of(placed).triangles.start + (light - placed.lights.start);
        Some(own.triangle(&self.triangles[triangle as usize], instance.index))
    }

    /// All lights in the world by number; numbers not in use get triangles without radiance. Their `mesh` is the index of
    /// the instance.
    #[must_use]
    pub fn world_lights(&self) -> Vec<EmissiveTriangle> {
        let dark = EmissiveTriangle {
            p: [[0.0; 3]; 3],
            radiance: [0.0; 3],
            mesh: INVALID,
            flags: 0,
        };
        let mut out = alloc::vec![dark; self.lights.end() as usize];
        for (index, placed) in self.placed.iter().enumerate().filter(|(_, placed)| placed.live) {
            let own = &self.instances[index];
            let range = self.blas_of(placed).triangles.clone();
            let local = &self.triangles[range.start as usize..range.end as usize];
            let lights = placed.lights.start as usize..placed.lights.end as usize;
            for (light, triangle) in out[lights].iter_mut().zip(local) {
                *light = own.triangle(triangle, index as u32);
            }
        }
        out
    }

    /// Number of lights in the world.
    #[must_use]
    pub fn light_count(&self) -> usize {
        let placed = self.placed.iter().filter(|placed| placed.live);
        placed.map(|placed| placed.lights.len()).sum()
    }

    /// The lights that were there before the last [`update`](Self::update) and are no more: what a temporal method must
    /// forget before it looks at the new frame. Every other light keeps its number. Numbers of removed lights may mean
    /// other lights at once.
    #[must_use]
    pub fn removed_lights(&self) -> &[Range<u32>] {
        &self.removed_lights
    }

    /// Bytes that sampling and pmf read, unused parts included.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.nodes) + size_of_val(&*self.instances) + size_of_val(&*self.trails)
    }

    fn blas_of(&self, placed: &Placed) -> &Blas {
        &self.blases[self.blas_index(placed) as usize]
    }

    fn blas_index(&self, placed: &Placed) -> u32 {
        self.meshes[placed.mesh as usize].blas
    }

    /// Greatest number of nodes on a path from the root to a light.
    #[must_use]
    pub fn depth(&self) -> u32 {
        self.top.depth + self.bottom_depth
    }
}
