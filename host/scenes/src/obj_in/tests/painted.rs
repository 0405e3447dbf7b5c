//! Materials with pictures.

use super::*;

const WHITE: [u8; 4] = [255; 4];
const BLACK: [u8; 4] = [0, 0, 0, 255];

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
    let mut all = vec![("room.mtl", mtl.as_bytes())];
    all.extend(files);
    let folder = folder(name, &all);
    let scene = Scene::read_obj_slice("room.obj", PAINTED.as_bytes(), Some(&folder));
    let _ = std::fs::remove_dir_all(folder);
    scene.expect("valid")
}

/// The format's second coordinate grows upward: below its middle lie the rows of the lower half.
#[test]
fn pictures_lie_upright() {
    let sign = png(1, &[WHITE, BLACK]);
    let scene = painted(
        "upright",
        "newmtl sign\nKd 0.5 0.5 0.5\nKe 2 3 4\nmap_Ke sign.png\n",
        &[("sign.png", &sign)],
    );
    let primitive = &scene.data().meshes[0].primitives[0];
    let radiance = primitive.radiance.as_ref().expect("by its picture");
    // Means of four texels, and the picture begins anew: within the lower row white counts from a half at its edges to nothing,
    // a quarter in the mean.
    for (radiance, expected) in radiance.iter().zip([0.5, 0.5, 1.5]) {
        assert!(
            (radiance[0] - expected).abs() < 1e-3,
            "{radiance:?}, expected {expected}"
        );
    }
    let [r, g, b] = radiance[2];
    assert!((g / r - 1.5).abs() < 1e-5 && (b / r - 2.0).abs() < 1e-5);
    assert_eq!(scene.warnings(), &[] as &[String]);
    // The mean of the material is that of the whole picture.
    assert_eq!(scene.data().materials[0].radiance, [1.0, 1.5, 2.0]);
}

#[test]
fn colours_opacities_and_options_of_maps() {
    let leaf = png(2, &[[255, 0, 0, 7], [0, 255, 0, 7], WHITE, BLACK]);
    let shape = png(1, &[WHITE, BLACK]);
    let mtl =
        "newmtl sign\nKd 0.5 1 1\nmap_Kd -clamp on -s 2 3 1 -o 0.25 0.5 -bm 1 leaf.png\nmap_d shape.png\n";
    let files: [(&str, &[u8]); 2] = [("leaf.png", &leaf), ("shape.png", &shape)];
    let scene = painted("leaf", mtl, &files);
    let data = scene.data();
    // The shape lies as the colours do, though it has not their options, or others.
    let others = mtl.replace("map_d shape", "map_d -s 4 4 shape");
    for scene in [&scene, &painted("leaf-others", &others, &files)] {
        let warnings = scene.warnings();
        assert!(
            warnings.len() == 1 && warnings[0].contains("`map_d`") && warnings[0].contains("`-s`"),
            "{warnings:?}"
        );
    }
    let same = mtl.replace("map_d shape", "map_d -clamp on -s 2 3 1 -o 0.25 0.5 shape");
    assert_eq!(painted("leaf-same", &same, &files).warnings(), &[] as &[String]);
    let paint = data.materials[0].paint.expect("a picture");
    assert_eq!(paint.base, [0.5, 1.0, 1.0, 1.0]);
    assert_eq!(paint.opacity, Opacity::Cut(0.5));
    let texture = paint.base_texture.expect("a picture");
    assert_eq!(texture.wrap, [Wrap::Clamp; 2]);
    assert_eq!(texture.transform, [[2.0, 0.0], [0.0, -3.0], [0.25, 0.5]]);
    assert!(texture.is_color && paint.glow_texture.is_none());
    // Opacity is that of the other picture, row by row.
    let alphas: Vec<u8> = data.pictures[0]
        .texels
        .iter()
        .skip(3)
        .step_by(4)
        .copied()
        .collect();
    assert_eq!(alphas, [255, 255, 0, 0]);

    // Vertices 1, 2 and 3 are there twice, for they lie at two places of the picture; 4 once.
    let primitive = &data.meshes[0].primitives[0];
    let lies = primitive.coordinates.as_ref().expect("where it lies");
    assert_eq!((primitive.positions.len(), lies.len()), (7, 7));
    let third = primitive.triangles[2].map(|vertex| lies[vertex as usize]);
    assert_eq!(third, [[0.0, 0.5], [1.0, 0.5], [1.0, 1.0]]);

    // Without a picture of opacity the alpha of colours counts for nothing.
    let scene = painted("opaque", "newmtl sign\nmap_Kd leaf.png\n", &[("leaf.png", &leaf)]);
    let paint = scene.data().materials[0].paint.expect("a picture");
    assert_eq!(paint.opacity, Opacity::Opaque);
    assert!(
        scene.data().pictures[0]
            .texels
            .iter()
            .skip(3)
            .step_by(4)
            .all(|&alpha| alpha == 255)
    );
}

/// What cannot be shown is as it was: means of what is there, black where it should glow, coordinates that are none at 0.
#[test]
fn what_is_painted_and_is_not_there() {
    let scene = painted(
        "missing",
        "newmtl sign\nKe 1 1 1\nmap_Ke no.png\nmap_Kd no.png\n",
        &[],
    );
    assert!(scene.data().materials[0].paint.is_none());
    assert_eq!(scene.data().materials[0].radiance, [0.0; 3]);
    assert!(scene.warnings().iter().any(|warning| warning.contains("no.png")));
    let text = PAINTED.replace("vt 1 1", "vt -nan(ind) 1e30");
    let leaf = png(1, &[WHITE]);
    let folder = folder(
        "nan",
        &[
            ("room.mtl", b"newmtl sign\nmap_Kd leaf.png\n"),
            ("leaf.png", &leaf),
        ],
    );
    let scene = Scene::read_obj_slice("room.obj", text.as_bytes(), Some(&folder)).expect("valid");
    let _ = std::fs::remove_dir_all(folder);
    let lies = scene.data().meshes[0].primitives[0]
        .coordinates
        .clone()
        .expect("where it lies");
    assert_eq!(lies.last(), Some(&[0.0; 2]));
    assert!(
        scene
            .warnings()
            .iter()
            .any(|warning| warning.contains("count as 0")),
        "{:?}",
        scene.warnings()
    );
}

/// Options as exporters write them, and names with signs that begin comments elsewhere.
#[test]
fn maps_and_names_as_exporters_write_them() {
    let leaf = png(1, &[WHITE]);
    for options in [
        "-imfchan m",
        "-type sphere",
        "-colorspace sRGB",
        "-blendu on -blendv off",
        "-mm 0 1",
        "-t 0.1 0 0",
        "-bm 0.5 -boost 2 -texres 512",
        "-s 1 1 1",
    ] {
        for file in ["leaf.png", "512 leaf.png", "leaf#1.png"] {
            let scene = painted(
                "options",
                &format!("newmtl sign\nmap_Kd {options} {file} # a leaf\n"),
                &[(file, &leaf)],
            );
            assert!(
                scene.data().materials[0].paint.is_some(),
                "{options} {file}: {:?}",
                scene.warnings()
            );
        }
    }
    let text = PAINTED
        .replace("usemtl sign", "usemtl Material#2")
        .replace("mtllib", "# from C:\\models\\\nmtllib");
    let library = b"newmtl Material#1\nKd 1 0 0\nnewmtl Material#2\nKd 0 1 0 # green\n";
    let folder = folder("signs", &[("room.mtl", library)]);
    let scene = Scene::read_obj_slice("room.obj", text.as_bytes(), Some(&folder)).expect("valid");
    let _ = std::fs::remove_dir_all(folder);
    assert_eq!(
        scene.data().materials[0].base_color,
        [0.0, 1.0, 0.0],
        "{:?}",
        scene.warnings()
    );
}

/// Lamps that show one picture, each in a material of its own: it is looked at once.
#[test]
fn many_lamps_of_one_picture() {
    let sign = png(512, &vec![[255, 0, 0, 255]; 512 * 512]);
    let (mut obj, mut mtl) = (
        String::from("mtllib room.mtl\nvt 0 0\nvt 1 0\nvt 1 1\n"),
        String::new(),
    );
    for k in 0..2000 {
        mtl += &format!("newmtl m{k}\nKe 1 1 1\nmap_Ke sign.png\n");
        obj += &format!("v {k} 0 0\nv {k} 1 0\nv {k} 1 1\ng g{k}\nusemtl m{k}\nf -3/1 -2/2 -1/3\n");
    }
    let folder = folder("lamps", &[("room.mtl", mtl.as_bytes()), ("sign.png", &sign)]);
    let scene = Scene::read_obj_slice("room.obj", obj.as_bytes(), Some(&folder)).expect("valid");
    let _ = std::fs::remove_dir_all(folder);
    assert_eq!(scene.data().pictures.len(), 1);
    let radiance = scene
        .data()
        .meshes
        .iter()
        .map(|mesh| mesh.primitives[0].radiance.as_ref().expect("its own")[0]);
    // What glows anywhere leaves a trace in the other channels.
    assert!(
        radiance
            .clone()
            .all(|[r, g, b]| (r - 1.0).abs() < 1e-6 && g < 1e-3 && b < 1e-3)
    );
}
