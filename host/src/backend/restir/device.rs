//! ReSTIR on a Vulkan device.

use std::marker::PhantomData;
use std::sync::Arc;
use std::time::Duration;

use bytemuck::{Pod, bytes_of};
use lightbvh::{EmissiveTriangle, Instance};
use lightbvh_kernels::bvh::{Choice, Standard, TreeOf, TreePush, WIDTH};
use lightbvh_kernels::restir::RestirPush;
use lightbvh_kernels::shading::camera::Camera;
use lightbvh_kernels::shading::material::Material;
use lightbvh_kernels::shading::restir::shade::Shaded;
use lightbvh_kernels::shading::restir::surface::Surface;
use lightbvh_kernels::shading::restir::{PixelReservoir, RestirParams};
use lightbvh_kernels::shading::trace::{RayNode, SurfaceTriangle};

use super::{CandidateSource, Combination, Restir, RestirFrame, RestirOptions, continues, params};
use crate::backend::device::device_time;
use crate::backend::{SceneArrays, Timed};
use crate::vulkan::{Binding, Buffer, Device, Pass, VulkanError};

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

/// A frame's scene on the device.
struct SceneBuffers {
    ray_nodes: Buffer<RayNode>,
    surfaces: Buffer<SurfaceTriangle>,
    materials: Buffer<Material>,
    lights: Buffer<EmissiveTriangle>,
    camera: Buffer<Camera>,
}

/// The frame before.
struct Last {
    scene: Arc<SceneArrays>,
    size: (u32, u32),
    buffers: SceneBuffers,
    gbuffer: Buffer<Surface>,
    reservoirs: Buffer<PixelReservoir>,
}

/// What initial candidates are drawn from.
enum SourceBuffers<N> {
    Power(Buffer<u32>),
    LightBvh(Box<TreeBuffers<N>>),
}

/// A light BVH on the device.
struct TreeBuffers<N> {
    nodes: Buffer<N>,
    instances: Buffer<Instance>,
    trails: Buffer<u32>,
    push: TreePush,
    kernel: String,
}

impl SceneBuffers {
    fn upload(device: &Device, scene: &SceneArrays) -> Result<Self, VulkanError> {
        Ok(Self {
            ray_nodes: device.upload(&scene.rays.nodes)?,
            surfaces: device.upload(&scene.rays.triangles)?,
            materials: device.upload(&scene.materials)?,
            lights: device.upload(scene.lights.triangles())?,
            camera: device.upload(&[scene.camera])?,
        })
    }

    /// The four buffers that a [`Scene`](lightbvh_kernels::shading::pixel::Scene) is made of.
    fn view(&self) -> [Binding<'_>; 4] {
        [
            self.ray_nodes.bind(),
            self.surfaces.bind(),
            self.materials.bind(),
            self.lights.bind(),
        ]
    }
}

impl<N: Pod> SourceBuffers<N> {
    fn upload<C: Choice<W, Node = N>, const W: usize>(
        device: &Device,
        source: CandidateSource,
        scene: &SceneArrays,
        tree: &TreeOf<'_, C, W>,
    ) -> Result<Self, VulkanError> {
        Ok(match source {
            CandidateSource::Power => Self::Power(device.upload(&scene.thresholds)?),
            CandidateSource::LightBvh => Self::LightBvh(Box::new(TreeBuffers {
                nodes: device.upload(tree.nodes)?,
                instances: device.upload(tree.instances)?,
                trails: device.upload(tree.trails)?,
                push: TreePush::of(tree),
                kernel: format!("restir_initial_bvh{}", C::SUFFIX),
            })),
        })
    }

    fn kernel(&self) -> &str {
        match self {
            Self::Power(_) => "restir_initial_power",
            Self::LightBvh(tree) => &tree.kernel,
        }
    }

    fn bindings(&self) -> Vec<Binding<'_>> {
        match self {
            Self::Power(thresholds) => vec![thresholds.bind()],
            Self::LightBvh(tree) => vec![tree.nodes.bind(), tree.instances.bind(), tree.trails.bind()],
        }
    }

    fn push(&self) -> TreePush {
        match self {
            Self::Power(_) => TreePush::default(),
            Self::LightBvh(tree) => tree.push,
        }
    }
}

impl<'d, C: Choice<W>, const W: usize> DeviceRestir<'d, C, W> {
    /// Before the first frame.
    #[must_use]
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
    ) -> Result<Duration, VulkanError> {
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
        scene: &SceneBuffers,
        gbuffer: &Buffer<Surface>,
        reservoirs: &Buffer<PixelReservoir>,
    ) -> Result<Duration, VulkanError> {
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
    fn frame(&mut self, frame: &RestirFrame<'_, C, W>) -> Result<Timed<Vec<[f32; 3]>>, VulkanError> {
        let device = self.device;
        let mut params = params(&self.options, frame);
        let pixels = frame.width as usize * frame.height as usize;
        let scene = SceneBuffers::upload(device, frame.scene)?;
        let source = SourceBuffers::upload::<C, W>(device, self.options.source, frame.scene, &frame.bvh)?;
        let gbuffer = device.output::<Surface>(pixels)?;
        let mut reservoirs = device.output::<PixelReservoir>(pixels)?;
        let none = TreePush::default();

        let own = [
            vec![scene.camera.bind()],
            source.bindings(),
            vec![gbuffer.bind(), reservoirs.bind()],
        ]
        .concat();
        let bindings = [scene.view().as_slice(), &own].concat();
        let work = self.options.candidates;
        let mut time = self.over_pixels(source.kernel(), &bindings, &params, source.push(), work)?;

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

    fn state(&self) -> Result<(Vec<Surface>, Vec<PixelReservoir>), VulkanError> {
        match &self.last {
            Some(last) => Ok((last.gbuffer.read()?, last.reservoirs.read()?)),
            None => Ok(Default::default()),
        }
    }
}
