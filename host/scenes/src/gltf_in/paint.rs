//! What is painted on materials: textures that the reference renderer shows.

use gltf::json;
use gltf::json::material::AlphaMode;
use gltf::json::texture::Info;
use gltf::json::validation::Checked::Valid;
use serde_json::{Map, Value};

use super::super::error::SceneError;
use super::super::paint::{Opacity, Paint, Texture};
use super::Document;

/// What a material is painted with, and by which set of coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Painted {
    pub paint: Paint,
    /// `TEXCOORD_` and this.
    pub set: u32,
}

/// The textures of a material, of which each that is missing counts as ones.
pub(super) struct Named<'a> {
    pub base: Option<&'a Info>,
    pub rough: Option<&'a Info>,
    pub glow: Option<&'a Info>,
}

/// What is painted on `material`, where any of it is to be seen. `factors` are those without textures, `opacity` is the mean.
pub(super) fn read(
    document: &Document<'_>,
    element: &str,
    material: &json::Material,
    named: &Named<'_>,
    factors: Paint,
    opacity: f32,
) -> Result<Option<Painted>, SceneError> {
    let mut paint = factors;
    let mut set = None;
    let mut lie = |found: Option<(Texture, u32)>, what: &str| {
        let (texture, own) = found?;
        let set = *set.get_or_insert(own);
        if own != set {
            document.warn(format!(
                "{element}: its {what} texture lies by TEXCOORD_{own}, the one before it by TEXCOORD_{set}, and is replaced by its mean"
            ));
        }
        (own == set).then_some(texture)
    };
    let of = |info: Option<&Info>, is_color| -> Result<Option<(Texture, u32)>, SceneError> {
        let Some(info) = info else { return Ok(None) };
        let others = info.extensions.as_ref().map(|extensions| &extensions.others);
        document.shown(info.index, info.tex_coord, others, element, is_color)
    };
    paint.base_texture = lie(of(named.base, true)?, "base colour");
    paint.rough_texture = lie(of(named.rough, false)?, "metallic-roughness");
    if let Some(normal) = &material.normal_texture {
        let others = normal.extensions.as_ref().map(|extensions| &extensions.others);
        let found = document.shown(normal.index, normal.tex_coord, others, element, false)?;
        paint.bump_texture = lie(found, "normal");
        paint.bump = normal.scale;
    }
    if paint.radiance != [0.0; 3] {
        paint.glow_texture = lie(of(named.glow, true)?, "emission");
    }
    let cutoff = material.alpha_cutoff.map_or(0.5, |cutoff| cutoff.0);
    paint.opacity = match material.alpha_mode {
        Valid(AlphaMode::Mask) if opacity < 1.0 || cutoff > 1.0 => Opacity::Cut(cutoff),
        // All of it is there.
        _ if opacity >= 1.0 => Opacity::Opaque,
        Valid(AlphaMode::Blend) => Opacity::Blended,
        _ => Opacity::Opaque,
    };
    let [base, metal] = [
        paint.base.map(unit),
        [paint.metallic, paint.roughness, paint.transmission, 0.0].map(unit),
    ];
    paint.base = base;
    [paint.metallic, paint.roughness, paint.transmission, _] = metal;
    Ok(paint.is_seen().then_some(Painted {
        paint,
        set: set.unwrap_or(0),
    }))
}

/// In [0, 1]; what is not a number was found out before, or is here.
fn unit(x: f32) -> f32 {
    if x >= 0.0 { x.min(1.0) } else { 0.0 }
}

impl Document<'_> {
    /// A texture as the renderer shows it, and by which set of coordinates; `None` where its picture cannot be had, which is noted.
    fn shown(
        &self,
        index: json::Index<json::Texture>,
        set: u32,
        others: Option<&Map<String, Value>>,
        element: &str,
        is_color: bool,
    ) -> Result<Option<(Texture, u32)>, SceneError> {
        let Some(picture) = self.kept(index, element)? else {
            return Ok(None);
        };
        let (wrap, is_nearest) = self.sampler(index, element)?;
        let transform = self.transform(others, element)?;
        let set = transform.tex_coord.unwrap_or(set);
        Ok(Some((
            Texture {
                picture,
                is_color,
                is_nearest,
                wrap,
                transform: transform.columns(),
            },
            set,
        )))
    }
}
