//! Large meshes: copied, built beside the frames, and put in place piece by piece.

mod flight;
mod threads;

use alloc::vec::Vec;

use self::flight::{At, Flight};
use self::threads::{Start, Threads};
use super::queue::Queue;
use super::worker::Worker;
use super::{FrameStart, RebuildError, RebuilderParams};
use crate::bvh::{Builder, Bvh, HANDED, Trails};
use crate::node::{Holds, Node};

/// A mesh with at most one triangle for so many bytes is put in place at once: a sweep takes as long for a triangle as so many
/// bytes.
const SWEPT: u32 = 256;
/// What a frame copies less where it puts a part of the top level in place, which takes as long as copying all of it does.
const BESIDE: u32 = 4;
/// Least bytes that a frame copies.
const LEAST: u32 = 1 << 14;

/// The large meshes of one light BVH.
#[derive(Debug)]
pub(super) struct Meshes<N: Holds, const W: usize> {
    under_way: Vec<Flight<N, W>>,
    /// Bottom levels that are still to begin.
    waiting: Queue,
    /// Those that changed and are worth keeping, of which parts may not be.
    strained: Queue,
    /// Those of which much changed a little at a time, until they are at rest.
    resting: Queue,
    /// Those whose trees came to nothing since the last frame ended.
    lost: Vec<u32>,
    /// Small ones, which are put in place at once, as many as a frame has room for.
    small: Queue,
    threads: Threads<N, W>,
    /// By which the light BVH knows whose stages are whose.
    builder: Builder,
}

/// Whether a bottom level is to be built anew: it is worn, or much of it changed a little at a time.
fn is_wanted<N: Node<W>, I, const W: usize, T: Trails>(
    scene: &Bvh<N, I, W, T>,
    blas: u32,
    params: &RebuilderParams,
) -> bool {
    scene.is_worn(blas, &params.rebuild) || scene.is_to_rest(blas, &params.rebuild)
}

/// Whether a bottom level gets its tree in one frame, built beside the others of the frame: a small one of few instances, and a
/// single level.
fn is_at_once<N: Node<W>, I, const W: usize, T: Trails>(
    scene: &Bvh<N, I, W, T>,
    blas: u32,
    params: &RebuilderParams,
) -> bool {
    let is_small = scene.blas_len(blas) <= most_at_once(params) && !scene.is_staged_only(blas);
    (is_small && scene.leaves_of_mesh(blas) <= HANDED) || scene.is_single_level()
}

/// Most meshes that a frame searches for a part to be built anew.
const SEARCHED: usize = 2;

/// Most waiting meshes that a frame looks at.
const LOOKED_AT: usize = 256;

impl<N: Holds, const W: usize> Default for Meshes<N, W> {
    fn default() -> Self {
        Self {
            under_way: Vec::new(),
            waiting: Queue::default(),
            strained: Queue::default(),
            resting: Queue::default(),
            lost: Vec::new(),
            small: Queue::default(),
            threads: Threads::default(),
            builder: Builder::default(),
        }
    }
}

impl<N: Node<W>, const W: usize> Meshes<N, W> {
    /// The threads there are.
    pub fn workers(&mut self) -> impl Iterator<Item = &mut Worker<N, W>> {
        let under_way = self.under_way.iter_mut().filter_map(Flight::worker);
        under_way
            .chain(&mut self.threads.idle)
            .chain(&mut self.threads.leaving)
    }

    pub fn is_busy(&self) -> bool {
        !self.under_way.is_empty()
            || !self.waiting.is_empty()
            || !self.strained.is_empty()
            || !self.small.is_empty()
    }

    /// Notes small ones whose trees came to nothing.
    pub fn note_lost(&mut self, lost: Vec<u32>) {
        self.lost.extend(lost);
    }

    /// Whether any came to nothing that may still be wanted.
    pub fn has_lost(&self) -> bool {
        !self.lost.is_empty()
    }

    /// Whether any may be at rest one day.
    pub fn has_resting(&self) -> bool {
        !self.resting.is_empty()
    }

    /// Whether small meshes wait.
    pub fn has_small(&self) -> bool {
        !self.small.is_empty()
    }

    /// Of those refitted lately, `worn` are to be built, once others are done, large ones among `strained` looked at, and
    /// `unsettled` ones built once nothing of them has changed since the epoch `rests_since`.
    pub fn await_turn<I, T: Trails>(
        &mut self,
        [worn, strained, unsettled]: [Vec<u32>; 3],
        rests_since: u64,
        scene: &Bvh<N, I, W, T>,
        params: &RebuilderParams,
    ) {
        let lost = core::mem::take(&mut self.lost).into_iter();
        let lost = lost.filter(|&blas| is_wanted(scene, blas, params));
        let mut worn: Vec<u32> = lost.chain(worn).collect();
        for blas in strained {
            if scene.blas_len(blas) > most_at_once(params) && scene.leaves_of_mesh(blas) <= HANDED {
                self.strained.push(blas);
            }
        }
        unsettled.into_iter().for_each(|blas| self.resting.push(blas));
        for _ in 0..LOOKED_AT.min(self.resting.len()) {
            let Some(blas) = self.resting.pop() else { break };
            match scene.is_to_rest(blas, &params.rebuild) {
                true if scene.is_at_rest(blas, rests_since) => worn.push(blas),
                true => self.resting.push(blas),
                false => {}
            }
        }
        for blas in worn {
            if is_at_once(scene, blas, params) {
                self.small.push(blas);
            } else if !self.is_under_way(blas, false) {
                self.waiting.push(blas);
            }
        }
    }

    fn is_under_way(&self, blas: u32, is_part: bool) -> bool {
        let mut flights = self.under_way.iter();
        flights.any(|flight| flight.blas == blas && flight.is_part == is_part)
    }

    /// Those that are put in place at once next, in no more triangles than a frame may take, all of a single level; and whether
    /// they are so many that nothing else should be.
    pub fn next_small<I, T: Trails>(
        &mut self,
        scene: &Bvh<N, I, W, T>,
        params: &RebuilderParams,
    ) -> (Vec<u32>, bool) {
        let all = most_at_once(params);
        let (mut room, mut now) = (all, Vec::new());
        for _ in 0..LOOKED_AT {
            let Some(blas) = self.small.first() else { break };
            // It may have gone, or been built by another.
            let count = if is_wanted(scene, blas, params) {
                scene.blas_len(blas)
            } else {
                0
            };
            if count > room && !scene.is_single_level() {
                break;
            }
            self.small.pop();
            if count > 0 {
                room -= count.min(room);
                now.push(blas);
            }
        }
        now.sort_unstable();
        (now, room < all / 2)
    }

    /// Brings all of them on, by no more than the frame may take, and a part [`BESIDE`] of it where it `shares` the frame with
    /// a part of the top level that comes in.
    pub fn begin_frame<I, T: Trails>(
        &mut self,
        scene: &mut Bvh<N, I, W, T>,
        params: &RebuilderParams,
        shares: bool,
        thread: Start<N, W>,
        start: &mut FrameStart,
    ) -> Result<(), RebuildError> {
        let flights = &self.under_way;
        let is_shared =
            scene.drop_stages_but(&self.builder, |id| flights.iter().any(|flight| flight.id == id));
        self.threads.clear_up(scene.take_retired());
        let most = params.meshes.max(1) as usize;
        let mut free = most.saturating_sub(self.under_way.len());
        if is_shared && !self.waiting.is_empty() {
            // Those of the other come first; its trees may be what these wait for.
            start.is_second = true;
            free = 0;
        }
        let (mut begun, mut looked_at) = (0, 0);
        while begun < free && looked_at < LOOKED_AT {
            let Some(blas) = self.waiting.pop() else { break };
            looked_at += 1;
            if self.is_under_way(blas, true) {
                // The part comes first.
                self.waiting.push(blas);
                break;
            }
            if scene.is_handed_over(blas) {
                // Its instances follow the last one first.
                self.waiting.push(blas);
                continue;
            }
            // It may have gone, or been built by another.
            let is_wanted = is_wanted(scene, blas, params);
            // What is not worn is asked for again where it gets worse.
            if let Some((id, job)) = is_wanted
                .then(|| scene.begin_stage(blas, &self.builder))
                .flatten()
            {
                let at = self.threads.make_room(job, params.after, thread);
                self.under_way.push(Flight {
                    id,
                    blas,
                    is_part: false,
                    at,
                });
                begun += 1;
            }
        }
        if begun < free {
            self.begin_part(scene, params, thread);
        }
        let all = params.bytes / if shares { BESIDE } else { 1 };
        let all = all.max(LEAST) as usize;
        let mut bytes = all;
        let mut result = Ok(());
        let mut flights = core::mem::take(&mut self.under_way);
        for flight in &mut flights {
            let mut stepped = flight.step(&mut self.threads, scene, params, &mut bytes, start);
            if matches!(flight.at, At::Over) && !scene.has(flight.id) && stepped.is_ok() {
                stepped = Err(RebuildError::Foreign);
            }
            if let Err(error) = stepped {
                result = Err(error);
            }
        }
        self.under_way = flights;
        let is_over = |flight: &Flight<N, W>| matches!(flight.at, At::Over);
        while let Some(at) = self.under_way.iter().position(is_over) {
            let flight = self.under_way.remove(at);
            self.note_over(&flight, scene, params, start);
        }
        scene.hand_over_some(HANDED);
        start.copied = (all - bytes) as u32;
        let waiting = self.waiting.len() + self.small.len();
        start.under_way = (self.under_way.len() + waiting + scene.handing_over()) as u32;
        result
    }

    /// Counts one that is over, and has its mesh looked at again.
    fn note_over<I, T: Trails>(
        &mut self,
        flight: &Flight<N, W>,
        scene: &Bvh<N, I, W, T>,
        params: &RebuilderParams,
        start: &mut FrameStart,
    ) {
        let is_adopted = scene.is_adopted(flight.id);
        let count = match (is_adopted, flight.is_part) {
            (true, false) => &mut start.adopted,
            (true, true) => &mut start.parts,
            (false, _) => &mut start.dropped,
        };
        *count += 1;
        // Nobody asks for it again: what changed while it was built may have worn the new tree already, and what came to
        // nothing is as worn as it was. A mesh of which a part found no tree may have other parts.
        match (flight.is_part, is_adopted) {
            (true, true) => {}
            (true, false) => self.strained.push(flight.blas),
            (false, true) => {
                let new = scene.follower_of(flight.blas);
                // It may have been asked for, and begun, since it was put in place.
                let is_due =
                    |&blas: &u32| scene.is_worn(blas, &params.rebuild) && !self.is_under_way(blas, false);
                if let Some(blas) = new.filter(is_due) {
                    self.waiting.push(blas);
                }
            }
            (false, false) => self.lost.push(flight.blas),
        }
    }

    /// Begins the next part of a mesh that has one to be built anew.
    fn begin_part<I, T: Trails>(
        &mut self,
        scene: &mut Bvh<N, I, W, T>,
        params: &RebuilderParams,
        thread: Start<N, W>,
    ) {
        let bytes = params.bytes.max(LEAST) as usize;
        for _ in 0..SEARCHED {
            let Some(blas) = self.strained.pop() else { break };
            if let Some((id, job)) = scene.begin_part(blas, &self.builder, &params.rebuild, bytes) {
                let at = self.threads.make_room(job, params.after, thread);
                self.under_way.push(Flight {
                    id,
                    blas,
                    is_part: true,
                    at,
                });
                break;
            }
        }
    }
}

/// Triangles of small meshes that are put in place at once.
fn most_at_once(params: &RebuilderParams) -> usize {
    (params.bytes.max(LEAST) / SWEPT) as usize
}
