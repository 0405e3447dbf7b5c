//! Lamps shut in bulbs, and bulbs that glow.

use super::*;

#[test]
fn a_crate_with_a_lamp_shut_in_is_seen_from_inside() {
    let (low, high) = ([-0.5; 3], [0.5; 3]);
    let floor = sheet([-5.0, -0.6, 5.0], [10.0, 0.0, 0.0], [0.0, 0.0, -10.0], GREY);
    for parts in [
        vec![cube(low, high, GREY)],
        vec![cube(low, high, GREY), floor.clone()],
    ] {
        for lamp in [[0.0; 3], [0.15, 0.25, 0.1], [-0.4, 0.1, 0.45]] {
            let view = scene_with(parts.clone(), &[lamp], false).frame(0).camera;
            assert!(is_within(&view, low, high), "{lamp:?}: {view:?}");
        }
    }
}

/// The camera stood within the bulb, whose inside the point makes far brighter than all else.
#[test]
fn a_lamp_in_its_bulb_does_not_hide_what_the_bulb_lights() {
    let bulb = globe([0.0, 2.0, 0.0], 0.1, LAMP);
    let floor = sheet([-3.0, 0.0, 3.0], [6.0, 0.0, 0.0], [0.0, 0.0, -6.0], GREY);
    let table = cube([0.5, 0.0, -0.5], [1.5, 0.8, 0.5], GREY);
    let view = scene_with(vec![bulb, floor, table], &[[0.0, 2.0, 0.0]], false)
        .frame(0)
        .camera;
    let far: f32 = (0..3).map(|i| (view.eye[i] - [0.0, 2.0, 0.0][i]).powi(2)).sum();
    assert!(far > 1.0, "{view:?}");
    for p in [[0.0, 2.0, 0.0], [1.0, 0.8, 0.0]] {
        let [x, y] = place(&view, p).expect("before the eye");
        assert!(x.abs() < 16.0 / 9.0 && y.abs() < 1.0, "{p:?}: {view:?}");
    }
}

/// A lamp shut in a bulb counts where there is nothing else, however faint: programs give lamps in glowing bulbs 10^5 cd.
#[test]
fn lamps_in_bulbs_count_where_nothing_else_shines() {
    // A wall of two sides in front of the lamp, or one.
    let bulb = globe([0.0, 2.0, 0.0], 0.05, GREY);
    let mut inner = globe([0.0, 2.0, 0.0], 0.04, GREY);
    inner.triangles.iter_mut().for_each(|own| own.swap(0, 1));
    let floor = sheet([-3.0, 0.0, 3.0], [6.0, 0.0, 0.0], [0.0, 0.0, -6.0], GREY);
    for walls in [vec![bulb.clone()], vec![bulb, inner]] {
        for (intensity, counts) in [(0.0, true), (1e-6, false), (10.0, false)] {
            // The second lamp stands in the open.
            let lamps = [[0.0, 2.0, 0.0], [2.0, 1.0, 0.0]];
            let parts = [&walls[..], std::slice::from_ref(&floor)].concat();
            let mut data = scene_with(parts, &lamps, false).into_data();
            data.analytic[1].intensity = intensity;
            let scene = Scene::new(data).expect("a sound scene");
            let frame = scene.frame(0);
            let room = Room::new(&frame.triangles, &scene.data().materials).expect("rays");
            let fluxes = lamps::fluxes(&frame, &room, 8.0, false);
            assert_eq!(fluxes[0] > 0.0, counts, "{intensity}: {fluxes:?}");
            assert_eq!(fluxes[1] > 0.0, intensity > 0.0, "{fluxes:?}");
        }
    }
}

/// The inside of `walls`, wound so that fronts look in.
fn turned(mut walls: Primitive) -> Primitive {
    walls.triangles.iter_mut().for_each(|own| own.swap(0, 1));
    walls
}

/// The camera stood within the bulb, whose inside it lights far more than the floor, and the image was of one grey.
#[test]
fn what_a_glowing_bulb_lights_is_seen_from_outside_of_it() {
    let centre = [0.0, 2.0, 0.0];
    let floor = sheet([-5.0, 0.0, 5.0], [10.0, 0.0, 0.0], [0.0, 0.0, -10.0], GREY);
    let ground = floor.positions.clone();
    for radius in [0.02, 0.1, 0.3, 1.0] {
        let of_two_walls = |material| {
            let inner = turned(globe(centre, 0.98 * radius, material));
            vec![globe(centre, radius, material), inner]
        };
        for (name, mut parts) in [
            ("two walls", of_two_walls(LAMP)),
            ("two walls of two sides", of_two_walls(LAMP_TWO_SIDED)),
            ("turned in", vec![turned(globe(centre, radius, LAMP_TWO_SIDED))]),
        ] {
            parts.push(floor.clone());
            let view = scene(parts, false).frame(0).camera;
            let away: f32 = (0..3).map(|i| (view.eye[i] - centre[i]).powi(2)).sum();
            assert!(away > 1.5 * radius * radius, "{name} of {radius}: {view:?}");
            assert!(view.eye[1] > 0.0, "{name} of {radius}: {view:?}");
            let seen = ground
                .iter()
                .chain([&[0.0; 3]])
                .filter(|&&p| place(&view, p).is_some_and(|[x, y]| x.abs() < 16.0 / 9.0 && y.abs() < 1.0));
            assert!(seen.count() >= 1, "{name} of {radius}: {view:?}");
        }
    }
}

/// A bulb that glows inside alone, with a faint lamp beside it: but for slivers, which nobody asks, no light of the bulb counts.
#[test]
fn light_that_stays_within_a_glowing_bulb_does_not_count() {
    let centre = [0.0, 2.0, 0.0];
    let floor = sheet([-5.0, 0.0, 5.0], [10.0, 0.0, 0.0], [0.0, 0.0, -10.0], GREY);
    let inner = turned(globe(centre, 0.3, LAMP));
    let parts = vec![inner, globe(centre, 0.32, GREY), floor];
    let mut data = scene_with(parts, &[[2.0, 1.0, 1.0]], false).into_data();
    data.analytic[0].intensity = 0.01;
    let scene = Scene::new(data).expect("a sound scene");
    let frame = scene.frame(0);
    let room = Room::new(&frame.triangles, &scene.data().materials).expect("rays");
    let fluxes = lamps::fluxes(&frame, &room, 14.0, false);
    let (lamp, glowing) = fluxes.split_last().expect("the lamp");
    let glowing: f64 = glowing.iter().sum();
    // Of a sphere of 0.3 m, 10 W/(m² sr).
    assert!(*lamp > 0.0 && glowing < 0.1 * 11.3, "{lamp}, {glowing}");
}

/// A lamp in a bulb of two walls that is not so small counted against a fainter one in the open.
#[test]
fn a_bulb_of_two_walls_shuts_its_lamp_in_whatever_its_size() {
    let floor = sheet([-5.0, 0.0, 5.0], [10.0, 0.0, 0.0], [0.0, 0.0, -10.0], GREY);
    for radius in [0.05, 0.2, 0.4] {
        let centre = [0.0, 2.0, 0.0];
        let bulb = globe(centre, radius, GREY);
        let inner = turned(globe(centre, 0.9 * radius, GREY));
        let mut data = scene_with(
            vec![bulb, inner, floor.clone()],
            &[centre, [2.0, 1.0, 1.0]],
            false,
        )
        .into_data();
        data.analytic[0].intensity = 1e5;
        data.analytic[1].intensity = 10.0;
        let view = Scene::new(data).expect("a sound scene").frame(0).camera;
        let away: f32 = (0..3).map(|i| (view.eye[i] - centre[i]).powi(2)).sum();
        assert!(away > 1.5 * radius * radius, "{radius}: {view:?}");
    }
    // A small room with one wall is none.
    let room = solid([-0.3, 1.7, -0.3], [0.3, 2.3, 0.3], GREY, true);
    let scene = scene_with(vec![room, floor], &[[0.0, 2.0, 0.0], [2.0, 1.0, 1.0]], false);
    let frame = scene.frame(0);
    let rays = Room::new(&frame.triangles, &scene.data().materials).expect("rays");
    let fluxes = lamps::fluxes(&frame, &rays, 14.0, false);
    assert!(fluxes.iter().all(|&flux| flux > 0.0), "{fluxes:?}");
}
