//! The unshadowed diffuse light of a light of any kind: of triangles in closed form, of others by points on them.

use lightbvh::light::{AnyLight, Light};
use lightbvh::{EmissiveTriangle, ShadingPoint};

use super::irradiance::irradiance;

/// Points along each axis of a light that has an extent.
const POINTS: u8 = 8;

/// Luminance of the irradiance at a point with a normal. Points and spots are exact; what has an extent is a mean over 64
/// points on it, evenly spread; a profile is taken as bright in all of its cone as where it is brightest, for no tree knows
/// more of it.
pub(in crate::cli) fn irradiance_of(light: &AnyLight, point: &ShadingPoint) -> f64 {
    let light = match EmissiveTriangle::try_from(*light) {
        Ok(triangle) => return irradiance(&triangle, point),
        Err(other) => other,
    };
    if !light.has_flux() {
        return 0.0;
    }
    let middle = |k: u8| (f32::from(k) + 0.5) / f32::from(POINTS);
    let places = (0..POINTS).flat_map(|i| (0..POINTS).map(move |j| [middle(i), middle(j)]));
    let sum: f64 = places
        .map(|uv| {
            let sent = light.point_for(point.p.into(), uv).irradiance(point);
            let [r, g, b] = sent.map(f64::from);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        })
        .sum();
    sum / (f64::from(POINTS) * f64::from(POINTS))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbvh::light::PointLight;

    #[test]
    fn a_point_sends_its_cosine_over_the_squared_distance() {
        let at = ShadingPoint {
            p: [1.0, 0.0, 0.0],
            n: [0.0, 1.0, 0.0],
        };
        let (squared, cosine) = (10.0_f64, 3.0 / 10.0_f64.sqrt());
        let point = PointLight {
            p: [0.0, 3.0, 0.0],
            intensity: [5.0; 3],
            range: 0.0,
            mesh: 0,
        };
        let expected = 5.0 * cosine / squared;
        let found = irradiance_of(&point.into(), &at);
        // One root that is right to 5e-6 (`exact::rsqrt`), and a dozen operations in `f32`.
        assert!((found - expected).abs() < 1e-5 * expected, "{found} {expected}");
        let dark = PointLight {
            intensity: [0.0; 3],
            ..point
        };
        assert_eq!(irradiance_of(&dark.into(), &at), 0.0);
    }
}
