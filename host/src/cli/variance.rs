//! `lightbvh variance`: the exact variance of one sample by each importance, on families of scenes.

mod families;

use lightbvh::importance::DefaultImportance;
use lightbvh::node::LightNode;
use lightbvh::{BuildParams, Bvh, CompactNode, Eq4, Heuristic, ImportanceModel, MomentNode, SampledLight};
use lightbvh_peers::{Falcor, Pbrt};
use serde::Serialize;

use self::families::{FAMILIES, Scene};
use super::measure::interval::Interval;
use super::measure::{mean_of, variances};
use super::table::say;
use super::{Context, Outcome, table};
use crate::error::HostError;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Only these families; may be repeated [default: all].
    #[arg(long, value_parser = FAMILIES.map(|(name, _)| name))]
    family: Vec<String>,
    /// Points of each scene.
    #[arg(long, default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    points: u32,
    /// Another scene of each family by another seed.
    #[arg(long, default_value_t = 1)]
    seed: u32,
}

/// The relative variance of diffuse light without shadows, over the points that any light reaches.
#[derive(Clone, Copy, Debug, Serialize)]
struct Found {
    mean: Option<f64>,
    median: Option<f64>,
}

/// An importance on its nodes, measured with one level and two.
#[derive(Debug, Serialize)]
struct Choice {
    name: &'static str,
    one: Found,
    two: Found,
}

#[derive(Debug, Serialize)]
struct Row {
    family: &'static str,
    lights: usize,
    choices: Vec<Choice>,
}

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let is_wanted = |name: &str| args.family.is_empty() || args.family.iter().any(|own| own == name);
    let families = FAMILIES.into_iter().filter(|(name, _)| is_wanted(name));
    let rows = families.map(|family| {
        let scene = Scene::new(family, args.seed, args.points);
        Row {
            family: family.0,
            lights: scene.lights.all().len(),
            choices: choices(&scene),
        }
    });
    let rows: Vec<Row> = rows.collect();
    if context.json {
        table::print_json(&rows)?;
        return Ok(Outcome::Good);
    }
    table::print(&rows, COLUMNS)?;
    say!(
        "exact variance of one sample over its squared mean, diffuse light without shadows, less is better: mean (median) over points, one \
         level; two levels;\ndefault on {} children a node by Ward's criterion, eq4, pbrt and falcor on 4 by SAOH; families: docs/figures.md",
        lightbvh_kernels::bvh::WIDTH
    )?;
    Ok(Outcome::Good)
}

/// The default, the same with 16 children, and the peers on the paper's tree.
fn choices(scene: &Scene) -> Vec<Choice> {
    let (own, paper) = (BuildParams::BALANCED, BuildParams::paper(Heuristic::Saoh));
    vec![
        choice::<MomentNode<8>, DefaultImportance, 8>("default", scene, &own),
        choice::<MomentNode<16>, DefaultImportance, 16>("16 wide", scene, &own),
        choice::<CompactNode<4>, Eq4, 4>("eq4", scene, &paper),
        choice::<CompactNode<4>, Pbrt, 4>("pbrt", scene, &paper),
        choice::<CompactNode<4>, Falcor, 4>("falcor", scene, &paper),
    ]
}

fn choice<N: LightNode<W> + Sync, I: ImportanceModel<N, W> + Sync, const W: usize>(
    name: &'static str,
    scene: &Scene,
    params: &BuildParams,
) -> Choice {
    let [one, two] = [false, true].map(|is_two| {
        let bvh: Bvh<(N, I), W> = match is_two {
            true => Bvh::two_level(&scene.lights, params),
            false => Bvh::single_level(&scene.lights, params),
        };
        let tree = bvh.tree();
        let lights = scene.lights.all();
        let all = variances(lights, &scene.points, |point, light| {
            let mesh = lights[light as usize].mesh;
            let instance = if is_two { mesh } else { SampledLight::INVALID };
            tree.pmf(&scene.points[point], light, instance)
        });
        let all: Vec<f64> = all.into_iter().flatten().collect();
        Found {
            mean: mean_of(&all),
            median: (!all.is_empty()).then(|| Interval::of(all).median),
        }
    });
    Choice { name, one, two }
}

const COLUMNS: &[table::Column<Row>] = &[
    ("family", |row| row.family.to_owned()),
    ("lights", |row| row.lights.to_string()),
    ("default", |row| cell(&row.choices[0])),
    ("16 wide", |row| cell(&row.choices[1])),
    ("eq4", |row| cell(&row.choices[2])),
    ("pbrt", |row| cell(&row.choices[3])),
    ("falcor", |row| cell(&row.choices[4])),
];

fn cell(choice: &Choice) -> String {
    let of = |found: &Found| {
        let [mean, median] = [found.mean, found.median].map(|value| table::known(value, 2));
        format!("{mean} ({median})")
    };
    format!("{}; {}", of(&choice.one), of(&choice.two))
}
