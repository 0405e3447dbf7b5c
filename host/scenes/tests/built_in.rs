//! The built-in scenes: determinism, ranges, and the way through `.glb` and back.

use lightbvh_scenes::{BUILT_IN, Frame, Scene, SceneError, View};

/// Of frames 0 and 150 of each built-in scene, in the order of [`BUILT_IN`].
const KNOWN_DIGESTS: [u64; 6] = [
    0x63d9_1958_57f5_f431,
    0x8dfc_0c6f_89fe_a967,
    0x166a_d35a_1d36_c171,
    0x6724_d322_c292_36bd,
    0x6ddf_479a_619e_cec7,
    0xa397_999c_9ff3_e2aa,
];

/// FNV-1a over all words of a frame.
fn digest(frame: &Frame) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let View {
        eye,
        right,
        up,
        forward,
        ..
    } = frame.camera;
    let camera = [eye, right, up, forward];
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
    // By words: zeros of either sign differ.
    assert_eq!(digest(a), digest(b), "{what}");
    assert_eq!(
        (&a.mesh_lights, &a.materials),
        (&b.mesh_lights, &b.materials),
        "{what}"
    );
    assert_eq!(a.background, b.background, "{what}");
}

#[test]
fn same_words_on_every_machine_and_through_glb_and_back() {
    let mut digests = Vec::new();
    for name in BUILT_IN {
        let open = || Scene::open(name).expect("built-in scenes open");
        let (scene, again) = (open(), open());
        let glb = scene.to_glb().expect("built-in scenes can be written");
        let back = Scene::read_gltf_slice(name, &glb, None).expect("what was written can be read");
        assert_eq!(back.warnings(), [""; 0], "{name}");
        for frame in [0, 7, 150] {
            let own = scene.frame(frame);
            assert_same_words(&own, &again.frame(frame), name);
            assert_same_words(&own, &back.frame(frame), name);
            digests.extend((frame != 7).then(|| digest(&own)));
        }
    }
    // A change means that pictures and measurements change too.
    assert_eq!(
        digests, KNOWN_DIGESTS,
        "the built-in scenes changed: {digests:#018x?}"
    );
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
