//! Moments against the same sums in `f64`.

mod reference;

use core::slice::from_ref;

use bytemuck::cast_slice;
use glam::Vec3;

use reference::{Exact, merged};

use super::LightMoments;
use crate::exact::{self, pow2};
use crate::importance::{ImportanceModel, Moments};
use crate::kit::{Random, cross, dot, minus, node, normalize, wide};
use crate::light::{EmissiveTriangle, Light, TWO_SIDED};
use crate::node::{MomentNode, Node, TwoSidedMomentNode};
use crate::point::ShadingPoint;
use crate::summary::{Lanes, Summary};
use crate::vector::{max3, min3};

impl Random {
    /// A set with flux, of lengths of about `scale`.
    fn set(&mut self, scale: f32, flux: f32) -> LightMoments {
        let m = self.vector() * if self.unit() < 0.2 { 0.02 } else { 0.57 };
        LightMoments {
            phi: (0.1 + self.unit()) * flux,
            c: self.vector() * scale,
            across: self.unit() * 0.2 * scale,
            along: self.unit() * 0.2 * scale,
            m,
            h: Vec3::new(self.unit(), self.unit(), self.unit()) * (0.5 * scale),
        }
    }
}

fn merge(sets: &[LightMoments; 8]) -> LightMoments {
    LightMoments::merged(&Lanes::of(sets))
}

#[track_caller]
fn near(found: f32, expected: f64, bound: f64, what: &str) {
    let off = (f64::from(found) - expected).abs();
    assert!(
        off <= bound,
        "{what}: {found:e}, expected {expected:e}, off by {off:e}"
    );
}

#[track_caller]
fn alike(found: &LightMoments, expected: &Exact, size: f64) {
    near(found.phi, expected.phi, 1e-5 * expected.phi, "flux");
    near(found.across, expected.across, 1e-5 * size, "across");
    near(found.along, expected.along, 1e-5 * size, "along");
    for k in 0..3 {
        near(found.c[k], expected.c[k], 1e-5 * size, "centre");
        near(found.m[k], expected.m[k], 1e-5, "normal");
        near(found.h[k], expected.h[k], 1e-5 * size, "half extent");
    }
}

/// Of the whole domain; now and then a set has no flux.
#[test]
fn merges_are_the_sums() {
    let mut random = Random(1);
    for scale in [-95, -60, 0, 40] {
        for flux in [-96, -40, 0, 99] {
            for _ in 0..125 {
                let mut sets = [LightMoments::EMPTY; 8];
                sets[random.below(8) as usize] = random.set(pow2(scale), pow2(flux));
                for set in &mut sets {
                    if random.unit() < 0.8 {
                        *set = random.set(pow2(scale), pow2(flux));
                    }
                }
                // Lengths below 2^-100 m count as zero.
                let size = pow2(scale.max(-83)).into();
                alike(&merge(&sets), &merged(&sets), size);
            }
        }
    }
}

#[test]
fn moments_of_triangles_are_the_integrals() {
    let mut random = Random(6);
    for i in 0..2000 {
        let size = pow2([0, 0, -40, 30][i % 4]);
        let at = random.vector() * size;
        let [b, c] = [0; 2].map(|_| at + random.vector() * size);
        let (flags, radiance) = (i as u32 / 7 % 2 * TWO_SIDED, [random.unit(), 2.0, random.unit()]);
        let p = [at, b, c].map(|v| v.to_array());
        let triangle = EmissiveTriangle {
            p,
            radiance,
            mesh: 0,
            flags,
        };
        let (p0, a, b) = (wide(at), wide(b - at), wide(c - at));
        let normal = cross(a, b);
        let length = dot(normal, normal).sqrt();
        let mean = [0, 1, 2].map(|k| (a[k] + b[k]) / 3.0);
        let longest = dot(a, a).max(dot(b, b));
        let offsets = [mean, minus(a, mean), minus(b, mean)];
        let squares: f64 = offsets.iter().map(|&d| dot(d, d)).sum();
        let deviation = (squares / 24.0).sqrt();
        let luminance = 0.2126 * f64::from(radiance[0]) + 0.7152 * 2.0 + 0.0722 * f64::from(radiance[2]);
        let sides = if flags == 0 { 1.0 } else { 2.0 };
        let expected = Exact {
            phi: core::f64::consts::FRAC_PI_2 * length * luminance * sides,
            c: [0, 1, 2].map(|k| p0[k] + mean[k]),
            across: deviation,
            along: if flags == 0 { 0.0 } else { deviation },
            m: if flags == 0 { normalize(normal) } else { [0.0; 3] },
            h: [0, 1, 2].map(|k| offsets.iter().fold(0.0, |most, d| d[k].abs().max(most))),
        };
        // Rounding turns the normals of needles.
        if length > 0.1 * longest {
            alike(&triangle.moments(), &expected, f64::from(size));
        }
    }
}

#[test]
fn packed_moments_are_within_half_a_code() {
    let mut random = Random(7);
    for scale in [-90, 0, 39] {
        for _ in 0..500 {
            let scale = pow2(scale);
            let sets = [0; 8].map(|_| random.set(scale, 1.0));
            let node: MomentNode<8> = node(&sets);
            let mut low = sets[0].c;
            let mut high = sets[0].c;
            for s in &sets {
                (low, high) = (min3(low, s.c), max3(high, s.c));
            }
            // The unit is at most twice the greatest offset from the middle, but not below 2^-87 m.
            let unit = f64::from((high - low).max_element()).max(2.0_f64.powi(-87));
            for (slot, s) in sets.iter().enumerate() {
                let found = node.summary(slot);
                let across = exact::max(s.across, 0.5 * s.along);
                let (size, breadth) = (f64::from(scale), f64::from(found.across) * 2.0_f64.sqrt());
                near(found.phi, s.phi.into(), f64::from(s.phi) / 32.0, "flux");
                near(
                    found.across,
                    across.into(),
                    f64::from(across) / 16.0 + 1e-6 * size,
                    "across",
                );
                for k in 0..3 {
                    near(
                        found.c[k],
                        s.c[k].into(),
                        unit * 2.0_f64.powi(-15) + 1e-6 * size,
                        "centre",
                    );
                    near(found.m[k], s.m[k].into(), 2.0_f64.powi(-8) * 1.001, "normal");
                    let stored = f64::from(s.h[k]).min(breadth * (16.0 - 1.0 / 16.0));
                    near(found.h[k], stored, breadth / 16.0 + breadth / 32.0, "half extent");
                }
                let along = f64::from(s.along).min(f64::from(found.across) * 63.0 / 32.0);
                near(
                    found.along,
                    along,
                    f64::from(found.across) / 20.0 + f64::from(across) / 16.0,
                    "along",
                );
            }
        }
    }
}

/// What a packed node says of all its children is what they say as they are read.
#[test]
fn packed_nodes_merge_what_they_store() {
    let mut random = Random(8);
    for _ in 0..500 {
        let sets = [0; 8].map(|_| random.set(1.0, 1.0));
        let node: MomentNode<8> = node(&sets);
        let mut stored = sets;
        for slot in 0..8 {
            stored[slot] = node.summary(slot);
        }
        alike(&node.merged(), &merged(&stored), 2.0);
    }
}

/// What a set without flux says of itself changes nothing: not the merged set, nor the words of the others in a node.
#[test]
fn sets_without_flux_do_not_matter() {
    let mut random = Random(7);
    let garbage = LightMoments {
        phi: 0.0,
        c: Vec3::new(pow2(40), -pow2(40), 3.0),
        across: pow2(30),
        along: pow2(31),
        m: Vec3::new(0.5, 0.5, -0.5),
        h: Vec3::splat(pow2(35)),
    };
    for _ in 0..500 {
        let mut plain = [LightMoments::EMPTY; 8];
        let mut dirty = plain;
        for slot in 0..8 {
            if random.unit() < 0.6 {
                plain[slot] = random.set(1.0, 1.0);
                dirty[slot] = plain[slot];
            } else {
                dirty[slot] = garbage;
            }
        }
        assert_eq!(merge(&plain), merge(&dirty));
        assert_eq!(merge(&[garbage; 8]), LightMoments::EMPTY);
        assert_eq!(node::<MomentNode<8>, 8>(&plain), node(&dirty));
    }
}

/// Flux at the end of its range stays in it: merged, and rounded up to a code.
#[test]
fn flux_stays_in_its_range() {
    let most = pow2(126);
    let mut set = Random(11).set(1.0, 1.0);
    // Rounds up to the next code, that of 2^126 and more.
    for phi in [most, most * 0.99] {
        set.phi = phi;
        assert_eq!(merge(&[set; 8]).phi, most);
        let node: MomentNode<8> = node(&[set; 8]);
        for slot in 0..8 {
            assert_eq!(node.summary(slot).phi, most, "{slot}");
        }
    }
}

/// A frame is as wide as a centre's offset and an extent can be together, and a little flux stays some beside the brightest.
#[test]
fn sets_fit_into_their_frame() {
    let mut random = Random(23);
    for _ in 0..2000 {
        let sets = [0; 8].map(|_| random.set(1.0, 1.0));
        let rows = super::merge::framed(&Lanes::of(&sets)).sets.0;
        for i in 0..8 {
            for k in 0..3 {
                let reach = exact::abs(rows[super::row::C + k][i]) + rows[super::row::H + k][i];
                assert!(reach <= pow2(31), "{reach:e}");
            }
        }
    }
    for (ratio, kept) in [(-39, -39), (-40, -40), (-41, -40), (-200, -40)] {
        let mut sets = [LightMoments::EMPTY; 8];
        sets[2] = LightMoments {
            phi: pow2(100),
            ..random.set(1.0, 1.0)
        };
        sets[6] = LightMoments {
            phi: pow2(100 + ratio),
            ..random.set(1.0, 1.0)
        };
        let rows = super::merge::framed(&Lanes::of(&sets)).sets.0;
        assert_eq!(rows[super::row::PHI][6], pow2(kept), "{ratio}");
        assert_eq!(rows[super::row::PHI][0], 0.0);
        assert!(node::<MomentNode<8>, 8>(&sets).summary(6).phi > 0.0, "{ratio}");
    }
}

/// Without mean normals a node without the row of them has the bits of the other: its words, what they say, and weights.
#[test]
fn two_sided_nodes_leave_out_a_constant_row() {
    fn check<const W: usize>(random: &mut Random) {
        let scale = random.power(-60, 36);
        let sets = [0; W].map(|_| {
            let flux = random.power(-35, 35) * if random.below(6) == 0 { 0.0 } else { 1.0 };
            LightMoments {
                m: Vec3::ZERO,
                ..random.set(scale, flux)
            }
        });
        let (full, less): (MomentNode<W>, TwoSidedMomentNode<W>) = (node(&sets), node(&sets));
        let (a, b): (&[u32], &[u32]) = (cast_slice(from_ref(&full)), cast_slice(from_ref(&less)));
        assert_eq!((a.len(), b.len()), (6 * W, 5 * W));
        assert_eq!((&a[..3 * W], &a[4 * W..]), (&b[..3 * W], &b[3 * W..]));
        for (slot, set) in sets.iter().enumerate() {
            let shines = set.phi > 0.0;
            assert_eq!(a[3 * W + slot], if shines { !0 } else { 0 }, "{slot}");
            assert!(!shines || full.summary(slot) == less.summary(slot), "{slot}");
        }
        assert_eq!(full.merged(), less.merged());
        for n in [Vec3::ZERO, random.direction()] {
            let away = random.vector() * (scale * random.power(-6, 6));
            let point = ShadingPoint {
                p: (sets[0].c + away).to_array(),
                n: n.to_array(),
            };
            let (a, b) = (Moments::weights(&full, &point), Moments::weights(&less, &point));
            assert_eq!(a.map(f32::to_bits), b.map(f32::to_bits), "{sets:?} at {point:?}");
        }
    }
    let random = &mut Random(31);
    for _ in 0..2000 {
        check::<4>(random);
        check::<8>(random);
        check::<16>(random);
    }
}
