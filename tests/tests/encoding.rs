//! Node layouts against f64: what a slot decodes to contains what was put into it, and its neighbours stay as they are.

use glam::Vec3;
use lightbvh::bounds::MIN_PHI;
use lightbvh::cone::{Cone, normalized};
use lightbvh::node::kind;
use lightbvh::{BoundsNode, CompactNode, Instance, LightBounds, LightNode, Summary, exact};
use lightbvh_tests::each_node;
use lightbvh_tests::generate::{self, Random, any_bounds, extreme_triangle};
use lightbvh_tests::oracle::{assert_cone_contains, box_contains, half_angle};
use rayon::prelude::*;

const ULP: f64 = 1.0 / 16_777_216.0;

/// Sets slot `slot` of an otherwise empty node and reads it again.
fn encoded<N: BoundsNode<W>, const W: usize>(bounds: &LightBounds, slot: usize) -> (N, LightBounds) {
    let mut node = N::EMPTY;
    node.set_child(slot, kind::LIGHT, 7);
    let mut children = [LightBounds::EMPTY; W];
    children[slot] = *bounds;
    node.set_summaries(&children);
    let decoded = node.summary(slot);
    (node, decoded)
}

fn encoding_is_outward<N: BoundsNode<W>, const W: usize>(bounds: &LightBounds, slot: usize) {
    let (node, decoded) = encoded::<N, W>(bounds, slot);
    assert!(
        box_contains(&decoded, bounds),
        "{}: {bounds:?} {decoded:?}",
        N::NAME
    );
    assert_cone_contains(decoded.cone(), bounds.cone(), N::NAME);
    assert!(decoded.phi >= bounds.phi);

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
    assert_cone_contains(
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

#[test]
fn encodings() {
    (0..256).into_par_iter().for_each(|seed| {
        let random = &mut Random::new(seed);
        for _ in 0..256 {
            let bounds = any_bounds(random);
            encoding_is_outward::<CompactNode<2>, 2>(&bounds, 1);
            encoding_is_outward::<CompactNode<16>, 16>(&bounds, random.below(16) as usize);
        }
    });
}

/// Kinds and links are kept apart from summaries, and from each other; what is said of a child does not touch the others.
fn children_keep_to_their_slots<N: LightNode<W>, const W: usize>() {
    let mut random = Random::new(W as u32);
    let mut node = N::EMPTY;
    let words = |node: &N, slot: usize| node.summary(slot).to_words().map(f32::to_bits);
    for round in 0..64 {
        for slot in 0..W {
            let before = node;
            let to = [kind::EMPTY, kind::INNER, kind::LIGHT, kind::MESH][(round + slot) % 4];
            let link = if round.is_multiple_of(3) {
                u32::MAX
            } else {
                random.bits()
            };
            node.set_child(slot, to, link);
            assert_eq!((node.kind(slot), node.link(slot)), (to, link));
            assert_eq!(node.summary(slot).phi(), 0.0, "set anew, it has no summary");
            node.relink(slot, !link);
            assert_eq!((node.kind(slot), node.link(slot)), (to, !link));
            for other in (0..W).filter(|&other| other != slot) {
                assert_eq!(
                    (node.kind(other), node.link(other)),
                    (before.kind(other), before.link(other))
                );
                assert_eq!(words(&node, other), words(&before, other));
            }
        }
        let before = node;
        node.set_summaries(&std::array::from_fn(|_| {
            N::Summary::of_triangle(&extreme_triangle(&mut random))
        }));
        for slot in 0..W {
            assert_eq!(
                (node.kind(slot), node.link(slot)),
                (before.kind(slot), before.link(slot))
            );
        }
    }
}

#[test]
fn kinds_and_links() {
    each_node!(children_keep_to_their_slots());
}

/// Flux that is not zero never becomes zero on its way into a node, up its parents and into the world.
fn flux_is_kept<N: LightNode<W>, const W: usize>() {
    let mut random = Random::new(W as u32);
    for _ in 0..2000 {
        let children: [N::Summary; W] =
            std::array::from_fn(|_| N::Summary::of_triangle(&extreme_triangle(&mut random)));
        let mut node = N::EMPTY;
        for slot in 0..W {
            node.set_child(slot, kind::LIGHT, 0);
        }
        node.set_summaries(&children);
        let mut any = false;
        for (slot, child) in children.iter().enumerate() {
            assert_eq!(node.summary(slot).phi() > 0.0, child.phi() > 0.0, "{child:?}");
            any |= child.phi() > 0.0;
        }
        let all = node.merged();
        assert_eq!(all.phi() > 0.0, any, "{children:?}");
        let flux = generate::log_uniform(&mut random, -100, 99);
        for flux in [flux, exact::pow2(-100), exact::pow2(100), 0.0] {
            let instance = Instance {
                flux,
                ..Instance::IDENTITY
            };
            let world = all.to_world::<lightbvh::EmissiveTriangle>(&instance).phi();
            assert_eq!(world > 0.0, any && flux > 0.0, "{all:?} times {flux}");
            assert!(world == 0.0 || (MIN_PHI..=exact::pow2(126)).contains(&world));
        }
        let words = all.to_words();
        assert_eq!(N::Summary::from_words(&words), all);
    }
}

#[test]
fn flux_stays_flux() {
    each_node!(flux_is_kept());
}

/// A quantiser's hardest inputs: what a code stands for, and its neighbours.
fn beside(x: f32) -> [f32; 3] {
    [x.next_down(), x, x.next_up()]
}

fn with_phi(phi: f32) -> LightBounds {
    LightBounds {
        min: Vec3::ZERO,
        max: Vec3::ONE,
        axis: Vec3::Y,
        cos_theta_o: 1.0,
        phi,
    }
}

/// All 14.8 million codes of flux: what each stands for is kept, and what lies above goes to the next code.
#[test]
fn all_codes_of_flux_are_outward() {
    let codes = (MIN_PHI.to_bits()..=exact::pow2(126).to_bits()).step_by(1 << 7);
    codes.collect::<Vec<_>>().into_par_iter().for_each(|word| {
        let phi = f32::from_bits(word);
        assert!(phi >= MIN_PHI && phi <= exact::pow2(126));
        let decoded = |phi: f32| encoded::<CompactNode<2>, 2>(&with_phi(phi), 1).1.phi;
        assert_eq!(decoded(phi), phi);
        let next = f32::from_bits(word + 0x80);
        assert_eq!(decoded(phi.next_up()), next, "{phi:e}");
        assert_eq!(decoded(next.next_down()), next, "{phi:e}");
    });
}

/// All 256 codes of an extent in all units, beside a greatest extent that sets the unit, about the origin and off it.
#[test]
fn all_codes_of_extents_are_outward() {
    (-100..=39_i32).into_par_iter().for_each(|e| {
        let unit = exact::pow2(e - 7);
        for greatest in [128.0, 200.0, 255.0] {
            for code in 0..=255_u32 {
                for h in beside(code as f32 * unit) {
                    let h = exact::flush(h.clamp(0.0, greatest * unit), exact::pow2(-100));
                    for axis in 0..3 {
                        let mut half = Vec3::splat(greatest * unit);
                        half[axis] = h;
                        for center in [Vec3::ZERO, Vec3::new(3.0, -5.0, 0.5) * unit] {
                            let bounds = LightBounds {
                                min: center - half,
                                max: center + half,
                                ..with_phi(1.0)
                            };
                            encoding_is_outward::<CompactNode<2>, 2>(&bounds, 0);
                        }
                    }
                }
            }
        }
    });
}

/// All 256 codes of cones: at the cosine that a code stands for, as widened on the way in, the next code begins.
#[test]
fn all_codes_of_cones_are_outward() {
    let axes = [
        Vec3::Y,
        normalized(Vec3::new(0.51, -0.62, 0.593)),
        normalized(Vec3::new(1.0, 1.0, -1.0)),
    ];
    let bounds = |axis, cos_theta_o| LightBounds {
        axis,
        cos_theta_o,
        ..with_phi(1.0)
    };
    for axis in axes {
        let code = |cos_theta_o: f32| {
            let (node, _) = encoded::<CompactNode<2>, 2>(&bounds(axis, cos_theta_o), 0);
            bytemuck::cast_slice::<u8, u32>(bytemuck::bytes_of(&node))[5 * 2] & 255
        };
        let mut seen = std::collections::BTreeSet::new();
        for wanted in 0..=255 {
            // The least cosine, by its order on bits, whose code is at most this one.
            let (mut low, mut high) = (exact::order_key(-1.0), exact::order_key(1.0));
            while low < high {
                let middle = low + (high - low) / 2;
                if code(from_key(middle)) <= wanted {
                    high = middle
                } else {
                    low = middle + 1
                }
            }
            for key in low.saturating_sub(2)..=low.saturating_add(2) {
                let cos = from_key(key);
                if (-1.0..=1.0).contains(&cos) {
                    seen.insert(code(cos));
                    encoding_is_outward::<CompactNode<2>, 2>(&bounds(axis, cos), 0);
                }
            }
        }
        // Codes 0 and 1 are the cones that widening never leaves; 254 and 255 are one sphere.
        assert!(seen.len() >= 250, "{} codes", seen.len());
    }
}

/// The number that `order_key` gave this key.
fn from_key(key: u32) -> f32 {
    f32::from_bits(if key >> 31 == 1 { key ^ 0x8000_0000 } else { !key })
}

/// All pairs of the 1023 codes of two of an axis's components: at the least number of a code and its neighbours.
#[test]
fn all_codes_of_axes_are_outward() {
    let unit = |code: i32| (code as f32 - 511.5) / (511.0 * 0.9983);
    let codes: Vec<i32> = (0..=1022).collect();
    codes.par_iter().for_each(|&i| {
        for &k in &codes {
            let (x, y) = (unit(i), unit(k));
            let z = 1.0 - f64::from(x).powi(2) - f64::from(y).powi(2);
            if z < 0.0 {
                continue;
            }
            let z = z.sqrt() as f32;
            for (a, b, c) in [(x, y, z), (z, x, y), (y, -z, x)] {
                for axis in [Vec3::new(a, b, c), Vec3::new(a.next_up(), b.next_down(), c)] {
                    let bounds = LightBounds {
                        axis,
                        ..with_phi(1.0)
                    };
                    encoding_is_outward::<CompactNode<2>, 2>(&bounds, 1);
                }
            }
        }
    });
}
