//! Textures of surfaces, and cut-outs. A type, so that scenes without textures pay nothing for them.

use bytemuck::{Pod, Zeroable};
use lightbvh::exact::{clamp, flush};

use super::block::{LANES, NONE, TriangleBlock, vertex};
use super::grid::{STEP, TINY};
use super::material::Material;
use super::picture::{HEADER_WORDS, Picture, Rgba, SRGB_WORDS, word};
use super::ray::Ray;

/// Where on which triangle.
#[derive(Clone, Copy, Debug)]
pub struct Spot {
    /// The triangle's number in a [`Hit`](super::trace::Hit).
    pub triangle: u32,
    /// The parts of its edges from the first vertex.
    pub at: [f32; 2],
}

/// The textures of a scene.
pub trait Textures: Copy + Send + Sync {
    /// Whether there are any; without them every surface is opaque and of one material.
    const HAS_TEXTURES: bool;

    /// Whether the triangle, which the ray meets, is there and not cut out.
    #[inline(always)]
    fn stops(&self, _blocks: &[TriangleBlock], _ray: &Ray, _triangle: u32) -> bool {
        true
    }

    /// How material `index` reflects at a spot.
    #[inline(always)]
    fn material(&self, materials: &[Material], index: u32, _spot: &Spot) -> Material {
        Material::load(materials, index)
    }

    /// The radiance of `light` where the parts of its edges are `at`; `emission` is its mean, which it has without a texture.
    /// What is cut out does not glow.
    #[inline(always)]
    fn glow(&self, _blocks: &[TriangleBlock], _light: u32, _at: [f32; 2], emission: [f32; 3]) -> [f32; 3] {
        emission
    }
}

/// No textures: every surface is opaque, and of one material.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoTextures;

impl Textures for NoTextures {
    const HAS_TEXTURES: bool = false;
}

/// Where a triangle lies on textures; 28 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Corner {
    /// Texture coordinates of its vertices; magnitude at most 2^20.
    pub uv: [[f32; 2]; 3],
    /// The material of a light; not read of surfaces.
    pub material: u32,
}

const _: () = assert!(size_of::<Corner>() == 28);

/// Textures in buffers.
#[derive(Clone, Copy, Debug)]
pub struct TextureView<'a> {
    /// By the number of a triangle in a [`Hit`](super::trace::Hit), all lanes of all blocks; then by the number of a light.
    pub corners: &'a [Corner],
    /// [`HEADER_WORDS`], of which the first is the number of materials, [`SRGB_WORDS`], a [`MaterialWords`] for each material,
    /// pictures. Empty without textures.
    pub words: &'a [u32],
}

/// Textures of a material.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct MaterialWords {
    /// Opacity below which the surface is not there; 0 where it is there everywhere.
    pub cutoff: f32,
    /// Factor on the base colour, and on the opacity.
    pub base: [f32; 4],
    /// Factor on the picture of the emission; not read without one.
    pub emission: [f32; 3],
    /// The word at which the [`PictureWords`](super::picture::PictureWords) of the base colour begins, or [`NONE`].
    pub base_picture: u32,
    /// That of emission.
    pub emission_picture: u32,
}

const _: () = assert!(size_of::<MaterialWords>() == 4 * MaterialWords::COUNT as usize);

impl MaterialWords {
    /// Words of it.
    pub const COUNT: u32 = 10;
}

/// Words of a [`MaterialWords`] by their places.
const CUTOFF: u32 = 0;
const BASE: u32 = 1;
const EMISSION: u32 = 5;
const BASE_PICTURE: u32 = 8;
const EMISSION_PICTURE: u32 = 9;

/// Where the words of a material begin.
#[inline]
fn material_at(material: u32) -> u32 {
    HEADER_WORDS + SRGB_WORDS + material.wrapping_mul(MaterialWords::COUNT)
}

/// A point between texture coordinates, by the parts of the edges.
#[inline]
fn between(corner: &Corner, at: [f32; 2]) -> [f32; 2] {
    let [a, b] = at;
    let along = |k: usize| {
        let u = corner.uv[0][k];
        flush((u + (corner.uv[1][k] - u) * a) + (corner.uv[2][k] - u) * b, STEP)
    };
    [along(0), along(1)]
}

impl TextureView<'_> {
    #[inline]
    fn has_material(&self, material: u32) -> bool {
        material < word(self.words, 0)
    }

    #[inline]
    fn word(&self, material: u32, at: u32) -> u32 {
        word(self.words, material_at(material).wrapping_add(at))
    }

    #[inline]
    fn number(&self, material: u32, at: u32) -> f32 {
        f32::from_bits(self.word(material, at))
    }

    /// What the picture of a material shows whose place is word `at`, and ones where it has none.
    #[inline]
    fn shown(&self, material: u32, at: u32, uv: [f32; 2]) -> Rgba {
        Picture {
            words: self.words,
            at: self.word(material, at),
        }
        .at(uv)
    }

    #[inline]
    fn corner(&self, index: u32) -> Corner {
        let mut corner = Corner {
            uv: [[0.0; 2]; 3],
            material: NONE,
        };
        if index < self.corners.len() as u32 {
            corner = self.corners[index as usize];
        }
        corner
    }

    /// Whether a material has places where it is not there.
    #[inline]
    fn is_cut(&self, material: u32) -> bool {
        self.has_material(material) && self.number(material, CUTOFF) > 0.0
    }

    /// Whether a spot of a material that is cut is there.
    #[inline]
    fn is_there(&self, material: u32, uv: [f32; 2]) -> bool {
        let base = self.shown(material, BASE_PICTURE, uv);
        let opacity = clamp(self.number(material, BASE + 3) * base.a, 0.0, 1.0);
        opacity >= self.number(material, CUTOFF)
    }
}

impl Textures for TextureView<'_> {
    const HAS_TEXTURES: bool = true;

    #[inline]
    fn stops(&self, blocks: &[TriangleBlock], ray: &Ray, triangle: u32) -> bool {
        let material = blocks[triangle as usize / LANES].material[triangle as usize % LANES];
        let mut stops = true;
        if self.is_cut(material) {
            let p0 = vertex(blocks, triangle, 0);
            let at = ray.barycentric(
                p0,
                vertex(blocks, triangle, 1) - p0,
                vertex(blocks, triangle, 2) - p0,
            );
            stops = self.is_there(material, between(&self.corner(triangle), at));
        }
        stops
    }

    #[inline]
    fn material(&self, materials: &[Material], index: u32, spot: &Spot) -> Material {
        let mut material = Material::load(materials, index);
        if self.has_material(index) && self.word(index, BASE_PICTURE) != NONE {
            let uv = between(&self.corner(spot.triangle), spot.at);
            let base = self.shown(index, BASE_PICTURE, uv);
            material.albedo = [
                clamp(self.number(index, BASE) * base.r, 0.0, 1.0),
                clamp(self.number(index, BASE + 1) * base.g, 0.0, 1.0),
                clamp(self.number(index, BASE + 2) * base.b, 0.0, 1.0),
            ];
        }
        material
    }

    #[inline]
    fn glow(&self, blocks: &[TriangleBlock], light: u32, at: [f32; 2], emission: [f32; 3]) -> [f32; 3] {
        let corner = self.corner(((blocks.len() * LANES) as u32).wrapping_add(light));
        let mut glow = emission;
        let material = corner.material;
        if self.has_material(material) {
            let uv = between(&corner, at);
            let shown = self.shown(material, EMISSION_PICTURE, uv);
            // Without a picture of it, emission is what the light says: it may differ from triangle to triangle.
            let is_shown = self.word(material, EMISSION_PICTURE) != NONE;
            let own = |k: u32, mean: f32| {
                if is_shown {
                    self.number(material, EMISSION + k)
                } else {
                    mean
                }
            };
            glow = [
                flush(own(0, emission[0]) * shown.r, TINY),
                flush(own(1, emission[1]) * shown.g, TINY),
                flush(own(2, emission[2]) * shown.b, TINY),
            ];
            if self.is_cut(material) && !self.is_there(material, uv) {
                glow = [0.0; 3];
            }
        }
        glow
    }
}
