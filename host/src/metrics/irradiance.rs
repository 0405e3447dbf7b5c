//! The unshadowed diffuse light of a triangle, in closed form, and how much its estimate varies.

use lightbvh::{EmissiveTriangle, LightBounds, ShadingPoint};
use rayon::prelude::*;

use super::variance;
use crate::vector::{cross, dot, sub};

type V = [f64; 3];

/// Irradiance at a point with a normal, up to a factor common to all lights: Lambert's formula over the part of the triangle
/// above the horizon, times luminance (J. H. Lambert, Photometria, 1760; Arvo, "Analytic methods for simulated light
/// transport", 1995, section 2). Zero behind a one-sided emitter, and from what is too thin to count as a light: no tree
/// chooses it.
pub fn irradiance(triangle: &EmissiveTriangle, point: &ShadingPoint) -> f64 {
    if LightBounds::of_triangle(triangle).phi <= 0.0 {
        return 0.0;
    }
    let (p, n) = (point.p.map(f64::from), point.n.map(f64::from));
    let corners = triangle.p.map(|vertex| sub(vertex.map(f64::from), p));
    let normal = cross(sub(corners[1], corners[0]), sub(corners[2], corners[0]));
    let front = dot(normal, corners[0]) < 0.0;
    if !(front || triangle.is_two_sided()) || dot(normal, normal) == 0.0 {
        return 0.0;
    }
    let mut polygon: Vec<V> = Vec::with_capacity(4);
    for k in 0..3 {
        let (a, b) = (corners[k], corners[(k + 1) % 3]);
        let (ha, hb) = (dot(n, a), dot(n, b));
        if ha > 0.0 {
            polygon.push(a);
        }
        if (ha > 0.0) != (hb > 0.0) {
            let t = ha / (ha - hb);
            polygon.push(std::array::from_fn(|i| a[i] + (b[i] - a[i]) * t));
        }
    }
    let mut sum = 0.0;
    for k in 0..polygon.len() {
        let (a, b) = (polygon[k], polygon[(k + 1) % polygon.len()]);
        let across = cross(a, b);
        let sine = dot(across, across).sqrt();
        if sine > 0.0 {
            sum += sine.atan2(dot(a, b)) * dot(across, n) / sine;
        }
    }
    f64::from(triangle.luminance()) * sum.abs() * 0.5
}

/// The relative variance of one sample of diffuse light without shadows at each point, by the probability of each light, asked for
/// by the numbers of point and light; `None` where no light arrives.
pub fn variances(
    lights: &[EmissiveTriangle],
    points: &[ShadingPoint],
    pmf: impl Fn(usize, u32) -> f32 + Sync,
) -> Vec<Option<f64>> {
    let of = |(k, point): (usize, &ShadingPoint)| {
        let sent = lights.iter().map(|light| irradiance(light, point));
        let lit = (0..).zip(sent).filter(|(_, sent)| *sent > 0.0);
        variance(lit.map(|(light, sent)| (sent, f64::from(pmf(k, light)))))
    };
    points.par_iter().enumerate().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbvh::light::Light;

    fn lamp(p: [[f32; 3]; 3]) -> EmissiveTriangle {
        EmissiveTriangle {
            p,
            radiance: [1.0; 3],
            mesh: 0,
            flags: 0,
        }
    }

    /// Against the mean over many points on the triangle.
    #[test]
    fn the_formula_is_the_integral() {
        let triangle = lamp([[-0.4, 1.0, 0.1], [0.9, 1.3, -0.2], [0.2, -0.7, 1.1]]);
        let n = [0.48f32, 0.6, 0.64];
        for (p, sign) in [([0.1, -0.4, -0.3], 1.0), ([0.6, 0.2, 0.9], -1.0)] {
            let n = n.map(|x| x * sign);
            let point = ShadingPoint { p, n };
            let two_sided = EmissiveTriangle {
                flags: lightbvh::light::TWO_SIDED,
                ..triangle
            };
            let mean = |light: &EmissiveTriangle| {
                let middle = |k: u16| (f32::from(k) + 0.5) / 400.0;
                let places = (0..400).flat_map(|i| (0..400).map(move |j| [middle(i), middle(j)]));
                let sent = places.map(|uv| f64::from(light.point_for(p.into(), uv).irradiance(&point)[0]));
                sent.sum::<f64>() / (400.0 * 400.0)
            };
            for light in [triangle, two_sided] {
                let (found, expected) = (irradiance(&light, &point), mean(&light));
                assert!(
                    (found - expected).abs() < 2e-3 * expected.max(1e-3),
                    "{found} {expected}"
                );
            }
        }
    }
}
