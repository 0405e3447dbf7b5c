//! ReSTIR on the CPU: the kernels' functions for each pixel, over all cores of the current rayon pool.

use std::marker::PhantomData;
use std::sync::Arc;
use std::time::Instant;

use lightbvh_kernels::bvh::{Choice, Standard, WIDTH};
use lightbvh_kernels::shading::pick::{PickLight, Power, Uniform};
use lightbvh_kernels::shading::pixel::Scene;
use lightbvh_kernels::shading::restir::combine::{Biased, Combine, Unbiased};
use lightbvh_kernels::shading::restir::initial::{first_reservoir, first_surface};
use lightbvh_kernels::shading::restir::shade::shade;
use lightbvh_kernels::shading::restir::spatial::spatial;
use lightbvh_kernels::shading::restir::surface::Surface;
use lightbvh_kernels::shading::restir::temporal::{Before, temporal};
use lightbvh_kernels::shading::restir::{PixelReservoir, RestirParams};
use rayon::prelude::*;

use super::{Combination, History, LightRemap, Restir, RestirFrame, RestirOptions, continues, params};
use crate::backend::{BackendError, Sampler, SceneArrays, Timed};

/// ReSTIR on the CPU.
pub struct CpuRestir<C: Choice<W> = Standard, const W: usize = WIDTH> {
    options: RestirOptions,
    last: Option<Last>,
    shadow_rays: u64,
    choice: PhantomData<C>,
}

/// The frame before.
struct Last {
    scene: Arc<SceneArrays>,
    size: (u32, u32),
    gbuffer: Vec<Surface>,
    reservoirs: Vec<PixelReservoir>,
}

impl<C: Choice<W>, const W: usize> CpuRestir<C, W> {
    /// Before the first frame.
    pub fn new(options: RestirOptions) -> Self {
        Self {
            options,
            last: None,
            shadow_rays: 0,
            choice: PhantomData,
        }
    }
}

impl<C: Choice<W>, const W: usize> Restir<C, W> for CpuRestir<C, W> {
    fn frame(&mut self, frame: &RestirFrame<'_, C, W>) -> Result<Timed<Vec<[f32; 3]>>, BackendError> {
        let start = Instant::now();
        let params = params(&self.options, frame);
        let view = frame.scene.view();
        let scene = frame.scene.as_ref();
        let (gbuffer, mut reservoirs) = match self.options.source {
            Sampler::Uniform => {
                let count = scene.lights.triangles().len() as u32;
                initial(scene, &params, &Uniform { count })
            }
            Sampler::Power => {
                let thresholds = &scene.thresholds;
                initial(scene, &params, &Power { thresholds })
            }
            Sampler::SingleLevel | Sampler::TwoLevel => initial(scene, &params, &frame.bvh),
        };
        let usable = |last: &&Last| continues(&last.scene, last.size, frame) && self.options.history > 0;
        if let Some(last) = self.last.as_ref().filter(usable) {
            let none = LightRemap::default();
            let remap = frame.remap.unwrap_or(&none);
            let reuse = Reuse {
                scene,
                params: &params,
                gbuffer: &gbuffer,
            };
            reservoirs = match self.options.combination {
                Combination::Unbiased => {
                    let then = last.scene.view();
                    let combine = Unbiased {
                        surfaces: then.surfaces,
                        lights: then.lights,
                    };
                    reuse.over_time(&combine, last, remap, &reservoirs)
                }
                Combination::Biased => reuse.over_time(&Biased, last, remap, &reservoirs),
            };
        }
        for spatial_pass in 0..self.options.spatial_passes {
            let params = RestirParams {
                spatial_pass,
                ..params
            };
            let reuse = Reuse {
                scene,
                params: &params,
                gbuffer: &gbuffer,
            };
            reservoirs = match self.options.combination {
                Combination::Unbiased => {
                    let combine = Unbiased {
                        surfaces: view.surfaces,
                        lights: view.lights,
                    };
                    reuse.over_pixels(&combine, &reservoirs)
                }
                Combination::Biased => reuse.over_pixels(&Biased, &reservoirs),
            };
        }
        let (shaded, kept): (Vec<_>, Vec<_>) = gbuffer
            .par_iter()
            .zip(&reservoirs)
            .map(|(surface, last)| shade(&view, &params, surface, last))
            .unzip();
        let time = start.elapsed();
        self.shadow_rays = shaded.iter().map(|pixel| u64::from(pixel.shadow_rays)).sum();
        self.last = Some(Last {
            scene: Arc::clone(frame.scene),
            size: (frame.width, frame.height),
            gbuffer,
            reservoirs: kept,
        });
        Ok(Timed {
            value: shaded.iter().map(|pixel| pixel.radiance).collect(),
            time,
        })
    }

    fn reset(&mut self) {
        self.last = None;
    }

    fn shadow_rays(&self) -> u64 {
        self.shadow_rays
    }

    fn state(&self) -> Result<History, BackendError> {
        Ok(self.last.as_ref().map_or_else(Default::default, |last| {
            (last.gbuffer.clone(), last.reservoirs.clone())
        }))
    }
}

/// Pass 1.
fn initial<P: PickLight + Sync>(
    scene: &SceneArrays,
    params: &RestirParams,
    picker: &P,
) -> (Vec<Surface>, Vec<PixelReservoir>) {
    let view: Scene<'_> = scene.view();
    (0..params.width * params.height)
        .into_par_iter()
        .map(|pixel| {
            let surface = first_surface(&view, &scene.camera, params, pixel);
            let reservoir = first_reservoir(&view, params, picker, &surface, pixel);
            (surface, reservoir)
        })
        .unzip()
}

/// What passes 2 and 3 have in common.
struct Reuse<'a> {
    scene: &'a SceneArrays,
    params: &'a RestirParams,
    gbuffer: &'a [Surface],
}

impl Reuse<'_> {
    /// Pass 2.
    fn over_time<C: Combine + Sync>(
        &self,
        combine: &C,
        last: &Last,
        remap: &LightRemap,
        reservoirs: &[PixelReservoir],
    ) -> Vec<PixelReservoir> {
        let before = Before {
            camera: &last.scene.camera,
            gbuffer: &last.gbuffer,
            reservoirs: &last.reservoirs,
            to_current: remap.to_current(),
        };
        let view = self.scene.view();
        (0..self.gbuffer.len())
            .into_par_iter()
            .map(|pixel| {
                temporal(
                    combine,
                    view.materials,
                    view.lights,
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
    fn over_pixels<C: Combine + Sync>(
        &self,
        combine: &C,
        reservoirs: &[PixelReservoir],
    ) -> Vec<PixelReservoir> {
        let view = self.scene.view();
        (0..self.gbuffer.len() as u32)
            .into_par_iter()
            .map(|pixel| {
                spatial(
                    combine,
                    view.materials,
                    view.lights,
                    self.gbuffer,
                    reservoirs,
                    self.params,
                    pixel,
                )
            })
            .collect()
    }
}
