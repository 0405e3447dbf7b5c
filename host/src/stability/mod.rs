//! `lightbvh stability`: the extremes that the light BVH must survive, each with its worst error against a stated bound.
//!
//! [`cases`] makes the extremes; [`checks`] looks at one tree over one of them on the CPU; [`invariance`] compares a scene with
//! itself scaled, turned and moved; [`words`] compares devices with the CPU. What a row means stands in [`row`].

pub mod case;
pub mod cases;
pub mod checks;
pub mod invariance;
pub mod random;
pub mod row;
pub mod words;

use lightbvh::{Lights, ShadingPoint};
use serde::Serialize;

use self::case::{Case, Source, moving_scene, validated};
use self::row::Row;
use crate::backend::{Bvh, Sampler};
use crate::error::HostError;
use crate::vulkan::{Device, VulkanError};
use crate::workload;

/// How much is done.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Samples per point on the CPU.
    pub samples: u32,
    /// Lights of the largest scene.
    pub most_lights: u32,
}

impl Effort {
    /// Some minutes.
    pub const FULL: Self = Self {
        samples: 20_000,
        most_lights: 10_000_000,
    };
    /// Less than a minute.
    pub const QUICK: Self = Self {
        samples: 2_000,
        most_lights: 1_000_000,
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
    let samples = effort.samples;
    let triangles = match &case.source {
        Source::World(triangles) => triangles,
        Source::Moving { meshes, instances } => {
            let (bvh, lights) = moving_scene(&case.name, meshes, instances, &case.params)?;
            let points = case::around(lights.all(), 24, &mut random::Random::new(5));
            let points = [&case.points[..], &points].concat();
            let tree = (&bvh, &lights, "instances");
            return check(&case.name, tree, (&points, samples), devices, found);
        }
    };
    let lights = validated(&case.name, triangles.to_vec())?;
    let points = (&case.points[..], samples);
    for sampler in [Sampler::SingleLevel, Sampler::TwoLevel] {
        let bvh = workload::build(&lights, sampler, &case.params);
        check(
            &case.name,
            (&bvh, &lights, sampler.name()),
            points,
            devices,
            found,
        )?;
    }
    Ok(())
}

/// A tree of this structure on the CPU, and on each device.
fn check(
    name: &str,
    (bvh, lights, structure): (&Bvh, &Lights, &str),
    (points, samples): (&[ShadingPoint], u32),
    devices: &[&Device],
    found: &mut Found,
) -> Result<(), HostError> {
    let rows = checks::check(name, structure, (bvh, lights), points, samples);
    found.rows.extend(rows);
    for device in devices {
        match words::compare(name, structure, bvh, lights, points, device) {
            Err(HostError::Vulkan(VulkanError::BufferTooLarge { .. })) => found.skipped.push(Skipped {
                name: format!("{name}, {structure}"),
                device: device.name().to_owned(),
                why: "larger than a buffer of the device may be",
            }),
            rows => found.rows.extend(rows?),
        }
    }
    Ok(())
}
