//! Pass `render`: direct lighting, one invocation per pixel. Reads the scene, the ray BVH and whatever the picker chooses
//! lights by; writes the pixel.

use bytemuck::{Pod, Zeroable};
use glam::{UVec3, Vec3};
use lightbvh::exact::hash;
use lightbvh::light::AnyLight;
use lightbvh::light::infinite::DistantLight;
use lightbvh::{EmissiveTriangle, Instance};
use spirv_std::spirv;

use crate::bvh::{Kinds, NodeOf, Paper, Standard, TreeOf};
use crate::invocation;
use crate::shading::camera::Camera;
use crate::shading::emitter::Emitter;
use crate::shading::material::Material;
use crate::shading::numbers::Part;
use crate::shading::pick::{PickLight, Power, Uniform};
use crate::shading::pixel::{Samples, Scene, reflected, see};
use crate::shading::skin::{Corner, NoSkin, SkinView};
use crate::shading::sky::{NoSky, SkyView};
use crate::shading::trace::{RayNode, TriangleBlock};
use lightbvh::TreeWords;

/// What all pixels of an image have in common besides the scene; push constants, 56 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct RenderParams {
    /// Columns, 1 to 2^24.
    pub width: u32,
    /// Rows, 1 to 2^24.
    pub height: u32,
    /// Lights sampled for each pixel, at most 2^24.
    pub samples: u32,
    /// Number of the first of them among `all`: a pixel may have more samples than one image takes, which images then take one after the
    /// other. Paths have none.
    pub first: u32,
    /// Samples of a pixel that are spread evenly among each other; 0 counts as `samples`.
    pub all: u32,
    /// Candidates of each light sample, at most [`MAX_CANDIDATES`](crate::shading::pixel::MAX_CANDIDATES); 0 and 1 for a
    /// light as picked. Paths take no candidates.
    pub candidates: u32,
    /// Directions that the surface reflects into whose lights join the candidates of each light sample, at most
    /// [`MAX_SCATTERED`](crate::shading::candidates::MAX_SCATTERED). Paths take none.
    pub scattered: u32,
    /// Chooses the random numbers of the lights. Images that differ in nothing else show the same surfaces.
    pub seed: u32,
    /// Which of `parts` this image is, whose mean has the samples of all: their numbers lie between each other's. Paths have none.
    pub part: u32,
    /// How many such images there are; 0 counts as 1.
    pub parts: u32,
    /// Chooses the points within the pixels that camera rays go through, evenly spread for successive numbers: the mean over several is smooth at
    /// edges.
    pub jitter: u32,
    /// Radiance of what no surface covers, linear RGB, W/(m² sr).
    pub background: [f32; 3],
}

const _: () = assert!(size_of::<RenderParams>() == 56);

/// The radiance that reaches the camera through pixel `index`, linear RGB, W/(m² sr). Pixels are numbered by rows from
/// the upper left.
#[inline]
#[must_use]
pub fn render_pixel<L: Emitter, P: PickLight>(
    scene: &Scene<'_, L>,
    camera: &Camera,
    params: &RenderParams,
    picker: &P,
    index: u32,
) -> [f32; 3] {
    let width = if params.width == 0 { 1 } else { params.width };
    let y = index / width;
    let x = index - y * width;
    let pixel = hash(index);
    let ray = camera.ray([x, y], [width, params.height], pixel, params.jitter);
    let background = Vec3::new(params.background[0], params.background[1], params.background[2]);
    let seen = see(scene, &ray, background);
    let seed = hash(pixel.wrapping_add(hash(params.seed)));
    let samples = Samples {
        count: params.samples,
        first: params.first,
        all: if params.all == 0 {
            params.samples
        } else {
            params.all
        },
        candidates: params.candidates,
        scattered: params.scattered,
        part: Part {
            index: params.part,
            of: params.parts,
        },
    };
    let radiance = seen.direct + reflected(scene, &seen, picker, samples, seed);
    [radiance.x, radiance.y, radiance.z]
}

/// Push constants of the render passes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct RenderPush {
    /// The image.
    pub params: RenderParams,
    /// First pixel of this dispatch; `results` begins with it.
    pub first: u32,
    /// Number of pixels of this dispatch.
    pub count: u32,
    /// The light BVH (`render_bvh` only).
    pub tree: TreeWords,
}

/// Pass `render_bvh` for one choice.
macro_rules! render_pass {
    ($choice:ty, $light:ty, $pass:ident, $name:tt, [$($at:tt $own:ident: $word:ty),*], $sky:expr, $skin:expr) => {
        /// Direct lighting by lights chosen from a light BVH of one or two levels.
        #[spirv(compute(threads(64), entry_point_name = $name))]
        pub fn $pass(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(push_constant)] push: &RenderPush,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] ray_nodes: &[RayNode],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] surfaces: &[TriangleBlock],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] materials: &[Material],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] triangles: &[$light],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] instances: &[Instance],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 5)] camera: &[Camera],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 6)] nodes: &[NodeOf<$choice>],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 7)] trails: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 8)] results: &mut [[f32; 3]],
            $(#[spirv(storage_buffer, descriptor_set = 0, binding = $at)] $own: &[$word],)*
        ) {
            let i = invocation(id);
            if i < push.count {
                let scene = Scene::new(ray_nodes, surfaces, materials, triangles, instances, $sky, $skin);
                let picker: TreeOf<'_, $choice, _> = push.tree.tree(nodes, instances, trails);
                results[i as usize] = render_pixel(
                    &scene,
                    &camera[0],
                    &push.params,
                    &picker,
                    push.first.wrapping_add(i),
                );
            }
        }
    };
}

render_pass!(
    Standard,
    EmissiveTriangle,
    render_bvh,
    "render_bvh",
    [],
    NoSky,
    NoSkin
);
render_pass!(
    Paper,
    EmissiveTriangle,
    render_bvh_eq4,
    "render_bvh_eq4",
    [],
    NoSky,
    NoSkin
);
render_pass!(Kinds, AnyLight, render_bvh_any, "render_bvh_any", [9 suns: DistantLight, 10 sky_counts: u32, 11 sky_radiance: [f32; 3], 12 corners: Corner, 13 paint: u32], SkyView { suns, counts: sky_counts, radiance: sky_radiance }, SkinView { corners, words: paint });

/// Pass `render_power` for one type of light.
macro_rules! render_power_pass {
    ($light:ty, $pass:ident, $name:tt, [$($at:tt $own:ident: $word:ty),*], $sky:expr, $skin:expr) => {
        /// Direct lighting by lights chosen in proportion to their power. `thresholds` is [`Power`]'s table.
        #[spirv(compute(threads(64), entry_point_name = $name))]
        pub fn $pass(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(push_constant)] push: &RenderPush,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] ray_nodes: &[RayNode],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] surfaces: &[TriangleBlock],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] materials: &[Material],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] triangles: &[$light],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] instances: &[Instance],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 5)] camera: &[Camera],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 6)] thresholds: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 7)] results: &mut [[f32; 3]],
            $(#[spirv(storage_buffer, descriptor_set = 0, binding = $at)] $own: &[$word],)*
        ) {
            let i = invocation(id);
            if i < push.count {
                let scene = Scene::new(ray_nodes, surfaces, materials, triangles, instances, $sky, $skin);
                let picker = Power { thresholds };
                results[i as usize] = render_pixel(
                    &scene,
                    &camera[0],
                    &push.params,
                    &picker,
                    push.first.wrapping_add(i),
                );
            }
        }
    };
}

render_power_pass!(EmissiveTriangle, render_power, "render_power", [], NoSky, NoSkin);
render_power_pass!(AnyLight, render_power_any, "render_power_any", [8 suns: DistantLight, 9 sky_counts: u32, 10 sky_radiance: [f32; 3], 11 corners: Corner, 12 paint: u32], SkyView { suns, counts: sky_counts, radiance: sky_radiance }, SkinView { corners, words: paint });

/// Pass `render_uniform` for one type of light.
macro_rules! render_uniform_pass {
    ($light:ty, $pass:ident, $name:tt, [$($at:tt $own:ident: $word:ty),*], $sky:expr, $skin:expr) => {
        /// Direct lighting by lights chosen uniformly.
        #[spirv(compute(threads(64), entry_point_name = $name))]
        pub fn $pass(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(push_constant)] push: &RenderPush,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] ray_nodes: &[RayNode],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] surfaces: &[TriangleBlock],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] materials: &[Material],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] triangles: &[$light],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] instances: &[Instance],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 5)] camera: &[Camera],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 6)] results: &mut [[f32; 3]],
            $(#[spirv(storage_buffer, descriptor_set = 0, binding = $at)] $own: &[$word],)*
        ) {
            let i = invocation(id);
            if i < push.count {
                let scene = Scene::new(ray_nodes, surfaces, materials, triangles, instances, $sky, $skin);
                let picker = Uniform {
                    count: triangles.len() as u32,
                };
                results[i as usize] = render_pixel(
                    &scene,
                    &camera[0],
                    &push.params,
                    &picker,
                    push.first.wrapping_add(i),
                );
            }
        }
    };
}

render_uniform_pass!(
    EmissiveTriangle,
    render_uniform,
    "render_uniform",
    [],
    NoSky,
    NoSkin
);
render_uniform_pass!(AnyLight, render_uniform_any, "render_uniform_any", [7 suns: DistantLight, 8 sky_counts: u32, 9 sky_radiance: [f32; 3], 10 corners: Corner, 11 paint: u32], SkyView { suns, counts: sky_counts, radiance: sky_radiance }, SkinView { corners, words: paint });
