//! `lightbvh soak`: frames of random edits, beside rebuilds and followed by devices, each held against its bound.

mod bound;
mod clock;
mod edits;
mod flat;
mod mirrors;
mod report;
mod times;

use lightbvh::Rebuilder;
use lightbvh::bvh::{RebuildParams, RebuilderParams, Swap};

use self::clock::Timed;
use self::edits::World;
use self::flat::Memory;
use self::mirrors::Mirrors;
use self::report::{Beyond, Counts, Report, Violation, print};
use self::times::Times;
use super::range::{self, given};
use super::{Context, Outcome, devices, progress};
use crate::error::HostError;

/// Every so many frames all invariants are checked and all words compared.
const CHECKED: u32 = 1_000;
/// So many frames in a row have rebuilds swapped in by one rule, then as many by the other.
const RULED: u32 = 500;
/// Frames between the end of the one that starts a rebuild and the start of the one in which it is due, by the deterministic rule.
const AFTER: u32 = 3;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Number of frames, 100 to 10^8. That memory is flat is judged from 8,000 on.
    #[arg(long, default_value_t = 100_000)]
    frames: u32,
    /// Parts of frames in 1000 that may take longer than their bound, 0 to 1000: on a core that others use too some do, whatever
    /// they do there. Else exit status 1, as where a word differs, memory grows, or a count of work or an invariant does not hold.
    #[arg(long, default_value_t = 0, value_name = "IN_1000")]
    late: u32,
    /// Chooses all edits.
    #[arg(long, default_value_t = 0)]
    seed: u32,
    /// Number of instances about which their count stays, 10 to 10^6.
    #[arg(long, default_value_t = 2_000)]
    instances: u32,
    /// Triangles of the largest mesh, 10 to 10^6; others have fewer, most of them few.
    #[arg(long, default_value_t = 20_000)]
    mesh_triangles: u32,
}

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    range::check(&[
        given("--frames", args.frames, 100..=100_000_000),
        given("--instances", args.instances, 10..=1_000_000),
        given("--mesh-triangles", args.mesh_triangles, 10..=1_000_000),
        given("--late", args.late, 0..=1000),
    ])?;
    let opened = devices::open(context)?;
    let report = soak(context, args, &opened)?;
    devices::close(opened)?;
    print(context, &report)?;
    Ok(Outcome::good_if(report.is_good()))
}

fn soak(context: &Context, args: &Args, opened: &[devices::Opened]) -> Result<Report, HostError> {
    let mut world = World::new(args.seed, args.instances, args.mesh_triangles);
    let mut mirrors = Mirrors::new(opened, &mut world.bvh)?;
    let mut times = Times::new(args.frames);
    let mut memory = Memory::new(args.frames);
    let mut counts = Counts::default();
    let mut beyond = Beyond::default();
    let (mut parts, mut invalid) = (0, None);
    let bar = progress::bar(args.frames.into(), "{bar:40} {pos}/{len} {eta}", context.json);
    let mut rebuilder = rebuilder(0);
    for frame in 0..args.frames {
        if frame.is_multiple_of(RULED) {
            // A rebuild under way is dropped with its rebuilder.
            rebuilder = self::rebuilder(frame / RULED);
        }
        let (edits, mut work) = world.edits(&mut counts);
        let bvh = &mut world.bvh;
        let (begin, start) = Timed::of(|| rebuilder.begin_frame(bvh));
        let start = start?;
        counts.adopted += u32::from(start.swapped);
        counts.waited += u32::from(!start.waited.is_zero());
        counts.inline += u32::from(start.inline);
        counts.copied = counts.copied.max(start.copied);
        let (edit, added) = Timed::of(|| {
            bvh.apply(edits)
                .expect("edits of what is there, within the domain")
        });
        let (refit, ()) = Timed::of(|| {
            bvh.plan();
        });
        work.take(bvh.work());
        counts.touched += u64::from(work.instances);
        counts.nodes += u64::from(work.top);
        mirrors.follow(bvh)?;
        let (computed, ()) = Timed::of(|| bvh.refit());
        let (end, ()) = Timed::of(|| rebuilder.end_frame(bvh));
        // Whoever keeps numbers of lights over frames replaces those first.
        bvh.take_removed_lights();
        world.take(&added);

        let phases = [begin, edit, refit.and(computed), end];
        times.take(frame, &phases);
        parts += phases.len();
        let bounds = work.bounds();
        for (phase, (time, bound)) in times::PHASES.into_iter().zip(phases.iter().zip(bounds)) {
            if time.thread > bound {
                beyond.take(|| Violation::new(frame, phase, time, bound, &work, start.swapped));
            }
        }
        memory.take(frame, world.bvh.memory());
        if (frame + 1).is_multiple_of(CHECKED) || frame + 1 == args.frames {
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
        frames: args.frames,
        seed: args.seed,
        instances: world.size_now().0,
        lights: world.size_now().1,
        edits: counts,
        bytes: RebuilderParams::default().bytes,
        rows: times.rows(),
        beyond: beyond.count,
        parts,
        late: args.late,
        first_beyond: beyond.first,
        invalid,
        memory: memory.scene(),
        process: memory.process(),
        devices: mirrors.tallies(),
    })
}

/// By both kinds of swap in turn; twice whatever has changed, so that much is taken over, and twice what is due by default.
fn rebuilder(turn: u32) -> Rebuilder {
    let rebuild = match turn % 4 {
        0 | 1 => RebuildParams::eager(),
        _ => RebuildParams::default(),
    };
    let when_ready = RebuilderParams {
        rebuild,
        ..RebuilderParams::default()
    };
    Rebuilder::new(if turn.is_multiple_of(2) {
        when_ready
    } else {
        RebuilderParams {
            after: AFTER,
            swap: Swap::Deterministic,
            ..when_ready
        }
    })
}
