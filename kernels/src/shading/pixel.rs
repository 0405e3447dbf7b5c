//! What a ray sees of a scene.

use glam::Vec3;
use lightbvh::device::vector::{cross, dot, flush3, length_squared};
use lightbvh::{EmissiveTriangle, Instance, ShadingPoint};

use super::area::{Connection, offset_distance};
use super::emitter::Emitter;
use super::emitters::Emitters;
use super::grid::{TINY_AREA, div, sqrt};
use super::material::Material;
use super::ray::Ray;
use super::textures::{Spot, Textures};
use super::trace::{LANES, NONE, RayNode, Surfaces, TriangleBlock, any_hit, closest_hit, vertex};

/// Everything that light meets.
#[derive(Clone, Copy)]
pub struct Scene<'a, L: Emitter = EmissiveTriangle> {
    /// What rays hit.
    pub surfaces: Surfaces<'a, L::Textures<'a>>,
    /// How it reflects; indexed by the triangles.
    pub materials: &'a [Material],
    /// What of it emits.
    pub emitters: Emitters<'a, L>,
}

impl<'a, L: Emitter> Scene<'a, L> {
    /// The scene that a kernel's buffers hold.
    #[inline]
    #[must_use]
    pub fn new(
        nodes: &'a [RayNode],
        blocks: &'a [TriangleBlock],
        materials: &'a [Material],
        lights: &'a [L],
        instances: &'a [Instance],
        textures: L::Textures<'a>,
    ) -> Self {
        Self {
            surfaces: Surfaces {
                nodes,
                blocks,
                textures,
            },
            materials,
            emitters: Emitters { lights, instances },
        }
    }

    /// How what was seen reflects.
    #[inline]
    #[must_use]
    pub fn material(&self, seen: &Seen) -> Material {
        self.surfaces
            .textures
            .material(self.materials, seen.material, &seen.spot)
    }

    /// `light`, which is number `number`, as it glows at the point that `uv` chooses.
    #[inline]
    #[must_use]
    pub fn glowing(&self, light: L, number: u32, uv: [f32; 2]) -> L {
        let mut glowing = light;
        if <L::Textures<'_> as Textures>::HAS_TEXTURES {
            // The parts of a triangle's edges, as `uniform_point` folds them.
            let fold = uv[0] + uv[1] > 1.0;
            let at = if fold { [1.0 - uv[0], 1.0 - uv[1]] } else { uv };
            let Surfaces { blocks, textures, .. } = self.surfaces;
            glowing = light.with_emission(textures.glow(blocks, number, at, light.emission()));
        }
        glowing
    }
}

/// What of `connection` arrives at `point`: nothing where anything but `light` lies between.
#[inline]
#[must_use]
pub fn arriving<L: Emitter>(
    scene: &Scene<'_, L>,
    point: &ShadingPoint,
    connection: &Connection,
    light: u32,
) -> Vec3 {
    let ray = Ray::new(point.position(), connection.direction, 1.0);
    let mut left = connection.contribution;
    if any_hit(&scene.surfaces, &ray, light) {
        left = Vec3::ZERO;
    }
    left
}

/// What a camera ray sees.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// The point to be lit, moved off its surface towards the viewer, and the normal on that side. Zero normal: the ray
    /// left the scene, or hit what cannot be shaded.
    pub point: ShadingPoint,
    /// Unit direction to the viewer.
    pub wo: Vec3,
    /// Index of the material.
    pub material: u32,
    /// What arrives without being reflected: the radiance of a light seen directly, or the background.
    pub direct: Vec3,
    /// What was met.
    pub spot: Spot,
}

/// What a ray meets, and how far away.
#[derive(Clone, Copy, Debug)]
pub struct Encounter {
    /// What it sees.
    pub seen: Seen,
    /// The light that it met, or [`NONE`].
    pub light: u32,
    /// The instance of that light.
    pub instance: u32,
    /// Distance in multiples of the ray's direction; the ray's end if it met nothing.
    pub distance: f32,
}

/// Follows `ray` to the first surface.
#[inline]
#[must_use]
pub fn see<L: Emitter>(scene: &Scene<'_, L>, ray: &Ray, background: Vec3) -> Seen {
    encounter(scene, ray, background).seen
}

/// [`see`], and what a path needs to know besides.
#[inline]
#[must_use]
pub fn encounter<L: Emitter>(scene: &Scene<'_, L>, ray: &Ray, background: Vec3) -> Encounter {
    let blocks = scene.surfaces.blocks;
    let hit = closest_hit(&scene.surfaces, ray);
    let mut seen = Seen {
        point: ShadingPoint {
            p: [0.0; 3],
            n: [0.0; 3],
        },
        wo: Vec3::ZERO,
        material: 0,
        direct: background,
        spot: Spot {
            triangle: hit.triangle,
            at: [0.0; 2],
        },
    };
    let mut light = NONE;
    let mut instance = NONE;
    let (block, lane) = (hit.triangle as usize / LANES, hit.triangle as usize % LANES);
    if block < blocks.len() {
        let p0 = vertex(blocks, hit.triangle, 0);
        let p1 = vertex(blocks, hit.triangle, 1);
        let p2 = vertex(blocks, hit.triangle, 2);
        let e1 = p1 - p0;
        let e2 = p2 - p0;
        let m = flush3(cross(e1, e2), TINY_AREA);
        let length = sqrt(length_squared(m));
        let front = dot(m, ray.direction) < 0.0;
        let [a, b] = ray.barycentric(p0, e1, e2);
        seen.spot.at = [a, b];
        if length > TINY_AREA {
            let side = div(if front { 1.0 } else { -1.0 }, length);
            let n = m * side;
            // From the barycentric coordinates: off the plane only by the rounding of the triangle's own coordinates, however far away
            // the ray started.
            let p = ((p0 + e1 * a) + e2 * b) + n * offset_distance(p0, p1, p2);
            seen.wo = -ray.direction * div(1.0, sqrt(length_squared(ray.direction)));
            seen.point = ShadingPoint {
                p: [p.x, p.y, p.z],
                n: [n.x, n.y, n.z],
            };
        }
        seen.material = blocks[block].material[lane];
        light = blocks[block].light[lane];
        instance = blocks[block].instance[lane];
        seen.direct = emitted(scene, light, instance, front, seen.spot.at);
    }
    Encounter {
        seen,
        light,
        instance,
        distance: hit.t,
    }
}

/// The radiance of a light seen from its front or back; none where there is no such light.
#[inline]
fn emitted<L: Emitter>(scene: &Scene<'_, L>, light: u32, instance: u32, front: bool, at: [f32; 2]) -> Vec3 {
    let mut radiance = Vec3::ZERO;
    if light != NONE {
        let mut own = scene.emitters.light(light, instance);
        if <L::Textures<'_> as Textures>::HAS_TEXTURES {
            let Surfaces { blocks, textures, .. } = scene.surfaces;
            own = own.with_emission(textures.glow(blocks, light, at, own.emission()));
        }
        radiance = own.emitted(front);
    }
    radiance
}
