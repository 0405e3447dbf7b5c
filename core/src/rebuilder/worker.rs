//! The thread that builds.

use alloc::string::String;
use alloc::vec::Vec;
use core::any::Any;
use core::time::Duration;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::thread::{self, JoinHandle};

use super::clock::Clock;
use super::handover::{Handover, Outcome};
use crate::bvh::{MeshJob, MeshTree, Rebuild, Rebuilt};
use crate::levels::Levels;
use crate::node::{Holds, Node};

/// What is to be built.
#[derive(Debug)]
pub(super) enum Job<N: Holds, const W: usize> {
    /// The top level, and small bottom levels.
    Frame(Rebuild<N, W>),
    /// A bottom level that is put in place piece by piece.
    Mesh(MeshJob<N>),
    /// Memory for the triangles of such a bottom level.
    Room(MeshJob<N>),
    /// What is not needed any more: giving its memory back takes longer than a frame may.
    Free(Vec<Waste<N>>),
}

/// What is not needed any more, and is only dropped.
#[derive(Debug)]
#[expect(dead_code, reason = "its memory is all that matters")]
pub(super) enum Waste<N: Holds> {
    /// Copied triangles that nobody wants built.
    Job(MeshJob<N>),
    /// A tree that is in place, or not wanted.
    Tree(MeshTree<N>),
    /// Lists of bottom levels that were replaced.
    Lists(Vec<Levels>),
}

/// What was.
#[derive(Debug)]
pub(super) enum Product<N: Holds, const W: usize> {
    /// Of [`Job::Frame`].
    Frame(Rebuilt<N, W>),
    /// Of [`Job::Mesh`].
    Mesh(MeshTree<N>),
    /// Of [`Job::Room`].
    Room(MeshJob<N>),
    /// Of [`Job::Free`].
    Nothing,
}

impl<N: Holds, const W: usize> Product<N, W> {
    /// What nobody wants any more, if it is large.
    pub fn waste(self) -> Option<Waste<N>> {
        match self {
            Self::Mesh(tree) => Some(Waste::Tree(tree)),
            Self::Room(job) => Some(Waste::Job(job)),
            Self::Frame(_) | Self::Nothing => None,
        }
    }
}

/// What was built and the time it took, or what the panic said that ended it.
pub(super) type Built<N, const W: usize> = Result<(Product<N, W>, Duration), String>;

type Shared<N, const W: usize> = Arc<Handover<Job<N, W>, Built<N, W>>>;

/// Builds, here and now.
pub(super) fn build<N: Node<W>, const W: usize>(job: Job<N, W>) -> Built<N, W> {
    let began = Clock::start();
    // The job is all that building touches, and a panic ends it.
    let rebuilt = catch_unwind(AssertUnwindSafe(|| match job {
        Job::Frame(rebuild) => Product::Frame(rebuild.run()),
        Job::Mesh(mesh) => Product::Mesh(mesh.run::<W>()),
        Job::Room(mesh) => Product::Room(mesh.with_room()),
        Job::Free(waste) => {
            drop(waste);
            Product::Nothing
        }
    }));
    rebuilt
        .map(|rebuilt| (rebuilt, began.elapsed()))
        .map_err(|panic| message(&*panic))
}

fn message(panic: &(dyn Any + Send)) -> String {
    if let Some(text) = panic.downcast_ref::<&str>() {
        String::from(*text)
    } else if let Some(text) = panic.downcast_ref::<String>() {
        text.clone()
    } else {
        String::from("(no message)")
    }
}

/// A thread that builds what is handed over until it is dropped, which waits for its end.
#[derive(Debug)]
pub(super) struct Worker<N: Holds, const W: usize> {
    handover: Shared<N, W>,
    thread: Option<JoinHandle<()>>,
}

impl<N: Node<W>, const W: usize> Worker<N, W> {
    /// Starts the thread.
    pub fn start() -> std::io::Result<Self> {
        let handover: Shared<N, W> = Arc::new(Handover::new());
        let own = handover.clone();
        let thread = thread::Builder::new()
            .name(String::from("lightbvh-rebuild"))
            .spawn(move || {
                while let Some(task) = own.next() {
                    task.run(build);
                }
            })?;
        Ok(Self {
            handover,
            thread: Some(thread),
        })
    }

    pub fn handover(&self) -> &Handover<Job<N, W>, Built<N, W>> {
        &self.handover
    }

    /// The outcome of the job under way, waited for where `waits`; `None` where it is not there yet.
    pub fn outcome(&self, waits: bool) -> Option<Built<N, W>> {
        let outcome = match waits {
            true => self.handover.take(),
            false => self.handover.try_take(),
        };
        outcome.map(|outcome| match outcome {
            Outcome::Done(built) => built,
            Outcome::Lost => Err(String::from("the worker ended without a result")),
        })
    }
}

impl<N: Holds, const W: usize> Worker<N, W> {
    /// Lets the thread end by itself.
    pub fn detach(&mut self) {
        self.thread = None;
    }
}

impl<N: Holds, const W: usize> Drop for Worker<N, W> {
    fn drop(&mut self) {
        self.handover.close();
        if let Some(thread) = self.thread.take() {
            // Panics while building are results; one beyond them has left its job lost, which was told.
            drop(thread.join());
        }
    }
}
