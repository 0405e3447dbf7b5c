//! What is as it was without beams or with masks.

use super::*;
use lightbvh::exact::hash;
use lightbvh::importance::{Leveled, Linked, LinkedPoint};
use lightbvh::light::{AnyLight, LinkedAny};
use lightbvh::node::{LinkedSpotMomentNode, Lit};
use lightbvh::{BuildParams, Bvh, Lights, Moments};

/// Without spots, all bits are those of the layout without beams.
#[test]
fn other_lights_are_what_they_were() {
    let random = &mut Random(5);
    let own: Vec<AnyLight> = (0..300).map(|_| other(random)).collect();
    let lights = Lights::new(own).expect("in the domain");
    let with = Tree::<AnyLight>::single_level(&lights, &BuildParams::default());
    let without = Plain::<AnyLight>::single_level(&lights, &BuildParams::default());
    for k in 0..4000_u32 {
        let p = random.vector(8.0);
        let point = random.point(p);
        assert_eq!(with.sample(&point, hash(k)), without.sample(&point, hash(k)));
    }
}

/// Masks and beams together: a light has a probability just where it has a bit in common.
#[test]
fn masks_stand_beside_beams() {
    type Both = Bvh<Lit<LinkedSpotMomentNode<8>, LinkedAny>, Linked<Leveled<Moments, 9>>, 8>;
    let random = &mut Random(25);
    let own: Vec<LinkedAny> = any(spots(random, 200, 4.0))
        .into_iter()
        .map(|light| LinkedAny {
            light,
            mask: 1 << random.below(8),
        })
        .collect();
    let bvh = Both::single_level(
        &Lights::new(own.clone()).expect("in the domain"),
        &BuildParams::default(),
    );
    for _ in 0..200 {
        let p = random.vector(8.0);
        let receiver = LinkedPoint {
            point: random.point(p),
            mask: random.below(256),
        };
        let mut sum = 0.0;
        for (k, own) in own.iter().enumerate() {
            let pmf = bvh.tree().pmf(&receiver, k as u32, u32::MAX);
            assert_eq!(pmf > 0.0, own.mask & receiver.mask != 0);
            sum += f64::from(pmf);
        }
        let expected = f64::from(u8::from(receiver.mask != 0));
        assert!((sum - expected).abs() < 1.0e-5, "{sum} for {:#x}", receiver.mask);
    }
}
