//! `lightbvh bench --worst`: nodes evaluated and time of single samples and pmfs where they are hardest.

mod scenes;

use std::cell::Cell;
use std::hint::black_box;
use std::time::Instant;

use lightbvh::importance::Space;
use lightbvh::{BuildParams, INVALID, ImportanceModel, LightNode, LightTree, Random64, ShadingPoint};
use lightbvh_kernels::bvh::{Paper, TriangleModel, Triangles};
use serde::Serialize;
use serde_json::json;

use self::scenes::{Scene, scenes};
use super::super::{Context, Outcome, table};
use crate::backend::Bvh;
use crate::cli::measure::times::quantiles;
use crate::cli::table::say;
use crate::error::HostError;

/// Samples, and pmfs, of each scene.
const QUERIES: u32 = 20_000;

thread_local! {
    /// Nodes whose weights were computed.
    static EVALUATED: Cell<u32> = const { Cell::new(0) };
}

/// The importance `I`, counting the nodes that it is asked about.
struct Counting<I>(std::marker::PhantomData<I>);

impl<N, I: ImportanceModel<N, W>, const W: usize> ImportanceModel<N, W> for Counting<I> {
    const UNIFORM_HALVINGS: u32 = I::UNIFORM_HALVINGS;

    fn weights_in(node: &N, point: &ShadingPoint, _: Space) -> [f32; W] {
        EVALUATED.with(|count| count.set(count.get() + 1));
        I::weights(node, point)
    }
}

/// The distribution of one quantity over the queries of a scene.
#[derive(Clone, Debug, Serialize)]
struct Case {
    what: &'static str,
    importance: &'static str,
    scene: &'static str,
    lights: u32,
    depth: u32,
    unit: &'static str,
    median: f64,
    p99: f64,
    p999: f64,
    most: f64,
}

pub(super) fn run(context: &Context) -> Result<Outcome, HostError> {
    let mut cases = Vec::new();
    for scene in scenes() {
        cases.extend(measure::<Triangles, 8>(&scene));
        cases.extend(measure::<Paper, 4>(&scene));
    }
    let bounded = cases
        .iter()
        .all(|case| case.unit != "nodes" || case.most <= f64::from(case.depth));
    if context.json {
        table::print_json(&json!({ "queries": QUERIES, "bounded": bounded, "cases": cases }))?;
    } else {
        print(&cases)?;
        say!("")?;
        say!(
            "most nodes of any sample or pmf: {} the depth of the tree",
            if bounded { "at most" } else { "ABOVE" }
        )?;
    }
    Ok(Outcome::good_if(bounded))
}

fn measure<C: TriangleModel<W>, const W: usize>(scene: &Scene) -> Vec<Case> {
    let bvh = Bvh::<C, W>::single_level(&scene.lights, &BuildParams::default());
    let tree = bvh.tree();
    let lights = scene.lights.all().len() as u32;
    let mut cases = Vec::new();
    for what in ["sample", "pmf"] {
        let mut nodes = Vec::with_capacity(QUERIES as usize);
        let mut times = Vec::with_capacity(QUERIES as usize);
        for i in 0..QUERIES {
            let point = scene.point(i);
            let (random, light) = scene.random(i);
            EVALUATED.with(|count| count.set(0));
            ask(what, &tree.by::<Counting<C::Importance>>(), &point, random, light);
            nodes.push(f64::from(EVALUATED.with(Cell::get)));
            let start = Instant::now();
            ask(what, &tree, &point, random, light);
            times.push(start.elapsed().as_nanos() as f64);
        }
        for (unit, values) in [("nodes", nodes), ("ns", times)] {
            let [median, p99, p999, most] = quantiles(values, [0.5, 0.99, 0.999, 1.0]);
            cases.push(Case {
                what,
                importance: C::NAME,
                scene: scene.name,
                lights,
                depth: tree.depth,
                unit,
                median,
                p99,
                p999,
                most,
            });
        }
    }
    cases
}

fn ask<N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    what: &str,
    tree: &LightTree<'_, N, I, W>,
    point: &ShadingPoint,
    random: u32,
    light: u32,
) {
    if what == "sample" {
        black_box(tree.sample(point, Random64::from(random)));
    } else {
        black_box(tree.pmf(point, light, INVALID));
    }
}

fn print(cases: &[Case]) -> Result<(), HostError> {
    Ok(table::print(
        cases,
        &[
            ("scene", |c| c.scene.to_owned()),
            ("importance", |c| c.importance.to_owned()),
            ("what", |c| c.what.to_owned()),
            ("lights", |c| c.lights.to_string()),
            ("depth", |c| c.depth.to_string()),
            ("unit", |c| c.unit.to_owned()),
            ("median", |c| format!("{:.0}", c.median)),
            ("99 %", |c| format!("{:.0}", c.p99)),
            ("99.9 %", |c| format!("{:.0}", c.p999)),
            ("most", |c| format!("{:.0}", c.most)),
        ],
    )?)
}
