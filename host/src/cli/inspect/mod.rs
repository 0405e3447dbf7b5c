//! `lightbvh inspect`: what a scene requires, the smallest model that is sufficient, and whether it is.

mod check;
mod kinds;

use std::ffi::OsString;

use lightbvh::BuildParams;
use lightbvh::importance::DefaultImportance;
use lightbvh::light::AnyLight;
use lightbvh::requirements::{Declared, Layout, Model, Requirements, Updates};
use lightbvh_gpu::KernelSet;
use lightbvh_kernels::bvh::{Node, WIDTH};
use serde::Serialize;
use serde_json::{Value, json};

use self::check::{Checked, MOST_VARIANCE, MeanRatio, Promise, Row, check};
use self::kinds::LightKinds;
use super::reading::Reading;
use super::{Context, Outcome, table};
use crate::cli::measure::{NOT_MEASURED, points};
use crate::cli::table::{news, yes};
use crate::error::HostError;
use crate::scene::{Instances, Primitive, Property, Scene, SceneData};
use crate::workload::{lights_at, lights_of};

/// Probabilities that are compared at once: a scene of more lights is looked at from fewer points.
const MOST_PROBABILITIES: usize = 1 << 25;
/// Roughness up to which a surface counts as glossy: its lobe then covers less than a tenth of the hemisphere.
const GLOSSY: f32 = 0.5;

#[derive(Debug, clap::Args)]
pub struct Args {
    /// A built-in scene (street, square, carousel, stage) or a .gltf, .glb, .obj or .ply file.
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

/// How many nodes with lights the scene's animations move, and the meshes of how many they deform.
#[derive(Clone, Copy, Debug, Default, Serialize)]
struct Motion {
    moving: usize,
    bending: usize,
}

/// Materials by what matters to the choice of a light.
#[derive(Clone, Copy, Debug, Serialize)]
struct Surfaces {
    materials: usize,
    glossy: usize,
}

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let scene = args.reading.open(&args.scene)?;
    for warning in scene.warnings() {
        news!("{}: {warning}", scene.name());
    }
    scene.require_any_light()?;
    let others_alone = scene.emissive_count() == 0;
    let motion = Motion::of(scene.data(), others_alone);
    let surfaces = Surfaces::of(scene.data());
    let declared = declared(args, motion);
    // A refitted tree is looked at after a refit.
    let frames = [args.frame, args.frame + u32::from(declared.transforms)];
    let mut report = json!({
        "scene": scene.name(), "frame": frames[0], "checked_frame": frames[1],
        "motion": motion, "animations": animations(&scene), "surfaces": surfaces,
    });
    let about = line("animation", &motion.said());
    if others_alone {
        return without_triangles(context, &scene, (args.frame, declared), (report, &about));
    }
    if let Some(left_out) = scene.unknown_in_figures() {
        news!("{}: {left_out}", scene.name());
    }
    let (bvh, _) =
        Instances::new::<Node, DefaultImportance, WIDTH>(&scene, args.frame, BuildParams::default())
            .map_err(|error| HostError::in_frame(scene.name(), args.frame, error))?;
    let requirements = Requirements::of(&bvh, declared);
    let chosen = requirements.model();
    let lights = lights_at(&scene, frames[1])?;
    let most = MOST_PROBABILITIES / lights.triangles().len().max(1);
    let count = args.points.min(most.max(1) as u32);
    let points = points::on_surfaces(&scene, frames[1], count);
    let checked = check(&requirements, &scene, frames, &lights, &points)?;
    let kernels = KernelSet::of(&checked.model)
        .err()
        .map(|missing| missing.command());
    let kinds = match scene.analytic_count() {
        0 => None,
        _ => Some(LightKinds::of(
            lights_of::<AnyLight>(&scene, args.frame)?.triangles(),
        )),
    };
    let (facts, reasons) = (facts(&requirements, &surfaces), reasons(&requirements, &surfaces));
    if context.json {
        let [first, last] = [&checked.rows[0], &checked.rows[checked.last]];
        let own = json!({
            "points": count, "lights": requirements.lights, "facts": facts,
            "kinds": kinds.as_ref().map(LightKinds::json),
            "chosen": model_json(&chosen), "reasons": reasons, "model": model_json(&checked.model),
            "kernels": { "committed": kernels.is_none(), "command": kernels },
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
        return Ok(Outcome::good_if(checked.holds()));
    }
    let mut text = format!(
        "{} in frame {}, {} emissive triangles\n\nwhat it requires\n",
        scene.name(),
        args.frame,
        requirements.lights
    );
    text.extend(
        facts
            .iter()
            .map(|fact| line(fact.name, &format!("{}: {}", fact.found, fact.reason))),
    );
    text += &about;
    text += &format!("\nthe smallest model that is sufficient: {chosen}\n");
    text.extend(reasons.iter().map(|reason| format!("  {reason}\n")));
    if let Some(kinds) = &kinds {
        text += &format!(
            "a tree over its lights of all kinds: {}\n  lights: {}\n",
            kinds.tree(),
            kinds.cones()
        );
    }
    table::print_text(&text)?;
    print_check(&checked, count, frames)?;
    let how = match checked.model == chosen {
        true => "as chosen",
        false => "less what was put back",
    };
    let kernels = match &kernels {
        None => "committed\n".to_owned(),
        Some(command) => format!("not committed; they are compiled by\n  {command}\n"),
    };
    let of = kinds.map_or("", |_| " of its triangles alone");
    let model = &checked.model;
    table::print_text(&format!(
        "\nmodel{of}, {how}: {model}\nkernels for devices: {kernels}"
    ))?;
    Ok(Outcome::good_if(checked.holds()))
}

/// A scene that no triangle lights: its kinds of light, and the tree over all of them, which `verify` checks.
fn without_triangles(
    context: &Context,
    scene: &Scene,
    (frame, declared): (u32, Declared),
    (mut report, about): (Value, &str),
) -> Result<Outcome, HostError> {
    let lights = lights_of::<AnyLight>(scene, frame)?;
    let count = lights.triangles().len();
    let kinds = LightKinds::of(lights.triangles());
    let tree = kinds.tree();
    if context.json {
        report["lights"] = count.into();
        report["kinds"] = kinds.json();
        report["tree"] = tree.into();
        table::print_json(&report)?;
        return Ok(Outcome::Good);
    }
    let mut text = format!(
        "{} in frame {frame}, lit by {}\n\nwhat it requires\n",
        scene.name(),
        scene.other_lights()
    );
    text += &line("lights of a tree", &kinds.cones());
    text += &line("changes", &yes(!changes(&declared).is_empty()));
    text += about;
    text += &format!("\na tree over its lights: {tree}, two levels\n");
    table::print_text(&text)?;
    Ok(Outcome::Good)
}

/// All animations of the file, by their numbers.
fn animations(scene: &Scene) -> Value {
    let data = scene.data();
    let shown = data
        .animations
        .iter()
        .map(|own| (own.place, &own.name, true, true));
    let clips = data.clips.iter().map(|own| (own.place, &own.name, false, true));
    let idle = data.idle.iter().map(|(place, name)| (*place, name, false, false));
    let mut all: Vec<_> = shown.chain(clips).chain(idle).collect();
    all.sort_by_key(|&(place, ..)| place);
    all.into_iter()
        .map(|(place, name, is_shown, moves)| json!({ "number": place, "name": name, "shown": is_shown, "moves": moves }))
        .collect()
}

fn declared(args: &Args, motion: Motion) -> Declared {
    let has = |change| !args.still && args.changes.contains(&change);
    Declared {
        transforms: has(Change::Transforms) || !args.still && motion.moving > 0,
        radiance: has(Change::Radiance),
        triangles: has(Change::Triangles) || !args.still && motion.bending > 0,
        instances: has(Change::Instances),
        meshes: has(Change::Meshes),
    }
}

impl Motion {
    /// Of the targets of all animations, shown or not: nodes with emissive meshes, or `with_others` too.
    fn of(data: &SceneData, with_others: bool) -> Self {
        let (mut moves, mut morphs) = (vec![false; data.nodes.len()], vec![false; data.nodes.len()]);
        for channel in data
            .animations
            .iter()
            .chain(&data.clips)
            .flat_map(|own| &own.channels)
        {
            match channel.property {
                Property::Weights(_) => morphs[channel.node as usize] = true,
                _ => moves[channel.node as usize] = true,
            }
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
        let mut found = Self::default();
        for (index, node) in data.nodes.iter().enumerate() {
            let primitives = node.mesh.map(|mesh| &data.meshes[mesh as usize].primitives);
            if !primitives.is_some_and(|all| all.iter().any(shines)) {
                continue;
            }
            let skin = node.skin.map(|skin| &data.skins[skin as usize].joints);
            let bends = skin.is_some_and(|joints| joints.iter().any(|&joint| moves[joint as usize]));
            found.bending += usize::from(bends || morphs[index]);
            found.moving += usize::from(skin.is_none() && moves[index]);
        }
        let others = data.analytic.iter();
        let moving = others.filter(|light| moves[light.node as usize]).count();
        found.moving += if with_others { moving } else { 0 };
        found
    }

    fn said(self) -> String {
        let Self { moving, bending } = self;
        match (moving, bending) {
            (0, 0) => "no: no animation moves a node with lights".to_owned(),
            _ => format!("yes: nodes with lights move: {moving}; their meshes deform: {bending}"),
        }
    }
}

impl Surfaces {
    fn of(data: &SceneData) -> Self {
        let materials = &data.materials;
        Self {
            materials: materials.len(),
            glossy: materials.iter().filter(|own| own.roughness <= GLOSSY).count(),
        }
    }

    fn gloss(&self) -> String {
        let Self { materials, glossy } = self;
        format!("of {materials} materials {glossy} have a roughness of {GLOSSY} or less")
    }
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
fn facts(found: &Requirements, surfaces: &Surfaces) -> Vec<Fact> {
    let (triangles, one_sided) = (found.triangles, found.one_sided);
    let changes = changes(&found.declared);
    let changed = match changes.is_empty() {
        true => "everything stays as it is".to_owned(),
        false => changes.join(", "),
    };
    let fact = |name, found: &str, reason: String| Fact {
        name,
        found: found.to_owned(),
        reason,
    };
    let is = |is| if is { "yes" } else { "no" };
    let sides = format!(
        "of {triangles} triangles {one_sided} shine from one side, {} from both",
        triangles - one_sided
    );
    let meshes = format!(
        "meshes: {}, instances: {}, at most {} of a mesh",
        found.meshes, found.instances, found.most_instances
    );
    vec![
        fact("two-sided only", is(one_sided == 0 && triangles > 0), sides),
        fact("one mesh", is(found.is_one_mesh()), meshes),
        fact(
            "changes",
            is(!changes.is_empty()),
            format!("{changed}, as declared"),
        ),
        fact("glossy receivers", is(surfaces.glossy > 0), surfaces.gloss()),
    ]
}

/// Why each part of the smallest model is what it is: a sentence for each that begins with its name.
fn reasons(found: &Requirements, surfaces: &Surfaces) -> Vec<String> {
    let model = found.model();
    let layout = match (model.layout, found.one_sided) {
        (Layout::TwoSidedMoments, _) => {
            "no light has a normal, so nodes leave their row out: 20 bytes of each child instead of 24"
                .to_owned()
        }
        (_, 0) => "of meshes that come nothing is known, so nodes keep mean normals".to_owned(),
        (_, some) => format!(
            "{some} of {} triangles shine from one side, so nodes keep mean normals",
            found.triangles
        ),
    };
    let levels = match (model.single_level, found.is_one_mesh()) {
        (false, _) => {
            let mut needs = changes(&found.declared);
            if found.most_instances > 1 {
                needs.push("instances share meshes");
            }
            format!("two, because {}", needs.join(", "))
        }
        (true, true) => "one, because one mesh stays in its place: no top level chooses it".to_owned(),
        (true, false) => format!(
            "one, because all {} meshes stay as they are, each in one place",
            found.meshes
        ),
    };
    let updates = match model.updates {
        Updates::Nothing => {
            "nothing changes, so triangles, instance states and lists for refits are not kept"
        }
        Updates::All => "lights change, so everything is kept",
    };
    let mut said = vec![
        format!("layout: {layout}"),
        format!("levels: {levels}"),
        format!("updates: {updates}"),
    ];
    if surfaces.glossy > 0 {
        said.push(
            "glossy surfaces: rays into their lobes share lights with samples by probabilities (multiple importance sampling); an \
             importance that knows the lobe (`Glossy`) may have less variance for the same samples, and takes longer for each"
                .to_owned(),
        );
    }
    said
}

/// The default, and each part that is another, one after the other.
fn print_check(checked: &Checked, points: u32, [frame, moved]: [u32; 2]) -> Result<(), HostError> {
    let (default, last) = (&checked.rows[0], &checked.rows[checked.last]);
    if default.variance.is_none() {
        table::print_text(&format!(
            "\nfrom {points} points on surfaces: {NOT_MEASURED}; what parts promise of the variance is not known to hold\n"
        ))?;
    }
    let refitted = match moved == frame {
        true => String::new(),
        false => format!(" in frame {moved}, after a refit"),
    };
    table::print_text(&format!(
        "\nchecked from {points} points on surfaces{refitted}, one part after the other\n"
    ))?;
    table::print(&checked.rows, COLUMNS)?;
    let (default, last) = (default.cost, last.cost);
    table::print_text(&format!(
        "saved against the default: {:.1} of {:.1} bytes per light that sampling reads, {:.1} of {:.1} in all arrays\n",
        default.bytes_per_light - last.bytes_per_light,
        default.bytes_per_light,
        default.memory_per_light - last.memory_per_light,
        default.memory_per_light,
    ))?;
    for row in checked.rows.iter().filter(|row| !row.held) {
        let done = match row.put_back {
            true => "the part is put back",
            false => "this is a fault of lightbvh; please report it",
        };
        let promise = row.promised();
        table::print_text(&format!(
            "{}: the promise of {promise} does not hold here, {done}\n",
            row.part
        ))?;
    }
    Ok(())
}

/// A line of what is required.
fn line(name: &str, text: &str) -> String {
    format!("  {name:<20} {text}\n")
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

fn model_json(model: &Model) -> Value {
    json!({
        "type": model.type_name(),
        "layout": model.layout.name(),
        "levels": 2 - u32::from(model.single_level),
        "width": model.width,
        "updates": model.updates.name(),
    })
}
