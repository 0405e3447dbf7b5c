//! Pictures on surfaces.

use super::*;
use crate::scene::paint::Wrap;

fn png(texels: &[[u8; 4]]) -> Vec<u8> {
    let picture = image::RgbaImage::from_raw(1, texels.len() as u32, texels.as_flattened().to_vec());
    let mut bytes = std::io::Cursor::new(Vec::new());
    let picture = picture.expect("a picture");
    picture
        .write_to(&mut bytes, image::ImageFormat::Png)
        .expect("a picture");
    bytes.into_inner()
}

const QUAD: &str = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 2 0 0 0 2 0] \"integer indices\" [0 1 2]
    \"point2 uv\" [0 0 1 0 0 1]\n";

fn scene(name: &str, text: &str) -> Scene {
    let bricks = png(&[[255, 255, 255, 255], [0, 0, 0, 255]]);
    let text = format!("{UNMIRRORED}{text}");
    let folder = Folder::new(name, &[("bricks.png", &bricks), ("x.pbrt", text.as_bytes())]);
    folder.read("x.pbrt").expect("valid")
}

#[test]
fn colours_of_surfaces_are_shown() {
    let scene = scene(
        "shown",
        &format!(
            "Texture \"bricks\" \"spectrum\" \"imagemap\" \"string filename\" \"bricks.png\" \"string wrap\" \"clamp\"
             \"float uscale\" 2 \"float vscale\" 3 \"float udelta\" 0.25 \"float vdelta\" 0.5
             Texture \"darker\" \"spectrum\" \"scale\" \"texture tex\" \"bricks\" \"float scale\" 0.5
             Texture \"values\" \"spectrum\" \"imagemap\" \"string filename\" \"bricks.png\" \"string encoding\" \"linear\"
             Material \"diffuse\" \"texture reflectance\" \"bricks\"\n{QUAD}
             Material \"coateddiffuse\" \"texture reflectance\" \"darker\" \"float roughness\" 0.0001\n{QUAD}
             Material \"conductor\" \"texture reflectance\" \"values\"\n{QUAD}"
        ),
    );
    let data = scene.data();
    assert_eq!(scene.warnings(), &[] as &[String]);
    // Three materials show one picture.
    assert_eq!(data.pictures.len(), 1);
    let paints: Vec<_> = (0..3)
        .map(|mesh| {
            let primitive = &data.meshes[mesh].primitives[0];
            let lies = primitive.coordinates.as_ref().expect("where it lies");
            assert_eq!(lies[..], [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
            data.materials[primitive.material as usize]
                .paint
                .expect("a picture")
        })
        .collect();
    let texture = paints[0].base_texture.expect("a picture");
    assert_eq!(texture.wrap, [Wrap::Clamp; 2]);
    // pbrt's second coordinate grows upward.
    assert_eq!(texture.transform, [[2.0, 0.0], [0.0, -3.0], [0.25, 0.5]]);
    assert_eq!(paints[0].base, [1.0; 4]);
    assert_eq!(paints[1].base, [0.5, 0.5, 0.5, 1.0]);
    assert!((paints[1].roughness - 0.1).abs() < 1e-6);
    assert_eq!((paints[2].metallic, paints[0].metallic), (1.0, 0.0));
    let is_color = paints
        .iter()
        .map(|paint| paint.base_texture.expect("a picture").is_color);
    assert!(is_color.eq([true, true, false]));
}

#[test]
fn what_cannot_be_shown_keeps_its_mean() {
    let scene = scene(
        "means",
        &format!(
            "Texture \"inverted\" \"spectrum\" \"imagemap\" \"string filename\" \"bricks.png\" \"bool invert\" true
             Texture \"bright\" \"spectrum\" \"imagemap\" \"string filename\" \"bricks.png\" \"float scale\" 1.5
             Texture \"bricks\" \"spectrum\" \"imagemap\" \"string filename\" \"bricks.png\"
             Material \"diffuse\" \"texture reflectance\" \"inverted\"\n{QUAD}
             Material \"diffuse\" \"texture reflectance\" \"bright\"\n{QUAD}
             Material \"diffuse\" \"texture reflectance\" \"bricks\"\n{TRIANGLE}
             AreaLightSource \"diffuse\" \"rgb L\" [1 2 3]\n{QUAD}"
        ),
    );
    let data = scene.data();
    let of = |mesh: usize| {
        let primitive = &data.meshes[mesh].primitives[0];
        let material = &data.materials[primitive.material as usize];
        let is_shown = material.paint.is_some() && primitive.coordinates.is_some();
        (is_shown, material.base_color, material.radiance)
    };
    assert_eq!(of(0), (false, [0.5; 3], [0.0; 3]));
    assert_eq!(of(1), (false, [0.75; 3], [0.0; 3]));
    // Without coordinates it lies by pbrt's own; what emits shows no picture.
    assert_eq!(of(2), (true, [0.5; 3], [0.0; 3]));
    assert_eq!(of(3), (false, [0.5; 3], [1.0, 2.0, 3.0]));
    let warnings = scene.warnings().join("\n");
    for part in ["inverted", "brighter"] {
        assert!(warnings.contains(part), "{warnings}");
    }
}

/// u by the angle, v from the lowest z up; a sphere that closes has its first meridian twice.
#[test]
fn spheres_and_files_know_where_pictures_lie() {
    let ply = b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        property float s\nproperty float t\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
        0 0 0 0 0.25\n1 0 0 1 0.5\n0 1 0 0 0.75\n3 0 1 2\n";
    let bricks = png(&[[255, 255, 255, 255], [0, 0, 0, 255]]);
    let text = format!(
        "{UNMIRRORED}Texture \"bricks\" \"spectrum\" \"imagemap\" \"string filename\" \"bricks.png\"
         Material \"diffuse\" \"texture reflectance\" \"bricks\"
         Shape \"sphere\" \"float radius\" 2\nShape \"plymesh\" \"string filename\" \"m.ply\"\n"
    );
    let folder = Folder::new(
        "spheres",
        &[
            ("bricks.png", &bricks),
            ("m.ply", ply),
            ("x.pbrt", text.as_bytes()),
        ],
    );
    let scene = folder.read("x.pbrt").expect("valid");
    let primitive = &scene.data().meshes[0].primitives[0];
    let lies = primitive.coordinates.as_ref().expect("where it lies");
    for (&[x, y, z], &[u, v]) in primitive.positions.iter().zip(lies) {
        let height = (f64::from(z) / 2.0).clamp(-1.0, 1.0);
        let expected = 1.0 - libm::acos(height) / std::f64::consts::PI;
        assert!((f64::from(v) - expected).abs() < 1e-3, "{z} {v}");
        let turn = libm::atan2(f64::from(y), f64::from(x)) / std::f64::consts::TAU;
        let apart = (f64::from(u) - turn).rem_euclid(1.0);
        let is_pole = z.abs() > 1.999;
        assert!(is_pole || apart.min(1.0 - apart) < 1e-3, "{x} {y} {u}");
    }
    assert!(lies.iter().any(|uv| uv[0] == 1.0) && lies.iter().any(|uv| uv[0] == 0.0));
    // No triangle goes around the back of the picture.
    for triangle in &primitive.triangles {
        let us = triangle.map(|vertex| lies[vertex as usize][0]);
        assert!(us.iter().all(|u| (u - us[0]).abs() < 0.1), "{us:?}");
    }
    let lies = scene.data().meshes[1].primitives[0].coordinates.as_ref();
    assert_eq!(
        lies.expect("where it lies")[..],
        [[0.0, 0.25], [1.0, 0.5], [0.0, 0.75]]
    );
}

#[test]
fn cameras_and_powers_that_mean_nothing_are_named() {
    let camera = |fov: &str| format!("Camera \"perspective\" \"float fov\" {fov}\nWorldBegin\n{TRIANGLE}");
    for fov in ["0", "-30", "180"] {
        let scene = read(&camera(fov));
        assert!(scene.data().cameras.is_empty());
        let warnings = scene.warnings().join("\n");
        assert!(warnings.contains(&format!("`fov` is {fov}")), "{warnings}");
    }
    assert_eq!(read(&camera("45")).warnings(), &[] as &[String]);
    for light in [
        "LightSource \"point\" \"rgb I\" [1 1 1] \"float power\" -4",
        "LightSource \"distant\" \"float illuminance\" 0",
        "AreaLightSource \"diffuse\" \"float power\" -2",
    ] {
        let warnings = read(&format!("{UNMIRRORED}{light}\n{TRIANGLE}"))
            .warnings()
            .join("\n");
        assert!(warnings.contains("not above 0"), "{light}: {warnings}");
    }
}

/// pbrt-v4, `Triangle::Intersect` and `BilinearPatch`: (0, 0), (1, 0), (1, 1) where a mesh has no `uv`, and a patch its corners.
#[test]
fn meshes_without_coordinates_lie_as_in_pbrt() {
    let scene = scene(
        "default-uv",
        "Texture \"bricks\" \"spectrum\" \"imagemap\" \"string filename\" \"bricks.png\"
         Material \"diffuse\" \"texture reflectance\" \"bricks\"
         Shape \"trianglemesh\" \"point3 P\" [0 0 0 2 0 0 2 2 0 0 2 0] \"integer indices\" [0 1 2 0 2 3]
         Shape \"bilinearmesh\" \"point3 P\" [0 0 1 2 0 1 0 2 1 2 2 1]
         ReverseOrientation
         Shape \"trianglemesh\" \"point3 P\" [0 0 0 2 0 0 2 2 0]\n",
    );
    assert_eq!(scene.warnings(), &[] as &[String]);
    let of = |mesh: usize| -> Vec<([f32; 3], [f32; 2])> {
        let primitive = &scene.data().meshes[mesh].primitives[0];
        let lies = primitive.coordinates.as_ref().expect("where it lies");
        let vertices = primitive.triangles.as_flattened().iter();
        vertices
            .map(|&vertex| (primitive.positions[vertex as usize], lies[vertex as usize]))
            .collect()
    };
    let [a, b, c, d] = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0]];
    let [first, second, third] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
    let both = [
        (a, first),
        (b, second),
        (c, third),
        (a, first),
        (c, second),
        (d, third),
    ];
    assert_eq!(of(0)[..], both);
    // A patch: each corner has its own place, whichever half it is of.
    for ([x, y, _], uv) in of(1) {
        assert_eq!([x / 2.0, y / 2.0], uv);
    }
    // Turned over, and each vertex where it was.
    assert_eq!(of(2)[..], [(a, first), (c, third), (b, second)]);
}

/// pbrt refuses them; here they are named.
#[test]
fn misspelt_parameters_and_missing_files_are_named() {
    let scene = read(&format!(
        "Camera \"perspective\" \"float fov_\" 30 \"float lensradius\" 0
         WorldBegin
         LightSource \"point\" \"rgb I\" [1 1 1] \"point3 form\" [0 0 1]
         Texture \"bricks\" \"spectrum\" \"imagemap\"
         Texture \"noise\" \"float\" \"fbm\" \"integer octave\" 3
         Material \"diffuse\" \"texture reflectance\" \"bricks\" \"rgb Reflectance\" [1 0 0]
         Attribute \"shape\" \"float radius\" 3
         Shape \"plymesh\"
         Shape \"sphere\" \"float zman\" 1
         {TRIANGLE}"
    ));
    let warnings = scene.warnings().join("\n");
    for part in [
        "ignored parameter `fov_` of Camera: it has none of that name; correct the name (x.pbrt, line 1)",
        "ignored parameter `form` of LightSource",
        "ignored parameter `octave` of Texture",
        "ignored parameter `Reflectance` of Material",
        "ignored parameter `zman` of Shape",
        "a texture is taken as grey: an `imagemap` has no `filename`",
        "a `plymesh` has no `filename`",
    ] {
        assert!(warnings.contains(part), "{part}: {warnings}");
    }
    // What `Attribute` says for all shapes counts for those that have it, and is no mistake of the others.
    assert!(
        !warnings.contains("`radius`") && !warnings.contains("folder"),
        "{warnings}"
    );
    assert_eq!(warnings.matches("ignored").count(), 5, "{warnings}");
}

#[test]
fn pictures_of_light_are_divided_by_their_exposure() {
    let picture = super::super::super::radiance_hdr::tests::picture("EXPOSURE=4\n", &[[128, 128, 128, 129]]);
    let text = format!("AreaLightSource \"diffuse\" \"string filename\" \"x.hdr\"\n{TRIANGLE}");
    let folder = Folder::new("exposure", &[("x.pbrt", text.as_bytes()), ("x.hdr", &picture)]);
    let frame = folder.read("x.pbrt").expect("valid").frame(0);
    assert_eq!(frame.emissive[0].radiance, [0.25; 3]);
}

#[test]
fn scales_of_textures_that_no_scene_takes_are_named() {
    let scene = scene(
        "scales",
        &format!(
            "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"bricks.png\" \"float uscale\" 1e30
             Material \"diffuse\" \"texture reflectance\" \"t\"\n{QUAD}"
        ),
    );
    let data = scene.data();
    let paint = data.materials[data.meshes[0].primitives[0].material as usize].paint;
    let texture = paint.expect("a picture").base_texture.expect("a picture");
    assert_eq!(texture.transform[0][0], (1 << 20) as f32);
    assert!(scene.warnings()[0].contains("beyond 2^20 count as 2^20"));
}
