//! Small worlds for the reference renderer, ways to find their lights, and comparisons of means.

use glam::Vec3;
use lightbvh::{
    BuildParams, EmissiveTriangle, Heuristic, Instance, LightBvh, Lights, Random64, SampledLight,
    ShadingPoint,
};
use lightbvh_host::render::{RayBvh, power_thresholds};
use lightbvh_kernels::shading::emitters::{Emitters, listed};
use lightbvh_kernels::shading::material::Material;
use lightbvh_kernels::shading::pick::{PickLight, Power, Uniform};
use lightbvh_kernels::shading::pixel::{Scene, Seen};
use lightbvh_kernels::shading::textures::Spot;
use lightbvh_kernels::shading::trace::{NONE, SurfaceTriangle};

use crate::statistics::{Mean, normal_quantile};

/// Chance that a right renderer fails one comparison.
pub const TAIL: f64 = 1e-7;

/// Rays start 2^-18 of the coordinates off their surfaces, and f32 rounds: a relative error left out of comparisons.
pub const RENDERER_ERROR: f64 = 1e-3;

/// Vertices of a triangle.
pub type Corners = [[f32; 3]; 3];

/// A surface of this albedo and gloss.
#[must_use]
pub fn glossy(albedo: f32, specular: f32, exponent_log2: u32) -> Material {
    Material {
        albedo: [albedo; 3],
        specular,
        exponent_log2,
    }
}

/// A surface without gloss.
#[must_use]
pub fn matte(albedo: f32) -> Material {
    glossy(albedo, 0.0, 0)
}

/// A light of even radiance.
#[must_use]
pub fn light(p: Corners, radiance: f32, mesh: u32, flags: u32) -> EmissiveTriangle {
    EmissiveTriangle {
        p,
        radiance: [radiance; 3],
        mesh,
        flags,
    }
}

/// The two triangles of a parallelogram; their front is where `u`, `v` run counter-clockwise.
#[must_use]
pub fn quad(corner: [f32; 3], u: [f32; 3], v: [f32; 3]) -> [Corners; 2] {
    let [c, u, v] = [corner, u, v].map(Vec3::from);
    let [a, b, d] = [(c + u).into(), (c + u + v).into(), (c + v).into()];
    [[corner, a, b], [corner, b, d]]
}

/// Triangles, the first of them lights, all of one material.
pub struct World {
    /// The surfaces.
    pub bvh: RayBvh,
    /// The lights.
    pub lights: Vec<EmissiveTriangle>,
    instances: [Instance; 1],
    material: [Material; 1],
}

impl World {
    /// Of lights, which can be seen too, and others.
    ///
    /// # Panics
    /// If a coordinate is out of the domain.
    #[must_use]
    pub fn new(lights: Vec<EmissiveTriangle>, others: &[Corners], material: Material) -> Self {
        let surface = |p, light, instance| SurfaceTriangle {
            p,
            material: 0,
            light,
            instance,
        };
        let bright = lights
            .iter()
            .zip(0..)
            .map(|(l, light)| surface(l.p, light, l.mesh));
        let dark = others.iter().map(|&p| surface(p, NONE, NONE));
        let surfaces: Vec<SurfaceTriangle> = bright.chain(dark).collect();
        Self {
            bvh: RayBvh::build(&surfaces).expect("a ray BVH"),
            instances: listed(lights.len() as u32),
            lights,
            material: [material],
        }
    }

    /// What the renderer takes.
    #[must_use]
    pub fn scene(&self) -> Scene<'_> {
        Scene {
            surfaces: self.bvh.surfaces(),
            materials: &self.material,
            emitters: Emitters {
                lights: &self.lights,
                instances: &self.instances,
            },
        }
    }

    /// Calls `test` with each way to choose a light.
    ///
    /// # Panics
    /// If a light is out of the domain.
    pub fn each_picker(&self, mut test: impl FnMut(&'static str, By<'_>)) {
        let lights = Lights::new(self.lights.clone()).expect("within the domain");
        let uniform = Uniform {
            count: self.lights.len() as u32,
        };
        let thresholds = power_thresholds(&self.lights).expect("a power");
        let power = Power {
            thresholds: &thresholds,
        };
        let sah = BuildParams {
            heuristic: Heuristic::Sah,
            ..BuildParams::default()
        };
        let one = LightBvh::single_level(&lights, &BuildParams::default());
        let two = LightBvh::two_level(&lights, &sah);
        test("uniform", By(&uniform));
        test("power", By(&power));
        test("single-level", By(&one.tree()));
        test("two-level", By(&two.tree()));
    }
}

/// What is seen at `point` from direction `wo` in a [`World`].
#[must_use]
pub fn seen(point: ShadingPoint, wo: Vec3) -> Seen {
    Seen {
        point,
        wo,
        material: 0,
        direct: Vec3::ZERO,
        spot: Spot {
            triangle: NONE,
            at: [0.0; 2],
        },
    }
}

/// Whatever picks.
#[derive(Clone, Copy)]
pub struct By<'a>(pub &'a dyn PickLight);

impl PickLight for By<'_> {
    fn pick(&self, point: &ShadingPoint, random: Random64) -> SampledLight {
        self.0.pick(point, random)
    }

    fn pmf(&self, point: &ShadingPoint, light: u32, instance: u32) -> f32 {
        self.0.pmf(point, light, instance)
    }
}

/// Asserts that a mean agrees with a reference; returns the tolerance.
///
/// # Panics
/// If it does not.
pub fn agrees(what: &str, found: &Mean, reference: f64, reference_error: f64) -> f64 {
    let tolerance = normal_quantile(TAIL) * found.error().hypot(reference_error) + RENDERER_ERROR * reference;
    assert!(
        (found.mean() - reference).abs() <= tolerance,
        "{what}: {} ± {}, expected {reference} ± {reference_error}",
        found.mean(),
        found.error()
    );
    tolerance
}
