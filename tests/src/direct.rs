//! Direct lighting by brute force in f64: every light, many points on each, every surface tried for every shadow ray.
//! Nothing of the renderer is in it.

use glam::DVec3;
use lightbvh::{EmissiveTriangle, ShadingPoint};

use crate::generate::Random;
use crate::oracle::{Triangle, vector};
use crate::statistics::Mean;

/// The cosine-weighted radiance that arrives at `point` from `y` on a light, per area of the light: L cos θ cos θ' / d²
/// with the red radiance as L. In a volume there is no cosine at the receiver.
#[must_use]
pub fn arriving(point: &ShadingPoint, light: &EmissiveTriangle, y: DVec3) -> f64 {
    let (p, n) = (vector(point.p), vector(point.n));
    let d = y - p;
    let w = d.normalize();
    let received = if n == DVec3::ZERO { 1.0 } else { n.dot(w).max(0.0) };
    let emitted = -Triangle::new(light).normal.normalize().dot(w);
    let emitted = if light.is_two_sided() {
        emitted.abs()
    } else {
        emitted.max(0.0)
    };
    f64::from(light.radiance[0]) * received * emitted / d.length_squared()
}

/// Whether the open segment from `a` to `b` meets the triangle (the plane's distances, then the sides by their volumes).
#[must_use]
pub fn blocks(t: &[DVec3; 3], a: DVec3, b: DVec3) -> bool {
    let n = (t[1] - t[0]).cross(t[2] - t[0]);
    let (da, db) = (n.dot(a - t[0]), n.dot(b - t[0]));
    if da * db >= 0.0 {
        return false;
    }
    let d = b - a;
    let side = |i: usize| d.dot((t[i] - a).cross(t[(i + 1) % 3] - a));
    let (u, v, w) = (side(0), side(1), side(2));
    (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0)
}

/// The estimate of the integral over all lights: its mean, and the standard error of it.
#[derive(Clone, Copy, Debug)]
pub struct Reference {
    /// The sum over all lights.
    pub sum: f64,
    /// Its standard error.
    pub error: f64,
}

/// The sum over all lights of [`arriving`] times area, each by `side`² jittered points, shadowed by `occluders` and by
/// the other lights.
#[must_use]
pub fn brute_force(
    point: &ShadingPoint,
    lights: &[EmissiveTriangle],
    occluders: &[[[f32; 3]; 3]],
    side: u32,
    random: &mut Random,
) -> Reference {
    let p = vector(point.p);
    let walls: Vec<[DVec3; 3]> = occluders.iter().map(|t| t.map(vector)).collect();
    let lamps: Vec<Triangle> = lights.iter().map(Triangle::new).collect();
    let (mut sum, mut variance) = (0.0, 0.0);
    for (i, light) in lights.iter().enumerate() {
        let [p0, p1, p2] = lamps[i].p;
        let mut mean = Mean::default();
        for cell in 0..side * side {
            let u = f64::from(cell % side) + f64::from(random.unit());
            let v = f64::from(cell / side) + f64::from(random.unit());
            let (u, v) = (u / f64::from(side), v / f64::from(side));
            // Uniform on the triangle by the square root, where the renderer folds.
            let root = u.sqrt();
            let y = p0 * (1.0 - root) + p1 * (root * (1.0 - v)) + p2 * (root * v);
            let arrives = arriving(point, light, y);
            let shadowed = arrives > 0.0
                && (walls.iter().any(|t| blocks(t, p, y))
                    || lamps
                        .iter()
                        .enumerate()
                        .any(|(k, t)| k != i && blocks(&t.p, p, y)));
            mean.add(if shadowed { 0.0 } else { arrives * lamps[i].area() });
        }
        sum += mean.mean();
        // Jittered points vary less than independent ones, so this is an upper bound.
        variance += mean.error() * mean.error();
    }
    Reference {
        sum,
        error: variance.sqrt(),
    }
}
