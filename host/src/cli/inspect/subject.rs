//! Light BVHs of any model over the lights of a scene.

use std::time::{Duration, Instant};

use lightbvh::bvh::{NoTrails, StaticBvh, StaticMeshBvh, Trails};
use lightbvh::exact::hash;
use lightbvh::requirements::{Layout, Model, Structure, Updates};
use lightbvh::{
    BuildParams, Bvh, Defensive, Edit, EditError, FullMomentNode, ImportanceModel, LeanMomentNode, LightNode,
    Lights, MomentLayout, MomentNode, Moments, SampledLight, ShadingPoint, TwoSidedMomentNode,
};

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

    /// Samples each point `passes` times, by hashes of numbers from `first` on.
    fn time(&self, points: &[ShadingPoint], first: u32, passes: u32) -> Duration;
}

/// The time that `sample` takes.
fn time(
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

subject!([N: LightNode<W>, I: ImportanceModel<N, W> + Sync, const W: usize]
    Bvh<N, I, W>, memory, |bvh: &Self, p, l, i| Some(bvh.pmf(p, l, i)));
subject!([N: LightNode<W>, I: ImportanceModel<N, W> + Sync, const W: usize]
    StaticBvh<N, I, W>, bytes, |bvh: &Self, p, l, i| Some(bvh.pmf(p, l, i)));
subject!([N: LightNode<W>, I: ImportanceModel<N, W> + Sync, const W: usize]
    StaticMeshBvh<N, I, W>, memory, |bvh: &Self, p, l, i| Some(bvh.pmf(p, l, i)));
subject!([N: MomentLayout<W> + LightNode<W>, const W: usize]
    StaticMeshBvh<N, Moments, W, NoTrails>, memory, |_, _, _, _| None);
subject!([N: MomentLayout<W> + LightNode<W>, const W: usize]
    Bvh<N, Moments, W, NoTrails>, memory, |_, _, _, _| None);
subject!([N: MomentLayout<W> + LightNode<W>, const W: usize]
    StaticBvh<N, Moments, W, NoTrails>, bytes, |_, _, _, _| None);

/// The light BVH of `model`, whose width and layout [`is_known`] knows.
pub(super) fn build(model: &Model, source: &Source<'_>) -> Result<Box<dyn Subject>, HostError> {
    match (model.layout, model.width) {
        (Layout::TwoSidedMoments, 4) => chosen::<TwoSidedMomentNode<4>, 4>(model, source),
        (Layout::TwoSidedMoments, 16) => chosen::<TwoSidedMomentNode<16>, 16>(model, source),
        (Layout::TwoSidedMoments, _) => chosen::<TwoSidedMomentNode<8>, 8>(model, source),
        (Layout::LeanMoments, _) => chosen::<LeanMomentNode<8>, 8>(model, source),
        (Layout::FullMoments, _) => chosen::<FullMomentNode<8>, 8>(model, source),
        (_, 4) => chosen::<MomentNode<4>, 4>(model, source),
        (_, 16) => chosen::<MomentNode<16>, 16>(model, source),
        (_, _) => chosen::<MomentNode<8>, 8>(model, source),
    }
}

/// Whether [`build`] has the model's layout in its width.
pub(super) fn is_known(model: &Model) -> bool {
    let any_width = matches!(model.layout, Layout::Moments | Layout::TwoSidedMoments);
    model.width == 8 || (any_width && [4, 16].contains(&model.width))
}

fn chosen<N, const W: usize>(model: &Model, source: &Source<'_>) -> Result<Box<dyn Subject>, HostError>
where
    N: MomentLayout<W> + LightNode<W> + 'static,
{
    match (model.uniform_halvings, model.trails) {
        (0, false) => {
            let (bvh, edits) = built::<N, Moments, W>(model, source)?;
            kept(bvh.without_trails(), edits, model.updates)
        }
        (0, true) => {
            let (bvh, edits) = built::<N, Moments, W>(model, source)?;
            kept(bvh, edits, model.updates)
        }
        _ => {
            let (bvh, edits) = built::<N, Defensive<Moments, 6>, W>(model, source)?;
            kept(bvh, edits, model.updates)
        }
    }
    .map_err(|error| HostError::in_frame(source.scene.name(), source.moved, error))
}

/// With what `updates` need, then moved and refitted.
fn kept<N: LightNode<W> + 'static, I: 'static, const W: usize, T: Trails + 'static>(
    mut bvh: Bvh<N, I, W, T>,
    edits: Vec<Edit>,
    updates: Updates,
) -> Result<Box<dyn Subject>, EditError>
where
    Bvh<N, I, W, T>: Subject,
    StaticMeshBvh<N, I, W, T>: Subject,
    StaticBvh<N, I, W, T>: Subject,
{
    if updates == Updates::Instances {
        let mut bvh = bvh.into_static_meshes();
        bvh.apply(edits)?;
        bvh.refit();
        return Ok(Box::new(bvh));
    }
    bvh.apply(edits)?;
    bvh.refit();
    Ok(match updates {
        Updates::Nothing => Box::new(bvh.into_static()),
        _ => Box::new(bvh),
    })
}

/// A light BVH, and the edits that move it; none where lights stay.
fn built<N: LightNode<W>, I, const W: usize>(
    model: &Model,
    source: &Source<'_>,
) -> Result<(Bvh<N, I, W>, Vec<Edit>), HostError> {
    let params = BuildParams::default();
    if model.structure == Structure::SingleLevel {
        return Ok((Bvh::single_level(source.lights, &params), Vec::new()));
    }
    let (bvh, mut instances) = Instances::new(source.scene, source.frame, params)
        .map_err(|error| HostError::in_frame(source.scene.name(), source.frame, error))?;
    Ok((bvh, instances.edits(source.scene, source.moved)))
}
