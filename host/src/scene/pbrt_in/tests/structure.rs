//! Transforms, cameras, attributes, objects, files; damage.

use super::*;

fn vertices(text: &str) -> [[f32; 3]; 3] {
    read(&format!("{UNMIRRORED}{text}\n{TRIANGLE}"))
        .frame(0)
        .triangles[0]
        .p
}

#[test]
fn the_last_transform_is_the_first_that_acts() {
    // (2, 0, 0) is scaled to (6, 0, 0), then moved.
    assert_eq!(vertices("Translate 1 2 3 Scale 3 1 1")[1], [7.0, 2.0, 3.0]);
    assert_eq!(vertices("Scale 3 1 1 Translate 1 2 3")[1], [9.0, 2.0, 3.0]);
    // A quarter about z takes +x to +y.
    near(vertices("Rotate 90 0 0 1")[1], [0.0, 2.0, 0.0], 1e-3);
    // Columns come one after the other: the fourth moves.
    let moved = "Translate 9 9 9 Transform [1 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1]";
    assert_eq!(vertices(moved)[0], [5.0, 6.0, 7.0]);
    let twice = "Translate 1 0 0 ConcatTransform [2 0 0 0 0 2 0 0 0 0 2 0 0 0 1 1]";
    assert_eq!(vertices(twice)[1], [5.0, 0.0, 1.0]);
    assert_eq!(vertices("Translate 1 0 0 Identity")[0], [0.0; 3]);
    let spaces = "Translate 1 0 0 CoordinateSystem \"here\" Identity CoordSysTransform \"here\"";
    assert_eq!(vertices(spaces)[0], [1.0, 0.0, 0.0]);
    assert_eq!(
        vertices("AttributeBegin Translate 1 0 0 AttributeEnd")[0],
        [0.0; 3]
    );
    // Only the start of a motion counts.
    let moving = "ActiveTransform EndTime Translate 1 0 0 ActiveTransform All Translate 0 1 0";
    assert_eq!(vertices(moving)[0], [0.0, 1.0, 0.0]);
    // LookAt leads from the world to the camera: what is 5 before the eye is at z = 5.
    near(
        vertices("LookAt 0 0 5  0 0 0  0 1 0")[0],
        [0.0, 0.0, 5.0],
        ROUNDED,
    );
}

#[test]
fn a_camera_shows_its_right_on_the_right() {
    // pbrt: from (0, 0, -5) along +z, left-handed, so +x is on the right. Mirrored in z: from (0, 0, 5) along -z.
    let scene = read(&format!(
        "LookAt 1 2 -5  1 2 0  0 1 0\nCamera \"perspective\" \"float fov\" 60\nFilm \"rgb\" \"integer xresolution\" 300 \"integer yresolution\" 200\n\
         WorldBegin\nTranslate 0 0 1\n{TRIANGLE}"
    ));
    let frame = scene.frame(0);
    let camera = &frame.camera;
    near(camera.eye, [1.0, 2.0, 5.0], ROUNDED);
    near(camera.right, [1.0, 0.0, 0.0], ROUNDED);
    near(camera.up, [0.0, 1.0, 0.0], ROUNDED);
    near(camera.forward, [0.0, 0.0, -1.0], ROUNDED);
    // Two vertices change places, so that the front stays in front.
    assert_eq!(frame.triangles[0].p[2], [2.0, 0.0, -1.0]);
    // The shorter side has the angle: rows here.
    near(
        [camera.yfov, 0.0, 0.0],
        [60.0_f64.to_radians(), 0.0, 0.0],
        ROUNDED,
    );
    // A world that was mirrored by its author stays: -x is on the right of this one, looking along +z.
    let scene = read(&format!(
        "Scale -1 1 1 LookAt 0 0 -5  0 0 0  0 1 0\nCamera \"perspective\"\nWorldBegin\n{TRIANGLE}"
    ));
    let camera = &scene.frame(0).camera;
    near(camera.eye, [0.0, 0.0, -5.0], ROUNDED);
    near(camera.right, [-1.0, 0.0, 0.0], ROUNDED);
    near(camera.forward, [0.0, 0.0, 1.0], ROUNDED);
}

#[test]
fn the_shorter_side_has_the_angle() {
    let yfov = |film: &str, camera: &str| {
        let scene = read(&format!(
            "Camera \"perspective\" {camera}\nFilm \"rgb\" {film}\nWorldBegin\n{TRIANGLE}"
        ));
        f64::from(scene.frame(0).camera.yfov)
    };
    let upright = "\"integer xresolution\" 100 \"integer yresolution\" 200";
    // Columns have 90 degrees: half the height is tan 45° · 2.
    assert!((yfov(upright, "\"float fov\" 90") - 2.0 * 2.0_f64.atan()).abs() < 1e-6);
    assert!(
        (yfov("", "\"float fov\" 90 \"float screenwindow\" [-2 2 -0.5 0.5]") - 2.0 * 0.5_f64.atan()).abs()
            < 1e-6
    );
    assert!((yfov(upright, "\"float frameaspectratio\" 1") - std::f64::consts::FRAC_PI_2).abs() < 1e-6);
}

/// Its up was forgotten, and the floor stood on its edge.
#[test]
fn an_orthographic_camera_is_seen_from_far_behind_it() {
    let scene = read(&format!(
        "Scale 0.5 0.5 0.5 LookAt 3 1 8  3 1 0  1 0 0\nCamera \"orthographic\" \"float screenwindow\" [-4 4 -3 3]\nWorldBegin\n{TRIANGLE}"
    ));
    let camera = &scene.frame(0).camera;
    near(camera.up, [1.0, 0.0, 0.0], ROUNDED);
    // Half of the image is 3 of the camera's units high, 6 m.
    let behind = 32.0 * 6.0;
    let away = f64::from(camera.eye[2]).abs();
    assert!((away - (8.0 + behind)).abs() < 1e-3, "{camera:?}");
    let half = behind * (0.5 * f64::from(camera.yfov)).tan();
    assert!((half - 6.0).abs() < 1e-4, "{half}");
    assert!(
        scene.warnings()[0].contains("an orthographic camera is replaced"),
        "{:?}",
        scene.warnings()
    );
}

/// A word among numbers was dropped without a word.
#[test]
fn lists_are_of_numbers_or_of_words() {
    for (text, expected) in [
        (
            "Shape \"trianglemesh\" \"point3 P\" [0 \"a\" 0 0 1 0 0 0 1 0]",
            "`point3 P` mixes numbers with `a`",
        ),
        (
            "Shape \"trianglemesh\" \"point3 Q\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 2]",
            "the mesh has no `P`",
        ),
        (
            "LightSource \"spot\" \"float coneangle\" \"wide\"",
            "`float coneangle` has other values than numbers",
        ),
        (
            "AreaLightSource \"diffuse\" \"bool twosided\" 1",
            "`bool twosided` has other values than words",
        ),
    ] {
        let error = refused(&format!("WorldBegin\n{text}"));
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn attributes_hold_until_they_end() {
    let scene = read(&format!(
        "AttributeBegin\nAttribute \"shape\" \"float alpha\" 0\n{TRIANGLE}AttributeEnd\n{TRIANGLE}\
         AttributeBegin\nAreaLightSource \"diffuse\"\nAttribute \"material\" \"rgb reflectance\" [0 0 1]\nMaterial \"diffuse\"\n{TRIANGLE}AttributeEnd\n{TRIANGLE}"
    ));
    assert_eq!((scene.triangle_count(), scene.emissive_count()), (3, 1));
    let data = scene.data();
    let material = data.meshes[1].primitives[0].material as usize;
    assert_eq!(data.materials[material].base_color, [0.0, 0.0, 1.0]);
}

#[test]
fn objects_stand_where_their_instances_are() {
    let scene = read(&format!(
        "{UNMIRRORED}ObjectBegin \"o\"\nTranslate 0 0 1\nAreaLightSource \"diffuse\" \"rgb L\" [1 2 3]\n{TRIANGLE}ObjectEnd\n\
         AttributeBegin Translate 10 0 0 Scale 2 2 2 ObjectInstance \"o\" AttributeEnd\n\
         AttributeBegin Scale 1 1 -1 ObjectInstance \"o\" AttributeEnd\nObjectInstance \"none\""
    ));
    let frame = scene.frame(0);
    assert_eq!((frame.emissive.len(), frame.mesh_lights.len()), (2, 2));
    assert_eq!(frame.emissive[0].p[1], [14.0, 0.0, 2.0]);
    assert!(normal(frame.emissive[0].p)[2] > 0.0);
    assert!(normal(frame.emissive[1].p)[2] < 0.0);
    let warnings = scene.warnings().join("\n");
    assert!(
        warnings.contains("`none` is not defined") && warnings.contains("shine in each instance"),
        "{warnings}"
    );
}

#[test]
fn files_include_others() {
    let folder = Folder::new(
        "include",
        &[
            (
                "x.pbrt",
                b"Include \"a.pbrt\"\nImport \"b.pbrt\"\nInclude \"t.pbrt\"",
            ),
            ("a.pbrt", b"Translate 1 0 0"),
            ("b.pbrt", b"Translate 0 5 0"),
            ("t.pbrt", TRIANGLE.as_bytes()),
            ("loop.pbrt", b"\nInclude \"loop.pbrt\""),
            ("wrong.pbrt", b"Include \"c.pbrt\""),
            ("c.pbrt", b"\n\nTranslate 1 2"),
            ("none.pbrt", b"Include \"no such file\""),
        ],
    );
    let scene = folder.read("x.pbrt").expect("valid");
    assert_eq!(scene.frame(0).triangles[0].p[0], [1.0, 0.0, 0.0]);
    let error = |file: &str| folder.read(file).expect_err(file).to_string();
    assert!(error("loop.pbrt").contains("loop.pbrt, line 2: files include each other more than 32 deep"));
    let wrong = error("wrong.pbrt");
    assert!(
        wrong.contains("c.pbrt, line 3: expected 3 finite numbers"),
        "{wrong}"
    );
    assert!(error("none.pbrt").contains("cannot read"));
}

#[test]
fn nesting_has_an_end() {
    let error = refused(&"AttributeBegin\n".repeat(5000));
    assert!(
        error.contains("line 4097: attributes are nested more than 4096 times"),
        "{error}"
    );
    for (text, expected) in [
        ("AttributeEnd", "line 1: AttributeEnd without"),
        ("\nObjectBegin \"a\" AttributeEnd", "line 2: AttributeEnd without"),
        ("ObjectBegin \"a\" ObjectBegin \"b\"", "ObjectBegin in an object"),
        ("Rotate 1 2 3", "expected 4 finite numbers"),
        ("Translate 1 2 inf", "expected 3 finite numbers"),
        ("5", "expected a directive, found `5`"),
        ("]", "found a bracket"),
        ("\"a\"", "found \"a\""),
        ("Camera [\"perspective\"", "expected a string"),
    ] {
        let error = refused(text);
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn what_is_not_known_is_named_once() {
    let scene = read(&format!(
        "Frobnicate \"a\" [1 2] \"float b\" 1\nFrobnicate 1 2 true\nMediumInterface \"a\" \"b\"\nMakeNamedMedium \"a\" \"string type\" \"homogeneous\"\n\
         LightSource \"projection\"\nMaterial \"velvet\"\nColorSpace \"rec2020\"\nTexture \"t\" \"float\" \"marble\"\nMaterial \"diffuse\" \"texture reflectance\" \"u\"\n\
         Sampler \"halton\" \"integer pixelsamples\" 4\nIntegrator \"path\"\nOption \"bool a\" true\n{TRIANGLE}"
    ));
    let expected = [
        "directives `Frobnicate` are not known (2 times, first in x.pbrt, line 1)",
        "media are left out (2 times, first in x.pbrt, line 3)",
        "lights of kind `projection` are left out (x.pbrt, line 5)",
        "material `velvet` is taken as diffuse grey (x.pbrt, line 6)",
        "colour space `rec2020` is taken as srgb (x.pbrt, line 7)",
        "textures of class `marble` are taken as grey (x.pbrt, line 8)",
        "texture `u` is not defined, and taken as grey (x.pbrt, line 9)",
    ];
    assert_eq!(scene.warnings(), expected);
}

/// Everything that a file may have.
const ALL: &str = r#"LookAt 0 2 8  0 1 0  0 1 0
Camera "perspective" "float fov" [ 40 ] "float lensradius" 0.1
Film "rgb" "integer xresolution" 320 "integer yresolution" 240
WorldBegin
Texture "tex" "spectrum" "checkerboard" "rgb tex1" [0.1 0.2 0.3] "float tex2" 0.9
MakeNamedMaterial "m" "string type" "coateddiffuse" "texture reflectance" "tex" "float roughness" 0.1
AttributeBegin
  Rotate 30 0 1 0 Scale 2 2 2
  NamedMaterial "m"
  Shape "sphere" "float radius" 0.5 "float zmax" 0.25
  AreaLightSource "diffuse" "blackbody L" 3000 "float scale" 2 "bool twosided" true
  Shape "disk" "float radius" 0.5
  Shape "bilinearmesh" "point3 P" [0 0 0 1 0 0 0 1 0 1 1 0] "integer indices" [0 1 2 3]
AttributeEnd
LightSource "spot" "rgb I" [1 2 3] "point3 from" [0 4 0] "point3 to" [0 0 0] "float power" 10
LightSource "distant" "spectrum L" [400 1 600 2] "float illuminance" 3
LightSource "infinite" "rgb L" [0.1 0.1 0.2]
ObjectBegin "o"
  Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0] "integer indices" [0 1 2] "normal N" [0 0 1 0 0 1 0 0 1]
ObjectEnd
ConcatTransform [1 0 0 0 0 1 0 0 0 0 1 0 1 2 3 1]
ObjectInstance "o"
AreaLightSource "diffuse" "float power" 5
Shape "sphere"
"#;

#[test]
fn damage_is_an_error_or_a_scene() {
    assert!(read(ALL).has_kinds());
    let files = [ALL.as_bytes().to_vec()];
    let mut valid = 0;
    damaged(&files, 3000, |bytes| {
        if let Ok(scene) = Scene::read_pbrt_slice("damaged", bytes, None) {
            valid += 1;
            if valid % 64 == 0 {
                assert!(!scene.frame(0).triangles.is_empty());
            }
        }
    });
    assert!(valid > 300, "{valid}");
}

/// A file that is not there is told with the line that asks for it.
#[test]
fn missing_includes_are_told_with_their_line() {
    let folder = std::env::temp_dir();
    let text = "WorldBegin\n\nInclude \"lightbvh-there-is-no-such-file.pbrt\"\n";
    let error = Scene::read_pbrt_slice("x.pbrt", text.as_bytes(), Some(&folder))
        .expect_err("no such file")
        .to_string();
    assert!(
        error.contains("x.pbrt, line 3") && error.contains("there-is-no-such-file"),
        "{error}"
    );
}
