//! Importance: positive wherever there is flux, finite everywhere, the same at every scale. Formulas are in core's own tests.

use glam::Vec3;
use lightbvh::node::kind;
use lightbvh::{
    BuildParams, CompactNode, EmissiveTriangle, ImportanceModel, LightNode, Lights, ShadingPoint, Summary,
    exact,
};
use lightbvh_peers::{Falcor, Pbrt};
use lightbvh_tests::each_layout;
use lightbvh_tests::generate::{self, Random, extreme_triangle, log_uniform};
use lightbvh_tests::oracle::{Triangle, all_pmfs, built};
use rayon::prelude::*;

/// A point where it is hard to say whether `light` arrives: in its plane, just before or behind it, on it, within its
/// box, just above the horizon of a surface, far away.
fn adversarial_point(random: &mut Random, light: &EmissiveTriangle) -> ShadingPoint {
    let [p0, p1, p2] = light.p.map(Vec3::from);
    let size = (p1 - p0).length().max((p2 - p0).length()).max(exact::pow2(-40));
    let normal = Triangle::new(light).normal.normalize_or_zero().as_vec3();
    let (u, v) = (random.between(-2.0, 3.0), random.between(-2.0, 3.0));
    let in_plane = p0 + (p1 - p0) * u + (p2 - p0) * v;
    let inside = p0 + (p1 - p0) * (0.5 * random.unit()) + (p2 - p0) * (0.5 * random.unit());
    let sign = if random.below(2) == 0 { 1.0 } else { -1.0 };
    let away = Vec3::from(random.direction());
    let p = match random.below(9) {
        0 => in_plane,
        1 => in_plane + normal * (sign * size * log_uniform(random, -24, 0)),
        2 => inside,
        3 => inside + normal * (sign * size * log_uniform(random, -24, 0)),
        4 => inside + away * (size * log_uniform(random, -4, 10)),
        5 => away * log_uniform(random, 0, 38),
        6 => Vec3::from(light.p[random.below(3) as usize]),
        // From far off at a grazing angle: no box is large there, so that only the cone counts.
        _ => {
            let distance = size * log_uniform(random, 3, 24);
            let along = normal.cross(away).normalize_or_zero();
            inside + along * distance + normal * (sign * distance * log_uniform(random, -19, -3))
        }
    };
    let p = p.clamp(Vec3::splat(-exact::pow2(40)), Vec3::splat(exact::pow2(40)));
    // A normal by which the nearest vertex is a little above or below the horizon, or any.
    let to = light
        .p
        .map(|v| (Vec3::from(v).as_dvec3() - p.as_dvec3()).normalize_or_zero());
    let n = match random.below(4) {
        0 => Vec3::ZERO,
        1 => Vec3::from(random.direction()),
        _ => {
            let towards = to[random.below(3) as usize];
            let across = towards
                .cross(Vec3::from(random.direction()).as_dvec3())
                .normalize_or_zero();
            let tilt = f64::from(sign * log_uniform(random, -24, -1));
            (across + towards * tilt).normalize_or_zero().as_vec3()
        }
    };
    ShadingPoint {
        p: p.to_array(),
        n: n.to_array(),
    }
}

/// Greatest weight that a node may give.
const MOST: f32 = exact::pow2(120);

/// Weights of a node over `lights` and of one above it: positive just where there is flux, and in the range of what a choice can
/// share out.
fn weights_are_sound<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    lights: &[EmissiveTriangle],
    point: &ShadingPoint,
) {
    let mut children = [N::Summary::EMPTY; W];
    let mut leaf = N::EMPTY;
    for (slot, light) in lights.iter().take(W).enumerate() {
        leaf.set_child(slot, kind::LIGHT, slot as u32);
        children[slot] = N::Summary::of_light(light);
    }
    leaf.set_summaries(&children);
    let mut inner = N::EMPTY;
    inner.set_child(W - 1, kind::INNER, 1);
    let mut above = [N::Summary::EMPTY; W];
    above[W - 1] = leaf.merged();
    inner.set_summaries(&above);
    for (node, summaries) in [(leaf, children), (inner, above)] {
        let weights = I::weights(&node, point);
        for (weight, summary) in weights.iter().zip(&summaries) {
            let sound = (0.0..=MOST).contains(weight) && (*weight > 0.0) == (summary.phi() > 0.0);
            assert!(sound, "{} {W}: {weights:?} of {lights:?} at {point:?}", N::NAME);
        }
    }
}

/// Lights of any kind, at the ends of the domain, and of one size beside each other, so that boxes and cones are not degenerate.
#[test]
fn positive_wherever_there_is_flux() {
    (0..128).into_par_iter().for_each(|seed| {
        let random = &mut Random::new(seed);
        let scale = exact::pow2(random.below(60) as i32 - 30);
        for round in 0..128 {
            let mut lights: Vec<_> = (0..1 + random.below(4))
                .map(|_| extreme_triangle(random))
                .collect();
            if round % 4 == 0 {
                lights[0].radiance = [exact::pow2(100 - 200 * random.below(2) as i32); 3];
            }
            let mut point = adversarial_point(random, &lights[0]);
            if round % 4 == 1 {
                let far = exact::pow2(40);
                point.p = [0; 3].map(|_| [0.0, far, -far, exact::pow2(-100)][random.below(4) as usize]);
            }
            each_layout!(weights_are_sound(&lights, &point));
            weights_are_sound::<CompactNode<4>, Falcor, 4>(&lights, &point);
            weights_are_sound::<CompactNode<4>, Pbrt, 4>(&lights, &point);
            let lights: Vec<_> =
                generate::small_triangles(4, 4, 4.0, 1.0, random.below(2) == 0, random.bits())
                    .into_iter()
                    .map(|t| EmissiveTriangle {
                        p: t.p.map(|v| v.map(|x| x * scale)),
                        ..t
                    })
                    .collect();
            let point = adversarial_point(random, &lights[0]);
            each_layout!(weights_are_sound(&lights, &point));
            weights_are_sound::<CompactNode<4>, Falcor, 4>(&lights, &point);
            weights_are_sound::<CompactNode<4>, Pbrt, 4>(&lights, &point);
        }
    });
}

/// Lights in meshes of any size, some flat, some on a plane or without area, some dark, with flux over many orders.
fn lights(random: &mut Random) -> Vec<EmissiveTriangle> {
    let (count, per_mesh, flat) = (1 + random.below(60), 1 + random.below(9), random.below(3) == 0);
    let mut all = generate::small_triangles(count, per_mesh, 10.0, 1.0, random.below(2) == 0, random.bits());
    for triangle in &mut all {
        match random.below(6) {
            0 => triangle.p = [triangle.p[0]; 3],
            1 => triangle.radiance = [0.0; 3],
            2 => triangle.radiance = [exact::pow2(random.below(80) as i32 - 40); 3],
            3 => triangle.flags = EmissiveTriangle::TWO_SIDED,
            _ => {}
        }
        if flat {
            triangle.p.iter_mut().for_each(|v| v[1] = 0.0);
        }
    }
    all
}

/// Lengths and flux times powers of two: not one bit of a pmf changes while everything stays within the domain.
#[test]
fn scales_do_not_matter() {
    (0..128).into_par_iter().for_each(|seed| {
        let random = &mut Random::new(seed);
        let (metres, watts) = (random.below(25) as i32 - 12, random.below(31) as i32 - 20);
        let (length, flux) = (exact::pow2(metres), exact::pow2(watts));
        let triangles = lights(random);
        let scaled = triangles.iter().map(|t| EmissiveTriangle {
            p: t.p.map(|v| v.map(|x| x * length)),
            radiance: t.radiance.map(|x| x * flux),
            ..*t
        });
        let scaled = Lights::new(scaled.collect()).expect("within the domain");
        let lights = Lights::new(triangles).expect("within the domain");
        each_layout!(same_pmfs(&lights, &scaled, length, random));
    });
}

fn same_pmfs<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    lights: &Lights,
    scaled: &Lights,
    length: f32,
    random: &mut Random,
) {
    let two = random.below(2) == 0;
    let [a, b] = [lights, scaled].map(|lights| built::<N, W>(lights, &BuildParams::default(), two));
    for _ in 0..4 {
        let point = generate::point(random, 10.0);
        let far = ShadingPoint {
            p: point.p.map(|x| x * length),
            n: point.n,
        };
        let bits = |pmfs: Vec<f32>| pmfs.into_iter().map(f32::to_bits).collect::<Vec<_>>();
        let (here, there) = (
            all_pmfs::<N, I, W>(&a, lights, &point),
            all_pmfs::<N, I, W>(&b, scaled, &far),
        );
        assert_eq!(
            bits(here),
            bits(there),
            "{} {W} at {point:?}, times {length}",
            N::NAME
        );
    }
}
