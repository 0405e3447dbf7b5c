//! What runs the passes: the CPU over all its cores, or a Vulkan device. Both run the same functions on the same arrays,
//! so [`compare`](crate::compare) may ask for equal words. A [`Choice`] says over which node layout, by which importance;
//! [`Standard`] where it is left out.

mod cpu;
mod device;
mod follow;
mod parts;
mod record;
mod restir;
mod scene;
mod structure;

pub use cpu::CpuBackend;
pub use device::DeviceBackend;
pub use parts::MAX_SAMPLES_PER_INVOCATION;
pub use record::{PIXEL_RECORD, PMF_RECORD, SAMPLED_RECORD, node_record};
pub use restir::{
    CandidateSource, Combination, CpuRestir, DeviceRestir, LightRemap, RESERVOIR_RECORD, Restir, RestirFrame,
    RestirOptions, SURFACE_RECORD,
};
pub use scene::{Sampler, SceneArrays};
pub use structure::Structure;

use std::time::Duration;

use lightbvh::{LightBvh, Lights};
use lightbvh_kernels::bvh::{Choice, Standard, WIDTH};
use lightbvh_kernels::query::{Query, Sampled};
use lightbvh_kernels::render::RenderParams;

use crate::compare::Record;
use crate::vulkan::VulkanError;

/// The light BVH of a choice.
pub type Bvh<C = Standard, const W: usize = WIDTH> = LightBvh<<C as Choice<W>>::Node, W>;

/// The moving lights of a choice.
pub type LightScene<C = Standard, const W: usize = WIDTH> = lightbvh::Scene<<C as Choice<W>>::Node, W>;

/// A result and how long it took: on a device the kernels' own time, where it can tell.
#[derive(Clone, Debug)]
pub struct Timed<T> {
    /// The result.
    pub value: T,
    /// Time of the work itself, without transfers.
    pub time: Duration,
}

/// Runs the passes over one light BVH.
pub trait Backend {
    /// Name for tables.
    fn name(&self) -> &str;

    /// Words of a node.
    fn node_record(&self) -> Record;

    /// Refits a BVH to `lights`, which are those of the BVH moved or changed, and returns the words of all nodes. Moving
    /// lights are left as they are.
    ///
    /// # Errors
    /// [`VulkanError`] from a device.
    fn refit(&mut self, lights: &Lights) -> Result<Timed<Vec<u32>>, VulkanError>;

    /// The words of all nodes as they are.
    ///
    /// # Errors
    /// [`VulkanError`] from a device.
    fn nodes(&mut self) -> Result<Vec<u32>, VulkanError>;

    /// Chooses a light for each query.
    ///
    /// # Errors
    /// [`VulkanError`] from a device.
    fn sample(&mut self, queries: &[Query]) -> Result<Timed<Vec<Sampled>>, VulkanError>;

    /// Evaluates the probability of each query's light.
    ///
    /// # Errors
    /// [`VulkanError`] from a device.
    fn pmf(&mut self, queries: &[Query]) -> Result<Timed<Vec<f32>>, VulkanError>;

    /// Renders direct lighting with lights chosen by `sampler`; the light BVH's samplers use this backend's BVH. More than
    /// [`MAX_SAMPLES_PER_INVOCATION`] samples are the mean of several images, the same ones on every backend.
    ///
    /// # Errors
    /// [`VulkanError`] from a device.
    fn render(
        &mut self,
        scene: &SceneArrays,
        params: &RenderParams,
        sampler: Sampler,
    ) -> Result<Timed<Vec<[f32; 3]>>, VulkanError>;

    /// Renders light along paths of up to `bounces` reflections, at most
    /// [`MAX_BOUNCES`](lightbvh_kernels::shading::path::MAX_BOUNCES), with lights chosen as by [`render`](Self::render);
    /// [`RenderParams::samples`] counts paths, which are shared out over several images where they are many or long.
    ///
    /// # Errors
    /// [`VulkanError`] from a device.
    fn render_path(
        &mut self,
        scene: &SceneArrays,
        params: &RenderParams,
        bounces: u32,
        sampler: Sampler,
    ) -> Result<Timed<Vec<[f32; 3]>>, VulkanError>;
}

/// A backend that follows moving lights.
pub trait Follow<C: Choice<W> = Standard, const W: usize = WIDTH>: Backend {
    /// Takes over what [`plan`](lightbvh::Scene::plan) says has changed in `scene`, and refits it here. Planned frames must
    /// be followed without gaps, each before it is refitted in `scene` itself; `lights` are its lights in the world.
    ///
    /// # Errors
    /// [`VulkanError`] from a device.
    fn follow(&mut self, scene: &LightScene<C, W>, lights: &Lights) -> Result<Timed<()>, VulkanError>;
}
