//! Large meshes: copied, built beside the frames, and put in place piece by piece.

use alloc::vec::Vec;

use super::clock::Clock;
use super::queue::Queue;
use super::worker::{Built, Job, Product, Waste, Worker, build};
use super::{FrameStart, RebuildError, RebuilderParams, Swap};
use crate::bvh::{Builder, Bvh, HANDED, MeshJob, MeshTree, StageId, Trails};
use crate::levels::Levels;
use crate::node::{Holds, Node};

/// A mesh with at most one triangle for so many bytes is put in place at once: a sweep takes as long for a triangle as so many
/// bytes.
const SWEPT: u32 = 256;
/// What a frame copies less where it puts a part of the top level in place, which takes as long as copying all of it does.
const BESIDE: u32 = 4;
/// Least bytes that a frame copies.
const LEAST: u32 = 1 << 14;

/// The large meshes of one light BVH.
#[derive(Debug)]
pub(super) struct Meshes<N: Holds, const W: usize> {
    under_way: Vec<Flight<N, W>>,
    /// Bottom levels that are still to begin.
    waiting: Queue,
    /// Those that changed and are worth keeping, of which parts may not be.
    strained: Queue,
    /// Those of which much changed a little at a time, until they are at rest.
    resting: Queue,
    /// Those whose trees came to nothing since the last frame ended.
    lost: Vec<u32>,
    /// Small ones, which are put in place at once, as many as a frame has room for.
    small: Queue,
    /// Threads that have nothing to do, and those whose results nobody waits for.
    idle: Vec<Worker<N, W>>,
    leaving: Vec<Worker<N, W>>,
    /// What a thread is to give back.
    waste: Vec<Waste<N>>,
    /// By which the light BVH knows whose stages are whose.
    builder: Builder,
}

/// A mesh under way.
#[derive(Debug)]
struct Flight<N: Holds, const W: usize> {
    id: StageId,
    blas: u32,
    /// Whether it is a part of one.
    is_part: bool,
    at: At<N, W>,
}

/// How far it is.
#[derive(Debug)]
enum At<N: Holds, const W: usize> {
    /// Room is made for its triangles, here and, after so many frames, by a thread.
    Room(u32, Worker<N, W>),
    /// The same where no thread could be started: as many frames pass, so that trees do not depend on that.
    RoomHere(u32, MeshJob<N>),
    /// Its triangles are copied, for a thread if any could be started.
    Copied(MeshJob<N>, Option<Worker<N, W>>),
    /// It is built by a thread, and due after so many frames.
    Built(u32, Worker<N, W>),
    /// It was built here, for no thread could be started.
    Inline(u32, Built<N, W>),
    /// Its tree is put in place.
    Placed(MeshTree<N>),
    /// What changed meanwhile is refitted.
    Settled,
    /// Its tree is in place, or it is not wanted any more.
    Over,
}

/// What a thread made, and the time that was waited for it; none where it is not to be waited for.
fn outcome<N: Node<W>, const W: usize>(
    worker: &Worker<N, W>,
    params: &RebuilderParams,
    start: &mut FrameStart,
) -> Option<Built<N, W>> {
    let waits = params.swap == Swap::Deterministic;
    let began = Clock::start();
    let made = worker.outcome(waits);
    if waits {
        start.waited += began.elapsed();
    }
    made
}

/// Whether a bottom level is to be built anew: it is worn, or much of it changed a little at a time.
fn is_wanted<N: Node<W>, I, const W: usize, T: Trails>(
    scene: &Bvh<N, I, W, T>,
    blas: u32,
    params: &RebuilderParams,
) -> bool {
    scene.is_worn(blas, &params.rebuild) || scene.is_to_rest(blas, &params.rebuild)
}

/// Whether a bottom level gets its tree in one frame, built beside the others of the frame: a small one of few instances, and a
/// single level.
fn is_at_once<N: Node<W>, I, const W: usize, T: Trails>(
    scene: &Bvh<N, I, W, T>,
    blas: u32,
    params: &RebuilderParams,
) -> bool {
    let is_small = scene.blas_len(blas) <= most_at_once(params) && !scene.is_staged_only(blas);
    (is_small && scene.leaves_of_mesh(blas) <= HANDED) || scene.is_single_level()
}

/// Most meshes that a frame searches for a part to be built anew.
const SEARCHED: usize = 2;

/// Most waiting meshes that a frame looks at.
const LOOKED_AT: usize = 256;

impl<N: Holds, const W: usize> Default for Meshes<N, W> {
    fn default() -> Self {
        Self {
            under_way: Vec::new(),
            waiting: Queue::default(),
            strained: Queue::default(),
            resting: Queue::default(),
            lost: Vec::new(),
            small: Queue::default(),
            idle: Vec::new(),
            leaving: Vec::new(),
            waste: Vec::new(),
            builder: Builder::default(),
        }
    }
}

impl<N: Node<W>, const W: usize> Meshes<N, W> {
    /// The threads there are.
    pub fn workers(&mut self) -> impl Iterator<Item = &mut Worker<N, W>> {
        let under_way = self
            .under_way
            .iter_mut()
            .filter_map(|flight| match &mut flight.at {
                At::Room(_, worker) | At::Built(_, worker) | At::Copied(_, Some(worker)) => Some(worker),
                _ => None,
            });
        under_way.chain(&mut self.idle).chain(&mut self.leaving)
    }

    pub fn is_busy(&self) -> bool {
        !self.under_way.is_empty()
            || !self.waiting.is_empty()
            || !self.strained.is_empty()
            || !self.small.is_empty()
    }

    /// Notes small ones whose trees came to nothing.
    pub fn note_lost(&mut self, lost: Vec<u32>) {
        self.lost.extend(lost);
    }

    /// Whether any came to nothing that may still be wanted.
    pub fn has_lost(&self) -> bool {
        !self.lost.is_empty()
    }

    /// Whether any may be at rest one day.
    pub fn has_resting(&self) -> bool {
        !self.resting.is_empty()
    }

    /// Whether small meshes wait.
    pub fn has_small(&self) -> bool {
        !self.small.is_empty()
    }

    /// Of those refitted lately, `worn` are to be built, once others are done, large ones among `strained` looked at, and
    /// `unsettled` ones built once nothing of them has changed since the epoch `rests_since`.
    pub fn await_turn<I, T: Trails>(
        &mut self,
        [worn, strained, unsettled]: [Vec<u32>; 3],
        rests_since: u64,
        scene: &Bvh<N, I, W, T>,
        params: &RebuilderParams,
    ) {
        let lost = core::mem::take(&mut self.lost).into_iter();
        let lost = lost.filter(|&blas| is_wanted(scene, blas, params));
        let mut worn: Vec<u32> = lost.chain(worn).collect();
        for blas in strained {
            if scene.blas_len(blas) > most_at_once(params) && scene.leaves_of_mesh(blas) <= HANDED {
                self.strained.push(blas);
            }
        }
        unsettled.into_iter().for_each(|blas| self.resting.push(blas));
        for _ in 0..LOOKED_AT.min(self.resting.len()) {
            let Some(blas) = self.resting.pop() else { break };
            match scene.is_to_rest(blas, &params.rebuild) {
                true if scene.is_at_rest(blas, rests_since) => worn.push(blas),
                true => self.resting.push(blas),
                false => {}
            }
        }
        for blas in worn {
            if is_at_once(scene, blas, params) {
                self.small.push(blas);
            } else if !self.is_under_way(blas, false) {
                self.waiting.push(blas);
            }
        }
    }

    fn is_under_way(&self, blas: u32, is_part: bool) -> bool {
        let mut flights = self.under_way.iter();
        flights.any(|flight| flight.blas == blas && flight.is_part == is_part)
    }

    /// Those that are put in place at once next, in no more triangles than a frame may take, all of a single level; and whether
    /// they are so many that nothing else should be.
    pub fn next_small<I, T: Trails>(
        &mut self,
        scene: &Bvh<N, I, W, T>,
        params: &RebuilderParams,
    ) -> (Vec<u32>, bool) {
        let all = most_at_once(params);
        let (mut room, mut now) = (all, Vec::new());
        for _ in 0..LOOKED_AT {
            let Some(blas) = self.small.first() else { break };
            // It may have gone, or been built by another.
            let count = if is_wanted(scene, blas, params) {
                scene.blas_len(blas)
            } else {
                0
            };
            if count > room && !scene.is_single_level() {
                break;
            }
            self.small.pop();
            if count > 0 {
                room -= count.min(room);
                now.push(blas);
            }
        }
        now.sort_unstable();
        (now, room < all / 2)
    }

    /// Brings all of them on, by no more than the frame may take, and a part [`BESIDE`] of it where it `shares` the frame with
    /// a part of the top level that comes in.
    pub fn begin_frame<I, T: Trails>(
        &mut self,
        scene: &mut Bvh<N, I, W, T>,
        params: &RebuilderParams,
        shares: bool,
        thread: fn() -> std::io::Result<Worker<N, W>>,
        start: &mut FrameStart,
    ) -> Result<(), RebuildError> {
        let flights = &self.under_way;
        let is_shared =
            scene.drop_stages_but(&self.builder, |id| flights.iter().any(|flight| flight.id == id));
        self.clear_up(scene.take_retired());
        let most = params.meshes.max(1) as usize;
        let mut free = most.saturating_sub(self.under_way.len());
        if is_shared && !self.waiting.is_empty() {
            // Those of the other come first; its trees may be what these wait for.
            start.is_second = true;
            free = 0;
        }
        let (mut begun, mut looked_at) = (0, 0);
        while begun < free && looked_at < LOOKED_AT {
            let Some(blas) = self.waiting.pop() else { break };
            looked_at += 1;
            if self.is_under_way(blas, true) {
                // The part comes first.
                self.waiting.push(blas);
                break;
            }
            if scene.is_handed_over(blas) {
                // Its instances follow the last one first.
                self.waiting.push(blas);
                continue;
            }
            // It may have gone, or been built by another.
            let is_wanted = is_wanted(scene, blas, params);
            // What is not worn is asked for again where it gets worse.
            if let Some((id, job)) = is_wanted
                .then(|| scene.begin_stage(blas, &self.builder))
                .flatten()
            {
                let at = self.make_room(job, params.after, thread);
                self.under_way.push(Flight {
                    id,
                    blas,
                    is_part: false,
                    at,
                });
                begun += 1;
            }
        }
        if begun < free {
            self.begin_part(scene, params, thread);
        }
        let all = params.bytes / if shares { BESIDE } else { 1 };
        let all = all.max(LEAST) as usize;
        let mut bytes = all;
        let mut result = Ok(());
        let mut flights = core::mem::take(&mut self.under_way);
        for flight in &mut flights {
            if let Err(error) = self.step(flight, scene, params, &mut bytes, start) {
                result = Err(error);
            }
        }
        flights.retain(|flight| !matches!(flight.at, At::Over));
        self.under_way = flights;
        scene.hand_over_some(HANDED);
        start.copied = (all - bytes) as u32;
        let waiting = self.waiting.len() + self.small.len();
        start.under_way = (self.under_way.len() + waiting + scene.handing_over()) as u32;
        result
    }

    fn step<I, T: Trails>(
        &mut self,
        flight: &mut Flight<N, W>,
        scene: &mut Bvh<N, I, W, T>,
        params: &RebuilderParams,
        bytes: &mut usize,
        start: &mut FrameStart,
    ) -> Result<(), RebuildError> {
        let id = flight.id;
        let mut result = Ok(());
        flight.at = match core::mem::replace(&mut flight.at, At::Over) {
            At::Room(left, worker) => match scene.find_room(id, bytes) {
                None => {
                    self.leaving.push(worker);
                    At::Over
                }
                Some(_) if left > 1 => At::Room(left - 1, worker),
                Some(false) => At::Room(0, worker),
                Some(true) => {
                    let made = outcome(&worker, params, start);
                    match made {
                        Some(Ok((Product::Room(job), _))) => At::Copied(job, Some(worker)),
                        Some(made) => taken(made, &mut result),
                        None => At::Room(0, worker),
                    }
                }
            },
            At::RoomHere(left, job) => match scene.find_room(id, bytes) {
                None => {
                    self.waste.push(Waste::Job(job));
                    At::Over
                }
                Some(_) if left > 1 => At::RoomHere(left - 1, job),
                Some(false) => At::RoomHere(0, job),
                Some(true) => At::Copied(job, None),
            },
            At::Copied(mut job, worker) => match scene.copy_stage(id, &mut job, bytes) {
                Some(true) => submit(job, params.after, worker),
                Some(false) => At::Copied(job, worker),
                None => {
                    self.waste.push(Waste::Job(job));
                    self.idle.extend(worker);
                    At::Over
                }
            },
            At::Built(left, worker) if left > 1 => {
                scene.expect_nodes(id, bytes);
                At::Built(left - 1, worker)
            }
            At::Inline(left, built) if left > 1 => {
                scene.expect_nodes(id, bytes);
                At::Inline(left - 1, built)
            }
            At::Built(_, worker) => {
                let built = outcome(&worker, params, start);
                match built {
                    Some(built) => {
                        // One that has seen a panic is replaced.
                        if built.is_ok() {
                            self.idle.push(worker);
                        }
                        taken(built, &mut result)
                    }
                    None => {
                        scene.expect_nodes(id, bytes);
                        At::Built(0, worker)
                    }
                }
            }
            At::Inline(_, built) => taken(built, &mut result),
            At::Placed(mut tree) if flight.is_part => match scene.settle_part(id, &mut tree, bytes) {
                Some(false) => At::Placed(tree),
                _ => {
                    self.waste.push(Waste::Tree(tree));
                    At::Over
                }
            },
            At::Placed(mut tree) => match scene.place_stage(id, &mut tree, bytes) {
                Some(false) => At::Placed(tree),
                placed => {
                    self.waste.push(Waste::Tree(tree));
                    placed.map_or(At::Over, |_| At::Settled)
                }
            },
            At::Settled => match scene.settle_stage(id, bytes) {
                Some(false) => At::Settled,
                _ => At::Over,
            },
            At::Over => At::Over,
        };
        if result.is_err() {
            scene.give_up(id);
        }
        if matches!(flight.at, At::Over) {
            if !scene.has(id) && result.is_ok() {
                result = Err(RebuildError::Foreign);
            }
            let is_adopted = scene.is_adopted(id);
            let count = match (is_adopted, flight.is_part) {
                (true, false) => &mut start.adopted,
                (true, true) => &mut start.parts,
                (false, _) => &mut start.dropped,
            };
            *count += 1;
            // Nobody asks for it again: what changed while it was built may have worn the new tree already, and what came to
            // nothing is as worn as it was. A mesh of which a part found no tree may have other parts.
            match (flight.is_part, is_adopted) {
                (true, true) => {}
                (true, false) => self.strained.push(flight.blas),
                (false, true) => {
                    let new = scene.follower_of(flight.blas);
                    if let Some(blas) = new.filter(|&blas| scene.is_worn(blas, &params.rebuild)) {
                        self.waiting.push(blas);
                    }
                }
                (false, false) => self.lost.push(flight.blas),
            }
        }
        result
    }

    /// Begins the next part of a mesh that has one to be built anew.
    fn begin_part<I, T: Trails>(
        &mut self,
        scene: &mut Bvh<N, I, W, T>,
        params: &RebuilderParams,
        thread: fn() -> std::io::Result<Worker<N, W>>,
    ) {
        let bytes = params.bytes.max(LEAST) as usize;
        for _ in 0..SEARCHED {
            let Some(blas) = self.strained.pop() else { break };
            if let Some((id, job)) = scene.begin_part(blas, &self.builder, &params.rebuild, bytes) {
                let at = self.make_room(job, params.after, thread);
                self.under_way.push(Flight {
                    id,
                    blas,
                    is_part: true,
                    at,
                });
                break;
            }
        }
    }

    /// Has memory given back beside the frames, by a thread that has nothing else to do.
    fn clear_up(&mut self, lists: Vec<Levels>) {
        for worker in core::mem::take(&mut self.leaving) {
            match worker.outcome(false) {
                Some(Ok((product, _))) => {
                    self.waste.extend(product.waste());
                    self.idle.push(worker);
                }
                // One that has seen a panic is replaced.
                Some(Err(_)) => {}
                None => self.leaving.push(worker),
            }
        }
        if !lists.is_empty() {
            self.waste.push(Waste::Lists(lists));
        }
        if self.waste.is_empty() {
            return;
        }
        if let Some(worker) = self.idle.pop() {
            let waste = core::mem::take(&mut self.waste);
            match worker.handover().submit(Job::Free(waste)) {
                Ok(()) => self.leaving.push(worker),
                Err(_) => self.idle.push(worker),
            }
        }
    }

    /// A thread that makes room for what is to be copied.
    fn make_room(
        &mut self,
        job: MeshJob<N>,
        after: u32,
        thread: fn() -> std::io::Result<Worker<N, W>>,
    ) -> At<N, W> {
        let Some(worker) = self.idle.pop().or_else(|| thread().ok()) else {
            return At::RoomHere(after, job);
        };
        match worker.handover().submit(Job::Room(job)) {
            Ok(()) => At::Room(after, worker),
            Err(job) => match build(job) {
                Ok((Product::Room(job), _)) => At::RoomHere(after, job),
                _ => At::Over,
            },
        }
    }
}

/// Has what was copied built by a thread, or here where there is none.
fn submit<N: Node<W>, const W: usize>(job: MeshJob<N>, after: u32, worker: Option<Worker<N, W>>) -> At<N, W> {
    let Some(worker) = worker else {
        return At::Inline(after, build(Job::Mesh(job)));
    };
    match worker.handover().submit(Job::Mesh(job)) {
        Ok(()) => At::Built(after, worker),
        Err(job) => At::Inline(after, build(job)),
    }
}

/// Triangles of small meshes that are put in place at once.
fn most_at_once(params: &RebuilderParams) -> usize {
    (params.bytes.max(LEAST) / SWEPT) as usize
}

/// What a thread has built, to be put in place.
fn taken<N: Holds, const W: usize>(built: Built<N, W>, result: &mut Result<(), RebuildError>) -> At<N, W> {
    match built {
        Ok((Product::Mesh(tree), _)) => At::Placed(tree),
        Ok((Product::Frame(_) | Product::Room(_) | Product::Nothing, _)) => At::Over,
        Err(message) => {
            *result = Err(RebuildError::Panicked { message });
            At::Over
        }
    }
}
