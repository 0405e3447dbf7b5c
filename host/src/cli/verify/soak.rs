//! `lightbvh verify --soak`: frames of random edits, with rebuilds in the background and followed by devices.

use bytemuck::cast_slice;
use lightbvh::bvh::{InstanceId, MeshId, Swap};
use lightbvh::node::{Node as _, kind};
use lightbvh::refit::BlasRoot;
use lightbvh::tree::{INVALID, OPENED, TreeWords};
use lightbvh::{Edit, EmissiveTriangle, Instance, Rebuilder, RebuilderParams, Transform};
use lightbvh_gpu::Mirror;
use lightbvh_kernels::bvh::{Node, WIDTH};
use serde::Serialize;

use crate::backend::{Bvh, DeviceArrays, DeviceBackend, Follow};
use crate::cli::devices::Opened;
use crate::cli::measure::times::{Spread, thread_us};
use crate::cli::table::{self, say};
use crate::error::HostError;
use crate::stability::random::Random;
use crate::tally::{Kind, Tally};
use crate::words::Record;

/// Frames from one check of all invariants and words to the next.
const CHECKED: u32 = 1_000;
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
/// Words of a node.
const NODE: usize = size_of::<Node>() / 4;
/// Arrays are compared word by word.
const WORD: Record = Record {
    name: "word in use",
    words: 1,
};
/// The parts of a frame, in their order.
const PHASES: [&str; 4] = ["begin-frame", "apply", "refit", "end-frame"];

/// How much is done.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plan {
    pub frames: u32,
    /// Chooses all edits.
    pub seed: u32,
    /// Number of instances about which their count stays.
    pub instances: u32,
    /// Triangles of the largest mesh; others have fewer, most of them few.
    pub mesh_triangles: u32,
}

/// How often what was done.
#[derive(Clone, Copy, Debug, Default, Serialize)]
struct Counts {
    added: u32,
    removed: u32,
    moved: u32,
    dimmed: u32,
    /// Meshes.
    deformed: u32,
    /// Meshes removed with their instances, and others added.
    exchanged: u32,
    /// Top levels swapped in, and meshes.
    swapped: u32,
    rebuilt: u32,
    /// Frames that waited for a build, by the deterministic rule.
    waited: u32,
    /// Frames whose own thread built, since no other could be started.
    inline: u32,
    /// Frames in which all was checked.
    checked: u32,
}

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
    /// The invariant that did not hold, which ended the soak.
    invalid: Option<String>,
    memory: Means,
    process: Means,
    devices: Vec<Compared>,
}

/// The words of a device.
#[derive(Clone, Debug, Serialize)]
struct Compared {
    name: String,
    #[serde(flatten)]
    tally: Tally,
}

pub(super) fn soak(plan: &Plan, opened: &[Opened], is_quiet: bool) -> Result<Report, HostError> {
    let mut world = World::new(plan);
    // Follows as devices do, and so has the offsets of their links.
    let mut layout = Mirror::default();
    layout.frame(&world.bvh);
    let mut devices = Vec::new();
    for o in opened {
        let device: DeviceBackend<'_> = DeviceBackend::new(&o.device, &world.bvh)?;
        devices.push((device, Tally::default()));
    }
    // Written once before the first frame, so that memory does not grow by it.
    let mut times: [Vec<f32>; 4] = std::array::from_fn(|_| vec![f32::MAX; plan.frames as usize]);
    let [mut memory, mut process] = [Quarters::default(); 2];
    let mut counts = Counts::default();
    let mut invalid = None;
    let bar = super::progress(plan.frames.into(), "frames", is_quiet);
    let mut rebuilder = Rebuilder::default();
    for frame in 0..plan.frames {
        if frame.is_multiple_of(RULED) {
            rebuilder = self::rebuilder(frame / RULED);
        }
        let edits = world.edits(&mut counts);
        let bvh = &mut world.bvh;
        let (begin, start) = thread_us(|| rebuilder.begin_frame(bvh));
        let start = start?;
        counts.swapped += u32::from(start.swapped);
        counts.rebuilt += start.meshes;
        counts.waited += u32::from(!start.waited.is_zero());
        counts.inline += u32::from(start.inline);
        let (apply, added) = thread_us(|| bvh.apply(edits).expect("edits within the domain"));
        let (refit, ()) = thread_us(|| bvh.refit());
        let (end, ()) = thread_us(|| rebuilder.end_frame(bvh));
        for (list, time) in times.iter_mut().zip([begin, apply, refit, end]) {
            list[frame as usize] = time as f32;
        }
        for (device, _) in &mut devices {
            device.follow(bvh)?;
        }
        layout.frame(bvh);
        // Whoever keeps numbers of lights over frames replaces those first.
        bvh.take_removed_lights();
        let meshes = added.meshes.iter().zip(world.new_mesh.take());
        world.meshes.extend(meshes.map(|(&id, own)| (id, own)));
        let new = std::mem::take(&mut world.new_instances);
        world.instances.extend(added.instances.into_iter().zip(new));
        let quarter = (u64::from(frame) * 4 / u64::from(plan.frames)) as u32;
        memory.take(quarter, world.bvh.memory() as f64);
        // The system is asked seldom: that takes as long as a frame.
        if frame.is_multiple_of(16)
            && let Some(usage) = memory_stats::memory_stats()
        {
            process.take(quarter, usage.physical_mem as f64);
        }
        if (frame + 1).is_multiple_of(CHECKED) || frame + 1 == plan.frames {
            if let Err(violation) = world.bvh.validate() {
                invalid = Some(format!("frame {frame}: {violation}"));
                break;
            }
            let words = layout.words(&world.bvh);
            for (device, tally) in &mut devices {
                compare(tally, frame, &world.bvh, &device.arrays()?, &words)?;
            }
            counts.checked += 1;
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    // Each quarter sees a round of both rules: else they differ by those.
    let judged = plan.frames >= 4 * 2 * RULED;
    let rows = PHASES.into_iter().zip(times).map(|(what, list)| Row {
        what,
        us: Spread::of(list.into_iter().map(f64::from)),
    });
    Ok(Report {
        frames: plan.frames,
        seed: plan.seed,
        instances: world.instances.len(),
        lights: world.bvh.light_count(),
        edits: counts,
        rows: rows.collect(),
        invalid,
        memory: memory.means(0.0, judged),
        process: process.means(ROOM, judged),
        devices: opened
            .iter()
            .zip(devices)
            .map(|(o, (_, tally))| Compared {
                name: o.device.name().to_owned(),
                tally,
            })
            .collect(),
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
    fn new(plan: &Plan) -> Self {
        let mut world = Self {
            bvh: lightbvh::Bvh::default(),
            meshes: Vec::new(),
            instances: Vec::new(),
            new_instances: Vec::new(),
            new_mesh: None,
            count: plan.instances as usize,
            largest: plan.mesh_triangles,
            random: Random::new(plan.seed),
        };
        for number in 0..MESHES {
            // The largest is there from the first.
            let triangles = world.mesh(number == 0);
            let id = world.bvh.add_mesh(triangles.clone()).expect("within the domain");
            world.meshes.push((id, triangles));
        }
        let mut edits = Vec::new();
        world.add(world.count, &mut edits);
        let added = world.bvh.apply(edits).expect("within the domain").instances;
        let new = std::mem::take(&mut world.new_instances);
        world.instances.extend(added.into_iter().zip(new));
        world.bvh.refit();
        world
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

    /// Turned at random, at a place, or else anywhere.
    fn turned(&mut self, place: Option<[f32; 3]>) -> Transform {
        let random = &mut self.random;
        let (s, c) = libm::sincosf(random.between(0.0, std::f32::consts::TAU));
        Transform {
            columns: [[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]],
            translation: place.unwrap_or_else(|| std::array::from_fn(|_| random.between(0.0, SIDE))),
        }
    }

    /// How many of `all` a batch has: most often one, seldom many.
    fn few(&mut self, all: usize) -> usize {
        let most = match self.below(64) {
            0 => all / 4,
            1..4 => all / 64,
            4..16 => 8,
            _ => 1,
        };
        (1 + self.below(most.max(1))).min(all)
    }

    /// The edits of a frame.
    fn edits(&mut self, counts: &mut Counts) -> Vec<Edit> {
        let mut edits = Vec::new();
        for _ in 0..1 + self.below(3) {
            match self.below(16) {
                // Nothing happens in some frames.
                0 => {}
                1..4 => {
                    // The more there are, the fewer come.
                    let room = (self.count + self.count / 10).saturating_sub(self.instances.len());
                    let count = self.few(self.count).min(room);
                    self.add(count, &mut edits);
                    counts.added += count as u32;
                }
                4..7 => {
                    let least = self.count - self.count / 10;
                    let spare = self.instances.len().saturating_sub(least);
                    let count = self.few(self.count).min(spare);
                    for _ in 0..count {
                        let at = self.below(self.instances.len());
                        edits.push(Edit::RemoveInstance(self.instances.swap_remove(at).0));
                    }
                    counts.removed += count as u32;
                }
                kind @ 7..14 => {
                    let count = self.few(self.instances.len());
                    let is_far = self.below(4) == 0;
                    for _ in 0..count {
                        let at = self.below(self.instances.len());
                        let instance = self.instances[at].0;
                        edits.push(match kind {
                            13 => {
                                let radiance = match self.below(8) {
                                    0 => 0.0,
                                    _ => self.random.between(0.1, 1.1),
                                };
                                Edit::SetRadiance { instance, radiance }
                            }
                            _ => {
                                let old = self.bvh.instances()[instance.index() as usize].translation;
                                let step = |x: f32| (x + self.random.between(-NEAR, NEAR)).clamp(0.0, SIDE);
                                let near = old.map(step);
                                let transform = self.turned((!is_far).then_some(near));
                                Edit::SetTransform { instance, transform }
                            }
                        });
                    }
                    let done = [&mut counts.moved, &mut counts.dimmed];
                    *done[usize::from(kind == 13)] += count as u32;
                }
                14 => {
                    edits.push(self.deform());
                    counts.deformed += 1;
                }
                _ => counts.exchanged += u32::from(self.exchange(&mut edits)),
            }
        }
        edits
    }

    fn add(&mut self, count: usize, edits: &mut Vec<Edit>) {
        for _ in 0..count {
            let at = self.below(self.meshes.len());
            let (mesh, transform) = (self.meshes[at].0, self.turned(None));
            self.new_instances.push(mesh);
            edits.push(Edit::AddInstance {
                mesh,
                transform,
                radiance: 1.0,
            });
        }
    }

    /// A mesh jitters, or is scrambled, as a whole or in a range of its triangles.
    fn deform(&mut self) -> Edit {
        let at = self.below(self.meshes.len());
        let count = self.meshes[at].1.len();
        let step = if self.below(4) == 0 { 2.0 } else { 0.05 };
        let is_whole = self.below(2) == 0;
        let first = if is_whole { 0 } else { self.below(count) };
        let end = if is_whole {
            count
        } else {
            count.min(first + 1 + self.below(32))
        };
        let mut triangles = self.meshes[at].1[first..end].to_vec();
        for triangle in &mut triangles {
            let by: [f32; 3] = std::array::from_fn(|_| step * self.random.between(-0.5, 0.5));
            triangle.p = triangle.p.map(|p| std::array::from_fn(|k| p[k] + by[k]));
        }
        let mesh = self.meshes[at].0;
        match is_whole {
            true => Edit::SetTriangles { mesh, triangles },
            false => Edit::SetTriangleRange {
                mesh,
                first: first as u32,
                triangles,
            },
        }
    }

    /// A mesh is removed with all its instances; another is added, with as many. Only once a frame, and no mesh that an edit of
    /// this frame has placed.
    fn exchange(&mut self, edits: &mut Vec<Edit>) -> bool {
        let at = self.below(self.meshes.len());
        let id = self.meshes[at].0;
        if self.new_mesh.is_some() || self.new_instances.contains(&id) {
            return false;
        }
        let users = self.instances.extract_if(.., |(_, mesh)| *mesh == id);
        let users: Vec<Edit> = users.map(|(own, _)| Edit::RemoveInstance(own)).collect();
        let count = users.len();
        edits.extend(users);
        self.meshes.swap_remove(at);
        edits.push(Edit::RemoveMesh(id));
        let triangles = self.mesh(false);
        self.new_mesh = Some(triangles.clone());
        edits.push(Edit::AddMesh { triangles });
        self.add(count, edits);
        true
    }
}

/// Sums of a quantity over the second and the last quarter.
#[derive(Clone, Copy, Debug, Default)]
struct Quarters {
    sums: [f64; 2],
    counts: [u32; 2],
}

impl Quarters {
    fn take(&mut self, quarter: u32, value: f64) {
        if let Some(at) = [1, 3].iter().position(|&own| own == quarter) {
            self.sums[at] += value;
            self.counts[at] += 1;
        }
    }

    fn means(&self, room: f64, judged: bool) -> Means {
        let [second_quarter, last_quarter] =
            [0, 1].map(|at| self.sums[at] / f64::from(self.counts[at].max(1)));
        Means {
            second_quarter,
            last_quarter,
            flat: last_quarter <= second_quarter * GROWTH + room,
            judged,
        }
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

/// Compares all words of a device that are in use.
fn compare(
    tally: &mut Tally,
    frame: u32,
    bvh: &Bvh,
    found: &DeviceArrays,
    words: &TreeWords,
) -> Result<(), HostError> {
    let (tree, all) = (bvh.tree(), bvh.plan_of_everything());
    let (bottom, top) = (all.bottom.nodes(), all.top.nodes());
    let records: Vec<u32> = (0..tree.instances.len() as u32).collect();
    let live = records.iter().copied();
    let live: Vec<u32> = live.filter(|&index| bvh.instance_id(index).is_some()).collect();
    let lights: Vec<u32> = live
        .iter()
        .map(|&index| tree.instances[index as usize])
        .flat_map(|own| own.first_triangle..own.first_triangle + own.count)
        .collect();
    let opened = live
        .iter()
        .map(|&index| (index, tree.links.places[index as usize]));
    let opened = opened.filter(|(_, place)| (OPENED..INVALID).contains(place));
    let parts: Vec<u32> = opened
        .flat_map(|(index, place)| {
            let root = &bvh.nodes()[tree.instances[index as usize].root as usize];
            let count = (0..WIDTH).filter(|&slot| root.kind(slot) == kind::INNER).count() as u32;
            place - OPENED..place - OPENED + count
        })
        .collect();
    let behind = size_of_val(bvh.nodes()) / 4;
    let [above, places, first] = [words.above, words.places, words.parts].map(|word| word as usize);
    let mut take = |name, words: usize, expected: &[u32], found: &[u32], indices: &[u32]| {
        let of = |all: &[u32]| -> Vec<u32> {
            let each = indices.iter().map(|&index| index as usize * words);
            each.flat_map(|at| all.get(at..at + words).unwrap_or_default().to_vec())
                .collect()
        };
        let what = format!("frame {frame} {name}");
        tally.take(Kind::Arrays, &what, &WORD, &of(expected), &of(found))
    };
    let [root, instance, light] = [
        size_of::<BlasRoot>(),
        size_of::<Instance>(),
        size_of::<EmissiveTriangle>(),
    ]
    .map(|bytes| bytes / 4);
    take("nodes", NODE, cast_slice(bvh.nodes()), &found.nodes, bottom)?;
    take(
        "top",
        NODE,
        cast_slice(bvh.top_nodes()),
        &found.nodes[behind..],
        top,
    )?;
    take("roots", root, cast_slice(bvh.roots()), &found.roots, &all.roots)?;
    take(
        "instances",
        instance,
        cast_slice(tree.instances),
        &found.instances,
        &records,
    )?;
    take(
        "triangles",
        light,
        cast_slice(bvh.triangles()),
        &found.triangles,
        &lights,
    )?;
    take(
        "trails",
        tree.trail_words as usize,
        tree.trails,
        &found.trails,
        &lights,
    )?;
    take("above", 1, tree.links.above, &found.trails[above..], top)?;
    take("places", 1, tree.links.places, &found.trails[places..], &live)?;
    take("parts", 1, tree.links.parts, &found.trails[first..], &parts)
}

impl Report {
    /// Whether memory is flat, all is valid, and no word of a device differs.
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
    let edits = serde_json::to_value(report.edits).map_err(std::io::Error::from)?;
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
    for Compared { name, tally } in &report.devices {
        let first = tally.first_difference.as_deref().unwrap_or("");
        let (compared, different) = (tally.compared, tally.different);
        say!("{name}: {compared} words compared, {different} different {first}")?;
    }
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
        let (mut flat, mut grows) = (Quarters::default(), Quarters::default());
        for frame in 0..400_u32 {
            flat.take(frame / 100, 1e6 + f64::from(frame % 7));
            grows.take(frame / 100, 1e6 + 1e4 * f64::from(frame));
        }
        assert!(flat.means(0.0, true).flat && !grows.means(0.0, true).flat);
    }
}
