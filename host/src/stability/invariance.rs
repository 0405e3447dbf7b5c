//! A scene against itself scaled, turned and moved: by how much its estimate may become worse.

use glam::{DMat3, DQuat, DVec3};
use lightbvh::{BuildParams, EmissiveTriangle, ShadingPoint};

use super::case::{around, validated};
use super::cases::scattered;
use super::checks::all_pmfs;
use super::random::Random;
use super::row::{Check, Row};
use crate::backend::{Bvh, Sampler};
use crate::error::HostError;
use crate::metrics::{mean, variances};
use crate::workload::build;

/// Greatest factor on the standard deviation; see [`Check::Deviation`].
const DEVIATION: f64 = 2.0;

/// A scene and where it is looked at.
#[derive(Clone)]
struct Scene {
    lights: Vec<EmissiveTriangle>,
    points: Vec<ShadingPoint>,
}

impl Scene {
    fn new(lights: Vec<EmissiveTriangle>) -> Self {
        let points = around(&lights, 48, &mut Random::new(7));
        Self { lights, points }
    }

    /// With places, and directions, brought elsewhere.
    fn mapped(&self, place: impl Fn([f32; 3]) -> [f32; 3], direction: impl Fn([f32; 3]) -> [f32; 3]) -> Self {
        let mut mapped = self.clone();
        for vertex in mapped.lights.iter_mut().flat_map(|light| light.p.iter_mut()) {
            *vertex = place(*vertex);
        }
        for point in &mut mapped.points {
            (point.p, point.n) = (place(point.p), direction(point.n));
        }
        mapped
    }

    fn turned(&self, random: &mut Random) -> Self {
        let axis = DVec3::from(random.direction().map(f64::from)).normalize();
        let turn = DMat3::from_quat(DQuat::from_axis_angle(axis, f64::from(random.between(0.1, 3.0))));
        let apply = |v: [f32; 3]| {
            (turn * DVec3::from(v.map(f64::from)))
                .to_array()
                .map(|x| x as f32)
        };
        self.mapped(apply, apply)
    }

    /// Root mean square over the points of the relative standard deviation of one sample's estimate.
    fn deviation(&self, sampler: Sampler) -> Result<f64, HostError> {
        let lights = validated("invariance", self.lights.clone())?;
        let bvh: Bvh = build(&lights, sampler, &BuildParams::default());
        let pmfs = self.points.iter().map(|point| all_pmfs(&bvh, &lights, point));
        let pmfs: Vec<Vec<f32>> = pmfs.collect();
        let pmf = |k: usize, light: u32| pmfs[k][light as usize];
        let variances = variances(&self.lights, &self.points, pmf).into_iter();
        let variances: Vec<f64> = variances.flatten().collect();
        Ok(mean(&variances).sqrt())
    }
}

/// A scene on a grid of 1 m about the origin, and the same at 10^7 m, where that is the grid of f32: no vertex is rounded.
fn offset() -> (Scene, Scene) {
    let random = &mut Random::new(13);
    let light = |mesh: u32| {
        let corner = [0; 3].map(|_| random.between(0.0, 2000.0).floor());
        let mut vertex = || corner.map(|c| c + random.between(-40.0, 40.0).floor());
        EmissiveTriangle {
            p: [corner, vertex(), vertex()],
            radiance: [1.0; 3],
            mesh: mesh / 8,
            flags: u32::from(mesh.is_multiple_of(4)),
        }
    };
    let near = Scene::new((0..400).map(light).collect()).mapped(|p| p.map(f32::floor), |n| n);
    let far = near.mapped(|[x, y, z]| [x + 1e7, y - 1e7, z + 1e7], |n| n);
    (near, far)
}

/// All rows, on the CPU.
pub fn rows() -> Result<Vec<Row>, HostError> {
    let base = Scene::new(scattered(400, 5));
    let tens = (-12..=12).map(|e| 10f32.powi(e));
    let scaled = tens.map(|factor| base.mapped(|p| p.map(|x| x * factor), |n| n));
    let scaled = scaled.collect();
    let random = &mut Random::new(9);
    let turned = (0..12).map(|_| base.turned(random)).collect();
    let (near, far) = offset();
    let groups: [(&str, &Scene, Vec<Scene>); 3] = [
        ("scaled by 1e-12 to 1e12", &base, scaled),
        ("turned", &base, turned),
        ("moved by 1e7 m", &near, vec![far]),
    ];
    let mut rows = Vec::new();
    for (name, base, others) in groups {
        for sampler in [Sampler::SingleLevel, Sampler::TwoLevel] {
            let own = base.deviation(sampler)?;
            let mut worst = 0.0;
            for other in &others {
                let factor = other.deviation(sampler)? / own;
                let value = factor.max(1.0 / factor);
                // What is not a number is beyond any bound.
                if value > worst || value.is_nan() {
                    worst = value;
                }
            }
            rows.push(Row::new(name, sampler.name(), Check::Deviation, worst, DEVIATION));
        }
    }
    Ok(rows)
}
