//! Triangles in one place: where many distances are equal, PLOC pairs few clusters in a round, and takes time in proportion to
//! their square.

use std::collections::HashMap;

use glam::Vec3A;
use lightbvh::exact::{hash, unit_f32};
use obvhs::triangle::Triangle;

/// As many in one place as do no harm.
const FEW: u32 = 16;

/// Moves triangles of which there are many in one place, so that a builder tells them apart: by up to their own size, or where
/// they have none by that of the scene. Their order in the tree means nothing, and boxes are computed from where they are.
/// Others stay.
pub(super) fn spread(triangles: &mut [Triangle]) {
    let place = |t: &Triangle| [t.v0, t.v1, t.v2].map(|v| v.to_array().map(f32::to_bits));
    let mut counts: HashMap<_, u32> = HashMap::new();
    let mut most = 0;
    for triangle in triangles.iter() {
        let count = counts.entry(place(triangle)).or_default();
        *count += 1;
        most = most.max(*count);
    }
    if most <= FEW {
        return;
    }
    let largest = triangles
        .iter()
        .flat_map(|t| [t.v0, t.v1, t.v2])
        .fold(0.0_f32, |largest, v| largest.max(v.abs().max_element()));
    for (index, triangle) in (0_u32..).zip(triangles) {
        if counts[&place(triangle)] <= FEW {
            continue;
        }
        let low = triangle.v0.min(triangle.v1).min(triangle.v2);
        let high = triangle.v0.max(triangle.v1).max(triangle.v2);
        let size = (high - low).max_element().max(largest / 256.0);
        let random = |k: u32| unit_f32(hash(index.wrapping_mul(3).wrapping_add(k))) - 0.5;
        let moved = Vec3A::new(random(0), random(1), random(2)) * size;
        for vertex in [&mut triangle.v0, &mut triangle.v1, &mut triangle.v2] {
            *vertex += moved;
        }
    }
}
