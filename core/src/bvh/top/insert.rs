//! Insertion of a leaf or a subtree into the top level: a descent from the root to where it costs least.

use super::cost::Cluster;
use super::{Shape, Top};
use crate::node::{Node, kind};
use crate::trail::{max_levels, place_parts};
use crate::tree::INVALID;

/// Stands for zero flux, W: costs of such items are compared by distance alone.
const ZERO_FLUX: f64 = 1e-100;

/// The next step of an item at a node.
#[derive(Clone, Copy, Debug)]
enum Step {
    /// Into an empty slot.
    Place(usize),
    /// To the node in this slot.
    Enter(usize),
    /// Into a new node, with the child that is in this slot.
    Pair(usize),
    /// Into the second slot; both children are put into a new node, in the first slot.
    Merge(usize, usize),
}

/// A child of a node.
#[derive(Clone, Copy, Debug)]
struct Child {
    slot: usize,
    cluster: Cluster,
    /// Number of its levels.
    height: u32,
}

impl<N> Top<N> {
    /// Inserts a leaf or a subtree by a greedy descent, which looks at one node of each level and enters those of more levels than
    /// the item has. Returns the lowest node whose children changed; it and those above are still to be computed. `None` if the
    /// tree would get deeper than a trail is long.
    pub(super) fn insert<const W: usize>(&mut self, to: u32, link: u32) -> Option<u32>
    where
        N: Node<W>,
    {
        let (item, height) = (self.cluster(to, link), self.height_of(to, link));
        let (mut node, mut level) = (self.root, 0);
        loop {
            let own = &self.nodes[node as usize];
            let child = |slot: usize| (own.kind(slot), own.link(slot));
            match self.step(node, level, (&item, height))? {
                Step::Enter(slot) => {
                    node = own.link(slot);
                    let there = self.cluster(kind::INNER, node);
                    self.shapes[node as usize].cluster = there.with(&item);
                    level += 1;
                }
                Step::Place(slot) => {
                    self.attach(node, slot, to, link);
                    return Some(node);
                }
                Step::Pair(slot) => {
                    let there = child(slot);
                    return Some(self.pair(node, slot, there, (to, link)));
                }
                Step::Merge(a, b) => {
                    let (one, other) = (child(a), child(b));
                    let new = self.pair(node, a, one, other);
                    self.attach(node, b, to, link);
                    return Some(new);
                }
            }
        }
    }

    fn cluster<const W: usize>(&self, to: u32, link: u32) -> Cluster
    where
        N: Node<W>,
    {
        let mut own = match to {
            kind::INNER => self.shapes[link as usize].cluster,
            _ => Cluster::new(&self.leaf(link).summary),
        };
        if own.phi <= 0.0 {
            // A summary without flux may have no centre.
            own.center = self.center_of(to, link).map(f64::from);
            own.phi = ZERO_FLUX;
        }
        own
    }

    /// The cheapest step that keeps the tree within its levels.
    fn step<const W: usize>(&self, node: u32, level: u32, item: (&Cluster, u32)) -> Option<Step>
    where
        N: Node<W>,
    {
        let ((item, item_height), levels) = (item, max_levels(W));
        if level + 1 + item_height > levels {
            return None;
        }
        let own = &self.nodes[node as usize];
        if let Some(slot) = (0..W).find(|&slot| own.kind(slot) == kind::EMPTY) {
            return Some(Step::Place(slot));
        }
        let children: [Child; W] = core::array::from_fn(|slot| {
            let (to, link) = (own.kind(slot), own.link(slot));
            Child {
                slot,
                cluster: self.cluster(to, link),
                height: self.height_of(to, link),
            }
        });
        let mut best: Option<((f64, u32), Step)> = None;
        let mut offer = |cost: f64, height: u32, step: Step| {
            if best.is_none_or(|(least, _)| (cost, height) < least) {
                best = Some(((cost, height), step));
            }
        };
        for (k, one) in children.iter().enumerate() {
            if level + 2 + item_height <= levels {
                match one.height > item_height {
                    true => offer(
                        one.cluster.merging(item) + item.cost(),
                        one.height,
                        Step::Enter(one.slot),
                    ),
                    false => offer(one.cluster.pairing(item), 1, Step::Pair(one.slot)),
                }
            }
            for other in &children[k + 1..] {
                if level + 2 + one.height.max(other.height) <= levels {
                    offer(
                        one.cluster.pairing(&other.cluster),
                        1 + one.height.max(other.height),
                        Step::Merge(one.slot, other.slot),
                    );
                }
            }
        }
        best.map(|(_, step)| step)
    }

    /// Puts a new node over two children, each kind and link, into a slot; returns it.
    fn pair<const W: usize>(&mut self, node: u32, slot: usize, one: (u32, u32), other: (u32, u32)) -> u32
    where
        N: Node<W>,
    {
        let new = self.free.pop().unwrap_or_else(|| {
            self.nodes.push(N::EMPTY);
            self.above.push(INVALID);
            self.shapes.push(Shape::default());
            self.nodes.len() as u32 - 1
        });
        self.nodes[new as usize] = N::EMPTY;
        self.attach(new, 0, one.0, one.1);
        self.attach(new, 1, other.0, other.1);
        let [own, others] = [one, other].map(|(to, link)| self.height_of(to, link));
        let mut height = 1 + own.max(others);
        let (one, other) = [one, other].map(|(to, link)| self.cluster(to, link)).into();
        let shape = &mut self.shapes[new as usize];
        (shape.height, shape.cluster) = (height, one.with(&other));
        shape.center = shape.cluster.center.map(|x| x as f32);
        self.attach(node, slot, kind::INNER, new);
        // Heights bound the next insertions.
        let mut above = node;
        while self.shapes[above as usize].height <= height {
            height += 1;
            self.shapes[above as usize].height = height;
            match self.above[above as usize] {
                INVALID => break,
                at => above = place_parts::<W>(at).0,
            }
        }
        new
    }
}
