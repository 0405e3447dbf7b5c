//! The thread that builds.

use alloc::boxed::Box;
use alloc::string::String;
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::any::Any;
use core::time::Duration;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::thread::{self, JoinHandle};

use super::clock::Clock;
use super::handover::{Handover, Outcome};
use crate::build::BuildParams;
use crate::bvh::mesh::MeshTree;
use crate::bvh::top::{Batch, Top};
use crate::node::{Holds, Node};

/// Trees to build.
#[derive(Debug)]
pub(super) enum Work<N: Holds> {
    /// The top level, whose leaves are up to date.
    Top(Box<Top<N>>),
    /// Trees of meshes.
    Meshes(Vec<MeshTree<N>>),
}

/// Work, and how it is done.
#[derive(Debug)]
pub(super) struct Job<N: Holds> {
    pub work: Work<N>,
    pub params: BuildParams,
    /// Whether it applies edits until the frame waits for it, so that its result depends on no clock.
    pub waits: bool,
}

/// Work that was done.
#[derive(Debug)]
pub(super) struct Built<N: Holds> {
    pub work: Work<N>,
    /// Number of batches of edits applied to the top level.
    pub batches: usize,
    pub time: Duration,
}

/// Finished work, or the message of the panic that ended it.
pub(super) type Outcomes<N> = Result<Built<N>, String>;

type Shared<N> = Arc<Handover<Job<N>, Outcomes<N>, Arc<Batch>>>;

/// Builds on this thread, then applies the edits made meanwhile.
pub(super) fn build<N: Node<W>, const W: usize>(
    job: Job<N>,
    edits: &dyn Fn(bool) -> Vec<Arc<Batch>>,
) -> Outcomes<N> {
    let began = Clock::start();
    // The job is all that building touches, and a panic ends it.
    let built = catch_unwind(AssertUnwindSafe(|| {
        let Job {
            mut work,
            params,
            waits,
        } = job;
        let mut batches = 0;
        match &mut work {
            Work::Top(top) => {
                top.build(&params);
                loop {
                    let more = edits(waits);
                    batches += more.len();
                    // Together they are edited sooner; one by one the result does not depend on when they were read.
                    let together = if waits { 1 } else { more.len().max(1) };
                    more.chunks(together).for_each(|some| top.edit(some, &params));
                    if !waits || more.is_empty() {
                        break;
                    }
                }
            }
            Work::Meshes(meshes) => meshes.iter_mut().for_each(|mesh| mesh.build(&params)),
        }
        (work, batches)
    }));
    built
        .map(|(work, batches)| Built {
            work,
            batches,
            time: began.elapsed(),
        })
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

/// A thread that builds submitted jobs. Dropping it waits for its end.
#[derive(Debug)]
pub(super) struct Worker<N: Holds> {
    handover: Shared<N>,
    thread: Option<JoinHandle<()>>,
}

impl<N: Holds> Worker<N> {
    /// Starts the thread.
    pub fn start<const W: usize>() -> std::io::Result<Self>
    where
        N: Node<W>,
    {
        let handover: Shared<N> = Arc::new(Handover::new());
        let own = handover.clone();
        let thread = thread::Builder::new()
            .name(String::from("lightbvh-rebuild"))
            .spawn(move || {
                // A build uses this thread alone: the other threads belong to the frame.
                #[cfg(feature = "rayon")]
                let _pool = rayon::ThreadPoolBuilder::new()
                    .num_threads(1)
                    .use_current_thread()
                    .build();
                while let Some(task) = own.next() {
                    task.run(build::<N, W>);
                }
            })?;
        Ok(Self {
            handover,
            thread: Some(thread),
        })
    }

    /// Submits a job; returns it if one is under way.
    pub fn submit(&self, job: Job<N>) -> Result<(), Job<N>> {
        self.handover.submit(job)
    }

    /// Sends a batch that was edited while the top level is built.
    pub fn send(&self, batch: Arc<Batch>) {
        self.handover.send(batch);
    }

    /// The outcome of the job under way, waited for where `waits`; `None` where it is not there yet.
    pub fn outcome(&self, waits: bool) -> Option<Outcomes<N>> {
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

impl<N: Holds> Drop for Worker<N> {
    fn drop(&mut self) {
        self.handover.close();
        if let Some(thread) = self.thread.take() {
            // A panic in a build is a result; any other leaves its job lost, which is reported.
            drop(thread.join());
        }
    }
}
