use crate::bvh::top::search::tests::{above_and_part, lamps};
use crate::bvh::{RebuildParams, opened};
use crate::kit::Random;
use crate::node::Node;
use crate::summary::Summary;

/// What is kept below a cut costs no more than what is opened, but for the rounding of what nodes say of their children.
#[test]
fn the_costliest_subtrees_are_opened() {
    let (scene, ..) = lamps(&mut Random(2), |k| if k % 9 == 0 { 50.0 } else { 1.0 });
    let cut = scene.cut(scene.top.root, 300);
    let cost = |node: &u32| opened::cost(&scene.nodes[*node as usize].merged());
    let least = cut.inner[1..].iter().map(cost).fold(f64::INFINITY, f64::min);
    let most = cut.kept.iter().map(cost).fold(0.0, f64::max);
    assert!(
        cut.kept.len() > 100 && most <= 1.25 * least,
        "{most} kept, {least} opened"
    );
    let leaves = cut.names.len() + cut.kept.len();
    assert!((300 - 7..=300).contains(&leaves), "{leaves}");
    let own = |node: &u32| {
        f64::from(scene.quality(*node).apart()) * f64::from(scene.nodes[*node as usize].merged().phi())
    };
    let expected: f64 = cut.inner[1..].iter().map(own).sum();
    assert!((cut.cost / expected - 1.0).abs() < 1e-9);
}

/// A part is not found any more once another node has its number.
#[test]
fn a_part_that_was_replaced_is_not_found() {
    let (mut scene, ..) = lamps(&mut Random(3), |_| 1.0);
    let [_, node] = above_and_part(&scene);
    let part = scene.part(node);
    assert_eq!(scene.node_of(part), Some(node));
    let built = scene.rebuild(&RebuildParams::eager()).run();
    scene.install(built).expect("its own");
    assert!(scene.top.nodes[part.number as usize] != crate::tree::INVALID);
    assert_eq!(scene.node_of(part), None);
}
