//! The variance of samples for a glossy surface, by an importance that is told of the lobe and by the one that is not.
//!
//! Lights are taken as small patches, each with its solid angle: sums over all of them are exact but for the size of the
//! patches. One sample is a light with a point on it; with multiple importance sampling a direction that the surface reflects
//! into joins it, both weighted by the balance heuristic (E. Veach and L. Guibas, "Optimally Combining Sampling Techniques for
//! Monte Carlo Rendering", 1995).

use std::f64::consts::PI;
use std::hint::black_box;
use std::time::Instant;

use lightbvh::exact::hash;
use lightbvh::importance::{DefaultImportance, Glossy};
use lightbvh::{
    BuildParams, Bvh, Defensive, EmissiveTriangle, GlossyPoint, ImportanceModel, LightTree, MomentNode,
    Moments, Receiver, ShadingPoint,
};
use serde::Serialize;

use super::{Subject, mean_of};
use crate::backend::Sampler;
use crate::cli::table;
use crate::cli::times::ms;
use crate::cli::trade::quantile::Interval;
use crate::vector::{cross, dot, sub};
use crate::workload::{build, instance_of};

/// Exponents of the lobes, as powers of two.
const EXPONENTS: [i32; 5] = [4, 6, 8, 10, 13];
/// What surfaces reflect in either way.
const DIFFUSE: f32 = 0.5;
const SPECULAR: f32 = 0.5;
/// Turns of the times, and samples of each point in one.
const TURNS: u32 = 15;
const PASSES: u32 = 16;

type V = [f64; 3];
/// [`DefaultImportance`], told of the lobe.
type Told = Defensive<Glossy<Moments>, 6>;

/// A lobe in a scene, over points that face the camera.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Row {
    scene: String,
    exponent: f64,
    points: usize,
    /// Relative variance of one sample: by the default, which is told of no lobe.
    default: OverPoints,
    /// By `Glossy`.
    told: OverPoints,
    /// Share of the points with less variance by `Glossy`.
    less: Option<f64>,
    /// The same with a direction that the surface reflects into.
    default_mis: OverPoints,
    told_mis: OverPoints,
    less_mis: Option<f64>,
    /// Time of a sample by `Glossy` over that by the default, turn by turn; `None` without points.
    time: Option<Interval>,
}

/// Mean and median over the points, of which there is one at least.
#[derive(Clone, Copy, Debug, Serialize)]
struct OverPoints {
    mean: Option<f64>,
    median: Option<f64>,
}

/// A part of a light, seen from a point.
#[derive(Clone, Copy)]
struct Patch {
    light: u32,
    /// Its share of the light's area.
    share: f64,
    solid_angle: f64,
    direction: V,
    radiance: f64,
}

/// Measures `subject`, whose points the camera at `eye` sees, or somebody anywhere.
pub(super) fn measure(subject: &Subject, eye: Option<[f32; 3]>) -> Vec<Row> {
    let bvh: Bvh<MomentNode<8>, DefaultImportance, 8> =
        build(&subject.lights, Sampler::TwoLevel, &BuildParams::default());
    let receivers: Vec<GlossyPoint> = (0..)
        .zip(&subject.points)
        .filter_map(|(k, point)| facing(point, eye, k))
        .collect();
    let patches: Vec<Vec<Patch>> = receivers
        .iter()
        .map(|receiver| seen(subject.lights.triangles(), &receiver.point))
        .collect();
    let instances: Vec<u32> = (0..subject.lights.triangles().len() as u32)
        .map(|light| instance_of(&bvh, &subject.lights, light))
        .collect();
    let (plain, told) = (bvh.tree(), bvh.by::<Told>());
    let time = times(&plain, &told, &receivers);
    let row = |log2: i32| {
        let mut of = [const { Vec::new() }; 4];
        for (receiver, patches) in receivers.iter().zip(&patches) {
            let receiver = GlossyPoint {
                exponent: lightbvh::exact::pow2(log2),
                ..*receiver
            };
            let pmf = |light: u32| {
                [
                    plain.pmf(&receiver.point, light, instances[light as usize]),
                    told.pmf_for(&receiver, light, instances[light as usize]),
                ]
            };
            if let Some(found) = variances(&receiver, patches, pmf) {
                for (all, one) in of.iter_mut().zip(found) {
                    all.push(one);
                }
            }
        }
        let [default, told, default_mis, told_mis] = of;
        Row {
            scene: subject.name.clone(),
            exponent: f64::from(log2).exp2(),
            points: default.len(),
            less: less(&told, &default),
            less_mis: less(&told_mis, &default_mis),
            default: OverPoints::of(default),
            told: OverPoints::of(told),
            default_mis: OverPoints::of(default_mis),
            told_mis: OverPoints::of(told_mis),
            time,
        }
    };
    EXPONENTS.map(row).into()
}

impl Row {
    pub fn scene(&self) -> &str {
        &self.scene
    }

    /// Whether there was no point to measure at.
    pub fn is_empty(&self) -> bool {
        self.points == 0
    }
}

impl OverPoints {
    fn of(values: Vec<f64>) -> Self {
        Self {
            mean: mean_of(&values),
            median: (!values.is_empty()).then(|| Interval::of(values).median),
        }
    }

    fn text(&self) -> String {
        match self.mean {
            Some(_) => format!(
                "{} ({})",
                table::known(self.mean, 3),
                table::known(self.median, 3)
            ),
            None => table::known(None, 3),
        }
    }
}

fn less(a: &[f64], b: &[f64]) -> Option<f64> {
    let less = a.iter().zip(b).filter(|(a, b)| a < b).count();
    (!a.is_empty()).then(|| less as f64 / a.len() as f64)
}

/// The surface at `point`, if it faces the viewer.
fn facing(point: &ShadingPoint, eye: Option<[f32; 3]>, k: u32) -> Option<GlossyPoint> {
    let n = point.n.map(f64::from);
    let view = match eye {
        Some(eye) => sub(eye.map(f64::from), point.p.map(f64::from)),
        None => [0, 1, 2].map(|axis| f64::from(hash(3 * k + axis)) / f64::from(u32::MAX) - 0.5),
    };
    let view = unit(view)?;
    let cos = dot(n, view);
    let mirror = unit([0, 1, 2].map(|axis| 2.0 * cos * n[axis] - view[axis]))?;
    (cos > 0.0).then(|| GlossyPoint {
        point: *point,
        mirror: mirror.map(|x| x as f32),
        diffuse: DIFFUSE,
        specular: SPECULAR,
        exponent: 1.0,
    })
}

/// The lights before `point`, near ones in more patches.
fn seen(lights: &[EmissiveTriangle], point: &ShadingPoint) -> Vec<Patch> {
    let (p, n) = (point.p.map(f64::from), point.n.map(f64::from));
    let mut patches = Vec::new();
    for (light, triangle) in (0..).zip(lights) {
        // What is too thin to count as a light is chosen by no tree.
        if lightbvh::LightBounds::of_triangle(triangle).phi <= 0.0 {
            continue;
        }
        let corners = triangle.p.map(|v| sub(v.map(f64::from), p));
        let edges = [sub(corners[1], corners[0]), sub(corners[2], corners[0])];
        let normal = cross(edges[0], edges[1]);
        let size = dot(edges[0], edges[0]).max(dot(edges[1], edges[1])).sqrt();
        let nearest = corners
            .map(|v| dot(v, v))
            .into_iter()
            .fold(f64::INFINITY, f64::min)
            .sqrt();
        let parts = ((4.0 * size / nearest.max(0.1 * size)).ceil() as u32).clamp(1, 12);
        let share = 1.0 / f64::from(parts * parts);
        for centre in centroids(corners[0], edges, parts) {
            let d2 = dot(centre, centre);
            let Some(direction) = unit(centre) else { continue };
            let along = -dot(normal, direction);
            let emits = if triangle.is_two_sided() {
                along.abs()
            } else {
                along.max(0.0)
            };
            if emits > 0.0 && dot(n, direction) > 0.0 {
                patches.push(Patch {
                    light,
                    share,
                    solid_angle: 0.5 * emits * share / d2,
                    direction,
                    radiance: f64::from(triangle.luminance()),
                });
            }
        }
    }
    patches
}

/// Of the `parts`² triangles that a triangle falls into.
fn centroids(corner: V, edges: [V; 2], parts: u32) -> impl Iterator<Item = V> {
    let at = move |u: f64, v: f64| {
        let scale = 1.0 / f64::from(parts);
        [0, 1, 2].map(|k| corner[k] + scale * (u * edges[0][k] + v * edges[1][k]))
    };
    (0..parts).flat_map(move |i| {
        (0..parts - i).flat_map(move |j| {
            let (u, v) = (f64::from(i), f64::from(j));
            let third = 1.0 / 3.0;
            let upper = (i + j + 1 < parts).then(|| at(u + 2.0 * third, v + 2.0 * third));
            std::iter::once(at(u + third, v + third)).chain(upper)
        })
    })
}

/// Relative variances by both probabilities of each light, of one sample and with a direction; nothing in the dark.
fn variances(receiver: &GlossyPoint, patches: &[Patch], pmf: impl Fn(u32) -> [f32; 2]) -> Option<[f64; 4]> {
    let n = receiver.point.n.map(f64::from);
    let mirror = receiver.mirror.map(f64::from);
    let cos = dot(n, mirror);
    let view = [0, 1, 2].map(|k| 2.0 * cos * n[k] - mirror[k]);
    let [diffuse, specular, k] = [receiver.diffuse, receiver.specular, receiver.exponent].map(f64::from);
    let all = diffuse + specular;
    // What a patch sends to the viewer, and the probability that a direction meets it.
    let of = |patch: &Patch| {
        let cos = dot(n, patch.direction);
        let half = unit([0, 1, 2].map(|axis| patch.direction[axis] + view[axis])).unwrap_or(n);
        let power = dot(n, half).max(0.0).powf(k);
        let reflected = (diffuse + specular * (k + 6.0) / 8.0 * power) / PI;
        let by_half = (k + 1.0) / (2.0 * PI) * power / (4.0 * dot(view, half).max(1e-6));
        let density = (diffuse * cos / PI + specular * by_half) / all;
        (
            patch.radiance * patch.solid_angle * cos * reflected,
            density * patch.solid_angle,
        )
    };
    let both: Vec<(f64, f64)> = patches.iter().map(of).collect();
    let total: f64 = both.iter().map(|(sent, _)| sent).sum();
    if total <= 0.0 {
        return None;
    }
    // Patches wider than the lobe would be met more often than always.
    let met = both.iter().map(|(_, met)| met).sum::<f64>().max(1.0);
    let (mut squares, mut sums, mut known) = ([0.0; 4], [[0.0; 2]; 2], None);
    for (patch, (sent, direct)) in patches.iter().zip(both) {
        let pmfs = match known {
            Some((light, pmfs)) if light == patch.light => pmfs,
            _ => pmf(patch.light).map(f64::from),
        };
        known = Some((patch.light, pmfs));
        for (at, pmf) in pmfs.into_iter().enumerate() {
            let (picked, direct) = (pmf * patch.share, direct / met);
            squares[at] += sent * sent / picked;
            let weighted = sent / (picked + direct);
            squares[2 + at] += weighted * sent;
            sums[at][0] += picked * weighted;
            sums[at][1] += direct * weighted;
        }
    }
    let square = total * total;
    Some([
        squares[0] / square - 1.0,
        squares[1] / square - 1.0,
        (squares[2] - sums[0][0].powi(2) - sums[0][1].powi(2)) / square,
        (squares[3] - sums[1][0].powi(2) - sums[1][1].powi(2)) / square,
    ])
}

/// Time of a sample that is told, over one that is not.
fn times(
    plain: &LightTree<'_, MomentNode<8>, DefaultImportance, 8>,
    told: &LightTree<'_, MomentNode<8>, Told, 8>,
    receivers: &[GlossyPoint],
) -> Option<Interval> {
    let receivers: Vec<GlossyPoint> = receivers
        .iter()
        .map(|r| GlossyPoint {
            exponent: 256.0,
            ..*r
        })
        .collect();
    let mut found = [const { Vec::new() }; 2];
    for turn in 0..TURNS {
        found[0].push(time_of(
            plain,
            receivers.iter().map(|receiver| &receiver.point),
            turn,
        ));
        found[1].push(time_of(told, receivers.iter(), turn));
    }
    (!receivers.is_empty()).then(|| Interval::of_ratios(&found[1], &found[0]))
}

fn time_of<'a, I: ImportanceModel<MomentNode<8>, 8, P>, P: Receiver + 'a>(
    tree: &LightTree<'_, MomentNode<8>, I, 8>,
    receivers: impl Iterator<Item = &'a P> + Clone,
    turn: u32,
) -> f64 {
    let start = Instant::now();
    let mut sum = 0.0;
    for pass in 0..PASSES {
        for (k, receiver) in (0u32..).zip(receivers.clone()) {
            sum += tree
                .sample_for(receiver, hash(hash(turn * PASSES + pass).wrapping_add(k)))
                .pmf;
        }
    }
    black_box(sum);
    ms(start.elapsed())
}

fn unit(v: V) -> Option<V> {
    let length = dot(v, v).sqrt();
    (length > 0.0).then(|| v.map(|x| x / length))
}

/// A share in a cell.
fn percent(share: Option<f64>) -> String {
    match share {
        Some(share) => format!("{:.0} %", 100.0 * share),
        None => table::known(None, 0),
    }
}

pub(super) fn print(rows: &[Row]) -> std::io::Result<()> {
    let columns: [table::Column<Row>; 9] = [
        ("scene", |r| r.scene.clone()),
        ("exponent", |r| r.exponent.to_string()),
        ("default, mean (median)", |r| r.default.text()),
        ("told", |r| r.told.text()),
        ("less at", |r| percent(r.less)),
        ("default with MIS", |r| r.default_mis.text()),
        ("told with MIS", |r| r.told_mis.text()),
        ("less at", |r| percent(r.less_mis)),
        ("time", |r| match &r.time {
            Some(time) => format!("{:.2} [{:.2}, {:.2}]", time.median, time.low, time.high),
            None => table::known(None, 2),
        }),
    ];
    table::print(rows, &columns)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_a_triangle_have_its_centre_and_number() {
        for parts in 1..6 {
            let all: Vec<V> = centroids([1.0, 0.0, 0.0], [[3.0, 0.0, 0.0], [0.0, 6.0, 0.0]], parts).collect();
            assert_eq!(all.len() as u32, parts * parts);
            let centre = [0, 1].map(|axis| all.iter().map(|c| c[axis]).sum::<f64>() / all.len() as f64);
            assert!((centre[0] - 2.0).abs() < 1e-12 && (centre[1] - 2.0).abs() < 1e-12);
        }
    }

    #[test]
    fn what_is_not_measured_has_no_figure() {
        let none = OverPoints::of(Vec::new());
        assert_eq!(
            (none.mean, none.median, none.text()),
            (None, None, "-".to_owned())
        );
        assert_eq!((less(&[], &[]), percent(None)), (None, "-".to_owned()));
        assert_eq!(OverPoints::of(vec![1.0, 2.0, 6.0]).text(), "3.000 (2.000)");
        assert_eq!(percent(less(&[1.0, 2.0], &[2.0, 2.0])), "50 %");
    }

    /// A light that is chosen always, in one patch: no variance but what the direction adds, and the direction that meets half
    /// of what is sent leaves the balance heuristic a known one.
    #[test]
    fn variances_are_those_of_the_balance_heuristic() {
        let receiver = GlossyPoint {
            point: ShadingPoint {
                p: [0.0; 3],
                n: [0.0, 1.0, 0.0],
            },
            mirror: [0.0, 1.0, 0.0],
            diffuse: 1.0,
            specular: 0.0,
            exponent: 1.0,
        };
        let patch = |light, solid_angle| Patch {
            light,
            share: 1.0,
            solid_angle,
            direction: [0.0, 1.0, 0.0],
            radiance: 1.0,
        };
        // A direction meets it with a quarter.
        let one = [patch(0, 0.25 * PI)];
        let found = variances(&receiver, &one, |_| [1.0, 0.5]).expect("light");
        let mis = |p: f64, d: f64| {
            let weighted = 1.0 / (p + d);
            (p + d) * weighted * weighted - (p * weighted).powi(2) - (d * weighted).powi(2)
        };
        for (found, expected) in found.into_iter().zip([0.0, 1.0, mis(1.0, 0.25), mis(0.5, 0.25)]) {
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        }
        // Two alike, chosen alike: as one.
        let two = [patch(0, 0.1), patch(1, 0.1)];
        let found = variances(&receiver, &two, |light| [0.5, [0.25, 0.75][light as usize]]).expect("light");
        assert!(
            found[0].abs() < 1e-12 && (found[1] - (1.0 + 1.0 / 3.0 - 1.0)).abs() < 1e-12,
            "{found:?}"
        );
        assert!(variances(&receiver, &[], |_| [1.0; 2]).is_none());
    }
}
