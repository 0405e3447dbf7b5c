//! The thread that builds.

use alloc::string::String;
use core::any::Any;
use core::time::Duration;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::thread::{self, JoinHandle};

use super::clock::Clock;
use super::handover::Handover;
use crate::bvh::{Rebuild, Rebuilt};
use crate::node::LightNode;

/// A rebuild and the time it took, or what the panic said that ended it.
pub(super) type Built<N, const W: usize> = Result<(Rebuilt<N, W>, Duration), String>;

type Shared<N, const W: usize> = Arc<Handover<Rebuild<N, W>, Built<N, W>>>;

/// Builds, here and now.
pub(super) fn build<N: LightNode<W>, const W: usize>(job: Rebuild<N, W>) -> Built<N, W> {
    let began = Clock::start();
    // The job is all that building touches, and a panic ends it.
    let rebuilt = catch_unwind(AssertUnwindSafe(|| job.run()));
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
pub(super) struct Worker<N, const W: usize> {
    handover: Shared<N, W>,
    thread: Option<JoinHandle<()>>,
}

impl<N: LightNode<W>, const W: usize> Worker<N, W> {
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

    pub fn handover(&self) -> &Handover<Rebuild<N, W>, Built<N, W>> {
        &self.handover
    }
}

impl<N, const W: usize> Drop for Worker<N, W> {
    fn drop(&mut self) {
        self.handover.close();
        if let Some(thread) = self.thread.take() {
            // Panics while building are results; one beyond them has left its job lost, which was told.
            drop(thread.join());
        }
    }
}
