//! Importance: Eq. 4 against its formula in `f64`, positive wherever there is flux, finite everywhere, the same at every scale.

use glam::{DVec3, Vec3};
use lightbvh::importance::Cluster;
use lightbvh::node::kind;
use lightbvh::{
    BoundsNode, BuildParams, Bvh, CompactNode, EmissiveTriangle, Eq4, FluxOverDistance, FullNode,
    ImportanceModel, LightBounds, LightNode, Lights, Node, ShadingPoint, Summary, exact,
};
use lightbvh_tests::each_layout;
use lightbvh_tests::generate::{self, Random, any_bounds, extreme_triangle, log_uniform};
use lightbvh_tests::oracle::{Triangle, all_pmfs};
use proptest::prelude::*;

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
        children[slot] = N::Summary::of_triangle(light);
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

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn positive_wherever_there_is_flux(seed: u32) {
        let random = &mut Random::new(seed);
        for _ in 0..128 {
            let lights: Vec<_> = (0..1 + random.below(4)).map(|_| extreme_triangle(random)).collect();
            let point = adversarial_point(random, &lights[0]);
            each_layout!(weights_are_sound(&lights, &point));
        }
    }

    /// The same with lights of one size beside each other, so that boxes and cones are not degenerate.
    #[test]
    fn positive_among_neighbours(seed: u32) {
        let random = &mut Random::new(seed);
        let scale = exact::pow2(random.below(60) as i32 - 30);
        for _ in 0..128 {
            let lights: Vec<_> = generate::small_triangles(4, 4, 4.0, 1.0, random.below(2) == 0, random.bits())
                .into_iter()
                .map(|t| EmissiveTriangle { p: t.p.map(|v| v.map(|x| x * scale)), ..t })
                .collect();
            let point = adversarial_point(random, &lights[0]);
            each_layout!(weights_are_sound(&lights, &point));
        }
    }

    /// Lengths and flux times powers of two: not one bit of a pmf changes while everything stays within the domain.
    #[test]
    fn scales_do_not_matter(lights in generate::lights(60), seed: u32, metres in -12..=12i32, watts in -20..=10i32) {
        let random = &mut Random::new(seed);
        let (length, flux) = (exact::pow2(metres), exact::pow2(watts));
        let scaled = lights.triangles().iter().map(|t| EmissiveTriangle {
            p: t.p.map(|v| v.map(|x| x * length)),
            radiance: t.radiance.map(|x| x * flux),
            ..*t
        });
        let scaled = Lights::new(scaled.collect()).expect("within the domain");
        each_layout!(same_pmfs(&lights, &scaled, length, random));
    }
}

fn same_pmfs<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    lights: &Lights,
    scaled: &Lights,
    length: f32,
    random: &mut Random,
) {
    let params = BuildParams::default();
    let (a, b) = if random.below(2) == 0 {
        (
            Bvh::<N, (), W>::two_level(lights, &params),
            Bvh::<N, (), W>::two_level(scaled, &params),
        )
    } else {
        (
            Bvh::<N, (), W>::single_level(lights, &params),
            Bvh::<N, (), W>::single_level(scaled, &params),
        )
    };
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

/// The extremes of place and flux together: no weight is lost to zero, infinity or NaN.
#[test]
fn corners_of_the_domain() {
    let far = exact::pow2(40);
    let mut random = Random::new(3);
    for _ in 0..20_000 {
        let mut light = extreme_triangle(&mut random);
        light.radiance = [exact::pow2(if random.below(2) == 0 { -100 } else { 100 }); 3];
        let p = [0; 3].map(|_| [0.0, far, -far, exact::pow2(-100), light.p[0][0]][random.below(5) as usize]);
        let n = if random.below(4) == 0 {
            [0.0; 3]
        } else {
            random.direction()
        };
        let point = ShadingPoint { p, n };
        let lights = [light, extreme_triangle(&mut random)];
        each_layout!(weights_are_sound(&lights, &point));
    }
}

/// Relative error of a rough reciprocal, and of a rough reciprocal root ([`exact::recip_rough`], [`exact::rsqrt_rough`]).
const RECIPROCAL: f64 = 3e-3;
const ROOT: f64 = 6.6e-4;
/// Relative error of the incident cosine's bound, which is at least 2^-8: a rough root; and the rounding of the height, a sum of
/// six products each within 2^-24 of the distance, which is at most 2^-20 of it, by 2^-8.
const INCIDENT: f64 = ROOT + 1.0 / 4096.0;
/// Absolute error of the emitters' cosine. The lengths across and along a tangent are rough roots of differences that are off by
/// 2^-21 of d², so within 6.6e-4 + 2^-10.5 of d; the sine and cosine of θ_o + θ_u are off by as much, each by both of its terms;
/// the cosine of a difference has them once more, twice; its square of a rough reciprocal root is off by 1.4e-3.
const ORIENTATION: f64 = 2.0 * (1.414 * (ROOT + 6.9e-4)) + (ROOT + 6.9e-4) + 1.4e-3;

/// Least and greatest factor of both cosines that the stated errors allow; `None` beside a step, where rounding decides.
fn factor(cluster: &Cluster, point: &ShadingPoint) -> Option<[f64; 2]> {
    const SLACK: f64 = 1.0 / 256.0;
    const FLOOR: f64 = 1.0 / 1024.0;
    let v = (cluster.center - point.position()).as_dvec3();
    let n = point.normal().as_dvec3();
    let (d, r) = (v.length(), cluster.extent.as_dvec3().length());
    if (d / r - 1.0).abs() < 1e-5 {
        return None;
    }
    let corners = (0..8).map(|corner| {
        let sign = |bit: u32| if corner >> bit & 1 == 0 { -1.0 } else { 1.0 };
        v + DVec3::new(sign(0), sign(1), sign(2)) * cluster.extent.as_dvec3()
    });
    let height = corners
        .map(|corner| n.dot(corner))
        .fold(f64::NEG_INFINITY, f64::max)
        / d;
    let below = -2f64.powi(-20);
    if n != DVec3::ZERO && (height - below).abs() < 1e-5 {
        return None;
    }
    let incident = if n == DVec3::ZERO {
        [1.0, 1.0]
    } else if height < below {
        [0.0, 0.0]
    } else {
        let bound = height.clamp(SLACK, 1.0);
        [bound * (1.0 - INCIDENT), (bound * (1.0 + INCIDENT)).min(1.0)]
    };
    // The stored axis is as long as it is.
    let theta = (-cluster.axis.as_dvec3().dot(v) / d).clamp(-1.0, 1.0).acos();
    let theta_u = if d > r {
        (r / d).asin()
    } else {
        std::f64::consts::PI
    };
    let cosine = (theta - f64::from(cluster.cos_theta_o).clamp(-1.0, 1.0).acos() - theta_u)
        .max(0.0)
        .cos();
    // What a layout decodes as the sine of θ_o is another 2e-3 off.
    let error = ORIENTATION + 2e-3;
    let orientation = [-error, error].map(|error| {
        let reach = (cosine + error).min(1.0) + SLACK;
        if reach > f64::from(cluster.cos_theta_e) {
            reach
        } else {
            0.0
        }
    });
    Some([0, 1].map(|k| (incident[k] * orientation[k]).max(FLOOR)))
}

/// The weight of a child against that of one whose factor is known: its box holds the point, its lights face everywhere.
/// Returns whether the factor was that of a cosine, neither the least nor the greatest.
fn eq4_is_its_formula<N: BoundsNode<2>>(random: &mut Random) -> bool {
    let size = log_uniform(random, -20, 19);
    let distance = size * log_uniform(random, -3, 6);
    let center = Vec3::from(random.direction()) * size * 4.0;
    let extent = Vec3::new(random.unit(), random.unit(), random.unit()) * size;
    let any = any_bounds(random);
    let bounds = LightBounds {
        min: center - extent,
        max: center + extent,
        axis: any.axis,
        cos_theta_o: any.cos_theta_o,
        cos_theta_e: 0.0,
        phi: log_uniform(random, -20, 20),
    };
    let p = center + Vec3::from(random.direction()) * distance;
    let n = if random.below(4) == 0 {
        [0.0; 3]
    } else {
        random.direction()
    };
    let point = ShadingPoint { p: p.to_array(), n };
    let known = LightBounds {
        min: p - Vec3::splat(4.0 * distance),
        max: p + Vec3::splat(5.0 * distance),
        cos_theta_o: -1.0,
        phi: log_uniform(random, -20, 20),
        ..bounds
    };
    let mut node = N::EMPTY;
    node.set_summaries(&[bounds, known]);
    let clusters = [0, 1].map(|slot| node.cluster(slot));
    let Some([least, greatest]) = factor(&clusters[0], &point) else {
        return false;
    };
    let over_distance = |cluster: &Cluster| {
        let d = (cluster.center - p).as_dvec3();
        let r = cluster.extent.as_dvec3();
        f64::from(cluster.phi) / (d.length_squared() + r.length_squared() / 12.0)
    };
    let [weight, one] = Eq4::weights(&node, &point).map(f64::from);
    let found = weight / one;
    let expected = over_distance(&clusters[0]) / over_distance(&clusters[1]) / (1.0 + 1.0 / 256.0);
    let rough = 2.0 * RECIPROCAL + 1e-5;
    assert!(
        (least * (1.0 - rough)..=greatest * (1.0 + rough)).contains(&(found / expected)),
        "{}: factor {}, expected {least} to {greatest}: {:?} at {point:?}",
        N::NAME,
        found / expected,
        clusters[0]
    );
    least > 0.01 && greatest < 0.99
}

#[test]
fn eq4_is_the_paper_s() {
    let random = &mut Random::new(5);
    let (mut compact, mut full) = (0, 0);
    for _ in 0..200_000 {
        compact += u32::from(eq4_is_its_formula::<CompactNode<2>>(random));
        full += u32::from(eq4_is_its_formula::<FullNode<2>>(random));
    }
    assert!(
        compact > 40_000 && full > 40_000,
        "{compact} and {full} of 200,000 are cosines"
    );
}

/// Flux over distance against its formula, by the weights of two children.
#[test]
fn flux_over_distance_is_its_formula() {
    let random = &mut Random::new(6);
    for _ in 0..50_000 {
        let mut node = FullNode::<2>::EMPTY;
        let size = log_uniform(random, -20, 19);
        let bounds = [0; 2].map(|_| {
            let center = Vec3::from(random.direction()) * size;
            let extent = Vec3::new(random.unit(), random.unit(), random.unit()) * size;
            LightBounds {
                min: center - extent,
                max: center + extent,
                phi: log_uniform(random, -10, 10),
                ..any_bounds(random)
            }
        });
        node.set_summaries(&bounds);
        let point = ShadingPoint {
            p: random.direction().map(|x| x * size * 2.0),
            n: random.direction(),
        };
        let expected = bounds.map(|b| {
            let (min, max) = (b.min.as_dvec3(), b.max.as_dvec3());
            let away = (min + max) * 0.5 - point.position().as_dvec3();
            // Of points spread evenly over a box the variance is a twelfth of the squared diagonal.
            f64::from(b.phi) / (away.length_squared() + (max - min).length_squared() / 12.0)
        });
        let found = FluxOverDistance::weights(&node, &point).map(f64::from);
        let off = found[0] / found[1] / (expected[0] / expected[1]) - 1.0;
        assert!(
            off.abs() < 2.0 * RECIPROCAL + 1e-5,
            "off by {off}: {bounds:?} at {point:?}"
        );
    }
}
