//! The cheapest split of a range of primitives.

use super::cost::{Heuristic, Scales};
use super::primitive::{Group, Primitive};
use super::{BuildParams, MAX_BUCKETS};

/// The buckets of one axis; kept from split to split, since most splits are small and need but a few of them.
pub(super) type Buckets = [Group; MAX_BUCKETS as usize];

/// A split plane between two buckets along an axis.
struct Plane {
    axis: usize,
    /// First bucket of the right side.
    bucket: usize,
    bucketing: Bucketing,
}

/// From a centroid to its bucket along one axis.
#[derive(Clone, Copy)]
struct Bucketing {
    low: f32,
    per_width: f32,
    last: usize,
}

impl Bucketing {
    fn new(low: f32, high: f32, buckets: usize) -> Self {
        // Scaled down a little so that the greatest centroid stays in the last bucket.
        Self {
            low,
            per_width: buckets as f32 * (1.0 - 1e-6) / (high - low),
            last: buckets - 1,
        }
    }

    #[inline]
    fn bucket(self, centroid: f32) -> usize {
        let b = ((centroid - self.low) * self.per_width) as i32 as usize;
        if b > self.last { self.last } else { b }
    }
}

/// Splits `range` in two at the cheapest of all planes between buckets, moving the primitives; where all centroids
/// coincide, into equal halves. Returns where the right part begins, in `1..range.len()`, and the unions of both parts
/// where they are known.
pub(super) fn split(
    range: &mut [Primitive],
    node: &Group,
    params: &BuildParams,
    buckets: &mut Buckets,
) -> (usize, Option<[Group; 2]>) {
    if range.len() == 2 {
        return (1, None);
    }
    match cheapest(range, node, params, buckets) {
        Some((plane, groups)) => {
            let middle = partition(range, |p| {
                plane.bucketing.bucket(p.centroid(plane.axis)) < plane.bucket
            });
            (middle, Some(groups))
        }
        None => (range.len() / 2, None),
    }
}

/// Splits `range` into equal halves across the widest side of its centroids.
pub(super) fn halve(range: &mut [Primitive]) -> usize {
    let (low, high) = centroid_box(range);
    let mut axis = 0;
    for k in 1..3 {
        if high[k] - low[k] > high[axis] - low[axis] {
            axis = k;
        }
    }
    let middle = range.len() / 2;
    range.select_nth_unstable_by(middle, |a, b| {
        (a.centroid(axis), a.index)
            .partial_cmp(&(b.centroid(axis), b.index))
            .unwrap_or(core::cmp::Ordering::Equal)
    });
    middle
}

fn cheapest(
    range: &[Primitive],
    node: &Group,
    params: &BuildParams,
    all_buckets: &mut Buckets,
) -> Option<(Plane, [Group; 2])> {
    let (low, high) = centroid_box(range);
    let scales = Scales::of(node);
    let wanted = params.buckets.clamp(2, MAX_BUCKETS) as usize;
    let buckets = if range.len() < wanted { range.len() } else { wanted };

    let mut best = None;
    let mut best_cost = f32::MAX;
    for axis in 0..3 {
        if high[axis] <= low[axis] {
            continue;
        }
        let bucketing = Bucketing::new(low[axis], high[axis], buckets);
        // Extents too small for their reciprocal leave every centroid in one bucket.
        if !bucketing.per_width.is_finite() {
            continue;
        }
        let groups = &mut all_buckets[..buckets];
        groups.fill(Group::EMPTY);
        for p in range {
            groups[bucketing.bucket(p.centroid(axis))].add(p);
        }
        let factor = scales.regularization(params.heuristic, node, axis);
        if let Some((bucket, cost)) = sweep(groups, &scales, params.heuristic, factor, best_cost) {
            best_cost = cost;
            let plane = Plane {
                axis,
                bucket,
                bucketing,
            };
            let [mut left, mut right] = [Group::EMPTY; 2];
            for (b, group) in groups.iter().enumerate() {
                if b < bucket { &mut left } else { &mut right }.merge(group);
            }
            best = Some((plane, [left, right]));
        }
    }
    best
}

/// The cheapest plane between the buckets, as the first bucket of its right side, and its cost times `factor`, if that
/// is below `bound`.
fn sweep(
    groups: &[Group],
    scales: &Scales,
    heuristic: Heuristic,
    factor: f32,
    bound: f32,
) -> Option<(usize, f32)> {
    let mut right_cost = [0.0; MAX_BUCKETS as usize];
    let mut right = Group::EMPTY;
    for b in (1..groups.len()).rev() {
        if groups[b].count > 0 {
            right.merge(&groups[b]);
            right_cost[b] = scales.cost(heuristic, &right);
        } else if b + 1 < groups.len() {
            right_cost[b] = right_cost[b + 1];
        }
    }
    let mut best = None;
    let mut least = bound;
    let mut left = Group::EMPTY;
    let total = right.count + groups[0].count;
    for b in 1..groups.len() {
        if groups[b - 1].count > 0 {
            left.merge(&groups[b - 1]);
            // Where the right side alone costs too much, the left side's cost is not needed.
            if left.count < total && right_cost[b] * factor < least {
                let cost = (scales.cost(heuristic, &left) + right_cost[b]) * factor;
                if cost < least {
                    least = cost;
                    best = Some((b, cost));
                }
            }
        }
    }
    best
}

fn centroid_box(range: &[Primitive]) -> ([f32; 3], [f32; 3]) {
    let (mut low, mut high) = ([f32::MAX; 3], [f32::MIN; 3]);
    for p in range {
        for k in 0..3 {
            let c = p.centroid(k);
            low[k] = if c < low[k] { c } else { low[k] };
            high[k] = if c > high[k] { c } else { high[k] };
        }
    }
    (low, high)
}

/// Moves the primitives for which `is_left` holds to the front and returns their number.
fn partition(range: &mut [Primitive], is_left: impl Fn(&Primitive) -> bool) -> usize {
    let (mut i, mut j) = (0, range.len());
    while i < j {
        if is_left(&range[i]) {
            i += 1;
        } else {
            j -= 1;
            range.swap(i, j);
        }
    }
    i
}

#[cfg(test)]
mod tests;
