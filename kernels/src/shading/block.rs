//! Triangles as the ray BVH holds them.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

/// No triangle, no light.
pub const NONE: u32 = u32::MAX;

/// Triangles that processors test at once, most of one leaf.
pub const LANES: usize = 4;

/// A triangle of the scene; 48 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SurfaceTriangle {
    /// Vertices in world space, metres; counter-clockwise seen from the front.
    pub p: [[f32; 3]; 3],
    /// Index of the material.
    pub material: u32,
    /// The light that it is, as a [`SampledLight`](lightbvh::SampledLight) numbers it, or [`NONE`].
    pub light: u32,
    /// That light's instance; not read where all lights are of one instance.
    pub instance: u32,
}

/// The triangles of a leaf of the ray BVH, lane by lane: processors test them all at once. Triangle `k` of a scene is lane `k % 4` of
/// block `k / 4`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct TriangleBlock {
    /// Coordinates on the grid, metres: by vertex, by axis.
    pub p: [[[f32; LANES]; 3]; 3],
    /// [`SurfaceTriangle::material`]; [`NONE`] where the lane has no triangle.
    pub material: [u32; LANES],
    /// [`SurfaceTriangle::light`].
    pub light: [u32; LANES],
    /// [`SurfaceTriangle::instance`].
    pub instance: [u32; LANES],
}

const _: () = assert!(size_of::<TriangleBlock>() == 48 * LANES);

impl TriangleBlock {
    /// No triangle: points, which no ray meets.
    pub const EMPTY: Self = Self {
        p: [[[0.0; LANES]; 3]; 3],
        material: [NONE; LANES],
        light: [NONE; LANES],
        instance: [NONE; LANES],
    };

    /// The triangle of a lane, if it has one.
    #[must_use]
    pub fn get(&self, lane: usize) -> Option<SurfaceTriangle> {
        (self.material[lane] != NONE).then(|| SurfaceTriangle {
            p: self.p.map(|corner| corner.map(|axis| axis[lane])),
            material: self.material[lane],
            light: self.light[lane],
            instance: self.instance[lane],
        })
    }

    /// Puts a triangle into a lane.
    pub fn set(&mut self, lane: usize, triangle: &SurfaceTriangle) {
        for (corners, corner) in self.p.iter_mut().zip(&triangle.p) {
            for (axis, &value) in corners.iter_mut().zip(corner) {
                axis[lane] = value;
            }
        }
        self.material[lane] = triangle.material;
        self.light[lane] = triangle.light;
        self.instance[lane] = triangle.instance;
    }
}

/// The vertex `k` of triangle `index`.
#[inline(always)]
#[must_use]
pub fn vertex(blocks: &[TriangleBlock], index: u32, k: usize) -> Vec3 {
    let (i, lane) = (index as usize / LANES, index as usize % LANES);
    Vec3::new(
        blocks[i].p[k][0][lane],
        blocks[i].p[k][1][lane],
        blocks[i].p[k][2][lane],
    )
}
