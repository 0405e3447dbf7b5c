//! Materials, their emission as a factor in [0, 1] and a strength, and their textures.

use serde_json::{Value, json};

use crate::Material;
use crate::textures::{IN_PLACE, MaterialTextures, Texture, Wrap};

/// The least power of two, from 1 on, that is not below any channel: the strength with which factors lie in [0, 1].
pub(super) fn strength(radiance: [f32; 3]) -> f32 {
    let peak = radiance.iter().fold(0.0_f32, |m, &channel| m.max(channel));
    let mut strength = 1.0_f32;
    // 2^127 is the largest power of two in `f32`.
    while strength < peak && strength < 1.0 / f32::MIN_POSITIVE {
        strength *= 2.0;
    }
    strength
}

/// Whether every channel is the product of an `f32` and the strength: one that is 2^126 times weaker may not be.
pub(super) fn is_product(radiance: [f32; 3]) -> bool {
    let strength = strength(radiance);
    radiance
        .iter()
        .all(|&channel| channel / strength * strength == channel)
}

/// Textures and samplers as a file lists them.
#[derive(Default)]
pub(super) struct Textures {
    pub textures: Vec<Value>,
    pub samplers: Vec<Value>,
    pub has_transforms: bool,
}

impl Textures {
    /// A material with its textures.
    pub(super) fn material(&mut self, material: &Material) -> Value {
        let [r, g, b] = material.base_color;
        let plain = MaterialTextures {
            base: [r, g, b, 1.0],
            radiance: material.radiance,
            ..MaterialTextures::PLAIN
        };
        let textures = material.textures.as_ref().unwrap_or(&plain);
        let strength = strength(textures.radiance);
        let mut out = json!({
            "name": material.name,
            "doubleSided": material.double_sided,
            "emissiveFactor": textures.radiance.map(|channel| channel / strength),
            "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": strength } },
            "pbrMetallicRoughness": {
                "baseColorFactor": textures.base,
                "metallicFactor": material.metallic,
                "roughnessFactor": material.roughness,
            },
        });
        if let Some(texture) = &textures.base_texture {
            out["pbrMetallicRoughness"]["baseColorTexture"] = self.info(texture);
        }
        if let Some(texture) = &textures.glow_texture {
            out["emissiveTexture"] = self.info(texture);
        }
        if textures.cutoff > 0.0 {
            out["alphaMode"] = json!("MASK");
            out["alphaCutoff"] = json!(textures.cutoff);
        }
        out
    }

    /// What names a texture.
    fn info(&mut self, texture: &Texture) -> Value {
        let wrap = |wrap| match wrap {
            Wrap::Repeat => 10_497,
            Wrap::Clamp => 33_071,
            Wrap::Mirror => 33_648,
        };
        self.samplers.push(json!({
            "wrapS": wrap(texture.wrap[0]),
            "wrapT": wrap(texture.wrap[1]),
            "magFilter": if texture.is_nearest { 9728 } else { 9729 },
        }));
        let index = self.textures.len();
        self.textures
            .push(json!({ "source": texture.picture, "sampler": index }));
        let mut info = json!({ "index": index });
        if texture.transform != IN_PLACE {
            self.has_transforms = true;
            let [x, y, offset] = texture.transform.map(|column| column.map(f64::from));
            info["extensions"]["KHR_texture_transform"] = json!({
                "offset": offset,
                "rotation": f64::atan2(-x[1], x[0]),
                // Where the map turns over, one of the two is negative.
                "scale": [x[0].hypot(x[1]), y[0].hypot(y[1]).copysign(x[0] * y[1] - x[1] * y[0])],
            });
        }
        info
    }
}
