//! What a frame of moving lights costs on a device: the host's time, and what it hands over.

use std::io;
use std::time::Instant;

use lightbvh::exact::{hash, unit_f32};
use lightbvh::{Edit, EmissiveTriangle, InstanceId, Transform};
use serde::Serialize;

use super::passes::WARM;
use crate::backend::{Bvh, DeviceBackend};
use crate::cli::devices::Opened;
use crate::cli::table::{self, Column, news};
use crate::error::HostError;
use crate::vulkan::Counts;

/// Frames that count. Those before them, for [`WARM`], do not.
const FRAMES: usize = 40;
/// Instances that move in a frame, those that there are at most.
const MOVED: [u32; 3] = [1, 100, 5_000];
/// Different meshes, and triangles of each.
const MESHES: u32 = 16;
const TRIANGLES: u32 = 2;
/// Side of the box that instances lie in, metres.
const SIDE: f32 = 100.0;

/// A quantity of a kind of frame.
#[derive(Clone, Debug, Serialize)]
pub(in crate::cli::bench) struct DeviceRow {
    /// `device-move-COUNT`: so many instances, scattered over all, move in each frame.
    pub what: String,
    /// Name of the device.
    pub device: String,
    pub instances: u32,
    /// In all instances together.
    pub triangles: u64,
    /// `ns` until the frame is handed over, `ns-done` until the device has done it, `bytes` written for it, `regions` copied,
    /// `runs` put in their places by dispatches, `submissions`, `waits`.
    pub unit: &'static str,
    pub median: f64,
    pub p99: f64,
    pub most: f64,
}

/// A frame, measured.
#[derive(Clone, Copy)]
struct Sample {
    handed: f64,
    done: f64,
    counts: Counts,
}

/// A unit, and how much of it a frame took.
type Quantity = (&'static str, fn(&Sample) -> f64);

/// Measures frames of `instances` lamps on each device.
///
/// # Errors
/// [`HostError`] from a device.
pub(in crate::cli::bench) fn rows(opened: &[Opened], instances: u32) -> Result<Vec<DeviceRow>, HostError> {
    let mut rows = Vec::new();
    for o in opened {
        for moved in MOVED.into_iter().filter(|moved| *moved <= instances) {
            news!("move {moved} of {instances} on {}", o.device.name());
            rows.extend(moving(o, instances, moved)?);
        }
    }
    Ok(rows)
}

/// Prints rows as a table.
pub(super) fn print(rows: &[DeviceRow]) -> io::Result<()> {
    let columns: [Column<DeviceRow>; 7] = [
        ("frame", |row| row.what.clone()),
        ("device", |row| row.device.clone()),
        ("instances", |row| row.instances.to_string()),
        ("unit", |row| row.unit.to_owned()),
        ("median", |row| format!("{:.0}", row.median)),
        ("p99", |row| format!("{:.0}", row.p99)),
        ("most", |row| format!("{:.0}", row.most)),
    ];
    table::print(rows, &columns)
}

/// Frames in which `moved` of `instances` move.
fn moving(opened: &Opened, instances: u32, moved: u32) -> Result<Vec<DeviceRow>, HostError> {
    let (mut bvh, ids) = lamps(instances);
    let mut backend: DeviceBackend<'_> = DeviceBackend::new(&opened.device, &bvh)?;
    let mut samples = Vec::new();
    let begin = Instant::now();
    let mut frame = 0;
    while samples.len() < FRAMES {
        frame += 1;
        bvh.apply(moves(&ids, moved, frame))
            .expect("edits within the domain");
        bvh.plan();
        let before = opened.device.counts();
        let start = Instant::now();
        backend.follow_ahead(&bvh)?;
        let submitted = backend.flush()?;
        let handed = start.elapsed().as_nanos() as f64;
        let counts = opened.device.counts() - before;
        if let Some(submitted) = submitted {
            submitted.wait()?;
        }
        let done = start.elapsed().as_nanos() as f64;
        bvh.refit();
        if begin.elapsed() >= WARM {
            samples.push(Sample { handed, done, counts });
        }
    }
    let row = |(unit, quantity): Quantity| {
        let mut values: Vec<f64> = samples.iter().map(quantity).collect();
        values.sort_by(f64::total_cmp);
        let at = |share: f64| values[((values.len() - 1) as f64 * share).ceil() as usize];
        DeviceRow {
            what: format!("device-move-{moved}"),
            device: opened.device.name().to_owned(),
            instances,
            triangles: u64::from(instances) * u64::from(TRIANGLES),
            unit,
            median: at(0.5),
            p99: at(0.99),
            most: at(1.0),
        }
    };
    let units: [Quantity; 7] = [
        ("ns", |it| it.handed),
        ("ns-done", |it| it.done),
        ("bytes", |it| it.counts.bytes as f64),
        ("regions", |it| it.counts.regions as f64),
        ("runs", |it| it.counts.runs as f64),
        ("submissions", |it| it.counts.submissions as f64),
        ("waits", |it| it.counts.waits as f64),
    ];
    Ok(units.into_iter().map(row).collect())
}

/// Lamps of two triangles anywhere in a box.
fn lamps(count: u32) -> (Bvh, Vec<InstanceId>) {
    let within = "the scene is made within the domain";
    let mut bvh: Bvh = lightbvh::Bvh::default();
    let meshes = (0..MESHES).map(|mesh| {
        let size = 0.1 + 0.02 * mesh as f32;
        let triangle = |flip: f32| EmissiveTriangle {
            p: [[0.0, 0.0, 0.0], [flip * size, 0.0, 0.0], [0.0, 0.0, flip * size]],
            radiance: [1.0 + mesh as f32; 3],
            mesh: 0,
            flags: 0,
        };
        let triangles = vec![triangle(1.0), triangle(-1.0)];
        Edit::AddMesh { triangles }
    });
    let meshes = bvh.apply(meshes.collect()).expect(within).meshes;
    let add = (0..count).map(|i| Edit::AddInstance {
        mesh: meshes[(i % MESHES) as usize],
        transform: place(i, 0),
        radiance: 1.0,
    });
    let ids = bvh.apply(add.collect()).expect(within).instances;
    bvh.refit();
    (bvh, ids)
}

/// `moved` of the lamps, scattered over all, take a step.
fn moves(ids: &[InstanceId], moved: u32, frame: u32) -> Vec<Edit> {
    let stride = (ids.len() as u32 / moved.max(1)).max(1);
    (0..moved)
        .map(|k| {
            // Another one of each stretch in each frame: no two are neighbours for long.
            let i = (k * stride + hash(k ^ hash(frame)) % stride).min(ids.len() as u32 - 1);
            Edit::SetTransform {
                instance: ids[i as usize],
                transform: place(i, frame + 1),
            }
        })
        .collect()
}

/// Where a lamp stands in a frame.
fn place(instance: u32, frame: u32) -> Transform {
    let draw = |k: u32| unit_f32(hash(hash(instance).wrapping_add(k)));
    let step = 0.05 * (frame % 64) as f32;
    Transform::at(std::array::from_fn(|k| SIDE * draw(k as u32) + step))
}
