extern crate std;

use std::vec::Vec;

use super::codes::Curve;
use super::radix::{entry, sort};
use super::*;
use crate::build::ward::{Extent, Leaves, WardPrimitive};
use crate::exact::{hash, unit_f32};

fn primitive(index: u32, c: [f32; 3]) -> WardPrimitive {
    WardPrimitive { c, phi: 1.0, index }
}

#[test]
fn entries_are_sorted() {
    for (count, mask) in [(0, !0), (1, !0), (1000, 7), (5000, !0), (100_000, 0xff00)] {
        let mut entries: Vec<u64> = (0..count).map(|i| entry(hash(i as u32) >> 2 & mask, i)).collect();
        let mut expected = entries.clone();
        expected.sort_unstable();
        sort(&mut entries);
        assert!(entries == expected, "{count}");
    }
}

/// Bit by bit, on the cells of the box 0..8 × 0..4 × 0..1.
#[test]
fn codes_interleave_cubes() {
    let extent = Extent::of(&[primitive(0, [0.0; 3]), primitive(1, [8.0, 4.0, 1.0])]);
    let curve = Curve::through(&extent);
    // x alone once; x and y in turns twice; then 25 bits are left: 8 turns of three, and one bit unused.
    for i in 0..1000 {
        let at = |k: u32, side: f32| unit_f32(hash(4 * i + k)) * side;
        let c = [at(0, 8.0), at(1, 4.0), at(2, 1.0)];
        let cell = |x: f32| (f64::from(x) * 2048.0 / 8.0 * (1.0 - 1e-6)) as u32;
        let (x, y, z) = (cell(c[0]), cell(c[1]), cell(c[2]));
        let mut expected = x >> 10;
        for bit in (8..10).rev() {
            expected = expected << 2 | (x >> bit & 1) << 1 | y >> bit & 1;
        }
        for bit in (0..8).rev() {
            expected = expected << 3 | (x >> bit & 1) << 2 | (y >> bit & 1) << 1 | z >> bit & 1;
        }
        // Rounding may take a position on a cell's border to the next.
        let found = curve.code(&primitive(0, c));
        let border = |x: f32| {
            let cells = f64::from(x) * 256.0 * (1.0 - 1e-6);
            let to = cells - cells as u32 as f64;
            !(1e-3..=1.0 - 1e-3).contains(&to)
        };
        assert!(
            found == expected || c.into_iter().any(border),
            "{c:?}: {found:b}, {expected:b}"
        );
    }
}

#[test]
fn clusters_are_the_greatest_prefixes_that_fit() {
    const W: usize = 8;
    let primitives: Vec<_> = (0..3000)
        .map(|i| {
            let at = |k: u32| unit_f32(hash(4 * i + k));
            // Every third light stands where others stand.
            primitive(
                i,
                if i % 3 == 0 {
                    [0.25; 3]
                } else {
                    [at(0), at(1) * 0.5, at(2)]
                },
            )
        })
        .collect();
    let curve = Curve::through(&Extent::of(&primitives));
    let (found, centres) = clusters::<W>(&primitives);
    let mut lights: Vec<u32> = Vec::new();
    for centre in &centres {
        let own: Vec<u32> = (0..found.count(centre.index))
            .map(|k| found.light(centre.index, k))
            .collect();
        assert!((1..=W).contains(&own.len()));
        assert!(crate::exact::abs(centre.phi - own.len() as f32) < 1e-6);
        let codes: Vec<u32> = own.iter().map(|&i| curve.code(&primitives[i as usize])).collect();
        let all: Vec<u32> = primitives.iter().map(|p| curve.code(p)).collect();
        // One bit less of prefix, and there are too many.
        let common = codes.iter().fold(30, |bits, code| {
            bits.min((code ^ codes[0]).leading_zeros() as i32 - 2)
        });
        let within = |bits: i32| {
            all.iter()
                .filter(|&&code| (code ^ codes[0]).leading_zeros() as i32 - 2 >= bits)
                .count()
        };
        if common < 30 {
            assert_eq!(within(common), own.len());
        }
        let above = (0..common).rev().find(|&bits| within(bits) > own.len());
        assert!(above.is_none_or(|bits| within(bits) > W), "{codes:?}");
        lights.extend(own);
    }
    lights.sort_unstable();
    assert!(lights.iter().copied().eq(0..3000));
}

/// The flux of a cluster stays in its range.
#[test]
fn clusters_of_the_brightest_lights_are_not_infinite() {
    let most = crate::exact::pow2(126);
    let primitives: Vec<_> = (0..40)
        .map(|i| WardPrimitive {
            phi: most,
            ..primitive(i, [0.5; 3])
        })
        .collect();
    let (_, centres) = clusters::<8>(&primitives);
    assert!(
        centres
            .iter()
            .all(|centre| centre.phi == most && centre.c == [0.5; 3])
    );
}
