//! `lightbvh inspect`: what a scene requires, the smallest model that is sufficient, and whether it is.

mod check;
mod kinds;

use std::ffi::OsString;

use lightbvh::BuildParams;
use lightbvh::light::AnyLight;
use lightbvh::requirements::{Choice, Declared, Layout, Requirements};
use lightbvh_kernels::bvh::{Triangles, WIDTH};
use serde::Serialize;
use serde_json::{Value, json};

use self::check::{Checked, MOST_VARIANCE, MeanRatio, Promise, Row, check};
use self::kinds::LightKinds;
use super::reading::Reading;
use super::{Context, Outcome, table};
use crate::cli::measure::points;
use crate::cli::table::{news, say, yes};
use crate::error::HostError;
use crate::scene::{Instances, Primitive, Scene, SceneData};
use crate::workload::{lights_at, lights_of};

/// Probabilities that are compared at once: a scene of more lights is looked at from fewer points.
const MOST_PROBABILITIES: usize = 1 << 25;
#[derive(Debug, clap::Args)]
pub struct Args {
    /// A built-in scene (street, square, carousel, stage) or a .gltf, .glb or .obj file.
    scene: OsString,
    #[command(flatten)]
    reading: Reading,
    /// Lights stay as they are in this frame, whatever the scene's animations say.
    #[arg(long = "static", conflicts_with = "changes")]
    still: bool,
    /// What changes besides what the scene's animations move; a file cannot say so.
    #[arg(long, value_enum, value_delimiter = ',')]
    changes: Vec<Change>,
    /// Points on surfaces that probabilities are compared at; fewer for more than 131,072 lights.
    #[arg(long, default_value_t = 256, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    points: u32,
    /// Frame that trees are built in; if instances move, they are compared one frame later.
    #[arg(long, default_value_t = 0, value_parser = clap::value_parser!(u32).range(..=1_000_000))]
    frame: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Change {
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

/// A fact about a scene's lights: a question, the answer, and where it is from.
#[derive(Serialize)]
struct Fact {
    name: &'static str,
    found: String,
    reason: String,
}

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let scene = args.reading.open(&args.scene)?;
    for warning in scene.warnings() {
        news!("{}: {warning}", scene.name());
    }
    scene.require_any_light()?;
    let moving = moving(scene.data());
    let declared = declared(args, moving);
    // A refitted tree is looked at after a refit.
    let frames = [args.frame, args.frame + u32::from(declared.transforms)];
    let mut report = json!({
        "scene": scene.name(), "frame": frames[0], "checked_frame": frames[1],
        "motion": { "moving": moving }, "animations": animations(&scene),
    });
    if scene.analytic_count() > 0 {
        return of_several_kinds(context, &scene, args.frame, moving, report);
    }
    let (bvh, _) = Instances::new::<Triangles, WIDTH>(&scene, args.frame, BuildParams::default())
        .map_err(|error| HostError::in_frame(scene.name(), args.frame, error))?;
    let requirements = Requirements::of(&bvh, declared);
    let chosen = requirements.model();
    let lights = lights_at(&scene, frames[1])?;
    let most = MOST_PROBABILITIES / lights.all().len().max(1);
    let count = args.points.min(most.max(1) as u32);
    let points = points::on_surfaces(&scene, frames[1], count);
    let checked = check(&requirements, &scene, frames, &lights, &points)?;
    let command = (checked.model.layout != Layout::Moments).then(|| {
        format!(
            "cargo run --release -p lightbvh-kernels-builder --features prebuilt-backend -- \
             --model '({}, DefaultImportance)' --width {WIDTH} --receiver ShadingPoint --out target/model",
            checked.model.node_type()
        )
    });
    let (facts, reasons) = (facts(&requirements), reasons(&requirements));
    let outcome = Outcome::good_if(checked.holds());
    let [first, last] = [&checked.rows[0], &checked.rows[checked.last]];
    if context.json {
        let own = json!({
            "points": count, "lights": requirements.lights, "facts": facts,
            "chosen": model_json(&chosen), "reasons": reasons, "model": model_json(&checked.model),
            "kernels": { "committed": command.is_none(), "command": command },
            "default": { "variance": first.variance, "cost": first.cost },
            "steps": checked.rows[1..],
            "saved": {
                "bytes_per_light": first.cost.bytes_per_light - last.cost.bytes_per_light,
                "memory_per_light": first.cost.memory_per_light - last.cost.memory_per_light,
            },
            "holds": checked.holds(),
        });
        for (key, value) in own.as_object().into_iter().flatten() {
            report[key] = value.clone();
        }
        table::print_json(&report)?;
        return Ok(outcome);
    }
    let (name, count_of) = (scene.name(), requirements.lights);
    say!(
        "{name} in frame {}, {count_of} emissive triangles of all instances\n\nwhat it requires",
        args.frame
    )?;
    for fact in &facts {
        line(fact.name, &format!("{}: {}", fact.found, fact.reason))?;
    }
    line("animation", &said(moving))?;
    say!("\nthe smallest model that is sufficient: {chosen}")?;
    for reason in &reasons {
        say!("  {reason}")?;
    }
    print_check(&checked, count, frames)?;
    let how = match checked.model == chosen {
        true => "as chosen",
        false => "less what was put back",
    };
    say!("\nmodel, {how}: {}", checked.model)?;
    match command {
        None => say!("kernels for devices: committed")?,
        Some(command) => say!("kernels for devices: not committed; they are compiled by\n  {command}")?,
    }
    Ok(outcome)
}

/// A scene that not only triangles light: its kinds of light, and the tree over all of them, which `verify` checks.
fn of_several_kinds(
    context: &Context,
    scene: &Scene,
    frame: u32,
    moving: usize,
    mut report: Value,
) -> Result<Outcome, HostError> {
    let lights = lights_of::<AnyLight>(scene, frame)?;
    let count = lights.all().len();
    let kinds = LightKinds::of(lights.all());
    let tree = kinds.tree();
    if context.json {
        report["lights"] = count.into();
        report["kinds"] = kinds.json();
        report["tree"] = tree.into();
        table::print_json(&report)?;
        return Ok(Outcome::Good);
    }
    say!(
        "{} in frame {frame}, {count} lights in meshes and by themselves\n\nwhat it requires",
        scene.name()
    )?;
    line("lights", &kinds.cones())?;
    line("animation", &said(moving))?;
    say!("\na tree over its lights: {tree}, two levels")?;
    Ok(Outcome::Good)
}

/// Whether nodes with lights move.
fn said(moving: usize) -> String {
    match moving {
        0 => "no: no animation moves a node with lights".to_owned(),
        _ => format!("yes: nodes with lights move: {moving}"),
    }
}

/// The animations, by their numbers in the file.
fn animations(scene: &Scene) -> Value {
    let all = scene.data().animations.iter();
    all.map(|own| json!({ "number": own.place, "name": own.name }))
        .collect()
}

fn declared(args: &Args, moving: usize) -> Declared {
    let has = |change| !args.still && args.changes.contains(&change);
    Declared {
        transforms: has(Change::Transforms) || !args.still && moving > 0,
        radiance: has(Change::Radiance),
        triangles: has(Change::Triangles),
        instances: has(Change::Instances),
        meshes: has(Change::Meshes),
    }
}

/// How many nodes with lights the animations move.
fn moving(data: &SceneData) -> usize {
    let mut moves = vec![false; data.nodes.len()];
    for channel in data.animations.iter().flat_map(|own| &own.channels) {
        moves[channel.node as usize] = true;
    }
    // Parents come before their children.
    for index in 0..data.nodes.len() {
        let parent = data.nodes[index].parent;
        moves[index] |= parent.is_some_and(|parent| moves[parent as usize]);
    }
    let is_bright = |rgb: &[f32; 3]| rgb.iter().any(|&channel| channel > 0.0);
    let shines = |primitive: &Primitive| match &primitive.radiance {
        Some(all) => all.iter().any(is_bright),
        None => is_bright(&data.materials[primitive.material as usize].radiance),
    };
    let shining = |mesh: u32| data.meshes[mesh as usize].primitives.iter().any(shines);
    let nodes = data.nodes.iter().zip(&moves);
    let lit = nodes.filter(|&(node, &moves)| moves && node.mesh.is_some_and(shining));
    let others = data.analytic.iter();
    lit.count() + others.filter(|light| moves[light.node as usize]).count()
}

/// The changes that are declared; none where everything stays.
fn changes(declared: &Declared) -> Vec<&'static str> {
    let named = [
        (declared.transforms, "instances move"),
        (declared.radiance, "instances are dimmed"),
        (declared.instances, "instances come and go"),
        (declared.meshes, "meshes come"),
        (declared.triangles, "meshes deform or vary in emission"),
    ];
    let there = named.into_iter().filter(|(is, _)| *is);
    there.map(|(_, what)| what).collect()
}

/// Every fact, each with its reason.
fn facts(found: &Requirements) -> [Fact; 3] {
    let (triangles, one_sided) = (found.triangles, found.one_sided);
    let changes = changes(&found.declared);
    let changed = match changes.is_empty() {
        true => "everything stays as it is".to_owned(),
        false => format!("{}, as declared", changes.join(", ")),
    };
    let sides = format!(
        "of {triangles} triangles {one_sided} shine from one side, {} from both",
        triangles - one_sided
    );
    let meshes = format!(
        "meshes: {}, instances: {}, at most {} of a mesh",
        found.meshes, found.instances, found.most_instances
    );
    let is_two_sided = one_sided == 0 && triangles > 0;
    [
        ("two-sided only", is_two_sided, sides),
        ("one mesh", found.is_one_mesh(), meshes),
        ("changes", !changes.is_empty(), changed),
    ]
    .map(|(name, is, reason)| Fact {
        name,
        found: yes(is),
        reason,
    })
}

/// Why each part of the smallest model is what it is: a sentence for each that begins with its name.
fn reasons(found: &Requirements) -> [String; 2] {
    let model = found.model();
    let layout = match (model.layout, found.one_sided) {
        (Layout::TwoSidedMoments, _) => "no light has a normal, so nodes leave their row out",
        (_, 0) => "nothing is known of meshes that come, so nodes keep mean normals",
        _ => "some triangles shine from one side, so nodes keep mean normals",
    };
    let levels = match (model.single_level, found.is_one_mesh()) {
        (false, _) => {
            let mut needs = changes(&found.declared);
            needs.extend((found.most_instances > 1).then_some("instances share meshes"));
            format!("two, because {}", needs.join(", "))
        }
        (true, true) => "one, because one mesh stays in its place: no top level chooses it".to_owned(),
        (true, false) => "one, because all meshes stay as they are, each in one place".to_owned(),
    };
    [format!("layout: {layout}"), format!("levels: {levels}")]
}

/// The default, and each part that is another, one after the other.
fn print_check(checked: &Checked, points: u32, [frame, moved]: [u32; 2]) -> std::io::Result<()> {
    let (default, last) = (&checked.rows[0], &checked.rows[checked.last]);
    if default.variance.is_none() {
        say!("\nno point receives light of a tree: what parts promise of the variance is not known to hold")?;
    }
    let refitted = match moved == frame {
        true => String::new(),
        false => format!(" in frame {moved}, after a refit"),
    };
    say!("\nchecked from {points} points on surfaces{refitted}, one part after the other")?;
    table::print(&checked.rows, COLUMNS)?;
    let (default, last) = (default.cost, last.cost);
    say!(
        "saved against the default: {:.1} of {:.1} bytes per light that sampling reads, {:.1} of {:.1} in all arrays",
        default.bytes_per_light - last.bytes_per_light,
        default.bytes_per_light,
        default.memory_per_light - last.memory_per_light,
        default.memory_per_light,
    )?;
    for row in checked.rows.iter().filter(|row| !row.held) {
        let done = match row.put_back {
            true => "the part is put back",
            false => "this is a fault of lightbvh; please report it",
        };
        say!(
            "{}: the promise of {} does not hold here, {done}",
            row.part,
            row.promised()
        )?;
    }
    Ok(())
}

/// A line of what is required.
fn line(name: &str, text: &str) -> std::io::Result<()> {
    say!("  {name:<20} {text}")
}

impl Row {
    fn promised(&self) -> String {
        match self.promise {
            None => "-".to_owned(),
            Some(Promise::Bits) => "equal bits".to_owned(),
            Some(Promise::BitsBelowInstance) => "equal bits below the instance".to_owned(),
            Some(Promise::Variance) => format!("variance surely up to {MOST_VARIANCE} times"),
        }
    }
}

const COLUMNS: &[table::Column<Row>] = &[
    ("part", |r| r.part.to_owned()),
    ("promise", Row::promised),
    ("holds", |r| yes(r.held)),
    ("compared", |r| r.compared.to_string()),
    ("different", |r| r.different.to_string()),
    ("variance", |r| table::known(r.variance, 4)),
    ("times, 95 %", |r| match r.variance_ratio {
        Some(MeanRatio { ratio, low, high }) => format!("{ratio:.3} [{low:.3}, {high:.3}]"),
        None => table::known(None, 3),
    }),
    ("bytes/light", |r| format!("{:.1}", r.cost.bytes_per_light)),
    ("all arrays", |r| format!("{:.1}", r.cost.memory_per_light)),
];

fn model_json(model: &Choice) -> Value {
    json!({
        "type": model.type_name(),
        "layout": model.layout.name(),
        "levels": 2 - u32::from(model.single_level),
        "width": WIDTH,
    })
}
