//! Delta lights: lamps without a surface, and what of their light the image is to show.

use super::*;

/// What stands off lights as a sun does: it was brought into the image, and what it lit was a speck.
#[test]
fn what_a_lamp_far_off_lights_fills_the_image() {
    let (low, high) = ([-1.0; 3], [1.0; 3]);
    let corners = cube(low, high, GREY).positions;
    for far in [3.0, 30.0, 1000.0] {
        let view = scene_with(vec![cube(low, high, GREY)], &[[far, far, 0.0]], false)
            .frame(0)
            .camera;
        fills(&view, &corners);
        // One of the two sides that are lit is before the eye.
        assert!(view.eye[0] > 1.0 || view.eye[1] > 1.0, "{far}: {view:?}");
    }
    // A room whose walls' backs are lit is seen from where they are.
    let view = scene_with(vec![solid(low, high, GREY, true)], &[[4.0, 5.0, 3.0]], false)
        .frame(0)
        .camera;
    assert!(!is_within(&view, low, high), "{view:?}");
}

/// Half of a room lies in the range of a dim lamp, the other half beyond that of a bright one, which lights nothing: the camera
/// looked at that.
#[test]
fn beyond_its_range_a_lamp_lights_nothing() {
    let floor = sheet([-20.0, 0.0, 5.0], [40.0, 0.0, 0.0], [0.0, 0.0, -10.0], GREY);
    let table = cube([-13.0, 0.0, -1.0], [-11.0, 1.0, 1.0], GREY);
    let lamps = [[-12.0, 3.0, 0.0], [12.0, 9.0, 0.0]];
    let mut data = scene_with(vec![floor, table], &lamps, false).into_data();
    data.analytic[0].range = Some(4.0);
    data.analytic[1].range = Some(2.0);
    data.analytic[1].intensity = 5000.0;
    let view = Scene::new(data).expect("a sound scene").frame(0).camera;
    let [x, y] = place(&view, [-12.0, 1.0, 0.0]).expect("the table is before the eye");
    assert!(x.abs() < 16.0 / 9.0 && y.abs() < 1.0, "{view:?}");
    let size = filled(&view, &[[-13.0, 0.0, 0.0], [-11.0, 0.0, 0.0]]);
    assert!(size[0].max(size[1]) > 0.02, "{size:?}: {view:?}");
}

/// Light of a narrow spot was looked for in all directions, and not found.
#[test]
fn what_a_narrow_spot_lights_is_seen() {
    let floor = sheet([-50.0, 0.0, 50.0], [100.0, 0.0, 0.0], [0.0, 0.0, -100.0], GREY);
    let table = cube([10.0, 0.0, -4.0], [12.0, 1.0, -2.0], GREY);
    let spot = AnalyticKind::Spot {
        inner: 0.05,
        outer: 0.1,
    };
    // From high above onto the table.
    let lamp = Transform::Trs {
        translation: [11.0, 12.0, -3.0],
        rotation: [
            -std::f32::consts::FRAC_1_SQRT_2,
            0.0,
            0.0,
            std::f32::consts::FRAC_1_SQRT_2,
        ],
        scale: [1.0; 3],
    };
    let mut data = scene_with(vec![floor, table], &[[0.0; 3]], false).into_data();
    data.nodes[1].transform = lamp;
    data.analytic[0].kind = spot;
    let view = Scene::new(data).expect("a sound scene").frame(0).camera;
    let [x, y] = filled(&view, &cube([10.0, 0.0, -4.0], [12.0, 1.0, -2.0], GREY).positions);
    assert!(x.max(y) > 0.06, "{x} by {y}: {view:?}");
    is_upright(&view);
}

#[test]
fn a_lamp_over_a_floor_and_its_light_are_seen() {
    let floor = sheet([-100.0, 0.0, 100.0], [200.0, 0.0, 0.0], [0.0, 0.0, -200.0], GREY);
    let lamp = cube([-0.2, 1.5, -0.2], [0.2, 1.6, 0.2], LAMP);
    let corners: Vec<_> = lamp.positions.clone();
    let view = scene(vec![floor, lamp], false).frame(0).camera;
    assert!(view.eye[1] > 0.0, "above the floor: {view:?}");
    filled(&view, &corners);
    filled(&view, &[[0.0; 3]]);
    let [x, y] = filled(&view, &[[-2.0, 0.0, 0.0], [2.0, 0.0, 0.0]]);
    assert!(x.max(y) > 0.06, "{x} by {y}: {view:?}");
    is_upright(&view);
}

/// Rays in the cone of a spot far off missed what is small in it, and the camera stood on its dark side.
#[test]
fn what_a_spot_far_off_lights_is_seen_from_there() {
    for around in 0..8_u16 {
        for (distance, outer) in [(6.0, 0.8), (15.0, 0.8), (15.0, 0.3), (200.0, 0.8)] {
            let angle = std::f32::consts::FRAC_PI_4 * f32::from(around);
            let (sine, cosine) = angle.sin_cos();
            let (half_sine, half_cosine) = (0.5 * angle).sin_cos();
            let statue = cube([-0.5, 0.0, -0.5], [0.5, 2.0, 0.5], GREY);
            let mut data = scene_with(vec![statue], &[[0.0; 3]], false).into_data();
            // Spots shine along -z: towards the statue.
            data.nodes[1].transform = Transform::Trs {
                translation: [distance * sine, 1.0, distance * cosine],
                rotation: [0.0, half_sine, 0.0, half_cosine],
                scale: [1.0; 3],
            };
            data.analytic[0].kind = AnalyticKind::Spot {
                inner: 0.5 * outer,
                outer,
            };
            let view = Scene::new(data).expect("a sound scene").frame(0).camera;
            let lit = view.eye[0] * sine + view.eye[2] * cosine;
            assert!(lit > 0.5, "{around} {distance} {outer}: {view:?}");
        }
    }
}

/// All rays of a lamp missed what lies in its range, and it counted for nothing.
#[test]
fn a_range_that_reaches_what_is_small_counts() {
    let (low, high) = ([-1.0, 0.0, -1.0], [1.0, 2.0, 1.0]);
    let lamps = [[0.0, 1.0, -20.0], [0.0, 1.0, 3.0]];
    for (range, is_behind) in [(60.0, true), (10.0, false)] {
        let mut data = scene_with(vec![cube(low, high, GREY)], &lamps, false).into_data();
        data.analytic[0].intensity = 4e5;
        data.analytic[0].range = Some(range);
        data.analytic[1].intensity = 60.0;
        let view = Scene::new(data).expect("a sound scene").frame(0).camera;
        assert_eq!(view.eye[2] < -1.0, is_behind, "{range}: {view:?}");
    }
}
