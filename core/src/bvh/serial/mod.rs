//! A light BVH as words, to be kept in a file and read again.
//!
//! Only what cannot be computed is written: lights, transforms, links, and what later edits depend on (which places are
//! free, the order of lists, how far apart the children of a node were). Nodes' summaries, instances' words, trails
//! and levels are computed again, by the functions that a refit calls: they are bit-identical on every machine.
//! `docs/format.md` lists every word.

mod header;
mod read;
mod restore;
#[cfg(test)]
mod tests;
mod words;
mod write;

pub use header::FORMAT;
pub use words::ReadError;

use self::words::{Words, damaged};
use super::Bvh;
use crate::model::Model;

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    /// Reads what [`to_words`](Self::to_words) wrote. The BVH goes on as the one that was written: the same samples and pmfs,
    /// and after the same edits, refits and rebuilds the same words if it was refitted when it was written. Places of its
    /// arrays that are not in use hold the words of nothing.
    ///
    /// Numbers of lights stay, those that wait in [`removed_lights`](super::View::removed_lights) too. It is another BVH, so it has ids of its own: [`mesh_id`](super::View::mesh_id) and [`instance_id`](super::View::instance_id) give them
    /// by the indices, which stay; a program that keeps ids in a file keeps [`InstanceId::index`](super::InstanceId::index) and
    /// [`MeshId::index`](super::MeshId::index) in their place. A `Rebuilder` of the one that was written knows nothing of it:
    /// it starts with a new one; where both are to go on alike, so does the one that was written. What was planned for a mirror
    /// is not written: one takes all arrays over, as `lightbvh_gpu::Mirror` does by itself.
    ///
    /// The words may be anything that gives a sound light BVH, damaged ones too: there is no checksum, and a turned bit may be
    /// another lamp. Reading takes time in proportion to them, but for sorting, and for each some 550 bytes of memory at worst
    /// (seen with empty nodes), room to grow among them; then every invariant is checked by [`validate`](super::View::validate), which
    /// takes as much again.
    ///
    /// # Errors
    /// [`ReadError`], which says which word is wrong or what of the tree does not hold.
    pub fn from_words(words: &[u32]) -> Result<Self, ReadError> {
        let mut words = Words { all: words, next: 0 };
        let bvh = Self::read(&mut words)?;
        if words.next < words.all.len() {
            return Err(words.length(words.next));
        }
        bvh.view().validate().map_err(damaged)?;
        Ok(bvh)
    }
}
