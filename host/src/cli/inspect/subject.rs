//! Light BVHs of any model over the lights of a scene.

use std::time::{Duration, Instant};

use lightbvh::bvh::{NoTrails, StaticBvh, StaticMeshBvh, Trails};
use lightbvh::exact::hash;
use lightbvh::importance::DefaultImportance;
use lightbvh::requirements::{Layout, Model, Updates};
use lightbvh::{
    BuildParams, Bvh, ImportanceModel, LightNode, Lights, MomentLayout, MomentNode, Moments, SampledLight,
    ShadingPoint, TwoSidedMomentNode,
};
use lightbvh_kernels::bvh::WIDTH;

use crate::error::HostError;
use crate::scene::{Instances, Scene};

/// What trees are built over.
pub(super) struct Source<'a> {
    pub scene: &'a Scene,
    pub frame: u32,
    /// The frame that they are then moved to, the same where lights stay.
    pub moved: u32,
    /// The lights of that frame in the world.
    pub lights: &'a Lights,
}

/// A light BVH of some model.
pub(super) trait Subject: Sync {
    /// Bytes that sampling reads.
    fn read_bytes(&self) -> usize;

    /// Bytes of all its arrays.
    fn all_bytes(&self) -> usize;

    /// The probability of a light; `None` where it cannot be asked for.
    fn probability(&self, point: &ShadingPoint, light: u32, instance: u32) -> Option<f32>;

    fn choose(&self, point: &ShadingPoint, number: u32) -> SampledLight;

    /// See [`time`].
    fn time(&self, points: &[ShadingPoint], first: u32, passes: u32) -> Duration;
}

/// The time that `sample` takes at each point `passes` times, by hashes of numbers from `first` on.
pub(super) fn time(
    points: &[ShadingPoint],
    first: u32,
    passes: u32,
    sample: impl Fn(&ShadingPoint, u32) -> SampledLight,
) -> Duration {
    let start = Instant::now();
    let mut sum = 0.0;
    for pass in 0..passes {
        let numbers = first.wrapping_add(pass.wrapping_mul(points.len() as u32));
        for (point, k) in points.iter().zip(0_u32..) {
            sum += sample(point, hash(numbers.wrapping_add(k))).pmf;
        }
    }
    std::hint::black_box(sum);
    start.elapsed()
}

/// A light BVH as a subject, by its own functions of these names.
macro_rules! subject {
    ([$($generics:tt)*] $bvh:ty, $memory:ident, $pmf:expr) => {
        impl<$($generics)*> Subject for $bvh {
            fn read_bytes(&self) -> usize {
                self.bytes()
            }

            fn all_bytes(&self) -> usize {
                self.$memory()
            }

            fn probability(&self, point: &ShadingPoint, light: u32, instance: u32) -> Option<f32> {
                $pmf(self, point, light, instance)
            }

            fn choose(&self, point: &ShadingPoint, number: u32) -> SampledLight {
                self.sample(point, number)
            }

            fn time(&self, points: &[ShadingPoint], first: u32, passes: u32) -> Duration {
                time(points, first, passes, |point, number| self.sample(point, number))
            }
        }
    };
}

subject!([N: LightNode<WIDTH>, I: ImportanceModel<N, WIDTH> + Sync]
    Bvh<N, I, WIDTH>, memory, |bvh: &Self, p, l, i| Some(bvh.pmf(p, l, i)));
subject!([N: LightNode<WIDTH>, I: ImportanceModel<N, WIDTH> + Sync]
    StaticBvh<N, I, WIDTH>, bytes, |bvh: &Self, p, l, i| Some(bvh.pmf(p, l, i)));
subject!([N: LightNode<WIDTH>, I: ImportanceModel<N, WIDTH> + Sync]
    StaticMeshBvh<N, I, WIDTH>, memory, |bvh: &Self, p, l, i| Some(bvh.pmf(p, l, i)));
subject!([N: MomentLayout<WIDTH> + LightNode<WIDTH>]
    StaticMeshBvh<N, Moments, WIDTH, NoTrails>, memory, |_, _, _, _| None);
subject!([N: MomentLayout<WIDTH> + LightNode<WIDTH>]
    Bvh<N, Moments, WIDTH, NoTrails>, memory, |_, _, _, _| None);
subject!([N: MomentLayout<WIDTH> + LightNode<WIDTH>]
    StaticBvh<N, Moments, WIDTH, NoTrails>, bytes, |_, _, _, _| None);

/// The light BVH of `model`.
pub(super) fn build(model: &Model, source: &Source<'_>) -> Result<Box<dyn Subject>, HostError> {
    match model.layout {
        Layout::TwoSidedMoments => chosen::<TwoSidedMomentNode<WIDTH>>(model, source),
        _ => chosen::<MomentNode<WIDTH>>(model, source),
    }
}

fn chosen<N>(model: &Model, source: &Source<'_>) -> Result<Box<dyn Subject>, HostError>
where
    N: MomentLayout<WIDTH> + LightNode<WIDTH> + 'static,
{
    Ok(match (model.uniform_halvings, model.trails) {
        (0, false) => kept(
            built::<N, Moments>(model, source)?.without_trails(),
            model.updates,
        ),
        (0, true) => kept(built::<N, Moments>(model, source)?, model.updates),
        _ => kept(built::<N, DefaultImportance>(model, source)?, model.updates),
    })
}

/// With what `updates` need.
fn kept<N: LightNode<WIDTH> + 'static, I: 'static, T: Trails + 'static>(
    bvh: Bvh<N, I, WIDTH, T>,
    updates: Updates,
) -> Box<dyn Subject>
where
    Bvh<N, I, WIDTH, T>: Subject,
    StaticMeshBvh<N, I, WIDTH, T>: Subject,
    StaticBvh<N, I, WIDTH, T>: Subject,
{
    match updates {
        Updates::Nothing => Box::new(bvh.into_static()),
        Updates::Instances => Box::new(bvh.into_static_meshes()),
        _ => Box::new(bvh),
    }
}

/// A light BVH, moved and refitted if its lights move.
fn built<N: LightNode<WIDTH>, I>(model: &Model, source: &Source<'_>) -> Result<Bvh<N, I, WIDTH>, HostError> {
    let params = BuildParams::default();
    if model.single_level {
        return Ok(Bvh::single_level(source.lights, &params));
    }
    let refused = |error| HostError::in_frame(source.scene.name(), source.moved, error);
    let (mut bvh, mut instances) = Instances::new(source.scene, source.frame, params)
        .map_err(|error| HostError::in_frame(source.scene.name(), source.frame, error))?;
    bvh.apply(instances.edits(source.scene, source.moved))
        .map_err(refused)?;
    bvh.refit();
    Ok(bvh)
}
