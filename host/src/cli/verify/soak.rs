//! `lightbvh verify --soak`: frames of random edits, with rebuilds in the background and followed by devices.

mod edits;
mod flat;
mod mirrors;
mod report;

use lightbvh::bvh::Swap;
use lightbvh::{Rebuilder, RebuilderParams};

use self::edits::World;
use self::flat::Memory;
use self::mirrors::Mirrors;
use self::report::{Counts, Times};
use crate::cli::devices::Opened;
use crate::cli::measure::times::thread_us;
use crate::error::HostError;

pub(super) use self::report::{Report, print};

/// Frames from one check of all invariants and words to the next.
const CHECKED: u32 = 1_000;
/// Frames in a row in which trees are swapped in by one rule.
const RULED: u32 = 500;
/// Frames that a build has by the deterministic rule.
const AFTER: u32 = 3;

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

pub(super) fn soak(plan: &Plan, opened: &[Opened], is_quiet: bool) -> Result<Report, HostError> {
    let mut world = World::new(plan.seed, plan.instances, plan.mesh_triangles);
    let mut mirrors = Mirrors::new(opened, &world.bvh)?;
    let mut times = Times::new(plan.frames);
    let mut memory = Memory::new(plan.frames);
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
        counts.take(&start?);
        let (apply, added) = thread_us(|| {
            bvh.apply(edits)
                .expect("edits of what is there, within the domain")
        });
        let (refit, ()) = thread_us(|| bvh.refit());
        let (end, ()) = thread_us(|| rebuilder.end_frame(bvh));
        times.take(frame, [begin, apply, refit, end]);
        mirrors.follow(bvh)?;
        // Whoever keeps numbers of lights over frames replaces those first.
        bvh.take_removed_lights();
        world.take(&added);
        memory.take(frame, world.bvh.memory());
        if (frame + 1).is_multiple_of(CHECKED) || frame + 1 == plan.frames {
            let sound = world.bvh.validate().map_err(|violation| violation.to_string());
            if let Err(what) = sound.and_then(|_| world.check()) {
                invalid = Some(format!("frame {frame}: {what}"));
                break;
            }
            mirrors.compare(frame, &world.bvh)?;
            counts.checked += 1;
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(Report {
        frames: plan.frames,
        seed: plan.seed,
        instances: world.size_now().0,
        lights: world.size_now().1,
        edits: counts,
        rows: times.rows(),
        invalid,
        memory: memory.scene(),
        process: memory.process(),
        devices: mirrors.tallies(),
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
