//! What follows from the words that were read: links are walked before anything trusts them, then all is refitted.

use crate::model::{Model, SummaryOf};
use alloc::vec::Vec;
use core::ops::Range;

use super::header::Header;
use super::words::{ReadError, damaged, misplaced, taken};
use crate::bvh::Bvh;
use crate::bvh::apply::NO_INSTANCE;
use crate::bvh::log::Log;
use crate::bvh::validate::Found;
use crate::node::kind;
use crate::refit::{BlasRoot, has_limits};
use crate::summary::Summary;
use crate::trail::{leaf, leaf_parts, trail_words};
use crate::transform::Transform;
use crate::tree::INVALID;

const NODES: &str = "nodes";
const LEAVES: &str = "leaves of the top level";

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    pub(super) fn restore(&mut self, header: &Header) -> Result<(), ReadError> {
        self.restore_lists()?;
        self.restore_lights(header)?;
        self.restore_meshes()?;
        self.instances = alloc::vec![NO_INSTANCE; self.placed.len()];
        for (instance, &listed) in self.instances.iter_mut().zip(&self.live) {
            instance.listed = listed;
        }
        for index in self.live.clone() {
            self.place(index);
        }
        if self.single {
            self.top.build(&self.params);
            self.stale.clear();
            self.check_single()?;
        } else {
            self.restore_top()?;
        }
        self.log = Log::default();
        Ok(())
    }

    /// The list of instances in use, and each mesh's.
    fn restore_lists(&mut self) -> Result<(), ReadError> {
        let live = self.placed.iter().filter(|placed| placed.live);
        self.live = alloc::vec![INVALID; live.clone().count()];
        for placed in live {
            self.meshes[placed.mesh as usize].users.push(INVALID);
        }
        for (index, placed) in (0..).zip(&self.placed).filter(|(_, placed)| placed.live) {
            let users = &mut self.meshes[placed.mesh as usize].users;
            for (list, at) in [(users, placed.user), (&mut self.live, placed.listed)] {
                match list.get_mut(at as usize) {
                    Some(entry) if *entry == INVALID => *entry = index,
                    _ => return Err(misplaced("instances in lists")),
                }
            }
        }
        Ok(())
    }

    /// Which numbers of lights are free.
    fn restore_lights(&mut self, header: &Header) -> Result<(), ReadError> {
        let live = self.placed.iter().filter(|placed| placed.live);
        let mut used: Vec<Range<u32>> = live.map(|placed| placed.numbers.clone()).collect();
        self.light_count = used.iter().map(ExactSizeIterator::len).sum();
        let waiting = &self.removed_lights[usize::from(self.forgotten)..];
        self.waiting_lights = waiting.iter().map(ExactSizeIterator::len).sum();
        used.extend_from_slice(waiting);
        self.numbers = taken(header.numbers, used, "lights")?;
        if header.numbers != self.view().light_end() {
            return Err(misplaced("the end of the lights' numbers"));
        }
        Ok(())
    }

    fn restore_meshes(&mut self) -> Result<(), ReadError> {
        self.trail_words = trail_words(W, self.bottom_depth);
        self.trails = alloc::vec![0; self.lights.len() * self.trail_words as usize];
        self.roots = alloc::vec![BlasRoot::new(INVALID, &<SummaryOf<M, W>>::EMPTY); self.meshes.len()];
        let mut seen = alloc::vec![false; self.nodes.len()];
        let mut leaves = alloc::vec![false; self.lights.len()];
        for index in 0..self.meshes.len() {
            let mesh = &self.meshes[index];
            if !mesh.live {
                continue;
            }
            let (nodes, lights) = (mesh.nodes.clone(), mesh.lights.clone());
            if !nodes.is_empty() {
                let found = Found::of(&self.nodes, nodes.start, kind::LIGHT, &mut seen).map_err(damaged)?;
                found.check_depth_first(&nodes).map_err(|_| misplaced(NODES))?;
                if found.depth > self.bottom_depth || found.leaves.len() != lights.len() {
                    return Err(misplaced(NODES));
                }
                for own in &found.leaves {
                    // As many as there are lights, each for the first time: so all of them.
                    let is_own = lights.contains(&own.link);
                    if !is_own || core::mem::replace(&mut leaves[own.link as usize], true) {
                        return Err(misplaced(NODES));
                    }
                    self.set_trail(own.link, own.trail);
                }
                self.meshes[index].depth = found.depth;
            }
            // Instances and their leaves are computed afterwards.
            let users = core::mem::take(&mut self.meshes[index].users);
            self.sweep_mesh(index as u32);
            self.meshes[index].users = users;
        }
        Ok(())
    }

    fn restore_top(&mut self) -> Result<(), ReadError> {
        let length = self.placed.len();
        self.top.places = alloc::vec![INVALID; length];
        self.top.leaves = alloc::vec![None; length];
        if has_limits::<M::Node, W>() {
            self.top.limits = alloc::vec![crate::beam::Limits::NONE; length];
        }
        for index in self.live.clone() {
            let child = self.leaf_of(leaf(index, 0));
            self.top.leaves[index as usize] = Some(child.summary.to_words());
            if has_limits::<M::Node, W>() {
                self.top.limits[index as usize] = child.limits;
            }
        }
        self.top.count = self.live.len() as u32;
        let mut opened = core::mem::take(&mut self.top.opened);
        for (&index, own) in &mut opened {
            own.parts = self.parts_of(index);
            if !self.placed[index as usize].live || own.parts.len() < 2 {
                return Err(misplaced(LEAVES));
            }
        }
        self.top.opened = opened;
        let mut seen = alloc::vec![false; self.top.nodes.len()];
        let found = Found::of(&self.top.nodes, self.top.root, kind::MESH, &mut seen);
        let found = found.map_err(damaged)?;
        let used = self.top.shapes.iter().filter(|shape| shape.height > 0).count();
        let is_used = |&(_, node): &(u32, u32)| self.top.shapes[node as usize].height > 0;
        let is_whole = used + self.top.free.len() == self.top.nodes.len();
        if !is_whole || found.levels.len() != used || !found.levels.iter().all(is_used) {
            return Err(misplaced(NODES));
        }
        let mut leaves: Vec<u32> = found.leaves.iter().map(|own| own.link).collect();
        let is_leaf = |&link: &u32| {
            let (instance, _) = leaf_parts(link);
            self.placed.get(instance as usize).is_some_and(|own| own.live) && self.top.has_leaf(link)
        };
        if !leaves.iter().all(is_leaf) {
            return Err(misplaced(LEAVES));
        }
        leaves.sort_unstable();
        if leaves.windows(2).any(|pair| pair[0] == pair[1]) {
            return Err(misplaced(LEAVES));
        }
        self.top.note_places::<W>();
        found
            .upward()
            .into_iter()
            .for_each(|node| self.top.refit_node(node));
        // A BVH written before a refit may have gaps and unplaced instances.
        self.top.note_gaps::<W>();
        let unplaced = self.unplaced();
        let stale = core::mem::take(&mut self.stale);
        for &index in &stale {
            self.placed[index as usize].is_stale = false;
        }
        unplaced.into_iter().for_each(|index| self.mark_stale(index));
        self.refit_top();
        self.top.written = Default::default();
        Ok(())
    }

    /// Whether it is one mesh that stands where it is.
    fn check_single(&self) -> Result<(), ReadError> {
        let is_alone = match (&*self.placed, &*self.meshes) {
            ([placed], [mesh]) => {
                placed.live
                    && mesh.live
                    && placed.transform == Transform::IDENTITY
                    && placed.radiance == [1.0; 3]
                    && placed.mask == u32::MAX
                    && placed.numbers.start == 0
                    && mesh.lights.start == 0
            }
            // Over no lights.
            ([], []) => true,
            _ => false,
        };
        if is_alone {
            Ok(())
        } else {
            Err(misplaced("the single level"))
        }
    }
}
