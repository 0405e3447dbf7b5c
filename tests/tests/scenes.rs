//! The built-in scenes: determinism, ranges, and the way through `.glb` and back.

use std::sync::OnceLock;

use lightbvh::light::MAX_COORDINATE;
use lightbvh_host::render::write_whole;
use lightbvh_host::scene::{BUILT_IN, Frame, Scene, SceneError};

/// Of frames 0 and 150 of each built-in scene, in the order of [`BUILT_IN`].
const KNOWN_DIGESTS: [u64; 6] = [
    0x63d9_1958_57f5_f431,
    0x8dfc_0c6f_89fe_a967,
    0x166a_d35a_1d36_c171,
    0x6724_d322_c292_36bd,
    0x6ddf_479a_619e_cec7,
    0xa397_999c_9ff3_e2aa,
];

/// Each built-in scene, made once for all tests.
fn built_in(name: &str) -> &'static Scene {
    static SCENES: OnceLock<Vec<Scene>> = OnceLock::new();
    let make = || {
        BUILT_IN
            .iter()
            .map(|name| Scene::open(name).expect("built-in scenes open"))
            .collect()
    };
    let place = BUILT_IN
        .iter()
        .position(|known| *known == name)
        .expect("a built-in name");
    &SCENES.get_or_init(make)[place]
}

/// FNV-1a over all words of a frame.
fn digest(frame: &Frame) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let camera = [
        frame.camera.eye,
        frame.camera.right,
        frame.camera.up,
        frame.camera.forward,
    ];
    // Instances follow from the lights' meshes.
    let triangles: Vec<_> = frame
        .triangles
        .iter()
        .map(|t| (t.p, [t.material, t.light]))
        .collect();
    let triangles: Vec<u32> = triangles
        .iter()
        .flat_map(|(p, words)| p.as_flattened().iter().map(|x| x.to_bits()).chain(*words))
        .collect();
    let bytes: [&[u8]; 3] = [
        bytemuck::cast_slice(&triangles),
        bytemuck::cast_slice(&frame.emissive),
        bytemuck::cast_slice(&camera),
    ];
    for &byte in bytes.into_iter().flatten() {
        hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
    }
    hash
}

fn assert_same_words(a: &Frame, b: &Frame, what: &str) {
    assert_eq!(a.triangles.len(), b.triangles.len(), "{what}: triangles");
    assert_eq!(a.emissive.len(), b.emissive.len(), "{what}: emissive triangles");
    for (i, (x, y)) in a.triangles.iter().zip(&b.triangles).enumerate() {
        assert_eq!(
            bytemuck::bytes_of(x),
            bytemuck::bytes_of(y),
            "{what}: triangle {i}: {x:?} and {y:?}"
        );
    }
    for (i, (x, y)) in a.emissive.iter().zip(&b.emissive).enumerate() {
        assert_eq!(
            bytemuck::bytes_of(x),
            bytemuck::bytes_of(y),
            "{what}: emissive {i}: {x:?} and {y:?}"
        );
    }
    assert_eq!(a.mesh_lights, b.mesh_lights, "{what}: mesh lights");
    assert_eq!(a.materials, b.materials, "{what}: materials");
    assert_eq!(a.camera, b.camera, "{what}: camera");
    assert_eq!(a.background, b.background, "{what}: background");
}

#[test]
fn same_words_every_time_and_on_every_machine() {
    for name in BUILT_IN {
        let again = Scene::open(name).expect("built-in scenes open");
        for frame in [0, 7, 150] {
            assert_same_words(&built_in(name).frame(frame), &again.frame(frame), name);
        }
    }
    let digests: Vec<u64> = BUILT_IN
        .iter()
        .flat_map(|name| [0, 150].map(|frame| digest(&built_in(name).frame(frame))))
        .collect();
    // Taken from the first run; a change means that pictures and measurements change too.
    assert_eq!(
        digests, KNOWN_DIGESTS,
        "the built-in scenes changed: {digests:#018x?}"
    );
}

#[test]
fn every_frame_is_finite_and_in_range() {
    for name in BUILT_IN {
        for number in (0..=200).step_by(10) {
            let frame = built_in(name).frame(number);
            for (i, triangle) in frame.triangles.iter().enumerate() {
                for x in triangle.p.as_flattened() {
                    let sound = (x.is_normal() || x.to_bits() == 0) && x.abs() <= MAX_COORDINATE;
                    assert!(sound, "{name} frame {number} triangle {i}: {x}");
                }
                assert!((triangle.material as usize) < frame.materials.len());
            }
            let eye = frame.camera.eye;
            assert!(
                eye.iter().all(|x| x.is_finite()),
                "{name} frame {number}: eye {eye:?}"
            );
        }
    }
}

#[test]
fn through_glb_and_back_gives_the_same_frames() {
    for name in BUILT_IN {
        let scene = built_in(name);
        let glb = scene.to_glb().expect("built-in scenes can be written");
        println!("{name}: {} bytes as .glb", glb.len());
        let back = Scene::read_gltf_slice(name, &glb, None).expect("what was written can be read");
        assert_eq!(back.warnings(), [""; 0], "{name}");
        for frame in [0, 7, 150] {
            assert_same_words(
                &scene.frame(frame),
                &back.frame(frame),
                &format!("{name} frame {frame}"),
            );
        }
    }
}

#[test]
fn glb_files_are_written_whole_or_not_at_all() {
    let folder = std::env::temp_dir().join(format!("lightbvh-scenes-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a temporary folder");
    let path = folder.join("street.glb");
    let glb = built_in("street").to_glb().expect("a small scene");
    write_whole(&path, &glb).expect("the folder can be written to");
    let opened = Scene::open(&path).expect("the file can be read");
    assert_same_words(
        &built_in("street").frame(3),
        &opened.frame(3),
        "street through a file",
    );
    let entries = std::fs::read_dir(&folder).expect("the folder");
    let names: Vec<_> = entries
        .map(|entry| entry.expect("an entry").file_name())
        .collect();
    assert_eq!(names, ["street.glb"], "no temporary file stays behind");

    let nowhere = folder.join("missing").join("street.glb");
    assert!(write_whole(&nowhere, &glb).is_err(), "there is no such folder");
    std::fs::remove_dir_all(&folder).expect("the temporary folder can go");
}

#[test]
fn unknown_names_list_the_built_in_scenes() {
    let error = Scene::open("stret").expect_err("no such scene");
    assert!(matches!(error, SceneError::UnknownScene { .. }), "{error}");
    assert!(
        BUILT_IN.iter().all(|name| error.to_string().contains(name)),
        "{error}"
    );
    let error = Scene::open("no/such/file.glb").expect_err("no such file");
    assert!(matches!(error, SceneError::Read { .. }), "{error}");
}
