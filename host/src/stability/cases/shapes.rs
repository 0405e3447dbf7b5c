//! What lights look like: needles, no area, nested boxes, cones of normals, numbers at the ends of f32.

use lightbvh::{EmissiveTriangle, ShadingPoint, exact};

use super::super::case::Case;
use super::super::random::Random;
use super::{facing_x, scattered};

pub(super) fn cases() -> Vec<Case> {
    let mut cases = vec![
        Case::new("needles and triangles without area", needles()),
        Case::new("nested boxes", (0..70).map(nested).collect()),
        subnormal("subnormal coordinates", f32::from_bits(0x0003_0001)),
        subnormal("minus zero", -0.0),
    ];
    let (half, third) = (std::f64::consts::FRAC_PI_2, std::f64::consts::FRAC_PI_3);
    for (name, angle) in [
        ("cone of normals of 0", 0.0),
        ("cone of normals just over 0", 2e-4),
        ("cone of normals of 60 degrees", third),
        ("cone of normals just under pi/2", half - 2e-4),
        ("cone of normals of pi/2", half),
        ("cone of normals just over pi/2", half + 2e-4),
        ("cone of normals just under pi", 2.0 * half - 2e-4),
        ("cone of normals of pi", 2.0 * half),
    ] {
        cases.push(cone(name, angle));
    }
    cases
}

/// Lights that differ in width by 2^30, and some of one edge or of one point.
fn needles() -> Vec<EmissiveTriangle> {
    let random = &mut Random::new(23);
    let mut lights = scattered(240, 23);
    for (i, light) in (0..).zip(&mut lights) {
        let [a, b, c] = light.p;
        let share = exact::pow2(-random_exponent(random));
        match i % 6 {
            0 => light.p[2] = std::array::from_fn(|k| a[k] + (c[k] - a[k]) * share),
            1 => light.p[2] = std::array::from_fn(|k| b[k] + (c[k] - b[k]) * share),
            2 => light.p[2] = std::array::from_fn(|k| 0.5 * (a[k] + b[k])),
            3 => light.p = [a; 3],
            _ => {}
        }
    }
    // About the origin nothing of a width is lost beside a corner's coordinates.
    for (i, light) in (0..).zip(&mut lights).filter(|(i, _)| i % 6 == 4) {
        let width = exact::pow2(-(i % 31));
        light.p = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, width, 0.0]];
    }
    lights
}

fn random_exponent(random: &mut Random) -> i32 {
    random.below(31) as i32
}

/// A triangle about the origin, half as large as the one before.
fn nested(i: u32) -> EmissiveTriangle {
    let s = exact::pow2(38 - i as i32);
    let mut light = facing_x([-s; 3], 3.0 * s, 1.0, i / 4, i & 1);
    light.p[1][0] = s;
    light
}

/// Lights with `tiny` in place of zeros, and points that have it too.
fn subnormal(name: &str, tiny: f32) -> Case {
    let mut lights: Vec<_> = (0..64)
        .map(|i| facing_x([0.0, (i % 8) as f32, (i / 8) as f32], 0.5, 1.0, i / 8, i & 1))
        .collect();
    for x in lights.iter_mut().flat_map(|light| light.p.iter_mut().flatten()) {
        *x = if *x == 0.0 { tiny } else { *x };
    }
    let points = [[tiny; 3], [1.0, tiny, tiny], [-1.0, 2.0, tiny], [tiny, 1.0, 1.0]];
    let normals = [
        [1.0, tiny, tiny],
        [-1.0, tiny, tiny],
        [tiny, 1.0, tiny],
        [0.0; 3],
        [-0.0; 3],
    ];
    let points = points
        .iter()
        .flat_map(|&p| normals.iter().map(move |&n| ShadingPoint { p, n }));
    Case::new(name, lights).with_points(points)
}

/// Lights whose normals fill the cone of half-angle `angle` about x; points near the directions where the cone's light ends.
fn cone(name: &str, angle: f64) -> Case {
    let random = &mut Random::new(31);
    let direction = |theta: f64, phi: f64| [theta.cos(), theta.sin() * phi.cos(), theta.sin() * phi.sin()];
    let light = |i: u32| {
        let phi = f64::from(i) * 2.4;
        let theta = if i.is_multiple_of(2) {
            angle
        } else {
            angle * f64::from(random.unit())
        };
        let n = glam::DVec3::from(direction(theta, phi));
        let across = n.any_orthonormal_vector() * 0.1;
        let corner = glam::DVec3::new(0.0, f64::from(random.unit()), f64::from(random.unit()));
        let p = [corner, corner + across, corner + n.cross(across)];
        EmissiveTriangle {
            p: p.map(|v| v.to_array().map(|x| x as f32)),
            radiance: [1.0; 3],
            mesh: i / 8,
            flags: 0,
        }
    };
    let lights: Vec<_> = (0..64).map(light).collect();
    let limit = angle + std::f64::consts::FRAC_PI_2;
    let points = (0..24).map(|i| {
        let off = [0.0, 1e-4, -1e-4, 1e-3, -1e-3, 0.02][i % 6];
        let reach = [3.0, 100.0, 1e5, 0.3][i / 6];
        let d = direction(limit + off, i as f64);
        ShadingPoint {
            p: d.map(|x| (x * reach) as f32),
            n: if i.is_multiple_of(2) {
                [0.0; 3]
            } else {
                d.map(|x| -x as f32)
            },
        }
    });
    Case::new(name, lights).with_points(points)
}
