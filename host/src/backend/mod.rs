//! Backends, which run the passes: the CPU over all its cores, or a Vulkan device. Both run the same functions on the same arrays,
//! so [`words`](crate::words) may ask for equal words. A [`Compiled`] says over which node layout, by which importance;
//! [`Triangles`] where it is left out.

mod batches;
mod cpu;
mod device;
mod device_arrays;
mod follow;
mod record;
mod scene;

pub use batches::Integrator;
pub(crate) use batches::mean_image;
pub use cpu::CpuBackend;
pub use device::DeviceBackend;
pub use follow::Mirrored;
pub use record::{Held, PIXEL_RECORD, PMF_RECORD, SAMPLED_RECORD, held};
pub use scene::{Sampler, SceneArrays};

use std::time::{Duration, Instant};

pub use lightbvh::Bvh;
use lightbvh::error::FollowError;
use lightbvh::{EmissiveTriangle, SampledLight};
use lightbvh_kernels::bvh::{Compiled, Triangles, WIDTH};
use lightbvh_kernels::query::Query;
use lightbvh_kernels::render::RenderParams;
use lightbvh_kernels::shading::emitter::Emitter;

use crate::vulkan::VulkanError;

/// An error of a backend.
#[derive(Debug, thiserror::Error)]
pub enum BackendError {
    /// The device.
    #[error(transparent)]
    Vulkan(#[from] VulkanError),
    /// The lights are not those that the BVH was built over.
    #[error(transparent)]
    Lights(#[from] FollowError),
}

/// A result and how long it took: on a device the kernels' own time, where it can tell.
#[derive(Clone, Debug)]
pub struct Timed<T> {
    /// The result.
    pub value: T,
    /// Time of the work itself, without transfers.
    pub time: Duration,
}

impl<T> Timed<T> {
    /// Does the work, by this machine's clock.
    pub(crate) fn of(work: impl FnOnce() -> T) -> Self {
        let start = Instant::now();
        let value = work();
        let time = start.elapsed();
        Self { value, time }
    }
}

/// Runs the passes over one light BVH, whose lights are of type `L`.
pub trait Backend<L: Emitter = EmissiveTriangle> {
    /// Chooses a light for each query.
    fn sample(&mut self, queries: &[Query]) -> Result<Timed<Vec<SampledLight>>, BackendError>;

    /// Evaluates the probability of each query's light.
    fn pmf(&mut self, queries: &[Query]) -> Result<Timed<Vec<f32>>, BackendError>;

    /// Renders the light that `integrator` follows, with lights chosen by `sampler`; the light BVH's samplers use this backend's
    /// BVH. [`RenderParams::samples`] counts light samples, or paths; more than
    /// [`samples_per_invocation`](Integrator::samples_per_invocation) are the mean of several images, the same ones on every
    /// backend.
    fn render(
        &mut self,
        scene: &SceneArrays<L>,
        params: &RenderParams,
        sampler: Sampler,
        integrator: Integrator,
    ) -> Result<Timed<Vec<[f32; 3]>>, BackendError>;
}

/// A backend that follows a BVH through its edits.
pub trait Follow<C: Compiled<W> = Triangles, const W: usize = WIDTH>: Backend<C::Light> {
    /// Copies the changes in `bvh` as of its last refit, and refits here.
    fn follow(&mut self, bvh: &Bvh<C, W>) -> Result<Timed<()>, BackendError>;

    /// The words in use of each buffer, as of the last [`follow`](Self::follow), which was of `bvh`.
    fn held(&mut self, bvh: &Bvh<C, W>) -> Result<Vec<Held>, BackendError>;
}
