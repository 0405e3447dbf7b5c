//! The threads of meshes, and what they are to give back.

use alloc::vec::Vec;

use super::super::worker::{Job, Product, Waste, Worker, build};
use super::flight::At;
use crate::bvh::MeshJob;
use crate::levels::Levels;
use crate::node::{Holds, Node};

/// Starts a thread.
pub(in crate::rebuilder) type Start<N, const W: usize> = fn() -> std::io::Result<Worker<N, W>>;

/// Threads that are not under way with a mesh.
#[derive(Debug)]
pub(super) struct Threads<N: Holds, const W: usize> {
    /// Those that have nothing to do.
    pub idle: Vec<Worker<N, W>>,
    /// Those whose results nobody waits for.
    pub leaving: Vec<Worker<N, W>>,
    /// What a thread is to give back.
    pub waste: Vec<Waste<N>>,
}

impl<N: Holds, const W: usize> Default for Threads<N, W> {
    fn default() -> Self {
        Self {
            idle: Vec::new(),
            leaving: Vec::new(),
            waste: Vec::new(),
        }
    }
}

impl<N: Node<W>, const W: usize> Threads<N, W> {
    /// Has memory given back beside the frames, by a thread that has nothing else to do.
    pub fn clear_up(&mut self, lists: Vec<Levels>) {
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

    /// Has a thread make room for what is to be copied.
    pub fn make_room(&mut self, job: MeshJob<N>, after: u32, start: Start<N, W>) -> At<N, W> {
        let Some(worker) = self.idle.pop().or_else(|| start().ok()) else {
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
