//! Small worlds, paths in them by every way of finding lights, and comparisons of their means.

use glam::Vec3;
use lightbvh::{
    BuildParams, EmissiveTriangle, Instance, LightBvh, Lights, Random64, SampledLight, ShadingPoint, exact,
};
use lightbvh_host::render::{RayBvh, power_thresholds};
use lightbvh_kernels::shading::emitters::{Emitters, listed};
use lightbvh_kernels::shading::material::Material;
use lightbvh_kernels::shading::path::path_radiance;
use lightbvh_kernels::shading::pick::{PickLight, Power, Uniform};
use lightbvh_kernels::shading::pixel::Scene;
use lightbvh_kernels::shading::ray::Ray;
use lightbvh_kernels::shading::sky::NoSky;
use lightbvh_kernels::shading::trace::{NONE, SurfaceTriangle};
use lightbvh_tests::statistics::{Mean, normal_quantile};

/// Chance that a right renderer fails one comparison.
pub const TAIL: f64 = 1e-7;

/// Rays start 2^-18 of the coordinates off their surfaces, and f32 rounds: a relative error left out of the test.
pub const RENDERER_ERROR: f64 = 1e-3;

/// Finds no light: every light is then found by sampled directions alone.
pub struct Nothing;

impl PickLight for Nothing {
    fn pick(&self, _point: &ShadingPoint, _random: Random64) -> SampledLight {
        SampledLight {
            light: NONE,
            instance: NONE,
            pmf: 0.0,
        }
    }

    fn pmf(&self, _point: &ShadingPoint, _light: u32, _instance: u32) -> f32 {
        0.0
    }
}

pub fn matte(albedo: f32) -> Material {
    Material {
        albedo: [albedo; 3],
        specular: 0.0,
        exponent_log2: 0,
    }
}

pub fn glossy(albedo: f32, specular: f32, exponent_log2: u32) -> Material {
    Material {
        albedo: [albedo; 3],
        specular,
        exponent_log2,
    }
}

/// Triangles, the first of them lights, all of one material.
pub struct World {
    pub bvh: RayBvh,
    pub lights: Vec<EmissiveTriangle>,
    instances: [Instance; 1],
    pub materials: Vec<Material>,
}

impl World {
    pub fn new(lights: Vec<EmissiveTriangle>, others: &[[[f32; 3]; 3]], material: Material) -> Self {
        let mut surfaces: Vec<SurfaceTriangle> = lights
            .iter()
            .zip(0..)
            .map(|(l, light)| SurfaceTriangle {
                p: l.p,
                material: 0,
                light,
                instance: l.mesh,
            })
            .collect();
        surfaces.extend(others.iter().map(|&p| SurfaceTriangle {
            p,
            material: 0,
            light: NONE,
            instance: NONE,
        }));
        Self {
            bvh: RayBvh::build(&surfaces).expect("a ray BVH"),
            instances: listed(lights.len() as u32),
            lights,
            materials: vec![material],
        }
    }

    pub fn scene(&self) -> Scene<'_> {
        Scene {
            sky: NoSky,
            surfaces: self.bvh.surfaces(),
            materials: &self.materials,
            emitters: Emitters {
                triangles: &self.lights,
                instances: &self.instances,
            },
        }
    }

    /// The mean over `count` paths along `ray`.
    pub fn paths<P: PickLight>(&self, picker: &P, ray: &Ray, sky: f32, bounces: u32, count: u32) -> Mean {
        let mut mean = Mean::default();
        for path in 0..count {
            let seed = exact::hash(path ^ bounces << 24);
            let value = path_radiance(&self.scene(), ray, Vec3::splat(sky), picker, bounces, seed);
            mean.add(f64::from(value.x));
        }
        mean
    }

    /// [`paths`](Self::paths) with each picker, and with none.
    pub fn each_picker(&self, ray: &Ray, bounces: u32, count: u32) -> Vec<(&'static str, Mean)> {
        let triangles = &self.lights[..];
        let lights = Lights::new(triangles.to_vec()).expect("within the domain");
        let uniform = Uniform {
            count: triangles.len() as u32,
        };
        let thresholds = power_thresholds(triangles).expect("a power");
        let power = Power {
            thresholds: &thresholds,
        };
        let one = LightBvh::single_level(&lights, &BuildParams::default());
        let two = LightBvh::two_level(&lights, &BuildParams::default());
        let [one, two] = [&one, &two].map(|bvh| bvh.tree());
        vec![
            ("uniform", self.paths(&uniform, ray, 0.0, bounces, count)),
            ("power", self.paths(&power, ray, 0.0, bounces, count)),
            ("single-level", self.paths(&one, ray, 0.0, bounces, count)),
            ("two-level", self.paths(&two, ray, 0.0, bounces, count)),
            ("directions alone", self.paths(&Nothing, ray, 0.0, bounces, count)),
        ]
    }
}

pub fn light(p: [[f32; 3]; 3], radiance: f32, mesh: u32, flags: u32) -> EmissiveTriangle {
    EmissiveTriangle {
        p,
        radiance: [radiance; 3],
        mesh,
        flags,
    }
}

/// The two triangles of a parallelogram; their front is where `u`, `v` run counter-clockwise.
pub fn quad(corner: [f32; 3], u: [f32; 3], v: [f32; 3]) -> [[[f32; 3]; 3]; 2] {
    let [c, u, v] = [corner, u, v].map(Vec3::from);
    let [a, b, d] = [(c + u).into(), (c + u + v).into(), (c + v).into()];
    [[corner, a, b], [corner, b, d]]
}

/// A cube from 0 to 4 m seen from inside: the fronts of its six sides.
pub fn cube() -> Vec<[[f32; 3]; 3]> {
    let (x, y, z) = ([4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]);
    [
        quad([0.0; 3], z, x),
        quad(y, x, z),
        quad([0.0; 3], x, y),
        quad(z, y, x),
        quad([0.0; 3], y, z),
        quad(x, z, y),
    ]
    .concat()
}

pub fn agree(what: &str, a: &Mean, b: f64, b_error: f64) {
    let tolerance = normal_quantile(TAIL) * a.error().hypot(b_error) + RENDERER_ERROR * b;
    assert!(
        (a.mean() - b).abs() <= tolerance,
        "{what}: {} ± {}, expected {b} ± {b_error}",
        a.mean(),
        a.error()
    );
    // A comparison that allows everything shows nothing.
    assert!(tolerance < 0.1 * b, "{what}: {b} ± {tolerance}");
}
