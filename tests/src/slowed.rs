//! Nodes that can be held up or made to panic while they are built: tests of what happens beside a build get
//! their hold on it without a hook in the library.

use std::cell::Cell;
use std::sync::{Condvar, Mutex, PoisonError};

use bytemuck::{Pod, Zeroable};
use lightbvh::bounds::LightBounds;
use lightbvh::importance::Cluster;
use lightbvh::node::Holds;
use lightbvh::summary::Lanes;
use lightbvh::{BoundsNode, CompactNode, EmissiveTriangle, Node};

/// Number of tests that may use [`Slowed`] in one program; each needs a number of its own.
pub const TESTS: usize = 3;

/// What happens to nodes on threads that are not [`spared`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pace {
    /// Nothing.
    #[default]
    Full,
    /// They wait until the pace changes.
    Held,
    /// They panic.
    Panic,
}

#[derive(Debug, Default)]
struct Control {
    pace: Pace,
    waiting: u32,
}

static CONTROLS: [Mutex<Control>; TESTS] = [const {
    Mutex::new(Control {
        pace: Pace::Full,
        waiting: 0,
    })
}; TESTS];
static CHANGED: [Condvar; TESTS] = [const { Condvar::new() }; TESTS];

thread_local! {
    static SPARED: Cell<bool> = const { Cell::new(false) };
}

/// Exempts the thread that calls: the frame's.
pub fn spare() {
    SPARED.set(true);
}

/// Sets the pace of the nodes of test `TEST`.
pub fn set<const TEST: usize>(pace: Pace) {
    control::<TEST>().pace = pace;
    CHANGED[TEST].notify_all();
}

/// Waits until a thread is held up.
pub fn wait_until_held<const TEST: usize>() {
    let mut control = control::<TEST>();
    while control.waiting == 0 {
        control = CHANGED[TEST]
            .wait(control)
            .unwrap_or_else(PoisonError::into_inner);
    }
}

fn control<const TEST: usize>() -> std::sync::MutexGuard<'static, Control> {
    CONTROLS[TEST].lock().unwrap_or_else(PoisonError::into_inner)
}

fn touch<const TEST: usize>() {
    // Threads of a pool, which have no name, build what edits bring: the frame waits for them.
    if SPARED.get() || std::thread::current().name().is_none() {
        return;
    }
    let mut control = control::<TEST>();
    match control.pace {
        Pace::Full => {}
        Pace::Held => {
            control.waiting += 1;
            CHANGED[TEST].notify_all();
            while control.pace == Pace::Held {
                control = CHANGED[TEST]
                    .wait(control)
                    .unwrap_or_else(PoisonError::into_inner);
            }
            control.waiting -= 1;
        }
        Pace::Panic => {
            drop(control);
            panic!("told to panic");
        }
    }
}

/// A [`CompactNode`] of width 4 that [`set`] governs.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Slowed<const TEST: usize>(CompactNode<4>);

impl<const TEST: usize> Holds for Slowed<TEST> {
    type Light = EmissiveTriangle;
}

impl<const TEST: usize> Node<4> for Slowed<TEST> {
    type Summary = LightBounds;

    const EMPTY: Self = Self(<CompactNode<4> as Node<4>>::EMPTY);
    const NAME: &'static str = "slowed";

    fn kind(&self, slot: usize) -> u32 {
        self.0.kind(slot)
    }
    fn link(&self, slot: usize) -> u32 {
        self.0.link(slot)
    }
    fn summary(&self, slot: usize) -> LightBounds {
        self.0.summary(slot)
    }
    fn set_child(&mut self, slot: usize, kind: u32, link: u32) {
        touch::<TEST>();
        self.0.set_child(slot, kind, link);
    }
    fn relink(&mut self, slot: usize, link: u32) {
        self.0.relink(slot, link);
    }
    fn set_lanes(&mut self, summaries: &Lanes<4>) {
        self.0.set_lanes(summaries);
    }
}

impl<const TEST: usize> BoundsNode<4> for Slowed<TEST> {
    fn cluster(&self, slot: usize) -> Cluster {
        self.0.cluster(slot)
    }
}
