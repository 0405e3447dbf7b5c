//! Lights and points of the speed bar.

use lightbvh::exact::{hash, unit_f32};
use lightbvh::{EmissiveTriangle, Lights, Random64, ShadingPoint};
use lightbvh_kernels::query::Query;

/// Side of the box that the lights lie in and edge of a light, metres.
const SIDE: f32 = 100.0;
const EDGE: f32 = 0.1;
/// Cells along each side that group the triangles into mesh lights: about a hundred triangles each at 10^5.
const CELLS: u32 = 10;

/// Small triangles anywhere in the box, grouped into mesh lights by the cell that they lie in.
pub(super) fn random_lights(count: u32) -> Lights {
    let draw = |i: u32, k: u32| unit_f32(hash(hash(i).wrapping_add(k)));
    let mut triangles: Vec<(u32, EmissiveTriangle)> = (0..count)
        .map(|i| {
            let corner: [f32; 3] = std::array::from_fn(|k| draw(i, k as u32) * SIDE);
            let vertex = |v: u32| std::array::from_fn(|k| corner[k] + EDGE * draw(i, 3 + 3 * v + k as u32));
            let radiance = std::array::from_fn(|k| 0.1 + draw(i, 12 + k as u32));
            let cell = corner.map(|c| (c / SIDE * CELLS as f32) as u32);
            let cell = (cell[0] * CELLS + cell[1]) * CELLS + cell[2];
            let p = [vertex(0), vertex(1), vertex(2)];
            (
                cell,
                EmissiveTriangle {
                    p,
                    radiance,
                    mesh: 0,
                    flags: 0,
                },
            )
        })
        .collect();
    triangles.sort_by_key(|&(cell, _)| cell);
    let mut mesh = 0;
    let mut last = None;
    let numbered = triangles.into_iter().map(|(cell, mut triangle)| {
        mesh += u32::from(last.is_some_and(|last| last != cell));
        last = Some(cell);
        triangle.mesh = mesh;
        triangle
    });
    Lights::new(numbered.collect()).expect("the lights are made within the domain")
}

/// Points in the box with any normal.
pub(super) fn random_queries(count: u32) -> Vec<Query> {
    (0..count)
        .map(|i| {
            let draw = |k: u32| unit_f32(hash(hash(!i).wrapping_add(k)));
            let p = std::array::from_fn(|k| draw(k as u32) * SIDE);
            let d: [f32; 3] = std::array::from_fn(|k| 2.0 * draw(3 + k as u32) - 1.0);
            let length = d.iter().map(|x| x * x).sum::<f32>().sqrt().max(1e-6);
            let number = Random64::from(hash(i));
            Query {
                point: ShadingPoint {
                    p,
                    n: d.map(|x| x / length),
                },
                words: [number.high, number.low],
            }
        })
        .collect()
}
