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

/// Bits that a slot of a `W`-wide node takes: a power of two, so that no slot straddles the words.
#[must_use]
pub const fn slot_bits(w: usize) -> u32 {
    match w {
        0..=2 => 1,
        3..=4 => 2,
        _ => 4,
    }
}

/// Greatest number of levels of one tree of `W`-wide nodes: as many as a trail holds. The builders keep to it.
#[must_use]
pub const fn max_levels(w: usize) -> u32 {
    64 / slot_bits(w)
}

/// Words of a trail in trees of at most `depth` levels: 1 where one holds it, else 2.
#[must_use]
pub const fn trail_words(w: usize, depth: u32) -> u32 {
    if depth * slot_bits(w) <= 32 { 1 } else { 2 }
}

impl BitTrail {
    /// Slot taken at `level` in `0..max_levels(W)`.
    #[inline(always)]
    #[must_use]
    pub fn slot<const W: usize>(self, level: u32) -> u32 {
        let bit = level * slot_bits(W);
        let word = if bit < 32 { self.low } else { self.high };
        (word >> (bit & 31)) & ((1 << slot_bits(W)) - 1)
    }

    /// The trail with `slot` taken at `level` in `0..max_levels(W)`.
    #[inline(always)]
    #[must_use]
    pub fn with<const W: usize>(self, level: u32, slot: u32) -> Self {
        let bit = level * slot_bits(W);
        let shift = bit & 31;
        let clear = !(((1u32 << slot_bits(W)) - 1) << shift);
        let set = slot << shift;
        if bit < 32 {
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
