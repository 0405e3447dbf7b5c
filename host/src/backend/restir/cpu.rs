//! ReSTIR on the CPU: the kernels' functions for each pixel, over all cores of the current rayon pool.

use std::sync::Arc;

use lightbvh::Instance;
use lightbvh_kernels::shading::camera::Camera;
use lightbvh_kernels::shading::emitters::Emitters;
use lightbvh_kernels::shading::pick::PickLight;
use lightbvh_kernels::shading::pixel::Scene;
use lightbvh_kernels::shading::restir::combine::Combine;
use lightbvh_kernels::shading::restir::initial::{first_reservoir, first_surface};
use lightbvh_kernels::shading::restir::shade::shade;
use lightbvh_kernels::shading::restir::spatial::spatial;
use lightbvh_kernels::shading::restir::surface::Surface;
use lightbvh_kernels::shading::restir::temporal::{Before, temporal};
use lightbvh_kernels::shading::restir::{PixelReservoir, RestirParams};
use rayon::prelude::*;

use crate::scene::SceneLight;

use super::{History, Last, LightRemap, Restir, RestirFrame, params};

/// What a frame leaves on the CPU.
pub(super) struct Left<L> {
    gbuffer: Vec<Surface>,
    reservoirs: Vec<PixelReservoir>,
    /// The lights as they were.
    triangles: Vec<L>,
    instances: Vec<Instance>,
}

impl<L> Left<L> {
    /// G-buffer and reservoirs.
    pub fn state(&self) -> History {
        (self.gbuffer.clone(), self.reservoirs.clone())
    }
}

/// The next frame, of `view`, with candidates from `picker`.
pub(in crate::backend) fn resample<L: SceneLight, P: PickLight + Sync>(
    restir: &mut Restir<L>,
    frame: &RestirFrame<'_, L>,
    view: &Scene<'_, L>,
    picker: &P,
) -> Vec<[f32; 3]> {
    let options = restir.options;
    let is_unbiased = options.combination.is_unbiased();
    let mut params = params(&options, frame);
    let (gbuffer, mut reservoirs) = initial(view, &frame.scene.camera, &params, picker);
    if let Some(last) = restir.history(frame)
        && let super::Left::Cpu(left) = &last.left
    {
        let none = LightRemap::default();
        let remap = frame.remap.unwrap_or(&none);
        let reuse = Reuse {
            view,
            params: &params,
            gbuffer: &gbuffer,
        };
        let combine = Combine {
            is_unbiased,
            surfaces: last.scene.surfaces(),
            emitters: Emitters {
                triangles: &left.triangles,
                instances: &left.instances,
            },
        };
        reservoirs = reuse.over_time(&combine, last, left, remap, &reservoirs);
    }
    for spatial_pass in 0..options.spatial_passes {
        params.spatial_pass = spatial_pass;
        let reuse = Reuse {
            view,
            params: &params,
            gbuffer: &gbuffer,
        };
        let combine = Combine {
            is_unbiased,
            surfaces: view.surfaces,
            emitters: view.emitters,
        };
        reservoirs = reuse.over_pixels(&combine, &reservoirs);
    }
    let (shaded, kept): (Vec<_>, Vec<_>) = gbuffer
        .par_iter()
        .zip(&reservoirs)
        .enumerate()
        .map(|(pixel, (surface, last))| shade(view, &params, surface, last, pixel as u32))
        .unzip();
    let left = Left {
        gbuffer,
        reservoirs: kept,
        triangles: view.emitters.triangles.to_vec(),
        instances: view.emitters.instances.to_vec(),
    };
    let shadow_rays = shaded.iter().map(|pixel| u64::from(pixel.shadow_rays)).sum();
    restir.keep(frame, super::Left::Cpu(Arc::new(left)), shadow_rays);
    shaded.iter().map(|pixel| pixel.radiance).collect()
}

/// Pass 1.
fn initial<L: SceneLight, P: PickLight + Sync>(
    view: &Scene<'_, L>,
    camera: &Camera,
    params: &RestirParams,
    picker: &P,
) -> (Vec<Surface>, Vec<PixelReservoir>) {
    (0..params.width * params.height)
        .into_par_iter()
        .map(|pixel| {
            let surface = first_surface(view, camera, params, pixel);
            let reservoir = first_reservoir(view, params, picker, &surface, pixel);
            (surface, reservoir)
        })
        .unzip()
}

/// What passes 2 and 3 have in common.
struct Reuse<'a, 's, L: SceneLight> {
    view: &'a Scene<'s, L>,
    params: &'a RestirParams,
    gbuffer: &'a [Surface],
}

impl<L: SceneLight> Reuse<'_, '_, L> {
    /// Pass 2.
    fn over_time(
        &self,
        combine: &Combine<'_, L>,
        last: &Last<L>,
        left: &Left<L>,
        remap: &LightRemap,
        reservoirs: &[PixelReservoir],
    ) -> Vec<PixelReservoir> {
        let before = Before {
            camera: &last.scene.camera,
            gbuffer: &left.gbuffer,
            reservoirs: &left.reservoirs,
            to_current: remap.to_current(),
        };
        (0..self.gbuffer.len())
            .into_par_iter()
            .map(|pixel| {
                temporal(
                    combine,
                    self.view.materials,
                    &self.view.emitters,
                    &before,
                    remap.to_previous(),
                    self.params,
                    &self.gbuffer[pixel],
                    reservoirs[pixel],
                    pixel as u32,
                )
            })
            .collect()
    }

    /// Pass 3.
    fn over_pixels(&self, combine: &Combine<'_, L>, reservoirs: &[PixelReservoir]) -> Vec<PixelReservoir> {
        (0..self.gbuffer.len() as u32)
            .into_par_iter()
            .map(|pixel| {
                spatial(
                    combine,
                    self.view.materials,
                    &self.view.emitters,
                    self.gbuffer,
                    reservoirs,
                    self.params,
                    pixel,
                )
            })
            .collect()
    }
}
