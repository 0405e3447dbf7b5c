//! Trees that the builders make: the domain's ends, meshes in the world.

use lightbvh::{BuildParams, Bvh, EmissiveTriangle, LightBounds, LightNode, Lights, exact};

use super::links::of_bvh;
use crate::generate::{Random, extreme_triangle, log_uniform, small_triangles};
use crate::known::tree::Tree;

pub(super) fn checked(triangles: Vec<EmissiveTriangle>) -> Lights {
    Lights::new(triangles).expect("within the domain")
}

pub(super) fn extremes<N: LightNode<W>, const W: usize>(random: &mut Random) -> Tree<N, W> {
    // A few without area or flux among those with it.
    let mut triangles: Vec<_> = (0..6).map(|_| extreme_triangle(random)).collect();
    while triangles.len() < 40 {
        let triangle = extreme_triangle(random);
        if LightBounds::of_triangle(&triangle).phi > 0.0 {
            triangles.push(triangle);
        }
    }
    // Most on both sides and of radiances near each other, so that many lights have a chance to be drawn.
    for triangle in triangles.iter_mut().skip(3) {
        triangle.flags = u32::from(random.below(4) > 0);
        let radiance = log_uniform(random, -6, 6);
        triangle.radiance = triangle.radiance.map(|x| if x > 0.0 { radiance } else { 0.0 });
    }
    // Coordinates and radiances at the very ends, and the flux that each may have.
    let (far, tiny) = (exact::pow2(40), exact::pow2(-100));
    triangles[0].p = [[-far; 3], [far, -far, far], [far, far, -far]];
    triangles[0].radiance = [exact::pow2(-22); 3];
    triangles[1].p = [[0.0; 3], [tiny, 0.0, 0.0], [0.0, tiny, 0.0]];
    triangles[1].radiance = [tiny; 3];
    let edge = exact::pow2(-96);
    triangles[2].p = [[0.0; 3], [edge, 0.0, 0.0], [0.0, 0.0, edge]];
    triangles[2].radiance = [exact::pow2(100); 3];
    let lights = checked(triangles);
    of_bvh(&Bvh::single_level(&lights, &BuildParams::default()), &lights)
}

pub(super) fn two_levels<N: LightNode<W>, const W: usize>(random: &mut Random) -> Tree<N, W> {
    let mut triangles = small_triangles(60, 6, 10.0, 0.5, true, random.bits());
    for (i, triangle) in triangles.iter_mut().enumerate() {
        triangle.flags = u32::from(i % 5 == 0);
        let factor = [1.0, 1e-12, 1e9, 0.0][i / 6 % 4];
        triangle.radiance = triangle.radiance.map(|x| x * factor);
    }
    let lights = checked(triangles);
    of_bvh(&Bvh::two_level(&lights, &BuildParams::default()), &lights)
}
