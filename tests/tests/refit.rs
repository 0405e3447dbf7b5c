//! Validation: no wrong word unnoticed.

use lightbvh::bvh::Cursor;
use lightbvh::{BuildParams, Instance, LightNode, Lights, bvh};
use lightbvh_tests::each_node;
use lightbvh_tests::generate;
use lightbvh_tests::oracle::built;

/// Every word in use of every array of a small BVH, each of its bits turned, and all of them: not one goes unnoticed. (None is
/// harmless: links, kinds and trails are held against the one walk that reaches everything once, all other words against what
/// refit writes.)
fn no_wrong_word_goes_unnoticed<N: LightNode<W>, const W: usize>(two: bool, seed: u32) {
    let triangles = generate::small_triangles(11, 4, 10.0, 1.0, true, seed);
    let lights = Lights::new(triangles).expect("lights");
    let bvh = built::<N, W>(&lights, &BuildParams::default(), two);
    bvh.view().validate().expect("valid as built");
    type Part<N> = fn(bvh::Parts<'_, N>) -> &mut [u32];
    let arrays: [(&str, Part<N>); 6] = [
        ("instances", |p| {
            bytemuck::cast_slice_mut::<Instance, u32>(p.instances)
        }),
        ("trails", |p| p.trails),
        ("nodes", |p| bytemuck::cast_slice_mut(p.nodes)),
        ("top level", |p| bytemuck::cast_slice_mut(p.top)),
        ("places of nodes", |p| p.above),
        ("places of instances", |p| p.places),
    ];
    let used = Cursor::default().plan(&bvh);
    let words = size_of::<N>() / 4;
    for (name, array) in arrays.into_iter().take(if two { 6 } else { 3 }) {
        let mut wrong = bvh.clone();
        for i in 0..array(wrong.parts_mut()).len() {
            if name == "nodes" && !used.bottom.nodes().contains(&((i / words) as u32)) {
                continue;
            }
            for mask in (0..32).map(|b| 1_u32 << b).chain([u32::MAX]) {
                array(wrong.parts_mut())[i] ^= mask;
                assert!(
                    wrong.view().validate().is_err(),
                    "{} {W}, two levels {two}: word {i} of the {name} with bits {mask:#x} turned",
                    N::NAME
                );
                array(wrong.parts_mut())[i] ^= mask;
            }
        }
        wrong.view().validate().expect("all put back");
    }
}

#[test]
fn every_bit_counts() {
    each_node!(no_wrong_word_goes_unnoticed(false, 1));
    each_node!(no_wrong_word_goes_unnoticed(true, 2));
}
