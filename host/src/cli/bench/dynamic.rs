//! `lightbvh bench --dynamic`: what a frame of moving lights costs, and that it follows what changed.

mod world;

use std::hint::black_box;
use std::io;
use std::time::{Duration, Instant};

use lightbvh::scene::RebuildParams;
use lightbvh::{BuildParams, Edit, Instance, LightBvh};
use lightbvh_kernels::bvh::{Node, WIDTH};
use serde::Serialize;

use self::world::{Change, World};
use crate::backend::{Backend, DeviceBackend};
use crate::cli::devices::Opened;
use crate::cli::table;
use crate::error::HostError;

/// Frames that count, and those before them that do not.
const FRAMES: usize = 20;
const WARM: usize = 2;
/// Frames on a device that count; a software device takes seconds for each.
const DEVICE_FRAMES: usize = 3;
/// Refits of the single-level tree.
const SINGLE_LEVEL: usize = 5;

/// Least, greatest and median of the frames, milliseconds.
#[derive(Clone, Copy, Debug, Default, Serialize)]
struct Spread {
    median: f64,
    least: f64,
    most: f64,
}

impl Spread {
    fn of(mut times: Vec<Duration>) -> Self {
        times.sort_unstable();
        let ms = |time: Option<&Duration>| time.map_or(0.0, |time| time.as_secs_f64() * 1e3);
        Self {
            median: ms(times.get(times.len() / 2)),
            least: ms(times.first()),
            most: ms(times.last()),
        }
    }
}

/// A kind of frame.
#[derive(Clone, Debug, Serialize)]
struct Row {
    change: &'static str,
    instances: u32,
    triangles: u64,
    /// Instances, or triangles of the deformed mesh, that change in each frame.
    changed: u32,
    backend: String,
    threads: usize,
    frames: usize,
    /// [`lightbvh::Scene::update`]: the edits, checked and done.
    update_ms: Spread,
    /// [`lightbvh::Scene::refit`], or the passes on a device.
    refit_ms: Spread,
    /// The top level's rebuild, which runs beside the frame, and its swap-in at the start of the next.
    rebuild_ms: Option<Spread>,
    swap_ms: Option<Spread>,
    /// Nodes and roots that the refit computes.
    nodes: usize,
    /// The refit's median over the time of copying the top level's nodes and instances once.
    copies: f64,
    /// The refit's median over that of a single-level refit of all triangles by one thread.
    of_single_level: f64,
}

/// All measurements.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Report {
    /// Copying the top level's nodes and instances.
    copy_ms: Spread,
    top_level_bytes: usize,
    /// Refit of a single-level tree of all triangles in the world, one thread.
    single_level_refit_ms: Spread,
    rows: Vec<Row>,
}

/// What the refits are compared with.
struct Scale {
    copy: f64,
    single_level: f64,
}

/// Measures scenes of `instances` × `mesh_triangles` triangles.
pub(super) fn report(instances: u32, mesh_triangles: u32, opened: &[Opened]) -> Result<Report, HostError> {
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a pool of one thread");
    let mut world = World::of_instances(instances, mesh_triangles);
    eprintln!("single level");
    let single_level = single_level(&world, &one);
    let (copy, top_level_bytes) = copy(&mut world);
    let scale = Scale {
        copy: copy.median,
        single_level: single_level.median,
    };

    let mut rows = Vec::new();
    let shares = [100, 10, 1].map(|share| (instances / share).max(1));
    for (change, changed) in shares
        .map(|changed| (Change::Move, changed))
        .into_iter()
        .chain([(Change::Shine, shares[0])])
    {
        eprintln!("{} {changed} of {instances}", change.name());
        rows.push(one.install(|| cpu(&mut world, change, changed, 1, &scale)));
    }
    // The same number in a smaller scene.
    let fewer = (instances / 10).max(shares[0]);
    eprintln!("move {} of {fewer}", shares[0]);
    let mut small = World::of_instances(fewer, mesh_triangles);
    rows.push(one.install(|| cpu(&mut small, Change::Move, shares[0], 1, &scale)));
    for o in opened {
        eprintln!("move {instances} on {}", o.device.name());
        rows.push(device(&mut world, Change::Move, instances, o, &scale)?);
    }

    let triangles = instances * mesh_triangles;
    let mut mesh = World::of_one_mesh(triangles);
    let all = rayon::current_num_threads();
    eprintln!("deform {triangles}");
    rows.push(one.install(|| cpu(&mut mesh, Change::Deform, triangles, 1, &scale)));
    if all > 1 {
        rows.push(cpu(&mut mesh, Change::Deform, triangles, all, &scale));
    }
    for o in opened {
        eprintln!("deform {triangles} on {}", o.device.name());
        rows.push(device(&mut mesh, Change::Deform, triangles, o, &scale)?);
    }
    Ok(Report {
        copy_ms: copy,
        top_level_bytes,
        single_level_refit_ms: single_level,
        rows,
    })
}

/// Frames on the CPU, by the threads of the current pool.
fn cpu(world: &mut World, change: Change, changed: u32, threads: usize, scale: &Scale) -> Row {
    let (mut update, mut refit, mut rebuild, mut swap) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let params = RebuildParams {
        top: true,
        drift: f64::INFINITY,
    };
    let rebuilt = change != Change::Deform;
    let mut nodes = 0;
    for frame in 0..WARM + FRAMES {
        let edits = world.edits(change, changed, frame as u32);
        let scene = &mut world.scene;
        let update_time = timed(|| {
            scene.update(edits).expect("the edits are within the domain");
        });
        let refit_time = timed(|| scene.refit());
        nodes = scene.work().computed();
        let (mut rebuild_time, mut swap_time) = (Duration::ZERO, Duration::ZERO);
        if rebuilt {
            let mut built = None;
            rebuild_time = timed(|| built = Some(scene.rebuild(&params).run()));
            swap_time = timed(|| built.into_iter().for_each(|built| scene.adopt(built)));
        }
        if frame >= WARM {
            update.push(update_time);
            refit.push(refit_time);
            rebuild.push(rebuild_time);
            swap.push(swap_time);
        }
    }
    let refit_ms = Spread::of(refit);
    Row {
        update_ms: Spread::of(update),
        rebuild_ms: rebuilt.then(|| Spread::of(rebuild)),
        swap_ms: rebuilt.then(|| Spread::of(swap)),
        ..row(
            world,
            change,
            changed,
            ("cpu", threads, FRAMES),
            refit_ms,
            nodes,
            scale,
        )
    }
}

/// Frames on a device, which follows the scene; its own time counts.
fn device(
    world: &mut World,
    change: Change,
    changed: u32,
    opened: &Opened,
    scale: &Scale,
) -> Result<Row, HostError> {
    let lights = world.lights();
    let mut backend = DeviceBackend::of_scene(&opened.device, &world.scene, &lights)?;
    let (mut update, mut refit) = (Vec::new(), Vec::new());
    let mut nodes = 0;
    // The first frame compiles.
    for frame in 0..=DEVICE_FRAMES {
        let edits = world.edits(change, changed, frame as u32);
        let update_time = timed(|| {
            world
                .scene
                .update(edits)
                .expect("the edits are within the domain");
        });
        nodes = world.scene.plan().computed();
        let lights = world.lights();
        let time = backend.follow(&world.scene, &lights)?.time;
        world.scene.refit();
        if frame > 0 {
            update.push(update_time);
            refit.push(time);
        }
    }
    let how = (opened.device.name(), 0, DEVICE_FRAMES);
    Ok(Row {
        update_ms: Spread::of(update),
        ..row(world, change, changed, how, Spread::of(refit), nodes, scale)
    })
}

fn row(
    world: &World,
    change: Change,
    changed: u32,
    (backend, threads, frames): (&str, usize, usize),
    refit_ms: Spread,
    nodes: usize,
    scale: &Scale,
) -> Row {
    Row {
        change: change.name(),
        instances: world.instance_count(),
        triangles: world.scene.light_count() as u64,
        changed,
        backend: backend.to_owned(),
        threads,
        frames,
        update_ms: Spread::default(),
        refit_ms,
        rebuild_ms: None,
        swap_ms: None,
        nodes,
        copies: refit_ms.median / scale.copy,
        of_single_level: refit_ms.median / scale.single_level,
    }
}

/// Refit of one tree over all triangles in the world by one thread, as without instances.
fn single_level(world: &World, one: &rayon::ThreadPool) -> Spread {
    let lights = world.lights();
    let mut bvh: LightBvh<Node, WIDTH> = LightBvh::single_level(&lights, &BuildParams::default());
    let times = (0..SINGLE_LEVEL).map(|_| one.install(|| timed(|| bvh.refit(&lights))));
    Spread::of(times.collect())
}

/// Copies of the top level's nodes and instances, and their size in bytes.
fn copy(world: &mut World) -> (Spread, usize) {
    let all = world.instance_count();
    let edits: Vec<Edit> = world.edits(Change::Move, all, 0);
    let scene = &mut world.scene;
    scene.update(edits).expect("the edits are within the domain");
    scene.refit();
    let work = scene.work();
    let mut top: Vec<u32> = [&work.instances[..], work.top.nodes()].concat();
    top.sort_unstable();
    top.dedup();
    let nodes: Vec<Node> = top.iter().map(|&i| scene.nodes()[i as usize]).collect();
    let instances: Vec<Instance> = scene.instances().to_vec();
    let (mut to_nodes, mut to_instances) = (nodes.clone(), instances.clone());
    let times = (0..FRAMES).map(|_| {
        timed(|| {
            to_nodes.copy_from_slice(black_box(&nodes));
            to_instances.copy_from_slice(black_box(&instances));
            black_box((&to_nodes, &to_instances));
        })
    });
    let bytes = size_of_val(&*nodes) + size_of_val(&*instances);
    (Spread::of(times.collect()), bytes)
}

fn timed(work: impl FnOnce()) -> Duration {
    let start = Instant::now();
    work();
    start.elapsed()
}

/// Prints the table.
pub(super) fn print(report: &Report) -> io::Result<()> {
    let header = [
        "change",
        "instances",
        "triangles",
        "changed",
        "backend",
        "threads",
        "update ms",
        "refit ms",
        "least",
        "most",
        "nodes",
        "rebuild ms",
        "swap ms",
        "copies",
        "of single-level",
    ];
    let median = |spread: &Option<Spread>| spread.map_or("-".to_owned(), |s| format!("{:.3}", s.median));
    let rows: Vec<Vec<String>> = report
        .rows
        .iter()
        .map(|r| {
            vec![
                r.change.to_owned(),
                r.instances.to_string(),
                r.triangles.to_string(),
                r.changed.to_string(),
                r.backend.clone(),
                if r.threads == 0 {
                    "-".to_owned()
                } else {
                    r.threads.to_string()
                },
                format!("{:.3}", r.update_ms.median),
                format!("{:.3}", r.refit_ms.median),
                format!("{:.3}", r.refit_ms.least),
                format!("{:.3}", r.refit_ms.most),
                r.nodes.to_string(),
                median(&r.rebuild_ms),
                median(&r.swap_ms),
                format!("{:.2}", r.copies),
                format!("{:.4}", r.of_single_level),
            ]
        })
        .collect();
    table::print(&header, &rows)?;
    table::print_text(&format!(
        "single-level refit of all triangles, one thread: {:.3} ms; copy of the top level ({} bytes): {:.4} ms\n",
        report.single_level_refit_ms.median, report.top_level_bytes, report.copy_ms.median
    ))
}
