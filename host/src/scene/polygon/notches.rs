//! Where a polygon is not convex.

use super::{Place, turn};

/// Boxes that are looked into for each corner of a polygon.
pub(super) const MOST_LOOKS: usize = 1024;

/// A part of lengths, more than their products and sums are rounded by.
const ROUNDING: f64 = 1.0 / (1_u64 << 40) as f64;

/// The corners at which a polygon does not turn to the left: one lies in a triangle of three others where any corner does. They
/// are those of the whole polygon; one that turns to the left later, or is cut, does no harm. Boxes around them are the nodes
/// of a binary tree, whose root is 1 and where those below `k` are `2 k` and `2 k + 1`.
pub(super) struct Notches {
    boxes: Vec<Upright>,
    /// Of nodes that are no leaves.
    slanted: Vec<Slanted>,
    looks: usize,
    stack: Vec<usize>,
}

/// A box along the axes.
#[derive(Clone, Copy)]
struct Upright {
    low: Place,
    high: Place,
}

/// A box along a line on which corners nearly lie, as the notches of a comb do: in an upright one lies much else.
#[derive(Clone, Copy, Default)]
struct Slanted {
    from: Place,
    /// Its corners, from there.
    corners: [Place; 4],
    /// More than any of them is away.
    size: f64,
}

impl Notches {
    pub(super) fn new(places: &[Place], mut corners: Vec<usize>) -> Self {
        let room = corners.len().next_power_of_two();
        let mut notches = Self {
            boxes: vec![Upright::NOTHING; 2 * room],
            slanted: vec![Slanted::default(); room],
            looks: MOST_LOOKS * places.len(),
            stack: Vec::new(),
        };
        notches.arrange(1, places, &mut corners);
        notches
    }

    /// Gives corners leaves below a node, those that are near each other to nodes near each other.
    fn arrange(&mut self, node: usize, places: &[Place], corners: &mut [usize]) {
        let Some(&corner) = corners.first() else {
            return;
        };
        if self.is_leaf(node) {
            self.boxes[node] = Upright::around(places[corner]);
            return;
        }
        let all = corners.iter().map(|&corner| Upright::around(places[corner]));
        let around = all.fold(Upright::NOTHING, Upright::union);
        self.boxes[node] = around;
        let extent = [0, 1].map(|axis| around.high[axis] - around.low[axis]);
        let axis = usize::from(extent[1] > extent[0]);
        let along = |a: &usize, b: &usize| places[*a][axis].total_cmp(&places[*b][axis]).then(a.cmp(b));
        let ends = [
            corners.iter().min_by(|a, b| along(a, b)),
            corners.iter().max_by(|a, b| along(a, b)),
        ];
        let ends = ends.map(|corner| corner.map_or([0.0; 2], |&corner| places[corner]));
        self.slanted[node] = Slanted::around(ends, corners.iter().map(|&corner| places[corner]));
        // Nodes of a level have room for as many.
        let half = self.slanted.len() >> (node.ilog2() + 1);
        let (low, high) = if corners.len() > half {
            corners.select_nth_unstable_by(half, along);
            corners.split_at_mut(half)
        } else {
            corners.split_at_mut(corners.len())
        };
        self.arrange(2 * node, places, low);
        self.arrange(2 * node + 1, places, high);
    }

    fn is_leaf(&self, node: usize) -> bool {
        node >= self.slanted.len()
    }

    /// Whether one lies in a triangle that turns to the left, or on its edges, or may as there were too many looks. Those where
    /// its corners are do not count.
    pub(super) fn any_in(&mut self, triangle: [Place; 3]) -> bool {
        self.stack.clear();
        self.stack.push(1);
        while let Some(node) = self.stack.pop() {
            let Some(looks) = self.looks.checked_sub(1) else {
                return true;
            };
            self.looks = looks;
            let around = self.boxes[node];
            if !around.meets(triangle) {
                continue;
            }
            if self.is_leaf(node) {
                if !triangle.contains(&around.low) {
                    return true;
                }
            } else if !self.slanted[node].misses(triangle) {
                self.stack.extend([2 * node, 2 * node + 1]);
            }
        }
        false
    }

    /// Boxes that may still be looked into.
    #[cfg(test)]
    pub(super) fn looks(&self) -> usize {
        self.looks
    }
}

impl Upright {
    const NOTHING: Self = Self {
        low: [f64::INFINITY; 2],
        high: [f64::NEG_INFINITY; 2],
    };

    fn around(place: Place) -> Self {
        Self {
            low: place,
            high: place,
        }
    }

    fn union(self, other: Self) -> Self {
        Self {
            low: [0, 1].map(|axis| self.low[axis].min(other.low[axis])),
            high: [0, 1].map(|axis| self.high[axis].max(other.high[axis])),
        }
    }

    /// Whether it may have a place in common with a triangle; exact where it has no size.
    fn meets(self, [a, b, c]: [Place; 3]) -> bool {
        let Self { low, high } = self;
        let apart = [0, 1].iter().any(|&axis| {
            a[axis].max(b[axis]).max(c[axis]) < low[axis] || high[axis] < a[axis].min(b[axis]).min(c[axis])
        });
        let reaches = |from: Place, to: Place| {
            // Its place that is farthest to the left of the edge.
            let x = if to[1] > from[1] { low[0] } else { high[0] };
            let y = if to[0] > from[0] { high[1] } else { low[1] };
            turn([from, to, [x, y]]) >= 0.0
        };
        !apart && reaches(a, b) && reaches(b, c) && reaches(c, a)
    }
}

impl Slanted {
    /// Along the line between two places.
    fn around([from, to]: [Place; 2], places: impl Iterator<Item = Place>) -> Self {
        let line = [to[0] - from[0], to[1] - from[1]];
        let square = line[0] * line[0] + line[1] * line[1];
        let (mut low, mut high) = ([0.0_f64; 2], [0.0_f64; 2]);
        for place in places.filter(|_| square > 0.0) {
            let [x, y] = [place[0] - from[0], place[1] - from[1]];
            let parts = [x * line[0] + y * line[1], y * line[0] - x * line[1]];
            for (axis, part) in parts.into_iter().enumerate() {
                low[axis] = low[axis].min(part / square);
                high[axis] = high[axis].max(part / square);
            }
        }
        let corner = |[s, t]: Place| [s * line[0] - t * line[1], s * line[1] + t * line[0]];
        let corners = [low, [low[0], high[1]], [high[0], low[1]], high].map(corner);
        let size = corners
            .iter()
            .flatten()
            .fold(0.0, |size: f64, c| size.max(2.0 * c.abs()));
        Self { from, corners, size }
    }

    /// Whether all of it is to the right of an edge of a triangle that turns to the left.
    fn misses(&self, [a, b, c]: [Place; 3]) -> bool {
        [(a, b), (b, c), (c, a)].into_iter().any(|(from, to)| {
            let edge = [to[0] - from[0], to[1] - from[1]];
            let away = [self.from[0] - from[0], self.from[1] - from[1]];
            let length = |[x, y]: Place| x.abs() + y.abs();
            let least = -ROUNDING * length(edge) * (length(away) + self.size);
            (self.corners.iter()).all(|[x, y]| edge[0] * (away[1] + y) - edge[1] * (away[0] + x) < least)
        })
    }
}
