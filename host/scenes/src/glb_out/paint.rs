//! What is painted on materials: pictures as PNG, and textures that name them.

use image::{ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};
use serde_json::{Value, json};

use super::Writer;
use super::material::strength;
use crate::paint::{IN_PLACE, Opacity, Paint, Picture, Texture, Wrap};

/// Textures and samplers as a file lists them.
#[derive(Default)]
pub(super) struct Textures {
    textures: Vec<Value>,
    samplers: Vec<Value>,
    has_transforms: bool,
}

impl Textures {
    /// Puts the lists into the file.
    pub(super) fn finish(self, root: &mut Value) {
        root["textures"] = self.textures.into();
        root["samplers"] = self.samplers.into();
        if self.has_transforms
            && let Some(used) = root["extensionsUsed"].as_array_mut()
        {
            used.push("KHR_texture_transform".into());
        }
    }

    /// What names a texture.
    fn info(&mut self, texture: &Texture) -> Value {
        let wrap = |wrap| match wrap {
            Wrap::Repeat => 10_497,
            Wrap::Clamp => 33_071,
            Wrap::Mirror => 33_648,
        };
        let sampler = json!({
            "wrapS": wrap(texture.wrap[0]),
            "wrapT": wrap(texture.wrap[1]),
            "magFilter": if texture.is_nearest { 9728 } else { 9729 },
        });
        let known = self.samplers.iter().position(|own| *own == sampler);
        let sampler = known.unwrap_or_else(|| {
            self.samplers.push(sampler);
            self.samplers.len() - 1
        });
        let own = json!({ "source": texture.picture, "sampler": sampler });
        let known = self.textures.iter().position(|texture| *texture == own);
        let index = known.unwrap_or_else(|| {
            self.textures.push(own);
            self.textures.len() - 1
        });
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

    /// Adds what is painted to a material as it is written.
    pub(super) fn paint(&mut self, paint: &Paint, material: &mut Value) {
        let strength = strength(paint.radiance);
        material["emissiveFactor"] = json!(paint.radiance.map(|channel| channel / strength));
        material["extensions"]["KHR_materials_emissive_strength"] = json!({ "emissiveStrength": strength });
        let reflectance = &mut material["pbrMetallicRoughness"];
        reflectance["baseColorFactor"] = json!(paint.base);
        reflectance["metallicFactor"] = json!(paint.metallic);
        reflectance["roughnessFactor"] = json!(paint.roughness);
        if let Some(texture) = &paint.base_texture {
            reflectance["baseColorTexture"] = self.info(texture);
        }
        if let Some(texture) = &paint.rough_texture {
            reflectance["metallicRoughnessTexture"] = self.info(texture);
        }
        if let Some(texture) = &paint.bump_texture {
            material["normalTexture"] = self.info(texture);
            material["normalTexture"]["scale"] = json!(paint.bump);
        }
        if let Some(texture) = &paint.glow_texture {
            material["emissiveTexture"] = self.info(texture);
        }
        match paint.opacity {
            Opacity::Opaque => {}
            Opacity::Cut(cutoff) => {
                material["alphaMode"] = json!("MASK");
                material["alphaCutoff"] = json!(cutoff);
            }
            Opacity::Blended => material["alphaMode"] = json!("BLEND"),
        }
        if let Some(extensions) = material["extensions"].as_object_mut() {
            extensions.remove("KHR_materials_transmission");
            if paint.transmission > 0.0 {
                extensions.insert(
                    String::from("KHR_materials_transmission"),
                    json!({ "transmissionFactor": paint.transmission }),
                );
            }
        }
    }
}

impl Writer {
    /// A picture as PNG.
    pub(super) fn picture(&mut self, picture: &Picture) -> Value {
        let at = self.binary.len();
        PngEncoder::new(&mut self.binary)
            .write_image(
                &picture.texels,
                picture.width,
                picture.height,
                ExtendedColorType::Rgba8,
            )
            .expect("writing a whole picture to memory does not fail");
        let length = self.binary.len() - at;
        // Accessors that follow begin at multiples of four.
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        self.views
            .push(json!({ "buffer": 0, "byteOffset": at, "byteLength": length }));
        json!({ "bufferView": self.views.len() - 1, "mimeType": "image/png" })
    }
}
