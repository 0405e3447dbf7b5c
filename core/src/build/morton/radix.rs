//! Radix sort of codes, each with an index.

use alloc::vec::Vec;

use super::codes::BITS;

/// Bits of a digit; three digits make a code.
const DIGIT: u32 = 10;
const VALUES: usize = 1 << DIGIT;
const _: () = assert!(BITS == 3 * DIGIT);

/// Code in the upper, index in the lower half.
pub(super) fn entry(code: u32, index: usize) -> u64 {
    (u64::from(code) << 32) | index as u64
}

/// Sorts entries whose indices rise by code, and by index where codes are equal: least digit first, keeping the order of
/// equal digits. No two entries are equal, so there is one sorted order however it is found.
pub(super) fn sort(entries: &mut Vec<u64>) {
    let mut room = alloc::vec![0; entries.len()];
    #[cfg(feature = "rayon")]
    if crate::build::ward::is_parallel(entries.len() / 2) {
        let middle = entries.len() / 2;
        let (a, b) = entries.split_at_mut(middle);
        let (a_room, b_room) = room.split_at_mut(middle);
        rayon::join(|| sort_in(a, a_room), || sort_in(b, b_room));
        merge(a_room, b_room, entries);
        return;
    }
    sort_in(entries, &mut room);
    core::mem::swap(entries, &mut room);
}

/// Sorts `from` into `to`.
fn sort_in(from: &mut [u64], to: &mut [u64]) {
    let digit = |entry: u64, pass: usize| (entry >> (32 + DIGIT * pass as u32)) as usize & (VALUES - 1);
    let mut counts = [[0u32; VALUES]; 3];
    for &entry in &*from {
        for pass in 0..3 {
            counts[pass][digit(entry, pass)] += 1;
        }
    }
    let (mut from, mut to) = (from, to);
    for (pass, counts) in counts.iter_mut().enumerate() {
        let mut start = 0;
        for count in counts.iter_mut() {
            start += core::mem::replace(count, start);
        }
        for &entry in &*from {
            let place = &mut counts[digit(entry, pass)];
            to[*place as usize] = entry;
            *place += 1;
        }
        core::mem::swap(&mut from, &mut to);
    }
}

/// Merges two sorted halves, each half of the result by a thread of its own.
#[cfg(feature = "rayon")]
fn merge(a: &[u64], b: &[u64], to: &mut [u64]) {
    let pivot = a[a.len() / 2];
    let (a_low, a_high) = a.split_at(a.len() / 2);
    let (b_low, b_high) = b.split_at(b.partition_point(|&entry| entry < pivot));
    let (to_low, to_high) = to.split_at_mut(a_low.len() + b_low.len());
    rayon::join(
        || merge_in(a_low, b_low, to_low),
        || merge_in(a_high, b_high, to_high),
    );
}

#[cfg(feature = "rayon")]
fn merge_in(a: &[u64], b: &[u64], to: &mut [u64]) {
    let (mut i, mut j) = (0, 0);
    for place in to {
        let (x, y) = (
            a.get(i).copied().unwrap_or(u64::MAX),
            b.get(j).copied().unwrap_or(u64::MAX),
        );
        let is_first = x < y;
        *place = if is_first { x } else { y };
        i += usize::from(is_first);
        j += usize::from(!is_first);
    }
}
