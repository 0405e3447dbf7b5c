//! The limits of a node's children: unions of masks, and beams, over the lights below that have flux.
//!
//! A union of masks is exact, so a child has a bit just where a light below it with flux has that bit. A walk that keeps to children with a
//! common bit comes to no dead end. A beam holds those of all lights below.

use crate::beam::{Beam, Limits};
use crate::instance::Instance;
use crate::light::Light;
use crate::node::{Node, kind};
use crate::summary::{Lanes, Summary};

/// Whether layout `N` stores any.
#[inline(always)]
pub(crate) const fn has_limits<N: Node<W>, const W: usize>() -> bool {
    N::HAS_MASKS || N::HAS_BEAMS
}

/// The limits of the children of a bottom level's `node`, for [`Node::set_limits`]; `children` are their summaries. Node `first` and those
/// after it stand in `nodes`.
#[inline(always)]
pub(crate) fn limits_below<N: Node<W>, const W: usize>(
    nodes: &[N],
    first: u32,
    lights: &[N::Light],
    node: &N,
    children: &Lanes<W>,
) -> [Limits; W] {
    let mut limits = [Limits::NONE; W];
    if has_limits::<N, W>() {
        for slot in 0..W {
            let (to, link) = (node.kind(slot), node.link(slot));
            let below = link.wrapping_sub(first);
            if to == kind::LIGHT && link < lights.len() as u32 {
                limits[slot] = limits_of_light::<N, W>(&lights[link as usize]);
            } else if to == kind::INNER && below < nodes.len() as u32 {
                limits[slot] = nodes[below as usize].merged_limits(&children.get(slot));
            }
        }
    }
    limits
}

/// Limits of a light.
#[inline(always)]
pub(super) fn limits_of_light<N: Node<W>, const W: usize>(light: &N::Light) -> Limits {
    Limits {
        mask: u32::MAX,
        beam: if N::HAS_BEAMS {
            light.beam()
        } else {
            Beam::ANYWHERE
        },
        end: if N::HAS_BEAMS {
            light.end()
        } else {
            Limits::ENDLESS
        },
    }
}

/// The limits of an instance in the world, where its summary is `world`.
#[inline(always)]
pub(super) fn in_world<N: Node<W>, const W: usize>(
    local: Limits,
    instance: &Instance,
    world: &N::Summary,
) -> Limits {
    let mut limits = local;
    limits.mask &= instance.mask;
    if N::HAS_BEAMS {
        limits = limits.to_world(instance, world.center());
    }
    limits
}
