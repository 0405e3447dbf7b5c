//! Builds on a thread in the background (paper section 3.5).
//!
//! The thread has a copy of each instance's leaf, which every frame updates, so no frame takes a snapshot.
//! It builds the whole top level and applies the edits made meanwhile. The next frame swaps the two trees in constant time; the
//! retired one is the next copy. The paper lets the next frame wait for the thread if it must; here that is a choice,
//! [`Swap::Deterministic`]. Meshes that changed are copied, built whole, and put in place.

mod clock;
mod handover;
mod params;
mod report;
mod scene;
mod worker;

use crate::model::{Model, Triangles};
use alloc::boxed::Box;
use alloc::vec::Vec;
use core::time::Duration;

use self::clock::Clock;
pub use self::params::{RebuilderParams, Swap};
pub use self::report::{FrameStart, RebuildError};
use self::worker::{Built, Job, Outcomes, Work, Worker, build};
use super::Bvh;
use super::mesh::MeshTree;
use super::records::TreeId;
use super::top::Top;
use crate::node::Holds;

/// Builds the trees of one [`Bvh`] in the background (paper section 3.5). Call [`begin_frame`](Self::begin_frame) before the
/// frame's edits and [`end_frame`](Self::end_frame) after its refit. One thread builds the top level after any change, and in
/// turn meshes whose lights changed. Use one for each [`Bvh`]: two void each other's builds.
///
/// Dropping it waits for its thread to end the build that it runs, if any: 0.4 s for a mesh of 10^6 lights. If no thread can be started (a limit of the system, or a platform without threads),
/// builds run at the end of their frame. On `wasm32-unknown-unknown` there is no clock either, and all times are
/// zero. If panics abort, a panic while building does too.
#[derive(Debug)]
pub struct Rebuilder<M: Model<W> = Triangles, const W: usize = 8> {
    params: RebuilderParams,
    worker: Option<Worker<M::Node>>,
    flight: Option<Flight<M::Node>>,
    /// A top level whose leaves are those of the scene as of batch `seen`, unless the thread has it.
    spare: Option<Box<Top<M::Node>>>,
    id: TreeId,
    /// The light BVH that it belongs to, and the number of the first batch that was not seen.
    tree: u32,
    seen: u64,
    /// Whether the top level changed since a build of it began.
    is_due: bool,
    /// Whether a mesh is built next, if any changed, and which.
    is_meshes_turn: bool,
    next_mesh: u32,
    /// When the last build was swapped in, and how long the pause after it is.
    pause: Option<(Clock, Duration)>,
    /// Frames that are left of it under [`Swap::Deterministic`].
    pause_frames: u32,
    /// How a worker is started.
    start: fn() -> std::io::Result<Worker<M::Node>>,
}

/// A build under way.
#[derive(Debug)]
struct Flight<N: Holds> {
    /// Frames to begin until it is due; at 1 or below, the next one.
    left: u32,
    /// The result, where it was built at once.
    inline: Option<Outcomes<N>>,
    /// Number of the first batch that it has to apply; `None` for a build of meshes.
    first: Option<u64>,
    /// Whether the result is to be dropped.
    is_void: bool,
}

impl<M: Model<W>, const W: usize> Default for Rebuilder<M, W> {
    fn default() -> Self {
        Self::new(RebuilderParams::default())
    }
}

impl<M: Model<W>, const W: usize> Rebuilder<M, W> {
    /// A rebuilder without a build under way; its thread starts with the first build.
    #[must_use]
    pub fn new(params: RebuilderParams) -> Self {
        Self {
            params,
            worker: None,
            flight: None,
            spare: None,
            id: TreeId::next(),
            tree: 0,
            seen: 0,
            is_due: false,
            is_meshes_turn: false,
            next_mesh: 0,
            pause: None,
            pause_frames: 0,
            start: Worker::start,
        }
    }

    /// Whether a build is under way, or its result waits to be swapped in.
    #[must_use]
    pub fn is_busy(&self) -> bool {
        self.flight.is_some()
    }

    /// Swaps in trees that are due. Call it before or after the frame's [`Bvh::apply`], but before its [`Bvh::refit`], with the
    /// scene that [`end_frame`](Self::end_frame) gets. A top level takes constant time, plus time in proportion to the instances
    /// that changed since the thread's last edit and those that may be opened. A mesh takes a copy of its nodes and trails.
    ///
    /// # Errors
    /// [`RebuildError`], once, if the build that was due failed. The frame can go on without it.
    pub fn begin_frame(&mut self, scene: &mut Bvh<M, W>) -> Result<FrameStart, RebuildError> {
        let mut start = FrameStart::default();
        let is_own = self.tree == scene.id.0;
        let first = self.flight.as_ref().and_then(|flight| flight.first);
        let needed = if is_own { first.unwrap_or(self.seen) } else { 0 };
        if !scene.follow_batches(self.id.0, needed) || !is_own {
            self.lose();
            (self.tree, self.seen) = (scene.id.0, scene.next_batch());
        }
        let Some(flight) = self.flight.as_mut() else {
            return Ok(start);
        };
        if flight.left > 1 {
            flight.left -= 1;
            return Ok(start);
        }
        let outcome = if let Some(built) = flight.inline.take() {
            start.inline = true;
            Some(built)
        } else {
            let began = Clock::start();
            let waits = self.params.swap == Swap::Deterministic;
            let outcome = self.worker.as_ref().and_then(|worker| worker.outcome(waits));
            if waits {
                start.waited = began.elapsed();
            }
            outcome
        };
        let Some(outcome) = outcome else {
            return Ok(start);
        };
        let (first, is_void) = (flight.first, flight.is_void);
        self.flight = None;
        let built = match outcome {
            Ok(built) => built,
            Err(message) => {
                // The next build starts a new worker; the failed work is still to be done.
                self.worker = None;
                self.is_due = true;
                return Err(RebuildError { message });
            }
        };
        self.rest(built.time);
        if !is_void {
            start.built = built.time;
            self.swap(scene, built, first.unwrap_or(self.seen), &mut start);
        }
        Ok(start)
    }

    /// Puts finished trees in place.
    fn swap(&mut self, scene: &mut Bvh<M, W>, built: Built<M::Node>, first: u64, start: &mut FrameStart) {
        match built.work {
            Work::Top(mut top) => {
                let first = first + built.batches as u64;
                let mut rest = scene.batches_from(first);
                if self.params.swap == Swap::Deterministic {
                    // One by one, as a thread applies them.
                    for batch in rest.drain(..self.seen.saturating_sub(first) as usize) {
                        top.edit(&[batch], &scene.params);
                    }
                }
                self.is_due |= scene.next_batch() > self.seen;
                self.seen = scene.next_batch();
                scene.swap_top(&mut top, rest);
                self.spare = Some(top);
                start.swapped = true;
            }
            Work::Meshes(meshes) => {
                for mesh in meshes {
                    start.meshes += u32::from(scene.install_mesh(&mesh));
                }
                scene.take_out_changed();
            }
        }
    }

    /// Begins the pause after a build that took `time`.
    fn rest(&mut self, time: Duration) {
        let idle = self.params.idle.max(0.0);
        if self.params.swap == Swap::Deterministic {
            // Infinity saturates: 2^32 - 1 frames.
            self.pause_frames = (idle * f64::from(self.params.after.max(1))) as u32;
        } else {
            let pause = Duration::try_from_secs_f64(time.as_secs_f64() * idle);
            self.pause = Some((Clock::start(), pause.unwrap_or(Duration::MAX)));
        }
    }

    /// Drops the copy of the top level and the build under way: they miss edits.
    fn lose(&mut self) {
        self.spare = None;
        self.is_due = true;
        if let Some(flight) = &mut self.flight {
            (flight.first, flight.is_void) = (None, true);
        }
    }

    /// Records the frame's changes, and starts the next build, unless one is under way, there is nothing to build, or the
    /// pause after the last one is not over. Call it after the frame's [`Bvh::refit`]. Takes time in proportion to the changes,
    /// and copies at most [`RebuilderParams::bytes`] of meshes. The first call, and the first with another scene, copies the top
    /// level.
    pub fn end_frame(&mut self, scene: &Bvh<M, W>) {
        if self.tree != scene.id.0 || scene.outbox.rebuilder != self.id.0 {
            self.lose();
            (self.tree, self.seen) = (scene.id.0, scene.next_batch());
        }
        let batches = scene.batches_from(self.seen);
        self.is_due |= !batches.is_empty();
        self.seen += batches.len() as u64;
        if let Some(spare) = &mut self.spare {
            batches.iter().for_each(|batch| spare.set(batch));
        } else if let (Some(Flight { first: Some(_), .. }), Some(worker)) = (&self.flight, &self.worker) {
            batches.into_iter().for_each(|batch| worker.send(batch));
        }
        if self.flight.is_some() || self.is_pausing() {
            return;
        }
        let Some(work) = self.next_work(scene) else {
            return;
        };
        let first = matches!(work, Work::Top(_)).then_some(self.seen);
        let job = Job {
            work,
            params: scene.params,
            waits: self.params.swap == Swap::Deterministic,
        };
        if self.worker.is_none() {
            self.worker = (self.start)().ok();
        }
        let refused = match &self.worker {
            Some(worker) => worker.submit(job).err(),
            None => Some(job),
        };
        self.flight = Some(Flight {
            left: self.params.after,
            inline: refused.map(|job| build(job, &|_| Vec::new())),
            first,
            is_void: false,
        });
    }

    fn is_pausing(&mut self) -> bool {
        if self.pause_frames > 0 {
            self.pause_frames -= 1;
            return true;
        }
        self.pause.is_some_and(|(since, pause)| since.elapsed() < pause)
    }

    /// The next work: the top level and meshes in turn.
    fn next_work(&mut self, scene: &Bvh<M, W>) -> Option<Work<M::Node>> {
        let has_top = self.is_due && !scene.single;
        if core::mem::take(&mut self.is_meshes_turn) || !has_top {
            let meshes = self.next_meshes(scene);
            if !meshes.is_empty() {
                return Some(Work::Meshes(meshes));
            }
        }
        self.is_meshes_turn = true;
        has_top.then(|| {
            self.is_due = false;
            let spare = self.spare.take();
            Work::Top(spare.unwrap_or_else(|| Box::new(scene.copy_top())))
        })
    }

    /// Copies of meshes that changed since they were built, as far as the frame may copy.
    fn next_meshes(&mut self, scene: &Bvh<M, W>) -> Vec<MeshTree<M::Node>> {
        let mut meshes = Vec::new();
        let mut left = self.params.bytes;
        for (mesh, bytes) in scene.reshaped_from(self.next_mesh) {
            if bytes > self.params.bytes {
                continue;
            }
            if bytes > left {
                break;
            }
            left -= bytes;
            self.next_mesh = mesh + 1;
            meshes.push(scene.copy_mesh(mesh));
        }
        meshes
    }
}

#[cfg(test)]
mod tests;
