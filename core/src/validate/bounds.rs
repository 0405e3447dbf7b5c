//! Bounds: what refit makes of the lights, and children within their parents.

use bytemuck::Pod;

use super::{Violation, What, equal};
use crate::bounds::LightBounds;
use crate::bvh::LightBvh;
use crate::cone::{Cone, sine_of};
use crate::exact::{self, pow2};
use crate::lights::Lights;
use crate::node::{LightNode, kind};
use crate::tree::{LightTree, MeshLeaf};
use crate::vector::{dot, length_squared};

/// Slack of the cone test, in cosine: 2^-20. The cosine of a sum of two angles takes some ten roundings of 2^-24.
const COSINE_SLACK: f32 = pow2(-20);

/// Checks all bounds of a BVH whose links are sound.
pub(super) fn validate<N: LightNode<W>, const W: usize, L: MeshLeaf>(
    bvh: &LightBvh<N, W, L>,
    lights: &Lights,
) -> Result<(), Violation> {
    // A copy of links and kinds alone, refitted: none of the bounds under test is in it.
    let mut again = bvh.clone();
    for node in again.nodes_mut() {
        let mut bare = N::EMPTY;
        for slot in 0..W {
            bare.set_child(slot, node.kind(slot), node.link(slot));
        }
        *node = bare;
    }
    again.refit(lights);
    for (index, (expected, found)) in again.nodes().iter().zip(bvh.nodes()).enumerate() {
        same(index as u32, expected, found)?;
    }

    let tree = bvh.tree();
    for node in tree.nodes {
        for slot in 0..W {
            if let Some(child) = child_node(&tree, node, slot) {
                within(&node.bounds(slot), child, &tree.nodes[child as usize])?;
            }
        }
    }
    Ok(())
}

/// The node behind a child, if it is not a triangle.
fn child_node<N: LightNode<W>, L: MeshLeaf, const W: usize>(
    tree: &LightTree<'_, N, L>,
    node: &N,
    slot: usize,
) -> Option<u32> {
    match node.kind(slot) {
        kind::INNER => Some(node.link(slot)),
        kind::MESH => Some(tree.meshes[node.link(slot) as usize].root()),
        _ => None,
    }
}

/// Checks that two nodes have the same words; the first difference is named by what it means, where it shows.
pub(crate) fn same<N: LightNode<W>, const W: usize>(
    index: u32,
    expected: &N,
    found: &N,
) -> Result<(), Violation> {
    if bytemuck::bytes_of(expected) == bytemuck::bytes_of(found) {
        return Ok(());
    }
    for slot in 0..W {
        let pairs = components(&expected.bounds(slot))
            .into_iter()
            .zip(components(&found.bounds(slot)));
        for (component, (e, f)) in (0..).zip(pairs) {
            equal(
                index,
                slot as u32,
                What::Bounds(component),
                e.to_bits(),
                f.to_bits(),
            )?;
        }
    }
    // Layouts are arrays over the slots, so every `W`-th word belongs to one child.
    let words = |node: &N, i: usize| {
        let bytes = bytemuck::bytes_of(node);
        u32::from_ne_bytes([bytes[4 * i], bytes[4 * i + 1], bytes[4 * i + 2], bytes[4 * i + 3]])
    };
    for i in 0..size_of::<N>() / 4 {
        let what = What::Word((i / W) as u32);
        equal(index, (i % W) as u32, what, words(expected, i), words(found, i))?;
    }
    Ok(())
}

/// Checks that two records have the same words; the first that differs is named by its place.
pub(crate) fn same_words<T: Pod>(node: u32, slot: u32, expected: &T, found: &T) -> Result<(), Violation> {
    let words = |record: &T, i: usize| {
        let bytes = bytemuck::bytes_of(record);
        u32::from_ne_bytes([bytes[4 * i], bytes[4 * i + 1], bytes[4 * i + 2], bytes[4 * i + 3]])
    };
    for i in 0..size_of::<T>() / 4 {
        equal(
            node,
            slot,
            What::Word(i as u32),
            words(expected, i),
            words(found, i),
        )?;
    }
    Ok(())
}

/// The components of bounds in the order of [`What::Bounds`].
fn components(b: &LightBounds) -> [f32; 12] {
    let (lo, hi, a) = (b.min, b.max, b.axis);
    [
        lo.x,
        lo.y,
        lo.z,
        hi.x,
        hi.y,
        hi.z,
        a.x,
        a.y,
        a.z,
        b.cos_theta_o,
        b.cos_theta_e,
        b.phi,
    ]
}

/// Checks that the children of node `index` lie within `outer`, the bounds that its parent holds of it.
pub(crate) fn within<N: LightNode<W>, const W: usize>(
    outer: &LightBounds,
    index: u32,
    node: &N,
) -> Result<(), Violation> {
    let limits = components(outer);
    for slot in 0..W {
        let inner = node.bounds(slot);
        // Without flux a box and a cone mean nothing.
        if node.kind(slot) != kind::EMPTY && inner.phi != 0.0 {
            let own = components(&inner);
            let check = |component: usize, holds: bool| {
                if holds {
                    Ok(())
                } else {
                    Err(Violation {
                        node: index,
                        slot: slot as u32,
                        what: What::Containment(component as u32),
                        expected: limits[component].to_bits(),
                        found: own[component].to_bits(),
                    })
                }
            };
            for k in 0..3 {
                check(k, own[k] >= limits[k])?;
                check(3 + k, own[3 + k] <= limits[3 + k])?;
            }
            check(9, contains(outer.cone(), inner.cone()))?;
            check(10, inner.cos_theta_e >= outer.cos_theta_e)?;
            check(11, inner.phi <= outer.phi)?;
        }
    }
    Ok(())
}

/// Whether θ_d + θ_inner ≤ θ_outer, within [`COSINE_SLACK`].
fn contains(outer: Cone, inner: Cone) -> bool {
    let cos_d = exact::clamp(dot(outer.axis, inner.axis), -1.0, 1.0);
    // As in the union of cones: the part of one axis across the other, precise where 1 − cos² is not.
    let across = inner.axis - outer.axis * cos_d;
    let sin_d = exact::sqrt(exact::min(length_squared(across), 1.0));
    let (cos_i, sin_i) = (inner.cos_theta_o, sine_of(inner.cos_theta_o));
    // A sum above π shows in its negative sine.
    let sin_sum = sin_d * cos_i + cos_d * sin_i;
    let cos_sum = if sin_sum < 0.0 {
        -1.0
    } else {
        cos_d * cos_i - sin_d * sin_i
    };
    outer.cos_theta_o <= cos_sum + COSINE_SLACK
}

#[cfg(test)]
mod tests;
