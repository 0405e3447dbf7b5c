//! The unshadowed diffuse light of a triangle, in closed form.

use lightbvh::{EmissiveTriangle, LightBounds, ShadingPoint};

use crate::vector::{cross, dot, sub};

type V = [f64; 3];

/// Irradiance at a point with a normal, up to a factor common to all lights: Lambert's formula over the part of the triangle
/// above the horizon, times luminance (J. H. Lambert, Photometria, 1760; Arvo, "Analytic methods for simulated light
/// transport", 1995, section 2). Zero behind a one-sided emitter, and from what is too thin to count as a light: no tree
/// chooses it.
pub(in crate::cli) fn irradiance(triangle: &EmissiveTriangle, point: &ShadingPoint) -> f64 {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn lamp(p: [[f32; 3]; 3]) -> EmissiveTriangle {
        EmissiveTriangle {
            p,
            radiance: [1.0; 3],
            mesh: 0,
            flags: 0,
        }
    }

    /// Against the sum over small pieces of cos·cos·area/d².
    #[test]
    fn the_formula_is_the_integral() {
        let triangle = lamp([[-0.4, 1.0, 0.1], [0.9, 1.3, -0.2], [0.2, -0.7, 1.1]]);
        let n = [0.48f32, 0.6, 0.64];
        for (p, sign) in [([0.1, -0.4, -0.3], 1.0), ([0.6, 0.2, 0.9], -1.0)] {
            let point = ShadingPoint {
                p,
                n: n.map(|x| x * sign),
            };
            let two_sided = EmissiveTriangle {
                flags: lightbvh::light::TWO_SIDED,
                ..triangle
            };
            let corners = triangle.p.map(|v| sub(v.map(f64::from), p.map(f64::from)));
            let (e1, e2) = (sub(corners[1], corners[0]), sub(corners[2], corners[0]));
            let normal = cross(e1, e2);
            let steps = 1000;
            let mut sum = 0.0;
            for i in 0..steps {
                for j in 0..steps - i {
                    for third in [1.0 / 3.0, 2.0 / 3.0] {
                        if third > 0.5 && i + j + 1 >= steps {
                            continue;
                        }
                        let (u, v) = (
                            (f64::from(i) + third) / f64::from(steps),
                            (f64::from(j) + third) / f64::from(steps),
                        );
                        let d: V = std::array::from_fn(|k| corners[0][k] + e1[k] * u + e2[k] * v);
                        let squared = dot(d, d);
                        let received = dot(point.n.map(f64::from), d).max(0.0);
                        sum += received * dot(normal, d).abs() / (squared * squared);
                    }
                }
            }
            let expected = sum * 0.5 / f64::from(steps * steps);
            let found = irradiance(&two_sided, &point);
            assert!(
                (found - expected).abs() < 2e-3 * expected.max(1e-3),
                "{found} {expected}"
            );
            let one_sided = irradiance(&triangle, &point);
            let front = dot(normal, corners[0]) < 0.0;
            assert_eq!(one_sided > 0.0, front && expected > 0.0);
        }
    }
}
