//! `lightbvh variance`: the exact variance of one sample by each importance, on families of scenes.

mod families;

use lightbvh::importance::DefaultImportance;
use lightbvh::node::LightNode;
use lightbvh::{
    BuildParams, Bvh, CompactNode, Eq4, Heuristic, ImportanceModel, Lights, MomentNode, SampledLight,
};
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

/// A way to choose, with one level and two.
#[derive(Debug, Serialize)]
struct Way {
    name: &'static str,
    one: Found,
    two: Found,
}

#[derive(Debug, Serialize)]
struct Row {
    family: &'static str,
    lights: usize,
    ways: Vec<Way>,
}

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let is_wanted = |name: &str| args.family.is_empty() || args.family.iter().any(|own| own == name);
    let families = FAMILIES.into_iter().filter(|(name, _)| is_wanted(name));
    let rows = families.map(|family| {
        let scene = Scene::new(family, args.seed, args.points);
        Row {
            family: family.0,
            lights: scene.lights.all().len(),
            ways: ways(&scene),
        }
    });
    let rows: Vec<Row> = rows.collect();
    if context.json {
        table::print_json(&rows)?;
        return Ok(Outcome::Good);
    }
    table::print(&rows, COLUMNS)?;
    say!(
        "relative variance of one sample of diffuse light without shadows: mean (median) over points, one level; two levels; the default has \
         {} children a node",
        lightbvh_kernels::bvh::WIDTH
    )?;
    Ok(Outcome::Good)
}

/// The default, the same with 16 children, and the peers on the paper's tree.
fn ways(scene: &Scene) -> Vec<Way> {
    let lights = &scene.lights;
    let (own, paper) = (BuildParams::BALANCED, BuildParams::paper(Heuristic::Saoh));
    vec![
        way::<MomentNode<8>, DefaultImportance, 8>("default", scene, lights, &own),
        way::<MomentNode<16>, DefaultImportance, 16>("16 wide", scene, lights, &own),
        way::<CompactNode<4>, Eq4, 4>("eq4", scene, lights, &paper),
        way::<CompactNode<4>, Pbrt, 4>("pbrt", scene, lights, &paper),
        way::<CompactNode<4>, Falcor, 4>("falcor", scene, lights, &paper),
    ]
}

fn way<N: LightNode<W> + Sync, I: ImportanceModel<N, W> + Sync, const W: usize>(
    name: &'static str,
    scene: &Scene,
    lights: &Lights,
    params: &BuildParams,
) -> Way {
    let [one, two] = [false, true].map(|is_two| {
        let bvh: Bvh<(N, I), W> = match is_two {
            true => Bvh::two_level(lights, params),
            false => Bvh::single_level(lights, params),
        };
        let tree = bvh.tree();
        let all = variances(lights.all(), &scene.points, |point, light| {
            let mesh = lights.all()[light as usize].mesh;
            let instance = if is_two { mesh } else { SampledLight::INVALID };
            tree.pmf(&scene.points[point], light, instance)
        });
        let all: Vec<f64> = all.into_iter().flatten().collect();
        Found {
            mean: mean_of(&all),
            median: (!all.is_empty()).then(|| Interval::of(all).median),
        }
    });
    Way { name, one, two }
}

const COLUMNS: &[table::Column<Row>] = &[
    ("family", |row| row.family.to_owned()),
    ("lights", |row| row.lights.to_string()),
    ("default", |row| cell(&row.ways[0])),
    ("16 wide", |row| cell(&row.ways[1])),
    ("eq4", |row| cell(&row.ways[2])),
    ("pbrt", |row| cell(&row.ways[3])),
    ("falcor", |row| cell(&row.ways[4])),
];

fn cell(way: &Way) -> String {
    let of = |found: &Found| {
        let [mean, median] = [found.mean, found.median].map(|value| table::known(value, 2));
        format!("{mean} ({median})")
    };
    format!("{}; {}", of(&way.one), of(&way.two))
}
