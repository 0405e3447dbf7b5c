//! Bit trails: the slots taken from a root down to a light.

/// The slots taken at each level of one tree, first level in the lowest bits: pbrt-v4's `bitTrail`, 64 bits long and for
/// any width. No shift reaches the word's size.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct BitTrail {
    /// Levels whose bits lie below 32.
    pub low: u32,
    /// The rest.
    pub high: u32,
}

/// Bits that a slot of a `W`-wide node takes, `W` in 2..=16. Slots of three bits leave the two highest bits of a word
/// unused, so that no slot straddles the words.
#[must_use]
pub const fn slot_bits(w: usize) -> u32 {
    match w {
        0..=2 => 1,
        3..=4 => 2,
        5..=8 => 3,
        _ => 4,
    }
}

/// Slots that one word of a trail holds: 32, 16, 10 or 8.
#[must_use]
pub const fn word_levels(w: usize) -> u32 {
    32 / slot_bits(w)
}

/// Greatest number of levels of one tree of `W`-wide nodes: as many as a trail of two words holds. The builders keep to
/// it.
#[must_use]
pub const fn max_levels(w: usize) -> u32 {
    2 * word_levels(w)
}

/// Words that the trails of a tree of `depth` levels take: one, or two.
#[must_use]
pub const fn trail_words(w: usize, depth: u32) -> u32 {
    if depth <= word_levels(w) { 1 } else { 2 }
}

/// The place of `slot` of node `node` of the top level: how [`Links`](crate::tree::Links) name it.
#[inline(always)]
#[must_use]
pub const fn place<const W: usize>(node: u32, slot: u32) -> u32 {
    (node << Width::<W>::BITS) | slot
}

/// Node and slot of a [`place`].
#[inline(always)]
#[must_use]
pub const fn place_parts<const W: usize>(place: u32) -> (u32, u32) {
    (place >> Width::<W>::BITS, place & Width::<W>::MASK)
}

/// Most nodes of a top level, and so most instances: 2^27. Their places are words below 2^31 at any width.
pub const MAX_PLACES: u32 = 1 << 27;

/// The link of a leaf of the top level: an instance as a whole for `part` 0, else the subtree in slot `part - 1` of its mesh's
/// root.
#[inline(always)]
#[must_use]
pub const fn leaf(instance: u32, part: u32) -> u32 {
    (part << MAX_PLACES.trailing_zeros()) | instance
}

/// Instance and part of a [`leaf`].
#[inline(always)]
#[must_use]
pub const fn leaf_parts(link: u32) -> (u32, u32) {
    (link & (MAX_PLACES - 1), link >> MAX_PLACES.trailing_zeros())
}

/// Refuses, when it is compiled, a width whose slots no trail can name.
struct Width<const W: usize>;

impl<const W: usize> Width<W> {
    /// Bits of a slot.
    const BITS: u32 = {
        assert!(W >= 2 && W <= 16, "a node has 2 to 16 children");
        slot_bits(W)
    };
    /// The greatest slot that the bits can name.
    const MASK: u32 = (1 << Self::BITS) - 1;
}

impl BitTrail {
    /// Slot taken at `level` in `0..max_levels(W)`.
    #[inline(always)]
    #[must_use]
    pub fn slot<const W: usize>(self, level: u32) -> u32 {
        let (shift, is_low) = Self::place::<W>(level);
        let word = if is_low { self.low } else { self.high };
        (word >> shift) & Width::<W>::MASK
    }

    /// The trail with `slot` taken at `level` in `0..max_levels(W)`.
    #[inline(always)]
    #[must_use]
    pub fn with<const W: usize>(self, level: u32, slot: u32) -> Self {
        let (shift, is_low) = Self::place::<W>(level);
        let clear = !(Width::<W>::MASK << shift);
        let set = slot << shift;
        if is_low {
            Self {
                low: (self.low & clear) | set,
                high: self.high,
            }
        } else {
            Self {
                low: self.low,
                high: (self.high & clear) | set,
            }
        }
    }

    /// The trail of one level more, with `slot` taken at the first; the others follow it. What is longer than
    /// [`max_levels`] loses its last.
    #[inline(always)]
    #[must_use]
    pub fn behind<const W: usize>(self, slot: u32) -> Self {
        let bits = Width::<W>::BITS;
        let last = bits * (word_levels(W) - 1);
        let kept = Width::<W>::MASK << last | ((1 << last) - 1);
        Self {
            low: ((self.low << bits) | (slot & Width::<W>::MASK)) & kept,
            high: ((self.high << bits) | ((self.low >> last) & Width::<W>::MASK)) & kept,
        }
    }

    /// The lowest bit of the slot at `level` within its word, and whether that is the low word.
    #[inline(always)]
    fn place<const W: usize>(level: u32) -> (u32, bool) {
        let is_low = level < word_levels(W);
        let within = if is_low {
            level
        } else {
            level.wrapping_sub(word_levels(W))
        };
        (within.wrapping_mul(Width::<W>::BITS) & 31, is_low)
    }
}

/// A path through both levels. Positions `0..max_levels(W)` are the levels of the tree that the walk starts in,
/// `max_levels(W)..2·max_levels(W)` those of the bottom level behind an instance; so a greater position is always
/// deeper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Path {
    /// Trail in the tree that the walk starts in.
    pub top: BitTrail,
    /// Trail in the bottom level, if an instance was passed.
    pub bottom: BitTrail,
}

impl Path {
    /// Slot taken at `position`.
    #[inline(always)]
    #[must_use]
    pub fn slot<const W: usize>(self, position: u32) -> u32 {
        let levels = max_levels(W);
        if position < levels {
            self.top.slot::<W>(position)
        } else {
            self.bottom.slot::<W>(position - levels)
        }
    }

    /// The path with `slot` taken at `position`.
    #[inline(always)]
    #[must_use]
    pub fn with<const W: usize>(self, position: u32, slot: u32) -> Self {
        let levels = max_levels(W);
        if position < levels {
            Self {
                top: self.top.with::<W>(position, slot),
                bottom: self.bottom,
            }
        } else {
            Self {
                top: self.top,
                bottom: self.bottom.with::<W>(position - levels, slot),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::Random;

    /// `with` sets one slot, `behind` moves all by a level.
    fn slots_are_kept<const W: usize>() {
        let (random, levels) = (&mut Random(W as u32), max_levels(W));
        let (mut trail, mut slots) = (BitTrail::default(), [0; 64]);
        for round in 0..200 {
            let (level, slot) = (random.below(levels), random.below(W as u32));
            if round % 3 == 0 {
                trail = trail.behind::<W>(slot);
                slots[..levels as usize].rotate_right(1);
                slots[0] = slot;
            } else {
                trail = trail.with::<W>(level, slot);
                slots[level as usize] = slot;
            }
            let is_kept = |level| trail.slot::<W>(level) == slots[level as usize];
            assert!((0..levels).all(is_kept), "{W}");
        }
    }

    #[test]
    fn trails_keep_slots_at_every_width() {
        macro_rules! widths {
            ($($w:literal)*) => { $(slots_are_kept::<$w>();)* };
        }
        widths!(2 3 4 5 6 7 8 9 10 11 12 13 14 15 16);
    }

    #[test]
    fn levels_fill_the_words() {
        let levels = [2, 3, 4, 5, 8, 9, 16].map(max_levels);
        assert_eq!(levels, [64, 32, 32, 20, 20, 16, 16]);
        assert_eq!(
            [trail_words(8, 10), trail_words(8, 11), trail_words(2, 32)],
            [1, 2, 1]
        );
    }
}
