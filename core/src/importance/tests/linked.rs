//! Weights of which masks and least shares leave some.

use super::Random;
use crate::beam::{Beam, Limits};
use crate::choose::{FULL, choose};
use crate::importance::{ImportanceModel, Leveled, Linked};
use crate::node::{LinkedMomentNode, Node, kind};
use crate::point::{LinkedPoint, ShadingPoint};
use crate::{LightMoments, exact};

/// The least and the greatest that an importance may give.
struct Extremes;

const WEIGHTS: [f32; 4] = [exact::pow2(120), exact::pow2(-120), f32::MIN_POSITIVE, 0.0];

impl<N> ImportanceModel<N, 4> for Extremes {
    fn weights_in(_: &N, _: &ShadingPoint, _: f32) -> [f32; 4] {
        WEIGHTS
    }
}

fn node(masks: [u32; 4], phi: [f32; 4]) -> LinkedMomentNode<4> {
    let mut node = LinkedMomentNode::<4>::EMPTY;
    for slot in 0..4 {
        node.set_child(slot, kind::LIGHT, slot as u32);
    }
    node.set_summaries(&phi.map(|phi| LightMoments {
        phi,
        ..LightMoments::EMPTY
    }));
    node.set_limits(&masks.map(|mask| Limits {
        mask,
        beam: Beam::ANYWHERE,
    }));
    node
}

fn receiver(mask: u32) -> LinkedPoint<ShadingPoint> {
    LinkedPoint {
        point: ShadingPoint {
            p: [0.0; 3],
            n: [0.0; 3],
        },
        mask,
    }
}

/// However far below the others those are that are left, all numbers are shared out among them.
#[test]
fn what_is_left_gets_all_numbers() {
    let node = node([1, 2, 4, 8], [1.0; 4]);
    for mask in 0..16 {
        let weights = Linked::<Extremes>::weights(&node, &receiver(mask));
        let mut sum = 0;
        for slot in 0..4 {
            let is_left = mask >> slot & 1 == 1 && WEIGHTS[slot] > 0.0;
            assert_eq!(weights[slot] > 0.0, is_left, "{mask} {slot}");
            let share = choose(&weights, FULL, 0, true, slot as u32);
            assert_eq!(share.count > 0, is_left, "{mask} {slot}");
            sum += share.count;
            if is_left {
                let found = choose(&weights, FULL, share.first, false, 0);
                assert_eq!((found.slot, found.count), (slot as u32, share.count));
            }
        }
        let any = mask & 7 != 0;
        assert_eq!(sum, if any { FULL } else { 0 }, "{mask}");
    }
}

#[test]
fn children_without_flux_are_in_no_union() {
    let random = &mut Random(3);
    for _ in 0..200 {
        let masks = [0; 4].map(|_| 1 << random.below(32));
        let phi = [0; 4].map(|_| random.below(2) as f32);
        let node = node(masks, phi);
        let mut all = 0;
        for slot in 0..4 {
            let own = if phi[slot] > 0.0 { masks[slot] } else { 0 };
            assert_eq!(node.mask(slot), own);
            all |= own;
        }
        assert_eq!(node.merged_mask(), all);
        // A child set anew has none.
        let mut node = node;
        node.set_child(1, kind::INNER, 9);
        assert_eq!(node.mask(1), 0);
    }
}

/// Weights of 2^0 to 2^-40 and none.
struct Steps;

impl<N> ImportanceModel<N, 8> for Steps {
    fn weights_in(_: &N, _: &ShadingPoint, _: f32) -> [f32; 8] {
        [1.0, 0.0, 2e-3, 1e-3, 1e-4, 1e-12, 0.5, 0.0]
    }
}

#[test]
fn a_least_share_is_kept_of_what_has_weight() {
    let own = Steps::weights(&(), &receiver(0).point);
    let found = Leveled::<Steps, 9>::weights(&(), &receiver(0).point);
    let sum: f32 = own.iter().sum();
    for slot in 0..8 {
        let expected = if own[slot] > 0.0 {
            f64::from(own[slot]).max(f64::from(sum) / 512.0)
        } else {
            0.0
        };
        assert!(
            (f64::from(found[slot]) - expected).abs() < 1e-6 * expected + 1e-30,
            "{slot}"
        );
    }
}
