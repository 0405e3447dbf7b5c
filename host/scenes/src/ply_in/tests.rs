use super::*;

const TEXT: &str = "ply\nformat ascii 1.0\ncomment two triangles\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
                    element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

/// The same in binary, with normals, a list of the vertices and an element in between.
fn binary(is_little: bool) -> Vec<u8> {
    let order = if is_little { "little" } else { "big" };
    let mut out = format!(
        "ply\nformat binary_{order}_endian 1.0\nelement vertex 4\nproperty double x\nproperty float y\nproperty short z\nproperty list uchar ushort \
         extra\nproperty float nx\nproperty float ny\nproperty float nz\nelement edge 1\nproperty int a\nelement face 1\nproperty uchar flag\n\
         property list ushort uint vertex_index\nend_header\n"
    )
    .into_bytes();
    let mut put = |bytes: &[u8]| {
        if is_little {
            out.extend(bytes);
        } else {
            out.extend(bytes.iter().rev());
        }
    };
    for [x, y] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
        put(&f64::to_le_bytes(x));
        put(&(y as f32).to_le_bytes());
        put(&0_i16.to_le_bytes());
        put(&[2]);
        put(&7_u16.to_le_bytes());
        put(&7_u16.to_le_bytes());
        for n in [0.0_f32, 0.0, -1.0] {
            put(&n.to_le_bytes());
        }
    }
    put(&5_i32.to_le_bytes());
    put(&[1]);
    put(&4_u16.to_le_bytes());
    for vertex in 0..4_u32 {
        put(&vertex.to_le_bytes());
    }
    out
}

fn read(name: &str, bytes: &[u8]) -> Result<Primitive, SceneError> {
    let scene = Scene::read_ply_slice(name, bytes)?;
    Ok(scene.data().meshes[0].primitives[0].clone())
}

#[test]
fn text_and_binary_hold_the_same() {
    let text = read("t", TEXT.as_bytes()).expect("valid");
    assert_eq!(
        text.positions,
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]
    );
    assert_eq!(text.triangles, [[0, 1, 2], [0, 2, 3]]);
    for is_little in [true, false] {
        let binary = read("b", &binary(is_little)).expect("valid");
        assert_eq!(binary.positions, text.positions);
        assert_eq!(binary.triangles, text.triangles);
    }
}

#[test]
fn a_file_is_a_scene_without_emission() {
    let scene = Scene::read_ply_slice("t", TEXT.as_bytes()).expect("valid");
    assert_eq!(scene.triangle_count(), 2);
    let error = scene.require_lights().expect_err("nothing emits");
    assert!(matches!(error, SceneError::NoEmissive { .. }));
}

#[test]
fn a_pointer_to_a_file_is_named() {
    let error = Scene::read_ply_slice("t", b"version https://git-lfs.github.com/spec/v1\noid sha256:0\n")
        .expect_err("no file");
    assert!(error.to_string().contains("git lfs pull"), "{error}");
}

#[test]
fn what_is_announced_must_be_there() {
    let cases = [
        (
            TEXT.replace("vertex 4", "vertex 4000000000"),
            "4000000000 of at least 6 bytes",
        ),
        (
            TEXT.replace("4 0 1 2 3", "4 0 1 2 9"),
            "has vertices [0, 1, 2, 9], but there are only 4",
        ),
        (TEXT.replace("4 0 1 2 3", "9 0 1 2 3"), "face 0"),
        (TEXT.replace("1 1 0", "1 one 0"), "vertex 2"),
        (TEXT.replace("end_header", "end"), "end before `end_header`"),
        (TEXT.replace("float x", "float w"), "no x, y and z"),
        (TEXT.replace("float x", "half x"), "type `half` is not known"),
        (TEXT.replace("ascii", "utf"), "format `utf` is not known"),
    ];
    for (text, expected) in cases {
        let error = read("t.ply", text.as_bytes()).expect_err(expected).to_string();
        assert!(
            error.starts_with("t.ply: ") && error.contains(expected),
            "{error}"
        );
    }
}

#[test]
fn damage_is_an_error_or_a_mesh() {
    let files = [TEXT.as_bytes().to_vec(), binary(true), binary(false)];
    crate::random::damaged(&files, 3000, |bytes| {
        if let Ok(scene) = Scene::read_ply_slice("damaged", bytes) {
            assert!(scene.triangle_count() > 0);
        }
    });
}

#[test]
fn other_versions_are_refused_by_name() {
    let newer = TEXT.replace("ascii 1.0", "ascii 2.0");
    let error = read("new.ply", newer.as_bytes()).expect_err("another version");
    let error = error.to_string();
    assert!(
        error.contains("line 2") && error.contains("version `2.0`") && error.contains("PLY 1.0"),
        "{error}"
    );
}

/// A dart is cut at its notch, wherever it begins, and where vertices come after faces; other faces stay as they are.
#[test]
fn concave_faces_are_cut_at_their_notch() {
    let vertices = "-2 2 0\n0 0.5 0\n2 2 0\n0 -2 0\n9 9 9\n";
    let faces = "4 0 1 2 3\n3 0 1 4\n4 2 3 0 1\n4 3 2 1 0\n";
    let head = [
        "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n",
        "element face 4\nproperty list uchar int vertex_indices\n",
    ];
    let begin = "ply\nformat ascii 1.0\n";
    for text in [
        format!("{begin}{}{}end_header\n{vertices}{faces}", head[0], head[1]),
        format!("{begin}{}{}end_header\n{faces}{vertices}", head[1], head[0]),
    ] {
        let mesh = read("t.ply", text.as_bytes()).expect("valid");
        assert_eq!(mesh.triangles[2], [0, 1, 4]);
        assert_eq!(mesh.triangles.len(), 7);
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|k| mesh.positions[k as usize]);
            0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
        };
        // Clockwise, but for the last.
        for (pair, sign) in [
            (&mesh.triangles[0..2], -1.0),
            (&mesh.triangles[3..5], -1.0),
            (&mesh.triangles[5..7], 1.0),
        ] {
            assert_eq!([area(&pair[0]), area(&pair[1])], [2.5 * sign; 2]);
        }
    }
}
