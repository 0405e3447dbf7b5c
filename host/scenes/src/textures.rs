//! Textures of materials: pictures, their places, and what each of them changes.

use std::sync::Arc;

/// Largest width or height of a picture.
pub const MAX_SIDE: u32 = 1 << 14;

/// A picture: red, green and blue, encoded (IEC 61966-2-1), and opacity, a byte each, by rows from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Columns, from 1 to [`MAX_SIDE`].
    pub width: u32,
    /// Rows, from 1 to [`MAX_SIDE`].
    pub height: u32,
    /// Four bytes for each texel.
    pub texels: Arc<Vec<u8>>,
}

/// How a picture goes on beyond its edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// It begins anew.
    #[default]
    Repeat,
    /// As at its edges.
    Clamp,
    /// Mirrored.
    Mirror,
}

/// A picture on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Texture {
    /// Index into [`SceneData::pictures`](super::SceneData::pictures).
    pub picture: u32,
    /// Whether each point shows the nearest texel, and not a mean of four.
    pub is_nearest: bool,
    /// Beyond its edges, along columns and along rows.
    pub wrap: [Wrap; 2],
    /// Where coordinates lie on it: what each coordinate adds, and where the origin goes.
    pub transform: [[f32; 2]; 3],
}

/// No change of coordinates.
pub const IN_PLACE: [[f32; 2]; 3] = [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]];

/// Factors of a material, and the textures that they multiply. The reference renderer shows them where it shows all kinds of light; where
/// it shows triangles alone, the means in [`Material`](super::Material) stand for them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MaterialTextures {
    /// Base colour, linear RGB, and opacity, each in [0, 1].
    pub base: [f32; 4],
    /// Radiance, W/(m² sr).
    pub radiance: [f32; 3],
    /// Of the base colour and the opacity.
    pub base_texture: Option<Texture>,
    /// Of the radiance.
    pub glow_texture: Option<Texture>,
    /// Opacity below which the surface is not there; 0 where it is there everywhere.
    pub cutoff: f32,
}

impl MaterialTextures {
    /// White, opaque, without a texture.
    pub const PLAIN: Self = Self {
        base: [1.0; 4],
        radiance: [0.0; 3],
        base_texture: None,
        glow_texture: None,
        cutoff: 0.0,
    };

    /// Its textures, with their names.
    pub fn all(&self) -> impl Iterator<Item = (&'static str, Texture)> {
        [
            ("base colour", self.base_texture),
            ("emission", self.glow_texture),
        ]
        .into_iter()
        .filter_map(|(name, texture)| Some((name, texture?)))
    }

    /// Whether it shows anything that means do not.
    pub fn is_seen(&self) -> bool {
        self.all().next().is_some() || self.cutoff > 0.0
    }
}
