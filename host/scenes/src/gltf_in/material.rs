//! Materials: the factors that the reference renderer uses, and which texture a surface glows by.

use gltf::json;
use gltf::json::material::AlphaMode;
use gltf::json::texture::Info;
use gltf::json::validation::Checked::{Invalid, Valid};
use serde::Deserialize;
use serde_json::{Map, Value};

use super::super::error::SceneError;
use super::super::model::Material;
use super::super::paint::{Opacity, Paint};
use super::{Document, paint};

/// A material, and the texture that its radiance is multiplied by, triangle by triangle.
#[derive(Default)]
pub(super) struct Look<'a> {
    pub material: Material,
    pub glow: Option<&'a Info>,
    /// By which set of coordinates what is painted on it lies.
    pub set: u32,
    /// Whether it emits the colour that it shows.
    pub is_unlit: bool,
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
        // metal. This is what stands for the texture where it is not shown.
        out.metallic = 0.0;
    }

    // Exporters round: 1.0000001 is 1. NaN stays, to be reported with the material.
    for factor in factor.iter_mut().chain([&mut out.metallic, &mut out.roughness]) {
        if (1.0..1.001).contains(factor) {
            *factor = 1.0;
        }
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
        Valid(AlphaMode::Mask) => out.masked = true,
        Invalid => document.warn(format!(
            "{element}: its alphaMode is none of OPAQUE, MASK and BLEND, and is taken as OPAQUE"
        )),
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
    }
    let glass = transmission(document, others, &element)?;
    out.transmission = out.transmission.max(glass);
    let rough = pbr.metallic_roughness_texture.as_ref();
    let named = paint::Named {
        base: texture,
        rough: rough.filter(|_| glossiness.is_none() && !unlit),
        glow,
    };
    let lit = if unlit { 0.0 } else { 1.0 };
    let textured = named.rough.is_some();
    let factors = Paint {
        base: [factor[0] * lit, factor[1] * lit, factor[2] * lit, factor[3]],
        metallic: if textured {
            pbr.metallic_factor.0
        } else {
            out.metallic
        },
        roughness: out.roughness,
        bump: 0.0,
        radiance: if unlit {
            [factor[0], factor[1], factor[2]]
        } else {
            out.radiance
        },
        base_texture: None,
        rough_texture: None,
        bump_texture: None,
        glow_texture: None,
        opacity: Opacity::Opaque,
        transmission: glass,
    };
    let painted = paint::read(document, &element, material, &named, factors, opacity)?;
    out.paint = painted.map(|painted| painted.paint);
    Ok(Look {
        material: out,
        glow,
        set: painted.map_or(0, |painted| painted.set),
        is_unlit: unlit,
    })
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
