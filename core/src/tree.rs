//! A light BVH as traversal sees it: borrowed arrays, the same on both processors.

use core::marker::PhantomData;

use bytemuck::{Pod, Zeroable};

use crate::importance::DefaultImportance;
use crate::instance::{Instance, world_light};
pub use crate::light::INVALID;
use crate::light::Light;
use crate::node::DefaultNode;
use crate::trail::{BitTrail, Path, max_levels, place_parts};

/// A light BVH of one or two levels: borrowed arrays with nodes of layout `N` and width `W`, and what children are chosen by, `I`.
///
/// Both shapes share every function: in a two-level tree the leaves of the starting tree are instances, in a single-level
/// tree they are triangles and `live` is 0.
pub struct LightTree<'a, N, I, const W: usize> {
    /// All nodes of all trees; at least one.
    pub nodes: &'a [N],
    /// Index of the node that a walk starts at.
    pub root: u32,
    /// The instances; those not in use are in no leaf.
    pub instances: &'a [Instance],
    /// Bit trails of the triangles within the tree that holds them, `trail_words` words each.
    pub trails: &'a [u32],
    /// 1 when every tree of triangles fits one word, else 2.
    pub trail_words: u32,
    /// Number of instances in use, listed by [`Instance::listed`]; 0 in a single-level tree.
    pub live: u32,
    /// Number of triangles of a single-level tree.
    pub lights: u32,
    /// Greatest number of nodes on a path from the root to a light: no walk takes more steps.
    pub depth: u32,
    /// The importance has no words.
    pub importance: PhantomData<I>,
}

/// `LightBvh` as borrowed arrays, which a shader has too.
pub type DefaultTree<'a> = LightTree<'a, DefaultNode, DefaultImportance, 8>;

impl<N, I, const W: usize> Clone for LightTree<'_, N, I, W> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<N, I, const W: usize> Copy for LightTree<'_, N, I, W> {}

impl<'a, N, I, const W: usize> LightTree<'a, N, I, W> {
    /// The same tree, walked by another importance.
    #[inline]
    #[must_use]
    pub fn by<J>(&self) -> LightTree<'a, N, J, W> {
        LightTree {
            nodes: self.nodes,
            root: self.root,
            instances: self.instances,
            trails: self.trails,
            trail_words: self.trail_words,
            live: self.live,
            lights: self.lights,
            depth: self.depth,
            importance: PhantomData,
        }
    }

    /// Light `light` of `instance` in the world, as a [`SampledLight`](crate::SampledLight) names them; `triangles` are those of the
    /// `Bvh`, in the spaces of their meshes. Without radiance where there is no such light. A single level has one
    /// instance, whichever is named.
    #[inline]
    #[must_use]
    pub fn triangle<L: Light>(&self, triangles: &[L], light: u32, instance: u32) -> L {
        // A single level has one instance, whatever is named; of several, none is meant by no index.
        let instance = match (self.live, instance) {
            (0, _) => INVALID,
            (_, INVALID) => INVALID - 1,
            _ => instance,
        };
        world_light(triangles, self.instances, light, instance)
    }

    /// The path to triangle `triangle` of the bottom level of instance `instance` (`u32::MAX` in a single-level tree).
    /// Indices out of range give a path that leads elsewhere; no access is out of range.
    #[inline]
    #[must_use]
    pub(crate) fn path_of(&self, triangle: u32, instance: u32) -> Path {
        if instance < self.instances.len() as u32 {
            let bottom = self.trail(triangle);
            Path {
                top: self.trail_to(self.leaf_of(instance, bottom)),
                bottom,
            }
        } else {
            Path {
                top: self.trail(triangle),
                bottom: BitTrail { low: 0, high: 0 },
            }
        }
    }

    /// The leaf of the top level below which a triangle of `instance` lies, whose trail in the bottom level is `bottom`: the instance, or
    /// the one of its parts.
    #[inline]
    fn leaf_of(&self, instance: u32, bottom: BitTrail) -> u32 {
        let own = &self.instances[instance as usize];
        let mut leaf = instance;
        if own.part != INVALID && !own.is_part() {
            let part = own.part.wrapping_add(bottom.slot::<W>(0));
            if part < self.instances.len() as u32 {
                leaf = part;
            }
        }
        leaf
    }

    /// The instance that a leaf of the top level belongs to: itself, unless it is a part.
    #[inline(always)]
    pub(crate) fn instance_of(&self, leaf: u32) -> u32 {
        let mut instance = leaf;
        if leaf < self.instances.len() as u32 {
            let own = &self.instances[leaf as usize];
            if own.is_part() && own.part != INVALID {
                instance = own.part;
            }
        }
        instance
    }

    /// Trail of an instance in the top level, from its leaf up: at most as many steps as a tree has levels, for any words.
    #[inline]
    fn trail_to(&self, instance: u32) -> BitTrail {
        let count = self.instances.len() as u32;
        let mut trail = BitTrail { low: 0, high: 0 };
        let mut place = self.instances[instance as usize].place;
        let mut steps = 0;
        while place != INVALID && steps < max_levels(W) {
            let (node, slot) = place_parts::<W>(place);
            trail = trail.behind::<W>(slot);
            place = INVALID;
            if node < count {
                place = self.instances[node as usize].above;
            }
            steps += 1;
        }
        trail
    }

    /// Trail of a triangle in the tree that holds it.
    #[inline]
    fn trail(&self, triangle: u32) -> BitTrail {
        let word = triangle.wrapping_mul(self.trail_words);
        let low = if word < self.trails.len() as u32 {
            self.trails[word as usize]
        } else {
            0
        };
        let wide = self.trail_words == 2 && word.wrapping_add(1) < self.trails.len() as u32;
        let high = if wide { self.trails[(word + 1) as usize] } else { 0 };
        BitTrail { low, high }
    }
}

/// What a [`LightTree`] holds besides its arrays: five words, for push constants. They may change with every edit.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct TreeWords {
    /// Index of the node that a walk starts at.
    pub root: u32,
    /// Words per bit trail, 1 or 2.
    pub trail_words: u32,
    /// Number of instances in use; 0 in a single-level tree.
    pub live: u32,
    /// Number of triangles of a single-level tree.
    pub lights: u32,
    /// Greatest number of nodes on a path.
    pub depth: u32,
}

impl TreeWords {
    /// Those of `tree`.
    #[must_use]
    pub fn of<N, I, const W: usize>(tree: &LightTree<'_, N, I, W>) -> Self {
        Self {
            root: tree.root,
            trail_words: tree.trail_words,
            live: tree.live,
            lights: tree.lights,
            depth: tree.depth,
        }
    }

    /// The tree over the given arrays: those of a `Bvh`, or a device's buffers.
    #[inline]
    #[must_use]
    pub fn tree<'a, N, I, const W: usize>(
        &self,
        nodes: &'a [N],
        instances: &'a [Instance],
        trails: &'a [u32],
    ) -> LightTree<'a, N, I, W> {
        LightTree {
            nodes,
            root: self.root,
            instances,
            trails,
            trail_words: self.trail_words,
            live: self.live,
            lights: self.lights,
            depth: self.depth,
            importance: PhantomData,
        }
    }
}
