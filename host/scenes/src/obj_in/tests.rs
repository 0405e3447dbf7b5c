use super::*;
use crate::paint::{Opacity, Wrap};
use crate::random::damaged;

mod painted;

const ROOM: &str = "# a lamp over a floor
mtllib room.mtl
v -1 0 -1
v 1 0 -1
v 1 0 1
v -1 0 1
o floor
usemtl grey
f 4 3 2 1
v -0.5 1 -0.5
v 0.5 1 -0.5
v 0.5 1 0.5
v -0.5 1 0.5
vn 0 -1 0
o lamp
g panel
usemtl glow
f -4//1 -3//1 \\
  -2//1 -1//-1
";

const LIBRARY: &str = "newmtl grey
Kd 0.25 0.5 0.75
Ks 0.1 0.1 0.1
Ns 30
newmtl glow
Kd 0 0 0
Ke 4 5 6
";

/// A folder of its own with files in it.
fn folder(name: &str, files: &[(&str, &[u8])]) -> std::path::PathBuf {
    let folder = std::env::temp_dir().join(format!("lightbvh-obj-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for files");
    for (file, bytes) in files {
        std::fs::write(folder.join(file), bytes).expect("a folder for files");
    }
    folder
}

fn read(name: &str, obj: &str, mtl: &str) -> Result<Scene, SceneError> {
    let folder = folder(name, &[("room.mtl", mtl.as_bytes())]);
    let scene = Scene::read_obj_slice("room.obj", obj.as_bytes(), Some(&folder));
    let _ = std::fs::remove_dir_all(folder);
    scene
}

#[test]
fn groups_materials_and_indices() {
    let scene = read("groups", ROOM, LIBRARY).expect("valid");
    let data = scene.data();
    assert_eq!(scene.warnings(), &[] as &[String]);
    assert_eq!(data.nodes[0].name, "floor");
    assert_eq!(data.nodes[1].name, "lamp/panel");
    assert_eq!(data.meshes[0].primitives[0].triangles.len(), 2);
    assert_eq!(data.materials[0].base_color, [0.25, 0.5, 0.75]);
    // α² = 2 / (30 + 2) = 1/16, so roughness² = α = 1/4.
    assert_eq!(data.materials[0].roughness, 0.5);
    assert_eq!(data.materials[1].radiance, [4.0, 5.0, 6.0]);
    let frame = scene.frame(0);
    assert_eq!(frame.emissive.len(), 2);
    assert_eq!(frame.mesh_lights.len(), 1);
    // Normals say that the lamp shines down, also where its winding does not.
    for light in &frame.emissive {
        assert!(crate::vector::normal(light.p)[1] < 0.0);
        assert!(light.p.iter().all(|vertex| vertex[1] == 1.0));
    }
    let turned = ROOM.replace("-4//1 -3//1 \\\n  -2//1 -1//-1", "-1//1 -2//1 -3//1 -4//1");
    let turned = read("turned", &turned, LIBRARY).expect("valid");
    for light in &turned.frame(0).emissive {
        assert!(crate::vector::normal(light.p)[1] < 0.0);
    }
}

#[test]
fn libraries_lie_beside_the_file_where_their_path_leads_nowhere() {
    for path in ["room.mtl", "somewhere/else/room.mtl", "C:\\scenes\\room.mtl"] {
        let scene = read("beside", &ROOM.replace("room.mtl", path), LIBRARY).expect("valid");
        assert_eq!(scene.emissive_count(), 2, "{path}");
    }
}

#[test]
fn materials_of_all_kinds() {
    let lines = |names: &[&str]| -> String {
        let faces = names.iter().map(|name| format!("usemtl {name}\nf 1 2 3\n"));
        format!(
            "mtllib room.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n{}",
            faces.collect::<String>()
        )
    };
    let mtl = "newmtl mirror\nKd 0 0 0\nKs 0.9 0.8 0.7\nillum 3\nnewmtl glass\nillum 7\nnewmtl thin\nd 0.25\nnewmtl clear\nTr 0.75\n\
               newmtl both\nd 1\nTr 1\nnewmtl pbr\nKd 0.5\nPr 0.3\nPm 0.6\nnewmtl missing\nmap_Ke -s 1 1 1 no such.png\n";
    let obj = lines(&[
        "mirror", "glass", "thin", "clear", "both", "pbr", "missing", "unknown",
    ]);
    let scene = read("kinds", &obj, mtl).expect("valid");
    let of = |name: &str| {
        let materials = &scene.data().materials;
        materials
            .iter()
            .find(|material| material.name == name)
            .expect(name)
    };
    assert_eq!(of("mirror").base_color, [0.9, 0.8, 0.7]);
    assert_eq!((of("mirror").metallic, of("mirror").roughness), (1.0, 0.0));
    assert_eq!(of("glass").transmission, 1.0);
    assert_eq!(of("thin").transmission, 0.75);
    assert_eq!(of("clear").transmission, 0.75);
    assert_eq!(of("both").transmission, 0.0);
    assert_eq!(of("pbr").base_color, [0.5; 3]);
    assert_eq!((of("pbr").roughness, of("pbr").metallic), (0.3, 0.6));
    assert_eq!(of("missing").radiance, [0.0; 3]);
    // Glass, thin and clear are left out.
    assert_eq!(scene.triangle_count(), 5);
    let warnings = scene.warnings().join("\n");
    for expected in [
        "`unknown` is in no library",
        "no such.png",
        "let half of the light through",
    ] {
        assert!(warnings.contains(expected), "{warnings}");
    }
    assert!(matches!(
        scene.require_lights(),
        Err(SceneError::NoEmissive { .. })
    ));
}

/// What would be an empty picture is taken as opaque; a lamp of clear glass is none.
#[test]
fn a_file_that_is_clear_throughout_is_opaque() {
    let obj = "mtllib room.mtl\nusemtl one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl two\nf 3 2 1\n";
    let of = |mtl: &str| {
        let scene = read("clear", obj, mtl).expect("valid");
        (scene.triangle_count(), scene.warnings().join("\n"))
    };
    let (count, said) = of("newmtl one\nd 0\nnewmtl two\nd 0\n");
    assert!(count == 2 && said.contains("taken as opaque"), "{count}: {said}");
    let (count, said) = of("newmtl one\nd 0\nnewmtl two\nd 0\nKe 1 1 1\n");
    assert!(count == 1 && said.contains("are left out"), "{count}: {said}");
}

#[test]
fn maps_count_by_their_means() {
    // Half white, half black: 0.5 of light.
    let mut picture = image::RgbImage::new(2, 1);
    picture.put_pixel(0, 0, image::Rgb([255; 3]));
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture
        .write_to(&mut bytes, image::ImageFormat::Png)
        .expect("memory");
    let mtl = "newmtl glow\nKd 0 0 0\nmap_Kd half.png\nKe 4 2 1\nmap_Ke half.png\n";
    let folder = folder(
        "maps",
        &[("room.mtl", mtl.as_bytes()), ("half.png", &bytes.into_inner())],
    );
    let obj = "mtllib room.mtl\nusemtl glow\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let scene = Scene::read_obj_slice("room.obj", obj.as_bytes(), Some(&folder)).expect("valid");
    let _ = std::fs::remove_dir_all(folder);
    assert_eq!(scene.data().materials[0].radiance, [2.0, 1.0, 0.5]);
    assert_eq!(scene.data().materials[0].base_color, [0.5; 3]);
}

#[test]
fn errors_name_the_line() {
    let cases = [
        ("v 0 0 0\nf 1 2 3\n", "line 2", "vertex 2, but there are only 1"),
        ("v 0 0\n", "line 1", "expected 3 numbers, found `0 0`"),
        ("v 0 0 nan\n", "line 1", "expected 3 numbers"),
        ("v 0 0 0\n\nf 1 1\n", "line 3", "2 vertices, expected at least 3"),
        ("v 0 0 0\nf 1 0 1\n", "line 2", "vertex 0"),
        ("v 0 0 0\nf 1 -2 1\n", "line 2", "vertex -2"),
        ("v 0 0 0\nf 1 / 1\n", "line 2", "`/` names no vertex"),
        ("v 0 0 0\nf a b c\n", "line 2", "`a` is no index of a vertex"),
        (
            "v 0 0 0\nf 1/1 1 1\n",
            "line 2",
            "texture coordinate 1, but there are only 0",
        ),
        ("v 0 0 0\nf 1//x 1 1\n", "line 2", "`x` is no index of a normal"),
    ];
    for (obj, line, problem) in cases {
        let error = Scene::read_obj_slice("x.obj", obj.as_bytes(), None)
            .expect_err(problem)
            .to_string();
        assert!(error.starts_with(&format!("x.obj, {line}: ")), "{error}");
        assert!(error.contains(problem), "{error}");
    }
    let error = Scene::read_obj_slice("x.obj", b"v 0 0 0\n", None).expect_err("no face");
    assert!(matches!(error, SceneError::Empty { .. }), "{error}");
    let error = read("line", "mtllib room.mtl\n", "newmtl a\nKd 1 2\n").expect_err("one number is missing");
    assert!(error.to_string().contains("room.mtl, line 2"), "{error}");
    let error = read("negative", ROOM, &LIBRARY.replace("Ke 4", "Ke -4")).expect_err("negative light");
    assert!(error.to_string().contains("light cannot be negative"), "{error}");
}

/// Files of some exporters name normals that they leave out. Of a face with some of them none counts: which side emits is its
/// front.
#[test]
fn faces_that_name_missing_normals_are_read_without() {
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 -1\nf 1//1 2//2 3//1\nf 1//9 2//9 3//9\nf 1//-2 2//1 3//1\n";
    let scene = Scene::read_obj_slice("x.obj", obj.as_bytes(), None).expect("valid");
    assert_eq!(scene.triangle_count(), 3);
    let warnings = scene.warnings();
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    assert!(
        warnings[0].starts_with("faces that name normals that are not before them are read without normals")
            && warnings[0].ends_with("(3 times, first in x.obj, line 5)"),
        "{warnings:?}"
    );
    let lamp = |normal: &str| {
        let obj = format!(
            "mtllib room.mtl\nusemtl glow\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 -1\nf 1//1 2//1 3//{normal}\n"
        );
        read("normals", &obj, LIBRARY).expect("valid").frame(0).emissive[0].p
    };
    let ([_, b, c], [_, d, e]) = (lamp("1"), lamp("2"));
    assert_eq!((b, c), (e, d), "the normals that are there turn the lamp");
}

#[test]
fn damage_is_an_error_or_a_scene() {
    let files = [ROOM.as_bytes().to_vec()];
    let mut valid = 0;
    damaged(&files, 3000, |bytes| {
        valid += usize::from(Scene::read_obj_slice("damaged", bytes, None).is_ok());
    });
    // Most damage is of a digit.
    assert!(valid > 300, "{valid}");
    let load = Load::new(None, &Limits::default()).expect("no folder");
    let mut library = mtl::Library::new(&load);
    damaged(&[LIBRARY.as_bytes().to_vec()], 2000, |bytes| {
        let _ = library.read("damaged", bytes, None, &mut Notes::default());
    });
    assert!(library.materials.contains_key("glow"));
}

/// Some editors put a mark of UTF-8 first.
#[test]
fn a_mark_of_utf8_is_passed_by() {
    let plain = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let marked = format!("\u{feff}{plain}");
    let [plain, marked] = [plain, &marked].map(|text| {
        let scene = Scene::read_obj_slice("x.obj", text.as_bytes(), None).expect("valid");
        (scene.frame(0).triangles, scene.warnings().to_vec())
    });
    assert_eq!(plain, marked);
}

/// A picture of so many columns.
fn png(columns: u32, texels: &[[u8; 4]]) -> Vec<u8> {
    let rows = texels.len() as u32 / columns;
    let picture =
        image::RgbaImage::from_raw(columns, rows, texels.as_flattened().to_vec()).expect("a picture");
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture
        .write_to(&mut bytes, image::ImageFormat::Png)
        .expect("a picture");
    bytes.into_inner()
}

/// A dart shines with its area, to one side, wherever it begins.
#[test]
fn concave_faces_emit_with_their_area() {
    for face in ["1 2 3 4", "2 3 4 1", "3 4 1 2", "4 1 2 3"] {
        let text =
            format!("mtllib room.mtl\nusemtl glow\nv -2 2 2\nv 0 2 0.5\nv 2 2 2\nv 0 2 -2\nf {face}\n");
        let scene = read("dart", &text, LIBRARY).expect("valid");
        let primitive = &scene.data().meshes[0].primitives[0];
        let heights: Vec<f32> = (primitive.triangles.iter())
            .map(|triangle| {
                let [a, b, c] = triangle.map(|k| primitive.positions[k as usize]);
                0.5 * ((b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2]))
            })
            .collect();
        assert_eq!(heights, [2.5; 2], "{face}");
    }
}
