//! Least shares, and what masks that allow all leave as it was.

use super::*;
use lightbvh::importance::{Leveled, Linked};
use lightbvh::light::LinkedTriangle;
use lightbvh::node::{LinkedMomentNode, Lit, Node, PackedMomentNode};
use lightbvh::{BuildParams, Bvh, Lights, MomentNode, Moments, TwoSidedMomentNode};

/// With every bit in common, light and probability are those of the importance, to the bit; and other importances do not see masks.
#[test]
fn masks_that_allow_all_change_nothing() {
    let random = &mut Random(9);
    let own = lights(700, random, triangle);
    let plain = Lights::new(own.iter().map(|own| own.light).collect()).expect("in the domain");
    let masked = Lights::new(
        own.iter()
            .map(|own| LinkedTriangle::from(own.light))
            .collect::<Vec<_>>(),
    );
    let plain: Bvh<MomentNode<8>, Moments, 8> = Bvh::single_level(&plain, &BuildParams::default());
    let masked =
        Tree::<LinkedTriangle>::single_level(&masked.expect("in the domain"), &BuildParams::default());
    // The words of a node but for the last row are those without masks.
    let row = size_of::<[u32; 8]>();
    assert_eq!(plain.nodes().len(), masked.nodes().len());
    for (a, b) in plain.nodes().iter().zip(masked.nodes()) {
        assert_eq!(
            bytemuck::bytes_of(a),
            &bytemuck::bytes_of(b)[..size_of_val(b) - row]
        );
    }
    for k in 0..3000 {
        let mut receiver = random.receiver(6.0);
        receiver.mask |= 1 << (k % 32);
        let number = random.word();
        let sampled = plain.sample(&receiver.point, number);
        assert_eq!(sampled, masked.sample(&receiver, number));
        assert_eq!(sampled, masked.by::<Moments>().sample(&receiver.point, number));
        assert_eq!(
            plain.pmf(&receiver.point, k % 700, 0).to_bits(),
            masked.tree().pmf(&receiver, k % 700, 0).to_bits()
        );
    }
}

/// A least share of each child is a least probability of each light, of those that are allowed.
#[test]
fn least_shares_bound_probabilities() {
    const LEAST: f64 = 1.0 / 512.0;
    let random = &mut Random(12);
    let all = Lights::new(lights(600, random, triangle)).expect("in the domain");
    let bvh = Tree::<LinkedTriangle>::single_level(&all, &BuildParams::default());
    // What is raised adds to the sum; shares are whole numbers of 2^21 at least.
    let of_node = LEAST / (1.0 + 8.0 * LEAST) - 2f64.powi(-20);
    let bound = of_node.powi(bvh.depth() as i32);
    let mut below = 0;
    for _ in 0..40 {
        let receiver = random.receiver(6.0);
        for light in 0..600 {
            let plain = bvh.tree().pmf(&receiver, light, 0);
            let tree = bvh.by::<Linked<Leveled<Moments, 9>>>();
            let pmf = f64::from(tree.pmf(&receiver, light, 0));
            assert_eq!(plain > 0.0, pmf > 0.0);
            assert!(pmf == 0.0 || pmf >= bound, "{pmf} of {bound}");
            below += u32::from(plain > 0.0 && f64::from(plain) < bound);
        }
    }
    assert!(below > 0, "nothing is tested");
}

/// What is not used costs nothing.
#[test]
fn nodes_without_masks_are_what_they_were() {
    const _: () = assert!(size_of::<MomentNode<8>>() == 8 * 24);
    const _: () = assert!(size_of::<TwoSidedMomentNode<8>>() == 8 * 20);
    const _: () = assert!(size_of::<LinkedMomentNode<8>>() == 8 * 28);
    const _: () = assert!(size_of::<Lit<LinkedMomentNode<8>, LinkedTriangle>>() == 8 * 28);
    fn has_masks<const ROWS: usize>() -> bool {
        <PackedMomentNode<8, ROWS> as Node<8>>::HAS_MASKS
    }
    assert_eq!(
        [has_masks::<5>(), has_masks::<6>(), has_masks::<7>()],
        [false, false, true]
    );
    assert_eq!(MomentNode::<8>::EMPTY.mask(3), u32::MAX);
    assert_eq!(LinkedMomentNode::<8>::EMPTY.merged_mask(), 0);
}
