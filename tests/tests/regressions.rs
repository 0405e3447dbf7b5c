//! Inputs that once broke a fuzz target, and one that goes deep for each: replayed without a fuzzer.

use std::path::Path;

use lightbvh_fuzz::{Forms, TARGETS};

#[test]
fn fuzz_inputs() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/regressions");
    for (name, target) in TARGETS {
        let mut count = 0;
        for entry in std::fs::read_dir(folder.join(name)).expect("a folder for each target") {
            let path = entry.expect("a readable folder").path();
            println!("{}", path.display());
            target(&std::fs::read(&path).expect("a readable file"), Forms::All);
            count += 1;
        }
        assert!(count > 0, "no input for {name}");
    }
}

/// What the fuzzer would begin with: random bytes of every length, whatever they make.
#[test]
fn random_inputs() {
    let mut random = lightbvh_tests::generate::Random::new(1);
    for i in 0..2000 {
        let bytes: Vec<u8> = (0..4 * (i % 400))
            .flat_map(|_| random.bits().to_le_bytes())
            .collect();
        // Of files most are refused early.
        for (_, target) in TARGETS.iter().filter(|(name, _)| i < 400 || *name == "gltf") {
            target(&bytes, Forms::All);
        }
    }
}

/// The document that the target `gltf` changes is read whole.
#[test]
fn document_of_the_fuzzer_is_sound() {
    let document = lightbvh_fuzz::gltf_document(&[0; 64]);
    let scene = lightbvh_host::scene::Scene::read_gltf_slice("fuzz", &document, None).expect("sound");
    let said = scene.warnings();
    assert!(
        !said
            .iter()
            .any(|own| own.contains("left out") || own.contains("counts as")),
        "{said:?}"
    );
    let data = scene.data();
    assert_eq!((data.meshes.len(), data.pictures.len()), (4, 2));
    assert_eq!((data.analytic.len(), data.animations[0].channels.len()), (1, 3));
}
