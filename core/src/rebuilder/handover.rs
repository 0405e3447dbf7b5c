//! The hand-over between a frame and its worker: one job goes in, one result comes out, and either side may go away.
//!
//! Everything lies behind one lock that is held for a few moves of a value only, never while a job runs or a value is
//! dropped. All interleavings are model-checked with loom (`tests/handover.rs`).

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

/// One job at a time on its way to a worker and back.
#[derive(Debug)]
pub(super) struct Handover<J, R> {
    state: Mutex<State<J, R>>,
    /// Told of every change; there are two sides, and each waits for what the other does.
    changed: Condvar,
}

/// What became of a job.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Outcome<R> {
    /// It was done.
    Done(R),
    /// The worker let go of it, as it does when it panics.
    Lost,
}

/// A job with the worker, who owes a result: dropped without one, the job counts as lost.
#[derive(Debug)]
pub(super) struct Task<'a, J, R> {
    handover: &'a Handover<J, R>,
    pub(super) job: Option<J>,
    owes: bool,
}

impl<J, R> Handover<J, R> {
    pub fn new() -> Self {
        Self {
            state: Mutex::new(State::Idle),
            changed: Condvar::new(),
        }
    }

    /// Hands a job to the worker; gives it back where one is under way, its outcome has not been taken, or the worker was
    /// told to end.
    pub fn submit(&self, job: J) -> Result<(), J> {
        let mut state = self.lock();
        if matches!(*state, State::Idle) {
            *state = State::Waiting(job);
            self.changed.notify_all();
            Ok(())
        } else {
            Err(job)
        }
    }

    /// The outcome of the job under way, waited for; `None` where there is no job.
    pub fn take(&self) -> Option<Outcome<R>> {
        let mut state = self.lock();
        while matches!(*state, State::Waiting(_) | State::Running) {
            state = self.wait(state);
        }
        Self::taken(&mut state)
    }

    /// The outcome of the job under way, if it is there by now.
    pub fn try_take(&self) -> Option<Outcome<R>> {
        Self::taken(&mut self.lock())
    }

    fn taken(state: &mut State<J, R>) -> Option<Outcome<R>> {
        match core::mem::replace(state, State::Idle) {
            State::Done(result) => Some(Outcome::Done(result)),
            State::Lost => Some(Outcome::Lost),
            other => {
                *state = other;
                None
            }
        }
    }

    /// Tells the worker to end after the job that it runs; one that it has not begun is dropped, as is a result that was
    /// not taken.
    pub fn close(&self) {
        let old = core::mem::replace(&mut *self.lock(), State::Closed);
        self.changed.notify_all();
        drop(old);
    }

    /// The worker's next job, waited for; `None` once closed.
    pub fn next(&self) -> Option<Task<'_, J, R>> {
        let mut state = self.lock();
        loop {
            match core::mem::replace(&mut *state, State::Running) {
                State::Waiting(job) => {
                    return Some(Task {
                        handover: self,
                        job: Some(job),
                        owes: true,
                    });
                }
                State::Closed => {
                    *state = State::Closed;
                    return None;
                }
                other => {
                    *state = other;
                    state = self.wait(state);
                }
            }
        }
    }

    /// The worker's last word on its job.
    fn settle(&self, settled: State<J, R>) {
        let mut state = self.lock();
        // Closed meanwhile, nobody asks any more.
        let unwanted = if matches!(*state, State::Running) {
            core::mem::replace(&mut *state, settled)
        } else {
            settled
        };
        self.changed.notify_all();
        drop(state);
        drop(unwanted);
    }

    /// No code that could panic runs under the lock, so what a poisoned one holds is whole.
    fn lock(&self) -> MutexGuard<'_, State<J, R>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wait<'a>(&self, state: MutexGuard<'a, State<J, R>>) -> MutexGuard<'a, State<J, R>> {
        self.changed.wait(state).unwrap_or_else(PoisonError::into_inner)
    }
}

impl<J, R> Task<'_, J, R> {
    /// Does the job by `work` and hands the result back.
    pub fn run(mut self, work: impl FnOnce(J) -> R) {
        if let Some(job) = self.job.take() {
            let result = work(job);
            self.handover.settle(State::Done(result));
        }
        self.owes = false;
    }
}

impl<J, R> Drop for Task<'_, J, R> {
    fn drop(&mut self) {
        if self.owes {
            self.handover.settle(State::Lost);
        }
    }
}
