//! Passes `render` and `render_paths`: direct lighting, and light along paths, one invocation per pixel. They read the scene, the
//! ray BVH and what lights are chosen by, and write the pixel.

use bytemuck::{Pod, Zeroable};
use glam::{UVec3, Vec3};
use lightbvh::device::vector::flush3;
use lightbvh::exact::hash;
use lightbvh::light::AnyLight;
use lightbvh::{EmissiveTriangle, Instance};
use spirv_std::spirv;

use crate::bvh::{AnyNode, AnyTree, Node, PaperNode, PaperTree, StandardTree};
use crate::invocation;
use crate::shading::camera::Camera;
use crate::shading::direct::reflected;
use crate::shading::emitter::Emitter;
use crate::shading::grid::{TINY, div};
use crate::shading::material::Material;
pub use crate::shading::params::RenderParams;
use crate::shading::path::path_radiance;
use crate::shading::pick::{Chosen, PickLight, Power, Uniform};
use crate::shading::pixel::{Scene, see};
use crate::shading::ray::Ray;
use crate::shading::textures::{Corner, NoTextures, TextureView};
use crate::shading::trace::{RayNode, TriangleBlock};
use lightbvh::TreeWords;

/// The ray of pixel `index`, numbered by rows from the upper left, what it sees where it meets nothing, and the seed of the random
/// numbers of its lights.
#[inline]
fn pixel_ray(camera: &Camera, params: &RenderParams, index: u32) -> (Ray, Vec3, u32) {
    let width = if params.width == 0 { 1 } else { params.width };
    let y = index / width;
    let x = index - y * width;
    let pixel = hash(index);
    let ray = camera.ray([x, y], [width, params.height], pixel, params.jitter);
    let background = Vec3::new(params.background[0], params.background[1], params.background[2]);
    (ray, background, hash(pixel.wrapping_add(hash(params.seed))))
}

/// The direct light that reaches the camera through pixel `index`, linear RGB, W/(m² sr).
#[inline]
#[must_use]
pub fn render_pixel<L: Emitter, P: PickLight>(
    scene: &Scene<'_, L>,
    camera: &Camera,
    params: &RenderParams,
    picker: &P,
    index: u32,
) -> [f32; 3] {
    let (ray, background, seed) = pixel_ray(camera, params, index);
    let seen = see(scene, &ray, background);
    let radiance = seen.direct + reflected(scene, &seen, picker, params, seed);
    [radiance.x, radiance.y, radiance.z]
}

/// The radiance that reaches the camera through pixel `index` along paths of up to `bounces` reflections, linear RGB, W/(m² sr):
/// the mean of [`samples`](RenderParams::samples) paths, which all begin with one camera ray.
#[inline]
#[must_use]
pub fn path_pixel<L: Emitter, P: PickLight>(
    scene: &Scene<'_, L>,
    camera: &Camera,
    params: &RenderParams,
    bounces: u32,
    picker: &P,
    index: u32,
) -> [f32; 3] {
    let (ray, background, seed) = pixel_ray(camera, params, index);
    let mut sum = Vec3::ZERO;
    for sample in 0..params.samples {
        let seed = hash(seed.wrapping_add(sample));
        sum += path_radiance(scene, &ray, background, picker, bounces, seed);
    }
    let count = if params.samples == 0 { 1 } else { params.samples };
    let mean = flush3(sum * div(1.0, count as i32 as f32), TINY);
    [mean.x, mean.y, mean.z]
}

/// Push constants of the render passes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct RenderPush {
    /// The image; of paths, `samples` counts them.
    pub params: RenderParams,
    /// Most reflections of a path, for `render_paths` alone, at most [`MAX_BOUNCES`](crate::shading::path::MAX_BOUNCES).
    pub bounces: u32,
    /// How lights are chosen: a number of [`by`](crate::shading::pick::by).
    pub by: u32,
    /// First pixel of this dispatch; `results` begins with it.
    pub first: u32,
    /// Number of pixels of this dispatch.
    pub count: u32,
    /// The light BVH, if lights are chosen from one.
    pub tree: TreeWords,
}

/// A pass over the pixels of a scene with one type of light and tree, in a module of its own: both in one are more than SwiftShader
/// compiles. The lists are bindings that only some scenes have, and the results'.
macro_rules! render_pass {
    (
        $pass:ident = $name:tt, $is_paths:literal, $tree:ident, $light:ty, $node:ty,
        [$($at:tt $own:ident: $word:ty),*], $textures:expr, $results:tt
    ) => {
        /// Direct lighting, or light along paths.
        #[spirv(compute(threads(64), entry_point_name = $name))]
        pub fn $pass(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(push_constant)] push: &RenderPush,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] ray_nodes: &[RayNode],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] surfaces: &[TriangleBlock],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] materials: &[Material],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] lights: &[$light],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] instances: &[Instance],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 5)] camera: &[Camera],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 6)] nodes: &[$node],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 7)] trails: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 8)] thresholds: &[u32],
            $(#[spirv(storage_buffer, descriptor_set = 0, binding = $at)] $own: &[$word],)*
            #[spirv(storage_buffer, descriptor_set = 0, binding = $results)] results: &mut [[f32; 3]],
        ) {
            let i = invocation(id);
            if i < push.count {
                let scene = Scene::new(ray_nodes, surfaces, materials, lights, instances, $textures);
                let tree: $tree<'_> = push.tree.tree(nodes, instances, trails);
                let picker = Chosen {
                    by: push.by,
                    tree,
                    power: Power { thresholds },
                    uniform: Uniform {
                        count: lights.len() as u32,
                    },
                };
                let pixel = push.first.wrapping_add(i);
                results[i as usize] = if $is_paths {
                    path_pixel(&scene, &camera[0], &push.params, push.bounces, &picker, pixel)
                } else {
                    render_pixel(&scene, &camera[0], &push.params, &picker, pixel)
                };
            }
        }
    };
}

/// Both passes over the pixels of a scene with one type of light and tree.
macro_rules! render_passes {
    ($direct:ident = $direct_name:tt, $paths:ident = $paths_name:tt, $($scene:tt)*) => {
        render_pass!($direct = $direct_name, false, $($scene)*);
        render_pass!($paths = $paths_name, true, $($scene)*);
    };
}

render_passes!(
    render = "render",
    render_paths = "render_paths",
    StandardTree,
    EmissiveTriangle,
    Node,
    [],
    NoTextures,
    9
);
render_passes!(
    render_eq4 = "render_eq4",
    render_paths_eq4 = "render_paths_eq4",
    PaperTree,
    EmissiveTriangle,
    PaperNode,
    [],
    NoTextures,
    9
);
render_passes!(
    render_any = "render_any",
    render_paths_any = "render_paths_any",
    AnyTree,
    AnyLight,
    AnyNode,
    [9 corners: Corner, 10 textures: u32],
    TextureView { corners, words: textures },
    11
);
