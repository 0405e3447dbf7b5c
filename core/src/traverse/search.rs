//! The search for a light that can be reached below a child.

use super::descend::enter;
use super::neighbor::Neighbor;
use crate::importance::ImportanceModel;
use crate::node::{LightNode, kind};
use crate::point::ShadingPoint;
use crate::trail::{Path, max_levels};
use crate::tree::{INVALID, LightTree, MeshLeaf};

/// A light found, or [`INVALID`], and its mesh light.
#[derive(Clone, Copy)]
pub(super) struct Found {
    pub light: u32,
    pub mesh: u32,
}

/// The first reachable light below `start`, which has importance, or with `!ascending` the last. With `ANY` only whether
/// there is one matters, and the light found is 0.
///
/// A depth-first search without a stack: after a dead end it starts over along the trail, changed at the deepest
/// alternative (the restart trail of Laine 2010). In any well-formed tree it ends within the bound; hostile words end
/// at it.
pub(super) fn find_live<N: LightNode<W>, I: ImportanceModel, L: MeshLeaf, const ANY: bool, const W: usize>(
    tree: &LightTree<'_, N, L>,
    point: &ShadingPoint,
    start: &Neighbor<W>,
    ascending: bool,
) -> Found {
    let (first_index, first_position, first_mesh) =
        enter::<N, L, W>(tree, start.kind, start.link, start.position, start.mesh);
    let at_light = start.kind == kind::LIGHT;
    let mut found = Found {
        light: if at_light {
            tree.light_of(start.link, start.mesh)
        } else {
            INVALID
        },
        mesh: start.mesh,
    };
    let mut done = at_light || start.is_none();

    let (mut index, mut position, mut mesh) = (first_index, first_position, first_mesh);
    let mut path = Path::default();
    // Positions below this one are retraced.
    let mut retrace = first_position;
    let (mut other_position, mut other_slot) = (INVALID, 0);
    // Most neighbours in the small trees of instances are lights: those are not worth a way into their mesh's space.
    let mut receiver = tree.receiver(point, if done { INVALID } else { mesh });
    let mut steps = search_bound(tree.nodes.len() as u32, 2 * max_levels(W));
    while !done && steps > 0 {
        steps -= 1;
        let valid = index < tree.nodes.len() as u32;
        let node = &tree.nodes[if valid { index as usize } else { 0 }];
        let open = node.open::<I, L::Local>(&receiver);
        let open = if valid { open } else { 0 };

        if ANY && open & node.lights() != 0 {
            // A light among the children settles at once whether there is one.
            found = Found { light: 0, mesh };
            done = true;
        } else {
            // The slot to enter, and the one after it in the order of search. What is retraced was open before.
            let from = if position < retrace {
                path.slot::<W>(position)
            } else if ascending || ANY {
                0
            } else {
                W as u32 - 1
            };
            let (chosen, after) = two_from::<W>(open, from, ascending || ANY);
            if after != INVALID {
                other_position = position;
                other_slot = after;
            }
            if chosen != INVALID {
                path = path.with::<W>(position, chosen);
                let slot = if chosen < W as u32 { chosen as usize } else { 0 };
                let (to, link) = (node.kind(slot), node.link(slot));
                if !ANY && to == kind::LIGHT {
                    found = Found {
                        light: tree.light_of(link, mesh),
                        mesh,
                    };
                    done = true;
                } else {
                    let (next, next_position, next_mesh) = enter::<N, L, W>(tree, to, link, position, mesh);
                    index = next;
                    position = next_position;
                    if next_mesh != mesh {
                        mesh = next_mesh;
                        receiver = tree.receiver(point, mesh);
                    }
                }
            } else if other_position != INVALID {
                // Dead end: start over with the deepest alternative.
                path = path.with::<W>(other_position, other_slot);
                retrace = other_position + 1;
                other_position = INVALID;
                index = first_index;
                position = first_position;
                if mesh != first_mesh {
                    mesh = first_mesh;
                    receiver = tree.receiver(point, mesh);
                }
            } else {
                done = true;
            }
        }
    }
    found
}

/// The first two of the slots `open` from slot `from` on, ascending or descending; [`INVALID`] for none.
#[inline(always)]
fn two_from<const W: usize>(open: u32, from: u32, ascending: bool) -> (u32, u32) {
    let (mut first, mut second) = (INVALID, INVALID);
    for i in 0..W as u32 {
        // Against the order, so that the first two come last.
        let slot = if ascending { W as u32 - 1 - i } else { i };
        let reached = if ascending { slot >= from } else { slot <= from };
        let takes = ((open >> slot) & 1 != 0) & reached;
        second = if takes { first } else { second };
        first = if takes { slot } else { first };
    }
    (first, second)
}

/// Each dead end costs at most one way down, and there are fewer dead ends than nodes.
#[inline(always)]
fn search_bound(nodes: u32, levels: u32) -> u32 {
    let most = u32::MAX / levels;
    (if nodes < most { nodes } else { most }) * levels
}
