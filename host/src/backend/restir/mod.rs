//! ReSTIR on the CPU and on a device: frames in a row, each one resampling what the one before left.
//!
//! Both sides run the functions of [`lightbvh_kernels::shading::restir`], where it stands what is unbiased and when.

pub(super) mod cpu;
pub(super) mod device;
mod remap;

pub use remap::LightRemap;

use std::sync::Arc;

use lightbvh::EmissiveTriangle;
use lightbvh_kernels::shading::restir::surface::Surface;
use lightbvh_kernels::shading::restir::{PixelReservoir, RestirParams};

use super::{BackendError, Sampler, SceneArrays};
use crate::scene::SceneLight;
use crate::words::{Field, Record};

/// How reservoirs are combined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, clap::ValueEnum, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum Combination {
    /// The expectation is the direct light; one shadow ray for each reservoir merged.
    // Under the conditions in `lightbvh_kernels::shading::restir`.
    Unbiased,
    /// Biased: darker where pixels that reuse each other's samples do not see the same lights; two shadow rays in all.
    /// Measured: 6 % of the light of the scene `street` is missing, a quarter in a scene made of penumbrae.
    // `tests/tests/restir_error.rs`, `restir_unbiased.rs`.
    Biased,
}

impl Combination {
    /// As on the command line and in reports.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Whether the expectation of an image is its direct light.
    pub fn is_unbiased(self) -> bool {
        self == Self::Unbiased
    }
}

/// What ReSTIR does in each frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RestirOptions {
    /// What initial candidates are chosen by: power, as in the paper on ReSTIR, or a light BVH.
    pub source: Sampler,
    /// How reservoirs are combined.
    pub combination: Combination,
    /// Candidates per pixel and frame, 1 to 1024: a software device ends the loops of an invocation after 65,535 turns in
    /// all (Mesa's llvmpipe), and a candidate takes 33 of them.
    pub candidates: u32,
    /// For how many times a frame's candidates the history counts at most; 0 for no reuse over time.
    pub history: u32,
    /// Neighbours per spatial pass, at most 1024.
    pub neighbors: u32,
    /// How far away they may be, pixels, at most 2^20.
    pub radius: u32,
    /// Spatial passes; 0 for no reuse over pixels.
    pub spatial_passes: u32,
}

impl RestirOptions {
    /// The settings of Bitterli et al. 2020, section 5: 32 candidates, a history of 20 times as many, neighbours within 30
    /// pixels — three of them and one pass where each costs a shadow ray, five and two passes where none does. From a
    /// light BVH a quarter as many: with 32 the street's error is 8 % lower (`lightbvh compare`, frames 0 and 60,
    /// 192 × 108), but llvmpipe then ends loops early in the scene `carousel`: `lightbvh verify` found 7,363 words different.
    pub fn new(source: Sampler, combination: Combination) -> Self {
        let (neighbors, spatial_passes) = match combination {
            Combination::Unbiased => (3, 1),
            Combination::Biased => (5, 2),
        };
        Self {
            source,
            combination,
            candidates: if source.needs_bvh() { 8 } else { 32 },
            history: 20,
            neighbors,
            radius: 30,
            spatial_passes,
        }
    }

    /// Shadow rays that a pixel costs in a frame at most: for visibility reuse, for the final sample, and, where the
    /// combination is unbiased, for the frame before and for each neighbour. [`Restir::shadow_rays`] counts those traced.
    pub fn most_shadow_rays(&self) -> u32 {
        2 + match self.combination {
            Combination::Unbiased => u32::from(self.history > 0) + self.neighbors * self.spatial_passes,
            Combination::Biased => 0,
        }
    }
}

/// One frame to render.
pub struct RestirFrame<'a, L = EmissiveTriangle> {
    /// The scene; kept until the next frame, which asks what it hid from whom.
    pub scene: &'a Arc<SceneArrays<L>>,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Chooses all random numbers but the next; another one for each frame.
    pub seed: u32,
    /// Chooses the points within the pixels that are looked at.
    pub jitter: u32,
    /// Radiance of what no surface covers, W/(m² sr).
    pub background: [f32; 3],
    /// What became of the lights of the frame before; `None` where each kept its number. Those of two levels do, as long as the
    /// numbers of removed ones are taken after the frame was resampled: see [`LightRemap::after`].
    pub remap: Option<&'a LightRemap>,
}

/// ReSTIR over frames in a row: what each leaves for the next. [`Backend::restir`](super::Backend::restir) renders them. Equal
/// frames give equal words, whatever runs them.
///
/// The history ends, as by [`reset`](Self::reset), where it cannot be used: the image has another size, reflectances differ,
/// another processor has rendered it, or the number of listed lights differs without a remap to say how. Two levels need none:
/// there lights keep their numbers.
///
/// A clone goes on from the same frame by itself.
pub struct Restir<L = EmissiveTriangle> {
    options: RestirOptions,
    last: Option<Last<L>>,
    shadow_rays: u64,
}

/// The frame before.
struct Last<L> {
    scene: Arc<SceneArrays<L>>,
    size: (u32, u32),
    left: Left<L>,
}

/// What a frame left where it was rendered.
enum Left<L> {
    Cpu(Arc<cpu::Left<L>>),
    Device(Arc<device::Left>),
}

impl<L> Clone for RestirFrame<'_, L> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<L> Copy for RestirFrame<'_, L> {}

impl<L> Clone for Restir<L> {
    fn clone(&self) -> Self {
        Self {
            options: self.options,
            last: self.last.clone(),
            shadow_rays: self.shadow_rays,
        }
    }
}

impl<L> Clone for Last<L> {
    fn clone(&self) -> Self {
        Self {
            scene: Arc::clone(&self.scene),
            size: self.size,
            left: self.left.clone(),
        }
    }
}

impl<L> Clone for Left<L> {
    fn clone(&self) -> Self {
        match self {
            Self::Cpu(left) => Self::Cpu(Arc::clone(left)),
            Self::Device(left) => Self::Device(Arc::clone(left)),
        }
    }
}

impl<L: SceneLight> Restir<L> {
    /// Before the first frame.
    pub fn new(options: RestirOptions) -> Self {
        Self {
            options,
            last: None,
            shadow_rays: 0,
        }
    }

    /// What is done in each frame.
    pub fn options(&self) -> &RestirOptions {
        &self.options
    }

    /// Forgets the frames so far.
    pub fn reset(&mut self) {
        self.last = None;
    }

    /// Shadow rays that the last frame traced, over all pixels.
    pub fn shadow_rays(&self) -> u64 {
        self.shadow_rays
    }

    /// G-buffer and reservoirs of the last frame, for comparing; empty before the first.
    ///
    /// # Errors
    /// [`BackendError`] from a device.
    pub fn state(&self) -> Result<History, BackendError> {
        match self.last.as_ref().map(|last| &last.left) {
            Some(Left::Cpu(left)) => Ok(left.state()),
            Some(Left::Device(left)) => left.state(),
            None => Ok(Default::default()),
        }
    }

    /// The frame before, where `frame` may use it.
    fn history(&self, frame: &RestirFrame<'_, L>) -> Option<&Last<L>> {
        self.last.as_ref().filter(|last| {
            let count = |scene: &SceneArrays<L>| scene.lights.triangles().len();
            let (then, now) = (count(&last.scene), count(frame.scene));
            let lights_known = match frame.remap {
                _ if self.options.source == Sampler::TwoLevel => true,
                Some(remap) => remap.to_current().len() == then && remap.to_previous().len() == now,
                None => then == now,
            };
            self.options.history > 0
                && last.size == (frame.width, frame.height)
                && last.scene.materials == frame.scene.materials
                && lights_known
        })
    }

    /// Keeps what `frame` left, which traced `shadow_rays`.
    fn keep(&mut self, frame: &RestirFrame<'_, L>, left: Left<L>, shadow_rays: u64) {
        self.shadow_rays = shadow_rays;
        self.last = Some(Last {
            scene: Arc::clone(frame.scene),
            size: (frame.width, frame.height),
            left,
        });
    }
}

/// Words of a G-buffer's pixel.
pub const SURFACE_RECORD: Record = Record {
    name: "surface",
    fields: &[
        Field::new("p", 3),
        Field::new("n", 3),
        Field::new("wo", 3),
        Field::new("material", 1),
        Field::new("direct", 3),
        Field::new("distance_squared", 1),
    ],
};

/// Words of a pixel's reservoir.
pub const RESERVOIR_RECORD: Record = Record {
    name: "reservoir",
    fields: &[
        Field::index("light"),
        Field::index("instance"),
        Field::new("uv", 2),
        Field::new("weight", 1),
        Field::new("count", 1),
        Field::new("shadow_rays", 1),
    ],
};

/// G-buffer and reservoirs of a frame.
pub type History = (Vec<Surface>, Vec<PixelReservoir>);

/// Parameters of the passes.
fn params<L>(options: &RestirOptions, frame: &RestirFrame<'_, L>) -> RestirParams {
    RestirParams {
        width: frame.width,
        height: frame.height,
        seed: frame.seed,
        jitter: frame.jitter,
        background: frame.background,
        candidates: options.candidates,
        history: options.history.saturating_mul(options.candidates),
        neighbors: options.neighbors,
        radius: options.radius,
        spatial_pass: 0,
        remapped: u32::from(frame.remap.is_some()),
        drops_occluded: u32::from(options.combination == Combination::Unbiased),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_most_shadow_rays_are_those_of_the_passes() {
        let unbiased = RestirOptions::new(Sampler::Power, Combination::Unbiased);
        assert_eq!(unbiased.most_shadow_rays(), 6);
        let initial_only = RestirOptions {
            history: 0,
            spatial_passes: 0,
            ..unbiased
        };
        assert_eq!(initial_only.most_shadow_rays(), 2);
        let biased = RestirOptions::new(Sampler::TwoLevel, Combination::Biased);
        assert_eq!(biased.most_shadow_rays(), 2);
    }
}
