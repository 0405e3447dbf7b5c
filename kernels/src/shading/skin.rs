//! What is painted on surfaces: textures, what is cut out of them, and what light goes through them. A type, so that scenes without
//! pay for nothing.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use lightbvh::exact::{clamp, flush, hash, max, unit_f32};

use super::grid::{STEP, TINY, div};
use super::material::Material;
use super::picture::{Picture, Rgba, word};
use super::pixel::load_material;
use super::ray::Ray;
use super::tangent::bent;
use super::trace::{LANES, NONE, TriangleBlock, vertex};

/// Mode of [`Skin::meets`]: what an eye sees. A surface that covers a part of what is behind it stops as many rays, chosen by the words of
/// the ray.
pub const SEE: u32 = 0;
/// Mode: what a light is found behind. Only what lets nothing through stops the ray.
pub const FIND: u32 = 1;
/// Mode: what is left of light on a shadow ray. Only what lets nothing through stops it.
pub const SHADOW: u32 = 2;
/// Mode: what clear surfaces leave of the light that comes to an eye. Nothing stops the ray.
pub const GLASS: u32 = 3;

/// What is left of light on its way.
pub trait Through: Copy {
    /// All of it.
    const ALL: Self;
    /// None.
    const NOTHING: Self;
    /// Whether there is any.
    fn is_open(self) -> bool;
    /// What is left of `light`.
    fn of(self, light: Vec3) -> Vec3;
}

impl Through for bool {
    const ALL: Self = true;
    const NOTHING: Self = false;

    #[inline(always)]
    fn is_open(self) -> bool {
        self
    }

    #[inline(always)]
    fn of(self, light: Vec3) -> Vec3 {
        light
    }
}

impl Through for Vec3 {
    const ALL: Self = Vec3::ONE;
    const NOTHING: Self = Vec3::ZERO;

    #[inline(always)]
    fn is_open(self) -> bool {
        self.x + self.y + self.z > 0.0
    }

    #[inline(always)]
    fn of(self, light: Vec3) -> Vec3 {
        light * self
    }
}

/// Where on which triangle.
#[derive(Clone, Copy, Debug)]
pub struct Spot {
    /// The triangle's number in a [`Hit`](super::trace::Hit).
    pub triangle: u32,
    /// The parts of its edges from the first vertex.
    pub at: [f32; 2],
}

/// What surfaces are painted with.
pub trait Skin: Copy + Send + Sync {
    /// Whether there is such paint; without, what follows the first method is that of an opaque surface of one material.
    const IS_PAINTED: bool;
    /// What is left of light behind surfaces.
    type Through: Through;

    /// Whether the triangle, which the ray meets, stops it, and what is left of `through` if not. The modes are [`SEE`], [`FIND`],
    /// [`SHADOW`] and [`GLASS`].
    fn meets<const MODE: u32>(
        &self,
        blocks: &[TriangleBlock],
        ray: &Ray,
        triangle: u32,
        through: Self::Through,
    ) -> (bool, Self::Through);

    /// Whether any surface is clear, so that [`GLASS`] has something to find.
    #[inline(always)]
    fn has_glass(&self) -> bool {
        false
    }

    /// How material `index` reflects at a spot.
    #[inline(always)]
    fn material(&self, materials: &[Material], index: u32, _spot: &Spot) -> Material {
        load_material(materials, index)
    }

    /// The normal there, for the geometric `n` on the side of the viewer, who is at `wo`.
    #[inline(always)]
    fn normal(&self, _blocks: &[TriangleBlock], _spot: &Spot, n: Vec3, _wo: Vec3) -> Vec3 {
        n
    }

    /// The radiance of `light` where the parts of its edges are `at`; `emission` is its mean, which it has where nothing is painted on it.
    /// What is cut out does not glow; with `COVERED` what is blended glows as far as it is there.
    #[inline(always)]
    fn glow<const COVERED: bool>(
        &self,
        _blocks: &[TriangleBlock],
        _light: u32,
        _at: [f32; 2],
        emission: [f32; 3],
    ) -> [f32; 3] {
        emission
    }
}

/// No paint: every surface is opaque, and of one material.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoSkin;

impl Skin for NoSkin {
    const IS_PAINTED: bool = false;
    type Through = bool;

    #[inline(always)]
    fn meets<const MODE: u32>(&self, _: &[TriangleBlock], _: &Ray, _: u32, through: bool) -> (bool, bool) {
        (true, through)
    }
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

/// Paint, as buffers hold it.
#[derive(Clone, Copy, Debug)]
pub struct SkinView<'a> {
    /// By the number of a triangle in a [`Hit`](super::trace::Hit), all lanes of all blocks; then by the number of a light.
    pub corners: &'a [Corner],
    /// [`HEADER_WORDS`], [`SRGB_WORDS`], a [`PaintWords`] for each material, pictures. Empty where nothing is painted.
    pub words: &'a [u32],
}

/// Words of the header: how many materials are painted, then [`HAS_GLASS`]; the rest is zero.
pub const HEADER_WORDS: u32 = 8;
/// Of linear numbers by their sRGB bytes.
pub const SRGB_WORDS: u32 = 256;
/// Bit of the header's second word: some material is [clear](PaintWords::CLEAR).
pub const HAS_GLASS: u32 = 1;

/// What is painted on a material.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct PaintWords {
    /// [`CUT`](Self::CUT) and so on.
    pub flags: u32,
    /// Opacity below which a cut surface is not there.
    pub cutoff: f32,
    /// Factor on the base colour, and on the opacity.
    pub base: [f32; 4],
    /// Factors on metallic and roughness.
    pub metallic: f32,
    /// See [`metallic`](Self::metallic).
    pub roughness: f32,
    /// Factor on the two components of normals across.
    pub bump: f32,
    /// Factor on the picture of the emission; not read without one.
    pub emission: [f32; 3],
    /// What of light goes through a clear surface: a factor on its base colour.
    pub transmission: f32,
    /// The word at which the [`PictureWords`](super::picture::PictureWords) of the base colour begins, or [`NONE`].
    pub base_picture: u32,
    /// That of metallic (blue) and roughness (green).
    pub rough_picture: u32,
    /// That of normals.
    pub bump_picture: u32,
    /// That of emission.
    pub emission_picture: u32,
}

const _: () = assert!(size_of::<PaintWords>() == 4 * PaintWords::COUNT as usize);

impl PaintWords {
    /// Words of it.
    pub const COUNT: u32 = 17;
    /// Flag: nothing is there where the opacity is below the cutoff.
    pub const CUT: u32 = 1;
    /// Flag: covers the part of what is behind it that its opacity says.
    pub const BLENDED: u32 = 2;
    /// Flag: light goes through, unless the triangle emits.
    pub const CLEAR: u32 = 4;
    /// Flag: the reflectance is that of these words, not the material's.
    pub const REFLECTS: u32 = 8;
    /// Flag: the factor on the picture of the emission is what the light says, not [`emission`](Self::emission): a photometric profile.
    pub const BY_LIGHT: u32 = 16;
}

/// Where the words of a material begin.
#[inline]
fn paint_at(material: u32) -> u32 {
    HEADER_WORDS + SRGB_WORDS + material.wrapping_mul(PaintWords::COUNT)
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

impl SkinView<'_> {
    #[inline]
    fn has_material(&self, material: u32) -> bool {
        material < word(self.words, 0)
    }

    #[inline]
    fn flags(&self, material: u32) -> u32 {
        let mut flags = 0;
        if self.has_material(material) {
            flags = word(self.words, paint_at(material));
        }
        flags
    }

    #[inline]
    fn number(&self, material: u32, at: u32) -> f32 {
        f32::from_bits(word(self.words, paint_at(material).wrapping_add(at)))
    }

    /// What picture `which` of a material shows, and ones where it has none: base colour, roughness, normals, emission.
    #[inline]
    fn shown(&self, material: u32, which: u32, uv: [f32; 2]) -> Rgba {
        let at = word(
            self.words,
            paint_at(material).wrapping_add(13).wrapping_add(which),
        );
        Picture {
            words: self.words,
            at,
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

    #[inline]
    fn opacity(&self, material: u32, base: &Rgba) -> f32 {
        clamp(self.number(material, 5) * base.a, 0.0, 1.0)
    }

    /// Which part of a spot of a material is there.
    #[inline]
    fn cover(&self, flags: u32, material: u32, base: &Rgba) -> f32 {
        let opacity = self.opacity(material, base);
        if flags & PaintWords::CUT != 0 {
            if opacity >= self.number(material, 1) {
                1.0
            } else {
                0.0
            }
        } else if flags & PaintWords::BLENDED != 0 {
            opacity
        } else {
            1.0
        }
    }
}

/// Flags of what does not simply stop rays.
const LETS_THROUGH: u32 = PaintWords::CUT | PaintWords::BLENDED | PaintWords::CLEAR;

impl Skin for SkinView<'_> {
    const IS_PAINTED: bool = true;
    type Through = Vec3;

    #[inline]
    fn meets<const MODE: u32>(
        &self,
        blocks: &[TriangleBlock],
        ray: &Ray,
        triangle: u32,
        through: Vec3,
    ) -> (bool, Vec3) {
        let (block, lane) = (triangle as usize / LANES, triangle as usize % LANES);
        let material = blocks[block].material[lane];
        let is_light = blocks[block].light[lane] != NONE;
        let flags = self.flags(material);
        let mut stops = MODE != GLASS;
        let mut left = through;
        if flags & LETS_THROUGH != 0 {
            let p0 = vertex(blocks, triangle, 0);
            let at = ray.barycentric(
                p0,
                vertex(blocks, triangle, 1) - p0,
                vertex(blocks, triangle, 2) - p0,
            );
            let uv = between(&self.corner(triangle), at);
            let base = self.shown(material, 0, uv);
            let cover = self.cover(flags, material, &base);
            let is_clear = flags & PaintWords::CLEAR != 0 && !is_light;
            let mut tint = Vec3::splat(1.0 - cover);
            if is_clear {
                // What is there of it is clear.
                let share = self.number(material, 12) * cover;
                tint += Vec3::new(
                    share * clamp(self.number(material, 2) * base.r, 0.0, 1.0),
                    share * clamp(self.number(material, 3) * base.g, 0.0, 1.0),
                    share * clamp(self.number(material, 4) * base.b, 0.0, 1.0),
                );
            }
            if MODE == SHADOW {
                left = passed(through, tint);
                stops = !left.is_open();
            } else if MODE == GLASS {
                if is_clear {
                    left = passed(through, tint);
                }
            } else if is_clear {
                stops = false;
            } else if MODE == SEE {
                let d = ray.direction;
                let words = hash(d.x.to_bits() ^ hash(d.y.to_bits() ^ hash(d.z.to_bits() ^ hash(triangle))));
                stops = unit_f32(words) < cover;
            } else {
                // A light is found wherever there is any of it.
                stops = if is_light { cover > 0.0 } else { cover >= 1.0 };
            }
        }
        (stops, left)
    }

    #[inline]
    fn has_glass(&self) -> bool {
        word(self.words, 1) & HAS_GLASS != 0
    }

    #[inline]
    fn material(&self, materials: &[Material], index: u32, spot: &Spot) -> Material {
        let mut material = load_material(materials, index);
        if self.flags(index) & PaintWords::REFLECTS != 0 {
            let uv = between(&self.corner(spot.triangle), spot.at);
            let base = self.shown(index, 0, uv);
            let rough = self.shown(index, 1, uv);
            let albedo = [
                clamp(self.number(index, 2) * base.r, 0.0, 1.0),
                clamp(self.number(index, 3) * base.g, 0.0, 1.0),
                clamp(self.number(index, 4) * base.b, 0.0, 1.0),
            ];
            material = Material::of(
                albedo,
                clamp(self.number(index, 6) * rough.b, 0.0, 1.0),
                clamp(self.number(index, 7) * rough.g, 0.0, 1.0),
            );
        }
        material
    }

    #[inline]
    fn normal(&self, blocks: &[TriangleBlock], spot: &Spot, n: Vec3, wo: Vec3) -> Vec3 {
        let (block, lane) = (spot.triangle as usize / LANES, spot.triangle as usize % LANES);
        let material = blocks[block].material[lane];
        let mut normal = n;
        if self.has_material(material) && word(self.words, paint_at(material).wrapping_add(15)) != NONE {
            let corner = self.corner(spot.triangle);
            let map = self.shown(material, 2, between(&corner, spot.at));
            let bump = self.number(material, 8);
            let across = [(map.r + map.r - 1.0) * bump, (map.g + map.g - 1.0) * bump];
            let p0 = vertex(blocks, spot.triangle, 0);
            let (e1, e2) = (
                vertex(blocks, spot.triangle, 1) - p0,
                vertex(blocks, spot.triangle, 2) - p0,
            );
            let [[u, v], [u1, v1], [u2, v2]] = corner.uv;
            let grown = [[u1 - u, v1 - v], [u2 - u, v2 - v]];
            normal = bent(
                n,
                wo,
                [e1, e2],
                grown,
                [across[0], across[1], map.b + map.b - 1.0],
            );
        }
        normal
    }

    #[inline]
    fn glow<const COVERED: bool>(
        &self,
        blocks: &[TriangleBlock],
        light: u32,
        at: [f32; 2],
        emission: [f32; 3],
    ) -> [f32; 3] {
        let corner = self.corner(((blocks.len() * LANES) as u32).wrapping_add(light));
        let mut glow = emission;
        let material = corner.material;
        if self.has_material(material) {
            let uv = between(&corner, at);
            let flags = self.flags(material);
            let mut cover = 1.0;
            if flags & (PaintWords::CUT | PaintWords::BLENDED) != 0 {
                let base = self.shown(material, 0, uv);
                cover = self.cover(flags, material, &base);
                if !COVERED && cover > 0.0 {
                    cover = 1.0;
                }
            }
            let shown = self.shown(material, 3, uv);
            let share = |factor: f32, texel: f32| flush(factor * (texel * cover), TINY);
            // Without a picture of it, emission is what the light says: it may differ from triangle to triangle.
            let is_shown = flags & PaintWords::BY_LIGHT == 0
                && word(self.words, paint_at(material).wrapping_add(16)) != NONE;
            let own = |at: u32, mean: f32| if is_shown { self.number(material, at) } else { mean };
            glow = [
                share(own(9, emission[0]), shown.r),
                share(own(10, emission[1]), shown.g),
                share(own(11, emission[2]), shown.b),
            ];
        }
        glow
    }
}

/// What `tint` leaves of `through`; no number is tiny.
#[inline]
fn passed(through: Vec3, tint: Vec3) -> Vec3 {
    Vec3::new(
        flush(through.x * tint.x, STEP),
        flush(through.y * tint.y, STEP),
        flush(through.z * tint.z, STEP),
    )
}

/// Least width of a lobe.
const LEAST_ALPHA: f32 = 1.0 / 32.0;

/// Metal and roughness as the two lobes have them.
impl Material {
    /// The reflectance of a surface of this base colour; each number in [0, 1].
    ///
    /// Normal-incidence reflectance is 0.04 for dielectrics and the base colour for metals (glTF 2.0, appendix B.2).
    /// The exponent follows Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces",
    /// section 5.2: n = 2/α² - 2 with α = roughness², rounded down to a power of two. The glossy lobe is white, so a metal keeps its
    /// colour in the diffuse lobe that is left.
    #[cfg_attr(target_arch = "spirv", inline(never))]
    #[cfg_attr(not(target_arch = "spirv"), inline)]
    #[must_use]
    pub fn of(base_color: [f32; 3], metallic: f32, roughness: f32) -> Self {
        let [r, g, b] = base_color;
        let luminance = (0.2126 * r + 0.7152 * g) + 0.0722 * b;
        let alpha = max(roughness * roughness, LEAST_ALPHA);
        let exponent = clamp(div(2.0, alpha * alpha) - 2.0, 1.0, 1024.0);
        Self {
            albedo: base_color,
            specular: 0.04 * (1.0 - metallic) + luminance * metallic,
            exponent_log2: (exponent.to_bits() >> 23) - 127,
        }
    }
}
