//! `lightbvh variance`: the exact relative variance of one light sample, scene by scene.
//!
//! At each point the unshadowed diffuse light of every light is computed, of triangles in closed form, and its probability is
//! asked of the tree: no sampling is involved, so the figure has no noise but that of the choice of points. Of several
//! candidates by numbers at equal distances the mean squared error is measured, by as many trials at each point.

mod gloss;
pub(super) mod irradiance;
pub(super) mod kinds;
pub(super) mod points;

use std::time::Instant;

use lightbvh::exact::hash;
use lightbvh::light::AnyLight;
use lightbvh::node::{Holds, Lit, Node};
use lightbvh::{
    BuildParams, Bvh, CompactNode, Cycles, Defensive, EmissiveTriangle, Eq4, Falcor, Flux, FluxOverDistance,
    FullMomentNode, Heuristic, ImportanceModel, LeanMomentNode, Lights, MomentNode, Moments, Pbrt,
    SampledLight, ShadingPoint, SphericalGaussian,
};
use lightbvh_kernels::bvh::AnyNode;
use serde::Serialize;
use serde_json::json;

use self::irradiance::irradiance;
use self::kinds::irradiance_of;
use super::{Context, Outcome, table};
use crate::backend::Sampler;
use crate::cli::table::news;
use crate::error::HostError;
use crate::metrics::mean;
use crate::scene::{Scene, SceneLight};
use crate::workload::{build, instance_of, lights_of};

/// Trials of several candidates at each point.
const TRIALS: u32 = 64;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Scenes: random, street, square, carousel, stage, or .gltf, .glb, .pbrt, .obj and .ply files; the first four if none is
    /// named.
    #[arg(long)]
    scene: Vec<String>,
    /// Points on the surfaces of each scene.
    #[arg(long, default_value_t = 400, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    points: u32,
    /// Lights of the scene `random`.
    #[arg(long, default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    lights: u32,
    /// Frame of the animation.
    #[arg(long, default_value_t = 0)]
    frame: u32,
    /// Every layout, width and importance, not only the default and the paper's.
    #[arg(long)]
    all: bool,
    /// Of glossy surfaces instead, seen from the camera: by the default, and by `Glossy`, which is told of the lobe, without
    /// and with a direction that the surface reflects into; and the time of a sample.
    #[arg(long, conflicts_with = "all")]
    gloss: bool,
}

/// The variance of samples by one structure, layout and importance, over the points of a scene.
#[derive(Clone, Debug, Serialize)]
struct Row {
    scene: String,
    structure: &'static str,
    layout: &'static str,
    importance: &'static str,
    width: usize,
    /// How many points any light of the tree reaches: all figures are over those, and there are none without one.
    points: usize,
    /// Mean over the points of variance / mean².
    mean: Option<f64>,
    median: Option<f64>,
    p95: Option<f64>,
    /// Mean over the points of the squared error of the mean of 8 candidates ([`LightTree::sample_many`]), over mean².
    ///
    /// [`LightTree::sample_many`]: lightbvh::LightTree::sample_many
    of_8: Option<f64>,
    /// Of 32.
    of_32: Option<f64>,
    /// Of up to 8 lights by adaptive splitting ([`LightTree::sample_split`]).
    ///
    /// [`LightTree::sample_split`]: lightbvh::LightTree::sample_split
    split_8: Option<f64>,
    /// Of up to 32.
    split_32: Option<f64>,
    /// Share of samples that contribute nothing: no light, or one that sends nothing to the point.
    nothing: Option<f64>,
}

/// A scene's lights, and the points that they are chosen for.
struct Subject<L = EmissiveTriangle> {
    name: String,
    lights: Lights<L>,
    points: Vec<ShadingPoint>,
}

impl Subject {
    fn random(args: &Args) -> Self {
        let (lights, points) = points::random(args.lights, args.points);
        let name = RANDOM.to_owned();
        Self { name, lights, points }
    }
}

impl<L: SceneLight> Subject<L> {
    fn of(scene: &Scene, args: &Args) -> Result<Self, HostError> {
        Ok(Self {
            name: scene.name().to_owned(),
            lights: lights_of(scene, args.frame)?,
            points: points::on_surfaces(scene, args.frame, args.points),
        })
    }
}

/// Where no figure is known.
pub(super) const NOT_MEASURED: &str =
    "no point receives light of a light that a tree would hold, and nothing is measured";

/// The scene that is no scene: lights anywhere.
const RANDOM: &str = "random";

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let named: Vec<String> = if args.scene.is_empty() {
        [RANDOM, "street", "square", "carousel"].map(String::from).into()
    } else {
        args.scene.clone()
    };
    if args.gloss {
        return glossy(context, args, &named);
    }
    let mut rows = Vec::new();
    for name in named {
        let start = Instant::now();
        let own = match opened(&name)? {
            None => measure(&Subject::random(args), args.all),
            Some(scene) if scene.needs_any_light() => measure_kinds(&Subject::of(&scene, args)?, args.all),
            Some(scene) => measure(&Subject::of(&scene, args)?, args.all),
        };
        if own.iter().all(|row| row.points == 0) {
            news!("{name}: {NOT_MEASURED}");
        }
        rows.extend(own);
        news!("{name}: {:.1} s", start.elapsed().as_secs_f64());
    }
    if context.json {
        table::print_json(&json!({ "points": args.points, "frame": args.frame, "rows": rows }))?;
    } else {
        print(&rows)?;
    }
    Ok(Outcome::Good)
}

/// A scene, but for the one that is none.
fn opened(name: &str) -> Result<Option<Scene>, HostError> {
    if name == RANDOM {
        return Ok(None);
    }
    let scene = Scene::open(name)?;
    for warning in scene.warnings() {
        news!("{name}: {warning}");
    }
    Ok(Some(scene))
}

fn glossy(context: &Context, args: &Args, named: &[String]) -> Result<Outcome, HostError> {
    let mut rows = Vec::new();
    for name in named {
        let start = Instant::now();
        let (subject, eye) = match opened(name)? {
            None => (Subject::random(args), None),
            Some(scene) => {
                scene.require_lights()?;
                if let Some(left_out) = scene.unknown_lights() {
                    news!("{name}: {left_out}");
                }
                let eye = points::eye(&scene, args.frame);
                (Subject::of(&scene, args)?, Some(eye))
            }
        };
        let own = gloss::measure(&subject, eye);
        if own.iter().all(gloss::Row::is_empty) {
            news!("{name}: {NOT_MEASURED}");
        }
        rows.extend(own);
        news!(
            "{}: {:.1} s",
            rows.last().map_or("", gloss::Row::scene),
            start.elapsed().as_secs_f64()
        );
    }
    if context.json {
        table::print_json(&json!({ "points": args.points, "frame": args.frame, "gloss": rows }))?;
    } else {
        gloss::print(&rows)?;
    }
    Ok(Outcome::Good)
}

/// The default importance of the crate: moments with a share of 1/64 of uniform choice.
type DefaultImportance = Defensive<Moments, 6>;

fn measure(subject: &Subject, all: bool) -> Vec<Row> {
    let balanced = BuildParams::default();
    let saoh = BuildParams {
        heuristic: Heuristic::Saoh,
        ..balanced
    };
    let light = sent(subject, irradiance);
    let of = Measured {
        subject,
        light: &light,
    };
    let mut rows = Vec::new();
    rows.extend(of.both::<CompactNode<4>, Eq4, 4>("eq4", &saoh));
    rows.extend(of.both::<MomentNode<8>, DefaultImportance, 8>("moments+1/64", &balanced));
    if all {
        let (fast, best) = (BuildParams::FAST, BuildParams::BEST);
        rows.extend(of.both::<MomentNode<8>, Moments, 8>("moments", &balanced));
        rows.extend(of.both::<MomentNode<16>, DefaultImportance, 16>("moments+1/64", &balanced));
        rows.extend(of.both::<MomentNode<16>, Moments, 16>("moments", &balanced));
        rows.extend(of.both::<MomentNode<4>, Moments, 4>("moments", &balanced));
        rows.extend(of.both::<FullMomentNode<8>, Moments, 8>("moments", &balanced));
        rows.extend(of.both::<LeanMomentNode<8>, Moments, 8>("moments", &balanced));
        rows.extend(of.both::<MomentNode<8>, DefaultImportance, 8>("moments+1/64, fast", &fast));
        rows.extend(of.both::<MomentNode<8>, DefaultImportance, 8>("moments+1/64, best", &best));
        rows.extend(of.both::<CompactNode<8>, Eq4, 8>("eq4", &saoh));
        rows.extend(of.both::<CompactNode<4>, Eq4, 4>("eq4, ward", &balanced));
        rows.extend(of.both::<CompactNode<4>, FluxOverDistance, 4>("flux/d²", &saoh));
        rows.extend(of.both::<MomentNode<8>, FluxOverDistance, 8>("flux/d²", &balanced));
        rows.extend(of.both::<MomentNode<8>, Flux, 8>("flux", &balanced));
        rows.extend(of.both::<CompactNode<4>, Pbrt, 4>("pbrt", &saoh));
        rows.extend(of.both::<CompactNode<4>, Falcor, 4>("falcor", &saoh));
        rows.extend(of.both::<CompactNode<4>, Cycles, 4>("cycles", &saoh));
        rows.extend(of.both::<MomentNode<8>, SphericalGaussian, 8>("gaussian", &balanced));
    }
    rows
}

/// Of a scene with lights of any kind, which those layouts hold that trees without such lights are compared by.
fn measure_kinds(subject: &Subject<AnyLight>, all: bool) -> Vec<Row> {
    type Plain = Lit<MomentNode<8>, AnyLight>;
    let light = sent(subject, irradiance_of);
    let of = Measured {
        subject,
        light: &light,
    };
    let balanced = BuildParams::default();
    let mut rows = Vec::new();
    rows.extend(of.both::<Plain, DefaultImportance, 8>("moments+1/64", &balanced));
    rows.extend(of.both::<AnyNode, DefaultImportance, 8>("moments+1/64", &balanced));
    if all {
        rows.extend(of.both::<Plain, Moments, 8>("moments", &balanced));
        rows.extend(of.both::<AnyNode, Moments, 8>("moments", &balanced));
    }
    rows
}

/// By point, what each light sends there.
fn sent<L: SceneLight>(subject: &Subject<L>, of: impl Fn(&L, &ShadingPoint) -> f64) -> Vec<Vec<f64>> {
    let lights = subject.lights.triangles();
    let points = subject.points.iter();
    points
        .map(|point| lights.iter().map(|light| of(light, point)).collect())
        .collect()
}

/// A scene, and by point what each light sends there.
struct Measured<'a, L> {
    subject: &'a Subject<L>,
    light: &'a [Vec<f64>],
}

impl<L: SceneLight> Measured<'_, L> {
    /// One level and two.
    fn both<N: Node<W> + Holds<Light = L>, I: ImportanceModel<N, W>, const W: usize>(
        &self,
        importance: &'static str,
        params: &BuildParams,
    ) -> [Row; 2] {
        let lights = &self.subject.lights;
        [Sampler::SingleLevel, Sampler::TwoLevel].map(|structure| {
            let bvh = build::<N, I, W>(lights, structure, params);
            let (variances, nothing) = variances(&bvh, self.subject, self.light);
            let part = |share: f64| {
                let at = share * (variances.len().max(1) - 1) as f64;
                variances.get(at as usize).copied()
            };
            Row {
                scene: self.subject.name.clone(),
                structure: structure.name(),
                layout: N::NAME,
                importance,
                width: W,
                points: variances.len(),
                mean: mean_of(&variances),
                median: part(0.5),
                p95: part(0.95),
                of_8: self.error(|point, number| spaced::<N, I, W, 8>(&bvh, point, number)),
                of_32: self.error(|point, number| spaced::<N, I, W, 32>(&bvh, point, number)),
                split_8: self.error(|point, number| split::<N, I, W, 8>(&bvh, point, number)),
                split_32: self.error(|point, number| split::<N, I, W, 32>(&bvh, point, number)),
                nothing,
            }
        })
    }

    /// The squared error of an estimate relative to the squared mean, over trials and points that any light reaches; `None`
    /// where none does.
    fn error(&self, estimate: impl Fn(&ShadingPoint, u32) -> Weighted) -> Option<f64> {
        let (mut error, mut points) = (0.0, 0_u32);
        for (number, (point, light)) in (0u32..).zip(self.subject.points.iter().zip(self.light)) {
            let mean: f64 = light.iter().sum();
            if mean > 0.0 {
                points += 1;
                for trial in 0..TRIALS {
                    let lights = estimate(point, hash(number * TRIALS + trial));
                    let sent =
                        |&(i, weight): &(u32, f64)| light.get(i as usize).copied().unwrap_or(0.0) * weight;
                    error += (lights.iter().map(sent).sum::<f64>() / mean - 1.0).powi(2);
                }
            }
        }
        (points > 0).then(|| error / (f64::from(TRIALS) * f64::from(points)))
    }
}

/// The mean of what there is.
pub(super) fn mean_of(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| mean(values))
}

/// The relative variance at each point that any light reaches, sorted, and the mean share of samples that contribute nothing;
/// `None` where no light reaches any.
fn variances<N: Node<W> + Holds<Light: SceneLight>, I: ImportanceModel<N, W>, const W: usize>(
    bvh: &Bvh<N, I, W>,
    subject: &Subject<<N as Holds>::Light>,
    light: &[Vec<f64>],
) -> (Vec<f64>, Option<f64>) {
    let (mut variances, mut nothing) = (Vec::new(), Vec::new());
    for (point, light) in subject.points.iter().zip(light) {
        let (mut mean, mut square, mut useful) = (0.0, 0.0, 0.0);
        for (i, &sent) in (0..).zip(light) {
            if sent > 0.0 {
                let pmf = f64::from(bvh.pmf(point, i, instance_of(bvh, &subject.lights, i)));
                mean += sent;
                square += sent * sent / pmf;
                useful += pmf;
            }
        }
        if mean > 0.0 {
            // Below zero by rounding only, where one light counts.
            variances.push((square / (mean * mean) - 1.0).max(0.0));
            nothing.push(1.0 - useful);
        }
    }
    variances.sort_by(f64::total_cmp);
    (variances, mean_of(&nothing))
}

/// Lights with the weights of their contributions to an estimate.
type Weighted = Vec<(u32, f64)>;

/// `COUNT` candidates by numbers at equal distances: their mean is the estimate.
fn spaced<N: Node<W>, I: ImportanceModel<N, W>, const W: usize, const COUNT: usize>(
    bvh: &Bvh<N, I, W>,
    point: &ShadingPoint,
    number: u32,
) -> Weighted {
    weighted(&bvh.sample_many::<COUNT>(point, number), COUNT as f64)
}

/// Up to `MOST` lights, one out of each subtree: their sum is the estimate.
fn split<N: Node<W>, I: ImportanceModel<N, W>, const W: usize, const MOST: usize>(
    bvh: &Bvh<N, I, W>,
    point: &ShadingPoint,
    number: u32,
) -> Weighted {
    let (lights, count) = bvh.tree().sample_split::<MOST>(point, number);
    weighted(&lights[..count], 1.0)
}

fn weighted(lights: &[SampledLight], count: f64) -> Weighted {
    let there = lights.iter().filter(|found| found.pmf > 0.0);
    there
        .map(|found| (found.light, 1.0 / (count * f64::from(found.pmf))))
        .collect()
}

/// What several lights leave of one light's variance; nothing where there is none.
fn gain(row: &Row, error: Option<f64>) -> String {
    match (row.mean, error) {
        // Beyond that it is rounding that is left.
        (Some(mean), Some(error)) if mean / error > 0.0 && mean / error < 1e9 => {
            format!("1/{:.1}", mean / error)
        }
        _ => "-".to_owned(),
    }
}

fn print(rows: &[Row]) -> Result<(), HostError> {
    Ok(table::print(
        rows,
        &[
            ("scene", |r| r.scene.clone()),
            ("structure", |r| r.structure.to_owned()),
            ("layout", |r| r.layout.to_owned()),
            ("importance", |r| r.importance.to_owned()),
            ("width", |r| r.width.to_string()),
            ("mean", |r| table::known(r.mean, 3)),
            ("median", |r| table::known(r.median, 3)),
            ("p95", |r| table::known(r.p95, 3)),
            ("of 8", |r| gain(r, r.of_8)),
            ("of 32", |r| gain(r, r.of_32)),
            ("split 8", |r| gain(r, r.split_8)),
            ("split 32", |r| gain(r, r.split_32)),
            ("nothing", |r| match r.nothing {
                Some(nothing) => format!("{:.1} %", (100.0 * nothing).max(0.0)),
                None => table::known(None, 1),
            }),
        ],
    )?)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A floor that faces +z below a lamp, and a light. The lamp shines down on the floor, or up, where nothing is.
    pub fn room(is_lit: bool, light: &str) -> Scene {
        let turned = if is_lit { "ReverseOrientation" } else { "" };
        let text = format!(
            "Scale -1 1 1\nCamera \"perspective\"\nWorldBegin\n{light}\n\
             Shape \"trianglemesh\" \"point3 P\" [-4 -4 0 4 -4 0 0 4 0]\n\
             {turned} AreaLightSource \"diffuse\"\nShape \"trianglemesh\" \"point3 P\" [0 0 1 1 0 1 0 1 1]\n"
        );
        Scene::read_pbrt_slice("room.pbrt", text.as_bytes(), None).expect("valid")
    }

    fn args() -> Args {
        Args {
            scene: Vec::new(),
            points: 32,
            lights: 1,
            frame: 0,
            all: false,
            gloss: false,
        }
    }

    fn rows(is_lit: bool) -> Vec<Row> {
        let triangles = room(is_lit, "");
        // From below the floor, on its back.
        let kinds = room(is_lit, "LightSource \"point\" \"point3 from\" [0.2 0.2 -1]");
        assert!(kinds.needs_any_light());
        let mut rows = measure(&Subject::of(&triangles, &args()).expect("lights"), false);
        rows.extend(measure_kinds(
            &Subject::of(&kinds, &args()).expect("lights"),
            false,
        ));
        rows
    }

    /// Four rows of 0.000 and "nothing 0.0 %", as if all were perfect.
    #[test]
    fn what_is_not_measured_has_no_figure() {
        const FIGURES: [&str; 8] = [
            "mean", "median", "p95", "of_8", "of_32", "split_8", "split_32", "nothing",
        ];
        for row in rows(false) {
            let report = json!(row);
            assert_eq!(row.points, 0);
            for figure in FIGURES {
                assert!(report[figure].is_null(), "{figure}: {report}");
            }
            assert_eq!(
                (gain(&row, row.of_8), table::known(row.mean, 3)),
                ("-".into(), "-".into())
            );
        }
        for row in rows(true) {
            let report = json!(row);
            assert!(row.points > 0);
            for figure in FIGURES {
                assert!(report[figure].is_number(), "{figure}: {report}");
            }
        }
    }
}
