//! Configurations that are a light BVH by some importance. Trees are of two types, the default's and the paper's: other importances
//! choose from the same nodes.

use std::marker::PhantomData;
use std::time::{Duration, Instant};

use lightbvh::exact::hash;
use lightbvh::node::Node as _;
use lightbvh::{ImportanceModel, Lights, Random64, ShadingPoint};
use lightbvh_kernels::bvh::{Choice, Paper, Standard, TreeOf, TriangleChoice, WIDTH};
use lightbvh_kernels::render::RenderParams;
use lightbvh_kernels::shading::emitters::Emitters;

use super::subject::{Axis, Config, Subject};
use super::update::{Followed, Frame, Spent, Update};
use crate::backend::{Bvh, Sampler, SceneArrays, Timed};
use crate::error::HostError;
use crate::method::Builder;
use crate::render::render;
use crate::workload::instance_of;

/// How lights are chosen from trees of one type: calls are per batch of samples, so that the trees' type is compiled once for
/// all importances.
trait Chooser<C: TriangleChoice<W>, const W: usize> {
    /// Time of `candidates` for each point; numbers begin with hash(`first`).
    fn sample(
        &self,
        tree: &TreeOf<'_, C, W>,
        points: &[ShadingPoint],
        first: u32,
        candidates: u32,
    ) -> Duration;

    fn candidates(
        &self,
        tree: &TreeOf<'_, C, W>,
        at: (&ShadingPoint, Random64),
        candidates: u32,
        found: &mut Vec<(u32, f32)>,
    );

    fn pmf(&self, tree: &TreeOf<'_, C, W>, point: &ShadingPoint, light: u32, instance: u32) -> f32;

    fn render(&self, bvh: &Bvh<C, W>, arrays: &SceneArrays, params: &RenderParams) -> Timed<Vec<[f32; 3]>>;
}

/// By importance `I`.
struct By<I>(PhantomData<I>);

impl<C, I, const W: usize> Chooser<C, W> for By<I>
where
    C: TriangleChoice<W>,
    I: ImportanceModel<C::Node, W> + Sync,
{
    fn sample(
        &self,
        tree: &TreeOf<'_, C, W>,
        points: &[ShadingPoint],
        first: u32,
        candidates: u32,
    ) -> Duration {
        let tree = tree.by::<I>();
        let start = Instant::now();
        let mut sum = 0.0;
        for (point, number) in points.iter().zip(first..) {
            let number = hash(number);
            sum += match candidates {
                1 => tree.sample(point, number).pmf,
                2 => tree.sample_many::<_, 2>(point, number)[1].pmf,
                4 => tree.sample_many::<_, 4>(point, number)[3].pmf,
                8 => tree.sample_many::<_, 8>(point, number)[7].pmf,
                _ => tree.sample_many::<_, 16>(point, number)[15].pmf,
            };
        }
        std::hint::black_box(sum);
        start.elapsed()
    }

    fn candidates(
        &self,
        tree: &TreeOf<'_, C, W>,
        (point, number): (&ShadingPoint, Random64),
        candidates: u32,
        found: &mut Vec<(u32, f32)>,
    ) {
        let tree = tree.by::<I>();
        let mut take = |sampled: &[lightbvh::SampledLight]| {
            found.extend(sampled.iter().map(|sampled| (sampled.light, sampled.pmf)));
        };
        match candidates {
            1 => take(&[tree.sample(point, number)]),
            2 => take(&tree.sample_many::<_, 2>(point, number)),
            4 => take(&tree.sample_many::<_, 4>(point, number)),
            8 => take(&tree.sample_many::<_, 8>(point, number)),
            _ => take(&tree.sample_many::<_, 16>(point, number)),
        }
    }

    fn pmf(&self, tree: &TreeOf<'_, C, W>, point: &ShadingPoint, light: u32, instance: u32) -> f32 {
        tree.by::<I>().pmf(point, light, instance)
    }

    fn render(&self, bvh: &Bvh<C, W>, arrays: &SceneArrays, params: &RenderParams) -> Timed<Vec<[f32; 3]>> {
        let tree = bvh.tree();
        let view = arrays.lit_by(Emitters {
            triangles: bvh.triangles(),
            instances: tree.instances,
        });
        Timed::of(|| render(&view, &arrays.camera, params, &tree.by::<I>()))
    }
}

/// A light BVH, and how its lights are chosen.
pub(super) struct Built<C: TriangleChoice<W> = Standard, const W: usize = WIDTH> {
    config: Config,
    bvh: Bvh<C, W>,
    followed: Followed,
    chooser: Box<dyn Chooser<C, W>>,
}

/// What does not take a type.
pub(super) struct With<'a> {
    pub first: &'a Frame<'a>,
    pub axis: Axis,
    pub levels: Sampler,
    pub builder: Builder,
    pub update: Update,
    pub candidates: u32,
}

impl With<'_> {
    /// Over the default's nodes.
    pub fn of<I>(self, importance: &'static str) -> Result<Box<dyn Subject>, HostError>
    where
        I: ImportanceModel<<Standard as Choice<WIDTH>>::Node, WIDTH> + Sync + 'static,
    {
        Ok(Box::new(self.built::<Standard, I, WIDTH>(importance)?))
    }

    /// Over the paper's nodes.
    pub fn of_paper<I>(self, importance: &'static str) -> Result<Box<dyn Subject>, HostError>
    where
        I: ImportanceModel<<Paper as Choice<4>>::Node, 4> + Sync + 'static,
    {
        Ok(Box::new(self.built::<Paper, I, 4>(importance)?))
    }

    fn built<C, I, const W: usize>(self, importance: &'static str) -> Result<Built<C, W>, HostError>
    where
        C: TriangleChoice<W>,
        I: ImportanceModel<C::Node, W> + Sync + 'static,
    {
        let params = self.builder.params();
        let (bvh, followed): (Bvh<C, W>, _) = Followed::build(self.first, self.levels, self.update, params)?;
        Ok(Built {
            config: Config {
                axis: self.axis,
                integrator: "direct",
                levels: self.levels,
                importance,
                layout: C::Node::NAME,
                width: W,
                builder: self.builder,
                update: self.update,
                candidates: self.candidates,
            },
            bvh,
            followed,
            chooser: Box::new(By::<I>(PhantomData)),
        })
    }
}

impl<C: TriangleChoice<W>, const W: usize> Subject for Built<C, W> {
    fn config(&self) -> Config {
        self.config
    }

    fn bytes(&self) -> usize {
        self.bvh.bytes()
    }

    fn build(&self, frame: &Frame<'_>) -> Result<Duration, HostError> {
        let Config {
            levels,
            update,
            builder,
            ..
        } = self.config;
        let start = Instant::now();
        let built: (Bvh<C, W>, _) = Followed::build(frame, levels, update, builder.params())?;
        std::hint::black_box(&built);
        Ok(start.elapsed())
    }

    fn advance(&mut self, frame: &Frame<'_>) -> Result<Spent, HostError> {
        self.followed.advance(&mut self.bvh, frame)
    }

    fn sample(&self, points: &[ShadingPoint], first: u32) -> Duration {
        self.chooser
            .sample(&self.bvh.tree(), points, first, self.config.candidates)
    }

    fn candidates(&self, point: &ShadingPoint, number: Random64, found: &mut Vec<(u32, f32)>) {
        found.clear();
        self.chooser
            .candidates(&self.bvh.tree(), (point, number), self.config.candidates, found);
    }

    fn pmf(&self, lights: &Lights, point: &ShadingPoint, light: u32) -> f32 {
        let instance = instance_of(&self.bvh, lights, light);
        self.chooser.pmf(&self.bvh.tree(), point, light, instance)
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
        Ok(self.chooser.render(&self.bvh, arrays, &params))
    }
}
