//! Links, kinds, trails and lists of levels.

use alloc::vec::Vec;
use core::ops::Range;

use super::{Violation, What, equal, same_words};
use crate::bvh::LightBvh;
use crate::instance::Instance;
use crate::levels::Levels;
use crate::lights::Lights;
use crate::node::{LightNode, kind};
use crate::trail::{BitTrail, max_levels, trail_words};
use crate::tree::INVALID;

/// Level of a node that was not reached.
const UNREACHED: u32 = INVALID;

/// What the leaves of a tree may be.
struct Leaves {
    kind: u32,
    /// Indices that belong into the tree.
    range: Range<u32>,
    /// About a leaf that belongs into another tree.
    foreign: What,
    /// About the number of times that an index is a leaf.
    counted: What,
}

struct Walk<'a, N, const W: usize> {
    nodes: &'a [N],
    /// Level of each node within its tree.
    levels: Vec<u32>,
    leaves: u32,
}

/// Checks everything but the bounds; returns the number of leaves.
pub(super) fn validate<N: LightNode<W>, const W: usize>(
    bvh: &LightBvh<N, W>,
    lights: &Lights,
) -> Result<u32, Violation> {
    let tree = bvh.tree();
    let count = tree.nodes.len() as u32;
    let triangles = lights.triangles().len() as u32;
    let meshes = if bvh.is_two_level() {
        lights.mesh_count() as u32
    } else {
        0
    };
    equal(
        INVALID,
        INVALID,
        What::MeshCount,
        meshes,
        tree.instances.len() as u32,
    )?;
    let words = triangles.wrapping_mul(tree.trail_words);
    equal(
        INVALID,
        INVALID,
        What::TrailCount,
        words,
        tree.trails.len() as u32,
    )?;

    let mut walk = Walk::<N, W> {
        nodes: tree.nodes,
        levels: alloc::vec![UNREACHED; tree.nodes.len()],
        leaves: 0,
    };
    let trail_of = |light: u32| {
        let at = light as usize * tree.trail_words as usize;
        BitTrail {
            low: tree.trails[at],
            high: if tree.trail_words == 2 {
                tree.trails[at + 1]
            } else {
                0
            },
        }
    };
    let triangle_leaves = |range: Range<usize>| Leaves {
        kind: kind::LIGHT,
        range: range.start as u32..range.end as u32,
        foreign: What::Owner,
        counted: What::Triangle,
    };

    let (mut bottom_depth, mut top_depth) = (0, 0);
    if bvh.is_two_level() {
        let mesh_leaves = Leaves {
            kind: kind::MESH,
            range: 0..meshes,
            foreign: What::Link,
            counted: What::Mesh,
        };
        let trail = |mesh: u32| tree.instances[mesh as usize].trail();
        equal(
            INVALID,
            INVALID,
            What::RootCount,
            meshes,
            bvh.roots().len() as u32,
        )?;
        top_depth = walk.tree(tree.root, tree.root..count, &mesh_leaves, trail)?;
        for (mesh, light) in tree.instances.iter().enumerate() {
            let range = lights.mesh(mesh);
            equal(
                INVALID,
                mesh as u32,
                What::First,
                range.start as u32,
                light.light_of(range.start as u32),
            )?;
            equal(INVALID, mesh as u32, What::Blas, mesh as u32, light.blas)?;
            equal(
                INVALID,
                mesh as u32,
                What::Root,
                light.root,
                bvh.roots()[mesh].node,
            )?;
            let expected = Instance {
                root: light.root,
                trail: light.trail,
                blas: mesh as u32,
                first: range.start as u32,
                first_triangle: range.start as u32,
                count: range.len() as u32,
                listed: mesh as u32,
                ..Instance::IDENTITY
            };
            same_words(INVALID, mesh as u32, &expected, light)?;
            let depth = walk.tree(light.root, 0..tree.root, &triangle_leaves(range), trail_of)?;
            bottom_depth = bottom_depth.max(depth);
        }
    } else {
        let all = triangle_leaves(0..triangles as usize);
        bottom_depth = walk.tree(tree.root, 0..count, &all, trail_of)?;
    }
    for (node, &level) in walk.levels.iter().enumerate() {
        equal(
            node as u32,
            INVALID,
            What::Reached,
            1,
            u32::from(level != UNREACHED),
        )?;
    }

    equal(
        INVALID,
        INVALID,
        What::Depth,
        bottom_depth + top_depth,
        bvh.depth(),
    )?;
    let words = trail_words(W, bottom_depth);
    equal(INVALID, INVALID, What::TrailWords, words, tree.trail_words)?;
    let split = if bvh.is_two_level() { tree.root } else { count };
    walk.lists(bvh.bottom_levels(), 0..split)?;
    walk.lists(bvh.top_levels(), split..count)?;
    Ok(walk.leaves)
}

impl<N: LightNode<W>, const W: usize> Walk<'_, N, W> {
    /// Walks the tree from `root`, whose nodes must lie in `part`, and returns its depth.
    fn tree(
        &mut self,
        root: u32,
        part: Range<u32>,
        leaves: &Leaves,
        trail_of: impl Fn(u32) -> BitTrail,
    ) -> Result<u32, Violation> {
        if !part.contains(&root) || root as usize >= self.nodes.len() {
            return Err(Violation {
                node: INVALID,
                slot: INVALID,
                what: What::Root,
                expected: part.start,
                found: root,
            });
        }
        let mut times = alloc::vec![0_u32; leaves.range.len()];
        let mut depth = 0;
        // A node is pushed when its parent is looked at, so no more than all nodes are ever on the stack.
        let mut stack = alloc::vec![(root, 0, BitTrail::default())];
        self.reach(INVALID, INVALID, root, 0)?;
        while let Some((index, level, trail)) = stack.pop() {
            depth = depth.max(level + 1);
            let node = &self.nodes[index as usize];
            for slot in 0..W {
                let (found, link) = (node.kind(slot), node.link(slot));
                let at = slot as u32;
                let own = trail.with::<W>(level, at);
                let error = |what, expected, found| Violation {
                    node: index,
                    slot: at,
                    what,
                    expected,
                    found,
                };
                if found == kind::EMPTY {
                    equal(index, at, What::Link, 0, link)?;
                } else if found == kind::INNER {
                    if !part.contains(&link) || link as usize >= self.nodes.len() {
                        return Err(error(What::Link, part.end, link));
                    }
                    self.reach(index, at, link, level + 1)?;
                    stack.push((link, level + 1, own));
                } else if found == leaves.kind {
                    if !leaves.range.contains(&link) {
                        return Err(error(leaves.foreign, leaves.range.start, link));
                    }
                    let seen = &mut times[(link - leaves.range.start) as usize];
                    *seen += 1;
                    equal(index, link, leaves.counted, 1, *seen)?;
                    self.leaves += 1;
                    let trail = trail_of(link);
                    equal(index, at, What::TrailLow, own.low, trail.low)?;
                    equal(index, at, What::TrailHigh, own.high, trail.high)?;
                } else {
                    return Err(error(What::Kind, leaves.kind, found));
                }
            }
        }
        for (i, &seen) in times.iter().enumerate() {
            equal(INVALID, leaves.range.start + i as u32, leaves.counted, 1, seen)?;
        }
        Ok(depth)
    }

    /// Notes that `node` is reached from a slot of `parent`.
    fn reach(&mut self, parent: u32, slot: u32, node: u32, level: u32) -> Result<(), Violation> {
        if level >= max_levels(W) {
            return Err(Violation {
                node: parent,
                slot,
                what: What::Level,
                expected: max_levels(W) - 1,
                found: level,
            });
        }
        let seen = &mut self.levels[node as usize];
        equal(
            node,
            INVALID,
            What::Reached,
            1,
            if *seen == UNREACHED { 1 } else { 2 },
        )?;
        *seen = level;
        Ok(())
    }

    /// Checks the list of levels of the nodes in `part`.
    fn lists(&self, lists: &Levels, part: Range<u32>) -> Result<(), Violation> {
        let mut times = alloc::vec![0_u32; part.len()];
        let mut above = max_levels(W);
        for range in lists.ranges() {
            let mut level = None;
            for &node in &lists.nodes()[range] {
                if !part.contains(&node) {
                    return equal(node, INVALID, What::Listed, 0, 1);
                }
                times[(node - part.start) as usize] += 1;
                let own = self.levels[node as usize];
                let of_range = *level.get_or_insert(own);
                equal(node, INVALID, What::ListedLevel, of_range, own)?;
                if own >= above {
                    return equal(node, INVALID, What::ListedLevel, above.wrapping_sub(1), own);
                }
            }
            above = level.unwrap_or(above);
        }
        for (node, &seen) in part.zip(&times) {
            equal(node, INVALID, What::Listed, 1, seen)?;
        }
        Ok(())
    }
}
