//! Materials, their emission as a factor in [0, 1] and a strength.

use serde_json::{Value, json};

use crate::Material;

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

/// Emission as a factor in [0, 1] and a strength.
pub(super) fn material(material: &Material) -> Value {
    let strength = strength(material.radiance);
    let mut extensions = json!({ "KHR_materials_emissive_strength": { "emissiveStrength": strength } });
    if material.transmission > 0.0 {
        extensions["KHR_materials_transmission"] = json!({ "transmissionFactor": material.transmission });
    }
    json!({
        "name": material.name,
        "doubleSided": material.double_sided,
        "emissiveFactor": material.radiance.map(|channel| channel / strength),
        "extensions": extensions,
        "pbrMetallicRoughness": {
            "baseColorFactor": [material.base_color[0], material.base_color[1], material.base_color[2], 1.0],
            "metallicFactor": material.metallic,
            "roughnessFactor": material.roughness,
        },
    })
}
