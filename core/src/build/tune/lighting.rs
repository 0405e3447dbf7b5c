//! The light that is to be estimated.

use crate::exact;
use crate::light::EmissiveTriangle;
use crate::point::ShadingPoint;

/// What a light contributes to a point. Lights are as they stand in the world, their `mesh` the index of the instance.
pub trait Lighting {
    /// Without shadows, up to a factor common to all lights and points; finite, not negative, and
    /// at most 1e100, as which greater ones count.
    fn light(&self, point: &ShadingPoint, light: &EmissiveTriangle) -> f64;

    /// The share of it that arrives, 0 to 1: what a shadow ray finds on average. All of it, unless the caller can tell.
    fn seen(&self, _point: &ShadingPoint, _light: &EmissiveTriangle) -> f64 {
        1.0
    }
}

/// A white diffuse surface, each light a point at its centroid, all of it seen. Coarse where lights are near for their size.
#[derive(Clone, Copy, Debug, Default)]
pub struct Diffuse;

impl Lighting for Diffuse {
    fn light(&self, point: &ShadingPoint, light: &EmissiveTriangle) -> f64 {
        let [a, b, c] = light.p.map(|p| p.map(f64::from));
        let (p, n) = (point.p.map(f64::from), point.n.map(f64::from));
        let to_light: [f64; 3] = core::array::from_fn(|k| (a[k] + b[k] + c[k]) / 3.0 - p[k]);
        let squared = dot(to_light, to_light);
        if squared <= 0.0 {
            return 0.0;
        }
        // Twice the area times the cosine times the distance; so is what is received, but for the area.
        let sent = -dot(cross(minus(b, a), minus(c, a)), to_light);
        let sent = if light.is_two_sided() {
            sent.max(-sent)
        } else {
            sent.max(0.0)
        };
        // A point in a volume receives from everywhere.
        let received = match point.n {
            [0.0, 0.0, 0.0] => sqrt(squared),
            _ => dot(n, to_light).max(0.0),
        };
        f64::from(light.luminance()) * received * sent / (squared * squared)
    }
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|k| a[k] - b[k])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|k| {
        let (k, l) = ((k + 1) % 3, (k + 2) % 3);
        a[k] * b[l] - a[l] * b[k]
    })
}

/// To the precision of an `f32`, which is enough here, and all there is without the standard library.
fn sqrt(value: f64) -> f64 {
    f64::from(exact::sqrt(value as f32))
}
