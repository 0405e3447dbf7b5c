//! Who is looked at closely.

use alloc::vec;

use crate::kit::triangle;
use crate::{LightBvh, Transform};

/// An instance that goes on moving is soon compared with what lies beside at all levels, though few are in one frame: those
/// that are not stay with the ones that they once were among, wherever they go.
#[test]
fn each_that_goes_on_moving_has_its_turn() {
    let mut scene = LightBvh::default();
    let mesh = scene
        .add_mesh(vec![triangle([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])])
        .expect("a mesh");
    for _ in 0..200 {
        scene.add_instance(mesh, Transform::IDENTITY).expect("one");
    }
    let mut turns = [0; 200];
    for step in 0..100_u8 {
        let before: u32 = turns.iter().sum();
        for (index, turns) in (0..).zip(&mut turns) {
            let x = f32::from(step) * 0.1 + index as f32;
            scene.placed[index as usize].transform = Transform::at([x, 1.0, 2.0]);
            *turns += u32::from(scene.has_its_turn(index));
        }
        let some = turns.iter().sum::<u32>() - before;
        assert!(some <= 100, "{some} in step {step}");
    }
    assert!(turns.iter().all(|&turns| turns > 0));
}
