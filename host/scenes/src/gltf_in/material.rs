//! Materials: the factors that the reference renderer uses, what is painted on them, and which texture a surface glows by.

use std::rc::Rc;

use gltf::json;
use gltf::json::material::AlphaMode;
use gltf::json::texture::Info;
use gltf::json::validation::Checked::{Invalid, Valid};

use super::super::error::SceneError;
use super::super::glow::Glow;
use super::super::model::Material;
use super::super::paint::{Opacity, Paint};
use super::Document;
use super::texture::{Named, Placed};

/// A material, and the texture that its radiance is multiplied by, triangle by triangle.
#[derive(Clone, Default)]
pub(super) struct Look {
    pub material: Material,
    /// With its set of coordinates.
    pub glow: Option<(Rc<Glow>, u32)>,
    /// By which set of coordinates what is painted on it lies.
    pub set: u32,
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
        name: material.name.clone().unwrap_or_default(),
        radiance: material.emissive_factor.0.map(|channel| channel * strength),
        double_sided: material.double_sided,
        metallic: pbr.metallic_factor.0,
        roughness: pbr.roughness_factor.0,
        ..Material::default()
    };
    let (mut factor, mut texture) = (pbr.base_color_factor.0, pbr.base_color_texture.as_ref());
    let glossiness = extensions.pbr_specular_glossiness.as_ref();
    let mut rough = pbr.metallic_roughness_texture.as_ref();
    if let Some(glossiness) = glossiness {
        (factor, texture) = (glossiness.diffuse_factor.0, glossiness.diffuse_texture.as_ref());
        (out.metallic, out.roughness) = (0.0, 1.0 - glossiness.glossiness_factor.0);
        rough = None;
    } else if rough.is_some() {
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
        mean = document.mean(info, element, true)?.unwrap_or(mean);
    }
    let [r, g, b, opacity] = [0, 1, 2, 3].map(|i| factor[i] * mean[i]);
    match material.alpha_mode {
        Valid(AlphaMode::Opaque) => {}
        Valid(AlphaMode::Blend) => {
            // NaN stays, to be reported with the material.
            out.transmission = if opacity > 1.0 { 0.0 } else { 1.0 - opacity };
        }
        Valid(AlphaMode::Mask) => out.masked = true,
        Invalid => document.note(
            element,
            "its alphaMode is none of OPAQUE, MASK and BLEND, and is taken as OPAQUE",
        ),
    }
    let [red, green, blue, _] = factor;
    let mut paint = Paint {
        base: factor,
        metallic: if rough.is_some() {
            pbr.metallic_factor.0
        } else {
            out.metallic
        },
        roughness: out.roughness,
        radiance: out.radiance,
        ..Paint::PLAIN
    };
    let mut glow = material.emissive_texture.as_ref();
    let is_unlit = extensions.unlit.is_some();
    if is_unlit {
        // It shows its colour whatever light falls on it: what glows so, and reflects nothing.
        glow = pbr.base_color_texture.as_ref().filter(|_| glossiness.is_none());
        rough = None;
        paint.base = [0.0, 0.0, 0.0, factor[3]];
        (paint.metallic, paint.radiance) = (1.0, [red, green, blue]);
        let own = if glow.is_some() { paint.radiance } else { [r, g, b] };
        let shown = 1.0 - out.transmission;
        out.radiance = own.map(|channel| channel * shown);
        (out.base_color, out.metallic) = ([0.0; 3], 1.0);
    } else {
        out.base_color = [r, g, b];
    }
    if let Some(glass) = &extensions.transmission {
        let mean = match &glass.transmission_texture {
            Some(info) => document.mean(info, element, false)?,
            None => None,
        };
        paint.transmission = glass.transmission_factor.0 * mean.map_or(1.0, |mean| mean[0]);
    }
    out.transmission = out.transmission.max(paint.transmission);
    let mut set = None;
    let mut lie = |placed: Option<Placed>, what: &str, is_color: bool| {
        let placed = placed?;
        let (own, set) = (placed.set, *set.get_or_insert(placed.set));
        if own != set {
            let what = format!(
                "its {what} texture lies by TEXCOORD_{own}, the one before it by TEXCOORD_{set}, and is replaced by its mean"
            );
            document.note(element, what);
        }
        (own == set).then(|| placed.shown(document, is_color))
    };
    let of = |info: Option<&Info>| match info {
        Some(info) => document.placed(&Named::from(info), element),
        None => Ok(None),
    };
    paint.base_texture = lie(of(texture)?, "base colour", true);
    paint.rough_texture = lie(of(rough)?, "metallic-roughness", false);
    if let Some(normal) = &material.normal_texture {
        let named = Named {
            index: normal.index,
            set: normal.tex_coord,
            transform: match &normal.extensions {
                Some(own) => document.extension(&own.others, "KHR_texture_transform", element)?,
                None => None,
            },
        };
        paint.bump_texture = lie(document.placed(&named, element)?, "normal", false);
        paint.bump = paint.bump_texture.map_or(0.0, |_| normal.scale);
    }
    // Nothing glows, whatever the texture shows.
    let is_named = glow.is_some();
    let glow = of(glow.filter(|_| paint.radiance != [0.0; 3]))?;
    let own_glow = match &glow {
        Some(own) => Some((Rc::new(own.glow(document)?), own.set)),
        None => None,
    };
    if is_named && own_glow.is_none() && !is_unlit {
        // What is known to glow somewhere is not taken to glow everywhere; unlit surfaces have a colour in any case.
        (out.radiance, paint.radiance) = ([0.0; 3], [0.0; 3]);
    }
    paint.glow_texture = lie(glow, "emission", true);
    let cutoff = material.alpha_cutoff.map_or(0.5, |cutoff| cutoff.0);
    paint.opacity = match material.alpha_mode {
        Valid(AlphaMode::Mask) if opacity < 1.0 || cutoff > 1.0 => Opacity::Cut(cutoff),
        Valid(AlphaMode::Blend) if opacity < 1.0 => Opacity::Blended,
        _ => Opacity::Opaque,
    };
    // In [0, 1]; NaN is reported with the material.
    let unit = |x: f32| if x >= 0.0 { x.min(1.0) } else { 0.0 };
    paint.base = paint.base.map(unit);
    for factor in [&mut paint.metallic, &mut paint.roughness, &mut paint.transmission] {
        *factor = unit(*factor);
    }
    out.paint = Some(paint).filter(Paint::is_seen);
    Ok(Look {
        material: out,
        glow: own_glow,
        set: set.unwrap_or(0),
    })
}
