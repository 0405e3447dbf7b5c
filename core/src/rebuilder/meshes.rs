//! Large meshes: copied, built beside the frames, and put in place piece by piece.

use alloc::vec::Vec;

use super::clock::Clock;
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
    waiting: Vec<u32>,
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

/// Meshes that are put in place at once, and those that are not.
pub(super) fn parted<N: LightNode<W>, I, const W: usize, T: Trails>(
    worn: Vec<u32>,
    scene: &Bvh<N, I, W, T>,
    params: &RebuilderParams,
) -> (Vec<u32>, Vec<u32>) {
    let mut room = (params.bytes.max(LEAST) / SWEPT) as usize;
    worn.into_iter().partition(|&blas| {
        let count = scene.blas_len(blas);
        let fits = count <= room || scene.is_single_level();
        room -= if fits { count.min(room) } else { 0 };
        fits
    })
}

impl<N, const W: usize> Default for Meshes<N, W> {
    fn default() -> Self {
        Self {
            under_way: Vec::new(),
            waiting: Vec::new(),
            idle: Vec::new(),
            freeing: Vec::new(),
            is_lost: false,
        }
    }
}

impl<N: LightNode<W>, const W: usize> Meshes<N, W> {
    pub fn is_busy(&self) -> bool {
        !self.under_way.is_empty() || !self.waiting.is_empty()
    }

    /// These are to be built, once others are done.
    pub fn await_turn(&mut self, blases: Vec<u32>) {
        for blas in blases {
            let is_known =
                self.waiting.contains(&blas) || self.under_way.iter().any(|flight| flight.blas == blas);
            if !is_known {
                self.waiting.push(blas);
            }
        }
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
        let mut begun = 0;
        while begun < free && !self.waiting.is_empty() {
            let blas = self.waiting.remove(0);
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
        start.under_way = (self.under_way.len() + self.waiting.len()) as u32;
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
