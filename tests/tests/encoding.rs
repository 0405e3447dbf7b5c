//! Node layouts against f64: what a slot decodes to contains what was put into it. That neighbours stay as they are, and no flux is
//! lost, the fuzz targets `trees` and `edits` find.

use glam::Vec3;
use lightbvh::device::bounds::MIN_PHI;
use lightbvh::device::cone::{Cone, normalized};
use lightbvh::node::kind;
use lightbvh::{BoundsNode, CompactNode, LightBounds, exact};
use lightbvh_tests::generate::{Random, any_bounds};
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
    let rounding = center.abs().max_element() * 2f64.powi(-22) + 2f64.powi(-50);
    let half = decoded_size.as_dvec3() * 0.5 + rounding;
    assert!(
        f64::from(cluster.radius_squared) <= half.length_squared() * (1.0 + 2f64.powi(-18)),
        "{}: {cluster:?} {decoded:?}",
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
            let (mut low, mut high) = (key_of(-1.0), key_of(1.0));
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

/// An integer that sorts as `x` does.
fn key_of(x: f32) -> u32 {
    let bits = x.to_bits();
    if x.is_sign_negative() {
        !bits
    } else {
        bits ^ 0x8000_0000
    }
}

/// The number that `key_of` gave this key.
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
