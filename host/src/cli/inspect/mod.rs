//! `lightbvh inspect`: what a scene requires, the smallest model that is sufficient, and whether it is.

mod motion;
mod steps;
mod subject;

use lightbvh::BuildParams;
use lightbvh::requirements::{Changes, Declared, Layout, Model, Receivers, Requirements, Structure};
use lightbvh_gpu::KernelSet;
use lightbvh_kernels::bvh::{Node, WIDTH};
use serde_json::{Value, json};

use self::motion::Motion;
use self::steps::{Checked, Cost, MOST_VARIANCE, Promise, Step, check};
use self::subject::{Source, is_known};
use super::trade::quantile::Interval;
use super::variance::points;
use super::{Context, Outcome, table};
use crate::error::HostError;
use crate::scene::{Instances, Scene};
use crate::workload::lights_at;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// A built-in scene (street, square, carousel) or a .gltf or .glb file.
    scene: String,
    /// Lights stay as they are in this frame, whatever the scene's animations say.
    #[arg(long = "static")]
    still: bool,
    /// No probability of a given light is asked for: there is no multiple importance sampling.
    #[arg(long)]
    no_mis: bool,
    /// What nodes store, instead of what is chosen.
    #[arg(long, value_enum)]
    layout: Option<LayoutName>,
    /// One level or two, instead of what is chosen.
    #[arg(long, value_enum)]
    levels: Option<LevelsName>,
    /// Children of a node, instead of 8: 4 or 16, of moments and two-sided moments.
    #[arg(long, value_parser = clap::value_parser!(u32).range(4..=16))]
    width: Option<u32>,
    /// Share of uniform choice, instead of what is chosen.
    #[arg(long, value_enum)]
    uniform: Option<Share>,
    /// Where lights are sampled. On devices a model whose kernels are not compiled is refused, with the command that compiles them.
    #[arg(long, value_enum, default_value_t = BackendName::Cpu)]
    backend: BackendName,
    /// Points on the surfaces of the scene that probabilities are compared at.
    #[arg(long, default_value_t = 256, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    points: u32,
    /// Frame of the animation that trees are built in.
    #[arg(long, default_value_t = 0)]
    frame: u32,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum LayoutName {
    /// 24 bytes of a child.
    Moments,
    /// The same without mean normals: 20 bytes.
    TwoSided,
    /// Without boxes and with one deviation: 20 bytes.
    Lean,
    /// Not quantised: 60 bytes.
    Full,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum LevelsName {
    One,
    Two,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum Share {
    None,
    #[value(name = "1/64")]
    SixtyFourth,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum BackendName {
    Cpu,
    Vulkan,
}

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let scene = Scene::open(&args.scene)?;
    for warning in scene.warnings() {
        eprintln!("{}: {warning}", scene.name());
    }
    let lights = lights_at(&scene, args.frame)?;
    let motion = Motion::of(&scene)?;
    let (bvh, _) = Instances::new::<Node, (), WIDTH>(&scene, args.frame, BuildParams::default())
        .map_err(|error| HostError::in_frame(scene.name(), args.frame, error))?;
    let requirements = Requirements::of(&bvh, declared(args, &motion));
    let chosen = requirements.model();
    let model = overridden(chosen, args);
    model.check(&requirements)?;
    if !is_known(&model) {
        return Err(HostError::Usage {
            option: "--width 4 or 16",
            needs: "--layout moments or two-sided",
        });
    }
    let kernels = KernelSet::of(&model);
    if args.backend == BackendName::Vulkan {
        kernels?;
    }
    let (_, points) = points::of(&args.scene, 0, args.frame, args.points)?;
    let source = Source {
        scene: &scene,
        frame: args.frame,
        lights: &lights,
    };
    let checked = check(&model, &requirements, &source, &points)?;
    let report = Report {
        args,
        motion,
        requirements,
        chosen,
        model,
        kernels: kernels.err().map(|missing| missing.command()),
        checked,
    };
    if context.json {
        table::print_json(&report.json())?;
    } else {
        report.print()?;
    }
    Ok(Outcome::good_if(report.holds()))
}

fn declared(args: &Args, motion: &Motion) -> Declared {
    let changes = Changes {
        transforms: motion.moving > 0,
        vertices: motion.deforming > 0,
        emission: motion.varying > 0,
        ..Changes::NONE
    };
    Declared {
        changes: if args.still { Changes::NONE } else { changes },
        receivers: Receivers::Surfaces,
        pmf: !args.no_mis,
    }
}

/// What is chosen, but for what is asked for.
fn overridden(chosen: Model, args: &Args) -> Model {
    let uniform_halvings = match args.uniform {
        None => chosen.uniform_halvings,
        Some(Share::None) => 0,
        Some(Share::SixtyFourth) => Model::DEFAULT.uniform_halvings,
    };
    Model {
        layout: match args.layout {
            None => chosen.layout,
            Some(LayoutName::Moments) => Layout::Moments,
            Some(LayoutName::TwoSided) => Layout::TwoSidedMoments,
            Some(LayoutName::Lean) => Layout::LeanMoments,
            Some(LayoutName::Full) => Layout::FullMoments,
        },
        structure: match args.levels {
            None => chosen.structure,
            Some(LevelsName::One) => Structure::SingleLevel,
            Some(LevelsName::Two) => Structure::TwoLevel,
        },
        width: args.width.map_or(chosen.width, |width| width as usize),
        uniform_halvings,
        // A share of uniform choice finds its lights by trails.
        trails: chosen.trails || uniform_halvings > 0,
        ..chosen
    }
}

/// Everything that is said.
struct Report<'a> {
    args: &'a Args,
    motion: Motion,
    requirements: Requirements,
    chosen: Model,
    model: Model,
    /// The command that compiles the model's kernels, where they are not committed.
    kernels: Option<String>,
    checked: Checked,
}

impl Report<'_> {
    /// Whether every promise holds: all of what was chosen, and equal bits of what was asked for.
    fn holds(&self) -> bool {
        let asked_for = self.model != self.chosen;
        let steps = &self.checked.steps;
        steps
            .iter()
            .all(|step| step.kept || (asked_for && step.promise == Promise::Variance))
    }

    /// What the model costs: that of the last step.
    fn cost(&self) -> Cost {
        let last = self.checked.steps.last();
        last.map_or(self.checked.default, |step| step.cost)
    }

    fn json(&self) -> Value {
        let facts: Vec<Value> = self
            .requirements
            .facts()
            .into_iter()
            .map(|fact| json!({ "name": fact.name, "found": fact.found, "reason": fact.reason }))
            .collect();
        let (default, cost) = (self.checked.default, self.cost());
        json!({
            "scene": self.args.scene, "frame": self.args.frame, "points": self.args.points,
            "lights": self.requirements.lights,
            "facts": facts,
            "motion": self.motion,
            "chosen": model_json(&self.chosen),
            "reasons": self.requirements.reasons(),
            "model": model_json(&self.model),
            "overridden": self.model != self.chosen,
            "kernels": { "committed": self.kernels.is_none(), "command": self.kernels },
            "default": { "variance": self.checked.variance, "cost": default },
            "steps": self.checked.steps,
            "saved": {
                "bytes_per_light": default.bytes_per_light - cost.bytes_per_light,
                "memory_per_light": default.memory_per_light - cost.memory_per_light,
                "ns_per_sample": cost.ns_saved,
            },
            "holds": self.holds(),
        })
    }

    fn print(&self) -> Result<(), HostError> {
        println!("requires");
        table::print(
            &self.requirements.facts(),
            &[
                ("fact", |fact| fact.name.to_owned()),
                ("", |fact| fact.found.clone()),
                ("because", |fact| fact.reason.clone()),
            ],
        )?;
        println!("motion: {}\n", self.motion.said());
        println!("model: {}", self.chosen);
        for reason in self.requirements.reasons() {
            println!("  {reason}");
        }
        if self.model != self.chosen {
            println!("overridden: {}", self.model);
        }
        match &self.kernels {
            None => println!("kernels: committed"),
            Some(command) => println!("kernels: not committed; {command}"),
        }
        println!(
            "\nchecked at {} points, one part after the other; the default has {:.1} bytes per light, {:.1} in all arrays, {:.0} ns per \
             sample, variance {:.4}",
            self.args.points,
            self.checked.default.bytes_per_light,
            self.checked.default.memory_per_light,
            self.checked.default.ns_per_sample,
            self.checked.variance
        );
        table::print(&self.checked.steps, COLUMNS)?;
        let (default, cost) = (self.checked.default, self.cost());
        let Interval { median, low, high } = cost.ns_saved;
        println!(
            "saved: {:.1} bytes per light of {:.1}, {:.1} of {:.1} in all arrays, {median:.1} ns per sample [{low:.1}, {high:.1}]",
            default.bytes_per_light - cost.bytes_per_light,
            default.bytes_per_light,
            default.memory_per_light - cost.memory_per_light,
            default.memory_per_light,
        );
        Ok(())
    }
}

const COLUMNS: &[table::Column<Step>] = &[
    ("part", |s| s.part.to_owned()),
    ("promise", |s| match s.promise {
        Promise::Bits => "equal bits".to_owned(),
        Promise::BitsThroughIdentity => "equal bits at points as the identity leaves them".to_owned(),
        Promise::Variance => format!("variance up to {MOST_VARIANCE} times"),
    }),
    ("compared", |s| s.compared.to_string()),
    ("different", |s| s.different.to_string()),
    ("most", |s| format!("{:.1e}", s.most)),
    ("variance", |s| format!("{:.4}", s.variance)),
    ("kept", |s| table::yes(s.kept)),
    ("bytes/light", |s| format!("{:.1}", s.cost.bytes_per_light)),
    ("all arrays", |s| format!("{:.1}", s.cost.memory_per_light)),
    ("sample ns", |s| format!("{:.1}", s.cost.ns_per_sample)),
];

fn model_json(model: &Model) -> Value {
    json!({
        "type": model.type_name(),
        "layout": model.layout.name(),
        "levels": match model.structure {
            Structure::SingleLevel => 1,
            Structure::TwoLevel => 2,
        },
        "width": model.width,
        "uniform_halvings": model.uniform_halvings,
        "trails": model.trails,
        "refit": model.refit,
    })
}
