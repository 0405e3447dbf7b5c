//! Polygons as triangles.

/// Work on concave polygons of one file: the sum of the cubes of their numbers of corners, which bounds the steps of `earcutr`.
const MOST_WORK: u64 = 1 << 36;

/// Cuts the polygons of a file into triangles.
#[derive(Debug, Default)]
pub(super) struct Cutter {
    work: u64,
}

impl Cutter {
    /// Hands triangles of a polygon to `take`, each as three indices of corners, which turn as the polygon does: the fan around
    /// the first corner, unless that turns a triangle over; then ears by `earcutr`, without corners on straight edges.
    ///
    /// # Errors
    /// The error of a polygon if all concave polygons together take too much work.
    pub fn cut(&mut self, corners: &[[f32; 3]], mut take: impl FnMut([usize; 3])) -> Result<(), String> {
        let count = corners.len();
        if let Some(axes) = axes(corners).filter(|_| count > 3)
            && overturns(corners, axes)
        {
            self.work = self.work.saturating_add((count as u64).saturating_pow(3));
            if self.work > MOST_WORK {
                return Err(format!(
                    "a concave polygon of {count} corners is too much work with those before it"
                ));
            }
            let places: Vec<f64> = corners.iter().flat_map(|&corner| place(corner, axes)).collect();
            let indices = earcutr::earcut(&places, &[], 2).unwrap_or_default();
            let ears = indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]);
            let area: f64 = ears
                .clone()
                .map(|t| turn(t.map(|k| place(corners[k], axes))))
                .sum();
            if area != 0.0 {
                ears.for_each(|[a, b, c]| take(if area > 0.0 { [a, b, c] } else { [a, c, b] }));
                return Ok(());
            }
        }
        (2..count).for_each(|k| take([0, k - 1, k]));
        Ok(())
    }
}

/// The axes across which Newell's normal is longest, in the order that makes the area positive. `None` without an area.
fn axes(corners: &[[f32; 3]]) -> Option<[usize; 2]> {
    let from = |k: usize| [0, 1, 2].map(|axis| f64::from(corners[k][axis]) - f64::from(corners[0][axis]));
    let mut normal = [0.0; 3];
    for k in 2..corners.len() {
        let own = crate::vector::cross(from(k - 1), from(k));
        normal = [0, 1, 2].map(|axis| normal[axis] + own[axis]);
    }
    let longest = (0..3).max_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs()))?;
    let (u, v) = ((longest + 1) % 3, (longest + 2) % 3);
    let area = normal[longest];
    (area.is_finite() && area != 0.0).then_some(if area > 0.0 { [u, v] } else { [v, u] })
}

fn place(corner: [f32; 3], [u, v]: [usize; 2]) -> [f64; 2] {
    [f64::from(corner[u]), f64::from(corner[v])]
}

/// Twice the area of a triangle, positive if it turns to the left.
fn turn([a, b, c]: [[f64; 2]; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Whether the fan turns a triangle over, by more than the rounding of its corners can.
fn overturns(corners: &[[f32; 3]], axes: [usize; 2]) -> bool {
    let at = |k: usize| place(corners[k], axes);
    let length = |a: [f64; 2], b: [f64; 2]| (b[0] - a[0]).abs() + (b[1] - a[1]).abs();
    let largest = (0..corners.len()).fold(0.0_f64, |most, k| most.max(at(k)[0].abs()).max(at(k)[1].abs()));
    // Half a unit in the last place at either end.
    let rounding = f64::from(f32::EPSILON) * largest;
    (2..corners.len()).any(|k| {
        let [a, b, c] = [at(0), at(k - 1), at(k)];
        turn([a, b, c]) < -rounding * (length(a, b) + length(a, c))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    fn triangles(corners: &[[f32; 3]]) -> Vec<[usize; 3]> {
        let mut out = Vec::new();
        let cut = Cutter::default().cut(corners, |triangle| out.push(triangle));
        cut.expect("little work");
        out
    }

    fn area(corners: &[[f32; 3]], triangle: [usize; 3], axes: [usize; 2]) -> f64 {
        0.5 * turn(triangle.map(|k| place(corners[k], axes)))
    }

    #[test]
    fn convex_polygons_are_fans() {
        for count in 3..40 {
            let turn = |k: usize| std::f32::consts::TAU * k as f32 / count as f32;
            let corners: Vec<_> = (0..count)
                .map(|k| [1e3 + turn(k).cos(), 2.0, turn(k).sin()])
                .collect();
            let fan: Vec<_> = (2..count).map(|k| [0, k - 1, k]).collect();
            assert_eq!(triangles(&corners), fan);
        }
        assert!(triangles(&[[0.0; 3]; 2]).is_empty());
    }

    /// Stars of any number of corners, from any first corner, in three planes: no triangle turns over, and the areas add up.
    #[test]
    fn concave_polygons_are_covered_once() {
        let mut random = Random::new(1);
        for count in (4..120).step_by(3) {
            let radii: Vec<f32> = (0..count).map(|_| 0.1 + 0.9 * random.unit() as f32).collect();
            for axes in [[0, 1], [1, 2], [2, 0]] {
                let corner = |k: usize| {
                    let turn = std::f32::consts::TAU * k as f32 / count as f32;
                    let mut corner = [0.5; 3];
                    (corner[axes[0]], corner[axes[1]]) = (radii[k] * turn.cos(), radii[k] * turn.sin());
                    corner
                };
                let corners: Vec<_> = (0..count).map(corner).collect();
                let whole: f64 = (2..count).map(|k| area(&corners, [0, k - 1, k], axes)).sum();
                let areas: Vec<f64> = triangles(&corners)
                    .into_iter()
                    .map(|t| area(&corners, t, axes))
                    .collect();
                let sum: f64 = areas.iter().sum();
                assert!(
                    (sum - whole).abs() < 1e-6 && areas.iter().all(|&own| own > -1e-9),
                    "{count}: {areas:?}"
                );
            }
        }
    }

    #[test]
    fn work_on_polygons_that_cross_themselves_is_bounded() {
        for x in [f32::NAN, f32::INFINITY, 3e38] {
            let near = [
                [0.0; 3],
                [x, 1.0, 0.0],
                [0.1, 0.1, 0.0],
                [1.0, x, 0.0],
                [1.0, 1.0, 0.0],
            ];
            assert!(triangles(&near).iter().flatten().all(|&k| k < 5));
        }
        let comb: Vec<_> = (0..5000)
            .map(|k| [k as f32, (k % 2) as f32, 0.0])
            .chain([[2500.0, 9.0, 0.0]])
            .collect();
        let problem = Cutter::default().cut(&comb, |_| ()).expect_err("too much");
        assert!(problem.contains("5001 corners"), "{problem}");
    }
}
