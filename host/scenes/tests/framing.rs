//! The camera of scenes that bring none.

use glam::Vec3;
use lightbvh_scenes::{Material, Mesh, Node, Primitive, Scene, SceneData, View};

/// A box from `low` to `high`, its fronts outside.
fn solid(low: [f32; 3], high: [f32; 3], material: u32) -> Primitive {
    let at = |i: usize| [0, 1, 2].map(|axis| if i >> axis & 1 == 0 { low[axis] } else { high[axis] });
    let sides = [
        0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5,
    ];
    let sides = sides.as_chunks::<4>().0.iter();
    Primitive {
        positions: (0..8).map(at).collect(),
        triangles: sides.flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect(),
        material,
        ..Primitive::default()
    }
}

/// A parallelogram, its front where its sides `a` and `b` go round it counter-clockwise.
fn sheet(p: [f32; 3], a: [f32; 3], b: [f32; 3], material: u32) -> Primitive {
    let plus = |p: [f32; 3], q: [f32; 3]| [0, 1, 2].map(|i| p[i] + q[i]);
    Primitive {
        positions: vec![p, plus(p, a), plus(plus(p, a), b), plus(p, b)],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        material,
        ..Primitive::default()
    }
}

/// Material 0 is grey, 1 glows.
fn scene(primitives: Vec<Primitive>) -> Scene {
    let material = |radiance| Material {
        base_color: [0.5; 3],
        radiance,
        ..Material::default()
    };
    Scene::new(SceneData {
        name: String::from("test"),
        nodes: vec![Node {
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

/// Where a point is in an image whose half height is one, right and up; none behind the eye.
fn place(view: &View, p: [f32; 3]) -> Option<[f32; 2]> {
    let d = Vec3::from(p) - Vec3::from(view.eye);
    let half = d.dot(view.forward.into()) * (0.5 * view.yfov).tan();
    (half > 0.0).then(|| [view.right, view.up].map(|axis| d.dot(axis.into()) / half))
}

/// All corners are in an image of 16:9, and fill at least a third of its width or height.
fn fill(view: &View, corners: &[[f32; 3]]) {
    let places = corners
        .iter()
        .map(|&corner| place(view, corner).expect("before the eye"));
    let places: Vec<_> = places.map(|[x, y]| [x * 9.0 / 16.0, y]).collect();
    let is_in = places.as_flattened().iter().all(|x| x.abs() < 1.0);
    let fills = [0, 1].map(|axis| {
        let along = || places.iter().map(|place| place[axis]);
        0.5 * (along().fold(-1.0, f32::max) - along().fold(1.0, f32::min))
    });
    assert!(is_in && fills[0].max(fills[1]) > 0.33, "{fills:?}: {view:?}");
    let is_upright = view.right[1].abs() < 1e-6 && view.up[1] > 0.0;
    assert!(is_upright, "{view:?}");
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
    // A lamp over a small table, a kilometre of ground that is dark but for what is near.
    let ground = solid([-500.0, -1.0, -500.0], [500.0, 0.0, 500.0], 0);
    let table = solid([100.0, 0.0, 100.0], [102.0, 1.0, 102.0], 0);
    let lamp = solid([100.9, 2.0, 100.9], [101.1, 2.1, 101.1], 1);
    let camera = scene(vec![ground, table, lamp]).frame(0).camera;
    let [eye, forward] = [camera.eye, camera.forward].map(Vec3::from);
    let towards = Vec3::new(101.0, 1.0, 101.0) - eye;
    assert!(towards.length() < 400.0, "{camera:?}");
    assert!(
        towards.normalize().dot(forward) > 0.9,
        "the lamp is in the image: {camera:?}"
    );
    assert!(eye.y > 0.0, "above ground: {camera:?}");
}

#[test]
fn a_lamp_behind_a_wall_is_seen_from_its_side() {
    // What is lit faces away from the first direction that is tried.
    let wall = solid([-3.0, -3.0, 0.0], [3.0, 3.0, 0.2], 0);
    let lamp = solid([-0.2, -0.2, -1.1], [0.2, 0.2, -1.0], 1);
    let camera = scene(vec![wall, lamp]).frame(0).camera;
    assert!(camera.eye[2] < 0.0, "{camera:?}");
}

#[test]
fn sign_is_seen_whole_from_its_front() {
    for (a, front) in [
        ([4.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
        ([-4.0, 0.0, 0.0], [0.0, 0.0, -1.0]),
        ([0.0, 0.0, -4.0], [1.0, 0.0, 0.0]),
        ([0.0, 0.0, 4.0], [-1.0, 0.0, 0.0]),
    ] {
        for material in [1, 0] {
            let sign = sheet([1.0, 2.0, 3.0], a, [0.0, 1.0, 0.0], material);
            let corners = sign.positions.clone();
            let view = scene(vec![sign]).frame(0).camera;
            let towards = -Vec3::from(view.forward).dot(front.into());
            assert!(towards > 0.5, "{towards} of {front:?}: {view:?}");
            fill(&view, &corners);
        }
    }
}

#[test]
fn boxes_of_any_size_are_seen_from_outside() {
    for size in [0.01_f32, 2.0, 4000.0] {
        let (low, high) = ([size, -2.0 * size, 7.0 * size], [2.0 * size, -size, 8.0 * size]);
        for material in [1, 0] {
            let one = solid(low, high, material);
            let corners = one.positions.clone();
            let view = scene(vec![one]).frame(0).camera;
            assert!(!inside(view.eye, low, high), "{view:?}");
            fill(&view, &corners);
        }
    }
}

/// The inside of a bulb is the brightest place.
#[test]
fn camera_does_not_stand_in_a_glowing_bulb() {
    let floor = sheet([-5.0, 0.0, 5.0], [10.0, 0.0, 0.0], [0.0, 0.0, -10.0], 0);
    for size in [0.02, 0.1, 0.3] {
        let (low, high) = ([-size, 2.0 - size, -size], [size, 2.0 + size, size]);
        let mut inner = solid(
            low.map(|x| 0.98 * x),
            [0.98 * size, 0.98 * (2.0 + size), 0.98 * size],
            1,
        );
        inner.triangles.iter_mut().for_each(|own| own.swap(0, 1));
        let primitives = vec![solid(low, high, 1), inner, floor.clone()];
        let view = scene(primitives).frame(0).camera;
        let is_out = !inside(view.eye, low, high) && view.eye[1] > 0.0;
        assert!(is_out, "{size}: {view:?}");
    }
}

#[test]
fn nothing_to_see_is_no_error() {
    let view = scene(vec![sheet([5.0; 3], [0.0; 3], [0.0; 3], 0)])
        .frame(0)
        .camera;
    let all = [view.eye, view.right, view.up, view.forward];
    assert!(all.iter().flatten().all(|x| x.is_finite()), "{view:?}");
}
