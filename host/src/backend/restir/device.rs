//! ReSTIR on a Vulkan device.

use std::marker::PhantomData;
use std::sync::Arc;
use std::time::Duration;

use bytemuck::bytes_of;
use lightbvh_kernels::bvh::{Choice, Standard, TreePush, WIDTH};
use lightbvh_kernels::restir::RestirPush;
use lightbvh_kernels::shading::restir::shade::Shaded;
use lightbvh_kernels::shading::restir::surface::Surface;
use lightbvh_kernels::shading::restir::{PixelReservoir, RestirParams};

use super::{Combination, History, Restir, RestirFrame, RestirOptions, continues, params};
use crate::backend::device_arrays::{DeviceScene, DeviceTree, device_time, kernel_name};
use crate::backend::{BackendError, SceneArrays, Timed};
use crate::vulkan::{Binding, Buffer, Device, Pass};

/// Candidates or neighbours per dispatch: keeps one well below the seconds after which a driver gives up on it.
const WORK_PER_PASS: usize = 1 << 21;

/// ReSTIR on a device.
pub struct DeviceRestir<'d, C: Choice<W> = Standard, const W: usize = WIDTH> {
    device: &'d Device,
    options: RestirOptions,
    last: Option<Last>,
    shadow_rays: u64,
    choice: PhantomData<C>,
}

/// The frame before.
struct Last {
    scene: Arc<SceneArrays>,
    size: (u32, u32),
    buffers: DeviceScene,
    gbuffer: Buffer<Surface>,
    reservoirs: Buffer<PixelReservoir>,
}

impl<'d, C: Choice<W>, const W: usize> DeviceRestir<'d, C, W> {
    /// Before the first frame.
    pub fn new(device: &'d Device, options: RestirOptions) -> Self {
        Self {
            device,
            options,
            last: None,
            shadow_rays: 0,
            choice: PhantomData,
        }
    }

    /// Runs a kernel over all pixels, in parts of `work` units of work per pixel.
    fn over_pixels(
        &self,
        kernel: &str,
        bindings: &[Binding<'_>],
        params: &RestirParams,
        tree: TreePush,
        work: u32,
    ) -> Result<Duration, BackendError> {
        let kernel = self.device.kernel(kernel)?;
        let pixels = params.width as usize * params.height as usize;
        let per_pass = (WORK_PER_PASS / work.max(1) as usize).max(64);
        let mut time = Duration::ZERO;
        for first in (0..pixels).step_by(per_pass) {
            let push = RestirPush {
                params: *params,
                first: first as u32,
                count: usize::min(per_pass, pixels - first) as u32,
                tree,
            };
            let mut pass = Pass::new();
            pass.dispatch(&kernel, bindings, bytes_of(&push), push.count);
            time += device_time(&self.device.run(&pass)?);
        }
        Ok(time)
    }

    /// Pass 2.
    fn over_time(
        &self,
        frame: &RestirFrame<'_, C, W>,
        last: &Last,
        params: &RestirParams,
        scene: &DeviceScene,
        gbuffer: &Buffer<Surface>,
        reservoirs: &Buffer<PixelReservoir>,
    ) -> Result<Duration, BackendError> {
        let (to_current, to_previous) = frame
            .remap
            .map_or((&[][..], &[][..]), |r| (r.to_current(), r.to_previous()));
        let to_current = self.device.upload(to_current)?;
        let to_previous = self.device.upload(to_previous)?;
        let common = [
            scene.materials.bind(),
            scene.lights.bind(),
            last.buffers.camera.bind(),
            last.gbuffer.bind(),
            last.reservoirs.bind(),
            to_current.bind(),
            gbuffer.bind(),
            reservoirs.bind(),
        ];
        let then = [
            last.buffers.ray_nodes.bind(),
            last.buffers.surfaces.bind(),
            last.buffers.lights.bind(),
            to_previous.bind(),
        ];
        let (kernel, bindings) = match self.options.combination {
            Combination::Unbiased => (
                "restir_temporal_unbiased",
                [then.as_slice(), common.as_slice()].concat(),
            ),
            Combination::Biased => ("restir_temporal_biased", common.to_vec()),
        };
        self.over_pixels(kernel, &bindings, params, TreePush::default(), 4)
    }
}

impl<C: Choice<W>, const W: usize> Restir<C, W> for DeviceRestir<'_, C, W> {
    fn frame(&mut self, frame: &RestirFrame<'_, C, W>) -> Result<Timed<Vec<[f32; 3]>>, BackendError> {
        let device = self.device;
        let mut params = params(&self.options, frame);
        let pixels = frame.width as usize * frame.height as usize;
        let scene = DeviceScene::upload(device, frame.scene)?;
        let gbuffer = device.output::<Surface>(pixels)?;
        let mut reservoirs = device.output::<PixelReservoir>(pixels)?;
        let none = TreePush::default();

        let source = self.options.source;
        let upload = || DeviceTree::upload::<C, W>(device, &frame.bvh);
        let tree = source.needs_bvh().then(upload).transpose()?;
        let inputs = scene.with_lights(source, tree.as_ref());
        let bindings = [inputs.as_slice(), &[gbuffer.bind(), reservoirs.bind()]].concat();
        let kernel = kernel_name::<C, W>("restir_initial", source);
        let work = self.options.candidates;
        let push = tree.as_ref().map_or(none, |tree| tree.push);
        let mut time = self.over_pixels(&kernel, &bindings, &params, push, work)?;

        let usable = |last: &&Last| continues(&last.scene, last.size, frame) && self.options.history > 0;
        if let Some(last) = self.last.as_ref().filter(usable) {
            time += self.over_time(frame, last, &params, &scene, &gbuffer, &reservoirs)?;
        }
        for spatial_pass in 0..self.options.spatial_passes {
            params.spatial_pass = spatial_pass;
            let merged = device.output::<PixelReservoir>(pixels)?;
            let all = [
                scene.view().as_slice(),
                &[gbuffer.bind(), reservoirs.bind(), merged.bind()],
            ]
            .concat();
            let (kernel, bindings) = match self.options.combination {
                Combination::Unbiased => ("restir_spatial_unbiased", all.as_slice()),
                // No rays, no buffers to trace them through.
                Combination::Biased => ("restir_spatial_biased", &all[2..]),
            };
            let work = self.options.neighbors.saturating_add(1).saturating_mul(2);
            time += self.over_pixels(kernel, bindings, &params, none, work)?;
            reservoirs = merged;
        }
        let output = device.output::<Shaded>(pixels)?;
        let bindings = [
            scene.view().as_slice(),
            &[gbuffer.bind(), reservoirs.bind(), output.bind()],
        ]
        .concat();
        time += self.over_pixels("restir_shade", &bindings, &params, none, 2)?;
        let shaded = output.read()?;
        self.shadow_rays = shaded.iter().map(|pixel| u64::from(pixel.shadow_rays)).sum();
        self.last = Some(Last {
            scene: Arc::clone(frame.scene),
            size: (frame.width, frame.height),
            buffers: scene,
            gbuffer,
            reservoirs,
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
        match &self.last {
            Some(last) => Ok((last.gbuffer.read()?, last.reservoirs.read()?)),
            None => Ok(Default::default()),
        }
    }
}
