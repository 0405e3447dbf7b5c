//! Passes `path_*`: light along paths of several reflections, one invocation per pixel. Same buffers as `render_*`.

use bytemuck::{Pod, Zeroable};
use glam::{UVec3, Vec3};
use lightbvh::exact::{div, hash};
use lightbvh::light::AnyLight;
use lightbvh::light::infinite::DistantLight;
use lightbvh::{EmissiveTriangle, Instance};
use spirv_std::spirv;

use crate::bvh::{Kinds, NodeOf, Paper, Standard, TreeOf};
use crate::invocation;
use crate::render::RenderParams;
use crate::shading::camera::Camera;
use crate::shading::emitter::Emitter;
use crate::shading::grid::{TINY, flush_vector};
use crate::shading::material::Material;
use crate::shading::path::path_radiance;
use crate::shading::pick::{PickLight, Power, Uniform};
use crate::shading::pixel::Scene;
use crate::shading::skin::{Corner, NoSkin, SkinView};
use crate::shading::sky::{NoSky, SkyView};
use crate::shading::trace::{RayNode, TriangleBlock};
use lightbvh::TreeWords;

/// The radiance that reaches the camera through pixel `index` along paths of up to `bounces` reflections, linear RGB,
/// W/(m² sr): the mean of [`samples`](RenderParams::samples) paths. Pixels are numbered by rows from the upper left, and
/// all paths of a pixel begin with the same camera ray, as the light samples of [`render_pixel`](crate::render::render_pixel).
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
    let width = if params.width == 0 { 1 } else { params.width };
    let y = index / width;
    let x = index - y * width;
    let pixel = hash(index);
    let ray = camera.ray([x, y], [width, params.height], pixel, params.jitter);
    let background = Vec3::new(params.background[0], params.background[1], params.background[2]);
    let seed = hash(pixel.wrapping_add(hash(params.seed)));
    let mut sum = Vec3::ZERO;
    for sample in 0..params.samples {
        sum += path_radiance(
            scene,
            &ray,
            background,
            picker,
            bounces,
            hash(seed.wrapping_add(sample)),
        );
    }
    let count = if params.samples == 0 { 1 } else { params.samples };
    let mean = flush_vector(sum * div(1.0, count as i32 as f32), TINY);
    [mean.x, mean.y, mean.z]
}

/// Push constants of the path passes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct PathPush {
    /// The image; `samples` counts paths.
    pub params: RenderParams,
    /// Most reflections of a path, at most [`MAX_BOUNCES`](crate::shading::path::MAX_BOUNCES).
    pub bounces: u32,
    /// First pixel of this dispatch; `results` begins with it.
    pub first: u32,
    /// Number of pixels of this dispatch.
    pub count: u32,
    /// The light BVH (`path_bvh` only).
    pub tree: TreeWords,
}

/// Pass `path_bvh` for one choice.
macro_rules! path_pass {
    ($choice:ty, $light:ty, $pass:ident, $name:tt, [$($at:tt $own:ident: $word:ty),*], $sky:expr, $skin:expr) => {
        /// Paths with lights chosen from a light BVH of one or two levels.
        #[spirv(compute(threads(64), entry_point_name = $name))]
        pub fn $pass(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(push_constant)] push: &PathPush,
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
                results[i as usize] = path_pixel(
                    &scene,
                    &camera[0],
                    &push.params,
                    push.bounces,
                    &picker,
                    push.first.wrapping_add(i),
                );
            }
        }
    };
}

path_pass!(
    Standard,
    EmissiveTriangle,
    path_bvh,
    "path_bvh",
    [],
    NoSky,
    NoSkin
);
path_pass!(
    Paper,
    EmissiveTriangle,
    path_bvh_eq4,
    "path_bvh_eq4",
    [],
    NoSky,
    NoSkin
);
path_pass!(Kinds, AnyLight, path_bvh_any, "path_bvh_any", [9 suns: DistantLight, 10 sky_counts: u32, 11 sky_radiance: [f32; 3], 12 corners: Corner, 13 paint: u32], SkyView { suns, counts: sky_counts, radiance: sky_radiance }, SkinView { corners, words: paint });

/// Pass `path_power` for one type of light.
macro_rules! path_power_pass {
    ($light:ty, $pass:ident, $name:tt, [$($at:tt $own:ident: $word:ty),*], $sky:expr, $skin:expr) => {
        /// Paths with lights chosen in proportion to their power. `thresholds` is [`Power`]'s table.
        #[spirv(compute(threads(64), entry_point_name = $name))]
        pub fn $pass(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(push_constant)] push: &PathPush,
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
                results[i as usize] = path_pixel(
                    &scene,
                    &camera[0],
                    &push.params,
                    push.bounces,
                    &picker,
                    push.first.wrapping_add(i),
                );
            }
        }
    };
}

path_power_pass!(EmissiveTriangle, path_power, "path_power", [], NoSky, NoSkin);
path_power_pass!(AnyLight, path_power_any, "path_power_any", [8 suns: DistantLight, 9 sky_counts: u32, 10 sky_radiance: [f32; 3], 11 corners: Corner, 12 paint: u32], SkyView { suns, counts: sky_counts, radiance: sky_radiance }, SkinView { corners, words: paint });

/// Pass `path_uniform` for one type of light.
macro_rules! path_uniform_pass {
    ($light:ty, $pass:ident, $name:tt, [$($at:tt $own:ident: $word:ty),*], $sky:expr, $skin:expr) => {
        /// Paths with lights chosen uniformly.
        #[spirv(compute(threads(64), entry_point_name = $name))]
        pub fn $pass(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(push_constant)] push: &PathPush,
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
                results[i as usize] = path_pixel(
                    &scene,
                    &camera[0],
                    &push.params,
                    push.bounces,
                    &picker,
                    push.first.wrapping_add(i),
                );
            }
        }
    };
}

path_uniform_pass!(EmissiveTriangle, path_uniform, "path_uniform", [], NoSky, NoSkin);
path_uniform_pass!(AnyLight, path_uniform_any, "path_uniform_any", [7 suns: DistantLight, 8 sky_counts: u32, 9 sky_radiance: [f32; 3], 10 corners: Corner, 11 paint: u32], SkyView { suns, counts: sky_counts, radiance: sky_radiance }, SkinView { corners, words: paint });
