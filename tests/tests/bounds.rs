//! Light bounds against f64: what they must contain they contain, under merge and under each layout's rounding.

use glam::{DVec3, Vec3};
use lightbvh::bounds::{MAX_PHI, MIN_PHI};
use lightbvh::cone::Cone;
use lightbvh::node::kind;
use lightbvh::{CompactNode, EmissiveTriangle, FullNode, LightBounds, LightNode, exact};
use lightbvh_tests::generate::{Random, extreme_triangle, log_uniform};
use lightbvh_tests::oracle::{Triangle, cone_excess, half_angle};
use proptest::prelude::*;
use std::f64::consts::PI;

/// What f64 itself may be off, in radians: acos and atan2 of numbers that are exact.
const ORACLE_ERROR: f64 = 1e-12;

const ULP: f64 = 1.0 / 16_777_216.0;

fn of_triangle_contains_it(light: &EmissiveTriangle) {
    let bounds = LightBounds::of_triangle(light);
    for v in light.p {
        let v = Vec3::from(v);
        assert!(
            bounds.min.cmple(v).all() && v.cmple(bounds.max).all(),
            "{bounds:?} {light:?}"
        );
    }
    let luminance = (0..3)
        .map(|c| [0.2126, 0.7152, 0.0722][c] * f64::from(light.radiance[c]))
        .sum::<f64>();
    let triangle = Triangle::new(light);
    let longest = (0..3)
        .map(|k| (triangle.p[k] - triangle.p[(k + 1) % 3]).length())
        .fold(0.0, f64::max);
    if luminance == 0.0 || longest == 0.0 {
        assert_eq!(bounds.phi, 0.0, "{light:?}");
        return;
    }
    // Edges are off by 2^-24 each, the products and their difference by as much again: together less than 8 units of
    // 2^-24 of |e1| |e2|, which the condition relates to the normal. Normalisation and flux add fewer than 8 each.
    let error = 8.0 * ULP * triangle.condition;
    // Below 2^-100 of the longest edge squared an area counts as none, from 2^-96 on certainly not.
    if triangle.normal.length() > 2f64.powi(-96) * longest * longest && error < 0.25 {
        let off = lightbvh_tests::oracle::angle(bounds.axis.as_dvec3(), triangle.normal);
        assert!(
            off <= error + 8.0 * ULP,
            "axis off by {off}, at most {error}: {light:?}"
        );
        assert!((bounds.axis.as_dvec3().length() - 1.0).abs() < 4.0 * ULP);
        let faces = if light.is_two_sided() { 2.0 } else { 1.0 };
        let phi = (PI * triangle.area() * luminance * faces).clamp(f64::from(MIN_PHI), f64::from(MAX_PHI));
        let relative = (f64::from(bounds.phi) / phi - 1.0).abs();
        assert!(
            relative <= error + 16.0 * ULP,
            "flux {} of {phi}: {light:?}",
            bounds.phi
        );
        // The cone is opened by the error, except below what a cosine near 1 resolves.
        let open = half_angle(bounds.cos_theta_o);
        assert!(
            off <= open + 2f64.powi(-11),
            "axis off by {off}, cone {open}: {light:?}"
        );
        assert!(open <= 2.0 * error + 2f64.powi(-11) || open == PI && (error > 0.12 || light.is_two_sided()));
        assert!(!light.is_two_sided() || open == PI);
    }
}

/// Bounds of any kind: of triangles, or with any cone.
fn any_bounds(random: &mut Random) -> LightBounds {
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

fn any_cone(random: &mut Random) -> Cone {
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
        _ => (f64::from(random.unit()) * PI).cos() as f32,
    };
    Cone {
        axis: lightbvh::cone::normalized(Vec3::from(axis)),
        cos_theta_o,
    }
}

fn pair(cone: Cone) -> (DVec3, f32) {
    (cone.axis.as_dvec3(), cone.cos_theta_o)
}

fn cone_contains(outer: Cone, inner: Cone, what: &str) {
    let excess = cone_excess(pair(outer), pair(inner));
    assert!(
        excess <= ORACLE_ERROR,
        "{what}: {inner:?} reaches {excess:e} rad out of {outer:?}"
    );
}

fn box_contains(outer: &LightBounds, inner: &LightBounds) -> bool {
    outer.min.cmple(inner.min).all() && inner.max.cmple(outer.max).all()
}

fn merge_contains_its_parts(a: &LightBounds, b: &LightBounds) {
    let both = a.merge(b);
    for part in [a, b] {
        if part.phi > 0.0 {
            assert!(box_contains(&both, part), "{part:?} {both:?}");
            cone_contains(both.cone(), part.cone(), "merge");
            assert!(both.cos_theta_e <= part.cos_theta_e);
        }
    }
    let sum = f64::from(a.phi) + f64::from(b.phi);
    assert!((f64::from(both.phi) - sum).abs() <= ULP * sum);
}

/// Sets slot `slot` of an otherwise empty node and reads it again.
fn encoded<N: LightNode<W>, const W: usize>(bounds: &LightBounds, slot: usize) -> (N, LightBounds) {
    let mut node = N::EMPTY;
    node.set_child(slot, kind::LIGHT, 7);
    node.set_bounds(slot, bounds);
    let decoded = node.bounds(slot);
    (node, decoded)
}

fn encoding_is_outward<N: LightNode<W>, const W: usize>(bounds: &LightBounds, slot: usize) {
    let (node, decoded) = encoded::<N, W>(bounds, slot);
    assert!(
        box_contains(&decoded, bounds),
        "{}: {bounds:?} {decoded:?}",
        N::NAME
    );
    cone_contains(decoded.cone(), bounds.cone(), N::NAME);
    assert!(decoded.cos_theta_e <= bounds.cos_theta_e && decoded.phi >= bounds.phi);

    // And not far out: a fiftieth of the greatest extent, a fiftieth of a radian below π/2, 2^-15 of the flux.
    let (size, decoded_size) = (bounds.max - bounds.min, decoded.max - decoded.min);
    let coarse = size.max_element() / 50.0
        + 2f32.powi(-98)
        + bounds.max.abs().max(bounds.min.abs()).max_element() * 2f32.powi(-22);
    assert!(
        (decoded_size - size).max_element() <= coarse,
        "{}: {bounds:?} {decoded:?}",
        N::NAME
    );
    if bounds.cos_theta_o >= 0.0 {
        assert!(half_angle(decoded.cos_theta_o) <= half_angle(bounds.cos_theta_o) + 0.02);
    }
    assert!(decoded.phi <= bounds.phi * (1.0 + 2f32.powi(-15)));

    // What importance sees: a sphere around the box, a direction along the axis, the same cone.
    let cluster = node.cluster(slot);
    let center = cluster.center.as_dvec3();
    let reach = (bounds.max.as_dvec3() - center)
        .abs()
        .max((bounds.min.as_dvec3() - center).abs());
    assert!(
        reach.length_squared() <= f64::from(cluster.radius_squared) * (1.0 + 4.0 * ULP),
        "{}: {reach} {cluster:?} {bounds:?}",
        N::NAME
    );
    cone_contains(
        Cone {
            axis: cluster.axis,
            cos_theta_o: cluster.cos_theta_o,
        },
        bounds.cone(),
        N::NAME,
    );
    let sine = f64::from(cluster.cos_theta_o).acos().sin();
    assert!(
        (f64::from(cluster.sin_theta_o) - sine).abs() < 2e-3,
        "{cluster:?}"
    );
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn triangles(seed: u32) {
        let random = &mut Random::new(seed);
        for _ in 0..256 {
            of_triangle_contains_it(&extreme_triangle(random));
        }
    }

    #[test]
    fn merges(seed: u32) {
        let random = &mut Random::new(seed);
        for _ in 0..256 {
            merge_contains_its_parts(&any_bounds(random), &any_bounds(random));
        }
    }

    #[test]
    fn encodings(seed: u32) {
        let random = &mut Random::new(seed);
        for _ in 0..256 {
            let bounds = any_bounds(random);
            encoding_is_outward::<CompactNode<2>, 2>(&bounds, 1);
            encoding_is_outward::<CompactNode<16>, 16>(&bounds, random.below(16) as usize);
            encoding_is_outward::<FullNode<4>, 4>(&bounds, random.below(4) as usize);
        }
    }

    /// Chains of merges and encodings, as refit makes them: the last still contains the first.
    #[test]
    fn chains(seed: u32) {
        let random = &mut Random::new(seed);
        let mut bounds = any_bounds(random);
        for _ in 0..64 {
            let merged = any_bounds(random).merge(&bounds);
            let (_, decoded) = encoded::<CompactNode<2>, 2>(&merged, 0);
            if bounds.phi > 0.0 {
                assert!(box_contains(&decoded, &bounds));
                cone_contains(decoded.cone(), bounds.cone(), "chain");
                assert!(decoded.phi >= bounds.phi);
            }
            bounds = decoded;
        }
    }
}

/// Every pair of cones of a grid of half-angles, at every angle of it apart, exactly parallel and opposite axes in it.
#[test]
fn unions_over_a_grid() {
    let mut angles: Vec<f64> = (0..=24).map(|i| PI * f64::from(i) / 24.0).collect();
    for tiny in [
        2f64.powi(-21),
        2f64.powi(-13),
        2f64.powi(-12),
        2f64.powi(-11),
        1e-3,
        0.01,
    ] {
        angles.extend([tiny, PI - tiny]);
    }
    let mut random = Random::new(1);
    let mut frames = vec![(Vec3::X, Vec3::Y), (Vec3::Z, Vec3::NEG_X)];
    for _ in 0..3 {
        let a = Vec3::from(random.direction());
        frames.push((a, a.any_orthonormal_vector()));
    }
    for (x, y) in frames {
        for &apart in &angles {
            let other = x.as_dvec3() * apart.cos() + y.as_dvec3() * apart.sin();
            let other = if apart == PI {
                -x
            } else {
                lightbvh::cone::normalized(other.as_vec3())
            };
            for &theta_a in &angles {
                for &theta_b in &angles {
                    let a = Cone {
                        axis: x,
                        cos_theta_o: theta_a.cos() as f32,
                    };
                    let b = Cone {
                        axis: other,
                        cos_theta_o: theta_b.cos() as f32,
                    };
                    let union = a.union(b);
                    cone_contains(union, a, "union, first");
                    cone_contains(union, b, "union, second");
                    // Smallest, but for the widening, rounding near 0 and π, and opposite axes, which give everything.
                    let (low, high) = (theta_a.max(theta_b), PI.min(0.5 * (theta_a + theta_b + apart)));
                    let found = half_angle(union.cos_theta_o);
                    let wide = low.max(high) + 3e-3;
                    let everything = apart > PI - 1e-5 || wide > PI - 3e-3;
                    assert!(
                        found <= wide || everything,
                        "{a:?} {b:?} {apart}: {found}, expected {wide}"
                    );
                }
            }
        }
    }
}

fn node_of_words<const W: usize>(words: &[u32]) -> CompactNode<W> {
    bytemuck::pod_read_unaligned(bytemuck::cast_slice(words))
}

/// Codes of cones: in order, from the single direction to the sphere, each decoded to itself or one step further out.
#[test]
fn all_cone_codes() {
    let mut last = 2.0;
    for code in 0..=255_u32 {
        let mut words = [0_u32; 14];
        words[4 * 2] = 0x3ff << 22 | 511 << 12 | 511 << 2;
        words[5 * 2] = 0x3f80_0000 << 1 | code;
        let node: CompactNode<2> = node_of_words(&words);
        let decoded = node.bounds(0);
        assert_eq!(decoded.phi, 1.0);
        assert!(decoded.cos_theta_o < last || code == 255, "code {code}");
        last = decoded.cos_theta_o;
        let (again, _) = encoded::<CompactNode<2>, 2>(&decoded, 0);
        let code_again = bytemuck::cast_slice::<u8, u32>(bytemuck::bytes_of(&again))[5 * 2] & 255;
        assert!(code_again >= code, "code {code} became {code_again}");
        assert!(
            code_again <= code + 2 || code_again == 255,
            "code {code} became {code_again}"
        );
        assert!(code_again < 255 || code > 250, "code {code} became the sphere");
    }
    assert_eq!(last, -1.0);
}

fn children_keep_to_their_slots<N: LightNode<W> + PartialEq + std::fmt::Debug, const W: usize>() {
    let mut random = Random::new(W as u32);
    let mut node = N::EMPTY;
    for round in 0..64 {
        for slot in 0..W {
            let before = node;
            let to = [kind::EMPTY, kind::INNER, kind::LIGHT, kind::MESH][(round + slot) % 4];
            let link = if round % 3 == 0 { u32::MAX } else { random.bits() };
            node.set_child(slot, to, link);
            assert_eq!(
                (node.kind(slot), node.link(slot), node.bounds(slot).phi),
                (to, link, 0.0)
            );
            node.set_bounds(slot, &any_bounds(&mut random));
            assert_eq!((node.kind(slot), node.link(slot)), (to, link));
            for other in (0..W).filter(|&other| other != slot) {
                assert_eq!(
                    (node.kind(other), node.link(other)),
                    (before.kind(other), before.link(other))
                );
                assert_eq!(node.bounds(other), before.bounds(other));
            }
        }
    }
}

#[test]
fn kinds_and_links() {
    children_keep_to_their_slots::<CompactNode<2>, 2>();
    children_keep_to_their_slots::<CompactNode<8>, 8>();
    children_keep_to_their_slots::<FullNode<2>, 2>();
    children_keep_to_their_slots::<FullNode<16>, 16>();
}

/// The least and greatest of everything at once.
#[test]
fn corners_of_the_domain() {
    let far = exact::pow2(40);
    let tiny = exact::pow2(-100);
    for (min, max) in [
        ([-far; 3], [far; 3]),
        ([far; 3], [far; 3]),
        ([0.0; 3], [tiny; 3]),
        ([0.0, -far, tiny], [tiny, far, tiny]),
        ([far, 0.0, -tiny], [far, tiny, tiny]),
        ([0.0; 3], [0.0; 3]),
    ] {
        for phi in [MIN_PHI, MAX_PHI, exact::pow2(126), 0.0] {
            for cos_theta_o in [1.0, 1.0 - f32::EPSILON, 0.0, f32::EPSILON - 1.0, -1.0] {
                let bounds = LightBounds {
                    min: Vec3::from(min),
                    max: Vec3::from(max),
                    axis: Vec3::NEG_Y,
                    cos_theta_o,
                    cos_theta_e: 0.0,
                    phi,
                };
                encoding_is_outward::<CompactNode<2>, 2>(&bounds, 0);
                encoding_is_outward::<FullNode<2>, 2>(&bounds, 0);
                merge_contains_its_parts(
                    &bounds,
                    &LightBounds {
                        phi: MIN_PHI,
                        ..bounds
                    },
                );
            }
        }
    }
}
