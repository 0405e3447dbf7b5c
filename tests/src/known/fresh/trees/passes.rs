//! The passes of a refit, from the links of a tree alone.

use lightbvh::LightNode;
use lightbvh::node::kind;
use lightbvh::refit::BlasRoot;
use lightbvh_kernels::bvh::{Node, WIDTH};

use crate::known::tree::Step;

/// The passes that refit all nodes below the roots and the top level above them, from the links alone.
pub(super) fn passes_of(
    nodes: &[Node],
    roots: &[BlasRoot],
    root: u32,
    two_level: bool,
) -> Vec<(Step, Vec<u32>)> {
    let mut passes = Vec::new();
    let trees: Vec<u32> = if two_level {
        roots.iter().map(|root| root.node).collect()
    } else {
        vec![root]
    };
    let mut refit = |first: Step, trees: &[u32]| {
        let mut levels = Vec::new();
        for &root in trees {
            height(nodes, root, &mut levels);
        }
        let mut all = levels.concat();
        all.sort_unstable();
        passes.push((first, all));
        passes.extend(levels.into_iter().skip(1).map(|level| (Step::Level, level)));
        if first == Step::Leaves && two_level {
            passes.push((Step::Roots, (0..roots.len() as u32).collect()));
        }
    };
    refit(Step::Leaves, &trees);
    if two_level {
        refit(Step::Instances, &[root]);
    }
    passes
}

/// Sorts node `index` and those below it by their height over the lowest.
fn height(nodes: &[Node], index: u32, levels: &mut Vec<Vec<u32>>) -> usize {
    let node = &nodes[index as usize];
    let below = (0..WIDTH)
        .filter(|&slot| node.kind(slot) == kind::INNER)
        .map(|slot| 1 + height(nodes, node.link(slot), levels))
        .max()
        .unwrap_or(0);
    if levels.len() <= below {
        levels.resize(below + 1, Vec::new());
    }
    levels[below].push(index);
    below
}
