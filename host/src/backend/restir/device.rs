//! ReSTIR on a Vulkan device.

use std::sync::Arc;
use std::time::Duration;

use bytemuck::bytes_of;
use lightbvh::TreeWords;
use lightbvh_kernels::bvh::Choice;
use lightbvh_kernels::restir::RestirPush;
use lightbvh_kernels::shading::emitter::Emitter;
use lightbvh_kernels::shading::restir::shade::Shaded;
use lightbvh_kernels::shading::restir::surface::Surface;
use lightbvh_kernels::shading::restir::{PixelReservoir, RestirParams};

use super::{History, Restir, RestirFrame, params};
use crate::backend::device_arrays::{DeviceScene, choosing, device_time};
use crate::backend::{BackendError, DeviceBackend, Timed};
use crate::scene::SceneLight;
use crate::vulkan::{Binding, Buffer, Kernel, Pass};

/// Candidates or neighbours per submission: keeps one well below the seconds after which a driver gives up on it.
const WORK_PER_PASS: usize = 1 << 21;

/// What a frame leaves on a device.
pub(super) struct Left {
    /// The scene as it was, its lights too: where they changed since, the light BVH has copies of its own.
    scene: DeviceScene,
    gbuffer: Buffer<Surface>,
    reservoirs: Buffer<PixelReservoir>,
}

impl Left {
    /// G-buffer and reservoirs.
    pub fn state(&self) -> Result<History, BackendError> {
        Ok((self.gbuffer.read()?, self.reservoirs.read()?))
    }
}

/// The next frame, with candidates from `backend`'s light BVH where the options say so.
pub(in crate::backend) fn resample<C: Choice<W, Light: SceneLight>, const W: usize>(
    restir: &mut Restir<C::Light>,
    frame: &RestirFrame<'_, C::Light>,
    backend: &mut DeviceBackend<'_, C, W>,
) -> Result<Timed<Vec<[f32; 3]>>, BackendError> {
    let (device, options) = (backend.device, restir.options);
    let mut params = params(&options, frame);
    let pixels = frame.width as usize * frame.height as usize;
    let emitters = backend.emitters(options.source);
    let scene = backend
        .scene
        .bring(device, frame.scene, options.source, emitters)?;
    let gbuffer = device.output::<Surface>(pixels)?;
    let mut reservoirs = device.output::<PixelReservoir>(pixels)?;
    let tree = backend.tree.push;
    let mut time = Duration::ZERO;
    let mut run = |kernel: &Arc<Kernel>, bindings: &[Binding], params: &RestirParams, tree, work: u32| {
        let per_pass = (WORK_PER_PASS / work.max(1) as usize).max(64);
        for first in (0..pixels).step_by(per_pass) {
            let push = RestirPush {
                params: *params,
                first: first as u32,
                count: usize::min(per_pass, pixels - first) as u32,
                tree,
            };
            let mut pass = Pass::new();
            pass.dispatch(kernel, bindings, bytes_of(&push), push.count);
            time += device_time(&device.run(&pass)?);
        }
        Ok::<_, BackendError>(())
    };

    let inputs = scene.with_lights(&backend.tree);
    let bindings = [inputs.as_slice(), &[gbuffer.bind(), reservoirs.bind()]].concat();
    let kernel = device.kernel_with(&format!("restir_initial{}", C::SUFFIX), choosing(options.source))?;
    run(&kernel, &bindings, &params, tree, options.candidates)?;

    let none = TreeWords::default();
    let is_unbiased = u32::from(options.combination.is_unbiased());
    let reusing = |pass: &str| device.kernel_with(&format!("{pass}{}", C::Light::SUFFIX), is_unbiased);
    if let Some(last) = restir.history(frame)
        && let super::Left::Device(left) = &last.left
        && left.gbuffer.is_on(device)
    {
        let (to_current, to_previous) = frame
            .remap
            .map_or((&[][..], &[][..]), |r| (r.to_current(), r.to_previous()));
        let to_current = device.upload(to_current)?;
        let to_previous = device.upload(to_previous)?;
        let [ray_nodes, surfaces, _, triangles, instances] = left.scene.view();
        let then = [ray_nodes, surfaces, triangles, instances, to_previous.bind()];
        let [_, _, materials, triangles, instances] = scene.view();
        let common = [
            materials,
            triangles,
            instances,
            left.scene.camera.clone(),
            left.gbuffer.bind(),
            left.reservoirs.bind(),
            to_current.bind(),
            gbuffer.bind(),
            reservoirs.bind(),
        ];
        let bindings = [then.as_slice(), common.as_slice(), left.scene.skin()].concat();
        let kernel = reusing("restir_temporal")?;
        run(&kernel, &bindings, &params, none, 4)?;
    }
    for spatial_pass in 0..options.spatial_passes {
        params.spatial_pass = spatial_pass;
        let merged = device.output::<PixelReservoir>(pixels)?;
        let pixel_buffers = [gbuffer.bind(), reservoirs.bind(), merged.bind()];
        let bindings = [scene.view().as_slice(), &pixel_buffers, scene.skin()].concat();
        let work = options.neighbors.saturating_add(1).saturating_mul(2);
        let kernel = reusing("restir_spatial")?;
        run(&kernel, &bindings, &params, none, work)?;
        reservoirs = merged;
    }
    let output = device.output::<Shaded>(pixels)?;
    let pixel_buffers = [gbuffer.bind(), reservoirs.bind(), output.bind()];
    let bindings = [scene.view().as_slice(), &pixel_buffers, &scene.surroundings()].concat();
    let kernel = device.kernel(&format!("restir_shade{}", C::Light::SUFFIX))?;
    run(&kernel, &bindings, &params, none, 2)?;
    let shaded = output.read()?;
    let shadow_rays = shaded.iter().map(|pixel| u64::from(pixel.shadow_rays)).sum();
    let left = Left {
        scene,
        gbuffer,
        reservoirs,
    };
    restir.keep(frame, super::Left::Device(Arc::new(left)), shadow_rays);
    Ok(Timed {
        value: shaded.iter().map(|pixel| pixel.radiance).collect(),
        time,
    })
}
