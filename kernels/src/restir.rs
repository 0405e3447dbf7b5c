//! Passes of ReSTIR, one invocation per pixel, a barrier between dispatches:
//!
//! 1. `restir_initial`: what the pixel sees, and a light sample out of candidates drawn by power (as in the paper) or from the
//!    light BVH. Writes G-buffer and reservoirs.
//! 2. `restir_temporal`: merges the frame before. Reads that frame's G-buffer and reservoirs, updates reservoirs in place.
//!    Left out in the first frame.
//! 3. `restir_spatial`, as often as wanted: merges neighbours. Reads one buffer of reservoirs, writes another.
//! 4. `restir_shade`: shadow ray and colour. Updates reservoirs in place; they and the G-buffer are the next frame's
//!    frame before.
//!
//! Passes 2 and 3 are **biased** where their specialisation constant 0 is zero, and otherwise unbiased under the conditions in
//! [`crate::shading::restir`].

use bytemuck::{Pod, Zeroable};
use glam::UVec3;
use lightbvh::light::AnyLight;
use lightbvh::light::infinite::DistantLight;
use lightbvh::{EmissiveTriangle, Instance};
use spirv_std::spirv;

use crate::bvh::{AnyNode, Kinds, Node, Paper, PaperNode, Standard, TreeOf, WIDTH};
use crate::invocation;
use crate::render::scene_pass;
use crate::shading::camera::Camera;
use crate::shading::emitters::Emitters;
use crate::shading::material::Material;
use crate::shading::pick::{Chosen, Power, Uniform};
use crate::shading::pixel::Scene;
use crate::shading::restir::combine::Combine;
use crate::shading::restir::initial::{first_reservoir, first_surface};
use crate::shading::restir::shade::{Shaded, shade};
use crate::shading::restir::spatial::spatial;
use crate::shading::restir::surface::Surface;
use crate::shading::restir::temporal::{Before, temporal};
use crate::shading::restir::{PixelReservoir, RestirParams};
use crate::shading::skin::{Corner, NoSkin, SkinView};
use crate::shading::sky::{NoSky, SkyView};
use crate::shading::trace::{RayNode, Surfaces, TriangleBlock};
use lightbvh::TreeWords;

/// Push constants of all passes; 100 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct RestirPush {
    /// The frame.
    pub params: RestirParams,
    /// First pixel of this dispatch.
    pub first: u32,
    /// Number of pixels of this dispatch.
    pub count: u32,
    /// The light BVH, if pass 1 chooses lights from one.
    pub tree: TreeWords,
}

const _: () = assert!(size_of::<RestirPush>() == 100);

scene_pass!(
    /// Pass 1.
    [
        restir_initial = "restir_initial",
        restir_initial_eq4 = "restir_initial_eq4",
        restir_initial_any = "restir_initial_any"
    ],
    RestirPush,
    [gbuffer: Surface = 9 or 14, reservoirs: PixelReservoir = 10 or 15],
    |i, push, scene, picker, camera| {
        let pixel = push.first.wrapping_add(i);
        if pixel < gbuffer.len() as u32 && pixel < reservoirs.len() as u32 {
            let surface = first_surface(&scene, camera, &push.params, pixel);
            gbuffer[pixel as usize] = surface;
            reservoirs[pixel as usize] = first_reservoir(&scene, &push.params, &picker, &surface, pixel);
        }
    }
);

/// Pass `restir_temporal` for one type of light.
macro_rules! temporal_pass {
    ($light:ty, $pass:ident, $name:tt, [$($at:tt $own:ident: $word:ty),*], $skin:expr) => {
        /// Pass 2; `before_*` is the frame before, `before_camera` its camera.
        #[spirv(compute(threads(64), entry_point_name = $name))]
        pub fn $pass(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(spec_constant(id = 0))] unbiased: u32,
            #[spirv(push_constant)] push: &RestirPush,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] before_ray_nodes: &[RayNode],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] before_surfaces: &[TriangleBlock],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] before_triangles: &[$light],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] before_instances: &[Instance],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] to_previous: &[[u32; 2]],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 5)] materials: &[Material],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 6)] triangles: &[$light],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 7)] instances: &[Instance],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 8)] before_camera: &[Camera],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 9)] before_gbuffer: &[Surface],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 10)] before_reservoirs: &[PixelReservoir],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 11)] to_current: &[[u32; 2]],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 12)] gbuffer: &[Surface],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 13)] reservoirs: &mut [PixelReservoir],
            $(#[spirv(storage_buffer, descriptor_set = 0, binding = $at)] $own: &[$word],)*
        ) {
            let i = invocation(id);
            let pixel = push.first.wrapping_add(i);
            if i < push.count && pixel < gbuffer.len() as u32 && pixel < reservoirs.len() as u32 {
                let emitters = Emitters {
                    triangles,
                    instances,
                };
                let combine = Combine {
                    is_unbiased: unbiased != 0,
                    surfaces: Surfaces {
                        nodes: before_ray_nodes,
                        blocks: before_surfaces,
                        skin: $skin,
                    },
                    emitters: Emitters {
                        triangles: before_triangles,
                        instances: before_instances,
                    },
                };
                let before = Before {
                    camera: &before_camera[0],
                    gbuffer: before_gbuffer,
                    reservoirs: before_reservoirs,
                    to_current,
                };
                let surface = gbuffer[pixel as usize];
                let current = reservoirs[pixel as usize];
                reservoirs[pixel as usize] = temporal(
                    &combine,
                    materials,
                    &emitters,
                    &before,
                    to_previous,
                    &push.params,
                    &surface,
                    current,
                    pixel,
                );
            }
        }
    };
}

temporal_pass!(EmissiveTriangle, restir_temporal, "restir_temporal", [], NoSkin);
temporal_pass!(
    AnyLight,
    restir_temporal_any,
    "restir_temporal_any",
    [14 before_corners: Corner, 15 paint: u32],
    SkinView {
        corners: before_corners,
        words: paint
    }
);

/// Pass `restir_spatial` for one type of light.
macro_rules! spatial_pass {
    ($light:ty, $pass:ident, $name:tt, [$($at:tt $own:ident: $word:ty),*], $skin:expr) => {
        /// Pass 3.
        #[spirv(compute(threads(64), entry_point_name = $name))]
        pub fn $pass(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(spec_constant(id = 0))] unbiased: u32,
            #[spirv(push_constant)] push: &RestirPush,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] ray_nodes: &[RayNode],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] surfaces: &[TriangleBlock],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] materials: &[Material],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] triangles: &[$light],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] instances: &[Instance],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 5)] gbuffer: &[Surface],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 6)] reservoirs: &[PixelReservoir],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 7)] results: &mut [PixelReservoir],
            $(#[spirv(storage_buffer, descriptor_set = 0, binding = $at)] $own: &[$word],)*
        ) {
            let i = invocation(id);
            let pixel = push.first.wrapping_add(i);
            if i < push.count && pixel < gbuffer.len() as u32 && pixel < reservoirs.len() as u32 {
                let emitters = Emitters {
                    triangles,
                    instances,
                };
                let combine = Combine {
                    is_unbiased: unbiased != 0,
                    surfaces: Surfaces {
                        nodes: ray_nodes,
                        blocks: surfaces,
                        skin: $skin,
                    },
                    emitters,
                };
                results[pixel as usize] = spatial(
                    &combine,
                    materials,
                    &emitters,
                    gbuffer,
                    reservoirs,
                    &push.params,
                    pixel,
                );
            }
        }
    };
}

spatial_pass!(EmissiveTriangle, restir_spatial, "restir_spatial", [], NoSkin);
spatial_pass!(
    AnyLight,
    restir_spatial_any,
    "restir_spatial_any",
    [8 corners: Corner, 9 paint: u32],
    SkinView {
        corners,
        words: paint
    }
);

/// Pass `restir_shade` for one type of light.
macro_rules! shade_pass {
    ($light:ty, $pass:ident, $name:tt, [$($at:tt $own:ident: $word:ty),*], $sky:expr, $skin:expr) => {
        /// Pass 4.
        #[spirv(compute(threads(64), entry_point_name = $name))]
        pub fn $pass(
            #[spirv(global_invocation_id)] id: UVec3,
            #[spirv(push_constant)] push: &RestirPush,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] ray_nodes: &[RayNode],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] surfaces: &[TriangleBlock],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] materials: &[Material],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 3)] triangles: &[$light],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 4)] instances: &[Instance],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 5)] gbuffer: &[Surface],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 6)] reservoirs: &mut [PixelReservoir],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 7)] results: &mut [Shaded],
            $(#[spirv(storage_buffer, descriptor_set = 0, binding = $at)] $own: &[$word],)*
        ) {
            let i = invocation(id);
            let pixel = push.first.wrapping_add(i);
            if i < push.count && pixel < gbuffer.len() as u32 && pixel < reservoirs.len() as u32 {
                let scene = Scene::new(ray_nodes, surfaces, materials, triangles, instances, $sky, $skin);
                let surface = gbuffer[pixel as usize];
                let last = reservoirs[pixel as usize];
                let (shaded, kept) = shade(&scene, &push.params, &surface, &last, pixel);
                results[pixel as usize] = shaded;
                reservoirs[pixel as usize] = kept;
            }
        }
    };
}

shade_pass!(EmissiveTriangle, restir_shade, "restir_shade", [], NoSky, NoSkin);
shade_pass!(AnyLight, restir_shade_any, "restir_shade_any", [8 suns: DistantLight, 9 sky_counts: u32, 10 sky_radiance: [f32; 3], 11 corners: Corner, 12 paint: u32], SkyView { suns, counts: sky_counts, radiance: sky_radiance }, SkinView { corners, words: paint });
