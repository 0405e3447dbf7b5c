//! Materials: the factors that the reference renderer uses, and which texture a surface glows by.

use gltf::json;
use gltf::json::material::AlphaMode;
use gltf::json::texture::Info;
use gltf::json::validation::Checked::Valid;
use serde::Deserialize;
use serde_json::{Map, Value};

use super::super::error::SceneError;
use super::super::model::Material;
use super::Document;

/// A material, and the texture that its radiance is multiplied by, triangle by triangle.
#[derive(Default)]
pub(super) struct Look<'a> {
    pub material: Material,
    pub glow: Option<&'a Info>,
}

/// `KHR_materials_transmission`.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Transmission {
    #[serde(default)]
    transmission_factor: f32,
    transmission_texture: Option<Info>,
}

/// `KHR_materials_pbrSpecularGlossiness`, which came before metal and roughness.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Glossiness {
    #[serde(default = "ones")]
    diffuse_factor: [f32; 4],
    diffuse_texture: Option<Info>,
    #[serde(default = "one")]
    glossiness_factor: f32,
}

fn ones() -> [f32; 4] {
    [1.0; 4]
}

fn one() -> f32 {
    1.0
}

/// All materials.
pub(super) fn read<'a>(document: &Document<'a>) -> Result<Vec<Look<'a>>, SceneError> {
    let root: &'a json::Root = document.root;
    root.materials
        .iter()
        .enumerate()
        .map(|(index, material)| look(document, index, material))
        .collect()
}

fn look<'a>(
    document: &Document<'a>,
    index: usize,
    material: &'a json::Material,
) -> Result<Look<'a>, SceneError> {
    let element = format!("materials[{index}]");
    let none = Map::new();
    let extensions = material.extensions.as_ref();
    let others = extensions.map_or(&none, |extensions| &extensions.others);
    let pbr = &material.pbr_metallic_roughness;
    let strength = extensions
        .and_then(|extensions| extensions.emissive_strength.as_ref())
        .map_or(1.0, |extension| extension.emissive_strength.0);
    let mut out = Material {
        name: material.name.clone().unwrap_or_default(),
        radiance: material.emissive_factor.0.map(|channel| channel * strength),
        double_sided: material.double_sided,
        metallic: pbr.metallic_factor.0,
        roughness: pbr.roughness_factor.0,
        ..Material::default()
    };
    let mut glow = material.emissive_texture.as_ref();
    let (mut factor, mut texture) = (pbr.base_color_factor.0, pbr.base_color_texture.as_ref());
    let glossiness: Option<Glossiness> =
        document.extension(others, "KHR_materials_pbrSpecularGlossiness", &element)?;
    if let Some(glossiness) = &glossiness {
        (factor, texture) = (glossiness.diffuse_factor, glossiness.diffuse_texture.as_ref());
        (out.metallic, out.roughness) = (0.0, 1.0 - glossiness.glossiness_factor);
    } else if pbr.metallic_roughness_texture.is_some() {
        // A textured metallic factor of 1 (the default) says nothing about the surface; most of such surfaces are not
        // metal.
        document.warn(format!(
            "{element}: the metallic-roughness texture is ignored, metallic taken as 0"
        ));
        out.metallic = 0.0;
    }

    // A texture that cannot be had counts as white.
    let mut mean = [1.0; 4];
    if let Some(info) = texture {
        mean = document.mean_color(info.index, &element)?.unwrap_or(mean);
    }
    let [r, g, b, opacity] = [0, 1, 2, 3].map(|i| factor[i] * mean[i]);
    let unlit = others.contains_key("KHR_materials_unlit");
    match material.alpha_mode {
        Valid(AlphaMode::Opaque) => {}
        Valid(AlphaMode::Blend) => {
            // NaN stays, to be reported with the material.
            out.transmission = if opacity > 1.0 { 0.0 } else { 1.0 - opacity };
        }
        _ => {
            out.masked = true;
            document.warn(format!(
                "{element}: the alpha mode is ignored, the surface taken as opaque"
            ));
        }
    }
    if unlit {
        // It shows its colour whatever light falls on it: what glows so, and reflects nothing.
        glow = pbr.base_color_texture.as_ref().filter(|_| glossiness.is_none());
        let own = if glow.is_some() {
            [factor[0], factor[1], factor[2]]
        } else {
            [r, g, b]
        };
        let shown = 1.0 - out.transmission;
        out.radiance = own.map(|channel| channel * shown);
        (out.base_color, out.metallic) = ([0.0; 3], 1.0);
        document.warn(format!(
            "{element} is unlit: its colour is emitted, and lights what is near"
        ));
    } else {
        out.base_color = [r, g, b];
        if texture.is_some() {
            // Reflection is not textured in the reference renderer; the mean keeps the surface's overall colour.
            document.warn(format!(
                "{element}: the base colour texture is replaced by its mean"
            ));
        }
    }
    out.transmission = out.transmission.max(transmission(document, others, &element)?);
    if out.is_clear() {
        document.warn(format!(
            "{element} lets {:.0} % of light through: its surfaces are left out unless they emit",
            100.0 * out.transmission
        ));
    }
    Ok(Look { material: out, glow })
}

/// The mean share of light that goes through.
fn transmission(
    document: &Document<'_>,
    others: &Map<String, Value>,
    element: &str,
) -> Result<f32, SceneError> {
    let found: Option<Transmission> = document.extension(others, "KHR_materials_transmission", element)?;
    let Some(found) = found else { return Ok(0.0) };
    let mut share = found.transmission_factor;
    if let Some(info) = &found.transmission_texture
        && let Some(mean) = document.mean_values(info.index, element)?
    {
        share *= mean[0];
    }
    Ok(share)
}
