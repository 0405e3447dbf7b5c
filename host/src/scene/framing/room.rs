//! What rays meet in a frame.

use glam::Vec3;
use lightbvh_kernels::shading::ray::{FAR, Ray};
use lightbvh_kernels::shading::trace::{LANES, NONE, SurfaceTriangle, any_hit, closest_hit};

use super::super::model::Material;
use super::spread::unit;
use crate::render::RayBvh;
use crate::vector::{dot, normal, sub};

/// What a back counts against a front: models are made to be seen from their fronts, and a wall's back hides its room. Of
/// two-sided materials it is meant to be seen too, but many programs write all materials as such.
const BACK: f64 = 0.15;
const BACK_OF_TWO: f64 = 0.3;

/// What a ray meets first.
pub(super) struct Met {
    /// Index of the triangle in the frame.
    pub triangle: usize,
    /// The normal of its front, a unit vector.
    pub n: [f64; 3],
    pub material: u32,
    /// How far away, in lengths of the direction.
    pub t: f64,
}

impl Met {
    /// Whether a ray in direction `d` meets the back.
    pub fn is_back(&self, d: [f64; 3]) -> bool {
        dot(self.n, d) > 0.0
    }
}

/// The triangles of a frame, ready for rays.
pub(super) struct Room {
    rays: RayBvh,
    /// What the back of each material counts.
    backs: Vec<f64>,
}

impl Room {
    /// None where rays cannot be traced; such a scene is refused when it is rendered.
    pub fn new(triangles: &[SurfaceTriangle], materials: &[Material]) -> Option<Self> {
        let rays = RayBvh::build(triangles).ok()?;
        let backs = materials
            .iter()
            .map(|material| if material.double_sided { BACK_OF_TWO } else { BACK });
        Some(Self {
            rays,
            backs: backs.collect(),
        })
    }

    /// What the back of a material counts against its front.
    pub fn back(&self, material: u32) -> f64 {
        self.backs.get(material as usize).copied().unwrap_or(BACK)
    }

    /// What is met from `from` in direction `d`.
    pub fn meet(&self, from: [f64; 3], d: [f64; 3]) -> Option<Met> {
        let hit = closest_hit(&self.rays.surfaces(), &Ray::new(narrowed(from), narrowed(d), FAR));
        let (block, lane) = (hit.triangle as usize / LANES, hit.triangle as usize % LANES);
        let triangle = self.rays.blocks.get(block)?.get(lane)?;
        Some(Met {
            triangle: self.rays.sources()[hit.triangle as usize] as usize,
            n: unit(normal(triangle.p)),
            material: triangle.material,
            t: f64::from(hit.t),
        })
    }

    /// Whether nothing lies between two points.
    pub fn is_clear(&self, from: [f64; 3], to: [f64; 3]) -> bool {
        let ray = Ray::new(narrowed(from), narrowed(sub(to, from)), 1.0 - 1e-6);
        !any_hit(&self.rays.surfaces(), &ray, NONE)
    }

    /// Whether nothing lies in a direction, without end.
    pub fn is_open(&self, from: [f64; 3], d: [f64; 3]) -> bool {
        let ray = Ray::new(narrowed(from), narrowed(d), FAR);
        !any_hit(&self.rays.surfaces(), &ray, NONE)
    }
}

fn narrowed(v: [f64; 3]) -> Vec3 {
    Vec3::from(v.map(|x| x as f32))
}
