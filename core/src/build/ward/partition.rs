//! Moving the primitives of a range to both sides of a plane.

#[cfg(feature = "rayon")]
use rayon::prelude::*;

use super::bins::Plane;
use super::frame::Extent;
use super::primitive::WardPrimitive;

/// Primitives that are moved, then looked at again for their box, while they are in the nearest cache.
const BLOCK: usize = 256;

/// Copies `from` into `to`, those on the left of `plane` to its front in order, the others to its end in reverse order.
/// Returns the number on the left and the boxes of both sides.
pub(super) fn partition(
    from: &[WardPrimitive],
    to: &mut [WardPrimitive],
    plane: &Plane,
) -> (usize, [Extent; 2]) {
    #[cfg(feature = "rayon")]
    if super::is_parallel(from.len()) {
        return in_parallel(from, to, plane);
    }
    let to = &mut to[..from.len()];
    let (mut left, mut right) = (0, to.len());
    let mut extents = [Extent::EMPTY; 2];
    for block in from.chunks(BLOCK) {
        let (left_before, right_before) = (left, right);
        for p in block {
            // Both places are free; one of the copies is written over later.
            to[left] = *p;
            to[right - 1] = *p;
            let is_right = usize::from(plane.is_right(p));
            left += 1 - is_right;
            right -= is_right;
        }
        grow(&mut extents[0], &to[left_before..left]);
        grow(&mut extents[1], &to[right..right_before]);
    }
    (left, extents)
}

fn grow(extent: &mut Extent, primitives: &[WardPrimitive]) {
    let more = Extent::of(primitives);
    extent.grow(&more.low, &more.high);
}

/// The same order as one thread leaves: every piece has its places on both sides.
#[cfg(feature = "rayon")]
fn in_parallel(from: &[WardPrimitive], to: &mut [WardPrimitive], plane: &Plane) -> (usize, [Extent; 2]) {
    use alloc::vec::Vec;

    let lefts: Vec<usize> = from
        .par_chunks(super::CHUNK)
        .map(|piece| piece.iter().map(|p| usize::from(!plane.is_right(p))).sum())
        .collect();
    let left: usize = lefts.iter().sum();
    let (mut front, mut back) = to.split_at_mut(left);
    let pieces: Vec<_> = from
        .chunks(super::CHUNK)
        .zip(lefts)
        .map(|(piece, lefts)| {
            let (left_part, rest) = core::mem::take(&mut front).split_at_mut(lefts);
            front = rest;
            let end = back.len() - (piece.len() - lefts);
            let (rest, right_part) = core::mem::take(&mut back).split_at_mut(end);
            back = rest;
            (piece, left_part, right_part)
        })
        .collect();
    let extents = pieces
        .into_par_iter()
        .map(|(piece, left_part, right_part)| scatter(piece, left_part, right_part, plane))
        .reduce(
            || [Extent::EMPTY; 2],
            |mut a, b| {
                for side in 0..2 {
                    a[side].grow(&b[side].low, &b[side].high);
                }
                a
            },
        );
    (left, extents)
}

/// Copies a piece to its places by way of a block, where a primitive may be written twice.
#[cfg(feature = "rayon")]
fn scatter(
    piece: &[WardPrimitive],
    mut left_part: &mut [WardPrimitive],
    mut right_part: &mut [WardPrimitive],
    plane: &Plane,
) -> [Extent; 2] {
    let mut extents = [Extent::EMPTY; 2];
    let mut moved = [super::NOTHING; BLOCK];
    for block in piece.chunks(BLOCK) {
        let (mut left, mut right) = (0, block.len());
        for p in block {
            moved[left] = *p;
            moved[right - 1] = *p;
            let is_right = usize::from(plane.is_right(p));
            left += 1 - is_right;
            right -= is_right;
        }
        grow(&mut extents[0], &moved[..left]);
        grow(&mut extents[1], &moved[left..block.len()]);
        let (front, rest) = left_part.split_at_mut(left);
        front.copy_from_slice(&moved[..left]);
        left_part = rest;
        let at = right_part.len() - (block.len() - left);
        let (rest, back) = right_part.split_at_mut(at);
        back.copy_from_slice(&moved[left..block.len()]);
        right_part = rest;
    }
    extents
}
