//! What glTF files say of surfaces: numbers of every size, textures and where they lie, pictures of every kind or none,
//! glass, surfaces that no light falls on.

use image::{ExtendedColorType, ImageFormat};
use lightbvh_host::scene::Scene;
use lightbvh_tests::gltf_files::{changed, embedded, png_white_black, push, read, read_json, triangle};
use serde_json::{Value, json};

/// [`triangle`] with texture coordinates in the white half of a picture, by which it glows.
pub fn textured(coordinates: [[f32; 2]; 3], picture: &[u8]) -> Value {
    let mut root = triangle();
    let bytes: Vec<u8> = coordinates
        .as_flattened()
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    push(
        &mut root["buffers"],
        json!({ "byteLength": 24, "uri": embedded(&bytes) }),
    );
    push(&mut root["bufferViews"], json!({ "buffer": 1, "byteLength": 24 }));
    push(
        &mut root["accessors"],
        json!({ "bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC2" }),
    );
    root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(2);
    root["materials"][0]["emissiveTexture"] = json!({ "index": 0 });
    // Texels as they are: by means of four all of so small a picture would glow.
    root["samplers"] = json!([{ "magFilter": 9728 }]);
    root["textures"] = json!([{ "source": 0, "sampler": 0 }]);
    root["images"] = json!([{ "uri": embedded(picture) }]);
    root
}

const LEFT: [[f32; 2]; 3] = [[0.1, 0.1], [0.3, 0.1], [0.1, 0.9]];
const RIGHT: [[f32; 2]; 3] = [[0.6, 0.1], [0.9, 0.1], [0.6, 0.9]];

fn radiance(root: &Value) -> Option<[f32; 3]> {
    let scene = read_json(root).expect("a sound file");
    scene.frame(0).emissive.first().map(|light| light.radiance)
}

fn warned(scene: &Scene, word: &str) {
    assert!(
        scene.warnings().iter().any(|warning| warning.contains(word)),
        "{word}: {:?}",
        scene.warnings()
    );
}

#[test]
fn positions_of_every_component_type() {
    // (0,0,0), (1,0,0), (0,1,0), in units of a whole, as plain integers and as fractions of the largest.
    let cases: [(u32, usize, bool, i32); 8] = [
        (5120, 1, false, 1),
        (5121, 1, false, 1),
        (5122, 2, false, 1),
        (5123, 2, false, 1),
        (5120, 1, true, 127),
        (5121, 1, true, 255),
        (5122, 2, true, 32767),
        (5123, 2, true, 65535),
    ];
    for (component, size, normalized, whole) in cases {
        let mut bytes = Vec::new();
        for corner in [[0, 0, 0], [whole, 0, 0], [0, whole, 0]] {
            let mut element: Vec<u8> = corner
                .iter()
                .flat_map(|x| x.to_le_bytes()[..size].to_vec())
                .collect();
            element.resize(8, 0);
            bytes.extend(element);
        }
        bytes.extend([0, 0, 1, 0, 2, 0]);
        let mut root = changed("/buffers/0", json!({ "byteLength": 30, "uri": embedded(&bytes) }));
        root["bufferViews"] = json!([
            { "buffer": 0, "byteLength": 24, "byteStride": 8 }, { "buffer": 0, "byteOffset": 24, "byteLength": 6 },
        ]);
        root["accessors"][0]["componentType"] = json!(component);
        root["accessors"][0]["normalized"] = json!(normalized);
        root["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
        let frame = read_json(&root).expect("a sound file").frame(0);
        let expected = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        assert_eq!(frame.triangles[0].p, expected, "{component} {normalized}");
    }
}

#[test]
fn sparse_indices_replace_some() {
    let mut root = triangle();
    // Element 1 of 0 1 2 becomes 2, element 2 becomes 1: turned over.
    push(
        &mut root["buffers"],
        json!({ "byteLength": 6, "uri": embedded(&[1, 2, 2, 0, 1, 0]) }),
    );
    push(&mut root["bufferViews"], json!({ "buffer": 1, "byteLength": 2 }));
    push(
        &mut root["bufferViews"],
        json!({ "buffer": 1, "byteOffset": 2, "byteLength": 4 }),
    );
    root["accessors"][1]["sparse"] = json!({
        "count": 2, "indices": { "bufferView": 2, "componentType": 5121 }, "values": { "bufferView": 3 },
    });
    let frame = read_json(&root).expect("a sound file").frame(0);
    assert_eq!(frame.triangles[0].p, [[0.0; 3], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]);
}

#[test]
fn a_child_that_the_scene_lists_stays_a_child() {
    let mut root = changed(
        "/nodes/0",
        json!({ "translation": [0.0, 0.0, 5.0], "children": [1] }),
    );
    push(&mut root["nodes"], json!({ "mesh": 0 }));
    root["scenes"][0]["nodes"] = json!([1, 0]);
    let scene = read_json(&root).expect("no harm");
    assert_eq!(scene.frame(0).triangles.len(), 1);
    assert_eq!(scene.frame(0).triangles[0].p[0], [0.0, 0.0, 5.0]);
    warned(&scene, "node 1");
    // Where its parent is not in the scene it is a root; the higher of two is placed first.
    push(
        &mut root["nodes"],
        json!({ "translation": [0.0, 7.0, 0.0], "children": [0] }),
    );
    root["scenes"][0]["nodes"] = json!([1, 0]);
    let scene = read_json(&root).expect("no harm");
    assert_eq!(scene.frame(0).triangles[0].p[0], [0.0, 0.0, 5.0]);
}

#[test]
fn textures_are_moved_turned_and_scaled() {
    let png = png_white_black();
    assert_eq!(radiance(&textured(LEFT, &png)), Some([1.0, 0.5, 0.25]));
    assert_eq!(radiance(&textured(RIGHT, &png)), None, "the black half");
    let placed = |coordinates, transform: Value| {
        let mut root = textured(coordinates, &png);
        root["extensionsRequired"] = json!(["KHR_texture_transform"]);
        root["materials"][0]["emissiveTexture"]["extensions"] = json!({ "KHR_texture_transform": transform });
        radiance(&root)
    };
    let white = Some([1.0, 0.5, 0.25]);
    assert_eq!(placed(LEFT, json!({ "offset": [0.5, 0.0] })), None);
    assert_eq!(placed(RIGHT, json!({ "scale": [0.5, 1.0] })), white);
    // A quarter turn: u' = v, so what was all in the left half goes from top to bottom.
    let quarter = std::f32::consts::FRAC_PI_2;
    let turned = placed(
        [[0.1, 0.1], [0.3, 0.1], [0.1, 0.3]],
        json!({ "rotation": quarter }),
    );
    assert_eq!(turned, white);
    assert_eq!(
        placed(
            [[0.1, 0.6], [0.3, 0.6], [0.1, 0.8]],
            json!({ "rotation": quarter })
        ),
        None
    );
    // The extension's own example, the lower left quarter: the scale comes first, then the turn, then the offset.
    let example = json!({ "offset": [0.0, 1.0], "rotation": quarter, "scale": [0.5, 0.5] });
    assert_eq!(placed([[0.1, 0.1], [0.9, 0.1], [0.1, 0.9]], example), white);
    // Coordinates of the other set.
    let mut root = textured(RIGHT, &png);
    root["meshes"][0]["primitives"][0]["attributes"] = json!({ "POSITION": 0, "TEXCOORD_1": 2 });
    root["materials"][0]["emissiveTexture"]["extensions"] =
        json!({ "KHR_texture_transform": { "texCoord": 1 } });
    assert_eq!(radiance(&root), None);
}

/// A header of KTX 2 for one level that lies behind it.
fn ktx2(format: u32, [width, height]: [u32; 2], scheme: u32, level: &[u8], unpacked: usize) -> Vec<u8> {
    let mut out = b"\xabKTX 20\xbb\r\n\x1a\n".to_vec();
    for word in [format, 1, width, height, 0, 0, 1, 1, scheme, 0, 0, 0, 0] {
        out.extend(word.to_le_bytes());
    }
    out.extend([0; 16]);
    for long in [104, level.len() as u64, unpacked as u64] {
        out.extend(long.to_le_bytes());
    }
    out.extend(level);
    out
}

#[test]
fn pictures_of_every_kind() {
    let texels = [255_u8, 255, 255, 0, 0, 0];
    let mut webp = std::io::Cursor::new(Vec::new());
    image::write_buffer_with_format(
        &mut webp,
        &texels,
        2,
        1,
        ExtendedColorType::Rgb8,
        ImageFormat::WebP,
    )
    .expect("encoded");
    // One raw block in a Zstandard frame: magic, a segment with its size, the block's header, the bytes.
    let mut zstd = vec![0x28, 0xb5, 0x2f, 0xfd, 0x20, 6, 0x31, 0, 0];
    zstd.extend(texels);
    let pictures = [
        ("EXT_texture_webp", webp.into_inner()),
        ("KHR_texture_basisu", ktx2(29, [2, 1], 0, &texels, 6)),
        ("KHR_texture_basisu", ktx2(29, [2, 1], 2, &zstd, 6)),
        (
            "KHR_texture_basisu",
            ktx2(43, [2, 1], 0, &[255, 255, 255, 255, 0, 0, 0, 255], 8),
        ),
    ];
    for (extension, picture) in pictures {
        for (coordinates, expected) in [(LEFT, Some([1.0, 0.5, 0.25])), (RIGHT, None)] {
            let mut root = textured(coordinates, &picture);
            root["extensionsRequired"] = json!([extension]);
            root["textures"] = json!([{ "sampler": 0, "extensions": { extension: { "source": 0 } } }]);
            assert_eq!(radiance(&root), expected, "{extension}");
        }
    }
}

/// A block of Basis Universal's UASTC, mode 8: one colour, here white; the rest of the block are hints for other formats.
#[test]
fn pictures_by_basis_universal() {
    let block = [
        0xf7, 0xff, 0xff, 0xff, 0xdf, 8, 212, 137, 56, 144, 107, 221, 18, 48, 132, 45,
    ];
    // Length; the descriptor's kind, version and length; colour model UASTC, sRGB, blocks of 4 by 4, 16 bytes; one sample.
    let mut descriptor = vec![44, 0, 0, 0, 0, 0, 0, 0, 2, 0, 40, 0, 166, 1, 2, 0, 3, 3, 0, 0, 16];
    descriptor.resize(44, 0);
    descriptor[30] = 127;
    descriptor[40..].fill(255);
    let mut picture = ktx2(0, [4, 4], 0, &block, 16);
    picture[48..56].copy_from_slice(&[120, 0, 0, 0, 44, 0, 0, 0]);
    picture.extend(descriptor);
    let mut root = textured(RIGHT, &picture);
    root["textures"] = json!([{ "extensions": { "KHR_texture_basisu": { "source": 0 } } }]);
    let scene = read_json(&root).expect("a sound file");
    assert_eq!(scene.frame(0).emissive[0].radiance, [1.0, 0.5, 0.25]);
    assert!(scene.warnings().is_empty(), "{:?}", scene.warnings());
    // Half as bright: 188 of 255 is 0.5 linear.
    for (byte, with) in [(0, 0x97), (1, 0x97), (2, 0x97), (3, 0xf7)] {
        picture[104 + byte] = with;
    }
    let mut root = textured(RIGHT, &picture);
    root["textures"] = json!([{ "extensions": { "KHR_texture_basisu": { "source": 0 } } }]);
    let [red, ..] = radiance(&root).expect("still bright");
    assert!((red - 0.503).abs() < 2e-3, "{red}");
}

#[test]
fn a_picture_that_cannot_be_had_is_noted_and_does_not_glow() {
    let png = png_white_black();
    let sound = || textured(RIGHT, &png);
    let mut cases = vec![sound(), sound(), sound(), sound()];
    cases[0]["images"][0] = json!({ "uri": "nowhere.png" });
    cases[1]["images"][0] = json!({ "uri": embedded(&png[..40]) });
    cases[2]["images"][0] = json!({});
    cases[3]["textures"][0] = json!({ "sampler": 0, "extensions": { "EXT_texture_avif": { "source": 0 } } });
    let most = [16_385, 1];
    for header in [
        ktx2(29, most, 0, &[0; 6], 6),
        ktx2(29, [2, 1], 0, &[0; 5], 5),
        ktx2(29, [2, 1], 2, &[0; 6], 6),
        ktx2(29, [2, 1], 2, &[0; 6], usize::MAX),
        ktx2(0, [4, 4], 0, &[0; 16], 16),
        ktx2(157, [4, 4], 0, &[0; 16], 16),
        ktx2(29, [2, 1], 0, &[0; 6], 6)[..90].to_vec(),
    ] {
        let mut root = sound();
        root["images"][0] = json!({ "uri": embedded(&header) });
        cases.push(root);
    }
    for (case, root) in cases.iter().enumerate() {
        // What is known to glow somewhere is not taken to glow everywhere.
        assert_eq!(radiance(root), None, "case {case}");
        // As the colour of a surface it is white.
        let mut painted = root.clone();
        painted["materials"][0]["pbrMetallicRoughness"] = json!({ "baseColorTexture": { "index": 0 } });
        painted["materials"][0]["emissiveTexture"] = json!(null);
        let scene = read_json(&painted).expect("a sound file");
        assert_eq!(scene.data().materials[0].base_color, [1.0; 3], "case {case}");
        warned(&read_json(root).expect("a sound file"), "white");
    }
    // Better a picture that can be decoded than the one preferred.
    let mut root = sound();
    push(&mut root["images"], json!({ "uri": embedded(&[1, 2, 3]) }));
    root["textures"][0] =
        json!({ "source": 0, "sampler": 0, "extensions": { "KHR_texture_basisu": { "source": 1 } } });
    assert_eq!(radiance(&root), None, "the right half is black");
    // A number of no picture is a broken file.
    root["textures"][0] = json!({ "source": 5 });
    assert!(read_json(&root).is_err());
}

#[test]
fn the_mean_of_a_base_colour_is_linear() {
    let mut root = textured(LEFT, &png_white_black());
    root["materials"][0]["pbrMetallicRoughness"] =
        json!({ "baseColorTexture": { "index": 0 }, "baseColorFactor": [1.0, 0.5, 0.25, 1.0] });
    let scene = read_json(&root).expect("a sound file");
    assert_eq!(scene.data().materials[0].base_color, [0.5, 0.25, 0.125]);
    root["materials"][0]["pbrMetallicRoughness"] = json!({});
    root["materials"][0]["extensions"] = json!({ "KHR_materials_pbrSpecularGlossiness": {
        "diffuseFactor": [0.25, 0.5, 1.0, 1.0], "diffuseTexture": { "index": 0 }, "glossinessFactor": 0.75,
    } });
    let material = read_json(&root).expect("a sound file").data().materials[0].clone();
    assert_eq!(material.base_color, [0.125, 0.25, 0.5]);
    assert_eq!((material.roughness, material.metallic), (0.25, 0.0));
}

/// [`triangle`], and a second one of another material above it.
fn under(material: Value) -> Value {
    let mut root = triangle();
    push(&mut root["materials"], material);
    let above = json!({ "attributes": { "POSITION": 0 }, "indices": 1, "material": 1 });
    push(&mut root["meshes"], json!({ "primitives": [above] }));
    push(
        &mut root["nodes"],
        json!({ "mesh": 1, "translation": [0.0, 0.0, 1.0] }),
    );
    root["scenes"][0]["nodes"] = json!([0, 1]);
    root
}

#[test]
fn clear_glass_hides_nothing() {
    let transmission = |factor: f32| json!({ "extensions": { "KHR_materials_transmission": { "transmissionFactor": factor } } });
    let blend = |opacity: f32| json!({ "alphaMode": "BLEND", "pbrMetallicRoughness": { "baseColorFactor": [1.0, 1.0, 1.0, opacity] } });
    for (material, triangles) in [
        (transmission(1.0), 1),
        (transmission(0.5), 1),
        (transmission(0.4), 2),
        (blend(0.25), 1),
        (blend(0.75), 2),
        (json!({ "alphaMode": "MASK" }), 2),
    ] {
        let scene = read_json(&under(material.clone())).expect("a sound file");
        assert_eq!(scene.triangle_count(), triangles, "{material}");
        assert_eq!(scene.frame(0).triangles.len(), triangles, "{material}");
        assert_eq!(scene.emissive_count(), 1);
        // Passes over all kinds of light show it.
        assert_eq!(scene.frame(0).clear.len(), 2 - triangles, "{material}");
        let back = read(&scene.to_glb().expect("written")).expect("read back");
        assert_eq!(back.frame(0), scene.frame(0), "{material}");
    }
    // Glass that glows is there.
    let mut glowing = transmission(1.0);
    glowing["emissiveFactor"] = json!([0.0, 0.0, 1.0]);
    assert_eq!(
        read_json(&under(glowing))
            .expect("a sound file")
            .frame(0)
            .triangles
            .len(),
        2
    );
    let scene = read_json(&under(transmission(f32::from(2_u8)))).expect_err("a share above one");
    assert!(
        scene.to_string().contains("transmission of material 1"),
        "{scene}"
    );
}

#[test]
fn unlit_surfaces_show_their_colour() {
    let mut root = textured(LEFT, &png_white_black());
    root["materials"] = json!([{
        "pbrMetallicRoughness": { "baseColorFactor": [0.5, 1.0, 0.25, 1.0], "baseColorTexture": { "index": 0 } },
        "extensions": { "KHR_materials_unlit": {} }, "emissiveFactor": [9.0, 9.0, 9.0],
    }]);
    root["extensionsRequired"] = json!(["KHR_materials_unlit"]);
    let scene = read_json(&root).expect("a sound file");
    assert_eq!(scene.frame(0).emissive[0].radiance, [0.5, 1.0, 0.25]);
    let surface = scene.data().materials[0].surface();
    assert_eq!(
        (surface.albedo, surface.specular),
        ([0.0; 3], 0.0),
        "it reflects nothing"
    );
    warned(&scene, "unlit");
}

#[test]
fn optional_extensions_are_left_out_with_a_note() {
    let mut root = triangle();
    root["extensionsUsed"] = json!(["KHR_materials_ior", "EXT_of_someone", "KHR_texture_transform"]);
    let scene = read_json(&root).expect("a sound file");
    assert_eq!(scene.warnings().len(), 2, "{:?}", scene.warnings());
    warned(&scene, "EXT_of_someone");
    root["materials"][0]["extensions"] =
        json!({ "KHR_materials_transmission": { "transmissionFactor": "all" } });
    warned(
        &read_json(&root).expect("optional"),
        "materials[0]: its extension KHR_materials_transmission is ignored",
    );
    root["extensionsRequired"] = json!(["KHR_materials_transmission"]);
    let error = read_json(&root).expect_err("required").to_string();
    assert!(
        error.contains("materials[0].extensions.KHR_materials_transmission"),
        "{error}"
    );
}
