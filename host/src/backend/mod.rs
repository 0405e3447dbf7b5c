//! What runs the passes: the CPU over all its cores, or a Vulkan device. Both run the same functions on the same arrays,
//! so [`compare`](crate::compare) may ask for equal words.

mod climb;
mod cpu;
mod device;
mod follow;
mod parts;
mod restir;
mod scene;
mod structure;

pub use cpu::CpuBackend;
pub use device::DeviceBackend;
pub use parts::MAX_SAMPLES_PER_INVOCATION;
pub use restir::{
    CandidateSource, Combination, CpuRestir, DeviceRestir, LightRemap, RESERVOIR_RECORD, Restir, RestirFrame,
    RestirOptions, SURFACE_RECORD,
};
pub use scene::{Sampler, SceneArrays};
pub use structure::{Structure, picker};

use std::time::Duration;

use lightbvh::{Instance, LightBvh, Lights};
use lightbvh_kernels::bvh::{Node, WIDTH};
use lightbvh_kernels::query::{Query, Sampled};
use lightbvh_kernels::render::RenderParams;

use crate::compare::{Field, Record};
use crate::vulkan::VulkanError;

/// The light BVH that the kernels are compiled for.
pub type Bvh = LightBvh<Node, WIDTH, Instance>;

/// The moving lights that the kernels are compiled for.
pub type LightScene = lightbvh::Scene<Node, WIDTH>;

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

    /// Refits a BVH to `lights`, which are those of the BVH moved or changed, and returns all nodes. Moving lights are left
    /// as they are.
    ///
    /// # Errors
    /// [`VulkanError`] from a device.
    fn refit(&mut self, lights: &Lights) -> Result<Timed<Vec<Node>>, VulkanError>;

    /// As [`refit`](Self::refit), to the same words, but with one dispatch for all bottom levels and one for the top level:
    /// each invocation goes up from a lowest node, and on from each node only if all below it is done. The CPU does this
    /// with one thread.
    ///
    /// # Errors
    /// [`VulkanError`] from a device.
    fn refit_once(&mut self, lights: &Lights) -> Result<Timed<Vec<Node>>, VulkanError>;

    /// Takes over what [`plan`](lightbvh::Scene::plan) says has changed in `scene`, and refits it here. Planned frames must
    /// be followed without gaps, each before it is refitted in `scene` itself; `lights` are its lights in the world.
    ///
    /// # Errors
    /// [`VulkanError`] from a device.
    fn follow(&mut self, scene: &LightScene, lights: &Lights) -> Result<Timed<()>, VulkanError>;

    /// All nodes as they are.
    ///
    /// # Errors
    /// [`VulkanError`] from a device.
    fn nodes(&mut self) -> Result<Vec<Node>, VulkanError>;

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

/// Words of a node, for comparison by name.
pub const NODE_RECORD: Record = Record {
    name: "node",
    fields: &[
        Field::new("center_x", WIDTH as u32),
        Field::new("center_y", WIDTH as u32),
        Field::new("center_z", WIDTH as u32),
        Field::new("extent", WIDTH as u32),
        Field::new("axis_kind", WIDTH as u32),
        Field::new("phi_cone", WIDTH as u32),
        Field::new("link", WIDTH as u32),
    ],
};

/// Words of a sampled light.
pub const SAMPLED_RECORD: Record = Record {
    name: "sampled light",
    fields: &[Field::index("light"), Field::new("pmf", 1)],
};

/// Word of a pmf.
pub const PMF_RECORD: Record = Record {
    name: "pmf",
    fields: &[Field::new("pmf", 1)],
};

/// Words of a pixel.
pub const PIXEL_RECORD: Record = Record {
    name: "pixel",
    fields: &[Field::new("radiance", 3)],
};
