//! A tree brought to a number of nodes, so that it takes the place of another without a gap.

use alloc::vec::Vec;

use crate::build::Topology;
use crate::exact;
use crate::light::Light;
use crate::node::{Node, kind};
use crate::trail::BitTrail;

/// A child of a node: another node, or a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Child {
    Node(usize),
    Light(u32),
}

/// A tree whose nodes come and go.
struct Tree<'a, L, const W: usize> {
    /// By node, the root first; what has gone has none.
    children: Vec<Vec<Child>>,
    /// How many are left.
    count: usize,
    triangles: &'a [L],
}

/// The tree with `count` nodes and at most `levels` levels; `None` where that was not found. A leaf node of few triangles gives
/// them to its parent and its nearest siblings; two triangles of a node get a node of their own.
pub(super) fn fit<N: Node<W>, const W: usize>(
    topology: Topology<N>,
    triangles: &[N::Light],
    count: usize,
    levels: u32,
) -> Option<Topology<N>> {
    if topology.nodes.len() == count {
        return Some(topology).filter(|topology| topology.depth <= levels);
    }
    let mut tree = Tree::<N::Light, W> {
        children: topology.nodes.iter().map(children).collect(),
        count: topology.nodes.len(),
        triangles,
    };
    tree.shrink(count);
    tree.grow(count);
    let mut out = Topology {
        nodes: Vec::with_capacity(count),
        levels: Vec::with_capacity(count),
        trails: Vec::with_capacity(triangles.len()),
        depth: 0,
    };
    tree.emit(0, 0, BitTrail::default(), levels, &mut out)?;
    Some(out).filter(|out| out.nodes.len() == count)
}

fn children<N: Node<W>, const W: usize>(node: &N) -> Vec<Child> {
    let slots = (0..W).filter_map(|slot| match node.kind(slot) {
        kind::INNER => Some(Child::Node(node.link(slot) as usize)),
        kind::LIGHT => Some(Child::Light(node.link(slot))),
        _ => None,
    });
    slots.collect()
}

fn node_of(child: Child) -> Option<usize> {
    match child {
        Child::Node(node) => Some(node),
        Child::Light(_) => None,
    }
}

impl<L: Light, const W: usize> Tree<'_, L, W> {
    fn is_leaf(&self, child: Child) -> Option<usize> {
        let node = node_of(child)?;
        let lights = |&child: &Child| node_of(child).is_none();
        self.children[node].iter().all(lights).then_some(node)
    }

    /// Places free for the triangles of leaf `leaf` below `parent`, its own slot among them.
    fn room(&self, parent: usize, leaf: usize) -> usize {
        let own = &self.children[parent];
        let siblings = own.iter().filter_map(|&child| node_of(child));
        let free: usize = siblings
            .filter(|&node| node != leaf)
            .map(|node| W - self.children[node].len())
            .sum();
        free + W - own.len() + 1
    }

    /// Dissolves leaf nodes, those of the fewest triangles first.
    fn shrink(&mut self, count: usize) {
        while self.count > count {
            let mut found: Vec<(usize, usize, usize)> = Vec::new();
            for parent in 0..self.children.len() {
                for &child in &self.children[parent] {
                    if let Some(leaf) = self.is_leaf(child) {
                        let few = self.children[leaf].len();
                        if few <= self.room(parent, leaf) {
                            found.push((few, parent, leaf));
                        }
                    }
                }
            }
            found.sort_unstable();
            let before = self.count;
            for (few, parent, leaf) in found {
                // What was done before may have taken its room, or dissolved it.
                let is_there = self.children[parent].contains(&Child::Node(leaf));
                if is_there
                    && self.count > count
                    && self.children[leaf].len() == few
                    && few <= self.room(parent, leaf)
                {
                    self.dissolve(parent, leaf);
                }
            }
            if self.count == before {
                return;
            }
        }
    }

    fn dissolve(&mut self, parent: usize, leaf: usize) {
        self.children[parent].retain(|&child| child != Child::Node(leaf));
        self.count -= 1;
        for child in core::mem::take(&mut self.children[leaf]) {
            let Child::Light(light) = child else { continue };
            if self.children[parent].len() < W {
                self.children[parent].push(child);
                continue;
            }
            let siblings = self.children[parent].iter();
            let open = siblings.filter_map(|&child| node_of(child));
            let open = open.filter(|&node| self.children[node].len() < W);
            let distance = |node: usize| {
                let mut nearest = f32::INFINITY;
                for &child in &self.children[node] {
                    if let Child::Light(other) = child {
                        nearest = exact::min(nearest, self.distance(light, other));
                    }
                }
                nearest
            };
            let nearest = open.min_by(|&a, &b| distance(a).total_cmp(&distance(b)));
            if let Some(node) = nearest {
                self.children[node].push(child);
            }
        }
    }

    /// Gives two triangles of a node, the nearest to each other, a node of their own: nodes of many triangles first.
    fn grow(&mut self, count: usize) {
        let lights = |own: &[Child]| own.iter().filter(|&&child| node_of(child).is_none()).count();
        for most in (2..=W).rev() {
            for node in 0..self.children.len() {
                if self.count >= count {
                    return;
                }
                let own = &self.children[node];
                if own.len() < 3 || lights(own) != most {
                    continue;
                }
                let mut best = (f32::INFINITY, 0, 0);
                for (i, &a) in own.iter().enumerate() {
                    for (j, &b) in own.iter().enumerate().skip(i + 1) {
                        if let (Child::Light(a), Child::Light(b)) = (a, b) {
                            let distance = self.distance(a, b);
                            if distance < best.0 || best.2 == 0 {
                                best = (distance, i, j);
                            }
                        }
                    }
                }
                let (_, i, j) = best;
                let second = self.children[node].remove(j);
                let new = Child::Node(self.children.len());
                let first = core::mem::replace(&mut self.children[node][i], new);
                self.children.push(alloc::vec![first, second]);
                self.count += 1;
            }
        }
    }

    /// Square of the distance between two lights.
    fn distance(&self, a: u32, b: u32) -> f32 {
        let center = |light: u32| self.triangles[light as usize].centroid();
        let (a, b) = (center(a), center(b));
        (0..3).map(|axis| (a[axis] - b[axis]) * (a[axis] - b[axis])).sum()
    }

    /// Writes the nodes from `node` down in depth-first order; recursion is as deep as the tree.
    fn emit<N: Node<W>>(
        &self,
        node: usize,
        level: u32,
        trail: BitTrail,
        levels: u32,
        out: &mut Topology<N>,
    ) -> Option<()> {
        if level >= levels {
            return None;
        }
        let index = out.nodes.len();
        out.nodes.push(N::EMPTY);
        out.levels.push(level);
        out.depth = out.depth.max(level + 1);
        for (slot, &child) in self.children[node].iter().enumerate() {
            let own = trail.with::<W>(level, slot as u32);
            match child {
                Child::Light(light) => {
                    out.nodes[index].set_child(slot, kind::LIGHT, light);
                    out.trails.push((light, own));
                }
                Child::Node(below) => {
                    let link = out.nodes.len() as u32;
                    out.nodes[index].set_child(slot, kind::INNER, link);
                    self.emit(below, level + 1, own, levels, out)?;
                }
            }
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::build::{BuildParams, build_over};
    use crate::kit::{Random, triangle};
    use crate::{CompactNode, LightNode, MomentNode};

    fn check<N: LightNode<W>, const W: usize>(params: &BuildParams, count: usize) -> usize {
        let random = &mut Random(count as u32);
        let at = |random: &mut Random| [0; 3].map(|_| 10.0 * random.unit());
        let lamps: Vec<crate::EmissiveTriangle> = (0..count)
            .map(|_| {
                let [x, y, z] = at(random);
                triangle([[x, y, z], [x + 0.1, y, z], [x, y + 0.1, z]])
            })
            .collect();
        let usual = build_over::<N, W>(&lamps, params).nodes.len();
        let mut found = 0;
        // A tree over other places of as many triangles has about as many nodes.
        for change in [-(usual as i32) / 40, -2, -1, 0, 1, 3, 40] {
            let wanted = (usual as i32 + change) as usize;
            let own = build_over::<N, W>(&lamps, params);
            let Some(tree) = fit::<N, W>(own, &lamps, wanted, 16) else {
                assert!(change < 0, "{usual} {change}");
                continue;
            };
            found += 1;
            assert_eq!(tree.nodes.len(), wanted);
            let mut times = alloc::vec![0; count];
            for &(light, trail) in &tree.trails {
                times[light as usize] += 1;
                let (mut node, mut level) = (0, 0);
                loop {
                    assert_eq!(tree.levels[node as usize], level);
                    let own = &tree.nodes[node as usize];
                    let slot = trail.slot::<W>(level) as usize;
                    if own.kind(slot) == kind::LIGHT {
                        assert_eq!(own.link(slot), light);
                        break;
                    }
                    assert!(own.kind(slot) == kind::INNER && own.link(slot) > node);
                    (node, level) = (own.link(slot), level + 1);
                }
                assert!(level < tree.depth);
            }
            assert!(times.iter().all(|&times| times == 1));
        }
        found
    }

    #[test]
    fn a_tree_takes_the_nodes_it_is_given() {
        for count in [400, 1000, 3000] {
            assert_eq!(check::<MomentNode<8>, 8>(&BuildParams::default(), count), 7);
            assert_eq!(check::<MomentNode<8>, 8>(&BuildParams::BEST, count), 7);
            assert!(check::<CompactNode<4>, 4>(&BuildParams::FAST, count) >= 5);
        }
        let lamp = triangle([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        let few = [lamp; 9];
        let own = || build_over::<MomentNode<8>, 8>(&few, &BuildParams::default());
        assert!(
            fit::<_, 8>(own(), &few, 1, 9).is_none(),
            "too few for the triangles"
        );
        assert!(fit::<_, 8>(own(), &few, 9, 9).is_none(), "too many");
        assert!(fit::<_, 8>(own(), &few, 4, 1).is_none(), "too flat");
    }
}
