//! Ranges against a search from the first index on; how much of the space is live.

use super::*;

/// The same as a search from the first index on, and no search at all where a million holes are too small.
#[test]
fn the_first_that_fit() {
    let mut ranges = Ranges::default();
    let mut used: Vec<bool> = Vec::new();
    let mut held: Vec<Range<u32>> = Vec::new();
    for i in 0..4000 {
        let random = crate::exact::hash(i);
        if random % 5 < 2 && !held.is_empty() {
            let range = held.swap_remove(random as usize / 8 % held.len());
            used[range.start as usize..range.end as usize].fill(false);
            ranges.give(range);
        } else {
            let count = 1 + (random >> 8) % 9;
            let fits = |start: u32| {
                (start..start + count).all(|at| !used.get(at as usize).is_some_and(|&used| used))
            };
            let first = (0..).find(|&start| fits(start)).expect("at the end");
            let range = ranges.take(count);
            assert_eq!(range, first..first + count);
            used.resize(used.len().max(range.end as usize), false);
            used[range.start as usize..range.end as usize].fill(true);
            held.push(range);
        }
    }
    let mut ranges = Ranges::default();
    ranges.take(2_000_000);
    (0..1_000_000).for_each(|i| ranges.give(2 * i..2 * i + 1));
    (0..1_000_000).for_each(|i| assert_eq!(ranges.take(2).start, 2_000_000 + 2 * i));
}

#[test]
fn what_is_not_taken_is_free() {
    let mut ranges = Ranges::taken(9, alloc::vec![5..7, 2..3, 4..4, 3..4]).expect("they do not overlap");
    assert_eq!(
        [ranges.take(2), ranges.take(2), ranges.take(1)],
        [0..2, 7..9, 4..5]
    );
    assert_eq!((ranges.take(1), ranges.end()), (9..10, 10));
    for wrong in [[0..2, 1..3], [8..10, 0..1]] {
        assert!(Ranges::taken(9, wrong.to_vec()).is_none());
    }
}

/// The space after many edits over the most that was live at once, and over what is live; lengths by `length`, of which about
/// `live` stay in use.
fn space(rounds: u32, live: usize, length: impl Fn(u32) -> u32) -> f64 {
    let mut ranges = Ranges::default();
    let mut held: Vec<Range<u32>> = Vec::new();
    let (mut used, mut most) = (0, 0);
    for i in 0..rounds {
        let random = crate::exact::hash(i);
        while used > live {
            let range = held.swap_remove(crate::exact::hash(random ^ used as u32) as usize % held.len());
            used -= range.len();
            ranges.give(range);
        }
        let range = ranges.take(length(random));
        used += range.len();
        most = most.max(used);
        held.push(range);
    }
    f64::from(ranges.end()) / most as f64
}

/// Where as much comes as goes, the space stays within 1.5 times what is live, whatever the lengths are.
#[test]
fn as_much_comes_as_goes() {
    let uniform = space(200_000, 100_000, |random| 1 + random % 1000);
    let equal = space(200_000, 10_000, |_| 7);
    let powers = space(200_000, 1_000_000, |random| 1 << (random % 14));
    // Many small ones and few large ones.
    let skewed = space(200_000, 1_000_000, |random| {
        if random % 64 == 0 { 20_000 } else { 1 + random % 50 }
    });
    let meshes = space(200_000, 2_000_000, |random| 100_000 / (1 + random % 1000));
    let all = [uniform, equal, powers, skewed, meshes];
    assert!(all.iter().all(|&ratio| ratio < 1.5), "{all:?}");
}
