//! Room in the arrays for what is built beside the frames.
//!
//! An array that grows moves all that it holds, which takes longer than a frame may, and memory that is written for the first
//! time costs a page fault for each 4 KiB. So room is reserved as meshes come in, whose calls pay for their triangles anyway;
//! what is reserved takes no memory before it is written. A frame then fills as much of it as it may, before anything is put
//! there.

use alloc::vec::Vec;
use core::ops::Range;

use super::quality::Quality;
use super::{Bvh, Trails};
use crate::node::Node;

/// So many bytes are copied in the time in which one is written for the first time: a page fault is 0.25 µs at best and 10 µs
/// on a virtual machine that has to ask for the page.
const FRESH: usize = 3;
/// So many of the largest mesh find room beside what there is.
const MESHES: usize = 2;
/// And a part of all nodes, for what is built in the place of small trees and of parts of the top level and fits into no hole.
const PART: usize = 4;
/// Bottom levels that find room: new trees of meshes, and parts of opened ones.
const LEAST: usize = 256;

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// A bottom level of so many triangles and nodes is there.
    pub(super) fn note_size(&mut self, triangles: usize, nodes: usize) {
        let [t, n] = self.largest;
        self.largest = [t.max(triangles), n.max(nodes)];
    }

    /// The same of all.
    pub(super) fn note_sizes(&mut self) {
        for blas in 0..self.blases.len() {
            let own = &self.blases[blas];
            self.note_size(own.triangles.len(), own.nodes.len());
        }
    }

    /// Has room for [`MESHES`] new trees of the largest mesh and a few small ones; in no time where it is there. A new tree may
    /// have a few nodes more.
    pub(super) fn reserve_room(&mut self) {
        let [triangles, nodes] = self.largest;
        let triangles = self.triangles.len() + MESHES * triangles;
        let nodes = self.nodes.len() + MESHES * (nodes + nodes / 8) + self.nodes.len() / PART;
        reserve(&mut self.triangles, triangles);
        if T::KEPT {
            reserve(&mut self.trails, triangles * self.trail_words as usize);
        }
        reserve(&mut self.nodes, nodes);
        reserve(&mut self.parents, nodes);
        reserve(&mut self.quality, nodes);
        self.marks.reserve(nodes);
        let bottoms = self.blases.len() + self.blases.len() / PART + LEAST;
        reserve(&mut self.blases, bottoms);
        reserve(&mut self.roots, bottoms);
        self.refitted.reserve(bottoms);
    }

    /// Places for `count` triangles and their trails, once as many are there; makes more of them by at most `bytes`.
    pub(super) fn take_triangles(&mut self, count: u32, bytes: &mut usize) -> Option<Range<u32>> {
        let range = self.triangle_ranges.take(count);
        let words = if T::KEPT { self.trail_words as usize } else { 0 };
        let size = FRESH * (size_of::<N::Light>() + 4 * words);
        let end = next(self.triangles.len(), range.end, size, bytes);
        self.cover_triangles(end);
        if T::KEPT {
            self.reserve_trails(0, end);
        }
        if end < range.end {
            self.triangle_ranges.give(range);
            return None;
        }
        Some(range)
    }

    /// Places for `count` nodes, as [`take_triangles`](Self::take_triangles).
    pub(super) fn take_nodes(&mut self, count: u32, bytes: &mut usize) -> Option<Range<u32>> {
        let range = self.node_ranges.take(count);
        let size = FRESH * (size_of::<N>() + size_of::<Quality>() + 2 * size_of::<u32>());
        let end = next(self.nodes.len(), range.end, size, bytes);
        self.cover_nodes(end);
        let length = self.nodes.len();
        if self.quality.len() < length {
            self.quality.resize(length, Quality::default());
        }
        self.marks.cover(length);
        if end < range.end {
            self.node_ranges.give(range);
            return None;
        }
        Some(range)
    }
}

/// Where an array of `length` entries that is to have `end` may end in this frame, its entries of `size`.
fn next(length: usize, end: u32, size: usize, bytes: &mut usize) -> u32 {
    let more = (end as usize).saturating_sub(length).min(*bytes / size);
    *bytes -= more * size;
    end.min((length + more) as u32)
}

/// Has room for as many entries, where the system has it: nobody has asked for them yet. Where there is not, the list gets
/// twice the room: with no more than is asked for, the next small mesh would move a list that a large one has just moved, 30 ms
/// of 10^6 triangles. And no less than a quarter of what there is, so that meshes that come one by one move it seldom: a list
/// of *n* entries was moved by every third call, *n*² bytes in all.
pub(super) fn reserve<E>(list: &mut Vec<E>, length: usize) {
    let room = length.saturating_sub(list.len());
    if list.capacity() - list.len() < room {
        _ = list.try_reserve_exact((2 * room).max(list.len() / 4));
    }
}

#[cfg(test)]
mod tests {
    use crate::kit::line;
    use crate::{LightBvh, Transform};
    use alloc::vec::Vec;

    /// Where the arrays are, and how long.
    fn places(bvh: &LightBvh) -> [*const (); 5] {
        [
            bvh.nodes.as_ptr().cast(),
            bvh.parents.as_ptr().cast(),
            bvh.triangles.as_ptr().cast(),
            bvh.trails.as_ptr().cast(),
            bvh.quality.as_ptr().cast(),
        ]
    }

    /// Two new trees for the largest mesh find room, filled in pieces, and no array is moved.
    #[test]
    fn what_is_built_beside_the_frames_moves_no_array() {
        let mut bvh = LightBvh::default();
        for count in [400, 3000, 50] {
            let mesh = bvh
                .add_mesh((0..count).map(|k| line(k, 1.0)).collect())
                .expect("a mesh");
            bvh.add_instance(mesh, Transform::IDENTITY).expect("one");
        }
        bvh.refit();
        let before = places(&bvh);
        let (ends, nodes) = (
            [bvh.triangle_ranges.end(), bvh.node_ranges.end()],
            bvh.blases[1].nodes.len() as u32,
        );
        for _ in 0..2 {
            let (mut frames, mut taken) = (0, Vec::new());
            while taken.len() < 2 {
                let bytes = &mut 20_000;
                taken = match taken.len() {
                    0 => bvh.take_triangles(3000, bytes).into_iter().collect(),
                    _ => taken.into_iter().chain(bvh.take_nodes(nodes, bytes)).collect(),
                };
                frames += 1;
            }
            assert!((30..80).contains(&frames), "{frames}");
        }
        assert_eq!(places(&bvh), before);
        assert_eq!(
            [bvh.triangle_ranges.end(), bvh.node_ranges.end()],
            [ends[0] + 6000, ends[1] + 2 * nodes]
        );
        // What fits into a hole needs none.
        bvh.triangle_ranges.give(ends[0]..ends[0] + 3000);
        assert!(bvh.take_triangles(3000, &mut 0).is_some());
    }

    /// Each third call moved all arrays: n² bytes in all, where each of them moves a few times.
    #[test]
    fn meshes_that_come_one_by_one_move_arrays_seldom() {
        let mut bvh = LightBvh::default();
        let mut moved = 0;
        let mut rooms = [0; 3];
        for k in 0..3000 {
            let lamp = [line(k, 1.0)];
            bvh.add_mesh(lamp.to_vec()).expect("a mesh");
            let now = [
                bvh.triangles.capacity(),
                bvh.trails.capacity(),
                bvh.nodes.capacity(),
            ];
            moved += (0..3).filter(|&k| now[k] != rooms[k]).count();
            rooms = now;
        }
        // By a quarter or more each time, from a few entries on.
        assert!(moved <= 3 * 40, "{moved}");
    }

    /// A small mesh that comes after a large one moves no array again.
    #[test]
    fn a_small_mesh_after_a_large_one_moves_no_array() {
        let mut bvh = LightBvh::default();
        let large = (0..5000).map(|k| line(k, 1.0)).collect();
        bvh.add_mesh(large).expect("a mesh");
        let before = places(&bvh);
        for _ in 0..100 {
            let small = (0..40).map(|k| line(k, 1.0)).collect();
            let mesh = bvh.add_mesh(small).expect("a mesh");
            bvh.add_instance(mesh, Transform::IDENTITY).expect("one");
            assert_eq!(places(&bvh), before);
        }
    }

    /// Small trees and parts of the top level find room too, after each edit that brings a mesh.
    #[test]
    fn a_quarter_of_all_nodes_finds_room() {
        let mut bvh = LightBvh::default();
        for k in 0..800 {
            let small = (0..40).map(|k| line(k, 1.0)).collect();
            bvh.add_mesh(small).expect("a mesh");
            let room = [
                bvh.nodes.capacity() - bvh.nodes.len(),
                bvh.parents.capacity() - bvh.parents.len(),
                bvh.quality.capacity() - bvh.quality.len(),
            ];
            assert!(
                room.iter().all(|&room| room >= bvh.nodes.len() / 4),
                "{k}: {room:?}"
            );
        }
    }
}
