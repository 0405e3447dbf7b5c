//! The top level: a wide tree over instances, in arrays of its own.
//!
//! It keeps what it needs of each leaf, so a worker thread can edit and build a copy by the same functions, and a frame swaps
//! the two in constant time. Edits change it leaf by leaf ([`Top::edit`]); [`Top::build`] makes all of it again.

mod build;
mod cost;
mod edit;
mod insert;

use alloc::collections::BTreeMap;
use alloc::vec::Vec;

use crate::beam::Limits;
use crate::exact;
use crate::node::{Node, kind};
use crate::refit::{Child, has_limits};
use crate::summary::{Lanes, SUMMARY_WORDS, Summary};
use crate::trail::{leaf, leaf_parts, place, place_parts};
use crate::tree::{INVALID, Links, OPENED};

pub(crate) use self::build::are_mixed;
pub(crate) use self::cost::Cluster;

/// The words of a leaf's [`Summary`], in the world.
pub(crate) type Words = [f32; SUMMARY_WORDS];

/// The leaves that one frame's edits changed. Lists are parallel.
#[derive(Clone, Debug, Default)]
pub(crate) struct Batch {
    /// Each once.
    pub instances: Vec<u32>,
    /// `None` for a removed one.
    pub leaves: Vec<Option<Words>>,
    /// Empty if the layout stores none.
    pub limits: Vec<Limits>,
    /// The parts of instances that may be opened, in the order of `instances`.
    pub parts: Vec<(u32, Vec<Part>)>,
}

/// A child of the root of an instance's mesh.
pub(crate) type Part = (Words, Limits);

/// An instance that may be opened: the children of its mesh's root, subtrees or lights, are leaves then in its place.
#[derive(Clone, Debug)]
pub(crate) struct Opened {
    /// Start of their places in `parts`; [`INVALID`] while it is closed.
    pub first: u32,
    pub parts: Vec<Part>,
}

/// Position, extent and cost of a node's children.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Shape {
    /// Mean of the children's centres, metres.
    pub center: [f32; 3],
    /// Half extents of the children when a child was last added or removed, metres.
    pub half: [f32; 3],
    /// From the centre of the node above to its own when it was put there, metres; NaN until both are computed.
    pub from: [f32; 3],
    /// Levels from this node down; 0 if the node is free.
    pub height: u32,
    /// Whether `half`, and `from` of children, are still to be computed.
    pub is_changed: bool,
    /// Words of the children's [merged](Node::merged) summary.
    pub words: Words,
    /// The children in the cost of an insertion, those included that were inserted and not computed yet.
    pub cluster: Cluster,
}

/// Lists what edits wrote since it was last taken, for mirrors.
#[derive(Clone, Debug, Default)]
pub(crate) struct Written {
    /// Whether everything is new.
    pub is_whole: bool,
    /// Nodes whose children changed.
    pub links: Vec<u32>,
    /// Nodes that were computed; those above them are not listed.
    pub computed: Vec<u32>,
}

/// The top level.
#[derive(Clone, Debug)]
pub(crate) struct Top<N> {
    pub nodes: Vec<N>,
    pub root: u32,
    /// By node: its place in the node above.
    pub above: Vec<u32>,
    pub shapes: Vec<Shape>,
    /// Nodes not in use, the last one is taken next.
    pub free: Vec<u32>,
    /// By instance: see [`Links::places`].
    pub places: Vec<u32>,
    pub leaves: Vec<Option<Words>>,
    /// By instance; empty if the layout stores none.
    pub limits: Vec<Limits>,
    /// How many instances there are.
    pub count: u32,
    pub opened: BTreeMap<u32, Opened>,
    /// See [`Links::parts`].
    pub parts: Vec<u32>,
    /// Instances that the last build would have looked into, had it known their parts.
    pub wanted: Vec<u32>,
    /// Nodes that lost a child since the last edit.
    pub lost: Vec<u32>,
    pub written: Written,
}

impl<N> Default for Top<N> {
    fn default() -> Self {
        Self {
            nodes: Vec::new(),
            root: 0,
            above: Vec::new(),
            shapes: Vec::new(),
            free: Vec::new(),
            places: Vec::new(),
            leaves: Vec::new(),
            limits: Vec::new(),
            count: 0,
            opened: BTreeMap::new(),
            parts: Vec::new(),
            wanted: Vec::new(),
            lost: Vec::new(),
            written: Written::default(),
        }
    }
}

impl<N> Top<N> {
    /// Number of levels.
    pub fn depth(&self) -> u32 {
        self.shapes[self.root as usize].height
    }

    pub fn links(&self) -> Links<'_> {
        Links {
            above: &self.above,
            places: &self.places,
            parts: &self.parts,
        }
    }

    /// Its nodes in use, by height: an order in which they may be refitted.
    pub fn by_height(&self) -> Vec<(u32, u32)> {
        let used = (0..).zip(&self.shapes).filter(|(_, shape)| shape.height > 0);
        let mut nodes: Vec<(u32, u32)> = used.map(|(node, shape)| (shape.height, node)).collect();
        nodes.sort_unstable();
        nodes
    }

    /// The nodes of `starts` that are in use and all above them, by height.
    pub fn above_some<const W: usize>(&self, starts: impl Iterator<Item = u32>) -> Vec<(u32, u32)> {
        let mut marks = alloc::vec![0u64; self.nodes.len().div_ceil(64)];
        let mut found = Vec::new();
        for start in starts {
            let mut node = start;
            while let Some(shape) = self.shapes.get(node as usize).filter(|shape| shape.height > 0) {
                let (word, bit) = (&mut marks[node as usize / 64], 1 << (node % 64));
                if *word & bit != 0 {
                    break;
                }
                *word |= bit;
                found.push((shape.height, node));
                node = match self.above[node as usize] {
                    INVALID => INVALID,
                    at => place_parts::<W>(at).0,
                };
            }
        }
        found.sort_unstable();
        found
    }

    /// The links by which an instance is in the tree: its own, or those of its parts.
    pub fn links_of(&self, instance: u32) -> core::ops::Range<u32> {
        match self.opened.get(&instance) {
            Some(own) if own.first != INVALID => 1..own.parts.len() as u32 + 1,
            _ => 0..1,
        }
    }

    /// The place of a leaf; [`INVALID`] if it is none.
    pub fn place_of(&self, instance: u32, part: u32) -> u32 {
        let place = self.places[instance as usize];
        match part {
            0 => place,
            _ if place == INVALID => INVALID,
            _ => {
                let at = (place & !OPENED).wrapping_add(part - 1);
                self.parts.get(at as usize).copied().unwrap_or(INVALID)
            }
        }
    }

    fn set_place(&mut self, instance: u32, part: u32, place: u32) {
        if part == 0 {
            self.places[instance as usize] = place;
        } else {
            let first = self.places[instance as usize] & !OPENED;
            self.parts[(first + part - 1) as usize] = place;
        }
    }

    /// Bytes of its arrays.
    pub fn memory(&self) -> usize {
        let opened: usize = self.opened.values().map(|own| size_of_val(&*own.parts)).sum();
        size_of_val(&*self.nodes)
            + size_of_val(&*self.above)
            + size_of_val(&*self.shapes)
            + size_of_val(&*self.free)
            + size_of_val(&*self.places)
            + size_of_val(&*self.leaves)
            + size_of_val(&*self.limits)
            + size_of_val(&*self.parts)
            + opened
    }

    /// Summary and limits of a leaf; empty if there is no such leaf.
    #[inline]
    pub fn leaf<const W: usize>(&self, link: u32) -> Child<N::Summary>
    where
        N: Node<W>,
    {
        let (instance, part) = leaf_parts(link);
        let own = match part {
            0 => {
                let words = self.leaves.get(instance as usize).copied().flatten();
                let limits = self.limits.get(instance as usize).copied();
                words.map(|words| (words, limits.unwrap_or(Limits::NONE)))
            }
            _ => self
                .opened
                .get(&instance)
                .and_then(|own| own.parts.get(part as usize - 1).copied()),
        };
        own.map_or(Child::EMPTY, |(words, limits)| Child {
            summary: N::Summary::from_words(&words),
            limits,
        })
    }

    /// The centre of a child, metres.
    fn center_of<const W: usize>(&self, to: u32, link: u32) -> [f32; 3]
    where
        N: Node<W>,
    {
        if to == kind::INNER {
            self.shapes[link as usize].center
        } else {
            let c = self.leaf(link).summary.center();
            // Empty bounds have no centre.
            [c.x, c.y, c.z].map(|x| if exact::abs(x) < f32::INFINITY { x } else { 0.0 })
        }
    }

    /// Puts a child into a slot; the node is still to be computed.
    pub fn attach<const W: usize>(&mut self, node: u32, slot: usize, to: u32, link: u32)
    where
        N: Node<W>,
    {
        self.nodes[node as usize].set_child(slot, to, link);
        let at = place::<W>(node, slot as u32);
        if to == kind::INNER {
            self.above[link as usize] = at;
            self.shapes[link as usize].from = [f32::NAN; 3];
        } else if to == kind::MESH {
            let (instance, part) = leaf_parts(link);
            self.set_place(instance, part, at);
        }
        self.shapes[node as usize].is_changed = true;
        self.written.links.push(node);
    }

    /// Computes a node from its children.
    pub fn refit_node<const W: usize>(&mut self, node: u32)
    where
        N: Node<W>,
    {
        let own = self.nodes[node as usize];
        let mut lanes = Lanes::<W>::all(&N::Summary::EMPTY);
        let mut limits = [Limits::NONE; W];
        let (mut sum, mut count, mut height) = ([0.0; 3], 0.0, 1);
        for slot in 0..W {
            let (to, link) = (own.kind(slot), own.link(slot));
            if to == kind::EMPTY {
                continue;
            }
            let child = if to == kind::INNER {
                let below = &self.shapes[link as usize];
                let summary = N::Summary::from_words(&below.words);
                height = height.max(1 + below.height);
                if has_limits::<N, W>() {
                    limits[slot] = self.nodes[link as usize].merged_limits(&summary);
                }
                summary
            } else {
                let leaf = self.leaf(link);
                limits[slot] = leaf.limits;
                leaf.summary
            };
            lanes.set(slot, &child);
            let center = self.center_of(to, link);
            (0..3).for_each(|k| sum[k] += center[k]);
            count += 1.0;
        }
        let own = &mut self.nodes[node as usize];
        own.set_lanes(&lanes);
        own.set_limits(&limits, &lanes);
        let merged = own.merged();
        let cluster = Cluster::new(&merged);
        let words = merged.to_words();
        let shape = &mut self.shapes[node as usize];
        (shape.words, shape.cluster) = (words, cluster);
        shape.height = height;
        shape.center = if count > 0.0 { sum.map(|x| x / count) } else { sum };
        if core::mem::take(&mut shape.is_changed) {
            self.shapes[node as usize].half = self.half_of(node);
        }
    }

    /// Half extents of a node's children; notes where those are that are new.
    fn half_of<const W: usize>(&mut self, node: u32) -> [f32; 3]
    where
        N: Node<W>,
    {
        let (own, above) = (self.nodes[node as usize], self.shapes[node as usize].center);
        let (mut least, mut most) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for slot in 0..W {
            let (to, link) = (own.kind(slot), own.link(slot));
            if to == kind::EMPTY {
                continue;
            }
            let center = self.center_of(to, link);
            let half = if to == kind::INNER {
                let child = &mut self.shapes[link as usize];
                if child.from[0].is_nan() {
                    child.from = [0, 1, 2].map(|k| center[k] - above[k]);
                }
                child.half
            } else {
                [exact::sqrt(self.leaf(link).summary.spread() / 3.0); 3]
            };
            for k in 0..3 {
                least[k] = exact::min(least[k], center[k] - half[k]);
                most[k] = exact::max(most[k], center[k] + half[k]);
            }
        }
        [0, 1, 2].map(|k| exact::max((most[k] - least[k]) * 0.5, 0.0))
    }

    /// Computes nodes and all above them, each once; returns those whose centres moved, children first.
    pub fn refit_above<const W: usize>(&mut self, starts: Vec<u32>) -> Vec<u32>
    where
        N: Node<W>,
    {
        let nodes = self.above_some::<W>(starts.iter().copied());
        let nodes = nodes.into_iter().map(|(_, node)| node);
        let moved = nodes.filter(|&node| {
            let old = self.shapes[node as usize].center;
            self.refit_node(node);
            self.shapes[node as usize].center != old
        });
        let moved = moved.collect();
        self.written.computed.extend(starts);
        moved
    }

    /// Number of levels of a child: 0 for a leaf.
    fn height_of(&self, to: u32, link: u32) -> u32 {
        match to {
            kind::INNER => self.shapes[link as usize].height,
            _ => 0,
        }
    }

    /// Sets the leaves that a batch names; the lists grow to hold them.
    pub fn set<const W: usize>(&mut self, batch: &Batch)
    where
        N: Node<W>,
    {
        if let Some(&last) = batch.instances.iter().max() {
            let length = self.leaves.len().max(last as usize + 1);
            self.leaves.resize(length, None);
            self.places.resize(length, INVALID);
            if has_limits::<N, W>() {
                self.limits.resize(length, Limits::NONE);
            }
        }
        let mut parts = batch.parts.iter().peekable();
        for (k, &instance) in batch.instances.iter().enumerate() {
            let old = core::mem::replace(&mut self.leaves[instance as usize], batch.leaves[k]);
            self.count += u32::from(batch.leaves[k].is_some());
            self.count -= u32::from(old.is_some());
            if let Some(limits) = batch.limits.get(k) {
                self.limits[instance as usize] = *limits;
            }
            let own = parts.next_if(|(owner, _)| *owner == instance).map(|(_, own)| own);
            if own.is_none() && self.opened.is_empty() {
                continue;
            }
            let known = self.opened.get(&instance);
            let first = known.map_or(INVALID, |known| known.first);
            let is_same = known.map(|known| known.parts.len()) == own.map(Vec::len);
            if first != INVALID && !is_same {
                self.take_out::<W>(instance);
            }
            match own {
                Some(own) => {
                    let own = Opened {
                        first: if is_same { first } else { INVALID },
                        parts: own.clone(),
                    };
                    self.opened.insert(instance, own);
                }
                None => _ = self.opened.remove(&instance),
            }
        }
    }

    /// Takes an instance out of the nodes above it, at once: walks no longer reach it.
    pub fn take_out<const W: usize>(&mut self, instance: u32)
    where
        N: Node<W>,
    {
        for part in self.links_of(instance) {
            self.detach::<W>(leaf(instance, part));
        }
        self.opened.remove(&instance);
        if let Some(place) = self.places.get_mut(instance as usize) {
            *place = INVALID;
        }
    }

    /// Empties the slot of a leaf.
    fn detach<const W: usize>(&mut self, link: u32)
    where
        N: Node<W>,
    {
        let (instance, part) = leaf_parts(link);
        if (instance as usize) < self.places.len() {
            let at = self.place_of(instance, part);
            if at != INVALID {
                let (node, slot) = place_parts::<W>(at);
                self.set_place(instance, part, INVALID);
                self.attach(node, slot as usize, kind::EMPTY, 0);
                self.lost.push(node);
            }
        }
    }
}

#[cfg(test)]
mod tests;
