//! Polygons as triangles.

mod notches;
#[cfg(test)]
mod tests;

use std::collections::VecDeque;

use notches::Notches;

/// A place in the plane of a polygon.
type Place = [f64; 2];

/// Hands `n - 2` triangles of a polygon of `n` corners to `take`, each as three indices of corners, which turn as the polygon
/// does. Nothing is handed over for less than 3 corners.
///
/// It is the fan around the first corner, unless that turns a triangle over. Then ears are cut (G. Meisters, "Polygons Have
/// Ears", 1975). The plane is that of two axes, across which Newell's normal is longest, so places and the signs of areas are
/// all but exact. The triangles cover a simple polygon once, also one to whose outline seams join holes. Of others, and of
/// those without an area, they are some.
///
/// Time is in proportion to `n log n`: what is left after [`Notches`] has looked into as many boxes as it may is a fan.
pub(super) fn cut(corners: &[[f32; 3]], mut take: impl FnMut([usize; 3])) {
    let axes = if corners.len() > 3 { axes(corners) } else { None };
    if let Some(axes) = axes
        && overturns(corners, axes)
    {
        let places = corners.iter().map(|&corner| place(corner, axes)).collect();
        Ring::new(places).cut(take);
    } else {
        (2..corners.len()).for_each(|k| take([0, k - 1, k]));
    }
}

/// The axes of a plane onto which a polygon is laid, in the order that makes its area positive. `None` of polygons without an area.
fn axes(corners: &[[f32; 3]]) -> Option<[usize; 2]> {
    let from = |k: usize| [0, 1, 2].map(|axis| f64::from(corners[k][axis]) - f64::from(corners[0][axis]));
    let mut normal = [0.0; 3];
    for k in 2..corners.len() {
        let (a, b) = (from(k - 1), from(k));
        for (axis, sum) in normal.iter_mut().enumerate() {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            *sum += a[u] * b[v] - a[v] * b[u];
        }
    }
    let longest = (0..3).max_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs()))?;
    let (u, v) = ((longest + 1) % 3, (longest + 2) % 3);
    let area = normal[longest];
    (area.is_finite() && area != 0.0).then_some(if area > 0.0 { [u, v] } else { [v, u] })
}

fn place(corner: [f32; 3], [u, v]: [usize; 2]) -> Place {
    [f64::from(corner[u]), f64::from(corner[v])]
}

/// Twice the area of a triangle, positive where it turns to the left.
fn turn([a, b, c]: [Place; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Whether the fan turns a triangle over, by more than the rounding of its corners can.
fn overturns(corners: &[[f32; 3]], axes: [usize; 2]) -> bool {
    let at = |k: usize| place(corners[k], axes);
    let length = |a: Place, b: Place| (b[0] - a[0]).abs() + (b[1] - a[1]).abs();
    let largest = (0..corners.len()).fold(0.0_f64, |most, k| most.max(at(k)[0].abs()).max(at(k)[1].abs()));
    // Half a unit in the last place at either end.
    let rounding = f64::from(f32::EPSILON) * largest;
    (2..corners.len()).any(|k| {
        let [a, b, c] = [at(0), at(k - 1), at(k)];
        turn([a, b, c]) < -rounding * (length(a, b) + length(a, c))
    })
}

/// What is left of a polygon.
struct Ring {
    places: Vec<Place>,
    before: Vec<usize>,
    after: Vec<usize>,
    notches: Notches,
}

impl Ring {
    fn new(places: Vec<Place>) -> Self {
        let count = places.len();
        let before: Vec<usize> = (0..count).map(|k| (k + count - 1) % count).collect();
        let after: Vec<usize> = (0..count).map(|k| (k + 1) % count).collect();
        let is_notch = |&k: &usize| turn([before[k], k, after[k]].map(|corner| places[corner])) <= 0.0;
        let notches = Notches::new(&places, (0..count).filter(is_notch).collect());
        Self {
            places,
            before,
            after,
            notches,
        }
    }

    fn cut(&mut self, mut take: impl FnMut([usize; 3])) {
        let count = self.places.len();
        let (mut left, mut first) = (count, 0);
        for strictly in [true, false] {
            // Corners wait in line. Those beside a cut go to its end, or long thin triangles around one corner came out. A cut
            // changes what they are, and nothing of others.
            let mut rounds = vec![0_u32; count];
            let mut line = VecDeque::with_capacity(2 * count);
            let mut corner = first;
            for _ in 0..left {
                line.push_back((corner, 0));
                corner = self.after[corner];
            }
            while left > 3
                && let Some((corner, round)) = line.pop_front()
            {
                if round != rounds[corner] || !self.is_ear(corner, strictly) {
                    continue;
                }
                let (before, after) = (self.before[corner], self.after[corner]);
                take([before, corner, after]);
                self.after[before] = after;
                self.before[after] = before;
                rounds[corner] = u32::MAX;
                (left, first) = (left - 1, after);
                for beside in [before, after] {
                    rounds[beside] += 1;
                    line.push_back((beside, rounds[beside]));
                }
            }
        }
        let mut corner = self.after[first];
        for _ in 2..left {
            let next = self.after[corner];
            take([first, corner, next]);
            corner = next;
        }
    }

    fn turn_of(&self, triangle: [usize; 3]) -> f64 {
        turn(triangle.map(|corner| self.places[corner]))
    }

    fn turn_at(&self, corner: usize) -> f64 {
        self.turn_of([self.before[corner], corner, self.after[corner]])
    }

    /// Whether the triangle of a corner and the two beside it lies in the polygon. `strictly`, it has an area and so has what it
    /// leaves.
    fn is_ear(&mut self, corner: usize, strictly: bool) -> bool {
        let (before, after) = (self.before[corner], self.after[corner]);
        let area = self.turn_of([before, corner, after]);
        if area <= 0.0 {
            return area == 0.0 && !strictly;
        }
        let lies = |area: f64| area > 0.0 || area == 0.0 && !strictly;
        // Of a dull corner all that is to the left of one edge is within; of one that folds back, none.
        let at_before =
            self.turn_at(before) < 0.0 || lies(self.turn_of([self.before[before], before, after]));
        let at_after = self.turn_at(after) < 0.0 || lies(self.turn_of([before, after, self.after[after]]));
        if !at_before || !at_after {
            return false;
        }
        let triangle = [before, corner, after].map(|corner| self.places[corner]);
        !self.notches.any_in(triangle)
    }
}
