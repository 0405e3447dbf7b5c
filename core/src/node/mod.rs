//! Nodes: the bounds of up to `W` children side by side, each with a link.
//!
//! A node holds its children's bounds, not its own: one fetch per level decides which child to enter. Width and layout
//! are type parameters, so a kernel holds the code of one layout only.

mod compact;
mod full;

pub use compact::CompactNode;
pub use full::FullNode;

use bytemuck::Pod;

use crate::bounds::LightBounds;
use crate::importance::{Cluster, ImportanceModel, to_weights};
use crate::point::Receiver;

/// Version of the node layouts' words; raised whenever a layout changes.
pub const NODE_FORMAT: u32 = 1;

/// What a child's link leads to.
pub mod kind {
    /// No child in this slot.
    pub const EMPTY: u32 = 0;
    /// Another node of the same tree; the link is its index.
    pub const INNER: u32 = 1;
    /// An emissive triangle; the link is its index.
    pub const LIGHT: u32 = 2;
    /// A mesh light (leaf of the top level); the link is its index, its bottom level's root goes on from there.
    pub const MESH: u32 = 3;
}

/// A node of width `W`: plain words, read and written slot by slot.
pub trait LightNode<const W: usize>: Pod + Send + Sync {
    /// A node without children.
    const EMPTY: Self;
    /// Name for tables.
    const NAME: &'static str;

    /// One of [`kind`].
    fn kind(&self, slot: usize) -> u32;
    /// Index of what the child is; see [`kind`].
    fn link(&self, slot: usize) -> u32;
    /// The child's bounds as importance needs them.
    fn cluster(&self, slot: usize) -> Cluster;
    /// The child's bounds as refit and validation need them.
    fn bounds(&self, slot: usize) -> LightBounds;
    /// Sets what the child is; its bounds become empty.
    fn set_child(&mut self, slot: usize, kind: u32, link: u32);
    /// Sets the child's link alone; kind and bounds stay.
    fn relink(&mut self, slot: usize, link: u32);
    /// Takes over child `from` of `other`, word by word.
    fn copy_child(&mut self, slot: usize, other: &Self, from: usize);
    /// Sets the child's bounds, rounded outward; kind and link stay.
    fn set_bounds(&mut self, slot: usize, bounds: &LightBounds);

    /// The children's bounds merged in slot order.
    #[inline]
    fn merged(&self) -> LightBounds {
        let mut merged = LightBounds::EMPTY;
        for slot in 0..W {
            if self.kind(slot) != kind::EMPTY {
                merged = merged.merge(&self.bounds(slot));
            }
        }
        merged
    }

    /// The children's importances at `point` on one scale, and their sum in slot order.
    #[inline(always)]
    fn weights<I: ImportanceModel, R: Receiver>(&self, point: &R) -> ([f32; W], f32) {
        let mut importances = [crate::importance::Importance {
            significand: 0.0,
            exponent: 0,
        }; W];
        for slot in 0..W {
            importances[slot] = I::importance(&self.cluster(slot), point);
        }
        to_weights(&importances)
    }

    /// Bit `slot` is set where the child has importance at `point`: where [`weights`](Self::weights) is positive, without
    /// the cost of scale and sum.
    #[inline(always)]
    fn open<I: ImportanceModel, R: Receiver>(&self, point: &R) -> u32 {
        let mut open = 0;
        for slot in 0..W {
            open |= u32::from(I::reaches(&self.cluster(slot), point)) << slot;
        }
        open
    }

    /// Bit `slot` is set where the child is a light.
    #[inline(always)]
    fn lights(&self) -> u32 {
        let mut lights = 0;
        for slot in 0..W {
            lights |= u32::from(self.kind(slot) == kind::LIGHT) << slot;
        }
        lights
    }
}
