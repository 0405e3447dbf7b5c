//! `lightbvh bench --dynamic`: what a frame of moving lights costs, and that it follows what changed.

pub(super) mod lone;
mod report;
mod world;

use std::hint::black_box;
use std::time::Duration;

use lightbvh::bvh::RebuildParams;
use lightbvh::{BuildParams, Edit, Instance, LightBvh};
use lightbvh_kernels::bvh::Node;

pub(super) use self::report::print;
use self::report::{Report, Row, Spread};
use self::world::{Change, World};
use crate::backend::{DeviceBackend, Follow};
use crate::cli::devices::Opened;
use crate::cli::table::news;
use crate::cli::times::timed;
use crate::error::HostError;

/// Frames that count, and those before them that do not.
const FRAMES: usize = 20;
const WARM: usize = 2;
/// Frames on a device that count; a software device takes seconds for each.
const DEVICE_FRAMES: usize = 3;
/// Refits of the single-level tree.
const SINGLE_LEVEL: usize = 5;

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
    news!("single level");
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
        let name: &str = change.into();
        news!("{name} {changed} of {instances}");
        rows.push(one.install(|| cpu(&mut world, change, changed, 1, &scale)));
    }
    // The same number in a smaller scene.
    let fewer = (instances / 10).max(shares[0]);
    news!("move {} of {fewer}", shares[0]);
    let mut small = World::of_instances(fewer, mesh_triangles);
    rows.push(one.install(|| cpu(&mut small, Change::Move, shares[0], 1, &scale)));
    for o in opened {
        news!("move {instances} on {}", o.device.name());
        rows.push(device(&mut world, Change::Move, instances, o, &scale)?);
    }

    let triangles = instances * mesh_triangles;
    let mut mesh = World::of_one_mesh(triangles);
    let all = rayon::current_num_threads();
    news!("deform {triangles}");
    rows.push(one.install(|| cpu(&mut mesh, Change::Deform, triangles, 1, &scale)));
    if all > 1 {
        rows.push(cpu(&mut mesh, Change::Deform, triangles, all, &scale));
    }
    for o in opened {
        news!("deform {triangles} on {}", o.device.name());
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
    let (mut update, mut refit) = (Vec::new(), Vec::new());
    let mut nodes = 0;
    for frame in 0..WARM + FRAMES {
        let edits = world.edits(change, changed, frame as u32);
        let times = frame_of(world, edits);
        nodes = world.scene.work().computed();
        if frame >= WARM {
            update.push(times.0);
            refit.push(times.1);
        }
    }
    let refit_ms = Spread::of(refit);
    let swapped = (change != Change::Deform).then(|| swapping(world, change, changed));
    Row {
        update_ms: Spread::of(update),
        rebuild_ms: swapped.map(|[rebuild, _, _]| rebuild),
        swap_ms: swapped.map(|[_, swap, _]| swap),
        refit_after_swap_ms: swapped.map(|[_, _, refit]| refit),
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

/// Frames that each swap in the top level rebuilt beside the one before: its rebuild, the swap, the refit after it.
fn swapping(world: &mut World, change: Change, changed: u32) -> [Spread; 3] {
    let params = RebuildParams {
        top: 1.0,
        drift: f64::INFINITY,
    };
    let (mut rebuild, mut swap, mut refit) = (Vec::new(), Vec::new(), Vec::new());
    for frame in 0..FRAMES {
        let mut built = None;
        rebuild.push(timed(|| built = Some(world.scene.rebuild(&params).run())));
        let edits = world.edits(change, changed, (WARM + FRAMES + frame) as u32);
        swap.push(timed(|| {
            if let Some(built) = built {
                world.scene.install(built).expect("of the same light BVH");
            }
        }));
        refit.push(frame_of(world, edits).1);
    }
    [rebuild, swap, refit].map(Spread::of)
}

/// Time of update and refit.
fn frame_of(world: &mut World, edits: Vec<Edit>) -> (Duration, Duration) {
    let scene = &mut world.scene;
    let update = timed(|| {
        scene.apply(edits).expect("the edits are within the domain");
    });
    (update, timed(|| scene.refit()))
}

/// Frames on a device, which follows the scene; its own time counts.
fn device(
    world: &mut World,
    change: Change,
    changed: u32,
    opened: &Opened,
    scale: &Scale,
) -> Result<Row, HostError> {
    let mut backend: DeviceBackend<'_> = DeviceBackend::new(&opened.device, &world.scene)?;
    let (mut update, mut refit) = (Vec::new(), Vec::new());
    let mut nodes = 0;
    // The first frame compiles.
    for frame in 0..=DEVICE_FRAMES {
        let edits = world.edits(change, changed, frame as u32);
        let update_time = timed(|| {
            world.scene.apply(edits).expect("the edits are within the domain");
        });
        nodes = world.scene.plan().computed();
        let time = backend.follow(&world.scene)?.time;
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
        change: change.into(),
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
        refit_after_swap_ms: None,
        nodes,
        copies: refit_ms.median / scale.copy,
        of_single_level: refit_ms.median / scale.single_level,
    }
}

/// Refit of one tree over all triangles in the world by one thread, as without instances.
fn single_level(world: &World, one: &rayon::ThreadPool) -> Spread {
    let lights = world.lights();
    let mut bvh = LightBvh::single_level(&lights, &BuildParams::default());
    let times = (0..SINGLE_LEVEL)
        .map(|_| one.install(|| timed(|| bvh.follow(&lights).expect("the lights that it was built over"))));
    Spread::of(times.collect())
}

/// Copies of the top level's nodes and instances, and their size in bytes.
fn copy(world: &mut World) -> (Spread, usize) {
    let all = world.instance_count();
    let edits: Vec<Edit> = world.edits(Change::Move, all, 0);
    let scene = &mut world.scene;
    scene.apply(edits).expect("the edits are within the domain");
    scene.refit();
    let work = scene.work();
    let nodes: Vec<Node> = work
        .top
        .nodes()
        .iter()
        .map(|&i| scene.nodes()[i as usize])
        .collect();
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
