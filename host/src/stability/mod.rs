//! `lightbvh stability`: the extremes that the light BVH must survive, each with its worst error against a stated bound.
//!
//! [`cases`] makes the extremes; [`checks`] looks at one tree over one of them on the CPU, by oracles in f64 that share no
//! arithmetic with what they check; [`invariance`] compares a scene with itself scaled, turned and moved; [`words`] compares
//! devices with the CPU. What a row means stands in [`row`].

pub mod case;
pub mod cases;
pub mod checks;
pub mod geometry;
pub mod invariance;
pub mod random;
pub mod row;
pub mod statistics;
pub mod subject;
pub mod words;

use lightbvh::{BoundsNode, Bvh, CompactNode, EmissiveTriangle, Eq4, ImportanceModel, LightNode, Lights};
use lightbvh_kernels::bvh::{Choice, Node, Standard, WIDTH};
use serde::Serialize;

use self::case::{Case, Source, moving_scene, validated};
use self::row::{Check, Row};
use self::subject::{Subject, Walked};
use crate::backend::{self, Sampler};
use crate::error::HostError;
use crate::vulkan::{Device, VulkanError};
use crate::workload;

/// Importance of the default choice.
pub type Importance = <Standard as Choice<WIDTH>>::Importance;

/// How much is done.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Samples per point on the CPU.
    pub samples: u32,
    /// Lights of the largest scene.
    pub most_lights: u32,
    /// Lights of the scene of equal lights.
    pub equal_lights: u32,
}

impl Effort {
    /// Some minutes.
    pub const FULL: Self = Self {
        samples: 20_000,
        most_lights: 10_000_000,
        equal_lights: 1 << 22,
    };
    /// Less than a minute.
    pub const QUICK: Self = Self {
        samples: 2_000,
        most_lights: 1_000_000,
        equal_lights: 1 << 18,
    };
}

/// Rows, and comparisons that were skipped.
#[derive(Debug, Default)]
pub struct Found {
    /// The rows.
    pub rows: Vec<Row>,
    /// Extremes that are larger than a device's buffers may be.
    pub skipped: Vec<Skipped>,
}

/// An extreme that a device has no room for.
#[derive(Debug, Serialize)]
pub struct Skipped {
    /// Extreme and structure.
    pub name: String,
    /// The device.
    pub device: String,
    /// The reason.
    pub why: &'static str,
}

/// Runs one extreme: on the CPU, and on each device.
pub fn run(case: &Case, effort: &Effort, devices: &[&Device], found: &mut Found) -> Result<(), HostError> {
    match &case.source {
        Source::World(triangles) => world(case, triangles, effort, devices, found),
        Source::Moving { meshes, instances } => {
            let (scene, lights) = moving_scene(&case.name, meshes, instances, &case.params)?;
            let case = Case {
                name: case.name.clone(),
                source: Source::World(Vec::new()),
                points: [
                    &case.points[..],
                    &case::around(lights.triangles(), 24, &mut random::Random::new(5)),
                ]
                .concat(),
                ..*case
            };
            let tree = Walked::new(scene.tree(), lights.triangles());
            found.rows.extend(checks::check(
                &case.name,
                "instances",
                &tree,
                &case.points,
                effort.samples,
            ));
            on_devices(&case, "instances", &scene, &lights, devices, found)
        }
    }
}

fn world(
    case: &Case,
    triangles: &[EmissiveTriangle],
    effort: &Effort,
    devices: &[&Device],
    found: &mut Found,
) -> Result<(), HostError> {
    let lights = validated(&case.name, triangles.to_vec())?;
    // Few points do for very many lights: each asks for all their probabilities.
    let samples = if case.large {
        50 * effort.samples
    } else {
        effort.samples
    };
    for sampler in [Sampler::SingleLevel, Sampler::TwoLevel] {
        let bvh = workload::build::<Node, Importance, WIDTH>(&lights, sampler, &case.params);
        let tree = walked(&bvh, &lights);
        found.rows.extend(checks::check(
            &case.name,
            sampler.name(),
            &tree,
            &case.points,
            samples,
        ));
        on_devices(case, sampler.name(), &bvh, &lights, devices, found)?;
    }
    if !case.large {
        narrow::<CompactNode<2>>(case, &lights, samples, found);
    }
    Ok(())
}

/// Trees of two-wide nodes, the deepest there are, by the paper's importance: on the CPU alone, since no kernels are compiled
/// for them.
fn narrow<N: BoundsNode<2> + LightNode<2>>(case: &Case, lights: &Lights, samples: u32, found: &mut Found) {
    let bvh = Bvh::<N, Eq4, 2>::two_level(lights, &case.params);
    let structure = format!("two-level {} 2-wide", N::NAME);
    let tree = walked(&bvh, lights);
    if case.least_depth > 0 {
        let missing = f64::from(case.least_depth.saturating_sub(tree.depth()));
        found
            .rows
            .push(Row::new(&case.name, &structure, Check::Depth, missing, 0.0));
    }
    found.rows.extend(checks::check(
        &case.name,
        &structure,
        &tree,
        &case.points,
        samples,
    ));
}

/// A tree over triangles in the world, walked by importance `I`.
pub fn walked<'a, N: LightNode<W>, I: ImportanceModel<N, W>, const W: usize>(
    bvh: &'a Bvh<N, I, W>,
    lights: &'a Lights,
) -> Walked<'a, N, I, W> {
    Walked::new(bvh.tree(), lights.triangles())
}

fn on_devices(
    case: &Case,
    structure: &str,
    bvh: &backend::Bvh,
    lights: &Lights,
    devices: &[&Device],
    found: &mut Found,
) -> Result<(), HostError> {
    for device in devices {
        match words::compare(&case.name, structure, bvh, lights, &case.points, device) {
            Err(HostError::Vulkan(VulkanError::BufferTooLarge { .. })) => found.skipped.push(Skipped {
                name: format!("{}, {structure}", case.name),
                device: device.name().to_owned(),
                why: "larger than a buffer of the device may be",
            }),
            rows => found.rows.extend(rows?),
        }
    }
    Ok(())
}
