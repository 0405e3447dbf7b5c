//! What glTF files say of surfaces that pictures describe: where they lie, what cannot be had, clear surfaces.

use std::io::Cursor;

use image::{ImageFormat, RgbImage};
use lightbvh::exact::hash;
use lightbvh_scenes::Scene;
use serde_json::{Value, json};

use crate::files::{embedded, png, png_white_black, push, read, read_json, refused, textured, triangle};

const LEFT: [[f32; 2]; 3] = [[0.1, 0.1], [0.3, 0.1], [0.1, 0.9]];
const RIGHT: [[f32; 2]; 3] = [[0.6, 0.1], [0.9, 0.1], [0.6, 0.9]];

fn radiance(root: &Value) -> Option<[f32; 3]> {
    let scene = read_json(root);
    scene.frame(0).emissive.first().map(|light| light.radiance)
}

fn warned(scene: &Scene, word: &str) {
    let said = scene.warnings();
    assert!(
        said.iter().any(|warning| warning.contains(word)),
        "{word}: {said:?}"
    );
}

#[test]
fn textures_are_moved_turned_and_scaled() {
    let (png, white) = (png_white_black(), Some([1.0, 0.5, 0.25]));
    let flat = [[0.1, 0.1], [0.3, 0.1], [0.1, 0.3]];
    let low = flat.map(|[u, v]| [u, v + 0.5]);
    let quarter = std::f32::consts::FRAC_PI_2;
    // 12 of 16 equal parts lie in the white texel.
    let both = [[0.0, 0.1], [1.0, 0.1], [0.0, 0.9]];
    // The extension's own example, the lower left quarter: the scale comes first, then the turn, then the offset.
    let example = json!({ "offset": [0.0, 1.0], "rotation": quarter, "scale": [0.5, 0.5] });
    for (coordinates, transform, expected) in [
        (LEFT, json!({}), white),
        (RIGHT, json!({}), None),
        (both, json!({}), Some([0.75, 0.375, 0.1875])),
        (LEFT, json!({ "offset": [0.5, 0.0] }), None),
        (RIGHT, json!({ "scale": [0.5, 1.0] }), white),
        // A quarter turn: u' = v.
        (flat, json!({ "rotation": quarter }), white),
        (low, json!({ "rotation": quarter }), None),
        ([[0.1, 0.1], [0.9, 0.1], [0.1, 0.9]], example, white),
        // Coordinates of another set.
        (RIGHT, json!({ "texCoord": 1 }), None),
    ] {
        let mut root = textured(coordinates, &png);
        if let Some(set) = transform.get("texCoord") {
            let attributes = json!({ "POSITION": 0, format!("TEXCOORD_{set}"): 2 });
            root["meshes"][0]["primitives"][0]["attributes"] = attributes;
        }
        root["extensionsRequired"] = json!(["KHR_texture_transform"]);
        root["materials"][0]["emissiveTexture"]["extensions"] = json!({ "KHR_texture_transform": transform });
        assert_eq!(radiance(&root), expected, "{transform}");
    }
}

/// A picture in KTX 2 of one level of Basis Universal's UASTC: one block of four by four texels.
fn ktx2([width, height]: [u32; 2], unpacked: u64, block: &[u8]) -> Vec<u8> {
    let mut out = b"\xabKTX 20\xbb\r\n\x1a\n".to_vec();
    for word in [0, 1, width, height, 0, 0, 1, 1, 0, 104, 44, 0, 0] {
        out.extend(word.to_le_bytes());
    }
    out.extend([0; 16]);
    for long in [148, block.len() as u64, unpacked] {
        out.extend(long.to_le_bytes());
    }
    // Length; the descriptor's kind, version and length; colour model UASTC, sRGB, blocks of 4 by 4, 16 bytes; one sample.
    let mut descriptor = vec![44, 0, 0, 0, 0, 0, 0, 0, 2, 0, 40, 0, 166, 1, 2, 0, 3, 3, 0, 0, 16];
    descriptor.resize(44, 0);
    descriptor[30] = 127;
    descriptor[40..].fill(255);
    [&out[..], &descriptor, block].concat()
}

/// A block of mode 8: one colour, here white, and half as bright (188 of 255 is 0.5 linear); the rest are hints for other formats.
const BLOCK: [u8; 16] = [
    0xf7, 0xff, 0xff, 0xff, 0xdf, 8, 212, 137, 56, 144, 107, 221, 18, 48, 132, 45,
];

#[test]
fn pictures_by_webp_and_basis_universal() {
    let mut webp = Cursor::new(Vec::new());
    let pixels = RgbImage::from_raw(2, 1, vec![255, 255, 255, 0, 0, 0]).expect("two pixels");
    pixels.write_to(&mut webp, ImageFormat::WebP).expect("encoded");
    let mut grey = BLOCK;
    grey[..4].copy_from_slice(&[0x97, 0x97, 0x97, 0xf7]);
    let [white, grey] = [BLOCK, grey].map(|block| ktx2([4, 4], 16, &block));
    for (extension, picture, coordinates, expected) in [
        ("EXT_texture_webp", webp.get_ref(), LEFT, Some(1.0)),
        ("EXT_texture_webp", webp.get_ref(), RIGHT, None),
        ("KHR_texture_basisu", &white, RIGHT, Some(1.0)),
        ("KHR_texture_basisu", &grey, RIGHT, Some(0.503)),
    ] {
        let mut root = textured(coordinates, picture);
        root["extensionsRequired"] = json!([extension]);
        root["textures"] = json!([{ "sampler": 0, "extensions": { extension: { "source": 0 } } }]);
        let found = radiance(&root).map(|[red, ..]| red);
        assert_eq!(found.is_some(), expected.is_some());
        assert!(
            (found.unwrap_or(0.0) - expected.unwrap_or(0.0)).abs() < 2e-3,
            "{found:?}"
        );
        assert_eq!(read_json(&root).warnings(), [""; 0]);
    }
}

#[test]
fn a_picture_that_cannot_be_had_is_noted_and_does_not_glow() {
    let png = png_white_black();
    let sound = || textured(RIGHT, &png);
    let headers = [
        ktx2([16_385, 1], 16, &BLOCK),
        ktx2([4, 4], 16, &BLOCK[..9]),
        ktx2([4, 4], u64::MAX, &BLOCK),
        ktx2([4, 4], 16, &BLOCK)[..90].to_vec(),
        png[..40].to_vec(),
    ];
    let embedded = headers.map(|bytes| json!({ "uri": embedded(&bytes) }));
    let images = [json!({ "uri": "nowhere.png" }), json!({})]
        .into_iter()
        .chain(embedded);
    let mut cases: Vec<Value> = images
        .map(|image| {
            let mut root = sound();
            root["images"][0] = image;
            root
        })
        .collect();
    cases.push(sound());
    cases[7]["textures"][0] = json!({ "sampler": 0, "extensions": { "EXT_texture_avif": { "source": 0 } } });
    for (case, root) in cases.iter().enumerate() {
        // What is known to glow somewhere is not taken to glow everywhere.
        assert_eq!(radiance(root), None, "case {case}");
        // As the colour of a surface it is white.
        let mut textured = root.clone();
        textured["materials"][0]["pbrMetallicRoughness"] = json!({ "baseColorTexture": { "index": 0 } });
        textured["materials"][0]["emissiveTexture"] = json!(null);
        let scene = read_json(&textured);
        assert_eq!(scene.data().materials[0].base_color, [1.0; 3], "case {case}");
        warned(&read_json(root), "white");
    }
    // Better a picture that can be decoded than the one preferred.
    let mut root = sound();
    push(&mut root["images"], json!({ "uri": "nowhere.ktx2" }));
    root["textures"][0] =
        json!({ "source": 0, "sampler": 0, "extensions": { "KHR_texture_basisu": { "source": 1 } } });
    assert_eq!(radiance(&root), None, "the right half is black");
    // A number of no picture is a broken file.
    root["textures"][0] = json!({ "source": 5 });
    refused(&root);
}

#[test]
fn the_mean_of_a_base_colour_is_linear() {
    let mut root = textured(LEFT, &png_white_black());
    root["materials"][0]["pbrMetallicRoughness"] =
        json!({ "baseColorTexture": { "index": 0 }, "baseColorFactor": [1.0, 0.5, 0.25, 1.0] });
    let scene = read_json(&root);
    assert_eq!(scene.data().materials[0].base_color, [0.5, 0.25, 0.125]);
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

/// It would hide the lamps behind it.
#[test]
fn clear_surfaces_are_left_out() {
    let glass = |factor: f32| json!({ "extensions": { "KHR_materials_transmission": { "transmissionFactor": factor } } });
    let blend = |opacity: f32| json!({ "alphaMode": "BLEND", "pbrMetallicRoughness": { "baseColorFactor": [1.0, 1.0, 1.0, opacity] } });
    let mut glowing = glass(1.0);
    glowing["emissiveFactor"] = json!([0.0, 0.0, 1.0]);
    for (material, triangles) in [
        (glass(0.5), 1),
        (glass(0.4), 2),
        (blend(0.25), 1),
        (blend(0.75), 2),
        (json!({ "alphaMode": "MASK" }), 2),
        (glowing, 2),
    ] {
        let scene = read_json(&under(material.clone()));
        assert_eq!(scene.frame(0).triangles.len(), triangles, "{material}");
        if triangles == 1 {
            warned(&scene, "clear");
        }
        let back = read(&scene.to_glb().expect("written")).expect("read back");
        assert_eq!(back.frame(0), scene.frame(0), "{material}");
    }
}

/// Files say what cannot be shown, and what stands for it is what is said.
#[test]
fn what_cannot_be_shown_has_what_stands_for_it() {
    let png = png_white_black();
    let file = || textured(LEFT, &png);
    let textures = |scene: &Scene| scene.data().materials[0].textures.expect("textures");
    let cutoff = |root: &Value| textures(&read_json(root)).cutoff;
    // A cutoff that no opacity reaches.
    let mut root = file();
    root["materials"][0]["pbrMetallicRoughness"] = json!({ "baseColorTexture": { "index": 0 } });
    root["materials"][0]["alphaMode"] = "MASK".into();
    root["materials"][0]["alphaCutoff"] = 2.0.into();
    assert_eq!(cutoff(&root), 2.0);
    root["materials"][0]["alphaCutoff"] = 0.5.into();
    assert_eq!(cutoff(&root), 0.0);
    // Without coordinates means stand for textures.
    let attributes = &mut root["meshes"][0]["primitives"][0]["attributes"];
    attributes.as_object_mut().expect("a list").remove("TEXCOORD_0");
    let scene = read_json(&root);
    assert_eq!(scene.frame(0).corners[0][0].material, u32::MAX);
    let mean = scene.data().materials[0].base_color[0];
    assert!((mean - 0.5).abs() < 1e-6, "{mean}");
    // A map that turns over, and a colour that is there in part.
    let mut root = file();
    root["materials"] = json!([{
        "alphaMode": "BLEND",
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.5, 1.0, 0.25, 0.75],
            "baseColorTexture": {
                "index": 0,
                "extensions": { "KHR_texture_transform": { "scale": [1.0, -1.0], "offset": [0.25, 0.5] } },
            },
        },
    }]);
    let scene = read_json(&root);
    let back = read(&scene.to_glb().expect("written")).expect("read back");
    assert_eq!(textures(&scene).cutoff, 0.5);
    assert_eq!(scene.frame(0), back.frame(0));
}

/// They place the same for lights and for surfaces.
#[test]
fn numbers_that_place_textures_are_bounded_and_named() {
    let far = (1 << 20) as f32;
    let png = png_white_black();
    for (bad, instead) in [(f32::INFINITY, far), (-1e30, -far), (f32::NAN, 0.0)] {
        let scene = read_json(&textured([[0.0, 0.0], [bad, 0.0], [0.0, 1.0]], &png));
        let lies = scene.data().meshes[0].primitives[0].coordinates.as_ref();
        assert_eq!(lies.expect("where it lies")[1], [instead, 0.0]);
        warned(&scene, "beyond 2^20 count as 2^20");
    }
    let far_scale = [[1.0, 0.0], [0.0, far], [0.0, 0.0]];
    let far_offset = [[1.0, 0.0], [0.0, 1.0], [0.0, -far]];
    for (given, expected) in [
        (json!({ "scale": [1, 1e38] }), far_scale),
        (json!({ "offset": [0, -1e30] }), far_offset),
    ] {
        let mut root = textured([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], &png);
        let texture = json!({ "index": 0, "extensions": { "KHR_texture_transform": given } });
        root["materials"][0]["emissiveTexture"] = texture.clone();
        root["materials"][0]["pbrMetallicRoughness"] = json!({ "baseColorTexture": texture });
        let scene = read_json(&root);
        let textures = scene.data().materials[0].textures.expect("a picture");
        for texture in [textures.base_texture, textures.glow_texture] {
            assert_eq!(texture.expect("a picture").transform, expected);
        }
        warned(&scene, "beyond 2^20");
    }
}

/// The flux of a triangle that glows by a picture is that of an integral over it, to a hundredth, however it lies.
#[test]
fn textured_flux_is_an_integral() {
    let (width, height) = (37_u32, 19_u32);
    let texel = |x: u32, y: u32| hash(x + 64 * y).to_le_bytes();
    let png = png(width, height, texel);
    let linear = |byte: u8| match f64::from(byte) / 255.0 {
        x if x <= 0.04045 => x / 12.92,
        x => ((x + 0.055) / 1.055).powf(2.4),
    };
    for corners in [
        [[0.1, 0.2], [0.9, 0.3], [0.2, 0.8]],
        [[-1.3, 0.4], [2.7, 0.9], [0.3, 3.1]],
        [[0.51, 0.52], [0.53, 0.52], [0.51, 0.55]],
    ] {
        let mut root = textured(corners, &png);
        root["samplers"] = json!([{ "magFilter": 9729 }]);
        let scene = read_json(&root);
        let found = scene.frame(0).emissive[0].radiance;
        let mut sum = [0.0; 3];
        let n = 1500;
        for i in 0..n {
            for j in 0..n - i {
                let (v, w) = ((i as f64 + 0.5) / f64::from(n), (j as f64 + 0.5) / f64::from(n));
                let at = |k: usize| {
                    let [a, b, c] = corners.map(|corner| f64::from(corner[k]));
                    a + (b - a) * v + (c - a) * w
                };
                let (x, y) = (at(0) * f64::from(width) - 0.5, at(1) * f64::from(height) - 0.5);
                let (left, top) = (x.floor(), y.floor());
                for (dx, dy) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
                    let weight = (1.0 - (x - left - dx).abs()) * (1.0 - (y - top - dy).abs());
                    let wrap = |i: f64, size: u32| i.rem_euclid(f64::from(size)) as u32;
                    let rgb = texel(wrap(left + dx, width), wrap(top + dy, height));
                    for k in 0..3 {
                        sum[k] += weight * linear(rgb[k]);
                    }
                }
            }
        }
        let count = f64::from(n) * f64::from(n + 1) / 2.0;
        let factor = scene.data().materials[0].radiance;
        for k in 0..3 {
            let expected = sum[k] / count * f64::from(factor[k]);
            let ratio = f64::from(found[k]) / expected;
            assert!((ratio - 1.0).abs() < 0.01, "{corners:?} channel {k}: {ratio}");
        }
    }
}
