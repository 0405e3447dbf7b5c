//! Lights and points to test with: seeded, and with the degenerate cases in.

use lightbvh::device::cone::{Cone, normalized};
use lightbvh::light::Light;
use lightbvh::{BuildParams, EmissiveTriangle, Heuristic, LightBounds, Lights, ShadingPoint, exact};
pub use lightbvh_host::stability::random::Random;

/// `count` random small triangles of edge about `edge` in a box of side `side`, in meshes of `per_mesh`; the triangles
/// of a mesh lie near each other when `clustered`.
#[must_use]
pub fn small_triangles(
    count: u32,
    per_mesh: u32,
    side: f32,
    edge: f32,
    clustered: bool,
    seed: u32,
) -> Vec<EmissiveTriangle> {
    let mut random = Random::new(seed);
    let mut center = [0.0; 3];
    (0..count)
        .map(|i| {
            if i % per_mesh == 0 || !clustered {
                center = [0; 3].map(|_| random.between(0.0, side));
            }
            let spread = if clustered { side * 0.01 } else { 0.0 };
            let corner = center.map(|c| c + spread * random.unit());
            let mut vertex = || corner.map(|c| c + edge * random.unit());
            let p = [vertex(), vertex(), vertex()];
            let radiance = [0; 3].map(|_| 0.1 + random.unit());
            EmissiveTriangle {
                p,
                radiance,
                mesh: i / per_mesh,
                flags: 0,
            }
        })
        .collect()
}

/// Trees split top-down by `heuristic` in so many buckets.
#[must_use]
pub fn split(heuristic: Heuristic, buckets: u32) -> BuildParams {
    BuildParams {
        buckets,
        ..BuildParams::paper(heuristic)
    }
}

/// A shading point in a box a little larger than `side`; one in eight is in a volume.
pub fn point(random: &mut Random, side: f32) -> ShadingPoint {
    let p = [0; 3].map(|_| random.between(-0.2 * side, 1.2 * side));
    let n = if random.below(8) == 0 {
        [0.0; 3]
    } else {
        random.direction()
    };
    ShadingPoint { p, n }
}

/// 2^e with `e` uniform in `low..=high`, times a significand.
pub fn log_uniform(random: &mut Random, low: i32, high: i32) -> f32 {
    let e = low + random.below((high - low + 1) as u32) as i32;
    exact::pow2(e) * (1.0 + random.unit())
}

/// A triangle anywhere in the crate's domain: edges of 2^-100 to 2^39 m near the origin or far from it, needles, thin
/// boxes, without area, one-sided or not, radiance 2^-100 to 2^100.
pub fn extreme_triangle(random: &mut Random) -> EmissiveTriangle {
    let scale = log_uniform(random, -99, 37);
    let edge = |random: &mut Random| random.direction().map(|x| x * scale);
    let corner = match random.below(3) {
        0 => [0.0; 3],
        1 => edge(random),
        _ => {
            let far = log_uniform(random, 0, 36);
            random.direction().map(|x| x * far)
        }
    };
    let (mut e1, mut e2) = (edge(random), edge(random));
    match random.below(8) {
        // A needle, by a short edge or by two edges almost the same.
        0 => e2 = e2.map(|x| x * exact::pow2(-(random.below(30) as i32))),
        1 => {
            let share = exact::pow2(-(random.below(30) as i32));
            e2 = [0, 1, 2].map(|k| e1[k] + e2[k] * share);
        }
        // A box without extent along an axis, or two.
        2 => {
            let k = random.below(3) as usize;
            (e1[k], e2[k]) = (0.0, 0.0);
        }
        3 => {
            let k = random.below(3) as usize;
            e1 = [0.0; 3];
            e1[k] = scale;
        }
        // No area.
        4 => e2 = e1.map(|x| 0.5 * x),
        5 => (e1, e2) = ([0.0; 3], [0.0; 3]),
        _ => {}
    }
    let radiance = [0; 3].map(|_| {
        if random.below(4) == 0 {
            0.0
        } else {
            log_uniform(random, -100, 99)
        }
    });
    let add = |a: [f32; 3], b: [f32; 3]| [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
    let triangle = EmissiveTriangle {
        p: [corner, add(corner, e1), add(corner, e2)],
        radiance,
        mesh: 0,
        flags: u32::from(random.below(4) == 0),
    };
    triangle.checked().expect("within the domain")
}

/// Bounds of any kind: of triangles, or with any cone.
pub fn any_bounds(random: &mut Random) -> LightBounds {
    let mut bounds = LightBounds::of_triangle(&extreme_triangle(random));
    if random.below(4) > 0 {
        let cone = any_cone(random);
        (bounds.axis, bounds.cos_theta_o) = (cone.axis, cone.cos_theta_o);
    }
    if random.below(4) > 0 {
        bounds.phi = log_uniform(random, -100, 99);
    }
    bounds
}

/// A cone about any axis, along the coordinate axes too, with half-angles near 0 and π.
pub fn any_cone(random: &mut Random) -> Cone {
    let axis = match random.below(3) {
        0 => {
            let mut axis = [0.0; 3];
            axis[random.below(3) as usize] = if random.below(2) == 0 { 1.0 } else { -1.0 };
            axis
        }
        _ => random.direction(),
    };
    let cos_theta_o = match random.below(6) {
        0 => 1.0,
        1 => -1.0,
        2 => 1.0 - log_uniform(random, -24, -8),
        3 => log_uniform(random, -23, -8) - 1.0,
        _ => (f64::from(random.unit()) * std::f64::consts::PI).cos() as f32,
    };
    Cone {
        axis: normalized(glam::Vec3::from(axis)),
        cos_theta_o,
    }
}

/// The lights elsewhere, every one of them.
///
/// # Panics
/// If one leaves the domain.
#[must_use]
pub fn moved(lights: &Lights, seed: u32) -> Lights {
    let mut random = Random::new(seed);
    let triangles = lights.all().iter().map(|t| {
        let by = [0; 3].map(|_| random.between(1.0, 5.0));
        let fade = exact::pow2(random.below(4) as i32);
        EmissiveTriangle {
            p: t.p.map(|v| [v[0] + by[0], v[1] + by[1], v[2] + by[2]]),
            radiance: t.radiance.map(|x| x * fade),
            ..*t
        }
    });
    Lights::new(triangles.collect()).expect("the same mesh lights")
}
