//! Weights at both ends of the range, under masks and times reflectance.

use crate::beam::Limits;
use crate::choose::{FULL, choose};
use crate::importance::{Glossy, ImportanceModel, Linked, Space};
use crate::node::{LinkedSpotMomentNode, Node};
use crate::point::{GlossyPoint, LinkedPoint, ShadingPoint};
use crate::summary::Lanes;
use crate::{LightMoments, exact};

/// The least and the greatest that an importance may give.
struct Extremes;

const WEIGHTS: [f32; 4] = [exact::pow2(120), exact::pow2(-120), f32::MIN_POSITIVE, 0.0];

impl<N> ImportanceModel<N, 4> for Extremes {
    fn weights_in(_: &N, _: &ShadingPoint, _: Space) -> [f32; 4] {
        WEIGHTS
    }
}

fn node(masks: [u32; 4]) -> LinkedSpotMomentNode<4> {
    let light = LightMoments {
        phi: 1.0,
        across: 0.5,
        ..LightMoments::EMPTY
    };
    let mut node: LinkedSpotMomentNode<4> = crate::kit::node(&[light; 4]);
    let limits = masks.map(|mask| Limits { mask, ..Limits::NONE });
    node.set_limits(&limits, &Lanes::all(&light));
    node
}

const POINT: ShadingPoint = ShadingPoint {
    p: [0.0; 3],
    n: [0.0, 1.0, 0.0],
};

/// However small their weights are next to the masked ones.
#[test]
fn allowed_children_share_all_numbers() {
    let node = node([1, 2, 4, 8]);
    for mask in 0..16 {
        let weights = Linked::<Extremes>::weights(&node, &LinkedPoint { point: POINT, mask });
        let mut sum = 0;
        for slot in 0..4 {
            let is_left = mask >> slot & 1 == 1 && WEIGHTS[slot] > 0.0;
            assert_eq!(weights[slot] > 0.0, is_left, "{mask} {slot}");
            let share = choose::<4>(|k| weights[k], FULL, 0, true, slot as u32);
            assert_eq!(share.count > 0, is_left, "{mask} {slot}");
            sum += share.count;
            if is_left {
                let found = choose::<4>(|k| weights[k], FULL, share.first, false, 0);
                assert_eq!((found.slot, found.count), (slot as u32, share.count));
            }
        }
        let any = mask & 7 != 0;
        assert_eq!(sum, if any { FULL } else { 0 }, "{mask}");
    }
}

#[test]
fn glossy_weights_stay_in_their_range() {
    let range = exact::pow2(-120)..=exact::pow2(120);
    for (away, exponent, specular) in [(9.0, 1.0, 0.0), (0.0, 65_536.0, 1.0), (9.0, 65_536.0, 1.0)] {
        for up in [0.0, 1.0, -1.0] {
            let receiver = GlossyPoint {
                point: ShadingPoint {
                    p: [away; 3],
                    ..POINT
                },
                mirror: [0.0, up, 0.0],
                diffuse: 0.0,
                specular,
                exponent,
            };
            let [most, least, tiny, none] = Glossy::<Extremes>::weights(&node([0; 4]), &receiver);
            let are_in = [most, least, tiny].iter().all(|w| range.contains(w));
            assert!(are_in && none == 0.0, "{most} {least} {tiny} {none}");
        }
    }
}
