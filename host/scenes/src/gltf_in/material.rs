//! Materials: the factors that the reference renderer uses, their textures, and which texture a surface glows by.

use std::rc::Rc;

use gltf::json;
use gltf::json::material::AlphaMode;
use gltf::json::texture::Info;
use gltf::json::validation::Checked::{Invalid, Valid};

use super::super::error::{SceneError, short};
use super::super::glow::Glow;
use super::super::model::Material;
use super::super::textures::MaterialTextures;
use super::Document;

/// A material, and the texture that its radiance is multiplied by, triangle by triangle.
#[derive(Clone, Default)]
pub(super) struct Look {
    pub material: Material,
    /// With its set of coordinates.
    pub glow: Option<(Rc<Glow>, u32)>,
    /// The set of coordinates of its textures.
    pub set: u32,
    /// Whether it is clear and does not emit: it would hide the lamps behind it.
    pub is_left_out: bool,
}

/// All materials.
pub(super) fn read(document: &Document<'_>) -> Result<Vec<Look>, SceneError> {
    let materials = document.root.materials.iter().enumerate();
    materials
        .map(|(index, material)| look(document, &format!("materials[{index}]"), material))
        .collect()
}

fn look(document: &Document<'_>, element: &str, material: &json::Material) -> Result<Look, SceneError> {
    let none = json::extensions::material::Material::default();
    let extensions = material.extensions.as_ref().unwrap_or(&none);
    let pbr = &material.pbr_metallic_roughness;
    let strength = extensions.emissive_strength.as_ref();
    let strength = strength.map_or(1.0, |extension| extension.emissive_strength.0);
    let mut out = Material {
        name: short(material.name.as_deref().unwrap_or_default()),
        radiance: material.emissive_factor.0.map(|channel| channel * strength),
        double_sided: material.double_sided,
        metallic: pbr.metallic_factor.0,
        roughness: pbr.roughness_factor.0,
        ..Material::default()
    };
    let (mut factor, texture) = (pbr.base_color_factor.0, pbr.base_color_texture.as_ref());
    if pbr.metallic_roughness_texture.is_some() {
        // A textured metallic factor of 1 (the default) says nothing about the surface; most of such surfaces are not metal.
        out.metallic = 0.0;
    }

    if pbr.metallic_roughness_texture.is_some() || material.normal_texture.is_some() {
        document.note(
            element,
            "its textures of normals, metal and roughness are left out",
        );
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
        mean = document.mean(info, element)?.unwrap_or(mean);
    }
    let [r, g, b, opacity] = [0, 1, 2, 3].map(|i| factor[i] * mean[i]);
    out.base_color = [r, g, b];
    let given = material.alpha_cutoff.map_or(0.5, |cutoff| cutoff.0);
    let cutoff = match material.alpha_mode {
        Valid(AlphaMode::Mask) if opacity < 1.0 || given > 1.0 => given,
        Valid(AlphaMode::Blend) if opacity < 1.0 && factor[3] >= 0.5 => 0.5,
        Valid(_) => 0.0,
        Invalid => {
            let what = "its alphaMode is none of OPAQUE, MASK and BLEND, and is taken as OPAQUE";
            document.note(element, what);
            0.0
        }
    };
    let glass = extensions.transmission.as_ref();
    let is_glass = glass.is_some_and(|glass| glass.transmission_factor.0 >= 0.5);
    let is_blended = matches!(material.alpha_mode, Valid(AlphaMode::Blend));
    let is_clear = is_glass || is_blended && factor[3] < 0.5;
    // In [0, 1]; NaN is reported with the material.
    let unit = |x: f32| if x >= 0.0 { x.min(1.0) } else { 0.0 };
    let mut textures = MaterialTextures {
        base: factor.map(unit),
        radiance: out.radiance,
        cutoff,
        ..MaterialTextures::PLAIN
    };
    let of = |info: Option<&Info>| match info {
        Some(info) => document.placed(info, element),
        None => Ok(None),
    };
    let base = of(texture)?;
    // Nothing glows, whatever the texture shows.
    let glow = material.emissive_texture.as_ref();
    let is_named = glow.is_some();
    let glow = of(glow.filter(|_| textures.radiance != [0.0; 3]))?;
    let own_glow = match &glow {
        Some(own) => Some((Rc::new(own.glow(document)?), own.set)),
        None => None,
    };
    if is_named && own_glow.is_none() {
        // What is known to glow somewhere is not taken to glow everywhere.
        (out.radiance, textures.radiance) = ([0.0; 3], [0.0; 3]);
    }
    let set = base.as_ref().or(glow.as_ref()).map_or(0, |own| own.set);
    textures.base_texture = base.map(|own| own.shown(document));
    if let Some(own) = glow {
        if own.set == set {
            textures.glow_texture = Some(own.shown(document));
        } else {
            let what = "its emission texture lies by other coordinates than its base colour, and is replaced by its mean";
            document.note(element, what);
        }
    }
    out.textures = Some(textures).filter(MaterialTextures::is_seen);
    Ok(Look {
        is_left_out: is_clear && out.radiance == [0.0; 3],
        material: out,
        glow: own_glow,
        set,
    })
}
