//! The configurations that are measured: by importance, layout, width, builder, levels, update, candidates, integrator and
//! arithmetic, one axis at a time from the default.

use std::marker::PhantomData;
use std::time::{Duration, Instant};

use lightbvh::EmissiveTriangle;
use lightbvh::exact::hash;
use lightbvh::importance::{DefaultImportance, NativeMath};
use lightbvh::node::{FullMomentNode, LeanMomentNode};
use lightbvh::{
    CompactNode, Cycles, Defensive, Eq4, Falcor, Flux, FluxOverDistance, ImportanceModel, LightNode, Lights,
    MomentNode, Moments, Pbrt, Random64, ShadingPoint, SphericalGaussian,
};
use lightbvh_kernels::bvh::Choice;
use lightbvh_kernels::render::RenderParams;
use serde::Serialize;

use super::reservoirs::Reservoirs;
use super::update::{Followed, Frame, Spent, Update};
use crate::backend::{Backend, Bvh, CpuBackend, Integrator, Sampler, SceneArrays, Timed};
use crate::error::HostError;
use crate::method::Builder;
use crate::workload::instance_of;

/// What a user can choose.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Config {
    /// What differs from the default.
    pub axis: Axis,
    /// What becomes of samples: `direct`, each counts by itself; `restir`, pixels and frames share them.
    pub integrator: &'static str,
    pub levels: Sampler,
    pub importance: &'static str,
    pub layout: &'static str,
    pub width: usize,
    pub builder: Builder,
    pub update: Update,
    /// Candidates of each sample.
    pub candidates: u32,
}

/// What a configuration is there to show.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Axis {
    /// What `LightBvh::two_level` and `render` do unless told otherwise.
    Default,
    /// What lights are chosen by.
    Importance,
    /// How nodes hold it.
    Layout,
    /// Children of a node.
    Width,
    /// How the tree is built.
    Builder,
    /// One level or two.
    Levels,
    /// How the tree follows moving lights.
    Update,
    /// Candidates of a sample.
    Candidates,
    /// Whether pixels and frames share samples.
    Integrator,
    /// Operations that every processor computes alike, or its own.
    Arithmetic,
}

/// A layout and an importance, as a choice of the CPU's renderer.
#[derive(Debug)]
pub(super) struct Pair<N, I>(PhantomData<(N, I)>);

impl<N, I> Clone for Pair<N, I> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<N, I> Copy for Pair<N, I> {}

impl<N, I, const W: usize> Choice<W> for Pair<N, I>
where
    N: LightNode<W> + std::fmt::Debug + 'static,
    I: ImportanceModel<N, W> + Clone + std::fmt::Debug + Send + Sync + 'static,
{
    type Light = EmissiveTriangle;
    type Node = N;
    type Importance = I;
    const NAME: &'static str = N::NAME;
    // No kernels are compiled for it.
    const SUFFIX: &'static str = "";
}

/// A configuration over the lights of a scene.
pub(super) trait Subject {
    fn config(&self) -> Config;

    fn bytes(&self) -> usize;

    /// Builds the tree of a frame, beside the one there is.
    fn build(&self, frame: &Frame<'_>) -> Result<Duration, HostError>;

    /// Brings the tree to the next frame.
    fn advance(&mut self, frame: &Frame<'_>) -> Result<Spent, HostError>;

    /// Samples each point once. Numbers begin with hash(`first`).
    fn sample(&self, points: &[ShadingPoint], first: u32) -> Duration;

    /// Numbers and pmfs of the candidates for a point.
    fn candidates(&self, point: &ShadingPoint, number: Random64, found: &mut Vec<(u32, f32)>);

    /// The probability of a light.
    fn pmf(&self, lights: &Lights, point: &ShadingPoint, light: u32) -> f32;

    /// Shadow rays of a pixel in the least image; images have multiples of it.
    fn least_rays(&self) -> u32 {
        1
    }

    fn render(
        &mut self,
        arrays: &SceneArrays,
        params: RenderParams,
    ) -> Result<Timed<Vec<[f32; 3]>>, HostError>;
}

/// A light BVH of one type.
pub(super) struct Built<N: LightNode<W>, I, const W: usize>
where
    Pair<N, I>: Choice<W, Node = N, Importance = I>,
{
    config: Config,
    backend: CpuBackend<Pair<N, I>, W>,
    followed: Followed,
}

/// All configurations over the lights of the `first` frame of the animation, the default first.
pub(super) fn all(first: &Frame<'_>) -> Result<Vec<Box<dyn Subject>>, HostError> {
    use Axis as A;
    type D = DefaultImportance;
    let with = |axis| With {
        first,
        axis,
        levels: Sampler::TwoLevel,
        builder: Builder::Ward,
        update: Update::usual(Sampler::TwoLevel),
        candidates: 1,
    };
    let levels = |axis, levels| With {
        levels,
        update: Update::usual(levels),
        ..with(axis)
    };
    let update = |levels_of, update| With {
        update,
        ..levels(A::Update, levels_of)
    };
    let builder = |axis, builder| With {
        builder,
        ..with(axis)
    };
    let candidates = |candidates| With {
        candidates,
        ..with(A::Candidates)
    };
    let reservoirs = |source| {
        let tree = with(A::Integrator).built::<MomentNode<8>, D, 8>("moments+1/64")?;
        let reservoirs = Reservoirs::new(source, tree, first)?;
        Ok(Box::new(reservoirs) as Box<dyn Subject>)
    };
    let (one, saoh) = (Sampler::SingleLevel, Builder::Saoh);
    [
        with(A::Default).of::<MomentNode<8>, D, 8>("moments+1/64"),
        with(A::Importance).of::<MomentNode<8>, Moments, 8>("moments"),
        builder(A::Importance, saoh).of::<CompactNode<4>, Eq4, 4>("eq4"),
        builder(A::Importance, saoh).of::<CompactNode<4>, FluxOverDistance, 4>("flux/d²"),
        with(A::Importance).of::<MomentNode<8>, FluxOverDistance, 8>("flux/d²"),
        with(A::Importance).of::<MomentNode<8>, Flux, 8>("flux"),
        builder(A::Importance, saoh).of::<CompactNode<4>, Pbrt, 4>("pbrt"),
        builder(A::Importance, saoh).of::<CompactNode<4>, Falcor, 4>("falcor"),
        builder(A::Importance, saoh).of::<CompactNode<4>, Cycles, 4>("cycles"),
        with(A::Importance).of::<MomentNode<8>, SphericalGaussian, 8>("gaussian"),
        with(A::Layout).of::<LeanMomentNode<8>, Moments, 8>("moments"),
        with(A::Layout).of::<FullMomentNode<8>, Moments, 8>("moments"),
        with(A::Width).of::<MomentNode<4>, D, 4>("moments+1/64"),
        with(A::Width).of::<MomentNode<16>, D, 16>("moments+1/64"),
        builder(A::Builder, Builder::Morton).of::<MomentNode<8>, D, 8>("moments+1/64"),
        builder(A::Builder, saoh).of::<MomentNode<8>, D, 8>("moments+1/64"),
        levels(A::Levels, one).of::<MomentNode<8>, D, 8>("moments+1/64"),
        With {
            builder: saoh,
            ..levels(A::Levels, one)
        }
        .of::<CompactNode<4>, Eq4, 4>("eq4"),
        update(Sampler::TwoLevel, Update::Refit).of::<MomentNode<8>, D, 8>("moments+1/64"),
        update(Sampler::TwoLevel, Update::Rebuild).of::<MomentNode<8>, D, 8>("moments+1/64"),
        update(Sampler::TwoLevel, Update::EveryEighth).of::<MomentNode<8>, D, 8>("moments+1/64"),
        update(one, Update::Rebuild).of::<MomentNode<8>, D, 8>("moments+1/64"),
        update(one, Update::EveryEighth).of::<MomentNode<8>, D, 8>("moments+1/64"),
        candidates(2).of::<MomentNode<8>, D, 8>("moments+1/64"),
        candidates(4).of::<MomentNode<8>, D, 8>("moments+1/64"),
        candidates(8).of::<MomentNode<8>, D, 8>("moments+1/64"),
        candidates(16).of::<MomentNode<8>, D, 8>("moments+1/64"),
        reservoirs(Sampler::Power),
        reservoirs(Sampler::TwoLevel),
        with(A::Arithmetic).of::<MomentNode<8>, Defensive<Moments<NativeMath>, 6>, 8>("moments+1/64, native"),
    ]
    .into_iter()
    .collect()
}

/// What does not take a type.
struct With<'a> {
    first: &'a Frame<'a>,
    axis: Axis,
    levels: Sampler,
    builder: Builder,
    update: Update,
    candidates: u32,
}

impl With<'_> {
    fn of<N, I, const W: usize>(self, importance: &'static str) -> Result<Box<dyn Subject>, HostError>
    where
        N: LightNode<W> + std::fmt::Debug + 'static,
        I: ImportanceModel<N, W> + Clone + std::fmt::Debug + Send + Sync + 'static,
    {
        Ok(Box::new(self.built::<N, I, W>(importance)?))
    }

    fn built<N, I, const W: usize>(self, importance: &'static str) -> Result<Built<N, I, W>, HostError>
    where
        N: LightNode<W> + std::fmt::Debug + 'static,
        I: ImportanceModel<N, W> + Clone + std::fmt::Debug + Send + Sync + 'static,
    {
        let params = self.builder.params();
        let (bvh, followed): (Bvh<Pair<N, I>, W>, _) =
            Followed::build(self.first, self.levels, self.update, params)?;
        Ok(Built {
            config: Config {
                axis: self.axis,
                integrator: "direct",
                levels: self.levels,
                importance,
                layout: N::NAME,
                width: W,
                builder: self.builder,
                update: self.update,
                candidates: self.candidates,
            },
            backend: CpuBackend::new(bvh),
            followed,
        })
    }
}

impl<N, I, const W: usize> Built<N, I, W>
where
    N: LightNode<W> + std::fmt::Debug + 'static,
    I: ImportanceModel<N, W> + Clone + std::fmt::Debug + Send + Sync + 'static,
{
    /// As of the frame last advanced to.
    pub fn bvh(&self) -> &Bvh<Pair<N, I>, W> {
        self.backend.bvh()
    }

    fn times<const COUNT: usize>(&self, points: &[ShadingPoint], first: u32) -> Duration {
        let tree = self.backend.bvh().tree();
        let start = Instant::now();
        let mut sum = 0.0;
        for (point, number) in points.iter().zip(first..) {
            let number = hash(number);
            sum += match COUNT {
                1 => tree.sample(point, number).pmf,
                _ => tree.sample_many::<COUNT>(point, number)[COUNT - 1].pmf,
            };
        }
        std::hint::black_box(sum);
        start.elapsed()
    }

    fn many<const COUNT: usize>(&self, point: &ShadingPoint, number: Random64, found: &mut Vec<(u32, f32)>) {
        let many = self.backend.bvh().sample_many::<COUNT>(point, number);
        found.extend(many.map(|sampled| (sampled.light, sampled.pmf)));
    }
}

impl<N, I, const W: usize> Subject for Built<N, I, W>
where
    N: LightNode<W> + std::fmt::Debug + 'static,
    I: ImportanceModel<N, W> + Clone + std::fmt::Debug + Send + Sync + 'static,
{
    fn config(&self) -> Config {
        self.config
    }

    fn bytes(&self) -> usize {
        self.backend.bvh().bytes()
    }

    fn build(&self, frame: &Frame<'_>) -> Result<Duration, HostError> {
        let Config {
            levels,
            update,
            builder,
            ..
        } = self.config;
        let start = Instant::now();
        std::hint::black_box(Followed::build::<N, I, W>(
            frame,
            levels,
            update,
            builder.params(),
        )?);
        Ok(start.elapsed())
    }

    fn advance(&mut self, frame: &Frame<'_>) -> Result<Spent, HostError> {
        self.followed.advance(self.backend.bvh_mut(), frame)
    }

    fn sample(&self, points: &[ShadingPoint], first: u32) -> Duration {
        match self.config.candidates {
            1 => self.times::<1>(points, first),
            2 => self.times::<2>(points, first),
            4 => self.times::<4>(points, first),
            8 => self.times::<8>(points, first),
            _ => self.times::<16>(points, first),
        }
    }

    fn candidates(&self, point: &ShadingPoint, number: Random64, found: &mut Vec<(u32, f32)>) {
        found.clear();
        match self.config.candidates {
            1 => self.many::<1>(point, number, found),
            2 => self.many::<2>(point, number, found),
            4 => self.many::<4>(point, number, found),
            8 => self.many::<8>(point, number, found),
            _ => self.many::<16>(point, number, found),
        }
    }

    fn pmf(&self, lights: &Lights, point: &ShadingPoint, light: u32) -> f32 {
        let bvh = self.backend.bvh();
        bvh.pmf(point, light, instance_of(bvh, lights, light))
    }

    fn render(
        &mut self,
        arrays: &SceneArrays,
        params: RenderParams,
    ) -> Result<Timed<Vec<[f32; 3]>>, HostError> {
        let params = RenderParams {
            candidates: self.config.candidates,
            ..params
        };
        Ok(self
            .backend
            .render(arrays, &params, self.config.levels, Integrator::Direct)?)
    }
}
