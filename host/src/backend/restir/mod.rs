//! ReSTIR on the CPU and on a device: frames in a row, each one resampling what the one before left.
//!
//! Both sides run the functions of [`lightbvh_kernels::shading::restir`], where it stands what is unbiased and when.

mod cpu;
mod device;

pub use cpu::CpuRestir;
pub use device::DeviceRestir;

use std::sync::Arc;

use lightbvh_kernels::bvh::{Choice, Standard, TreeOf, WIDTH};
use lightbvh_kernels::shading::restir::surface::Surface;
use lightbvh_kernels::shading::restir::{PixelReservoir, RestirParams};
use lightbvh_kernels::shading::trace::NONE;

use super::{BackendError, Sampler, SceneArrays, Timed};
use crate::words::{Field, Record};

/// How reservoirs are combined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, clap::ValueEnum, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum Combination {
    /// The expectation is the direct light (under the conditions in [`lightbvh_kernels::shading::restir`]); one shadow ray
    /// for each reservoir merged.
    Unbiased,
    /// Biased: darker where pixels that reuse each other's samples do not see the same lights; two shadow rays in all.
    /// Measured: 6 % of the light of the scene `street` is missing (`tests/tests/restir_error.rs`), a quarter in a scene
    /// made of penumbrae (`restir_unbiased.rs`).
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
    /// What initial candidates are chosen by: power, as in the paper on ReSTIR, or a light BVH. There is no kernel for
    /// [`Sampler::Uniform`], so devices refuse it.
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

/// Which lights of the frame before are which of this one's, where lights came, went or changed their index.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LightRemap {
    to_current: Vec<u32>,
    to_previous: Vec<u32>,
}

impl LightRemap {
    /// From the index now of each light of the frame before (`u32::MAX` for one that is gone), of `now` lights. An index
    /// that is out of range or was given before counts as gone: no two lights can become one.
    pub fn new(to_current: &[u32], now: usize) -> Self {
        let mut to_previous = vec![NONE; now];
        let to_current = to_current
            .iter()
            .enumerate()
            .map(
                |(previous, &current)| match to_previous.get_mut(current as usize) {
                    Some(slot) if *slot == NONE => {
                        *slot = previous as u32;
                        current
                    }
                    _ => NONE,
                },
            )
            .collect();
        Self {
            to_current,
            to_previous,
        }
    }

    /// By index in the frame before.
    pub fn to_current(&self) -> &[u32] {
        &self.to_current
    }

    /// By index now.
    pub fn to_previous(&self) -> &[u32] {
        &self.to_previous
    }
}

/// One frame to render.
#[derive(Clone, Copy)]
pub struct RestirFrame<'a, C: Choice<W> = Standard, const W: usize = WIDTH> {
    /// The scene; kept until the next frame, which asks what it hid from whom.
    pub scene: &'a Arc<SceneArrays>,
    /// The light BVH over its lights; used where candidates are chosen by it.
    pub bvh: TreeOf<'a, C, W>,
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
    /// What became of the lights of the frame before; `None` where each kept its index.
    pub remap: Option<&'a LightRemap>,
}

/// ReSTIR over frames in a row. Equal frames give equal words, whatever runs them.
pub trait Restir<C: Choice<W> = Standard, const W: usize = WIDTH> {
    /// Renders the next frame: direct lighting, W/(m² sr), by rows from the upper left.
    ///
    /// The history ends, as by [`reset`](Self::reset), where it cannot be used: the image has another size, reflectances
    /// differ, or the number of lights does without a remap to say how.
    ///
    /// # Errors
    /// [`BackendError`] from a device.
    fn frame(&mut self, frame: &RestirFrame<'_, C, W>) -> Result<Timed<Vec<[f32; 3]>>, BackendError>;

    /// Forgets the frames so far.
    fn reset(&mut self);

    /// Shadow rays that the last frame traced, over all pixels.
    fn shadow_rays(&self) -> u64;

    /// G-buffer and reservoirs of the last frame, for comparing; empty before the first.
    ///
    /// # Errors
    /// [`BackendError`] from a device.
    fn state(&self) -> Result<History, BackendError>;
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
        Field::new("uv", 2),
        Field::new("weight", 1),
        Field::new("count", 1),
        Field::new("shadow_rays", 1),
    ],
};

/// G-buffer and reservoirs of a frame.
pub type History = (Vec<Surface>, Vec<PixelReservoir>);

/// Parameters of the passes.
fn params<C: Choice<W>, const W: usize>(
    options: &RestirOptions,
    frame: &RestirFrame<'_, C, W>,
) -> RestirParams {
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

/// Whether the history of `before`, seen in an image of `size`, can be used for `frame`.
fn continues<C: Choice<W>, const W: usize>(
    before: &SceneArrays,
    size: (u32, u32),
    frame: &RestirFrame<'_, C, W>,
) -> bool {
    let (then, now) = (
        before.lights.triangles().len(),
        frame.scene.lights.triangles().len(),
    );
    let lights_known = match frame.remap {
        Some(remap) => remap.to_current.len() == then && remap.to_previous.len() == now,
        None => then == now,
    };
    size == (frame.width, frame.height) && before.materials == frame.scene.materials && lights_known
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_remap_is_one_to_one_whatever_it_is_made_from() {
        let remap = LightRemap::new(&[2, NONE, 0, 2, 7], 4);
        assert_eq!(remap.to_current(), [2, NONE, 0, NONE, NONE]);
        assert_eq!(remap.to_previous(), [2, NONE, 0, NONE]);
    }

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
