//! Clusters of triangles, merged in rounds.

#[cfg(test)]
mod tests;

use obvhs::Boundable;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::ploc::morton::morton_encode_u64_unorm;
use obvhs::triangle::Triangle;
use rdst::{RadixKey, RadixSort};

/// How far along the line a cluster looks for its nearest.
const DISTANCE: usize = 6;

/// In the first rounds only beside it.
const NEAR_ROUNDS: usize = 2;

/// Clusters that rounds may look at for each triangle, and in all; ordinary scenes have 3 to 7 for each.
const MOST_LOOKS: [usize; 2] = [32, 1 << 20];

/// As many triangles as `obvhs` sorts by the standard library.
const SORTED_BY_STD: usize = 250_000;

/// A triangle, and where it is on a curve that fills space.
#[derive(Clone, Copy)]
struct Key {
    code: u64,
    index: u64,
}

impl RadixKey for Key {
    const LEVELS: usize = 8;

    fn get_level(&self, level: usize) -> u8 {
        self.code.get_level(level)
    }
}

/// A tree, and what it took.
pub(super) struct Built {
    pub bvh: Bvh2,
    /// Clusters in all rounds together.
    looks: usize,
}

impl Built {
    /// Whether there were too many looks.
    pub fn is_hard(&self) -> bool {
        self.looks > most_looks(self.bvh.primitive_indices.len())
    }
}

fn most_looks(triangles: usize) -> usize {
    MOST_LOOKS[0] * triangles + MOST_LOOKS[1]
}

/// PLOC (D. Meister and J. Bittner, "Parallel Locally-Ordered Clustering for Bounding Volume Hierarchy Construction", 2018), as
/// `obvhs` builds it with a search distance of 6, 1 in the first two rounds: the same tree to the bit. But where clusters lie
/// within each other, each prefers the next one, and a round merges a single pair. So once there were [`MOST_LOOKS`], all merge
/// with the one beside them, and there are at most two more for each triangle. There must be at least one.
pub(super) fn build(triangles: &[Triangle]) -> Built {
    let mut clusters = sorted(triangles);
    let mut bvh = Bvh2::zeroed(triangles.len());
    bvh.primitive_indices = (0..triangles.len() as u32).collect();
    let most = most_looks(triangles.len());
    let (mut looks, mut rounds) = (0, 0);
    let mut next = Vec::with_capacity(clusters.len());
    let mut nearest = vec![0_i8; clusters.len()];
    let mut free = bvh.nodes.len();
    while clusters.len() > 1 {
        let count = clusters.len();
        let nearest = &mut nearest[..count];
        if looks > most {
            pairs(nearest);
        } else if rounds < NEAR_ROUNDS {
            beside(&clusters, nearest);
        } else {
            within(&clusters, nearest);
        }
        next.clear();
        for (index, cluster) in clusters.iter().enumerate() {
            let other = index.wrapping_add_signed(nearest[index].into());
            if other.wrapping_add_signed(nearest[other].into()) != index {
                next.push(*cluster);
            } else if other < index {
                free -= 2;
                bvh.nodes[free] = *cluster;
                bvh.nodes[free + 1] = clusters[other];
                let around = cluster.aabb().union(clusters[other].aabb());
                next.push(Bvh2Node::new(around, 0, free as u32));
            }
        }
        looks += count;
        rounds += 1;
        std::mem::swap(&mut clusters, &mut next);
    }
    bvh.nodes[0] = clusters[0];
    bvh.max_depth = bvh.max_depth.max(rounds + 1);
    bvh.children_are_ordered_after_parents = true;
    Built { bvh, looks }
}

/// A leaf for each triangle, along a Morton curve. The order of those at one place is what the sort makes of it, so it is that
/// of `obvhs`.
fn sorted(triangles: &[Triangle]) -> Vec<Bvh2Node> {
    let boxes: Vec<Aabb> = triangles.iter().map(Boundable::aabb).collect();
    let all = boxes.iter().fold(Aabb::empty(), |all, one| all.union(one));
    let scale = 1.0 / all.diagonal().as_dvec3();
    let offset = -all.min.as_dvec3() * scale;
    let key = |(index, around): (u64, &Aabb)| Key {
        code: morton_encode_u64_unorm(around.center().as_dvec3() * scale + offset),
        index,
    };
    let mut keys: Vec<Key> = (0..).zip(&boxes).map(key).collect();
    if keys.len() <= SORTED_BY_STD {
        keys.sort_unstable_by_key(|key| key.code);
    } else {
        keys.radix_sort_unstable();
    }
    let leaf = |key: &Key| Bvh2Node::new(boxes[key.index as usize], 1, key.index as u32);
    keys.iter().map(leaf).collect()
}

/// Half the area of a box around two clusters.
fn cost(a: &Bvh2Node, b: &Bvh2Node) -> f32 {
    a.aabb().union(b.aabb()).half_area()
}

/// Of each cluster which of the two beside it is nearest; the later one of equals.
fn beside(clusters: &[Bvh2Node], nearest: &mut [i8]) {
    let mut before = f32::INFINITY;
    for (pair, nearest) in clusters.windows(2).zip(nearest.iter_mut()) {
        let after = cost(&pair[0], &pair[1]);
        *nearest = if before < after { -1 } else { 1 };
        before = after;
    }
    if let Some(last) = nearest.last_mut() {
        *last = -1;
    }
}

/// The same of all within [`DISTANCE`].
fn within(clusters: &[Bvh2Node], nearest: &mut [i8]) {
    // Of the last clusters the costs with those after them.
    let mut costs = [[0.0_f32; DISTANCE]; DISTANCE];
    for (index, nearest) in nearest.iter_mut().enumerate() {
        let (mut best, mut least) = (0_i8, f32::INFINITY);
        for step in (1..=DISTANCE.min(index)).rev() {
            let cost = costs[(index - step) % DISTANCE][step - 1];
            if cost <= least {
                (best, least) = (-(step as i8), cost);
            }
        }
        let (this, others) = (&clusters[index], &clusters[index + 1..]);
        let own = &mut costs[index % DISTANCE];
        for ((step, other), kept) in (1..).zip(others).zip(own) {
            *kept = cost(this, other);
            if *kept <= least {
                (best, least) = (step, *kept);
            }
        }
        *nearest = best;
    }
}

/// The first with the second, the third with the fourth.
fn pairs(nearest: &mut [i8]) {
    for (index, nearest) in nearest.iter_mut().enumerate() {
        *nearest = if index % 2 == 0 { 1 } else { -1 };
    }
    if let Some(last) = nearest.last_mut() {
        *last = -1;
    }
}
