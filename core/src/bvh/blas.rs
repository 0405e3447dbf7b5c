//! Bottom levels: built when a mesh comes in or a new shape needs one, and placed among the nodes.

use alloc::boxed::Box;
use alloc::vec::Vec;
use core::ops::Range;

use super::known_flux::KnownFlux;
use super::powers::Powers;
use super::stage::{Outgoing, Staged};
use super::{Bvh, Trails};
use crate::build::Topology;
use crate::levels::Levels;
use crate::light::Light;
use crate::node::{Node, kind};
use crate::refit::{self, BlasRoot};
use crate::summary::Summary;
use crate::sweep;
use crate::trail::{BitTrail, trail_words};
use crate::transform::Extent;
use crate::tree::INVALID;

/// A tree over triangles in a space of their own.
#[derive(Clone, Debug)]
pub(super) struct Blas {
    /// Its nodes, the root first; empty where the index is not in use.
    pub nodes: Range<u32>,
    pub triangles: Range<u32>,
    /// The mesh that it belongs to.
    pub mesh: u32,
    /// Its nodes, unless `is_unlisted`: then they have to be listed first.
    pub levels: Levels,
    pub is_unlisted: bool,
    /// Nodes for whose subtrees none of as many nodes was found, so that parts below them are tried, until these are of another
    /// tree.
    pub misfits: Vec<u32>,
    pub depth: u32,
    pub extent: Extent,
    /// How the flux of its lights grows with an instance's scale.
    pub powers: Powers,
    /// Its flux as the top level was built for it, and whether that was less once.
    pub known_flux: KnownFlux,
    /// The centre of its lights as its instances were put where they are, in their space; NaN before it is known.
    pub center: [f32; 3],
    /// When its topology was made.
    pub created: u64,
    /// When what is known of it as a whole changed last.
    pub changed: u64,
    /// When more than one in 32 of its triangles changed in one frame last.
    pub stirred: u64,
    /// The tree that is to take its place.
    pub staged: Option<Box<Staged>>,
    /// The stage that made this one.
    pub adopted: u64,
    /// What is known of its parts, among the roots, where instances of it are opened.
    pub parts: Range<u32>,
    /// How many are.
    pub opened: u32,
    /// Triangles that changed since the tree was made, those that are brighter than the others counting as so many more.
    pub unsettled: u32,
    /// Whether a tree came to nothing since instances are opened into another number of parts: the next one waits until they
    /// are closed.
    pub is_staged_only: bool,
    /// The tree that was the mesh's before this one, while instances still follow it.
    pub outgoing: Option<Outgoing>,
    /// Whether this is such a tree.
    pub is_outgoing: bool,
    /// Whether all its triangles were set since its nodes were computed.
    pub is_stale: bool,
}

impl Blas {
    /// One of nothing yet, of that mesh.
    pub fn none<L: Light>(mesh: u32) -> Self {
        Self {
            nodes: 0..0,
            triangles: 0..0,
            mesh,
            levels: Levels::default(),
            is_unlisted: false,
            misfits: Vec::new(),
            depth: 0,
            extent: Extent::of::<L>(&[]),
            powers: Powers::default(),
            known_flux: KnownFlux::default(),
            center: [f32::NAN; 3],
            created: 0,
            changed: 0,
            stirred: 0,
            staged: None,
            adopted: 0,
            parts: 0..0,
            opened: 0,
            unsettled: 0,
            is_staged_only: false,
            outgoing: None,
            is_outgoing: false,
            is_stale: false,
        }
    }
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// A bottom level over `triangles`, as `topology` has it, whose primitives are numbered from 0; returns its index.
    pub(super) fn add_blas(&mut self, mesh: u32, triangles: &[N::Light], mut topology: Topology<N>) -> u32 {
        let index = self.blas_ranges.take(1).start;
        let range = self.triangle_ranges.take(triangles.len() as u32);
        let empty = Blas {
            triangles: range.clone(),
            extent: Extent::of(triangles),
            powers: Powers::of(triangles),
            ..Blas::none::<N::Light>(mesh)
        };
        // Places before it that a stage keeps hold nothing yet.
        put(&mut self.blases, index, empty, &Blas::none::<N::Light>(INVALID));
        put(
            &mut self.roots,
            index,
            BlasRoot::new(INVALID, &N::Summary::EMPTY),
            &BlasRoot::new(INVALID, &N::Summary::EMPTY),
        );
        self.write_triangles(index, triangles);
        topology.move_primitives::<W>(range.start);
        self.place_blas(index, &topology);
        let root = self.root_of(index);
        let own = &mut self.blases[index as usize];
        own.known_flux = KnownFlux::of(root.phi());
        if root.phi() > 0.0 {
            own.center = root.center().to_array();
        }
        index
    }

    /// What is known of a bottom level as a whole.
    pub(super) fn root_of(&self, blas: u32) -> N::Summary {
        self.roots[blas as usize].summary()
    }

    /// The bottom level of a mesh, whose number changes with its tree.
    #[cfg(test)]
    pub(super) fn of_mesh(&self, mesh: u32) -> &Blas {
        &self.blases[self.meshes[mesh as usize].blas as usize]
    }

    /// Takes a bottom level out.
    pub(super) fn remove_blas(&mut self, index: u32) {
        self.drop_stage(index);
        let blas = &mut self.blases[index as usize];
        let (nodes, triangles) = (blas.nodes.clone(), blas.triangles.clone());
        blas.nodes = 0..0;
        blas.triangles = 0..0;
        blas.levels = Levels::default();
        blas.is_unlisted = false;
        blas.misfits = Vec::new();
        blas.changed = blas.created;
        self.changes.forget_blas(index);
        self.node_ranges.give(nodes);
        self.triangle_ranges.give(triangles);
        self.blas_ranges.give(index..index + 1);
    }

    /// Writes the triangles of a bottom level and marks it for refit.
    pub(super) fn write_triangles(&mut self, index: u32, triangles: &[N::Light]) {
        self.put_triangles(index, 0, triangles);
        self.changes.new.mark_blas(index);
        self.blases[index as usize].is_stale = true;
    }

    /// Writes those of its triangles that begin with its `first`-th, and marks them for refit.
    pub(super) fn write_triangle_range(&mut self, index: u32, first: u32, triangles: &[N::Light]) {
        if triangles.is_empty() {
            return;
        }
        let range = self.put_triangles(index, first, triangles);
        if range.len() == self.blases[index as usize].triangles.len() {
            self.changes.new.mark_blas(index);
            self.blases[index as usize].is_stale = true;
        } else {
            self.changes.new.parts.push(range);
        }
    }

    fn put_triangles(&mut self, index: u32, first: u32, triangles: &[N::Light]) -> Range<u32> {
        self.hand_over_all(index);
        let start = self.blases[index as usize].triangles.start + first;
        let range = start..start + triangles.len() as u32;
        self.cover_triangles(range.end);
        let powers = self.powers_with(index, range.clone(), triangles);
        self.unsettle_mesh(index, triangles);
        let own = &mut self.triangles[range.start as usize..range.end as usize];
        for (to, from) in own.iter_mut().zip(triangles) {
            *to = from.of_mesh(index);
        }
        self.changes.new.written_triangles.push(range.clone());
        self.write_staged(index, first, triangles.len() as u32);
        self.set_powers(index, powers);
        range
    }

    /// Makes room for triangles up to `end`.
    pub(super) fn cover_triangles(&mut self, end: u32) {
        if self.triangles.len() < end as usize {
            let dark = N::Light::DARK;
            self.triangles.resize(end as usize, dark);
        }
    }

    /// Makes room for nodes up to `end`.
    pub(super) fn cover_nodes(&mut self, end: u32) {
        if self.nodes.len() < end as usize {
            self.nodes.resize(end as usize, N::EMPTY);
            self.parents.resize(end as usize, INVALID);
        }
    }

    /// Puts the nodes of `topology` in place of those that bottom level `index` had.
    pub(super) fn place_blas(&mut self, index: u32, topology: &Topology<N>) {
        self.drop_stage(index);
        self.hand_over_all(index);
        let old = self.blases[index as usize].nodes.clone();
        self.node_ranges.give(old);
        let nodes = self.place_nodes(&topology.nodes);
        self.bottom_depth = self.bottom_depth.max(topology.depth);
        if T::KEPT {
            self.place_trails(index, topology);
        }
        let levels = Levels::gather(topology.leveled(nodes.start));
        self.epoch += 1;
        let created = self.epoch;
        let blas = &mut self.blases[index as usize];
        blas.nodes = nodes.clone();
        blas.levels = levels;
        blas.is_unlisted = false;
        blas.misfits.clear();
        blas.unsettled = 0;
        blas.is_stale = false;
        blas.depth = topology.depth;
        blas.created = created;
        self.roots[index as usize].node = nodes.start;

        let range = nodes.start as usize..nodes.end as usize;
        sweep::bottom_sweep(
            &mut self.nodes[range],
            nodes.start,
            &self.triangles,
            &[nodes.start],
        );
        self.roots[index as usize] = refit::root(&self.nodes, nodes.start);
        self.judge_range(nodes.clone(), true);
        self.note_size(self.blas_len(index), nodes.len());
        self.changes.new.mark_built(index);
    }

    /// Room for `nodes`, their links moved to where they stand then; sets the parents.
    pub(super) fn place_nodes(&mut self, nodes: &[N]) -> Range<u32> {
        let range = self.node_ranges.take(nodes.len() as u32);
        self.cover_nodes(range.end);
        let base = range.start;
        self.parents[base as usize] = INVALID;
        for (i, node) in (base..).zip(nodes) {
            let mut moved = *node;
            for slot in 0..W {
                if node.kind(slot) == kind::INNER {
                    let link = base + node.link(slot);
                    moved.relink(slot, link);
                    self.parents[link as usize] = i;
                }
            }
            self.nodes[i as usize] = moved;
        }
        self.changes.new.written_nodes.push(range.clone());
        range
    }

    /// The trails of the triangles of bottom level `index`.
    fn place_trails(&mut self, index: u32, topology: &Topology<N>) {
        self.reserve_trails(topology.depth, self.blases[index as usize].triangles.end);
        let words = self.trail_words as usize;
        for &(triangle, trail) in &topology.trails {
            let at = triangle as usize * words;
            self.trails[at] = trail.low;
            if words == 2 {
                self.trails[at + 1] = trail.high;
            }
        }
        self.changes
            .new
            .written_trails
            .push(self.blases[index as usize].triangles.clone());
    }

    /// The trail of a triangle, where trails are kept.
    pub(super) fn trail_of(&self, triangle: u32) -> BitTrail {
        let at = triangle as usize * self.trail_words as usize;
        BitTrail {
            low: self.trails[at],
            high: if self.trail_words == 2 {
                self.trails[at + 1]
            } else {
                0
            },
        }
    }

    /// Makes trails as wide as trees of `depth` levels need, for all triangles, and room for those up to `end`.
    pub(super) fn reserve_trails(&mut self, depth: u32, end: u32) {
        if self.trail_words == 1 && trail_words(W, depth) == 2 {
            self.trail_words = 2;
            let narrow = core::mem::take(&mut self.trails);
            self.trails = narrow.into_iter().flat_map(|low| [low, 0]).collect();
            self.changes
                .new
                .written_trails
                .push(0..self.trails.len() as u32 / 2);
        }
        let length = end as usize * self.trail_words as usize;
        if self.trails.len() < length {
            self.trails.resize(length, 0);
        }
    }
}

/// Sets `list[index]`, with `filler` up to there.
pub(super) fn put<T: Clone>(list: &mut Vec<T>, index: u32, value: T, filler: &T) {
    if list.len() <= index as usize {
        list.resize(index as usize + 1, filler.clone());
    }
    list[index as usize] = value;
}
