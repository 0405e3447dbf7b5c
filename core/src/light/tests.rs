//! Every kind of light against integrals in `f64`: flux, moments, the points that are sampled, what they send, and where instances put
//! them.

extern crate std;

use std::format;
use std::string::String;
use std::vec::Vec;

use glam::Vec3;

use super::*;
use crate::kit::{Random, Wide, cross, dot, minus, narrow, normalize, times, wide};
use crate::point::ShadingPoint;
use crate::transform::Transform;
use crate::vector::length_squared;

const PI: f64 = core::f64::consts::PI;
const SHINE: [f32; 3] = [2.0, 3.0, 5.0];

fn luminance() -> f64 {
    0.2126 * 2.0 + 0.7152 * 3.0 + 0.0722 * 5.0
}

fn spot(cos_inner: f32, cos_outer: f32) -> SpotLight {
    SpotLight {
        p: [1.0, 2.0, -1.0],
        intensity: SHINE,
        range: 0.0,
        axis: [0.36, -0.8, 0.48],
        cos_inner,
        cos_outer,
        mesh: 0,
    }
}

fn sphere() -> SphereLight {
    SphereLight {
        p: [1.0, 2.0, -1.0],
        radius: 0.75,
        radiance: SHINE,
        mesh: 0,
    }
}

fn rectangle(flags: u32) -> RectangleLight {
    RectangleLight {
        p: [1.0, 2.0, -1.0],
        half: [[1.5, 0.0, 0.5], [0.1, 0.25, -0.3]],
        radiance: SHINE,
        mesh: 0,
        flags,
    }
}

fn disc(flags: u32) -> DiscLight {
    DiscLight {
        p: [1.0, 2.0, -1.0],
        half: [[0.6, 0.0, 0.8], [0.0, 1.0, 0.0]],
        radiance: SHINE,
        mesh: 0,
        flags,
    }
}

fn glow() -> BoxLight {
    BoxLight {
        p: [1.0, 2.0, -1.0],
        half: [[0.5, 0.1, 0.0], [0.0, 0.75, 0.0], [0.2, 0.0, 0.25]],
        radiance: SHINE,
        mesh: 0,
    }
}

fn close(what: &str, found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance * expected.abs().max(1e-9),
        "{what}: {found:e}, expected {expected:e}"
    );
}

/// Means over the middles of a grid of numbers.
fn over_grid<const K: usize>(n: usize, mut of: impl FnMut([f32; 2]) -> [f64; K]) -> [f64; K] {
    let mut sum = [0.0; K];
    for i in 0..n * n {
        let value = of([i % n, i / n].map(|k| (k as f32 + 0.5) / n as f32));
        for k in 0..K {
            sum[k] += value[k] / (n * n) as f64;
        }
    }
    sum
}

/// The mean of the irradiance estimated at a receiver, weighted as luminance.
fn estimated<L: Light>(light: &L, receiver: &ShadingPoint) -> f64 {
    let [mean] = over_grid(512, |uv| {
        let [r, g, b] = light
            .point_for(receiver.position(), uv)
            .irradiance(receiver)
            .map(f64::from);
        [0.2126 * r + 0.7152 * g + 0.0722 * b]
    });
    mean
}

fn receivers() -> Vec<ShadingPoint> {
    let mut random = Random(7);
    let mut out = Vec::new();
    for k in 0..12 {
        let reach = [2.5, 4.0, 30.0][k % 3];
        let unit = |v: Vec3| narrow(normalize(wide(v)));
        let p = unit(random.vector()) * reach + Vec3::new(1.0, 2.0, -1.0);
        let n = if k % 4 == 3 {
            Vec3::ZERO
        } else {
            // Mostly towards the light.
            unit(random.vector() * 0.5 + (Vec3::new(1.0, 2.0, -1.0) - p) / reach)
        };
        out.push(ShadingPoint {
            p: p.to_array(),
            n: n.to_array(),
        });
    }
    out
}

/// What places with normals on the light send, by sums over small pieces: place, normal (zero in a volume), size.
fn integrated(pieces: &[(Wide, Wide, f64)], is_two_sided: bool, receiver: &ShadingPoint) -> f64 {
    let (p, n) = (receiver.p.map(f64::from), receiver.n.map(f64::from));
    let in_volume = dot(n, n) == 0.0;
    let of = |(at, normal, size): &(Wide, Wide, f64)| {
        let d = minus(*at, p);
        let squared = dot(d, d);
        let w = times(d, 1.0 / squared.sqrt());
        let incident = if in_volume { 1.0 } else { dot(n, w).max(0.0) };
        let emitted = match -dot(*normal, w) {
            _ if dot(*normal, *normal) == 0.0 => 1.0,
            cosine if is_two_sided => cosine.abs(),
            cosine => cosine.max(0.0),
        };
        incident * emitted / squared * size
    };
    luminance() * pieces.iter().map(of).sum::<f64>()
}

/// Pieces of a parallelogram or an ellipse with these half axes.
fn flat_pieces(p: [f32; 3], half: [[f32; 3]; 2], is_round: bool) -> Vec<(Wide, Wide, f64)> {
    let (p, [a, b]) = (p.map(f64::from), half.map(|h| h.map(f64::from)));
    let across = cross(a, b);
    let area = 4.0 * dot(across, across).sqrt();
    let normal = normalize(across);
    let n = 400;
    let mut out = Vec::new();
    for i in 0..n * n {
        let [x, y] = [i % n, i / n].map(|k| 2.0 * (f64::from(k) + 0.5) / f64::from(n) - 1.0);
        if is_round && x * x + y * y > 1.0 {
            continue;
        }
        let at = [0, 1, 2].map(|k| p[k] + a[k] * x + b[k] * y);
        out.push((at, normal, area / f64::from(n * n)));
    }
    out
}

fn sphere_pieces(light: &SphereLight) -> Vec<(Wide, Wide, f64)> {
    let (p, r) = (light.p.map(f64::from), f64::from(light.radius));
    let n = 800;
    let mut out = Vec::new();
    for i in 0..n * n {
        let z = 2.0 * (f64::from(i % n) + 0.5) / f64::from(n) - 1.0;
        let angle = 2.0 * PI * (f64::from(i / n) + 0.5) / f64::from(n);
        let ring = (1.0 - z * z).sqrt();
        let normal = [ring * angle.cos(), ring * angle.sin(), z];
        let at = [0, 1, 2].map(|k| p[k] + r * normal[k]);
        out.push((at, normal, 4.0 * PI * r * r / f64::from(n * n)));
    }
    out
}

fn box_pieces(light: &BoxLight) -> Vec<(Wide, Wide, f64)> {
    let (p, [a, b, c]) = (light.p.map(f64::from), light.half.map(|h| h.map(f64::from)));
    let volume = 8.0 * dot(cross(a, b), c).abs();
    let n = 48;
    let mut out = Vec::new();
    for i in 0..n * n * n {
        let [x, y, z] =
            [i % n, i / n % n, i / n / n].map(|k| 2.0 * (f64::from(k) + 0.5) / f64::from(n) - 1.0);
        let at = [0, 1, 2].map(|k| p[k] + a[k] * x + b[k] * y + c[k] * z);
        out.push((at, [0.0; 3], volume / f64::from(n * n * n)));
    }
    out
}

fn check_irradiance<L: Light>(name: &str, light: &L, pieces: &[(Wide, Wide, f64)], is_two_sided: bool) {
    let mut lit = 0;
    for receiver in receivers() {
        let expected = integrated(pieces, is_two_sided, &receiver);
        let found = estimated(light, &receiver);
        let least = luminance() * 1e-6;
        assert!(
            (found - expected).abs() <= 0.01 * expected + least,
            "{name} at {receiver:?}: {found:e}, expected {expected:e}"
        );
        lit += u32::from(expected > least);
    }
    assert!(lit >= 4, "{name}: {lit} receivers are lit");
}

#[test]
fn flat_lights_send_what_integrals_over_them_give() {
    for flags in [0, TWO_SIDED] {
        let (own, round) = (rectangle(flags), disc(flags));
        let both = flags == TWO_SIDED;
        check_irradiance("rectangle", &own, &flat_pieces(own.p, own.half, false), both);
        check_irradiance("disc", &round, &flat_pieces(round.p, round.half, true), both);
    }
}

#[test]
fn spheres_send_what_integrals_over_them_give() {
    check_irradiance("sphere", &sphere(), &sphere_pieces(&sphere()), false);
    // From within none is seen.
    let inside = ShadingPoint {
        p: [1.0, 2.25, -1.0],
        n: [0.0; 3],
    };
    assert_eq!(estimated(&sphere(), &inside), 0.0);
}

#[test]
fn boxes_send_what_integrals_over_them_give() {
    check_irradiance("box", &glow(), &box_pieces(&glow()), false);
}

/// Each point of the cap sees the receiver, however near.
#[test]
fn points_of_spheres_are_seen() {
    for away in [0.750_001, 0.76, 1.0, 100.0] {
        let from = Vec3::new(1.0, 2.0 + away, -1.0);
        let [seen, all] = over_grid(64, |uv| {
            let at = sphere().point_for(from, uv);
            let d = minus(wide(from), at.p.map(f64::from));
            let n = at.normal.map(f64::from);
            assert!((dot(n, n) - 1.0).abs() < 1e-5, "{at:?}");
            let cosine = dot(d, n) / dot(d, d).sqrt();
            [f64::from(u8::from(cosine > -1e-3)), 1.0]
        });
        assert_eq!(seen, all, "{away} m");
    }
}

/// The cap that is seen from distance d has the area 2 π R² (1 - R / d), all of which is as likely.
#[test]
fn points_of_spheres_have_the_density_of_their_cap() {
    let radius = f64::from(sphere().radius);
    for away in [0.8, 1.0, 3.0, 100.0, 1e6] {
        let from = Vec3::new(1.0, 2.0 + away, -1.0);
        // As far as it is in the sphere's own numbers.
        let distance = f64::from(from.y) - 2.0;
        let expected = 1.0 / (core::f64::consts::TAU * radius * radius * (1.0 - radius / distance));
        for uv in [[0.0, 0.0], [0.5, 0.3], [0.99, 0.9]] {
            let found = f64::from(sphere().point_for(from, uv).density);
            assert!(
                (found / expected - 1.0).abs() < 2e-6,
                "{away}: {found}, expected {expected}"
            );
        }
    }
}

#[test]
fn points_and_spots_send_their_intensity() {
    let point = PointLight {
        p: [1.0, 2.0, -1.0],
        intensity: SHINE,
        range: 0.0,
        mesh: 0,
    };
    for receiver in receivers() {
        let d = minus([1.0, 2.0, -1.0], receiver.p.map(f64::from));
        let (squared, n) = (dot(d, d), receiver.n.map(f64::from));
        let w = times(d, 1.0 / squared.sqrt());
        let incident = if dot(n, n) == 0.0 { 1.0 } else { dot(n, w).max(0.0) };
        let plain = luminance() * incident / squared;
        close("point", estimated(&point, &receiver), plain, 1e-4);
        for [inner, outer] in [[0.9, 0.5], [1.0, -0.5], [0.2, 0.2], [-0.9, -1.0]] {
            let own = spot(inner, outer);
            let cosine = -dot(w, own.axis.map(f64::from));
            let fall = f64::from(inner - outer).max(2.0_f64.powi(-20));
            let falloff = ((cosine - f64::from(outer)) / fall).clamp(0.0, 1.0).powi(2);
            let found = estimated(&own, &receiver);
            assert!(
                (found - plain * falloff).abs() <= 1e-3 * plain,
                "spot {inner} {outer}: {found:e}, expected {:e}",
                plain * falloff
            );
        }
    }
}

/// The narrowest cones have their intensity on the axis and the falloff of their own cosines about it, placed or not.
#[test]
fn narrow_spots_send_what_their_cone_says() {
    let mut random = 1_u32;
    let mut draw = || {
        random = exact::hash(random);
        f64::from(exact::unit_f32(random)) * 2.0 - 1.0
    };
    for degrees in [0.1_f64, 0.2, 0.5, 1.0, 5.0] {
        for sharp in [0.0, 0.8, 1.0] {
            let (outer, inner) = (degrees.to_radians(), (degrees * sharp).to_radians());
            for _ in 0..200 {
                let axis = [draw(), draw(), draw()];
                let length = dot(axis, axis).sqrt();
                let axis = times(axis, 1.0 / length);
                let own = SpotLight {
                    p: [0.0; 3],
                    intensity: [1.0; 3],
                    range: 0.0,
                    axis: axis.map(|x| x as f32),
                    cos_inner: inner.cos() as f32,
                    cos_outer: exact::min(outer.cos() as f32, 1.0 - exact::pow2(-20)),
                    mesh: 0,
                };
                let own = own.checked().expect("a sound spot");
                for light in [own, crate::Transform::IDENTITY.place(&own, 0)] {
                    let (a, b) = (f64::from(light.cos_inner), f64::from(light.cos_outer));
                    let fall = (a - b).max(2.0_f64.powi(-20));
                    for off in [0.0, 0.3, 0.7, 0.95, 1.3] {
                        // A direction so far off the axis, in units of the cone.
                        let across = [axis[1] - axis[2], axis[2] - axis[0], axis[0] - axis[1]];
                        let across = times(across, outer * off / dot(across, across).sqrt());
                        let to = [0, 1, 2].map(|k| ((axis[k] + across[k]) * 3.0) as f32);
                        let w = to.map(f64::from);
                        let w = times(w, 1.0 / dot(w, w).sqrt());
                        let u = light.axis.map(f64::from);
                        let apart = minus(times(u, 1.0 / dot(u, u).sqrt()), w);
                        let expected = (((1.0 - b) - 0.5 * dot(apart, apart)) / fall)
                            .clamp(0.0, 1.0)
                            .powi(2);
                        let found = f64::from(light.point_for(Vec3::from(to), [0.5; 2]).radiance[0]);
                        assert!(
                            (found - expected).abs() < 2e-3,
                            "{degrees} degrees, {sharp}, at {off}: {found}, expected {expected}"
                        );
                    }
                }
            }
        }
    }
}

/// An axis that is not quite of length 1 becomes so.
#[test]
fn axes_are_brought_to_length_one() {
    for length in [0.9963_f32, 1.0037] {
        let own = SpotLight {
            axis: [0.0, length, 0.0],
            ..spot(0.9999, 0.9998)
        };
        let own = own.checked().expect("within the tolerance");
        assert_eq!(own.axis, [0.0, 1.0, 0.0]);
        assert_eq!(own.checked().expect("sound"), own);
    }
}

/// A sphere's size does not ask how bright its instance is.
#[test]
fn a_dark_instance_has_spheres_as_large() {
    let transform = crate::Transform {
        columns: [[3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 3.0]],
        translation: [1.0, 2.0, 3.0],
    };
    let expected = transform.place(&sphere(), 4).radius;
    close(
        "radius",
        f64::from(expected),
        3.0 * f64::from(sphere().radius),
        1e-6,
    );
    for radiance in [0.0, 1e-20, 0.3, 1e20] {
        assert_eq!(
            sphere().in_world(&transform.instance(radiance), 4).radius,
            expected,
            "{radiance}"
        );
    }
    let uneven = crate::Transform {
        columns: [[1.0, 0.0, 0.0], [0.0, 10.0, 0.0], [0.0, 0.0, 10.0]],
        translation: [0.0; 3],
    };
    // The root mean square of areas 100, 10 and 10.
    let mean = ((100.0_f64.powi(2) + 2.0 * 10.0_f64.powi(2)) / 3.0).sqrt().sqrt();
    close(
        "uneven",
        f64::from(uneven.place(&sphere(), 0).radius),
        mean * f64::from(sphere().radius),
        1e-6,
    );
}

/// Points of a box are spread along each axis by themselves.
#[test]
fn points_of_a_box_fill_it() {
    let own = BoxLight {
        half: [[0.5, 0.0, 0.0], [0.0, 0.0, 0.75], [0.0, 0.25, 0.0]],
        ..glow()
    };
    let mut products = [0.0_f64; 3];
    let n = 128;
    for i in 0..n * n {
        let uv = [(i % n) as f32 + 0.37, (i / n) as f32 + 0.61].map(|x| x / n as f32);
        let at = own.point_for(Vec3::ZERO, uv).p;
        let d = minus(at.map(f64::from), own.p.map(f64::from));
        let along = |k: usize| {
            let half = own.half[k].map(f64::from);
            dot(d, half) / dot(half, half)
        };
        for (k, product) in products.iter_mut().enumerate() {
            *product += along(k) * along((k + 1) % 3) / f64::from((n * n) as u32);
        }
    }
    // Of independent even numbers within 1, products have mean 0 and deviation 1/3.
    for product in products {
        assert!(product.abs() < 5.0 / 3.0 / f64::from(n as u32), "{products:?}");
    }
}

/// Flux and mean direction of spots over the sphere.
#[test]
fn spots_have_the_flux_and_the_mean_direction_of_their_falloff() {
    for [inner, outer] in [
        [0.9, 0.5],
        [1.0, -0.5],
        [0.2, 0.2],
        [-0.9, -1.0],
        [1.0, 0.999],
        [0.999_99, 0.999_98],
        [1.0, -1.0],
    ] {
        let own = spot(inner, outer);
        let (a, b) = (f64::from(inner), f64::from(outer));
        let (mut whole, mut first) = (0.0, 0.0);
        // From the outer cosine on, in even steps of it.
        let n = 200_000;
        for k in 0..n {
            let c = b + (1.0 - b) * (f64::from(k) + 0.5) / f64::from(n);
            let falloff = ((c - b) / (a - b).max(2.0_f64.powi(-20))).clamp(0.0, 1.0).powi(2);
            whole += falloff * (1.0 - b) / f64::from(n);
            first += falloff * c * (1.0 - b) / f64::from(n);
        }
        let found = own.moments();
        let what = format!("spot {inner} {outer}");
        // Narrow ones count as their root mean square.
        let flux = 2.0 * PI * whole;
        close(
            &what,
            f64::from(found.phi),
            luminance() * flux.max((flux * PI).sqrt()),
            1e-3,
        );
        assert_eq!(found.phi, own.bounds().phi);
        let length = f64::from(length_squared(found.m)).sqrt();
        close(&what, length, (1.5 * first / whole).clamp(0.0, 1.0), 1e-3);
    }
}

/// A table of one half up to 60°: axis and across as words say, flux and mean direction as of a spot with a sharp edge there.
fn profile() -> ProfileLight {
    ProfileLight {
        p: [1.0, 2.0, -1.0],
        intensity: SHINE,
        axis: [0.0, -1.0, 0.0],
        across: [0.6, 0.0, 0.8],
        cos_outer: 0.5,
        whole: 0.25,
        mean_cosine: 0.75,
        mesh: 0,
        flags: 0,
    }
}

#[test]
fn profiles_have_the_flux_of_their_table_and_are_read_by_direction() {
    let own = profile();
    assert_eq!(own.checked(), Ok(own));
    let flux = 2.0 * PI * 0.25;
    let found = own.moments();
    close(
        "profile",
        f64::from(found.phi),
        luminance() * (flux * PI).sqrt(),
        1e-3,
    );
    close("profile", f64::from(length_squared(found.m)).sqrt(), 1.0, 1e-3);
    assert_eq!(found.phi, own.bounds().phi);
    // Along the axis the middle of the picture; a quarter turn from across towards across × axis at the horizon.
    let p = Vec3::new(1.0, 2.0, -1.0);
    let near = |found: [f32; 2], expected: [f32; 2]| {
        let off = [0, 1].map(|k| exact::abs(found[k] - expected[k]));
        assert!(off[0] < 1e-5 && off[1] < 1e-5, "{found:?}, expected {expected:?}");
    };
    near(own.coordinates(p + Vec3::new(0.0, -3.0, 0.0)), [0.5, 0.5]);
    near(own.coordinates(p + Vec3::new(1.2, 0.0, 1.6)), [1.0, 0.5]);
    let third = crate::vector::cross(Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, -1.0, 0.0));
    near(own.coordinates(p + third * 2.0), [0.5, 1.0]);
    near(own.coordinates(p), [0.5, 0.5]);
    // A map that mirrors mirrors the table: where a point goes it sends what it sent there.
    let mirror = Transform {
        columns: [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        translation: [3.0, 0.0, 0.0],
    };
    for map in [
        mirror,
        Transform {
            columns: [[0.0, 2.0, 0.0], [-2.0, 0.0, 0.0], [0.0, 0.0, 2.0]],
            translation: [5.0, -3.0, 1.0],
        },
    ] {
        let instance = map.instance(1.0);
        let there = own.in_world(&instance, 4);
        let mut random = Random(8);
        for _ in 0..50 {
            let from = p + Vec3::from_array([0; 3].map(|_| 4.0 * random.signed()));
            let seen = Vec3::from_array(instance.vertex(from.to_array()));
            near(there.coordinates(seen), own.coordinates(from));
            assert_eq!(
                there.point_for(seen, [0.5; 2]).radiance,
                own.point_for(from, [0.5; 2]).radiance
            );
        }
    }
    let inside = own.point_for(p + Vec3::new(0.0, -2.0, 1.0), [0.5; 2]);
    assert_eq!((inside.radiance, inside.density), (SHINE, 1.0));
    let outside = own.point_for(p + Vec3::new(0.0, -1.0, 2.0), [0.5; 2]);
    assert_eq!(outside.radiance, [0.0; 3]);
    // What is wrong, by name.
    for (wrong, part) in [
        (ProfileLight { whole: 2.5, ..own }, "integral 2.5"),
        (
            ProfileLight {
                whole: f32::NAN,
                ..own
            },
            "a profile of integral",
        ),
        (
            ProfileLight {
                mean_cosine: 0.4,
                ..own
            },
            "mean cosine 0.4",
        ),
        (
            ProfileLight {
                cos_outer: 1.0,
                ..own
            },
            "cone from cosine 1",
        ),
        (
            ProfileLight {
                across: [0.0, -0.6, 0.8],
                ..own
            },
            "at right angles",
        ),
        (
            ProfileLight {
                axis: [0.0; 3],
                ..own
            },
            "expected length 1",
        ),
        (ProfileLight { flags: 1, ..own }, "flags are 0x1"),
        (
            ProfileLight {
                p: [f32::NAN, 0.0, 0.0],
                ..own
            },
            "light with a profile",
        ),
        (
            ProfileLight {
                intensity: [-1.0; 3],
                ..own
            },
            "intensity of a light with a profile",
        ),
    ] {
        let found = format!("{}", wrong.checked().expect_err("it is wrong"));
        assert!(found.contains(part), "{found}");
    }
    assert!(!ProfileLight { whole: 0.0, ..own }.has_flux());
}

/// Mean and variance of even points, from all sides; all of them in the box.
fn check_moments<L: Light>(name: &str, light: &L, pieces: &[(Wide, Wide, f64)], flux: f64) {
    let found = light.moments();
    close(name, f64::from(found.phi), flux, 1e-5);
    assert_eq!(found.phi, light.bounds().phi, "{name}");
    let size: f64 = pieces.iter().map(|piece| piece.2).sum();
    let mean = |k: usize| pieces.iter().map(|(at, _, own)| at[k] * own).sum::<f64>() / size;
    let center = [0, 1, 2].map(mean);
    let off = minus(center, wide(found.c));
    assert!(dot(off, off).sqrt() < 1e-4, "{name}: {center:?}, {found:?}");
    let variance: f64 = pieces
        .iter()
        .map(|(at, _, own)| {
            let d = minus(*at, center);
            dot(d, d) * own
        })
        .sum::<f64>()
        / size;
    // Flat lights of two sides have no direction along which they have none: all three axes count alike, as of triangles.
    let across = f64::from(found.across);
    let axes = if pieces[0].1 == pieces[1].1 && dot(pieces[0].1, pieces[0].1) > 0.0 {
        2.0
    } else {
        3.0
    };
    close(name, axes * across * across, variance, 4e-3);
    let is_directed = length_squared(found.m) > 0.0;
    assert_eq!(
        found.along,
        if is_directed { 0.0 } else { found.across },
        "{name}"
    );
    let mut most = [0.0_f64; 3];
    for (at, ..) in pieces {
        for k in 0..3 {
            most[k] = most[k].max((at[k] - center[k]).abs());
        }
    }
    for k in 0..3 {
        let h = f64::from([found.h.x, found.h.y, found.h.z][k]);
        assert!(
            h >= most[k] * (1.0 - 1e-6) && h <= most[k] * 1.06 + 1e-6,
            "{name}: {h}, {}",
            most[k]
        );
    }
    let bounds = light.bounds();
    for (at, ..) in pieces {
        for k in 0..3 {
            let [lo, hi] = [bounds.min, bounds.max].map(|v| f64::from([v.x, v.y, v.z][k]));
            assert!(lo - 1e-6 <= at[k] && at[k] <= hi + 1e-6, "{name}");
        }
    }
}

fn area(pieces: &[(Wide, Wide, f64)]) -> f64 {
    pieces.iter().map(|piece| piece.2).sum()
}

#[test]
fn moments_are_those_of_even_points() {
    for flags in [0, TWO_SIDED] {
        let sides = if flags == 0 { 1.0 } else { 2.0 };
        let own = rectangle(flags);
        let pieces = flat_pieces(own.p, own.half, false);
        check_moments(
            "rectangle",
            &own,
            &pieces,
            sides * PI * luminance() * area(&pieces),
        );
        let own = disc(flags);
        let pieces = flat_pieces(own.p, own.half, true);
        let expected = sides * PI * luminance() * PI;
        check_moments("disc", &own, &pieces, expected);
    }
    let own = sphere();
    let pieces = sphere_pieces(&own);
    check_moments("sphere", &own, &pieces, PI * luminance() * area(&pieces));
    let own = glow();
    let pieces = box_pieces(&own);
    check_moments("box", &own, &pieces, 4.0 * PI * luminance() * area(&pieces));
}

/// The normal is the direction of the half axes' product, and the light shines there.
#[test]
fn the_front_of_flat_lights_is_where_their_axes_turn_left() {
    let own = rectangle(0);
    let [a, b] = own.half.map(|h| h.map(f64::from));
    let n = normalize(cross(a, b));
    let m = wide(own.moments().m);
    assert!(dot(m, n) > 1.0 - 1e-4, "{m:?}");
    assert!(own.bounds().cos_theta_o > 0.99);
    let at = own.point_for(Vec3::ZERO, [0.5, 0.5]);
    assert!(dot(at.normal.map(f64::from), n) > 1.0 - 1e-6);
    assert_eq!(length_squared(rectangle(TWO_SIDED).moments().m), 0.0);
}

/// An instance keeps area lights where an affine map puts each of their points; a mirrored one keeps its front.
#[test]
fn instances_put_lights_where_the_map_puts_their_points() {
    let turned = Transform {
        columns: [[0.0, 2.0, 0.0], [-2.0, 0.0, 0.0], [0.0, 0.0, 2.0]],
        translation: [5.0, -3.0, 1.0],
    };
    let skewed = Transform {
        columns: [[1.0, 0.5, 0.0], [0.0, 2.0, 0.25], [0.5, 0.0, 1.5]],
        translation: [1.0, 1.0, 0.0],
    };
    let mirrored = Transform {
        columns: [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        translation: [0.0; 3],
    };
    let near = |a: [f32; 3], b: [f32; 3]| {
        a.into_iter()
            .zip(b)
            .all(|(a, b)| exact::abs(a - b) < 2e-6 * (1.0 + exact::abs(a)))
    };
    for (name, map) in [("turned", turned), ("skewed", skewed), ("mirrored", mirrored)] {
        let instance = map.instance(0.5);
        let place = |p: [f32; 3]| instance.vertex(p);
        let (flat, boxed) = (rectangle(0), glow());
        let world = flat.in_world(&instance, 9);
        assert_eq!((world.mesh, world.radiance), (9, [1.0, 1.5, 2.5]), "{name}");
        let corner = |l: &RectangleLight, k: usize, s: f32| [0, 1, 2].map(|i| l.p[i] + s * l.half[k][i]);
        let swapped = usize::from(name == "mirrored");
        for k in 0..2 {
            let (own, there) = (place(corner(&flat, k, 1.0)), corner(&world, k ^ swapped, 1.0));
            assert!(near(own, there), "{name}: {own:?} {there:?}");
        }
        let there = boxed.in_world(&instance, 9);
        for k in 0..3 {
            let own = place([0, 1, 2].map(|i| boxed.p[i] + boxed.half[k][i]));
            let edge = [0, 1, 2].map(|i| there.p[i] + there.half[k][i]);
            assert!(near(own, edge), "{name}: {own:?} {edge:?}");
        }
    }
    // Lengths twice as great: the sphere has four times the area, a spot turns, a point has its intensity as before.
    let instance = turned.instance(0.5);
    let ball = sphere().in_world(&instance, 9);
    assert!(
        exact::abs(ball.radius - 1.5) < 1e-6 && near(ball.p, instance.vertex(sphere().p)),
        "{ball:?}"
    );
    let lamp = spot(0.9, 0.5).in_world(&instance, 9);
    assert!(near(lamp.axis, [0.8, 0.36, 0.48]), "{lamp:?}");
    assert_eq!(
        (lamp.intensity, lamp.cos_inner, lamp.cos_outer),
        ([1.0, 1.5, 2.5], 0.9, 0.5)
    );
}

/// What is out of the domain, and what each message names.
#[test]
fn wrong_lights_are_refused_by_name() {
    let text = |error: Result<(), LightError>| -> String { format!("{}", error.expect_err("it is wrong")) };
    let refused = |light: SpotLight, part: &str| {
        let found = text(light.checked().map(|_| ()));
        assert!(found.contains(part), "{found}");
    };
    let good = spot(0.9, 0.5);
    assert_eq!(good.checked(), Ok(good));
    refused(
        SpotLight {
            cos_inner: 0.4,
            ..good
        },
        "inner cosine of 0.4 to an outer one of 0.5",
    );
    refused(
        SpotLight {
            cos_outer: 1.0,
            cos_inner: 1.0,
            ..good
        },
        "outer < 1",
    );
    refused(
        SpotLight {
            cos_inner: f32::NAN,
            ..good
        },
        "inner cosine of NaN",
    );
    refused(
        SpotLight {
            cos_outer: -1.5,
            ..good
        },
        "-1.5",
    );
    refused(
        SpotLight {
            axis: [0.0; 3],
            ..good
        },
        "is (0, 0, 0), expected length 1",
    );
    refused(
        SpotLight {
            axis: [f32::NAN; 3],
            ..good
        },
        "is (NaN",
    );
    refused(
        SpotLight {
            intensity: [0.0, -1.0, 0.0],
            ..good
        },
        "green of the intensity of a spot is -1",
    );
    refused(
        SpotLight {
            p: [0.0, 0.0, f32::INFINITY],
            ..good
        },
        "coordinate z of the spot is inf",
    );
    for radius in [0.0, -1.0, f32::NAN, f32::INFINITY, exact::pow2(-61)] {
        let found = text(SphereLight { radius, ..sphere() }.checked().map(|_| ()));
        assert!(found.contains("the radius of a sphere is"), "{found}");
    }
    let flags = RectangleLight {
        flags: 2,
        ..rectangle(0)
    };
    assert_eq!(flags.checked(), Err(LightError::Flags { flags: 2 }));
    let edge = DiscLight {
        half: [[0.0, f32::NAN, 0.0], [1.0, 0.0, 0.0]],
        ..disc(0)
    };
    let found = text(edge.checked().map(|_| ()));
    assert!(
        found.contains("coordinate y of the half axis of a disc is NaN"),
        "{found}"
    );
    let found = text(
        BoxLight {
            radiance: [1e31, 0.0, 0.0],
            ..glow()
        }
        .checked()
        .map(|_| ()),
    );
    assert!(found.contains("red of the radiance of a box"), "{found}");
}

/// Over the whole range of lengths and radiances, numbers stay in theirs.
#[test]
fn extremes_stay_finite() {
    fn check<L: Light>(light: L) {
        let light = light.checked().expect("in the domain");
        let moments = light.moments();
        let phi = moments.phi;
        assert!(
            phi == 0.0 || (crate::bounds::MIN_PHI..=crate::bounds::MAX_PHI).contains(&phi),
            "{light:?}"
        );
        assert_eq!(phi > 0.0, light.has_flux(), "{light:?}");
        for word in crate::summary::Summary::to_words(&moments) {
            assert!(word.is_finite(), "{light:?}: {moments:?}");
        }
        for from in [Vec3::ZERO, Vec3::splat(exact::pow2(40)), Vec3::new(1.0, 2.0, 3.0)] {
            for uv in [[0.0, 0.0], [0.5, 0.5], [0.999_999_94, 0.999_999_94], [0.0, 0.75]] {
                let at = light.point_for(from, uv);
                assert!(
                    at.p.iter().chain(&at.normal).all(|x| x.is_finite()),
                    "{light:?}: {at:?}"
                );
                assert!(at.density.is_finite() && at.density >= 0.0, "{light:?}: {at:?}");
                let receiver = ShadingPoint {
                    p: from.to_array(),
                    n: [0.0; 3],
                };
                let sent = at.irradiance(&receiver);
                assert!(
                    sent.iter().all(|x| !x.is_nan() && *x >= 0.0),
                    "{light:?}: {sent:?}"
                );
            }
        }
    }
    for e in [-60, -50, -30, -10, 0, 10, 30, 39] {
        let s = exact::pow2(e);
        for shine in [0.0, MIN_RADIANCE, 1.0, MAX_RADIANCE] {
            for place in [0.0, s, exact::pow2(39)] {
                let radiance = [shine; 3];
                let p = [place, -place, 0.0];
                check(PointLight {
                    p,
                    intensity: radiance,
                    range: 0.0,
                    mesh: 0,
                });
                check(SpotLight {
                    p,
                    intensity: radiance,
                    ..spot(0.9, 0.5)
                });
                check(ProfileLight {
                    p,
                    intensity: radiance,
                    ..profile()
                });
                check(ProfileLight {
                    whole: 0.0,
                    ..profile()
                });
                check(SphereLight {
                    p,
                    radius: s,
                    radiance,
                    mesh: 0,
                });
                let half = [[s, 0.0, 0.0], [0.0, s * exact::pow2(-20), s]];
                check(RectangleLight {
                    p,
                    half,
                    radiance,
                    mesh: 0,
                    flags: 0,
                });
                check(DiscLight {
                    p,
                    half,
                    radiance,
                    mesh: 0,
                    flags: TWO_SIDED,
                });
                check(RectangleLight {
                    half: [[s, 0.0, 0.0]; 2],
                    ..rectangle(0)
                });
                let half = [[s, 0.0, 0.0], [0.0, s, 0.0], [0.0, s, s * exact::pow2(-20)]];
                check(BoxLight {
                    p,
                    half,
                    radiance,
                    mesh: 0,
                });
                check(BoxLight {
                    half: [[s, 0.0, 0.0]; 3],
                    ..glow()
                });
            }
        }
    }
}

mod punctual;
mod ranges;
