//! What lies within what, component by component; and differences named by where they are.

extern crate std;

use glam::Vec3;

use super::*;
use crate::LightBounds;
use crate::cone::Cone;
use crate::kit::plain::PlainNode;

const OUTER: LightBounds = LightBounds {
    min: Vec3::new(-1.0, -2.0, -3.0),
    max: Vec3::new(4.0, 5.0, 6.0),
    axis: Vec3::new(0.0, 0.0, 1.0),
    cos_theta_o: 0.5,
    phi: 8.0,
};

fn node(bounds: &LightBounds) -> PlainNode<2> {
    let mut node = PlainNode::EMPTY;
    node.set_child(1, kind::LIGHT, 3);
    node.set_summaries(&[LightBounds::EMPTY, *bounds]);
    node
}

#[test]
fn what_reaches_out_is_named() {
    assert_eq!(contained(&OUTER, 7, &node(&OUTER)), Ok(()), "equal is within");
    let inner = LightBounds {
        min: OUTER.min + 0.5,
        max: OUTER.max - 0.5,
        cos_theta_o: 0.75,
        phi: 1.0,
        ..OUTER
    };
    assert_eq!(contained(&OUTER, 7, &node(&inner)), Ok(()));
    let change = |component: usize, by: f32| {
        let mut out = inner;
        match component {
            0..3 => out.min[component] = OUTER.min[component] + by,
            3..6 => out.max[component - 3] = OUTER.max[component - 3] + by,
            9 => out.cos_theta_o = OUTER.cos_theta_o + by,
            _ => out.phi = OUTER.phi + by,
        }
        out
    };
    for (component, outward) in [
        (0, -0.01),
        (1, -0.01),
        (2, -0.01),
        (3, 0.01),
        (4, 0.01),
        (5, 0.01),
        (9, -0.01),
        (11, 0.01),
    ] {
        let out = change(component, outward);
        let what = format!("{} within the parent's", LightBounds::NAMES[component]);
        let [e, f] = [OUTER, out].map(|own| format!("{:e}", own.to_words()[component]));
        let violation = Violation::new(7, 1, what, e, f);
        assert_eq!(contained(&OUTER, 7, &node(&out)), Err(violation));
        assert_eq!(contained(&OUTER, 7, &node(&change(component, -outward))), Ok(()));
        // Without flux it means nothing, and neither does it in an empty slot.
        let dark = LightBounds { phi: 0.0, ..out };
        assert_eq!(contained(&OUTER, 7, &node(&dark)), Ok(()));
        let mut empty = node(&out);
        empty.set_child(1, kind::EMPTY, 0);
        empty.set_summaries(&[LightBounds::EMPTY, out]);
        assert_eq!(contained(&OUTER, 7, &empty), Ok(()));
    }
}

/// Against angles in f64, with what the slack leaves open.
#[test]
fn cones_within_cones() {
    let steps = 24;
    let angle = |i: i32| f64::from(i) * core::f64::consts::PI / f64::from(steps);
    for apart in 0..=steps {
        let axis = Vec3::new(angle(apart).sin() as f32, 0.0, angle(apart).cos() as f32);
        for outer in 0..=steps {
            for inner in 0..=steps {
                let cone = |axis, i: i32| Cone {
                    axis,
                    cos_theta_o: angle(i).cos() as f32,
                };
                let found = cone(Vec3::Z, outer).contains(cone(axis, inner));
                // A sum of π or more reaches everything.
                let reach = (apart + inner).min(steps);
                assert_eq!(found, reach <= outer, "{apart} {outer} {inner}");
            }
        }
    }
    let cone = |cos_theta_o| Cone {
        axis: Vec3::Z,
        cos_theta_o,
    };
    let slack = 1.0 / 1_048_576.0;
    assert!(cone(0.5 + 0.9 * slack).contains(cone(0.5)));
    assert!(!cone(0.5 + 1.2 * slack).contains(cone(0.5)));
}

#[test]
fn differences_are_named_by_what_they_mean() {
    let one = node(&OUTER);
    assert_eq!(same(5, &one, &one), Ok(()));
    // The word that is always zero is no bound.
    for component in (0..12).filter(|&component| LightBounds::NAMES[component] != "zero") {
        let mut other = one;
        bytemuck::cast_slice_mut::<_, u32>(core::slice::from_mut(&mut other))[2 * component + 1] ^= 1;
        let expected = OUTER.to_words()[component];
        let found = f32::from_bits(expected.to_bits() ^ 1);
        let what = format!("{} after a refit", LightBounds::NAMES[component]);
        let violation = Violation::new(5, 1, what, format!("{expected:e}"), format!("{found:e}"));
        assert_eq!(same(5, &one, &other), Err(violation));
    }
    // That word, kind and link, in the first and in the second child.
    for (word, slot) in [(10, 0), (10, 1), (12, 0), (12, 1), (13, 0), (13, 1)] {
        let mut other = one;
        let words = bytemuck::cast_slice_mut::<_, u32>(core::slice::from_mut(&mut other));
        let before = words[2 * word + slot];
        words[2 * word + slot] ^= 0x8001_0100;
        let violation = Violation::new(
            5,
            INVALID,
            format!("word {}", 2 * word + slot),
            before,
            before ^ 0x8001_0100,
        );
        assert_eq!(same(5, &one, &other), Err(violation));
    }
    let record = [1u32, 0x0203_0405, 3];
    assert_eq!(same_words(1, 2, &record, &record), Ok(()));
    for word in 0..3 {
        let mut other = record;
        other[word] ^= 0xff00_0100;
        let violation = Violation::new(1, 2, format!("word {word}"), record[word], other[word]);
        assert_eq!(same_words(1, 2, &record, &other), Err(violation));
    }
}
