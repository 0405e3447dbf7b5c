//! `lightbvh verify --soak`: frames of random edits, with rebuilds in the background and followed by devices.

use std::collections::BTreeMap;

use lightbvh::bvh::{InstanceId, MeshId, Swap};
use lightbvh::{Edit, EmissiveTriangle, Rebuilder, RebuilderParams, Transform};
use serde::Serialize;

use super::{Args, DeviceReport};
use crate::backend::{Bvh, CpuBackend, DeviceBackend, Follow};
use crate::cli::devices::Opened;
use crate::cli::measure::times::{Spread, thread_us};
use crate::cli::table::{self, news, say};
use crate::error::HostError;
use crate::metrics::mean;
use crate::stability::case::around;
use crate::stability::random::Random;
use crate::stability::words::compare_bvh;
use crate::tally::{Side, Tallies, Tally};

/// Frames from one check of all invariants and words to the next.
const CHECKED: u32 = 1_000;
/// Points that samples and probabilities are compared at.
const POINTS: u32 = 64;
/// Frames in a row in which trees are swapped in by one rule.
const RULED: u32 = 500;
/// Frames that a build has by the deterministic rule.
const AFTER: u32 = 3;
/// Meshes at a time.
const MESHES: usize = 40;
/// Side of the box that all lies in, metres; and how far a near move goes.
const SIDE: f32 = 100.0;
const NEAR: f32 = 0.5;
/// The last quarter may have as much more memory than the second as chance brings: what is live changes all the time.
const GROWTH: f64 = 1.2;
/// The process has room besides the scene, bytes: lists that keep their capacity, and the allocator's own.
const ROOM: f64 = 16e6;
/// Frames from one question for memory to the next: the system takes as long as a frame to answer.
const ASKED: u32 = 16;
/// The parts of a frame, in their order.
const PHASES: [&str; 4] = ["begin-frame", "apply", "refit", "end-frame"];

/// How often what was done, and happened: edits by their kind; `swapped` top levels and `rebuilt` meshes; frames that `waited` for
/// a build by the deterministic rule, whose own thread built `inline`, or in which all was `checked`.
type Counts = BTreeMap<&'static str, u32>;

const COUNTED: [&str; 11] = [
    "added",
    "removed",
    "moved",
    "dimmed",
    "deformed",
    "exchanged",
    "swapped",
    "rebuilt",
    "waited",
    "inline",
    "checked",
];

/// Thread time of a part of all frames.
#[derive(Clone, Debug, Serialize)]
struct Row {
    what: &'static str,
    us: Spread,
}

#[derive(Clone, Debug, Serialize)]
pub(super) struct Report {
    frames: u32,
    seed: u32,
    /// At the end.
    instances: usize,
    lights: usize,
    edits: Counts,
    rows: Vec<Row>,
    /// The invariant that did not hold, which ended the soak, or a probability that was not the sample's.
    invalid: Option<String>,
    memory: Means,
    process: Means,
    devices: Vec<DeviceReport>,
}

pub(super) fn soak(frames: u32, args: &Args, opened: &[Opened]) -> Result<Report, HostError> {
    let mut world = World::new(args);
    let devices = opened.iter().map(|o| DeviceBackend::new(&o.device, &world.bvh));
    let mut devices: Vec<DeviceBackend<'_>> = devices.collect::<Result<_, _>>()?;
    let mut tallies = Tallies {
        devices: vec![Tally::default(); opened.len()],
        ..Tallies::default()
    };
    // Written once before the first frame, so that memory does not grow by it.
    let mut times: [Vec<f32>; 4] = std::array::from_fn(|_| vec![f32::MAX; frames as usize]);
    let mut memory: [Vec<f64>; 2] = std::array::from_fn(|_| vec![f64::MAX; frames.div_ceil(ASKED) as usize]);
    let mut counts: Counts = COUNTED.map(|what| (what, 0)).into();
    let mut invalid = None;
    let mut rebuilder = Rebuilder::default();
    for frame in 0..frames {
        if frame.is_multiple_of(RULED) {
            rebuilder = self::rebuilder(frame / RULED);
        }
        let edits = world.edits(&mut counts);
        let (begin, start) = thread_us(|| rebuilder.begin_frame(&mut world.bvh));
        let start = start?;
        for (what, more) in [
            ("swapped", u32::from(start.swapped)),
            ("rebuilt", start.meshes),
            ("waited", u32::from(!start.waited.is_zero())),
            ("inline", u32::from(start.inline)),
        ] {
            *counts.entry(what).or_default() += more;
        }
        let (apply, ()) = thread_us(|| world.apply(edits));
        let (refit, ()) = thread_us(|| world.bvh.refit());
        let (end, ()) = thread_us(|| rebuilder.end_frame(&world.bvh));
        for (list, time) in times.iter_mut().zip([begin, apply, refit, end]) {
            list[frame as usize] = time as f32;
        }
        for device in &mut devices {
            device.follow(&world.bvh)?;
        }
        // Whoever keeps numbers of lights over frames replaces those first.
        world.bvh.take_removed_lights();
        if frame.is_multiple_of(ASKED) {
            let process = memory_stats::memory_stats().map_or(0, |usage| usage.physical_mem);
            for (list, bytes) in memory.iter_mut().zip([world.bvh.view().memory(), process]) {
                list[(frame / ASKED) as usize] = bytes as f64;
            }
        }
        if (frame + 1).is_multiple_of(CHECKED) || frame + 1 == frames {
            if let Err(violation) = world.bvh.view().validate() {
                invalid = Some(format!("frame {frame}: {violation}"));
                break;
            }
            compare(frame, &mut world, &mut devices, &mut tallies)?;
            *counts.entry("checked").or_default() += 1;
            news!("frame {frame} checked");
        }
    }
    // Each quarter sees a round of both rules: else they differ by those.
    let judged = frames >= 4 * 2 * RULED;
    let rows = PHASES.into_iter().zip(times).map(|(what, list)| Row {
        what,
        us: Spread::of(list.into_iter().map(f64::from)),
    });
    if let (None, Some(first)) = (&invalid, tallies.cpu.first_difference) {
        invalid = Some(first);
    }
    let devices = opened.iter().zip(tallies.devices);
    Ok(Report {
        frames,
        seed: args.seed,
        instances: world.instances.len(),
        lights: world.bvh.view().light_count(),
        edits: counts,
        rows: rows.collect(),
        invalid,
        memory: Means::of(&memory[0], 0.0, judged),
        process: Means::of(&memory[1], ROOM, judged),
        devices: devices.map(|(o, tally)| DeviceReport::new(o, tally)).collect(),
    })
}

/// A rebuilder by both kinds of swap in turn; the deterministic one has no pauses.
fn rebuilder(turn: u32) -> Rebuilder {
    let mut params = RebuilderParams::default();
    if !turn.is_multiple_of(2) {
        params.after = AFTER;
        params.swap = Swap::Deterministic;
        params.idle = 0.0;
    }
    Rebuilder::new(params)
}

/// A scene that changes at random, about as large all the time.
struct World {
    bvh: Bvh,
    /// Meshes, with their triangles as they were at first.
    meshes: Vec<(MeshId, Vec<EmissiveTriangle>)>,
    /// Instances, with their meshes.
    instances: Vec<(InstanceId, MeshId)>,
    /// Those of the last edits, in their order, whose ids are not known yet.
    new_instances: Vec<MeshId>,
    new_mesh: Option<Vec<EmissiveTriangle>>,
    count: usize,
    largest: u32,
    random: Random,
}

impl World {
    fn new(args: &Args) -> Self {
        let mut world = Self {
            bvh: lightbvh::Bvh::default(),
            meshes: Vec::new(),
            instances: Vec::new(),
            new_instances: Vec::new(),
            new_mesh: None,
            count: args.instances as usize,
            largest: args.mesh_triangles,
            random: Random::new(args.seed),
        };
        for number in 0..MESHES {
            // The largest is there from the first.
            let triangles = world.mesh(number == 0);
            let id = world.bvh.add_mesh(triangles.clone()).expect("within the domain");
            world.meshes.push((id, triangles));
        }
        let edits = world.add(world.count);
        world.apply(edits);
        world.bvh.refit();
        world
    }

    /// Applies edits, and takes the ids of what they add.
    fn apply(&mut self, edits: Vec<Edit>) {
        let added = self.bvh.apply(edits).expect("edits within the domain");
        self.meshes
            .extend(added.meshes.into_iter().zip(self.new_mesh.take()));
        let new = std::mem::take(&mut self.new_instances);
        self.instances.extend(added.instances.into_iter().zip(new));
    }

    fn below(&mut self, count: usize) -> usize {
        self.random.below(count as u32) as usize
    }

    /// A mesh, the largest or one of a size that is half as likely as half of it.
    fn mesh(&mut self, is_largest: bool) -> Vec<EmissiveTriangle> {
        let most = 1 << self.below(self.largest.ilog2() as usize + 1);
        let count = match is_largest {
            true => self.largest,
            false => (1 + self.below(most) as u32).min(self.largest),
        };
        let size = 0.2 * (count as f32).cbrt();
        let random = &mut self.random;
        let one = |_| {
            let corner: [f32; 3] = std::array::from_fn(|_| size * random.between(-0.5, 0.5));
            let mut p = [corner; 3];
            for (axis, vertex) in p.iter_mut().enumerate() {
                vertex[axis] += random.between(0.05, 0.15);
            }
            EmissiveTriangle {
                p,
                radiance: [random.between(0.1, 1.1); 3],
                mesh: 0,
                flags: 0,
            }
        };
        (0..count).map(one).collect()
    }

    /// Turned at random, near a place, or else anywhere.
    fn turned(&mut self, place: Option<[f32; 3]>) -> Transform {
        let random = &mut self.random;
        let (s, c) = libm::sincosf(random.between(0.0, std::f32::consts::TAU));
        let place = place.map(|p| p.map(|x| (x + random.between(-NEAR, NEAR)).clamp(0.0, SIDE)));
        Transform {
            columns: [[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]],
            translation: place.unwrap_or_else(|| std::array::from_fn(|_| random.between(0.0, SIDE))),
        }
    }

    /// The edits of a frame: of no kind, of one, or of two.
    fn edits(&mut self, counts: &mut Counts) -> Vec<Edit> {
        let mut kinds: Vec<usize> = (0..self.below(3)).map(|_| self.below(8)).collect();
        // Meshes are exchanged first: instances that the batch adds have no ids yet, and would keep a mesh in use.
        kinds.sort_unstable();
        kinds.dedup();
        let edits = kinds.into_iter().flat_map(|kind| self.edits_of(kind, counts));
        edits.collect()
    }

    /// Edits of a kind: most often one, seldom many.
    fn edits_of(&mut self, kind: usize, counts: &mut Counts) -> Vec<Edit> {
        let most = [1, 1, 8, self.count / 64, self.count / 4][self.below(5)];
        let count = (1 + self.below(most.max(1))).min(self.instances.len());
        let present = self.instances.len() + self.new_instances.len();
        let tenth = self.count / 10;
        let (what, edits) = match kind {
            0 => ("exchanged", self.exchange()),
            1 => (
                "added",
                self.add(count.min((self.count + tenth).saturating_sub(present))),
            ),
            2 => {
                let spare = present.saturating_sub(self.count - tenth);
                let removed = (0..count.min(spare)).map(|_| {
                    let at = self.below(self.instances.len());
                    Edit::RemoveInstance(self.instances.swap_remove(at).0)
                });
                ("removed", removed.collect())
            }
            3..6 => ("moved", (0..count).map(|_| self.moved()).collect()),
            6 => ("dimmed", (0..count).map(|_| self.dimmed()).collect()),
            _ => ("deformed", vec![self.deform()]),
        };
        let done = if what == "exchanged" { 1 } else { edits.len() };
        *counts.entry(what).or_default() += done as u32;
        edits
    }

    fn add(&mut self, count: usize) -> Vec<Edit> {
        let added = (0..count).map(|_| {
            let at = self.below(self.meshes.len());
            let (mesh, transform) = (self.meshes[at].0, self.turned(None));
            self.new_instances.push(mesh);
            Edit::AddInstance {
                mesh,
                transform,
                radiance: [1.0; 3],
                mask: u32::MAX,
            }
        });
        added.collect()
    }

    /// One of four moves far.
    fn moved(&mut self) -> Edit {
        let at = self.below(self.instances.len());
        let instance = self.instances[at].0;
        let old = self.bvh.view().instances()[instance.index() as usize].translation;
        let place = (self.below(4) > 0).then_some(old);
        let transform = self.turned(place);
        Edit::SetTransform { instance, transform }
    }

    /// One of eight is turned off.
    fn dimmed(&mut self) -> Edit {
        let at = self.below(self.instances.len());
        let bright = if self.below(8) == 0 { 0.0 } else { 1.0 };
        let radiance = [0; 3].map(|_| bright * self.random.between(0.1, 1.1));
        let instance = self.instances[at].0;
        Edit::SetRadiance { instance, radiance }
    }

    /// A mesh jitters, or is scrambled, as a whole or in a range of its triangles.
    fn deform(&mut self) -> Edit {
        let at = self.below(self.meshes.len());
        let (mesh, mut triangles) = self.meshes[at].clone();
        let step = if self.below(4) == 0 { 2.0 } else { 0.05 };
        let is_whole = self.below(2) == 0;
        let first = if is_whole { 0 } else { self.below(triangles.len()) };
        triangles.drain(..first);
        if !is_whole {
            triangles.truncate(1 + self.below(32));
        }
        for triangle in &mut triangles {
            let by: [f32; 3] = std::array::from_fn(|_| step * self.random.between(-0.5, 0.5));
            triangle.p = triangle.p.map(|p| std::array::from_fn(|k| p[k] + by[k]));
        }
        let first = first as u32;
        match is_whole {
            true => Edit::SetLights {
                mesh,
                lights: triangles,
            },
            false => Edit::SetLightRange {
                mesh,
                first,
                lights: triangles,
            },
        }
    }

    /// A mesh is removed with all its instances; another is added, and as many instances of any.
    fn exchange(&mut self) -> Vec<Edit> {
        let at = self.below(self.meshes.len());
        let id = self.meshes.swap_remove(at).0;
        let users = self.instances.extract_if(.., |(_, mesh)| *mesh == id);
        let mut edits: Vec<Edit> = users.map(|(own, _)| Edit::RemoveInstance(own)).collect();
        let count = edits.len();
        edits.push(Edit::RemoveMesh(id));
        let triangles = self.mesh(false);
        self.new_mesh = Some(triangles.clone());
        edits.push(Edit::AddMesh { lights: triangles });
        edits.extend(self.add(count));
        edits
    }
}

/// Bytes in the mean over a quarter of the frames.
#[derive(Clone, Copy, Debug, Serialize)]
struct Means {
    second_quarter: f64,
    last_quarter: f64,
    flat: bool,
    /// Whether there were enough frames to tell.
    judged: bool,
}

impl Means {
    fn of(bytes: &[f64], room: f64, judged: bool) -> Self {
        let quarter = bytes.len() / 4;
        let (second_quarter, last_quarter) =
            (mean(&bytes[quarter..2 * quarter]), mean(&bytes[3 * quarter..]));
        Self {
            second_quarter,
            last_quarter,
            flat: last_quarter <= second_quarter * GROWTH + room,
            judged,
        }
    }
}

/// Compares all words in use, samples and probabilities on each device with the CPU's.
fn compare(
    frame: u32,
    world: &mut World,
    devices: &mut [DeviceBackend<'_>],
    tallies: &mut Tallies,
) -> Result<(), HostError> {
    let lights = world.bvh.view().world_lights();
    let points = around(&lights, POINTS, &mut world.random);
    let mut cpu: CpuBackend = CpuBackend::new(world.bvh.clone());
    let mut side: Side<'_, dyn Follow> = Side {
        cpu: &mut cpu,
        devices: devices.iter_mut().map(|own| own as &mut dyn Follow).collect(),
    };
    compare_bvh(
        &mut side,
        tallies,
        &format!("frame {frame}"),
        // Samples name live lights alone: words of others are not in use.
        (&world.bvh, &[]),
        &points,
    )
}

impl Report {
    /// Whether memory is flat, all is valid, and no word in use, sampled or evaluated on a device differs.
    pub fn is_good(&self) -> bool {
        let equal = self.devices.iter().all(|device| device.tally.different == 0);
        let flat = [self.memory, self.process]
            .iter()
            .all(|own| own.flat || !own.judged);
        self.invalid.is_none() && flat && equal
    }
}

pub(super) fn print(report: &Report) -> Result<(), HostError> {
    table::print(
        &report.rows,
        &[
            ("what", |r| r.what.to_owned()),
            ("median µs", |r| format!("{:.1}", r.us.median)),
            ("99 %", |r| format!("{:.1}", r.us.p99)),
            ("most", |r| format!("{:.1}", r.us.most)),
        ],
    )?;
    let edits = serde_json::to_string(&report.edits).map_err(std::io::Error::from)?;
    let (frames, instances, lights) = (report.frames, report.instances, report.lights);
    say!("\n{frames} frames, {instances} instances and {lights} lights at the end; edits: {edits}")?;
    for (what, means) in [("scene", &report.memory), ("process", &report.process)] {
        say!(
            "memory of the {what}: {:.2} MB in the second quarter, {:.2} MB in the last: {}",
            means.second_quarter * 1e-6,
            means.last_quarter * 1e-6,
            match (means.flat, means.judged) {
                (true, _) => "flat",
                (false, true) => "GROWS",
                (false, false) => "not judged over fewer than 4,000 frames",
            }
        )?;
    }
    super::print_devices(&report.devices)?;
    if let Some(invalid) = &report.invalid {
        say!("INVALID: {invalid}")?;
    }
    let verdict = if report.is_good() { "good" } else { "WRONG" };
    say!("words, invariants and memory: {verdict}")?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn growing_memory_is_not_flat() {
        let flat: Vec<f64> = (0..400).map(|frame| 1e6 + f64::from(frame % 7)).collect();
        let grows: Vec<f64> = (0..400).map(|frame| 1e6 + 1e4 * f64::from(frame)).collect();
        assert!(Means::of(&flat, 0.0, true).flat && !Means::of(&grows, 0.0, true).flat);
    }
}
