//! Rebuilds on a thread beside the frame (paper section 3.5).
//!
//! [`end_frame`](Rebuilder::end_frame) takes a copy of what is to be built and hands it to a worker thread,
//! [`begin_frame`](Rebuilder::begin_frame) swaps the result in. In between the scene is free: it may be sampled, edited and
//! refitted as ever. A large mesh is copied to the builder, and its tree put in place, a piece in each frame: the bytes that a
//! frame copies are bounded ([`RebuilderParams::bytes`]), whatever is built beside it. The paper lets the next frame wait for
//! the rebuild if it must; here that is a choice, [`Swap::Deterministic`].

mod clock;
mod handover;
mod meshes;
mod params;
mod queue;
mod report;
mod worker;

use alloc::collections::BTreeSet;
use alloc::vec::Vec;

use self::clock::Clock;
use self::meshes::Meshes;
pub use self::params::{RebuilderParams, Swap};
use self::queue::Queue;
pub use self::report::{FrameStart, RebuildError};
use self::worker::{Built, Job, Product, Worker, build};
use crate::bvh::{Bvh, Looked, Search, Taken, Trails};
use crate::node::{DefaultNode, Holds, Node};

/// Runs the rebuilds of one [`Bvh`] beside its frames (paper section 3.5), [`begin_frame`](Self::begin_frame) before the
/// frame's edits and [`end_frame`](Self::end_frame) after its refit: that of the top level and of small meshes, one at a time,
/// and those of [some](RebuilderParams::meshes) large meshes.
///
/// Dropping it waits for its threads to end the rebuilds that they run, if any: 0.3 s for a mesh of 10^6 triangles;
/// [`detach`](Self::detach) does not. Where no thread can be started (a limit of
/// the system, or a platform without threads) rebuilds run at the end of their frame, with the same results: so it is on
/// `wasm32-unknown-unknown`, where there is no clock either, and all times are zero. Where panics abort, one while building does
/// too.
#[derive(Debug)]
pub struct Rebuilder<N: Holds = DefaultNode, const W: usize = 8> {
    params: RebuilderParams,
    worker: Option<Worker<N, W>>,
    flight: Option<Flight<N, W>>,
    /// Large meshes.
    meshes: Meshes<N, W>,
    /// When the last rebuild was taken, if nothing was lost since.
    taken: Option<Taken>,
    /// For the next part of a large top level.
    search: Search,
    /// Instances that are to be opened, those `to_open`, or closed, and of which light BVH.
    reopening: Queue,
    to_open: BTreeSet<u32>,
    /// Those that were.
    reopened: Vec<u32>,
    reopens: Option<Taken>,
    /// Frames since there was time for any.
    held: u32,
    /// Which instances that moved away were looked at.
    looked: Looked,
    /// Whether small meshes that are many had the last turn.
    is_tops_turn: bool,
    /// How a worker is started.
    start: fn() -> std::io::Result<Worker<N, W>>,
}

/// Leaves of instances whose meshes went elsewhere that a frame puts in anew, or a few more where the last one is opened.
const STRAYED: usize = 2;
/// Instances that a frame opens or closes.
const REOPENED: usize = 2;
/// Frames in a row in which none is, for parts of a large top level come in.
const HELD: u32 = 3;

/// A rebuild under way.
#[derive(Debug)]
struct Flight<N: Holds, const W: usize> {
    /// Frames to begin until it is due; at 1 or below, the next one.
    left: u32,
    /// The result, where it was built at once.
    inline: Option<Built<N, W>>,
}

impl<N: Node<W>, const W: usize> Default for Rebuilder<N, W> {
    fn default() -> Self {
        Self::new(RebuilderParams::default())
    }
}

impl<N: Node<W>, const W: usize> Rebuilder<N, W> {
    /// A rebuilder that has nothing under way; its thread starts with the first rebuild.
    #[must_use]
    pub fn new(params: RebuilderParams) -> Self {
        Self {
            params,
            worker: None,
            flight: None,
            meshes: Meshes::default(),
            taken: None,
            search: Search::default(),
            reopening: Queue::default(),
            to_open: BTreeSet::new(),
            reopened: Vec::new(),
            reopens: None,
            held: 0,
            looked: Looked::default(),
            is_tops_turn: false,
            start: Worker::start,
        }
    }

    /// Ends without waiting: threads that still build go on alone until that is done, and what they build is dropped. Where
    /// their code may be unloaded meanwhile, as that of a plugin, drop it instead, which waits.
    pub fn detach(mut self) {
        let workers = self.worker.iter_mut().chain(self.meshes.workers());
        workers.for_each(Worker::detach);
    }

    /// Whether a rebuild is under way, or its result waits to be swapped in.
    #[must_use]
    pub fn is_busy(&self) -> bool {
        self.flight.is_some() || self.meshes.is_busy() || !self.reopening.is_empty()
    }

    /// How many instances wait for being opened or closed.
    #[cfg(test)]
    pub(crate) fn waiting_to_reopen(&self) -> usize {
        self.reopening.len()
    }

    /// Swaps in what is due. Comes before the frame's [`Bvh::apply`] or after it, but before its [`Bvh::plan`] and [`Bvh::refit`],
    /// with the scene that [`end_frame`](Self::end_frame) gets.
    ///
    /// # Errors
    /// [`RebuildError`], once, if the rebuild that was due came to nothing. The frame can go on as if nothing had been due.
    pub fn begin_frame<I, T: Trails>(
        &mut self,
        scene: &mut Bvh<N, I, W, T>,
    ) -> Result<FrameStart, RebuildError> {
        let mut start = FrameStart::default();
        let is_due = self.flight.as_ref().is_some_and(|flight| flight.left <= 1);
        let meshes = self
            .meshes
            .begin_frame(scene, &self.params, is_due, self.start, &mut start);
        if meshes == Err(RebuildError::Foreign) {
            // What it would have built of the other is still to be built.
            self.taken = None;
        }
        let flight = self.begin_flight(scene, &mut start);
        let most = match start.swapped {
            false => REOPENED,
            true if scene.is_top_large() && self.held < HELD => 0,
            true => 1,
        };
        self.held = if most == 0 { self.held + 1 } else { 0 };
        scene.put_strayed_elsewhere(STRAYED, &mut self.looked);
        let closed = scene.close_for_stages(most);
        self.reopen_some(scene, most - closed);
        flight?;
        meshes?;
        Ok(start)
    }

    /// Swaps in the top level and small meshes.
    fn begin_flight<I, T: Trails>(
        &mut self,
        scene: &mut Bvh<N, I, W, T>,
        start: &mut FrameStart,
    ) -> Result<(), RebuildError> {
        let Some(flight) = &mut self.flight else {
            return Ok(());
        };
        if flight.left > 1 {
            flight.left -= 1;
            return Ok(());
        }
        let built = if let Some(built) = flight.inline.take() {
            start.inline = true;
            Some(built)
        } else {
            let began = Clock::start();
            let waits = self.params.swap == Swap::Deterministic;
            let built = self.worker.as_ref().and_then(|worker| worker.outcome(waits));
            if waits {
                start.waited += began.elapsed();
            }
            built
        };
        let Some(built) = built else {
            return Ok(());
        };
        self.flight = None;
        // What it would have built is still to be built.
        let taken = self.taken.take();
        let (product, time) = built.map_err(|message| {
            // By a worker that has seen no panic.
            self.worker = None;
            RebuildError::Panicked { message }
        })?;
        if let Product::Frame(rebuilt) = product {
            if let Some(gain) = rebuilt.gain_above() {
                self.search.note_gain(gain);
            }
            let (wanted, unfit) = scene
                .install_as(rebuilt, false)
                .map_err(|_| RebuildError::Foreign)?;
            self.meshes.note_lost(unfit);
            let [open, close] = wanted;
            for &index in open.iter().chain(&close) {
                self.reopening.push(index);
            }
            // What is wanted last counts.
            close.iter().for_each(|index| _ = self.to_open.remove(index));
            self.to_open.extend(open);
            self.reopens = Some(scene.now());
        }
        self.taken = taken;
        start.swapped = true;
        start.built = time;
        Ok(())
    }

    /// Opens or closes some of the instances that a rebuilt top level asks it for: as many parts go and come as a node has
    /// children, and each is put in where it costs least, which is as long as what else a frame has time for. Where a part of a
    /// large top level comes in, one in [`HELD`] frames.
    fn reopen_some<I, T: Trails>(&mut self, scene: &mut Bvh<N, I, W, T>, most: usize) {
        if self.reopens.is_some_and(|of| !of.is_of_same(scene.now())) {
            self.reopening = Queue::default();
            self.to_open.clear();
            self.reopened.clear();
        }
        for _ in 0..most {
            if let Some(index) = self.reopening.pop() {
                let opens = self.to_open.remove(&index);
                if scene.reopen_one(index, opens) {
                    self.reopened.push(index);
                }
            }
        }
        // Once for all of them: the tree around is tried for what each of them changed.
        if self.reopening.is_empty() {
            scene.note_reopened(&core::mem::take(&mut self.reopened));
        }
    }

    /// Starts the next rebuild, unless one is under way or there is nothing to build. Comes after the frame's [`Bvh::refit`].
    /// Takes time in proportion to the meshes refitted since the last rebuild started, to the instances of the part of the top
    /// level that is rebuilt, at most [`RebuilderParams::leaves`], and to the triangles of small meshes that are built anew.
    pub fn end_frame<I, T: Trails>(&mut self, scene: &Bvh<N, I, W, T>) {
        let now = scene.now();
        self.search.note_frame(now);
        if self.taken != Some(now) {
            scene.search_again(&mut self.search);
        }
        if self.flight.is_some()
            || (self.taken == Some(now)
                && self.search.is_done()
                && !self.meshes.has_small()
                && !self.meshes.has_resting()
                && !self.meshes.has_lost())
        {
            return;
        }
        let worn = scene.worn_since(&self.params.rebuild, self.taken);
        let strained = scene.strained_since(&self.params.rebuild, self.taken);
        let unsettled = scene.unsettled_since(&self.params.rebuild, self.taken);
        let rests_since = self.search.rests_since();
        self.meshes
            .await_turn([worn, strained, unsettled], rests_since, scene, &self.params);
        let takes_turns = scene.is_top_large() && self.meshes.has_small();
        let is_tops_turn = takes_turns && core::mem::replace(&mut self.is_tops_turn, false);
        let mut top = Vec::new();
        if is_tops_turn {
            top = scene.copy_worn_parts(self.params.rebuild.top, self.params.leaves, &mut self.search);
        }
        let (mut small, mut is_much) = (Vec::new(), false);
        if top.is_empty() {
            (small, is_much) = self.meshes.next_small(scene, &self.params);
        }
        if takes_turns && is_much {
            self.is_tops_turn = true;
        } else if top.is_empty() {
            top = scene.copy_worn_parts(self.params.rebuild.top, self.params.leaves, &mut self.search);
        }
        let job = scene.rebuild_of(top, &small);
        self.taken = Some(now);
        if job.is_empty() {
            return;
        }
        if self.worker.is_none() {
            self.worker = (self.start)().ok();
        }
        let refused = match &self.worker {
            Some(worker) => worker.handover().submit(Job::Frame(job)).err(),
            None => Some(Job::Frame(job)),
        };
        self.flight = Some(Flight {
            left: self.params.after,
            inline: refused.map(build),
        });
    }
}

#[cfg(test)]
mod tests;
