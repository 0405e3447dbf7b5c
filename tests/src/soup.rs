//! Triangle soups for the ray tests.

use crate::generate::Random;
use lightbvh_kernels::shading::trace::{NONE, SurfaceTriangle};

/// A point of the cube `[-size, size)^3`.
pub fn in_cube(random: &mut Random, size: f32) -> [f32; 3] {
    [0; 3].map(|_| random.between(-size, size))
}

/// `count` random triangles with edges up to `edge` in a cube of half width `size`; with `grid`, all coordinates are
/// whole numbers, so that triangles coincide, line up with the axes, and degenerate.
pub fn soup(random: &mut Random, count: usize, size: f32, edge: f32, grid: bool) -> Vec<SurfaceTriangle> {
    let place = |x: f32| if grid { x.round() } else { x };
    (0..count)
        .map(|_| {
            let center = in_cube(random, size);
            let p = [0; 3].map(|_| {
                let offset = in_cube(random, edge);
                [0, 1, 2].map(|i| place(center[i] + offset[i]))
            });
            SurfaceTriangle {
                p,
                material: 0,
                light: NONE,
                instance: NONE,
            }
        })
        .collect()
}
