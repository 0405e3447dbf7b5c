//! Meshes: their lights, and trees over them, each in its own range of nodes.

use crate::model::{Model, SummaryOf};
use alloc::vec::Vec;
use core::ops::Range;

use super::Bvh;
use super::area::is_by_area;
use super::edit::MeshId;
use super::log::Entry;
use super::records::{Mesh, put};
use super::refit::SWEPT;
use crate::build::Topology;
#[cfg(feature = "std")]
use crate::build::build_over;
use crate::light::Light;
#[cfg(feature = "std")]
use crate::node::Holds;
use crate::node::{Node, kind};
use crate::refit::BlasRoot;
use crate::summary::Summary;
use crate::sweep;
use crate::trail::{BitTrail, trail_words};
use crate::transform::reach_of;
use crate::tree::INVALID;

/// A new tree over the lights of a mesh, which replaces its tree.
#[cfg(feature = "std")]
#[derive(Debug)]
pub(crate) struct MeshTree<N: Holds> {
    mesh: u32,
    generation: u32,
    /// The mesh's [version](Mesh::version) that it was built for.
    version: u64,
    lights: Vec<N::Light>,
    topology: Option<Topology<N>>,
}

#[cfg(feature = "std")]
impl<N: Holds> MeshTree<N> {
    /// Builds the tree, and computes its nodes.
    pub fn build<const W: usize>(&mut self, params: &crate::build::BuildParams)
    where
        N: Node<W>,
    {
        let mut topology = build_over::<N, W>(&self.lights, params);
        sweep::bottom_sweep(&mut topology.nodes, 0, &self.lights);
        self.topology = Some(topology);
    }
}

impl<M: Model<W>, const W: usize> Bvh<M, W> {
    /// Adds a mesh with the tree of `topology`, whose primitives are numbered from 0.
    pub(super) fn insert_mesh(&mut self, lights: &[M::Light], topology: &Topology<M::Node>) -> MeshId {
        let index = self.mesh_ranges.take(1).start;
        let range = self.light_ranges.take(lights.len() as u32);
        let generation = self
            .meshes
            .get(index as usize)
            .map_or(0, |old| old.generation + 1);
        let mesh = Mesh {
            live: true,
            generation,
            lights: range,
            reach: reach_of(lights),
            is_by_area: is_by_area(lights),
            ..Mesh::default()
        };
        put(&mut self.meshes, index, mesh);
        put(
            &mut self.roots,
            index,
            BlasRoot::new(INVALID, &<SummaryOf<M, W>>::EMPTY),
        );
        self.put_lights(index, 0, lights);
        if self.is_alone(lights.len()) {
            // An old trail may stay: none is followed.
            self.log.push(Entry::Tree(index));
        } else {
            self.place_tree(index, topology);
        }
        self.sweep_mesh(index);
        self.id_of_mesh(index)
    }

    /// Removes a mesh.
    pub(super) fn take_mesh(&mut self, index: u32) {
        let mesh = &mut self.meshes[index as usize];
        mesh.live = false;
        let (nodes, lights) = (mesh.nodes.start..mesh.capacity, mesh.lights.clone());
        (mesh.nodes, mesh.capacity, mesh.lights) = (0..0, 0, 0..0);
        self.node_ranges.give(nodes);
        self.light_ranges.give(lights);
        self.mesh_ranges.give(index..index + 1);
        self.dirty.remove(&index);
        self.reshaped.remove(&index);
    }

    /// Writes lights of a mesh from its `first`-th on, and marks them for refit.
    pub(super) fn write_lights(&mut self, index: u32, first: u32, lights: &[M::Light]) {
        if lights.is_empty() {
            return;
        }
        let range = self.put_lights(index, first, lights);
        let mesh = &mut self.meshes[index as usize];
        let count = mesh.lights.len();
        mesh.version += 1;
        if mesh.nodes.len() > 1 {
            self.reshaped.insert(index);
        }
        let all = range.len() == count;
        match all {
            true => self.log.push(Entry::Mesh(index)),
            false => self.log.push(Entry::Paths(index, range.clone())),
        }
        match self.dirty.get_mut(&index) {
            _ if all => _ = self.dirty.insert(index, Vec::new()),
            Some(ranges) if ranges.is_empty() => {}
            // The refit then sweeps the whole mesh.
            Some(ranges) if ranges.len() * SWEPT >= count => ranges.clear(),
            Some(ranges) => ranges.push(range),
            None => _ = self.dirty.insert(index, alloc::vec![range]),
        }
    }

    fn put_lights(&mut self, index: u32, first: u32, lights: &[M::Light]) -> Range<u32> {
        let start = self.meshes[index as usize].lights.start + first;
        let range = start..start + lights.len() as u32;
        if self.lights.len() < range.end as usize {
            self.lights.resize(range.end as usize, M::Light::DARK);
            self.trails
                .resize(range.end as usize * self.trail_words as usize, 0);
        }
        let own = &mut self.lights[range.start as usize..range.end as usize];
        for (to, from) in own.iter_mut().zip(lights) {
            *to = from.of_mesh(index);
        }
        self.log.push(Entry::Lights(range.clone()));
        let by_area = self.goes_by_area(index);
        if core::mem::replace(&mut self.meshes[index as usize].is_by_area, by_area) != by_area {
            for user in self.meshes[index as usize].users.clone() {
                self.place(user);
            }
        }
        range
    }

    /// Replaces the tree of a mesh; the nodes' summaries are copied as they are. If the nodes exceed the reserved capacity, they
    /// move, and all instances get the new root.
    pub(super) fn place_tree(&mut self, index: u32, topology: &Topology<M::Node>) {
        let count = topology.nodes.len() as u32;
        let mesh = &self.meshes[index as usize];
        let (mut start, first) = (mesh.nodes.start, mesh.lights.start);
        if mesh.capacity - start < count {
            self.node_ranges.give(start..mesh.capacity);
            // A later tree over as many lights may have a few nodes more.
            let reserved = self.node_ranges.take(count + count / 8);
            start = reserved.start;
            self.meshes[index as usize].capacity = reserved.end;
            if self.nodes.len() < reserved.end as usize {
                self.nodes.resize(reserved.end as usize, M::Node::EMPTY);
            }
            for user in self.meshes[index as usize].users.clone() {
                self.instances[user as usize].root = start;
                self.log.push(Entry::Instance(user));
            }
        }
        let own = &mut self.nodes[start as usize..(start + count) as usize];
        own.copy_from_slice(&topology.nodes);
        for node in own {
            for slot in 0..W {
                match node.kind(slot) {
                    kind::INNER => node.relink(slot, start + node.link(slot)),
                    kind::LIGHT => node.relink(slot, first + node.link(slot)),
                    _ => {}
                }
            }
        }
        let mesh = &mut self.meshes[index as usize];
        mesh.nodes = start..start + count;
        mesh.depth = topology.depth;
        self.bottom_depth = self.bottom_depth.max(topology.depth);
        self.place_trails(index, topology);
        self.log.push(Entry::Tree(index));
        self.compute_root(index);
    }

    /// Computes all nodes of a mesh.
    pub(super) fn sweep_mesh(&mut self, index: u32) {
        let nodes = self.meshes[index as usize].nodes.clone();
        let own = &mut self.nodes[nodes.start as usize..nodes.end as usize];
        sweep::bottom_sweep(own, nodes.start, &self.lights);
        self.compute_root(index);
    }

    /// Whether a mesh with this number of lights has no nodes.
    pub(super) fn is_alone(&self, lights: usize) -> bool {
        lights == 1 && !self.single
    }

    /// The root record of a mesh.
    pub(super) fn root_of(&self, index: u32) -> BlasRoot {
        let mesh = &self.meshes[index as usize];
        match mesh.root() {
            INVALID => {
                let light = &self.lights[mesh.lights.start as usize];
                BlasRoot::new(INVALID, &<SummaryOf<M, W>>::of_light(light))
            }
            root => BlasRoot::new(root, &self.nodes[root as usize].merged()),
        }
    }

    /// Computes the root record of a mesh, and marks the leaves of its instances for refit.
    pub(super) fn compute_root(&mut self, index: u32) {
        self.roots[index as usize] = self.root_of(index);
        for place in 0..self.meshes[index as usize].users.len() {
            self.mark_stale(self.meshes[index as usize].users[place]);
        }
    }

    fn place_trails(&mut self, index: u32, topology: &Topology<M::Node>) {
        let mesh = self.meshes[index as usize].lights.clone();
        if self.trail_words == 1 && trail_words(W, topology.depth) == 2 {
            self.trail_words = 2;
            let narrow = core::mem::take(&mut self.trails);
            self.trails = narrow.into_iter().flat_map(|low| [low, 0]).collect();
            // All trails changed: mirrors copy everything.
            self.log = super::Log::after(&self.log);
        }
        for &(light, trail) in &topology.trails {
            self.set_trail(mesh.start + light, trail);
        }
    }

    pub(super) fn set_trail(&mut self, light: u32, trail: BitTrail) {
        let words = self.trail_words as usize;
        let at = light as usize * words;
        self.trails[at..at + words].copy_from_slice(&[trail.low, trail.high][..words]);
    }

    /// The trail of a light of a mesh.
    pub(super) fn trail_of(&self, light: u32) -> BitTrail {
        let at = light as usize * self.trail_words as usize;
        BitTrail {
            low: self.trails[at],
            high: if self.trail_words == 2 {
                self.trails[at + 1]
            } else {
                0
            },
        }
    }

    /// Each mesh that changed since its tree was built, with the bytes of its lights: those from `first` on, then those
    /// before.
    #[cfg(feature = "std")]
    pub(crate) fn reshaped_from(&self, first: u32) -> impl Iterator<Item = (u32, usize)> + '_ {
        let after = self.reshaped.range(first..);
        let all = after.chain(self.reshaped.range(..first));
        all.map(|&mesh| {
            let count = self.meshes[mesh as usize].lights.len();
            (mesh, count * size_of::<M::Light>())
        })
    }

    /// A copy of the lights of a mesh, to build its tree from.
    #[cfg(feature = "std")]
    pub(crate) fn copy_mesh(&self, mesh: u32) -> MeshTree<M::Node> {
        let own = &self.meshes[mesh as usize];
        let range = own.lights.start as usize..own.lights.end as usize;
        MeshTree {
            mesh,
            generation: own.generation,
            version: own.version,
            lights: self.lights[range].to_vec(),
            topology: None,
        }
    }

    /// Replaces the tree of its mesh; false if the mesh was removed.
    #[cfg(feature = "std")]
    pub(crate) fn install_mesh(&mut self, tree: &MeshTree<M::Node>) -> bool {
        let index = tree.mesh;
        let own = self
            .meshes
            .get(index as usize)
            .filter(|own| own.live && own.generation == tree.generation);
        let (Some(version), Some(topology)) = (own.map(|own| own.version), &tree.topology) else {
            return false;
        };
        self.place_tree(index, topology);
        if version == tree.version {
            self.reshaped.remove(&index);
        } else {
            self.dirty.insert(index, Vec::new());
            self.log.push(Entry::Mesh(index));
        }
        true
    }
}
