//! Materials: the factors that the reference renderer uses.

use gltf::json;
use gltf::json::material::AlphaMode;
use gltf::json::validation::Checked::Valid;

use super::super::error::SceneError;
use super::super::model::Material;
use super::Document;

/// All materials; emissive textures are applied later, triangle by triangle.
pub(super) fn read(document: &Document<'_>) -> Result<Vec<Material>, SceneError> {
    document
        .root
        .materials
        .iter()
        .enumerate()
        .map(|(index, material)| one(document, index, material))
        .collect()
}

fn one(document: &Document<'_>, index: usize, material: &json::Material) -> Result<Material, SceneError> {
    let element = format!("materials[{index}]");
    let pbr = &material.pbr_metallic_roughness;
    let [r, g, b, _] = pbr.base_color_factor.0;
    let mut base_color = [r, g, b];
    if let Some(info) = &pbr.base_color_texture {
        // Reflection is not textured in the reference renderer; the mean keeps the surface's overall colour.
        let mean = document.texture(info.index, &element)?.mean();
        base_color = [0, 1, 2].map(|i| base_color[i] * mean[i]);
        document.warn(format!(
            "{element}: the base colour texture is replaced by its mean"
        ));
    }
    let strength = material
        .extensions
        .as_ref()
        .and_then(|extensions| extensions.emissive_strength.as_ref())
        .map_or(1.0, |extension| extension.emissive_strength.0);
    // A textured metallic factor of 1 (the default) says nothing about the surface; most of such surfaces are not
    // metal.
    let metallic = if pbr.metallic_roughness_texture.is_some() {
        document.warn(format!(
            "{element}: the metallic-roughness texture is ignored, metallic taken as 0"
        ));
        0.0
    } else {
        pbr.metallic_factor.0
    };
    let masked = material.alpha_mode != Valid(AlphaMode::Opaque);
    if masked {
        document.warn(format!(
            "{element}: the alpha mode is ignored, the surface taken as opaque"
        ));
    }
    Ok(Material {
        name: material.name.clone().unwrap_or_default(),
        base_color,
        radiance: material.emissive_factor.0.map(|channel| channel * strength),
        double_sided: material.double_sided,
        metallic,
        roughness: pbr.roughness_factor.0,
        masked,
    })
}
