//! What is motion, and what is not.

use super::*;
use crate::kit::triangle;

/// Where a quarter of the lamps sways in every frame nothing is at rest, and nothing that it may gain is tried before.
#[test]
fn what_goes_on_moving_is_not_at_rest() {
    let (mut scene, ids, places) = lamps(&mut Random(1), |_| 1.0);
    let mut rebuilder = deterministic();
    for k in 0..3 * REST {
        let some = ids.iter().zip(&places).step_by(4);
        let edits = some.map(|(&instance, at)| Edit::SetTransform {
            instance,
            transform: Transform::at([at[0] + 0.01 * (k % 2) as f32, at[1], at[2]]),
        });
        frame(&mut scene, &mut rebuilder, edits.collect());
        assert!(!rebuilder.is_busy(), "frame {k}");
    }
    let mut is_tried = false;
    for _ in 0..2 * REST {
        frame(&mut scene, &mut rebuilder, Vec::new());
        is_tried |= rebuilder.is_busy();
    }
    assert!(is_tried, "once it rests it is");
}

/// That a mesh gets another tree is no change of its instances: the top level is not tried for it.
#[test]
fn another_tree_of_a_mesh_is_no_change() {
    let mut scene = LightBvh::default();
    let random = &mut Random(6);
    let lamp = |random: &mut Random| {
        let [x, y, z] = random.vector().to_array();
        triangle([[x, y, z], [x + 0.01, y, z], [x, y, z + 0.02]])
    };
    let mesh = scene
        .add_mesh((0..200).map(|_| lamp(random)).collect())
        .expect("a mesh");
    let add = (0..300).map(|_| Edit::AddInstance {
        mesh,
        transform: Transform::at((random.vector() * 100.0).to_array()),
        radiance: 1.0,
    });
    scene.apply(add.collect()).expect("instances");
    scene.refit();
    let others = (0..200).map(|_| lamp(random)).collect();
    scene.set_triangles(mesh, others).expect("as many");
    scene.refit();
    let root = scene.top.number(scene.top.root) as usize;
    assert_eq!(scene.top.changes[root], 300, "that they are others is one");
    scene.top.changes.fill(0);
    let params = RebuildParams {
        top: f64::INFINITY,
        ..RebuildParams::default()
    };
    let built = scene.rebuild(&params).run();
    let epoch = scene.epoch;
    scene.install(built).expect("its own");
    scene.refit();
    assert!(scene.of_mesh(0).created > epoch, "it came in");
    assert_eq!(scene.top.changes[root], 0);
}
