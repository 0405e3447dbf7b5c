//! Scenes made by code, and what a viewer wants to see of each.

use std::sync::Arc;

use lightbvh::light::infinite::Environment;

use super::super::analytic::{AnalyticKind, AnalyticLight};
use super::super::model::{Material, Mesh, Node, Primitive, Scene, SceneData};
use super::super::transform::Transform;
use super::*;

mod bulbs;
mod delta;

/// Materials of the scenes.
const GREY: u32 = 0;
const GREY_TWO_SIDED: u32 = 1;
const LAMP: u32 = 2;
const LAMP_TWO_SIDED: u32 = 3;

/// A box from `low` to `high`, its fronts outside, or inside.
fn solid(low: [f32; 3], high: [f32; 3], material: u32, is_room: bool) -> Primitive {
    let at = |i: usize| [0, 1, 2].map(|axis| if i >> axis & 1 == 0 { low[axis] } else { high[axis] });
    let sides = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let triangles = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    Primitive {
        positions: (0..8).map(at).collect(),
        triangles: triangles
            .map(|[a, b, c]| if is_room { [a, c, b] } else { [a, b, c] })
            .collect(),
        material,
        ..Primitive::default()
    }
}

fn cube(low: [f32; 3], high: [f32; 3], material: u32) -> Primitive {
    solid(low, high, material, false)
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

/// A sphere by longitude and latitude.
fn globe(centre: [f32; 3], radius: f32, material: u32) -> Primitive {
    const RINGS: u32 = 12;
    let at = |ring: u32, k: u32| {
        let (down, round) = (
            std::f32::consts::PI * ring as f32 / RINGS as f32,
            std::f32::consts::PI * k as f32 / RINGS as f32,
        );
        let v = [down.sin() * round.sin(), down.cos(), down.sin() * round.cos()];
        [0, 1, 2].map(|i| centre[i] + radius * v[i])
    };
    let around = 2 * RINGS;
    let index = |ring: u32, k: u32| ring * around + k % around;
    let quads = (0..RINGS).flat_map(|ring| (0..around).map(move |k| (ring, k)));
    Primitive {
        positions: (0..=RINGS)
            .flat_map(|ring| (0..around).map(move |k| at(ring, k)))
            .collect(),
        triangles: quads
            .flat_map(|(ring, k)| {
                let [a, b, c, d] = [(ring, k), (ring + 1, k), (ring + 1, k + 1), (ring, k + 1)]
                    .map(|(ring, k)| index(ring, k));
                [[a, b, c], [a, c, d]]
            })
            .collect(),
        material,
        ..Primitive::default()
    }
}

fn scene(primitives: Vec<Primitive>, is_under_sky: bool) -> Scene {
    scene_with(primitives, &[], is_under_sky)
}

/// With points, each where it stands.
fn scene_with(primitives: Vec<Primitive>, lamps: &[[f32; 3]], is_under_sky: bool) -> Scene {
    let material = |radiance, double_sided| Material {
        base_color: [0.5; 3],
        radiance,
        double_sided,
        ..Material::default()
    };
    let point = |node| AnalyticLight {
        name: String::from("point"),
        node,
        kind: AnalyticKind::Point,
        color: [1.0; 3],
        intensity: 100.0,
        range: None,
    };
    let sky =
        || Environment::from_fn(4, |[_, y, _]| if y > 0.0 { [1.0; 3] } else { [0.1; 3] }).expect("a sky");
    Scene::new(SceneData {
        name: String::from("test"),
        nodes: std::iter::once(Node {
            mesh: Some(0),
            ..Node::default()
        })
        .chain(lamps.iter().map(|&p| Node {
            transform: Transform::at(p),
            ..Node::default()
        }))
        .collect(),
        analytic: (1..=lamps.len() as u32).map(point).collect(),
        meshes: vec![Mesh {
            name: String::new(),
            primitives,
        }],
        materials: vec![
            material([0.0; 3], false),
            material([0.0; 3], true),
            material([10.0; 3], false),
            material([10.0; 3], true),
        ],
        environment: is_under_sky.then(|| Arc::new(sky())),
        ..SceneData::default()
    })
    .expect("a sound scene")
}

/// Where a point is in the image, right and up, of an image whose half height is one; none behind the eye.
fn place(view: &View, p: [f32; 3]) -> Option<[f64; 2]> {
    let d = [0, 1, 2].map(|i| f64::from(p[i]) - f64::from(view.eye[i]));
    let part = |axis: [f32; 3]| d.iter().zip(axis).map(|(x, y)| x * f64::from(y)).sum::<f64>();
    let half = part(view.forward) * (0.5 * f64::from(view.yfov)).tan();
    (half > 0.0).then(|| [part(view.right) / half, part(view.up) / half])
}

/// How much of an image of 16 by 9 its corners reach across: columns and rows, from 0 to 1. All are in the image.
fn filled(view: &View, corners: &[[f32; 3]]) -> [f64; 2] {
    let (mut low, mut high) = ([f64::MAX; 2], [f64::MIN; 2]);
    for &corner in corners {
        let [x, y] = place(view, corner).expect("before the eye");
        assert!(
            x.abs() < 16.0 / 9.0 && y.abs() < 1.0,
            "cut at {corner:?}: {x}, {y}"
        );
        for (i, v) in [x, y].into_iter().enumerate() {
            (low[i], high[i]) = (low[i].min(v), high[i].max(v));
        }
    }
    [(high[0] - low[0]) / (32.0 / 9.0), (high[1] - low[1]) / 2.0]
}

/// The larger one is within 60 to 90 %.
fn fills(view: &View, corners: &[[f32; 3]]) {
    let [x, y] = filled(view, corners);
    assert!((0.6..=0.9).contains(&x.max(y)), "{x} by {y}: {view:?}");
}

fn is_within(view: &View, low: [f32; 3], high: [f32; 3]) -> bool {
    (0..3).all(|axis| low[axis] < view.eye[axis] && view.eye[axis] < high[axis])
}

fn is_upright(view: &View) {
    assert!(view.right[1].abs() < 1e-6 && view.up[1] > 0.0, "{view:?}");
}

#[test]
fn a_closed_room_is_seen_from_inside_with_its_furniture() {
    let (low, high) = ([-4.0, 0.0, -3.0], [4.0, 3.0, 3.0]);
    let lamp = cube([-0.2, 2.8, -0.2], [0.2, 2.9, 0.2], LAMP);
    let table = cube([0.5, 0.0, -0.5], [2.0, 0.8, 0.5], GREY);
    let shelf = cube([-3.9, 0.0, -2.0], [-3.4, 2.0, 2.0], GREY);
    for is_under_sky in [false, true] {
        let room = vec![
            solid(low, high, GREY, true),
            lamp.clone(),
            table.clone(),
            shelf.clone(),
        ];
        let view = scene(room, is_under_sky).frame(0).camera;
        assert!(is_within(&view, low, high), "{view:?}");
        assert!(!is_within(&view, [0.5, 0.0, -0.5], [2.0, 0.8, 0.5]), "{view:?}");
        assert!(!is_within(&view, [-3.9, 0.0, -2.0], [-3.4, 2.0, 2.0]), "{view:?}");
        let [x, y] = place(&view, [1.25, 0.8, 0.0]).expect("the table is before the eye");
        assert!(x.abs() < 16.0 / 9.0 && y.abs() < 1.0, "{view:?}");
        is_upright(&view);
    }
}

#[test]
fn a_crate_is_seen_from_outside() {
    // A lamp stands through the wall of the crate, most of it within, where most of its light stays.
    let (low, high) = ([-0.6, 0.0, -0.6], [0.6, 1.5, 0.6]);
    for (wide, from) in [(0.1, 0.3), (0.1, 0.4), (0.2, 0.3), (0.2, 0.4), (0.3, 0.3)] {
        for is_under_sky in [false, true] {
            let lamp = cube([-wide, 0.9, from], [wide, 0.9 + wide, 0.64], LAMP_TWO_SIDED);
            let parts = vec![cube(low, high, GREY_TWO_SIDED), lamp];
            let view = scene(parts, is_under_sky).frame(0).camera;
            assert!(!is_within(&view, low, high), "{view:?}");
            if is_under_sky {
                let corners: Vec<_> = cube(low, high, GREY).positions;
                fills(&view, &corners);
            }
            is_upright(&view);
        }
    }
}

/// The camera of one stood in the plane of its top, from where the dark inside filled half of the image.
#[test]
fn a_closed_cube_of_backs_is_seen_from_where_it_is_lit() {
    for at in [[0.0; 3], [5.0, 3.0, -8.0]] {
        let (low, high) = (at.map(|x| x - 1.0), at.map(|x| x + 1.0));
        let walls = solid(low, high, GREY, true);
        let corners = walls.positions.clone();
        let view = scene(vec![walls], true).frame(0).camera;
        assert!(!is_within(&view, low, high), "{view:?}");
        fills(&view, &corners);
        is_upright(&view);
    }
}

#[test]
fn a_sign_is_seen_from_its_front_and_whole() {
    // Towards each side of the horizon; the first choice is +Z.
    for (a, front) in [
        ([4.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
        ([-4.0, 0.0, 0.0], [0.0, 0.0, -1.0]),
        ([0.0, 0.0, -4.0], [1.0, 0.0, 0.0]),
        ([0.0, 0.0, 4.0], [-1.0, 0.0, 0.0]),
    ] {
        for (material, is_under_sky) in [(LAMP, false), (GREY, true)] {
            let sign = sheet([1.0, 2.0, 3.0], a, [0.0, 1.0, 0.0], material);
            let corners = sign.positions.clone();
            // A lamp has a board behind it, whose front looks the other way.
            let behind = [0, 1, 2].map(|i| [1.0, 2.0, 3.0][i] - 0.2 * front[i]);
            let board = (material == LAMP).then(|| sheet(behind, [0.0, 1.0, 0.0], a, GREY));
            let view = scene(std::iter::once(sign).chain(board).collect(), is_under_sky)
                .frame(0)
                .camera;
            let towards: f32 = (0..3).map(|i| -view.forward[i] * front[i]).sum();
            assert!(towards > 0.5, "{towards} of {front:?}: {view:?}");
            fills(&view, &corners);
            is_upright(&view);
        }
    }
}

#[test]
fn of_a_plain_with_a_city_the_city_is_framed() {
    let plain = sheet(
        [-1000.0, 0.0, 1000.0],
        [2000.0, 0.0, 0.0],
        [0.0, 0.0, -2000.0],
        GREY,
    );
    let house = |k: usize| {
        let (x, z) = (12.0 * (k / 8) as f32 - 150.0, 12.0 * (k % 8) as f32 - 50.0);
        cube([x, 0.0, z], [x + 8.0, 4.0 + (k % 5) as f32 * 2.0, z + 8.0], GREY)
    };
    let view = scene(std::iter::once(plain).chain((0..200).map(house)).collect(), true)
        .frame(0)
        .camera;
    // All but the outermost houses.
    let corners: Vec<_> = (8..192).flat_map(|k| house(k).positions).collect();
    let [x, y] = filled(&view, &corners);
    assert!(x.max(y) > 0.35, "{x} by {y}: {view:?}");
    assert!(view.eye[1] > 4.0, "above the streets: {view:?}");
    is_upright(&view);
}

#[test]
fn a_single_glowing_sphere_fills_the_image() {
    for radius in [0.01, 3.0, 4000.0] {
        let globe = globe([radius, -2.0 * radius, 7.0 * radius], radius, LAMP);
        let corners = globe.positions.clone();
        fills(&scene(vec![globe], false).frame(0).camera, &corners);
    }
}

#[test]
fn an_open_box_is_seen_through_its_open_side() {
    // Of each of four open sides, walls of two triangles whose fronts look in.
    for turn in 0..4 {
        let [low, high] = [[-1.0, 0.0, -1.0], [1.0, 2.0, 1.0]];
        let mut walls = solid(low, high, GREY, true);
        // Sides 0 and 1 are −Z and +Z, 4 and 5 −X and +X.
        let (side, front) = [
            (1, [0.0, 0.0, 1.0]),
            (0, [0.0, 0.0, -1.0]),
            (5, [1.0, 0.0, 0.0]),
            (4, [-1.0, 0.0, 0.0]),
        ][turn];
        walls.triangles.drain(2 * side..2 * side + 2);
        let view = scene(vec![walls, cube([-0.4, 0.0, -0.4], [0.2, 0.8, 0.2], GREY)], true)
            .frame(0)
            .camera;
        let towards: f32 = (0..3).map(|i: usize| -view.forward[i] * front[i]).sum();
        assert!(towards > 0.7, "{towards} of {front:?}: {view:?}");
        fills(&view, &cube(low, high, GREY).positions);
    }
}

#[test]
fn the_work_is_bounded_and_the_same() {
    let boxes = |count: usize| {
        let at = |k: usize| [k % 20, k / 20 % 20, k / 400].map(|x| 2.0 * x as f32);
        let lamp = |k: usize| if k.is_multiple_of(7) { LAMP } else { GREY };
        let all = (0..count).map(|k| cube(at(k), at(k).map(|x| x + 1.0), lamp(k)));
        scene(all.collect(), true)
    };
    let (small, large) = (boxes(3), boxes(2000));
    for scene in [&small, &large] {
        let frame = scene.frame(0);
        let room = Room::new(&frame.triangles, &scene.data().materials).expect("rays");
        let points = points::points(&frame, &room, 100.0);
        let corners = points::corners(&frame);
        assert!(corners.len() <= 3 * 1024 + 6, "{}", corners.len());
        assert!(points.len() <= 1024, "{}", points.len());
        let sum: f64 = points.iter().map(|point| point.weight).sum();
        assert!((sum - 1.0).abs() < 1e-9, "{sum}");
        let places = places::around(&points, &corners, 100.0).len()
            + places::nearer(&points).len()
            + places::between(&points, &room, 100.0).len();
        assert!(places <= 356, "{places}");
        assert_eq!(scene.clone().frame(3).camera, frame.camera);
    }
}

/// Floors were dark within some metres of their lamps, without a word.
#[test]
fn what_lies_far_off_is_told() {
    for (at, is_told) in [(0.0, false), (1e4, false), (5e5, true)] {
        let floor = sheet([at, 0.0, 0.0], [100.0, 0.0, 0.0], [0.0, 0.0, -100.0], GREY);
        let told = scene_with(vec![floor], &[[at + 50.0, 3.0, -50.0]], false)
            .frame(0)
            .far_off();
        assert_eq!(told.is_some(), is_told, "{told:?}");
        // One triangle at the origin says nothing of the others.
        let floor = sheet([at, 0.0, 0.0], [100.0, 0.0, 0.0], [0.0, 0.0, -100.0], GREY);
        let mut stray = sheet([0.0; 3], [0.2, 0.0, 0.0], [0.0, 0.0, -0.2], GREY);
        stray.triangles.truncate(1);
        let boxes = (0..8).map(|k| {
            let x = at + 10.0 * k as f32;
            cube([x, 0.0, -50.0], [x + 4.0, 4.0, -46.0], GREY)
        });
        let parts = [floor, stray].into_iter().chain(boxes).collect();
        let also = scene_with(parts, &[[at + 50.0, 3.0, -50.0]], false)
            .frame(0)
            .far_off();
        assert_eq!(also.is_some(), is_told, "{also:?}");
        // 2^-18 of the coordinate.
        assert!(told.is_none_or(|told| told.contains("rays start 1.90")), "{at}");
    }
}

/// It was said to lie far from the origin, beside a size of 0.000 m.
#[test]
fn what_is_very_small_is_told_as_such() {
    let sign = sheet([0.0; 3], [1e-10, 0.0, 0.0], [0.0, 1e-10, 0.0], LAMP);
    let told = scene(vec![sign], false).frame(0).far_off().expect("a note");
    assert!(told.contains("very small, 1.4e-10 m"), "{told}");
    assert!(!told.contains("0.000") && !told.contains("origin"), "{told}");
}

#[test]
fn nothing_to_see_is_no_error() {
    let flat = sheet([5.0; 3], [0.0; 3], [0.0; 3], GREY);
    let view = scene(vec![flat], false).frame(0).camera;
    let all = [view.eye, view.right, view.up, view.forward];
    assert!(all.iter().flatten().all(|x| x.is_finite()), "{view:?}");
}
