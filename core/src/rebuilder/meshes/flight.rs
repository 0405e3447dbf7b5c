//! A mesh under way: room is made for its triangles, they are copied, its tree is built beside the frames and put in place, a
//! piece in each frame.

use super::super::clock::Clock;
use super::super::worker::{Built, Job, Product, Waste, Worker, build};
use super::super::{FrameStart, RebuildError, RebuilderParams, Swap};
use super::threads::Threads;
use crate::bvh::{Bvh, MeshJob, MeshTree, StageId, Trails};
use crate::node::{Holds, Node};

/// A mesh under way.
#[derive(Debug)]
pub(super) struct Flight<N: Holds, const W: usize> {
    pub id: StageId,
    pub blas: u32,
    /// Whether it is a part of one.
    pub is_part: bool,
    pub at: At<N, W>,
}

/// How far it is.
#[derive(Debug)]
pub(super) enum At<N: Holds, const W: usize> {
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

impl<N: Node<W>, const W: usize> Flight<N, W> {
    /// Brings it on by a frame, at most by as much as `bytes` are left for, and has its stage given up where its builder panicked.
    pub fn step<I, T: Trails>(
        &mut self,
        threads: &mut Threads<N, W>,
        scene: &mut Bvh<N, I, W, T>,
        params: &RebuilderParams,
        bytes: &mut usize,
        start: &mut FrameStart,
    ) -> Result<(), RebuildError> {
        let id = self.id;
        let mut result = Ok(());
        self.at = match core::mem::replace(&mut self.at, At::Over) {
            At::Room(left, worker) => match scene.find_room(id, bytes) {
                None => {
                    threads.leaving.push(worker);
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
                    threads.waste.push(Waste::Job(job));
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
                    threads.waste.push(Waste::Job(job));
                    threads.idle.extend(worker);
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
                            threads.idle.push(worker);
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
            At::Placed(mut tree) if self.is_part => match scene.settle_part(id, &mut tree, bytes) {
                Some(false) => At::Placed(tree),
                _ => {
                    threads.waste.push(Waste::Tree(tree));
                    At::Over
                }
            },
            At::Placed(mut tree) => match scene.place_stage(id, &mut tree, bytes) {
                Some(false) => At::Placed(tree),
                placed => {
                    threads.waste.push(Waste::Tree(tree));
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
        result
    }

    /// The thread that is under way with it.
    pub fn worker(&mut self) -> Option<&mut Worker<N, W>> {
        match &mut self.at {
            At::Room(_, worker) | At::Built(_, worker) | At::Copied(_, Some(worker)) => Some(worker),
            _ => None,
        }
    }
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
