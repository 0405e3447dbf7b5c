//! Every interleaving of a frame and its worker, by loom: no job, message or result is lost or dropped twice, and nobody waits
//! for ever (loom reports a deadlock when all threads wait). Each is counted while it lives.
//!
//! `RUSTFLAGS="--cfg loom" cargo test -p lightbvh --features std --profile quick --test handover --target-dir target/loom`
#![cfg(loom)]

extern crate alloc;

// Of the library only this file, so that the rest of its tests need not be compiled with it.
#[path = "../src/bvh/rebuilder/handover.rs"]
#[expect(unreachable_pub, reason = "written for its crate")]
mod handover;

use loom::model;
use loom::sync::Arc;
use loom::sync::atomic::{AtomicUsize, Ordering};
use loom::thread;

use handover::{Handover, Outcome};

/// A value whose life is counted.
#[derive(Debug)]
struct Counted {
    number: usize,
    alive: Arc<AtomicUsize>,
}

impl Counted {
    fn new(number: usize, alive: &Arc<AtomicUsize>) -> Self {
        alive.fetch_add(1, Ordering::Relaxed);
        Self {
            number,
            alive: alive.clone(),
        }
    }
}

impl Drop for Counted {
    fn drop(&mut self) {
        self.alive.fetch_sub(1, Ordering::Relaxed);
    }
}

/// A result, with the numbers of the messages that its job read.
type Answer = (Counted, Vec<usize>);

type Shared = Arc<Handover<Counted, Answer, Counted>>;

/// The messages that a job reads.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Reads {
    Nothing,
    /// Messages that have arrived.
    Some,
    /// All messages, until none follow.
    All,
}

/// A worker that answers 10 times the job's number, and lets go of job number 0.
fn worker(handover: &Shared, alive: &Arc<AtomicUsize>, reads: Reads) -> thread::JoinHandle<Vec<usize>> {
    let (handover, alive) = (handover.clone(), alive.clone());
    thread::spawn(move || {
        let mut seen = Vec::new();
        while let Some(task) = handover.next() {
            let number = task.job.as_ref().expect("a task has its job").number;
            seen.push(number);
            if number > 0 {
                task.run(|job, messages| {
                    let mut read = Vec::new();
                    while reads != Reads::Nothing {
                        let more = messages(reads == Reads::All);
                        read.extend(more.iter().map(|message| message.number));
                        if more.is_empty() || reads == Reads::Some {
                            break;
                        }
                    }
                    (Counted::new(10 * job.number, &alive), read)
                });
            }
        }
        seen
    })
}

fn checked(body: impl Fn(&Shared, &Arc<AtomicUsize>) + Send + Sync + 'static) {
    model(move || {
        let handover = Arc::new(Handover::new());
        let alive = Arc::new(AtomicUsize::new(0));
        body(&handover, &alive);
        drop(handover);
        assert_eq!(alive.load(Ordering::Relaxed), 0, "nothing is left");
    });
}

fn number(outcome: Option<Outcome<Answer>>) -> Option<Outcome<usize>> {
    outcome.map(|outcome| match outcome {
        Outcome::Done((result, _)) => Outcome::Done(result.number),
        Outcome::Lost => Outcome::Lost,
    })
}

/// The messages that the job under way read.
fn read(outcome: Option<Outcome<Answer>>) -> Vec<usize> {
    match outcome {
        Some(Outcome::Done((_, read))) => read,
        _ => panic!("no result"),
    }
}

#[test]
fn each_job_gets_its_result() {
    checked(|handover, alive| {
        let thread = worker(handover, alive, Reads::Nothing);
        assert!(handover.take().is_none(), "nothing to wait for");
        for k in 1..=2 {
            handover.submit(Counted::new(k, alive)).expect("idle");
            assert_eq!(number(handover.take()), Some(Outcome::Done(10 * k)));
        }
        handover.close();
        assert_eq!(thread.join().expect("the worker ends"), [1, 2]);
    });
}

#[test]
fn a_result_not_waited_for_is_there_later() {
    checked(|handover, alive| {
        let thread = worker(handover, alive, Reads::Nothing);
        handover.submit(Counted::new(1, alive)).expect("idle");
        let refused = handover
            .submit(Counted::new(2, alive))
            .expect_err("one at a time");
        assert_eq!(refused.number, 2);
        drop(refused);
        let found = match handover.try_take() {
            Some(early) => Some(early),
            None => handover.take(),
        };
        assert_eq!(number(found), Some(Outcome::Done(10)));
        assert!(handover.try_take().is_none(), "results come once");
        handover.close();
        assert_eq!(thread.join().expect("the worker ends"), [1]);
    });
}

#[test]
fn a_job_let_go_of_is_told_once_and_another_may_follow() {
    checked(|handover, alive| {
        let thread = worker(handover, alive, Reads::Nothing);
        handover.submit(Counted::new(0, alive)).expect("idle");
        assert_eq!(number(handover.take()), Some(Outcome::Lost));
        assert!(handover.try_take().is_none(), "told once");
        handover.submit(Counted::new(1, alive)).expect("idle");
        assert_eq!(number(handover.take()), Some(Outcome::Done(10)));
        handover.close();
        assert_eq!(thread.join().expect("the worker ends"), [0, 1]);
    });
}

#[test]
fn a_job_that_waits_reads_each_message_sent_before_the_frame_waits() {
    checked(|handover, alive| {
        let thread = worker(handover, alive, Reads::All);
        handover.submit(Counted::new(1, alive)).expect("idle");
        for message in 1..=2 {
            handover.send(Counted::new(message, alive));
        }
        assert_eq!(read(handover.take()), [1, 2]);
        handover.close();
        assert_eq!(thread.join().expect("the worker ends"), [1]);
    });
}

#[test]
fn a_message_that_was_not_read_goes_to_no_later_job() {
    checked(|handover, alive| {
        for job in 1..=2 {
            handover.submit(Counted::new(job, alive)).expect("idle");
            let task = handover.next().expect("it was submitted");
            task.run(|job, messages| {
                let read = messages(false).iter().map(|message| message.number).collect();
                (job, read)
            });
            handover.send(Counted::new(7, alive));
            assert!(read(handover.take()).is_empty());
        }
    });
}

#[test]
fn closing_at_any_moment_ends_the_worker() {
    for (job, reads) in [(0, Reads::Nothing), (1, Reads::Nothing), (1, Reads::All)] {
        checked(move |handover, alive| {
            let thread = worker(handover, alive, reads);
            handover.submit(Counted::new(job, alive)).expect("idle");
            handover.close();
            let late = handover.submit(Counted::new(2, alive)).expect_err("closed");
            assert_eq!(late.number, 2);
            assert!(number(handover.take()).is_none(), "nothing comes after the end");
            let seen = thread.join().expect("the worker ends");
            assert!(seen.is_empty() || seen == [job]);
        });
    }
}

/// A frame may wait on one thread while another closes.
#[test]
fn closing_wakes_who_waits() {
    checked(|handover, alive| {
        let thread = worker(handover, alive, Reads::Nothing);
        handover.submit(Counted::new(1, alive)).expect("idle");
        let waiting = {
            let handover = handover.clone();
            thread::spawn(move || number(handover.take()))
        };
        handover.close();
        let found = waiting.join().expect("it ends");
        assert!(found.is_none() || found == Some(Outcome::Done(10)));
        thread.join().expect("the worker ends");
    });
}
