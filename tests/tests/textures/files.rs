//! Paint in files, and what stands for what cannot be shown.

use super::*;

/// A painted scene that is written and read again is painted as it was, and shows the same image.
#[test]
fn paint_survives_a_file() {
    let scene = painted_room();
    let back =
        Scene::read_gltf_slice("back.glb", &scene.to_glb().expect("written"), None).expect("read back");
    assert!(back.data().is_painted());
    let of = |scene: &Scene| {
        let materials = scene.data().materials.iter();
        materials.map(|own| own.paint).collect::<Vec<_>>()
    };
    for (own, other) in of(&scene).iter().zip(of(&back)) {
        let (own, mut other) = (own.expect("painted"), other.expect("painted"));
        let near = |a: Option<Texture>, b: &mut Option<Texture>| {
            if let (Some(a), Some(b)) = (a, b.as_mut()) {
                let [x, y] = [a.transform, b.transform].map(|t| t.as_flattened().to_vec());
                assert!(x.iter().zip(&y).all(|(x, y)| (x - y).abs() < 1e-6), "{x:?} {y:?}");
                b.transform = a.transform;
            }
        };
        near(own.base_texture, &mut other.base_texture);
        near(own.rough_texture, &mut other.rough_texture);
        near(own.bump_texture, &mut other.bump_texture);
        near(own.glow_texture, &mut other.glow_texture);
        if own.bump_texture.is_none() {
            other.bump = own.bump;
        }
        // Means of textures are chosen by; what they are of is equal.
        assert_eq!(own, other);
    }
    assert_eq!(scene.data().pictures, back.data().pictures);
    let coordinates = |scene: &Scene| -> Vec<_> {
        let meshes = scene.data().meshes.iter();
        let primitives = meshes.flat_map(|mesh| &mesh.primitives);
        primitives
            .map(|own| {
                let uv = own.coordinates.as_ref().expect("coordinates");
                own.triangles
                    .iter()
                    .map(|t| t.map(|v| uv[v as usize]))
                    .collect::<Vec<_>>()
            })
            .collect()
    };
    assert_eq!(coordinates(&scene), coordinates(&back));
}

/// Files say what cannot be shown, and what stands for it is what is said.
#[test]
fn what_cannot_be_shown_has_what_stands_for_it() {
    let png = lightbvh_tests::gltf_files::png_white_black();
    let left = [[0.1, 0.1], [0.3, 0.1], [0.1, 0.9]];
    let file = || textured(left, &png);
    let material = |root: &serde_json::Value, index: usize| -> Material {
        read_json(root).expect("sound").data().materials[index].clone()
    };
    // A cutoff that no opacity reaches.
    let mut root = file();
    root["materials"][0]["pbrMetallicRoughness"] = serde_json::json!({ "baseColorTexture": { "index": 0 } });
    root["materials"][0]["alphaMode"] = "MASK".into();
    root["materials"][0]["alphaCutoff"] = 2.0.into();
    assert_eq!(
        material(&root, 0).paint.expect("painted").opacity,
        Opacity::Cut(2.0)
    );
    root["materials"][0]["alphaCutoff"] = 0.5.into();
    assert_eq!(
        material(&root, 0).paint.expect("painted").opacity,
        Opacity::Opaque
    );
    // Without coordinates means stand for textures.
    let attributes = &mut root["meshes"][0]["primitives"][0]["attributes"];
    attributes.as_object_mut().expect("a list").remove("TEXCOORD_0");
    let scene = read_json(&root).expect("sound");
    assert!(
        scene.frame(0).corners[0]
            .iter()
            .all(|corner| corner.material == u32::MAX)
    );
    let mean = scene.data().materials[0].base_color[0];
    assert!((mean - 0.5).abs() < 1e-6, "{mean}");
    // What glows by a picture that is not there does not, whatever it reflects.
    let mut root = file();
    root["materials"][0]["pbrMetallicRoughness"] = serde_json::json!({ "baseColorFactor": [0, 0, 0, 1] });
    root["images"][0] = serde_json::json!({ "uri": "nowhere.png" });
    assert!(read_json(&root).expect("sound").frame(0).emissive.is_empty());
    // A map that turns over, and a colour that is shown as it is, in part.
    let mut root = file();
    root["materials"] = serde_json::json!([{
        "alphaMode": "BLEND",
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.5, 1.0, 0.25, 0.25],
            "baseColorTexture": {
                "index": 0,
                "extensions": { "KHR_texture_transform": { "scale": [1.0, -1.0], "offset": [0.25, 0.5] } },
            },
        },
        "extensions": { "KHR_materials_unlit": {} },
    }]);
    let scene = read_json(&root).expect("sound");
    let back =
        Scene::read_gltf_slice("back.glb", &scene.to_glb().expect("written"), None).expect("read back");
    let paint = |scene: &Scene| scene.data().materials[0].paint.expect("painted");
    assert_eq!(paint(&scene).radiance, [0.5, 1.0, 0.25]);
    assert_eq!(paint(&scene), paint(&back));
}
