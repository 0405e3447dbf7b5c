//! Begin and end of frames beside which trees are rebuilt.

use std::time::{Duration, Instant};

use lightbvh::Rebuilder;
use lightbvh::bvh::{RebuildParams, RebuilderParams};

use super::Patience;
use super::rows::{Kind, Row};
use super::scene::{Sample, Scene};
use crate::cli::times::timed;

/// Time between frames, in which the worker has a core.
const PAUSE: Duration = Duration::from_micros(300);
/// Frames beside one rebuild that count; others wait for its end.
const BESIDE: usize = 2000;

/// The top level is rebuilt beside frames in which nothing changes, and such in which one instance moves.
pub(super) fn rows(scene: &mut Scene, patience: Patience) -> Vec<Row> {
    let rebuild = RebuildParams {
        top: 1.0,
        drift: f64::INFINITY,
    };
    let change = |scene: &mut Scene| {
        let instance = scene.some();
        let transform = scene.near(instance);
        scene.bvh.set_transform(instance, transform).expect("its own");
    };
    let kind = |scene: &Scene, what, case| Kind::of_instances(scene, what, case);
    let flickers = flickering(scene, patience);
    let mut rows = measure(scene, rebuild, patience, change, change, "top level", kind);
    rows.extend(kind(scene, "end-frame", "one flickers, by default").times(&flickers));
    rows
}

/// So many frames in which a rebuilder starts nothing are rest, and so many it is given to come to it.
const QUIET: u32 = 40;
const MOST_LEFT: u32 = 4000;

/// Ends of frames in which one instance is dimmed and no rebuild is under way, by a rebuilder as it comes: what it starts then is
/// started for one lamp.
fn flickering(scene: &mut Scene, patience: Patience) -> Vec<Duration> {
    let mut rebuilder = Rebuilder::default();
    let lamp = scene.some();
    // What the frames before have left due is not this lamp's.
    let mut quiet = 0;
    for _ in 0..MOST_LEFT {
        rebuilder.begin_frame(&mut scene.bvh).expect("no panic");
        scene.bvh.refit();
        rebuilder.end_frame(&scene.bvh);
        quiet = if rebuilder.is_busy() { 0 } else { quiet + 1 };
        if quiet > QUIET {
            break;
        }
        std::thread::sleep(if quiet == 0 { PAUSE } else { Duration::ZERO });
    }
    let mut times = Vec::new();
    patience.frames(|frame| {
        while rebuilder.is_busy() {
            rebuilder.begin_frame(&mut scene.bvh).expect("no panic");
            std::thread::sleep(PAUSE);
        }
        let radiance = 1.0 + (frame % 2) as f32;
        scene.bvh.set_radiance(lamp, radiance).expect("its own");
        scene.bvh.refit();
        times.push(timed(|| rebuilder.end_frame(&scene.bvh)));
    });
    times
}

/// By what frame a time was taken.
#[derive(Default)]
struct Times {
    begin_still: Vec<Duration>,
    begin_changed: Vec<Duration>,
    end_still: Vec<Duration>,
    end_changed: Vec<Duration>,
    start: Vec<Duration>,
    adopt: Vec<Sample>,
}

/// Rebuilds that `start` makes due, one after the other, with frames beside them that `change` something or not.
pub(super) fn measure(
    scene: &mut Scene,
    rebuild: RebuildParams,
    patience: Patience,
    mut start: impl FnMut(&mut Scene),
    mut change: impl FnMut(&mut Scene),
    adopted: &'static str,
    kind: impl Fn(&Scene, &'static str, &'static str) -> Kind,
) -> Vec<Row> {
    let mut rebuilder = Rebuilder::new(RebuilderParams {
        rebuild,
        ..RebuilderParams::default()
    });
    let mut times = Times::default();
    let patience = Patience {
        time: 2 * patience.time,
        least: patience.least.min(6),
        ..patience
    };
    patience.frames(|_| {
        start(scene);
        scene.bvh.refit();
        scene.bytes();
        let time = timed(|| rebuilder.end_frame(&scene.bvh));
        if rebuilder.is_busy() {
            times.start.push(time);
        }
        beside(scene, &mut rebuilder, &mut change, &mut times);
    });
    let adopt = kind(scene, "adopt", adopted).rows(&times.adopt);
    let rows = [
        ("begin-frame", "nothing changes", &times.begin_still),
        ("begin-frame", "one changed", &times.begin_changed),
        ("end-frame", "nothing changed", &times.end_still),
        ("end-frame", "one changed", &times.end_changed),
        ("end-frame", "starts a rebuild", &times.start),
    ];
    let rows = rows.into_iter();
    let rows = rows.filter_map(|(what, case, times)| kind(scene, what, case).times(times));
    rows.chain(adopt).collect()
}

/// Frames until the rebuild under way is swapped in.
fn beside(
    scene: &mut Scene,
    rebuilder: &mut Rebuilder,
    change: &mut impl FnMut(&mut Scene),
    times: &mut Times,
) {
    let mut frame = 0;
    let mut changed = false;
    while rebuilder.is_busy() {
        let began = Instant::now();
        let start = rebuilder.begin_frame(&mut scene.bvh).expect("no panic");
        let swapped = start.swapped || start.adopted > 0;
        let mut begin = began.elapsed();
        if swapped {
            // Nothing else happens in this frame.
            begin += timed(|| scene.bvh.refit());
            let nodes = scene.bvh.work().computed();
            times.adopt.push(Sample {
                time: begin,
                nodes,
                bytes: scene.bytes(),
            });
            break;
        }
        // What the frame before has changed may be what its beginning has to see to.
        let begins = if changed {
            &mut times.begin_changed
        } else {
            &mut times.begin_still
        };
        if frame < BESIDE {
            begins.push(begin);
        }
        changed = frame % 2 == 0 && frame < BESIDE;
        if changed {
            change(scene);
        }
        scene.bvh.refit();
        let end = timed(|| rebuilder.end_frame(&scene.bvh));
        let ends = if changed {
            &mut times.end_changed
        } else {
            &mut times.end_still
        };
        if frame < BESIDE {
            ends.push(end);
        }
        frame += 1;
        std::thread::sleep(PAUSE);
    }
}
