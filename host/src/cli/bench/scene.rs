//! Lights and points of the speed bar.

use lightbvh::{EmissiveTriangle, Lights, Random64, ShadingPoint};
use lightbvh_kernels::query::Query;

use crate::stability::random::Random;

/// Side of the box that the lights lie in and edge of a light, metres.
const SIDE: f32 = 100.0;
const EDGE: f32 = 0.1;
/// Cells along each side that group the triangles into mesh lights: about a hundred triangles each at 10^5.
const CELLS: u32 = 10;

/// Small triangles anywhere in the box, grouped into mesh lights by the cell that they lie in.
pub(super) fn random_lights(count: u32) -> Lights {
    let random = &mut Random::new(1);
    let triangle = |_| {
        let corner = [0; 3].map(|_| random.between(0.0, SIDE));
        let cell = corner.map(|c| (c / SIDE * CELLS as f32) as u32);
        let mut vertex = || corner.map(|c| c + random.between(0.0, EDGE));
        EmissiveTriangle {
            p: [vertex(), vertex(), vertex()],
            radiance: [0; 3].map(|_| random.between(0.1, 1.1)),
            mesh: (cell[0] * CELLS + cell[1]) * CELLS + cell[2],
            flags: 0,
        }
    };
    let mut triangles: Vec<EmissiveTriangle> = (0..count).map(triangle).collect();
    triangles.sort_by_key(|triangle| triangle.mesh);
    // Meshes are numbered without gaps.
    for (mesh, own) in (0..).zip(triangles.chunk_by_mut(|a, b| a.mesh == b.mesh)) {
        own.iter_mut().for_each(|triangle| triangle.mesh = mesh);
    }
    Lights::new(triangles).expect("the lights are made within the domain")
}

/// Points in the box with any normal.
pub(super) fn random_queries(count: u32) -> Vec<Query> {
    let random = &mut Random::new(2);
    let query = |_| {
        let number = Random64::from(random.bits());
        Query {
            point: ShadingPoint {
                p: [0; 3].map(|_| random.between(0.0, SIDE)),
                n: random.direction(),
            },
            words: [number.high, number.low],
        }
    };
    (0..count).map(query).collect()
}
