//! The staging ring: memory that the host writes and the device copies from, used over and over.
//!
//! A submission's bytes lie one after another in it, and their place is free again once the submission has ended. The ring
//! holds four times the bytes of the largest submission so far, so that with [`IN_FLIGHT`](super::queue::IN_FLIGHT) of them
//! under way the next one finds its place, wherever the ring ends. It grows by powers of two from [`LEAST`] to [`MOST`] and
//! never shrinks; growing waits for nothing. What is more than a part ([`PART`]) goes in several submissions.

use ash::vk;
use gpu_allocator::vulkan::Allocation;
use std::collections::VecDeque;
use std::ops::Range;

/// The smallest ring, bytes.
pub(super) const LEAST: u64 = 64 << 10;
/// The largest ring, bytes.
pub(super) const MOST: u64 = 64 << 20;
/// Submissions' worth of bytes that a ring holds.
const FRAMES: u64 = super::queue::IN_FLIGHT as u64 + 1;
/// Bytes of one submission at most.
pub(super) const PART: u64 = MOST / FRAMES;

/// The buffer, and which of it is in use.
#[derive(Default)]
pub(super) struct Ring {
    /// Null before the first use, as the allocation is none.
    pub buffer: vk::Buffer,
    pub allocation: Option<Allocation>,
    places: Places,
}

impl Ring {
    /// A ring over a mapped buffer of `bytes`.
    pub fn new(buffer: vk::Buffer, allocation: Allocation, bytes: u64) -> Self {
        let allocation = Some(allocation);
        let places = Places {
            bytes,
            ..Places::default()
        };
        Self {
            buffer,
            allocation,
            places,
        }
    }

    /// How large a ring must be instead, where this one is too small for submissions of `bytes`.
    pub fn outgrown(&self, bytes: u64) -> Option<u64> {
        let wanted = (bytes * FRAMES).next_power_of_two().clamp(LEAST, MOST);
        (wanted > self.places.bytes).then_some(wanted)
    }

    /// A place of `bytes`, no more than [`PART`]; none while submissions use too much of the ring.
    pub fn place(&mut self, bytes: u64) -> Option<Range<usize>> {
        self.places.take(bytes)
    }

    /// Submission `number` reads what was placed since the last call.
    pub fn submit(&mut self, number: u64) {
        self.places.submit(number);
    }

    /// Nobody will read what was placed since the last submission.
    pub fn cancel(&mut self) {
        self.places.cancel();
    }

    /// Submissions up to `number` have ended.
    pub fn end(&mut self, number: u64) {
        self.places.end(number);
    }

    /// The bytes of a place.
    pub fn bytes(&mut self, place: Range<usize>) -> Option<&mut [u8]> {
        self.allocation.as_mut()?.mapped_slice_mut()?.get_mut(place)
    }
}

/// Which bytes of a ring are in use. Positions count on from lap to lap.
#[derive(Debug, Default)]
struct Places {
    bytes: u64,
    /// Everything before it is free.
    tail: u64,
    /// Everything from here on is free.
    head: u64,
    /// Of the submissions under way, in order: number, and where their places end.
    used: VecDeque<(u64, u64)>,
}

impl Places {
    fn take(&mut self, bytes: u64) -> Option<Range<usize>> {
        if self.used.is_empty() && self.head == self.tail {
            (self.head, self.tail) = (0, 0);
        }
        let at = self.head % self.bytes.max(1);
        // A place lies in one piece.
        let skipped = if at + bytes > self.bytes {
            self.bytes - at
        } else {
            0
        };
        if self.head + skipped + bytes > self.tail + self.bytes {
            return None;
        }
        self.head += skipped + bytes;
        let start = (at + skipped) % self.bytes.max(1);
        Some(start as usize..(start + bytes) as usize)
    }

    fn submit(&mut self, number: u64) {
        self.used.push_back((number, self.head));
    }

    fn cancel(&mut self) {
        self.head = self.used.back().map_or(self.tail, |(_, end)| *end);
    }

    fn end(&mut self, number: u64) {
        while let Some((_, end)) = self.used.pop_front_if(|(used, _)| *used <= number) {
            self.tail = end;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vulkan::queue::IN_FLIGHT;

    fn places(bytes: u64) -> Places {
        Places {
            bytes,
            ..Places::default()
        }
    }

    #[test]
    fn places_in_use_do_not_overlap() {
        let mut ring = places(1 << 10);
        let mut random = 1_u64;
        let mut live: VecDeque<(u64, Range<usize>)> = VecDeque::new();
        for number in 1..10_000 {
            random = random.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(1);
            let bytes = (random >> 40) % 256 / 4 * 4;
            let place = loop {
                match ring.take(bytes) {
                    Some(place) => break place,
                    None => {
                        let (ended, _) = live.pop_front().expect("a free ring takes a quarter of itself");
                        ring.end(ended);
                    }
                }
            };
            assert!(place.end <= 1 << 10 && place.len() as u64 == bytes);
            for (_, other) in &live {
                assert!(
                    place.is_empty()
                        || other.is_empty()
                        || place.end <= other.start
                        || other.end <= place.start
                );
            }
            ring.submit(number);
            live.push_back((number, place));
            if live.len() == IN_FLIGHT + 3 {
                let (ended, _) = live.pop_front().expect("some");
                ring.end(ended);
            }
        }
    }

    #[test]
    fn a_ring_of_four_frames_has_a_place_for_the_next_while_three_are_under_way() {
        for bytes in (4..=256).step_by(4) {
            let mut ring = places(1 << 10);
            for number in 1..5_000_u64 {
                if let Some(ended) = number.checked_sub(IN_FLIGHT as u64 + 1) {
                    ring.end(ended);
                }
                assert!(ring.take(bytes).is_some(), "{bytes} {number}");
                ring.submit(number);
            }
        }
    }

    #[test]
    fn what_was_not_submitted_is_free_again() {
        let mut ring = places(64);
        assert_eq!(ring.take(16), Some(0..16));
        ring.submit(1);
        assert_eq!(ring.take(40), Some(16..56));
        ring.cancel();
        assert_eq!(ring.take(48), Some(16..64));
        assert_eq!(ring.take(4), None);
        ring.submit(2);
        ring.end(1);
        assert_eq!(ring.take(20), None);
        assert_eq!(ring.take(16), Some(0..16));
        ring.cancel();
        ring.end(2);
        assert_eq!(ring.take(64), Some(0..64));
    }

    #[test]
    fn a_ring_grows_by_powers_of_two_up_to_the_most() {
        let ring = Ring::default();
        assert_eq!(ring.outgrown(4), Some(LEAST));
        assert_eq!(ring.outgrown(LEAST / 4 + 4), Some(2 * LEAST));
        assert_eq!(ring.outgrown(PART), Some(MOST));
        let full = Ring {
            places: places(MOST),
            ..Ring::default()
        };
        assert_eq!(full.outgrown(PART), None);
        assert_eq!(full.outgrown(0), None);
    }
}
