//! How far away a camera stands so that what is to be seen fills the image.

use crate::vector::dot;

/// The image that is filled, its columns by its rows: between 4:3 and 16:9, so that neither cuts much nor leaves much empty.
const ASPECT: f64 = 1.5;

/// Part of the image that is filled, along the axis that is filled first.
const FILLED: f64 = 0.88;

/// The axes of a camera: right, up, forward.
pub(super) type Axes = [[f64; 3]; 3];

/// The eye that is as near as it can be to `points`, each with a weight, while points of no more than `part` of all weight lie
/// beyond each side of the image of half height `tangent`. None without points.
///
/// A point lies within the right side where x − x₀ ≤ a (z − z₀), a the side's slope; so x₀ − a z₀ must be at least the largest
/// x − a z of all points, and likewise for the other sides. Two opposite sides give the place across and the depth; the depth
/// further back holds for both pairs.
pub(super) fn eye(points: &[([f64; 3], f64)], axes: &Axes, tangent: f64, part: f64) -> Option<[f64; 3]> {
    let [right, up, forward] = axes;
    let outside = part * points.iter().map(|(_, weight)| weight).sum::<f64>();
    let side = |across: &[f64; 3], sign: f64, slope: f64| {
        let place = |p: &[f64; 3]| sign * dot(*across, *p) - slope * dot(*forward, *p);
        if part == 0.0 {
            return points.iter().map(|(p, _)| place(p)).reduce(f64::max);
        }
        let mut places: Vec<(f64, f64)> = points.iter().map(|(p, weight)| (place(p), *weight)).collect();
        places.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut sum = 0.0;
        let within = places.iter().find(|(_, weight)| {
            sum += weight;
            sum > outside
        });
        within.or(places.last()).map(|(place, _)| *place)
    };
    // Across, and depth: the sides x₀ − a z₀ = r and −x₀ − a z₀ = l meet there.
    let pair = |across: &[f64; 3], slope: f64| {
        let (r, l) = (side(across, 1.0, slope)?, side(across, -1.0, slope)?);
        Some((0.5 * (r - l), -0.5 * (r + l) / slope))
    };
    let slope = FILLED * tangent;
    let (x, behind_x) = pair(right, slope * ASPECT)?;
    let (y, behind_y) = pair(up, slope)?;
    let z = behind_x.min(behind_y);
    Some([0, 1, 2].map(|i| x * right[i] + y * up[i] + z * forward[i]))
}

#[cfg(test)]
mod tests {
    use super::*;

    const AXES: Axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]];

    /// Half height of a point in the image, in half images.
    fn half_image(p: [f64; 3], eye: [f64; 3], tangent: f64) -> [f64; 2] {
        let depth = eye[2] - p[2];
        [0, 1].map(|i| (p[i] - eye[i]).abs() / (depth * tangent))
    }

    #[test]
    fn the_longer_side_fills_the_image() {
        let corner = |x: f64, y: f64| ([7.0 + x, 3.0 + y, -2.0], 1.0);
        let tangent = 0.5;
        for (wide, high) in [(4.0, 1.0), (1.0, 4.0), (2.0, 2.0)] {
            let points = [
                corner(wide, high),
                corner(-wide, high),
                corner(wide, -high),
                corner(-wide, -high),
            ];
            let eye = eye(&points, &AXES, tangent, 0.0).expect("points");
            for (p, _) in points {
                let [x, y] = half_image(p, eye, tangent);
                let fills = (x / ASPECT).max(y);
                assert!((fills - FILLED).abs() < 1e-9, "{fills} of {wide} by {high}");
            }
        }
    }

    #[test]
    fn a_point_of_little_weight_may_lie_outside() {
        let mut points = vec![
            ([-1.0, -1.0, 0.0], 1.0),
            ([1.0, 1.0, 0.0], 1.0),
            ([500.0, 0.0, 0.0], 0.01),
        ];
        let near = eye(&points, &AXES, 0.5, 0.02).expect("points");
        let all = eye(&points, &AXES, 0.5, 0.0).expect("points");
        assert!(near[2] < 4.0, "{near:?}");
        assert!(half_image(points[2].0, all, 0.5)[0] < ASPECT, "{all:?}");
        points.clear();
        assert_eq!(eye(&points, &AXES, 0.5, 0.0), None);
    }
}
