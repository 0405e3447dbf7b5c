//! Lights by formula in a frame: where they stand, and what of them is seen.

use lightbvh::light::{AnyLight, DiscLight, RectangleLight, SphereLight};
use lightbvh_kernels::shading::material::Material as SurfaceMaterial;
use lightbvh_kernels::shading::trace::SurfaceTriangle;

use super::analytic::{AnalyticKind, AnalyticLight};
use super::animate::Pose;
use super::flush::rounded;
use super::frame::Frame;
use super::model::SceneData;
use super::transform::to_light_bvh;

/// Facets of a sphere around its axis, and sides of a disc; facets of a sphere from pole to pole.
const AROUND: usize = 24;
const RINGS: usize = 12;

/// How lamps reflect.
const LAMP: SurfaceMaterial = SurfaceMaterial {
    albedo: [0.2; 3],
    specular: 0.0,
    exponent_log2: 0,
};

impl AnalyticLight {
    /// How many triangles show it.
    pub(super) fn facets(&self) -> usize {
        match self.kind {
            AnalyticKind::Sphere { .. } => 2 * AROUND * (RINGS - 1),
            AnalyticKind::Disc { .. } => AROUND,
            AnalyticKind::Rectangle { .. } => 2,
            _ => 0,
        }
    }
}

/// Appends the lights by formula, each a mesh light of its own after those of triangles, and the surfaces of those that have one.
pub(super) fn place(data: &SceneData, pose: &Pose, out: &mut Frame) {
    let material = out.materials.len() as u32;
    for (k, own) in (0..).zip(&data.analytic) {
        let (mesh, light) = (out.mesh_lights.len() as u32 + k, out.emissive.len() as u32 + k);
        let world = to_light_bvh(&pose.place_of(own)).place(&own.light(), mesh);
        out.others.push(world);
        let shown = shown(world).into_iter().map(|p| SurfaceTriangle {
            p: p.map(rounded),
            material,
            light,
            instance: mesh,
        });
        out.triangles.extend(shown);
    }
    if !out.others.is_empty() {
        out.materials.push(LAMP);
    }
}

/// What is seen of a light, the front of each triangle outside. A sphere's and a disc's facets lie within them: no ray to a
/// point on such a light ends at its own surface.
fn shown(light: AnyLight) -> Vec<[[f64; 3]; 3]> {
    if let Ok(RectangleLight { p, half, .. }) = RectangleLight::try_from(light) {
        let corner = |x, y| at(p, &half, [x, y]);
        let [a, b, c, d] = [
            corner(-1.0, -1.0),
            corner(1.0, -1.0),
            corner(1.0, 1.0),
            corner(-1.0, 1.0),
        ];
        vec![[a, b, c], [a, c, d]]
    } else if let Ok(DiscLight { p, half, .. }) = DiscLight::try_from(light) {
        let rim = |k: usize| at(p, &half, circle(k));
        let center = at(p, &half, [0.0; 2]);
        (0..AROUND).map(|k| [center, rim(k), rim(k + 1)]).collect()
    } else if let Ok(SphereLight { p, radius, .. }) = SphereLight::try_from(light) {
        let point = |ring: usize, k: usize| {
            let angle = std::f64::consts::PI * ring as f64 / RINGS as f64;
            let ([x, z], flat) = (circle(k), libm::sin(angle));
            let v = [x * flat, libm::cos(angle), z * flat];
            [0, 1, 2].map(|axis| f64::from(p[axis]) + f64::from(radius) * v[axis])
        };
        let quad = |ring: usize, k: usize| {
            let [a, b, c, d] =
                [(ring, k), (ring, k + 1), (ring + 1, k + 1), (ring + 1, k)].map(|(ring, k)| point(ring, k));
            // At the poles one of the two has no area.
            let upper = (ring > 0).then_some([a, b, c]);
            let lower = (ring + 1 < RINGS).then_some([a, c, d]);
            upper.into_iter().chain(lower)
        };
        (0..RINGS)
            .flat_map(|ring| (0..AROUND).flat_map(move |k| quad(ring, k)))
            .collect()
    } else {
        Vec::new()
    }
}

/// The point of a flat light at `x` and `y` half axes from its centre.
fn at(p: [f32; 3], half: &[[f32; 3]; 2], [x, y]: [f64; 2]) -> [f64; 3] {
    [0, 1, 2].map(|axis| f64::from(p[axis]) + x * f64::from(half[0][axis]) + y * f64::from(half[1][axis]))
}

/// The `k`-th of [`AROUND`] points of a circle; the first again after the last, to the bit.
fn circle(k: usize) -> [f64; 2] {
    let angle = std::f64::consts::TAU * (k % AROUND) as f64 / AROUND as f64;
    [libm::cos(angle), libm::sin(angle)]
}
