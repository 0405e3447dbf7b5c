//! The queue between a frame and its worker: one job goes in, messages follow it while it runs, one result comes out, and
//! either side may end.
//!
//! Everything lies behind one lock that is held for a few moves of a value only, never while a job runs or a value is
//! dropped. All interleavings are model-checked with loom (`tests/handover.rs`).

use alloc::vec::Vec;
use std::sync::PoisonError;

// The model replaces the primitives where it runs, which is in the test that includes this file.
#[cfg(all(test, loom))]
use loom::sync::{Condvar, Mutex, MutexGuard};
#[cfg(not(all(test, loom)))]
use std::sync::{Condvar, Mutex, MutexGuard};

/// Where the one job is.
#[derive(Debug)]
enum State<J, R> {
    /// There is none.
    Idle,
    /// Waiting for the worker.
    Waiting(J),
    /// With the worker.
    Running,
    /// Done.
    Done(R),
    /// The worker let go of it without a result.
    Lost,
    /// No more jobs.
    Closed,
}

/// The state under the lock.
#[derive(Debug)]
struct Shared<J, R, M> {
    state: State<J, R>,
    /// Messages that the job under way has not read.
    messages: Vec<M>,
    /// Whether the frame waits for the result: no message follows.
    is_awaited: bool,
}

/// One job at a time on its way to a worker and back.
#[derive(Debug)]
pub(super) struct Handover<J, R, M> {
    shared: Mutex<Shared<J, R, M>>,
    /// Signals every change: each of the two sides waits for the other.
    changed: Condvar,
}

/// Outcome of a job.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Outcome<R> {
    /// It was done.
    Done(R),
    /// The worker let go of it, as it does when it panics.
    Lost,
}

/// A job with the worker, who owes a result: dropped without one, the job counts as lost.
#[derive(Debug)]
pub(super) struct Task<'a, J, R, M> {
    handover: &'a Handover<J, R, M>,
    pub(super) job: Option<J>,
    owes: bool,
}

impl<J, R, M> Handover<J, R, M> {
    pub fn new() -> Self {
        Self {
            shared: Mutex::new(Shared {
                state: State::Idle,
                messages: Vec::new(),
                is_awaited: false,
            }),
            changed: Condvar::new(),
        }
    }

    /// Hands a job to the worker; gives it back where one is under way, its outcome has not been taken, or the worker was
    /// told to end.
    pub fn submit(&self, job: J) -> Result<(), J> {
        let mut shared = self.lock();
        if !matches!(shared.state, State::Idle) {
            return Err(job);
        }
        shared.state = State::Waiting(job);
        shared.is_awaited = false;
        // Messages that the last job did not read.
        let unread = core::mem::take(&mut shared.messages);
        self.changed.notify_all();
        drop(shared);
        drop(unread);
        Ok(())
    }

    /// Sends a message to the job under way; if the job does not read it, it is dropped.
    pub fn send(&self, message: M) {
        self.lock().messages.push(message);
        self.changed.notify_all();
    }

    /// The outcome of the job under way, waited for; `None` where there is no job.
    pub fn take(&self) -> Option<Outcome<R>> {
        let mut shared = self.lock();
        shared.is_awaited = true;
        self.changed.notify_all();
        while matches!(shared.state, State::Waiting(_) | State::Running) {
            shared = self.wait(shared);
        }
        Self::taken(&mut shared)
    }

    /// The outcome of the job under way, if it is there by now.
    pub fn try_take(&self) -> Option<Outcome<R>> {
        Self::taken(&mut self.lock())
    }

    fn taken(shared: &mut Shared<J, R, M>) -> Option<Outcome<R>> {
        match core::mem::replace(&mut shared.state, State::Idle) {
            State::Done(result) => Some(Outcome::Done(result)),
            State::Lost => Some(Outcome::Lost),
            other => {
                shared.state = other;
                None
            }
        }
    }

    /// Tells the worker to end after the job that it runs; one that it has not begun is dropped, as is a result that was
    /// not taken.
    pub fn close(&self) {
        let old = core::mem::replace(&mut self.lock().state, State::Closed);
        self.changed.notify_all();
        drop(old);
    }

    /// The worker's next job, waited for; `None` once closed.
    pub fn next(&self) -> Option<Task<'_, J, R, M>> {
        let mut shared = self.lock();
        loop {
            match core::mem::replace(&mut shared.state, State::Running) {
                State::Waiting(job) => {
                    return Some(Task {
                        handover: self,
                        job: Some(job),
                        owes: true,
                    });
                }
                State::Closed => {
                    shared.state = State::Closed;
                    return None;
                }
                other => {
                    shared.state = other;
                    shared = self.wait(shared);
                }
            }
        }
    }

    /// The messages to the running job that it has not read. If `waits`, waits for one, unless none follow.
    fn messages(&self, waits: bool) -> Vec<M> {
        let mut shared = self.lock();
        while waits
            && shared.messages.is_empty()
            && !shared.is_awaited
            && matches!(shared.state, State::Running)
        {
            shared = self.wait(shared);
        }
        core::mem::take(&mut shared.messages)
    }

    /// The worker's last word on its job.
    fn settle(&self, settled: State<J, R>) {
        let mut shared = self.lock();
        // Closed meanwhile, nobody asks any more.
        let unwanted = if matches!(shared.state, State::Running) {
            core::mem::replace(&mut shared.state, settled)
        } else {
            settled
        };
        self.changed.notify_all();
        drop(shared);
        drop(unwanted);
    }

    /// No code that could panic runs under the lock, so what a poisoned one holds is whole.
    fn lock(&self) -> MutexGuard<'_, Shared<J, R, M>> {
        self.shared.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wait<'a>(&self, shared: MutexGuard<'a, Shared<J, R, M>>) -> MutexGuard<'a, Shared<J, R, M>> {
        self.changed.wait(shared).unwrap_or_else(PoisonError::into_inner)
    }
}

impl<J, R, M> Task<'_, J, R, M> {
    /// Runs the job by `work`, which may ask for messages, and passes the result to the frame.
    pub fn run(mut self, work: impl FnOnce(J, &dyn Fn(bool) -> Vec<M>) -> R) {
        if let Some(job) = self.job.take() {
            let result = work(job, &|waits| self.handover.messages(waits));
            self.handover.settle(State::Done(result));
        }
        self.owes = false;
    }
}

impl<J, R, M> Drop for Task<'_, J, R, M> {
    fn drop(&mut self) {
        if self.owes {
            self.handover.settle(State::Lost);
        }
    }
}
