//! What is painted on the surface of a pixel, which its record does not say.

use glam::Vec3;

use super::super::emitter::Emitter;
use super::super::material::Material;
use super::super::pixel::{Scene, load_material};
use super::super::ray::{FAR, Ray};
use super::super::skin::{GLASS, Skin, Spot, TOUCH, Through};
use super::super::trace::{LANES, NONE, nearest, through, vertex};
use super::surface::Surface;
use crate::shading::grid::sqrt;

/// How the surface reflects, and what clear surfaces before it leave of that. The point is just before its triangle: a ray from there into
/// the image finds it.
#[inline]
#[must_use]
pub fn seen_again<L: Emitter>(scene: &Scene<'_, L>, surface: &Surface) -> (Material, Vec3) {
    let mut material = Material {
        albedo: [0.0; 3],
        specular: 0.0,
        exponent_log2: 0,
    };
    let mut tint = Vec3::ONE;
    if surface.is_lit() && surface.material < scene.materials.len() as u32 {
        material = load_material(scene.materials, surface.material);
        if <L::Skin<'_> as Skin>::IS_PAINTED {
            let blocks = scene.surfaces.blocks;
            let origin = surface.point.position();
            let ray = Ray::new(origin, -surface.wo(), FAR);
            let hit = nearest::<TOUCH, _>(&scene.surfaces, &ray);
            let (block, lane) = (hit.triangle as usize / LANES, hit.triangle as usize % LANES);
            // A neighbour at an edge is of another material at times.
            if block < blocks.len() && blocks[block].material[lane] == surface.material {
                let p0 = vertex(blocks, hit.triangle, 0);
                let e1 = vertex(blocks, hit.triangle, 1) - p0;
                let e2 = vertex(blocks, hit.triangle, 2) - p0;
                let spot = Spot {
                    triangle: hit.triangle,
                    at: ray.barycentric(p0, e1, e2),
                };
                material = scene
                    .surfaces
                    .skin
                    .material(scene.materials, surface.material, &spot);
            }
            if scene.surfaces.skin.has_glass() {
                let back = Ray::new(origin, surface.wo(), sqrt(surface.distance_squared));
                tint = through::<GLASS, _>(&scene.surfaces, &back, NONE).of(Vec3::ONE);
            }
        }
    }
    (material, tint)
}
