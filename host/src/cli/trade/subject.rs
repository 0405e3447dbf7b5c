//! A configuration: a light BVH that follows the animation, and an importance by which lights are chosen. Trees are of two
//! types, the default's and the paper's: other importances choose from the same nodes.

use lightbvh::device::bvh::follow;
use lightbvh::tree::Model;
use std::fmt;
use std::hint::black_box;
use std::marker::PhantomData;
use std::time::{Duration, Instant};

use lightbvh::exact::hash;
use lightbvh::node::Node as _;
use lightbvh::{ImportanceModel, Lights, SampledLight, ShadingPoint};
use lightbvh_kernels::bvh::{Paper, TreeOf, TriangleModel, Triangles, WIDTH};
use lightbvh_kernels::render::RenderParams;
use lightbvh_kernels::shading::emitters::Emitters;
use serde::Serialize;

use crate::backend::{BackendError, Bvh, Sampler, SceneArrays, Timed};
use crate::cli::measure::interval::Interval;
use crate::cli::measure::times::ms;
use crate::error::HostError;
use crate::method::{Builder, Step};
use crate::render::render;
use crate::scene::Instances;
use crate::workload::{build, instance_of};

/// A user's choices.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Config {
    /// The difference from the default.
    pub axis: Axis,
    pub levels: Sampler,
    pub importance: &'static str,
    /// How nodes hold it, and their children.
    pub layout: &'static str,
    pub width: usize,
    pub builder: Builder,
    pub update: Update,
    /// Candidates of each sample.
    pub candidates: u32,
}

/// The choice that a configuration shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Axis {
    /// The default of `LightBvh::two_level` and `render`.
    Default,
    /// The importance by which lights are chosen.
    Importance,
    /// How the tree is built.
    Builder,
    /// One level or two.
    Levels,
    /// How the tree follows moving lights.
    Update,
    /// Candidates of a sample.
    Candidates,
}

/// The update of a tree between two frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, strum::IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub(super) enum Update {
    /// New bounds in the tree of the first frame.
    Refit,
    /// The same in trees of the frame before, whose top level a [`Rebuilder`](lightbvh::Rebuilder) builds in the background.
    TopRebuild,
    /// A new tree.
    Rebuild,
    /// A new tree in every eighth frame, new bounds in the others.
    EveryEighth,
}

impl Update {
    /// The usual one of a user of `levels`.
    pub fn usual(levels: Sampler) -> Self {
        match levels {
            Sampler::TwoLevel => Self::TopRebuild,
            _ => Self::Refit,
        }
    }
}

impl Config {
    /// The default with something else on an axis.
    pub fn new(axis: Axis) -> Self {
        Self {
            axis,
            levels: Sampler::TwoLevel,
            importance: "moments+1/64",
            layout: <Triangles as Model<WIDTH>>::Node::NAME,
            width: WIDTH,
            builder: Builder::Ward,
            update: Update::TopRebuild,
            candidates: 1,
        }
    }

    /// Over the default's nodes, by an importance of this name.
    pub fn of<I>(self, importance: &'static str, first: &Step<'_>) -> Result<Box<dyn Subject>, HostError>
    where
        I: ImportanceModel<<Triangles as Model<WIDTH>>::Node, WIDTH> + Sync + 'static,
    {
        self.built::<Triangles, I, WIDTH>(importance, first)
    }

    /// Over the paper's nodes, built by SAOH.
    pub fn of_paper<I>(
        self,
        importance: &'static str,
        first: &Step<'_>,
    ) -> Result<Box<dyn Subject>, HostError>
    where
        I: ImportanceModel<<Paper as Model<4>>::Node, 4> + Sync + 'static,
    {
        let builder = Builder::Saoh;
        Self { builder, ..self }.built::<Paper, I, 4>(importance, first)
    }

    fn built<C, I, const W: usize>(
        self,
        importance: &'static str,
        first: &Step<'_>,
    ) -> Result<Box<dyn Subject>, HostError>
    where
        C: TriangleModel<W> + 'static,
        I: ImportanceModel<C::Node, W> + Sync + 'static,
    {
        let (layout, width) = (C::Node::NAME, W);
        let config = Self {
            importance,
            layout,
            width,
            ..self
        };
        let (bvh, instances) = tree::<C, W>(&config, first)?;
        Ok(Box::new(Followed::<C, I, W> {
            config,
            bvh,
            instances,
            updates: Updates::default(),
            importance: PhantomData,
        }))
    }
}

impl fmt::Display for Config {
    /// The difference from the default.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (builder, levels) = (self.builder.name(), self.levels.name());
        let update: &str = self.update.into();
        let importance = self.importance;
        match self.axis {
            Axis::Default => write!(f, "default"),
            Axis::Importance => write!(f, "{importance}, {} x {}, {builder}", self.layout, self.width),
            Axis::Builder => write!(f, "built by {builder}"),
            Axis::Levels => write!(f, "{levels}, {importance}"),
            Axis::Update => write!(f, "{levels}, {update}"),
            Axis::Candidates => write!(f, "1 of {} candidates", self.candidates),
        }
    }
}

/// A configuration over the lights of a scene.
pub(super) trait Subject: Sync {
    fn config(&self) -> Config;

    fn bytes(&self) -> usize;

    /// Times of the updates so far.
    fn updates(&self) -> &Updates;

    /// Builds the tree of a frame next to the one that there is.
    fn build(&self, frame: &Step<'_>) -> Result<Duration, HostError>;

    /// Brings the tree to the next frame.
    fn advance(&mut self, frame: &Step<'_>) -> Result<(), HostError>;

    /// Samples each point once. Numbers begin with hash(`first`).
    fn sample(&self, points: &[ShadingPoint], first: u32) -> Duration;

    /// The probability of a light.
    fn pmf(&self, lights: &Lights, point: &ShadingPoint, light: u32) -> f32;

    fn render(&self, arrays: &SceneArrays, params: RenderParams) -> Timed<Vec<[f32; 3]>>;
}

/// A tree that follows the animation, and an importance `I` by which lights are chosen.
struct Followed<C: TriangleModel<W>, I, const W: usize> {
    config: Config,
    bvh: Bvh<C, W>,
    /// Of two levels.
    instances: Option<Instances>,
    updates: Updates,
    importance: PhantomData<I>,
}

impl<C: TriangleModel<W>, I: ImportanceModel<C::Node, W>, const W: usize> Followed<C, I, W> {
    /// The probability of a sample, the last of its candidates.
    fn draw(&self, tree: &TreeOf<'_, C, W>, point: &ShadingPoint, number: u32) -> f32 {
        let tree = tree.by::<I>();
        let last = |found: &[SampledLight]| found[found.len() - 1].pmf;
        match self.config.candidates {
            1 => tree.sample(point, number).pmf,
            2 => last(&tree.sample_many::<_, 2>(point, number)),
            4 => last(&tree.sample_many::<_, 4>(point, number)),
            8 => last(&tree.sample_many::<_, 8>(point, number)),
            _ => last(&tree.sample_many::<_, 16>(point, number)),
        }
    }
}

impl<C: TriangleModel<W>, I: ImportanceModel<C::Node, W> + Sync, const W: usize> Subject
    for Followed<C, I, W>
{
    fn config(&self) -> Config {
        self.config
    }

    fn bytes(&self) -> usize {
        self.bvh.view().bytes()
    }

    fn updates(&self) -> &Updates {
        &self.updates
    }

    fn build(&self, frame: &Step<'_>) -> Result<Duration, HostError> {
        let built = Timed::of(|| tree::<C, W>(&self.config, frame));
        black_box(&built.value?);
        Ok(built.time)
    }

    fn advance(&mut self, frame: &Step<'_>) -> Result<(), HostError> {
        let start = Instant::now();
        let rebuilds = match self.config.update {
            Update::Refit | Update::TopRebuild => false,
            Update::Rebuild => true,
            Update::EveryEighth => frame.frame.is_multiple_of(8),
        };
        if rebuilds {
            (self.bvh, self.instances) = tree::<C, W>(&self.config, frame)?;
            self.updates.rebuild.push(ms(start.elapsed()));
            return Ok(());
        }
        if self.config.update == Update::TopRebuild {
            self.bvh.rebuild();
            self.updates.background.push(ms(start.elapsed()));
        }
        // Where nodes of the scene stand is the animation's business, not the tree's.
        let edits = self.instances.as_mut().map(|i| i.edits(frame.scene, frame.frame));
        let start = Instant::now();
        match edits {
            Some(edits) => {
                self.bvh.apply(edits).map_err(|error| frame.refused(error))?;
                self.bvh.refit();
            }
            None => follow(&mut self.bvh, frame.lights).map_err(BackendError::from)?,
        }
        self.updates.refit.push(ms(start.elapsed()));
        Ok(())
    }

    fn sample(&self, points: &[ShadingPoint], first: u32) -> Duration {
        let tree = self.bvh.tree();
        let timed = Timed::of(|| {
            let each = points.iter().zip(first..);
            each.map(|(point, number)| self.draw(&tree, point, hash(number)))
                .sum::<f32>()
        });
        black_box(timed.value);
        timed.time
    }

    fn pmf(&self, lights: &Lights, point: &ShadingPoint, light: u32) -> f32 {
        let instance = instance_of(&self.bvh, lights, light);
        self.bvh.tree().by::<I>().pmf(point, light, instance)
    }

    fn render(&self, arrays: &SceneArrays, params: RenderParams) -> Timed<Vec<[f32; 3]>> {
        let tree = self.bvh.tree();
        let view = arrays.lit_by(Emitters {
            lights: self.bvh.view().lights(),
            instances: tree.instances,
        });
        let params = RenderParams {
            candidates: self.config.candidates,
            ..params
        };
        Timed::of(|| render(&view, &arrays.camera, &params, &tree.by::<I>()))
    }
}

/// The tree of a frame, and where the lights of one of two levels are.
fn tree<C: TriangleModel<W>, const W: usize>(
    config: &Config,
    frame: &Step<'_>,
) -> Result<(Bvh<C, W>, Option<Instances>), HostError> {
    let params = config.builder.params();
    if config.levels != Sampler::TwoLevel {
        return Ok((build(frame.lights, config.levels, &params), None));
    }
    let made = Instances::new(frame.scene, frame.frame, params);
    let (bvh, instances) = made.map_err(|error| frame.refused(error))?;
    Ok((bvh, Some(instances)))
}

/// Times of the updates of one configuration over the animation, ms.
#[derive(Default)]
pub(super) struct Updates {
    /// Edits and new bounds.
    refit: Vec<f64>,
    /// New trees, for which frames wait.
    rebuild: Vec<f64>,
    /// New top levels, for which no frame waits.
    background: Vec<f64>,
}

impl Updates {
    /// The median of the refits.
    pub fn refit_ms(&self) -> f64 {
        median_or_zero(&self.refit)
    }

    /// The time that frames wait for: the mean over them, of medians by what was done, so that an interrupted one does not count.
    pub fn mean_ms(&self) -> f64 {
        let of = |times: &[f64]| median_or_zero(times) * times.len() as f64;
        (of(&self.refit) + of(&self.rebuild)) / (self.refit.len() + self.rebuild.len()).max(1) as f64
    }

    /// The median of what is built in the background.
    pub fn background_ms(&self) -> f64 {
        median_or_zero(&self.background)
    }
}

fn median_or_zero(times: &[f64]) -> f64 {
    match times {
        [] => 0.0,
        _ => Interval::of(times.to_vec()).median,
    }
}
