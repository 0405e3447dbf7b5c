//! What may be declared of a scene, and what may be asked for instead of what is chosen.

use std::ffi::OsString;

use crate::cli::reading::{BackendName, Reading};
use lightbvh::requirements::{Layout, Model, Updates};

#[derive(Debug, clap::Args)]
pub struct Args {
    /// A built-in scene (street, square, carousel, stage) or a .gltf, .glb, .obj or .ply file.
    pub scene: OsString,
    #[command(flatten)]
    pub(in crate::cli) reading: Reading,
    /// Lights stay as they are in this frame, whatever the scene's animations say.
    #[arg(long = "static", conflicts_with = "changes")]
    pub still: bool,
    /// What changes besides what the scene's animations move; a file cannot say so.
    #[arg(long, value_enum, value_delimiter = ',')]
    pub changes: Vec<Change>,
    /// No probability of a given light is asked for: there is no multiple importance sampling.
    #[arg(long)]
    pub no_mis: bool,
    /// What nodes store, instead of what is chosen.
    #[arg(long, value_enum)]
    pub layout: Option<LayoutName>,
    /// One level or two, instead of what is chosen.
    #[arg(long, value_enum)]
    pub levels: Option<LevelsName>,
    /// Share of uniform choice, instead of what is chosen.
    #[arg(long, value_enum)]
    pub uniform: Option<Share>,
    /// What may be changed, instead of what is chosen.
    #[arg(long, value_enum)]
    pub updates: Option<UpdatesName>,
    /// Where lights are sampled; for devices, a model whose kernels are not compiled is refused.
    #[arg(long, value_enum, default_value_t = BackendName::Cpu)]
    pub(in crate::cli) backend: BackendName,
    /// Points on surfaces that probabilities are compared at; fewer for more than 131,072 lights.
    #[arg(long, default_value_t = 256, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub points: u32,
    /// Frame that trees are built in; if instances move, they are compared one frame later.
    #[arg(long, default_value_t = 0, value_parser = clap::value_parser!(u32).range(..=1_000_000))]
    pub frame: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Change {
    /// Instances move.
    Transforms,
    /// Instances become brighter or dimmer, as a whole.
    Radiance,
    /// Meshes deform, or the emission of their triangles varies.
    Triangles,
    /// Instances of the same meshes come and go.
    Instances,
    /// Meshes come that are not in the scene yet.
    Meshes,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub enum LayoutName {
    /// 24 bytes of a child.
    Moments,
    /// The same without mean normals: 20 bytes.
    TwoSided,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub enum LevelsName {
    One,
    Two,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub enum Share {
    None,
    #[value(name = "1/64")]
    SixtyFourth,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub enum UpdatesName {
    /// Nothing: `StaticBvh`.
    Nothing,
    /// Where instances stand and how bright they are: `StaticMeshBvh`.
    Instances,
    /// Triangles too: `Bvh`.
    Meshes,
}

impl Args {
    /// Whether a part of the model is asked for by name.
    pub fn asks_for(&self, part: &str) -> bool {
        match part {
            "layout" => self.layout.is_some(),
            "levels" => self.levels.is_some(),
            "uniform share" => self.uniform.is_some(),
            _ => self.updates.is_some(),
        }
    }

    /// What is chosen, but for what is asked for.
    pub fn overrides(&self, chosen: Model) -> Model {
        let uniform_halvings = match self.uniform {
            None => chosen.uniform_halvings,
            Some(Share::None) => 0,
            Some(Share::SixtyFourth) => Model::DEFAULT.uniform_halvings,
        };
        Model {
            layout: match self.layout {
                None => chosen.layout,
                Some(LayoutName::Moments) => Layout::Moments,
                Some(LayoutName::TwoSided) => Layout::TwoSidedMoments,
            },
            single_level: match self.levels {
                None => chosen.single_level,
                Some(levels) => matches!(levels, LevelsName::One),
            },
            uniform_halvings,
            // A share of uniform choice finds its lights by trails.
            trails: chosen.trails || uniform_halvings > 0,
            updates: match self.updates {
                // What a device mirrors is a light BVH with all its edits.
                None if self.backend == BackendName::Vulkan => Updates::Meshes,
                None => chosen.updates,
                Some(UpdatesName::Nothing) => Updates::Nothing,
                Some(UpdatesName::Instances) => Updates::Instances,
                Some(UpdatesName::Meshes) => Updates::Meshes,
            },
            ..chosen
        }
    }
}
