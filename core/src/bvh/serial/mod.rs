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
    /// Numbers of lights stay, also those in [`removed_lights`](super::View::removed_lights). The BVH has new ids: get them by index with
    /// [`mesh_id`](super::View::mesh_id) and [`instance_id`](super::View::instance_id). A file keeps [`InstanceId::index`](super::InstanceId::index) and
    /// [`MeshId::index`](super::MeshId::index) in place of ids. Begin with a new `Rebuilder` and new mirrors.
    ///
    /// Any words are safe. There is no checksum: a flipped bit may give another sound light BVH. Takes time in proportion to the words,
    /// except for sorting, and at worst 550 bytes of memory for each; then [`validate`](super::View::validate) takes as much again.
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
