//! Units of lights, worked out by hand.

use lightbvh::light::Light;

use super::*;

fn lit(light: &str) -> Scene {
    read(&format!("{UNMIRRORED}{light}\n{TRIANGLE}"))
}

fn emission(scene: &Scene) -> [f32; 3] {
    let light = &scene.data().analytic[0];
    light.color.map(|x| x * light.intensity)
}

#[test]
fn an_area_light_has_its_radiance_or_its_power() {
    let area = |params: &str| {
        let scene = read(&format!(
            "{UNMIRRORED}AreaLightSource \"diffuse\" {params}\n{TRIANGLE}"
        ));
        let frame = scene.frame(0);
        assert_eq!(frame.emissive.len(), 1);
        (frame.emissive[0].radiance, frame.emissive[0].is_two_sided())
    };
    let (radiance, two) = area("\"rgb L\" [1 2 4] \"float scale\" 0.5");
    assert_eq!((radiance, two), ([0.5, 1.0, 2.0], false));
    // 100 W from 2 m² of one side: 100 / (2 π).
    let (radiance, _) = area("\"float power\" 100");
    near(radiance, [100.0 / (2.0 * std::f64::consts::PI); 3], ROUNDED);
    // The colour is a factor beside it, and two sides share it.
    let (radiance, two) = area("\"rgb L\" [2 1 0] \"float power\" 100 \"bool twosided\" true");
    let half = 100.0 / (4.0 * std::f64::consts::PI);
    near(radiance, [2.0 * half, half, 0.0], ROUNDED);
    assert!(two);
    // As version 3 writes it.
    assert_eq!(
        area("\"color L\" [1 2 4] \"rgb scale\" [1 2 3]").0,
        [1.0, 4.0, 12.0]
    );
}

#[test]
fn power_is_that_of_the_surface_in_the_world() {
    // Of two triangles, of 2 and 4 m² where the transform doubles them: each has the power.
    let scene = read(&format!(
        "{UNMIRRORED}Scale 2 1 1\nAreaLightSource \"diffuse\" \"float power\" 10\n\
         Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 2 0 2 0 0] \"integer indices\" [0 1 2 0 3 2]"
    ));
    let of = |area: f64| [10.0 / (std::f64::consts::PI * area); 3];
    let frame = scene.frame(0);
    near(frame.emissive[0].radiance, of(2.0), ROUNDED);
    near(frame.emissive[1].radiance, of(4.0), ROUNDED);
}

#[test]
fn points_and_spots() {
    let scene = lit(
        "Translate 1 2 3\nLightSource \"point\" \"rgb I\" [1 2 3] \"float scale\" 10 \"point3 from\" [0 0 1]",
    );
    assert_eq!(emission(&scene), [10.0, 20.0, 30.0]);
    let frame = scene.frame(0);
    assert_eq!(frame.others[0].centroid(), [1.0, 2.0, 4.0]);
    let scene = lit("LightSource \"point\" \"float power\" 8");
    near(emission(&scene), [2.0 / std::f64::consts::PI; 3], ROUNDED);

    let scene = lit(
        "LightSource \"spot\" \"rgb I\" [5 5 5] \"point3 from\" [0 0 5] \"point3 to\" [3 0 5] \"float coneangle\" 60 \"float conedeltaangle\" 15",
    );
    let AnalyticKind::Spot { inner, outer } = scene.data().analytic[0].kind else {
        panic!("no spot")
    };
    near(
        [inner, outer, 0.0],
        [45.0_f64.to_radians(), 60.0_f64.to_radians(), 0.0],
        ROUNDED,
    );
    let spot = lightbvh::light::SpotLight::try_from(scene.frame(0).others[0]).expect("a spot");
    // Its axis has fewer bits.
    near(spot.axis, [1.0, 0.0, 0.0], 1e-4);
    assert_eq!(spot.p, [0.0, 0.0, 5.0]);
    assert_eq!(emission(&scene), [5.0; 3]);
    // The defaults, and a power: 2 π ((1 - cos 25°) + (cos 25° - cos 30°) / 2) sr hold it.
    let scene = lit("LightSource \"spot\" \"float power\" 1");
    let [start, end] = [25.0_f64, 30.0].map(|degrees| degrees.to_radians().cos());
    let whole = std::f64::consts::TAU * (1.0 - 0.5 * (start + end));
    near(emission(&scene), [1.0 / whole; 3], ROUNDED);
}

#[test]
fn distant_lights_shine_from_one_point_to_the_other() {
    let scene = lit(
        "LightSource \"distant\" \"rgb L\" [1 2 3] \"float scale\" 2 \"point3 from\" [0 4 3] \"point3 to\" [0 0 0]",
    );
    assert_eq!(emission(&scene), [2.0, 4.0, 6.0]);
    let frame = scene.frame(0);
    let sun = frame.sky.view().suns[1];
    near(sun.direction, [0.0, 0.8, 0.6], ROUNDED);
    let scene = lit("LightSource \"distant\" \"float illuminance\" 7");
    assert_eq!(emission(&scene), [7.0; 3]);
    // More than can be sampled: the rest is named.
    let scene = lit(&"LightSource \"distant\"\n".repeat(9));
    assert_eq!(scene.data().analytic.len(), 7);
    assert!(
        scene.warnings()[0].contains("after 7 (2 times"),
        "{:?}",
        scene.warnings()
    );
}

#[test]
fn constant_skies_add_up() {
    let scene = lit(
        "LightSource \"infinite\" \"rgb L\" [1 2 3] \"float scale\" 2\nLightSource \"infinite\" \"float illuminance\" 1",
    );
    let map = scene.data().environment.as_ref().expect("a sky");
    let more = 1.0 / std::f64::consts::PI;
    for radiance in map.map().radiance.iter() {
        near(*radiance, [2.0 + more, 4.0 + more, 6.0 + more], ROUNDED);
    }
}

/// A square of black but for a bright block, of 8 texels each way.
fn square(bright: [u32; 2], side: u32) -> Vec<u8> {
    let mut picture = image::Rgb32FImage::new(side, side);
    for (x, y, pixel) in picture.enumerate_pixels_mut() {
        if x / 8 == bright[0] / 8 && y / 8 == bright[1] / 8 {
            *pixel = image::Rgb([1.0, 0.5, 0.25]);
        }
    }
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture
        .write_to(&mut bytes, image::ImageFormat::OpenExr)
        .expect("memory");
    bytes.into_inner()
}

#[test]
fn squares_are_equal_in_area_and_lead_back() {
    // Known directions: the middle is +z, the middles of edges the other axes at the equator's, the corners -z.
    for (place, direction) in [
        ([0.5, 0.5], [0.0, 0.0, 1.0]),
        ([1.0, 0.5], [1.0, 0.0, 0.0]),
        ([0.5, 1.0], [0.0, 1.0, 0.0]),
        ([0.0, 0.5], [-1.0, 0.0, 0.0]),
        ([0.5, 0.0], [0.0, -1.0, 0.0]),
        ([0.0, 0.0], [0.0, 0.0, -1.0]),
    ] {
        let found = equal_area::direction_of(place);
        for i in 0..3 {
            assert!((found[i] - direction[i]).abs() < 1e-12, "{place:?}: {found:?}");
        }
    }
    let side = 64;
    let mut above = 0;
    for x in 0..side {
        for y in 0..side {
            let place = [x, y].map(|x| (f64::from(x) + 0.5) / f64::from(side));
            let direction = equal_area::direction_of(place);
            assert!((dot(direction, direction) - 1.0).abs() < 1e-12);
            let back = equal_area::square_of(direction);
            for i in 0..2 {
                assert!((back[i] - place[i]).abs() < 1e-9, "{place:?}: {back:?}");
            }
            above += u32::from(direction[2] > 0.5);
        }
    }
    // The cap above z = 1/2 is a quarter of the sphere; its edge is 4 r √2 = 2 √2 texels·side / ... long, and cuts as many.
    let quarter = f64::from(side * side) / 4.0;
    assert!(
        (f64::from(above) - quarter).abs() < 2.0 * f64::from(side),
        "{above}"
    );
}

#[test]
fn a_sky_by_a_picture_is_bright_where_the_picture_is() {
    let side = 128;
    let bright = [72, 80];
    let place = bright.map(|x| f64::from(x + 4) / f64::from(side));
    let [x, y, z] = equal_area::direction_of(place);
    let folder = Folder::new("sky", &[("sky.exr", &square(bright, side))]);
    let brightest = |world: &str, expected: [f64; 3]| {
        let text = format!(
            "{world}LightSource \"infinite\" \"string filename\" \"sky.exr\" \"float scale\" 8\n{TRIANGLE}"
        );
        let scene = Scene::read_pbrt_slice("sky.pbrt", text.as_bytes(), Some(&folder.0)).expect("valid");
        let map = scene.data().environment.clone().expect("a sky");
        let mut best = ([0.0; 3], [0.0_f32; 3]);
        for a in 0..200 {
            for b in 0..200 {
                let place = [a, b].map(|x| (f64::from(x) + 0.5) / 200.0);
                let direction = equal_area::direction_of(place);
                let radiance = map.map().radiance(direction.map(|x| x as f32));
                if radiance[0] > best.1[0] {
                    best = (direction, radiance);
                }
            }
        }
        // Within the block, which has 1 / 256 of the sphere: it is some 0.22 radians wide, and no more than three times as long.
        assert!(
            dot(best.0, expected) > 0.66_f64.cos(),
            "{world}: {best:?}, expected {expected:?}"
        );
        near(best.1, [8.0, 4.0, 2.0], ROUNDED);
    };
    brightest(UNMIRRORED, [x, y, z]);
    // Mirrored with the world where the camera is left-handed.
    brightest("Camera \"perspective\"\nWorldBegin\n", [x, y, -z]);
    // Turned by a quarter about z: +x becomes +y.
    brightest(&format!("{UNMIRRORED}Rotate 90 0 0 1\n"), [-y, x, z]);
    // A patch that faces +z gets 4π times the mean over the sphere times the cosine, where all comes from about one direction;
    // 5 lux are asked for.
    let text = format!(
        "{UNMIRRORED}LightSource \"infinite\" \"string filename\" \"sky.exr\" \"float illuminance\" 5\n{TRIANGLE}"
    );
    let scene = Scene::read_pbrt_slice("sky.pbrt", text.as_bytes(), Some(&folder.0)).expect("valid");
    let map = scene.data().environment.clone().expect("a sky");
    let received = z * 4.0 * std::f64::consts::PI * f64::from(map.mean_luminance());
    assert!((received - 5.0).abs() < 0.25, "{received}");
}

#[test]
fn what_shines_by_formula() {
    let scene = read(&format!(
        "{UNMIRRORED}Translate 1 2 3 Scale 2 2 2\nAreaLightSource \"diffuse\" \"rgb L\" [3 2 1]\nShape \"sphere\" \"float radius\" 0.5\n\
         Shape \"disk\" \"float radius\" 0.5 \"float height\" 4\nReverseOrientation\nShape \"disk\""
    ));
    let data = scene.data();
    assert_eq!(data.analytic[0].kind, AnalyticKind::Sphere { radius: 1.0 });
    assert_eq!(data.analytic[1].kind, AnalyticKind::Disc { half: [1.0; 2] });
    assert_eq!(emission(&scene), [3.0, 2.0, 1.0]);
    let frame = scene.frame(0);
    assert_eq!(frame.others[0].centroid(), [1.0, 2.0, 3.0]);
    assert_eq!(frame.others[1].centroid(), [1.0, 2.0, 11.0]);
    let front = |index: usize| front_of(&frame, index);
    near(front(1), [0.0, 0.0, 1.0], ROUNDED);
    near(front(2), [0.0, 0.0, -1.0], ROUNDED);
    // Half a sphere, one that is stretched, one that shines inward, a disc and a sphere of two sides are triangles.
    for shape in [
        "Shape \"sphere\" \"float zmin\" 0",
        "Scale 1 2 1 Shape \"sphere\"",
        "ReverseOrientation Shape \"sphere\"",
        "AreaLightSource \"diffuse\" \"bool twosided\" true Shape \"disk\"",
        "AreaLightSource \"diffuse\" \"bool twosided\" true Shape \"sphere\"",
    ] {
        let scene = read(&format!("{UNMIRRORED}AreaLightSource \"diffuse\"\n{shape}"));
        assert!(
            scene.data().analytic.is_empty() && scene.emissive_count() > 0,
            "{shape}"
        );
    }
}

/// A dome shines inward; of very many each would be a mesh.
#[test]
fn the_first_spheres_of_two_sides_are_triangles() {
    let spheres = "Translate 3 0 0 Shape \"sphere\"\n".repeat(20);
    let scene = read(&format!(
        "{UNMIRRORED}AreaLightSource \"diffuse\" \"bool twosided\" true\n{spheres}"
    ));
    assert_eq!(scene.data().analytic.len(), 4);
    let said = |word: &str| {
        scene
            .warnings()
            .iter()
            .filter(|warning| warning.contains(word))
            .count()
    };
    assert_eq!(said("others shine outward alone"), 1, "{:?}", scene.warnings());
}

/// The normal of a flat light by formula.
fn front_of(frame: &Frame, index: usize) -> [f32; 3] {
    let light = frame.others[index];
    light.point_for(glam::Vec3::ZERO, [0.5; 2]).normal
}

#[test]
fn a_disc_keeps_its_side_in_a_mirrored_world() {
    for world in ["Camera \"perspective\"\nWorldBegin\n", UNMIRRORED] {
        let scene = read(&format!(
            "{world}AreaLightSource \"diffuse\"\nScale 1 1 -1\nShape \"disk\"\n{TRIANGLE}"
        ));
        let frame = scene.frame(0);
        let sign = if world == UNMIRRORED { -1.0 } else { 1.0 };
        near(front_of(&frame, 0), [0.0, 0.0, sign], ROUNDED);
        // As the triangle beside it, whose front is its +z too.
        let n = normal(frame.emissive[0].p);
        assert!(n[2] * sign > 0.0);
    }
}
