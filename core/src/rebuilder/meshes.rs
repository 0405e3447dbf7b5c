//! Large meshes: copied, built beside the frames, and put in place piece by piece.

use alloc::vec::Vec;

use super::clock::Clock;
use super::queue::Queue;
use super::worker::{Built, Job, Product, Worker, build};
use super::{FrameStart, RebuildError, RebuilderParams, Swap};
use crate::bvh::{Bvh, MeshJob, MeshTree, StageId, Trails};
use crate::node::LightNode;

/// A mesh with at most one triangle for so many bytes is put in place at once: a sweep takes as long for a triangle as so many bytes.
const SWEPT: u32 = 256;
/// Least bytes that a frame copies.
const LEAST: u32 = 1 << 14;

/// The large meshes of one light BVH.
#[derive(Debug)]
pub(super) struct Meshes<N, const W: usize> {
    under_way: Vec<Flight<N, W>>,
    /// Bottom levels that are still to begin.
    waiting: Queue,
    /// Small ones, which are put in place at once, as many as a frame has room for.
    small: Queue,
    /// Threads that have nothing to do, and those that give memory back.
    idle: Vec<Worker<N, W>>,
    freeing: Vec<Worker<N, W>>,
    /// Whether one came to nothing that may still be wanted.
    pub is_lost: bool,
}

/// A mesh under way.
#[derive(Debug)]
struct Flight<N, const W: usize> {
    id: StageId,
    blas: u32,
    at: At<N, W>,
}

/// How far it is.
#[derive(Debug)]
enum At<N, const W: usize> {
    /// Its triangles are copied.
    Copied(MeshJob<N>),
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

/// Most waiting meshes that a frame looks at.
const LOOKED_AT: usize = 256;

impl<N, const W: usize> Default for Meshes<N, W> {
    fn default() -> Self {
        Self {
            under_way: Vec::new(),
            waiting: Queue::default(),
            small: Queue::default(),
            idle: Vec::new(),
            freeing: Vec::new(),
            is_lost: false,
        }
    }
}

impl<N: LightNode<W>, const W: usize> Meshes<N, W> {
    pub fn is_busy(&self) -> bool {
        !self.under_way.is_empty() || !self.waiting.is_empty() || !self.small.is_empty()
    }

    /// Whether small meshes wait.
    pub fn has_small(&self) -> bool {
        !self.small.is_empty()
    }

    /// `worn` are to be built, once others are done. Returns those that are put in place at once, in no more triangles than a frame
    /// may take: all of a single level.
    pub fn await_turn<I, T: Trails>(
        &mut self,
        worn: Vec<u32>,
        scene: &Bvh<N, I, W, T>,
        params: &RebuilderParams,
    ) -> Vec<u32> {
        let all = (params.bytes.max(LEAST) / SWEPT) as usize;
        for blas in worn {
            if scene.blas_len(blas) <= all || scene.is_single_level() {
                self.small.push(blas);
            } else if !self.under_way.iter().any(|flight| flight.blas == blas) {
                self.waiting.push(blas);
            }
        }
        let (mut room, mut now) = (all, Vec::new());
        for _ in 0..LOOKED_AT {
            let Some(blas) = self.small.first() else { break };
            // It may have gone, or been built by another.
            let count = if scene.is_worn(blas, &params.rebuild) {
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
        now
    }

    /// Brings all of them on, by no more than the frame may take.
    pub fn begin_frame<I, T: Trails>(
        &mut self,
        scene: &mut Bvh<N, I, W, T>,
        params: &RebuilderParams,
        thread: fn() -> std::io::Result<Worker<N, W>>,
        start: &mut FrameStart,
    ) -> Result<(), RebuildError> {
        scene.drop_stages_but(|id| self.under_way.iter().any(|flight| flight.id == id));
        for worker in core::mem::take(&mut self.freeing) {
            match worker.outcome(false) {
                Some(_) => self.idle.push(worker),
                None => self.freeing.push(worker),
            }
        }
        let most = params.meshes.max(1) as usize;
        let free = most.saturating_sub(self.under_way.len());
        let (mut begun, mut looked_at) = (0, 0);
        while begun < free && looked_at < LOOKED_AT {
            let Some(blas) = self.waiting.pop() else { break };
            looked_at += 1;
            // It may have gone, or been built by another.
            let is_worn = scene.is_worn(blas, &params.rebuild);
            match is_worn.then(|| scene.begin_stage(blas)).flatten() {
                Some((id, job)) => {
                    let at = At::Copied(job);
                    self.under_way.push(Flight { id, blas, at });
                    begun += 1;
                }
                None => self.is_lost = true,
            }
        }
        let all = params.bytes.max(LEAST) as usize;
        let mut bytes = all;
        let mut result = Ok(());
        let mut flights = core::mem::take(&mut self.under_way);
        for flight in &mut flights {
            if let Err(error) = self.step(flight, scene, params, thread, &mut bytes, start) {
                result = Err(error);
            }
        }
        flights.retain(|flight| !matches!(flight.at, At::Over));
        self.under_way = flights;
        start.copied = (all - bytes) as u32;
        start.under_way = (self.under_way.len() + self.waiting.len() + self.small.len()) as u32;
        result
    }

    fn step<I, T: Trails>(
        &mut self,
        flight: &mut Flight<N, W>,
        scene: &mut Bvh<N, I, W, T>,
        params: &RebuilderParams,
        thread: fn() -> std::io::Result<Worker<N, W>>,
        bytes: &mut usize,
        start: &mut FrameStart,
    ) -> Result<(), RebuildError> {
        let id = flight.id;
        let mut result = Ok(());
        flight.at = match core::mem::replace(&mut flight.at, At::Over) {
            At::Copied(mut job) => match scene.copy_stage(id, &mut job, bytes) {
                Some(true) => self.submit(job, params.after, thread),
                Some(false) => At::Copied(job),
                None => At::Over,
            },
            At::Built(left, worker) if left > 1 => At::Built(left - 1, worker),
            At::Inline(left, built) if left > 1 => At::Inline(left - 1, built),
            At::Built(_, worker) => {
                let began = Clock::start();
                let built = worker.outcome(params.swap == Swap::Deterministic);
                start.waited += began.elapsed();
                match built {
                    Some(built) => {
                        // One that has seen a panic is replaced.
                        if built.is_ok() {
                            self.idle.push(worker);
                        }
                        taken(built, &mut result)
                    }
                    None => At::Built(0, worker),
                }
            }
            At::Inline(_, built) => taken(built, &mut result),
            At::Placed(mut tree) => match scene.place_stage(id, &mut tree, bytes) {
                Some(false) => At::Placed(tree),
                placed => {
                    self.free(tree);
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
            scene.drop_stages_but(|other| other != id);
        }
        if matches!(flight.at, At::Over) {
            let is_adopted = scene.is_adopted(id);
            start.adopted += u32::from(is_adopted);
            self.is_lost |= !is_adopted;
        }
        result
    }

    /// Gives the memory of a tree back, beside the frames where a thread has nothing else to do.
    fn free(&mut self, tree: MeshTree<N>) {
        if let Some(worker) = self.idle.pop() {
            match worker.handover().submit(Job::Free(tree)) {
                Ok(()) => self.freeing.push(worker),
                Err(_) => self.idle.push(worker),
            }
        }
    }

    fn submit(
        &mut self,
        job: MeshJob<N>,
        after: u32,
        thread: fn() -> std::io::Result<Worker<N, W>>,
    ) -> At<N, W> {
        let Some(worker) = self.idle.pop().or_else(|| thread().ok()) else {
            return At::Inline(after, build(Job::Mesh(job)));
        };
        match worker.handover().submit(Job::Mesh(job)) {
            Ok(()) => At::Built(after, worker),
            Err(job) => At::Inline(after, build(job)),
        }
    }
}

/// What a thread has built, to be put in place.
fn taken<N, const W: usize>(built: Built<N, W>, result: &mut Result<(), RebuildError>) -> At<N, W> {
    match built {
        Ok((Product::Mesh(tree), _)) => At::Placed(tree),
        Ok((Product::Frame(_) | Product::Nothing, _)) => At::Over,
        Err(message) => {
            *result = Err(RebuildError::Panicked { message });
            At::Over
        }
    }
}
