//! A light BVH as traversal sees it: borrowed arrays, the same on both processors; and the [models](Model) that it may be made of.

use core::marker::PhantomData;

use bytemuck::{Pod, Zeroable};

use crate::importance::DefaultImportance;
use crate::instance::Instance;
pub use crate::light::INVALID;
pub use crate::model::{AnyKind, Masked, Model, Paper, ReceiverOf, Triangles};
use crate::node::DefaultNode;
use crate::trail::{BitTrail, Path, max_levels, place_parts};

/// A light BVH of one or two levels: borrowed arrays with nodes of layout `N` and width `W`, and what children are chosen by, `I`.
///
/// Both shapes share every function: in a two-level tree the leaves of the starting tree are instances, in a single-level
/// tree they are lights and `live` is 0.
pub struct LightTree<'a, N, I, const W: usize> {
    /// The nodes of all bottom levels.
    pub nodes: &'a [N],
    /// Nodes of the tree that a walk starts in, at least one. On a device they stand among `nodes`.
    #[cfg(not(target_arch = "spirv"))]
    pub top: &'a [N],
    /// Index of the first of them there: links within the top level count from it.
    pub first: u32,
    /// Index of the node that a walk starts at.
    pub root: u32,
    /// The instances; those not in use are in no leaf.
    pub instances: &'a [Instance],
    /// Bit trails of the lights within the tree that holds them, `trail_words` words each.
    pub trails: &'a [u32],
    /// Links of the top level upward.
    pub links: Links<'a>,
    /// 1 when every tree of lights fits one word, else 2.
    pub trail_words: u32,
    /// Number of instances in use, listed by [`Instance::listed`]; 0 in a single-level tree.
    pub live: u32,
    /// Number of lights of a single-level tree.
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
            #[cfg(not(target_arch = "spirv"))]
            top: self.top,
            first: self.first,
            root: self.root,
            instances: self.instances,
            trails: self.trails,
            links: self.links,
            trail_words: self.trail_words,
            live: self.live,
            lights: self.lights,
            depth: self.depth,
            importance: PhantomData,
        }
    }

    /// The path to triangle `triangle` of the bottom level of instance `instance` (`u32::MAX` in a single-level tree).
    /// Indices out of range give a path that leads elsewhere; no access is out of range.
    #[inline]
    #[must_use]
    pub(crate) fn path_of(&self, triangle: u32, instance: u32) -> Path {
        let bottom = self.trail(triangle);
        if instance < self.instances.len() as u32 {
            Path {
                top: self.trail_to(self.place_of(instance, bottom)),
                bottom,
            }
        } else {
            Path {
                top: bottom,
                bottom: BitTrail { low: 0, high: 0 },
            }
        }
    }

    /// The place of the leaf of the top level below which a triangle of `instance` lies, whose trail in the bottom level is
    /// `bottom`: that of the instance, or of the one of its parts.
    #[inline]
    fn place_of(&self, instance: u32, bottom: BitTrail) -> u32 {
        let place = self.links.place(instance);
        if place != INVALID && place >= OPENED {
            self.links
                .part((place - OPENED).wrapping_add(bottom.slot::<W>(0)))
        } else {
            place
        }
    }

    /// Trail of a place in the top level, from there up: at most as many steps as a tree has levels, for any words.
    #[inline]
    fn trail_to(&self, place: u32) -> BitTrail {
        let mut trail = BitTrail { low: 0, high: 0 };
        let mut place = place;
        let mut steps = 0;
        while place < OPENED && steps < max_levels(W) {
            let (node, slot) = place_parts::<W>(place);
            trail = trail.behind::<W>(slot);
            place = self.links.above(node);
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

/// Bit of an instance's place: it is opened, and the other bits say where the places of its parts begin.
pub const OPENED: u32 = 1 << 31;

/// Links of the top level upward: by leaf and by node the [place](crate::trail::place) in the node above, so that a subtree
/// moves by one word.
#[derive(Clone, Copy, Debug, Default)]
pub struct Links<'a> {
    /// By node of the top level; `u32::MAX` for its root.
    #[cfg(not(target_arch = "spirv"))]
    pub above: &'a [u32],
    /// By instance: its place; if opened, bit [`OPENED`] and the start of its parts in `parts`; `u32::MAX` if it is no leaf.
    #[cfg(not(target_arch = "spirv"))]
    pub places: &'a [u32],
    /// Places of the parts of opened instances, that of slot k of the mesh's root k further.
    #[cfg(not(target_arch = "spirv"))]
    pub parts: &'a [u32],
    /// A device has all three behind the trails, in one buffer.
    #[cfg(target_arch = "spirv")]
    words: &'a [u32],
    #[cfg(target_arch = "spirv")]
    starts: [u32; 3],
}

impl<'a> Links<'a> {
    /// The links in `words`, whose lists begin at `above`, `places` and `parts`.
    #[inline(always)]
    #[must_use]
    pub fn within(words: &'a [u32], above: u32, places: u32, parts: u32) -> Self {
        #[cfg(target_arch = "spirv")]
        {
            Self {
                words,
                starts: [above, places, parts],
            }
        }
        #[cfg(not(target_arch = "spirv"))]
        {
            let from = |start: u32| words.get(start as usize..).unwrap_or(&[]);
            Self {
                above: from(above),
                places: from(places),
                parts: from(parts),
            }
        }
    }

    #[inline(always)]
    fn above(&self, node: u32) -> u32 {
        #[cfg(target_arch = "spirv")]
        return entry(self.words, self.starts[0].wrapping_add(node));
        #[cfg(not(target_arch = "spirv"))]
        entry(self.above, node)
    }

    #[inline(always)]
    fn place(&self, instance: u32) -> u32 {
        #[cfg(target_arch = "spirv")]
        return entry(self.words, self.starts[1].wrapping_add(instance));
        #[cfg(not(target_arch = "spirv"))]
        entry(self.places, instance)
    }

    #[inline(always)]
    fn part(&self, part: u32) -> u32 {
        #[cfg(target_arch = "spirv")]
        return entry(self.words, self.starts[2].wrapping_add(part));
        #[cfg(not(target_arch = "spirv"))]
        entry(self.parts, part)
    }
}

#[inline(always)]
fn entry(words: &[u32], index: u32) -> u32 {
    if index < words.len() as u32 {
        words[index as usize]
    } else {
        INVALID
    }
}

/// The nine words of a [`LightTree`] besides its arrays, for push constants. They may change with every edit.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct TreeWords {
    /// Index of the node that a walk starts at.
    pub root: u32,
    /// Words per bit trail, 1 or 2.
    pub trail_words: u32,
    /// Number of instances in use; 0 in a single-level tree.
    pub live: u32,
    /// Number of lights of a single-level tree.
    pub lights: u32,
    /// Greatest number of nodes on a path.
    pub depth: u32,
    /// Index of the top level's first node in `nodes`; links within it count from there.
    pub top: u32,
    /// First words of [`Links`] in `trails`: those of nodes, of instances, of parts.
    pub above: u32,
    /// See `above`.
    pub places: u32,
    /// See `above`.
    pub parts: u32,
}

impl TreeWords {
    /// The tree over the arrays of a device, as `lightbvh_gpu::Mirror` lays them out: the nodes of bottom levels and of the top
    /// level, the instances, the trails and links.
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
            #[cfg(not(target_arch = "spirv"))]
            top: nodes,
            first: self.top,
            root: self.root,
            instances,
            trails,
            links: Links::within(trails, self.above, self.places, self.parts),
            trail_words: self.trail_words,
            live: self.live,
            lights: self.lights,
            depth: self.depth,
            importance: PhantomData,
        }
    }
}
