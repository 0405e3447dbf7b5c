//! The passes of a refit, from the links of a tree alone.

use lightbvh::LightNode;
use lightbvh::node::kind;
use lightbvh::refit::BlasRoot;

use crate::known::tree::Step;

/// The passes that refit all nodes below the roots and the top level above them, level by level, from the links alone.
pub(super) fn passes_of<N: LightNode<W>, const W: usize>(
    nodes: &[N],
    roots: &[BlasRoot],
    root: u32,
    two_level: bool,
) -> Vec<(Step, Vec<u32>)> {
    let trees: Vec<u32> = if two_level {
        roots.iter().map(|root| root.node).collect()
    } else {
        vec![root]
    };
    let levels = |trees: &[u32]| {
        let mut levels = Vec::new();
        for &root in trees {
            height(nodes, root, &mut levels);
        }
        levels
    };
    let mut passes: Vec<_> = levels(&trees)
        .into_iter()
        .map(|level| (Step::Bottom, level))
        .collect();
    if two_level {
        passes.push((Step::Roots, (0..roots.len() as u32).collect()));
        passes.extend(levels(&[root]).into_iter().map(|level| (Step::Top, level)));
    }
    passes
}

/// Sorts node `index` and those below it by their height over the lowest.
fn height<N: LightNode<W>, const W: usize>(nodes: &[N], index: u32, levels: &mut Vec<Vec<u32>>) -> usize {
    let node = &nodes[index as usize];
    let below = (0..W)
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
