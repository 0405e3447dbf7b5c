use super::*;
use crate::paint::Wrap;

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

/// A triangle of a material `glow`.
const LAMP: &str = "mtllib room.mtl\nusemtl glow\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

const WHITE: [u8; 4] = [255; 4];
const BLACK: [u8; 4] = [0, 0, 0, 255];

/// Reads a file with its library and pictures beside it, in a folder of its own.
fn read_with(name: &str, obj: &str, mtl: &str, files: &[(&str, &[u8])]) -> Result<Scene, SceneError> {
    let folder = std::env::temp_dir().join(format!("lightbvh-obj-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for files");
    for (file, bytes) in files.iter().chain(&[("room.mtl", mtl.as_bytes())]) {
        std::fs::write(folder.join(file), bytes).expect("a folder for files");
    }
    let scene = Scene::read_obj_slice("room.obj", obj.as_bytes(), Some(&folder));
    let _ = std::fs::remove_dir_all(folder);
    scene
}

fn read(name: &str, obj: &str, mtl: &str) -> Result<Scene, SceneError> {
    read_with(name, obj, mtl, &[])
}

/// A picture of so many columns.
fn png(columns: u32, texels: &[[u8; 4]]) -> Vec<u8> {
    let rows = texels.len() as u32 / columns;
    let picture = image::RgbaImage::from_raw(columns, rows, texels.as_flattened().to_vec());
    let mut bytes = std::io::Cursor::new(Vec::new());
    let written = picture
        .expect("a picture")
        .write_to(&mut bytes, image::ImageFormat::Png);
    written.expect("memory");
    bytes.into_inner()
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
    assert_eq!((scene.emissive_count(), scene.mesh_light_count()), (2, 1));
    // Normals say that the lamp shines down, also where its winding does not. Some editors put a mark of UTF-8 first.
    let turned = ROOM.replace("-4//1 -3//1 \\\n  -2//1 -1//-1", "-1//1 -2//1 -3//1 -4//1");
    // A library lies beside the file where its path leads nowhere.
    let elsewhere = ROOM.replace("room.mtl", "C:\\scenes\\room.mtl");
    for text in [ROOM, &turned, &elsewhere, &format!("\u{feff}{ROOM}")] {
        let scene = read("turned", text, LIBRARY).expect("valid");
        let lights = scene.frame(0).emissive;
        assert_eq!(lights.len(), 2);
        for light in lights {
            assert!(crate::vector::normal(light.p)[1] < 0.0);
            assert!(light.p.iter().all(|vertex| vertex[1] == 1.0));
        }
    }
}

#[test]
fn materials_of_all_kinds() {
    let names = [
        "mirror", "glass", "thin", "clear", "both", "pbr", "missing", "unknown", "light",
    ];
    let faces: String = names.map(|name| format!("usemtl {name}\nf 1 2 3\n")).concat();
    let obj = format!("mtllib room.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n{faces}");
    let mtl = "newmtl mirror\nKd 0 0 0\nKs 0.9 0.8 0.7\nillum 3\nnewmtl glass\nillum 7\nnewmtl thin\nd 0.25\nnewmtl clear\nTr 0.75\n\
               newmtl both\nd 1\nTr 1\nnewmtl pbr\nKd 0.5\nPr 0.3\nPm 0.6\nnewmtl missing\nKe 1 1 1\nmap_Ke -s 1 1 1 no such.png\nmap_Kd no.png\nnewmtl light\nmap_Ke sky.hdr\n";
    let sky = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x80\x80\x81";
    let scene = read_with("kinds", &obj, mtl, &[("sky.hdr", sky)]).expect("valid");
    let materials = &scene.data().materials;
    let of = |name: &str| materials.iter().find(|own| own.name == name).expect(name);
    assert_eq!(of("mirror").base_color, [0.9, 0.8, 0.7]);
    assert_eq!((of("mirror").metallic, of("mirror").roughness), (1.0, 0.0));
    assert_eq!(of("pbr").base_color, [0.5; 3]);
    assert_eq!((of("pbr").roughness, of("pbr").metallic), (0.3, 0.6));
    assert!(
        of("light").radiance == [0.0; 3]
            && of("missing").radiance == [0.0; 3]
            && of("missing").paint.is_none()
    );
    // Surfaces named glass, thin and clear are left out.
    assert_eq!((scene.triangle_count(), scene.emissive_count()), (6, 0));
    let warnings = scene.warnings().join("\n");
    for expected in [
        "`unknown` is in no library",
        "`thin` is clear",
        "no such.png",
        "it holds light",
    ] {
        assert!(warnings.contains(expected), "{warnings}");
    }
}

/// What would be an empty picture is taken as opaque; a lamp of clear glass is none.
#[test]
fn a_file_that_is_clear_throughout_is_opaque() {
    let obj = "mtllib room.mtl\nusemtl one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl two\nf 3 2 1\n";
    for (last, expected) in [("", 2), ("Ke 1 1 1\n", 1)] {
        let mtl = format!("newmtl one\nd 0\nnewmtl two\nd 0\n{last}");
        let scene = read("clear", obj, &mtl).expect("valid");
        assert_eq!(scene.triangle_count(), expected);
    }
}

#[test]
fn errors_name_the_line() {
    for (obj, line, problem) in [
        ("v 0 0 0\nf 1 2 3\n", 2, "vertex 2, but there are only 1"),
        ("v 0 0\n", 1, "expected 3 numbers, found `0 0`"),
        ("v 0 0 nan\n", 1, "expected 3 numbers"),
        ("v 0 0 0\n\nf 1 1\n", 3, "2 vertices, expected at least 3"),
        ("v 0 0 0\nf 1 0 1\n", 2, "vertex 0"),
        ("v 0 0 0\nf 1 -2 1\n", 2, "vertex -2"),
        ("v 0 0 0\nf 1 / 1\n", 2, "`/` names no vertex"),
        ("v 0 0 0\nf a b c\n", 2, "`a` is no index of a vertex"),
        ("v 0 0 0\nf 1/1 1 1\n", 2, "coordinate 1, but there are only 0"),
    ] {
        let error = Scene::read_obj_slice("x.obj", obj.as_bytes(), None).expect_err(problem);
        let error = error.to_string();
        assert!(error.starts_with(&format!("x.obj, line {line}: ")), "{error}");
        assert!(error.contains(problem), "{error}");
    }
    let error = Scene::read_obj_slice("x.obj", b"v 0 0 0\n", None).expect_err("no face");
    assert!(matches!(error, SceneError::Empty { .. }), "{error}");
    let error = read("line", "mtllib room.mtl\n", "newmtl a\nKd 1 2\n").expect_err("one number is missing");
    assert!(error.to_string().contains("room.mtl, line 2"), "{error}");
    let error = read("negative", ROOM, &LIBRARY.replace("Ke 4", "Ke -4")).expect_err("negative light");
    assert!(error.to_string().contains("light cannot be negative"), "{error}");
}

/// Whatever is named is beside the file.
#[test]
fn libraries_outside_of_the_folder_are_refused() {
    let secret = std::env::temp_dir().join(format!("lightbvh-obj-secret-{}.mtl", std::process::id()));
    std::fs::write(&secret, LIBRARY).expect("a folder for files");
    let name = secret.file_name().and_then(|name| name.to_str()).expect("a name");
    let error = read("outside", &ROOM.replace("room.mtl", &format!("../{name}")), "");
    assert!(matches!(error, Err(SceneError::Outside { .. })), "{error:?}");
    // The format has no escapes: this is a name, of nothing.
    let escaped = ROOM.replace("room.mtl", &format!("%2e%2e/{name}"));
    let scene = read("outside", &escaped, "").expect("valid");
    assert!(scene.emissive_count() == 0 && scene.warnings()[0].contains("a material library is left out"));
    std::fs::remove_file(secret).expect("removed");
}

/// Files of some exporters name normals that they leave out. Of a face with some of them none counts: which side emits is its
/// front.
#[test]
fn faces_that_name_missing_normals_are_read_without() {
    let lamp = |normal: &str| {
        let obj = LAMP.replace("f 1 2 3", &format!("vn 0 0 -1\nf 1//1 2//1 3//{normal}"));
        read("normals", &obj, LIBRARY).expect("valid").frame(0).emissive[0].p
    };
    let ([_, b, c], [_, d, e]) = (lamp("1"), lamp("2"));
    assert_eq!((b, c), (e, d), "the normals that are there turn the lamp");
}

/// A dart shines with its area, to one side.
#[test]
fn concave_faces_emit_with_their_area() {
    let text = "mtllib room.mtl\nusemtl glow\nv -2 2 2\nv 0 2 0.5\nv 2 2 2\nv 0 2 -2\nf 1 2 3 4\n";
    let lights = read("dart", text, LIBRARY).expect("valid").frame(0).emissive;
    let twice = lights.iter().map(|light| crate::vector::normal(light.p)[1]);
    assert_eq!(twice.collect::<Vec<f64>>(), [5.0; 2]);
}

/// Two triangles of a square from (0, 0) to (1, 1), and a third that shares an edge with them and lies elsewhere on the picture.
const PAINTED: &str = "mtllib room.mtl
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 1 0
vt 1 0.5
vt 0 0.5
vt 0.5 1 0
vt 1 1
usemtl sign
f 1/1 2/2 3/3
f 1/1 3/3 4/4
f 1/4 2/3 3/6
";

fn painted(name: &str, mtl: &str, files: &[(&str, &[u8])]) -> Scene {
    read_with(name, PAINTED, &format!("newmtl sign\n{mtl}"), files).expect("valid")
}

/// The format's second coordinate grows upward: below its middle lie the rows of the lower half. What stands for the picture is
/// its mean, and black beside a map says nothing.
#[test]
fn pictures_lie_upright_and_count_by_their_means() {
    let sign = png(1, &[WHITE, BLACK]);
    let mtl = "Kd 0 0 0\nmap_Kd sign.png\nKe 2 3 4\nmap_Ke sign.png\n";
    let scene = painted("upright", mtl, &[("sign.png", &sign)]);
    let primitive = &scene.data().meshes[0].primitives[0];
    let radiance = primitive.radiance.as_ref().expect("by its picture");
    // Means of four texels, and the picture begins anew: within the lower row white counts from a half at its edges to nothing,
    // a quarter in the mean.
    for (radiance, expected) in radiance.iter().zip([0.5, 0.5, 1.5]) {
        assert!((radiance[0] - expected).abs() < 1e-3, "{radiance:?}: {expected}");
    }
    let [r, g, b] = radiance[2];
    assert!((g / r - 1.5).abs() < 1e-5 && (b / r - 2.0).abs() < 1e-5);
    assert_eq!(scene.warnings(), &[] as &[String]);
    // The mean of the material is that of the whole picture.
    assert_eq!(scene.data().materials[0].radiance, [1.0, 1.5, 2.0]);
    assert_eq!(scene.data().materials[0].base_color, [0.5; 3]);
}

#[test]
fn colours_opacities_and_options_of_maps() {
    let leaf = png(2, &[[255, 0, 0, 7], [0, 255, 0, 7], WHITE, BLACK]);
    let shape = png(1, &[WHITE, BLACK]);
    let mtl = "Kd 0.5 1 1\nmap_Kd -clamp on -s 2 3 1 -o 0.25 0.5 -bm 1 leaf.png\nmap_d shape.png\n";
    let files: [(&str, &[u8]); 2] = [("leaf.png", &leaf), ("shape.png", &shape)];
    let scene = painted("leaf", mtl, &files);
    let data = scene.data();
    let paint = data.materials[0].paint.expect("a picture");
    assert_eq!(paint.base, [0.5, 1.0, 1.0, 1.0]);
    assert_eq!(paint.cutoff, 0.5);
    let texture = paint.base_texture.expect("a picture");
    assert_eq!(texture.wrap, [Wrap::Clamp; 2]);
    assert_eq!(texture.transform, [[2.0, 0.0], [0.0, -3.0], [0.25, 0.5]]);
    assert!(paint.glow_texture.is_none());
    // Opacity is that of the other picture, row by row.
    let alphas = |scene: &Scene| -> Vec<u8> {
        let texels = scene.data().pictures[0].texels.iter();
        texels.skip(3).step_by(4).copied().collect()
    };
    assert_eq!(alphas(&scene), [255, 255, 0, 0]);

    // Vertices 1, 2 and 3 are there twice, for they lie at two places of the picture; 4 once.
    let primitive = &data.meshes[0].primitives[0];
    let lies = primitive.coordinates.as_ref().expect("where it lies");
    assert_eq!((primitive.positions.len(), lies.len()), (7, 7));
    let third = primitive.triangles[2].map(|vertex| lies[vertex as usize]);
    assert_eq!(third, [[0.0, 0.5], [1.0, 0.5], [1.0, 1.0]]);

    // Without a picture of opacity the alpha of colours counts for nothing.
    let scene = painted("opaque", "map_Kd leaf.png\n", &files);
    let paint = scene.data().materials[0].paint.expect("a picture");
    assert_eq!(paint.cutoff, 0.0);
    assert_eq!(alphas(&scene), [255; 4]);
}

/// Options and names as exporters write them, with signs that begin comments elsewhere, and coordinates that are none.
#[test]
fn maps_and_names_as_exporters_write_them() {
    let leaf = png(1, &[WHITE]);
    let all = "-imfchan m|-type sphere|-colorspace sRGB|-blendu on -blendv off|-mm 0 1|-t 0.1 0 0|\
               -bm 0.5 -boost 2 -texres 512|-s 1 1 1";
    for options in all.split('|') {
        for file in ["leaf.png", "512 leaf.png", "leaf#1.png"] {
            let mtl = format!("map_Kd {options} {file} # a leaf\n");
            let scene = painted("options", &mtl, &[(file, &leaf)]);
            let is_painted = scene.data().materials[0].paint.is_some();
            assert!(is_painted, "{options} {file}: {:?}", scene.warnings());
        }
    }
    let text = PAINTED
        .replace("usemtl sign", "usemtl Material#2")
        .replace("mtllib", "# from C:\\models\\\nmtllib")
        .replace("vt 1 1", "vt -nan(ind) 1e30");
    let library = "newmtl Material#1\nKd 1 0 0\nnewmtl Material#2\nKd 0 1 0 # green\nmap_Kd leaf.png\n";
    let scene = read_with("signs", &text, library, &[("leaf.png", &leaf)]).expect("valid");
    let (data, warnings) = (scene.data(), scene.warnings());
    assert_eq!(data.materials[0].base_color, [0.0, 1.0, 0.0], "{warnings:?}");
    let lies = data.meshes[0].primitives[0].coordinates.as_ref();
    let far = (1 << 20) as f32;
    assert_eq!(lies.expect("where it lies").last(), Some(&[0.0, far]));
    assert!(warnings[0].contains("and NaN as 0"), "{warnings:?}");
}
