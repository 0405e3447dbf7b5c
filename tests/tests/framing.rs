//! The camera of scenes that bring none.

use lightbvh_host::scene::{Material, Mesh, Node, Primitive, Scene, SceneData, Transform};

/// A box from `low` to `high`, its fronts outside.
fn solid(low: [f32; 3], high: [f32; 3], material: u32) -> Primitive {
    let at = |i: usize| [0, 1, 2].map(|axis| if i >> axis & 1 == 0 { low[axis] } else { high[axis] });
    let sides = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    Primitive {
        positions: (0..8).map(at).collect(),
        triangles: sides
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
            .collect(),
        material,
        ..Primitive::default()
    }
}

fn scene(primitives: Vec<Primitive>) -> Scene {
    let material = |radiance| Material {
        base_color: [0.5; 3],
        radiance,
        double_sided: true,
        ..Material::default()
    };
    Scene::new(SceneData {
        name: String::from("test"),
        nodes: vec![Node {
            transform: Transform::IDENTITY,
            mesh: Some(0),
            ..Node::default()
        }],
        meshes: vec![Mesh {
            name: String::new(),
            primitives,
        }],
        materials: vec![material([0.0; 3]), material([10.0; 3])],
        ..SceneData::default()
    })
    .expect("a sound scene")
}

fn inside(eye: [f32; 3], low: [f32; 3], high: [f32; 3]) -> bool {
    (0..3).all(|axis| low[axis] < eye[axis] && eye[axis] < high[axis])
}

#[test]
fn a_room_is_seen_from_inside() {
    let (low, high) = ([-4.0, 0.0, -3.0], [4.0, 3.0, 3.0]);
    let room = scene(vec![
        solid(low, high, 0),
        solid([-0.2, 2.5, -0.2], [0.2, 2.6, 0.2], 1),
    ]);
    let camera = room.frame(9).camera;
    assert!(inside(camera.eye, low, high), "{camera:?}");
    assert_eq!(camera, room.frame(0).camera);
    assert_eq!(camera, room.clone().frame(3).camera);
}

#[test]
fn what_is_dark_is_not_framed() {
    // A lamp over a small table, a kilometre of ground that is dark but for what is near, and a hill behind which all is dark.
    let ground = solid([-500.0, -1.0, -500.0], [500.0, 0.0, 500.0], 0);
    let table = solid([100.0, 0.0, 100.0], [102.0, 1.0, 102.0], 0);
    let lamp = solid([100.9, 2.0, 100.9], [101.1, 2.1, 101.1], 1);
    let camera = scene(vec![ground, table, lamp]).frame(0).camera;
    let away = [0, 1, 2].map(|i| camera.eye[i] - [101.0, 1.0, 101.0][i]);
    let distance = away.iter().map(|x| x * x).sum::<f32>().sqrt();
    assert!(distance < 400.0, "{camera:?}");
    let towards: f32 = (0..3).map(|i| -away[i] * camera.forward[i]).sum::<f32>() / distance;
    assert!(towards > 0.9, "the lamp is in the image: {camera:?}");
    assert!(camera.eye[1] > 0.0, "above ground: {camera:?}");
}

#[test]
fn a_lamp_behind_a_wall_is_seen_from_its_side() {
    // What is lit faces away from the first direction that is tried.
    let wall = solid([-3.0, -3.0, 0.0], [3.0, 3.0, 0.2], 0);
    let lamp = solid([-0.2, -0.2, -1.1], [0.2, 0.2, -1.0], 1);
    let camera = scene(vec![wall, lamp]).frame(0).camera;
    assert!(camera.eye[2] < 0.0, "{camera:?}");
}
