//! The methods that are compared: how each chooses lights, and what it does from frame to frame to keep choosing well.
//!
//! [`Method`] names each; its [`Recipe`] says what it does, and makes the [`Runner`] that does it.

mod independent;
mod names;

pub use names::{Builder, Importance, Method, Recipe};

use std::time::Duration;

use lightbvh::light::AnyLight;
use lightbvh::{EditError, EmissiveTriangle, Lights};
use lightbvh_kernels::bvh::{AnyKind, Compiled, Paper, Triangles, WIDTH};
use lightbvh_kernels::render::RenderParams;

use self::independent::Independent;
use crate::backend::{
    Backend, BackendError, Bvh, CpuBackend, DeviceBackend, Follow, Held, SceneArrays, Timed,
};
use crate::error::HostError;
use crate::scene::{Scene, SceneLight};
use crate::vulkan::Device;

/// A frame of an animation, as a method learns of it.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a, L = EmissiveTriangle> {
    /// The scene.
    pub scene: &'a Scene,
    /// Number of the frame.
    pub frame: u32,
    /// Its lights.
    pub lights: &'a Lights<L>,
}

impl<'a, L> Step<'a, L> {
    /// A frame of a scene.
    pub fn new(scene: &'a Scene, frame: u32, lights: &'a Lights<L>) -> Self {
        Self { scene, frame, lights }
    }

    /// The error for lights of this frame that a light BVH does not take.
    pub(crate) fn refused(&self, error: EditError) -> HostError {
        HostError::in_frame(self.scene.name(), self.frame, error)
    }
}

/// Times of bringing a method's structures to a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct UpdateTimes {
    /// New bounds in the structures there are.
    pub refit: Duration,
    /// Building structures anew, wherever and whenever it ran.
    pub rebuild: Duration,
    /// How long the frame waited for a rebuild: all of it if it does not run in the background.
    pub wait: Duration,
}

/// The unit of [`RenderParams::samples`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SampleBudget {
    /// Shadow rays per pixel, so that methods can be compared at equal cost. All look at the same points in the pixels.
    ShadowRays,
    /// Light samples per pixel, or paths, shared out over points of their own in the pixels, the same in every frame: edges become
    /// smooth.
    CameraRays,
}

/// A light BVH in figures.
#[derive(Clone, Debug)]
pub struct TreeFacts {
    /// The invariant that does not hold.
    pub violation: Option<String>,
    /// Number of nodes.
    pub nodes: usize,
    /// Greatest number of nodes on a path from the root to a light.
    pub depth: u32,
    /// Bytes that sampling reads.
    pub bytes: usize,
}

/// A method over one scene on one backend, whose lights are of type `L`.
pub trait Runner<L: SceneLight = EmissiveTriangle> {
    /// Brings the structures to the next frame. Frames come in ascending order, without gaps.
    fn advance(&mut self, step: &Step<'_, L>) -> Result<UpdateTimes, HostError>;

    /// Renders the frame last advanced to, which `arrays` are of.
    fn image(
        &mut self,
        step: &Step<'_, L>,
        arrays: &SceneArrays<L>,
        params: &RenderParams,
    ) -> Result<Timed<Vec<[f32; 3]>>, HostError>;

    /// The backend, as of the frame last advanced to.
    fn backend(&mut self) -> &mut dyn Backend<L>;

    /// The words in use of each buffer of the [`backend`](Self::backend).
    fn held(&mut self) -> Result<Vec<Held>, HostError>;

    /// The light BVH; none where lights are chosen by a table.
    fn tree(&self) -> Option<TreeFacts>;
}

/// Where a method renders and refits.
#[derive(Clone, Copy)]
pub enum Target<'d> {
    /// All cores of the current rayon pool.
    Cpu,
    /// A Vulkan device.
    Device(&'d Device),
}

impl<'d> Target<'d> {
    /// As in tables.
    pub fn name(&self) -> &str {
        match self {
            Self::Cpu => "cpu",
            Self::Device(device) => device.name(),
        }
    }

    /// A backend over `bvh`.
    pub(crate) fn backend<C: Compiled<W, Light: SceneLight>, const W: usize>(
        &self,
        bvh: Bvh<C, W>,
    ) -> Result<Box<dyn Follow<C, W> + 'd>, BackendError> {
        Ok(match *self {
            Self::Cpu => Box::new(CpuBackend::<C, W>::new(bvh)),
            Self::Device(device) => Box::new(DeviceBackend::<C, W>::new(device, &bvh)?),
        })
    }
}

impl Recipe {
    /// Builds what the method needs at its first frame.
    pub fn runner<'d, L: MethodLight>(
        &self,
        first: &Step<'_, L>,
        target: Target<'d>,
    ) -> Result<Box<dyn Runner<L> + 'd>, HostError> {
        L::runner(self, first, target)
    }

    fn runner_by<'d, C: Compiled<W, Light: SceneLight>, const W: usize>(
        &self,
        first: &Step<'_, C::Light>,
        target: Target<'d>,
    ) -> Result<Box<dyn Runner<C::Light> + 'd>, HostError> {
        Ok(Box::new(Independent::<C, W>::new(*self, first, target)?))
    }
}

/// Lights that methods are compiled for.
pub trait MethodLight: SceneLight {
    /// The importances that may choose them.
    const IMPORTANCES: &'static [Importance];

    /// Builds what `recipe` needs at its first frame.
    fn runner<'d>(
        recipe: &Recipe,
        first: &Step<'_, Self>,
        target: Target<'d>,
    ) -> Result<Box<dyn Runner<Self> + 'd>, HostError>;
}

impl MethodLight for EmissiveTriangle {
    const IMPORTANCES: &'static [Importance] = &Importance::ALL;

    fn runner<'d>(
        recipe: &Recipe,
        first: &Step<'_, Self>,
        target: Target<'d>,
    ) -> Result<Box<dyn Runner<Self> + 'd>, HostError> {
        match recipe.importance {
            Importance::Moments => recipe.runner_by::<Triangles, WIDTH>(first, target),
            Importance::Eq4 => recipe.runner_by::<Paper, 4>(first, target),
        }
    }
}

impl MethodLight for AnyLight {
    const IMPORTANCES: &'static [Importance] = &[Importance::Moments];

    fn runner<'d>(
        recipe: &Recipe,
        first: &Step<'_, Self>,
        target: Target<'d>,
    ) -> Result<Box<dyn Runner<Self> + 'd>, HostError> {
        match recipe.importance {
            Importance::Moments => recipe.runner_by::<AnyKind, WIDTH>(first, target),
            Importance::Eq4 => Err(HostError::Usage {
                option: "a --sampler by the paper's importance",
                needs: "a scene of emissive triangles alone; this one has other lights, or textures, which the renderer shows with moments only",
            }),
        }
    }
}
