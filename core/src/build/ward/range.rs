//! A range of primitives on its way into a node, and how it becomes two.

use core::cmp::Ordering;

use super::bins::{Measure, Plane};
use super::frame::Extent;
use super::primitive::WardPrimitive;
use crate::build::BuildParams;

/// Primitives that become one or more children of a node.
///
/// Every split moves them from one buffer into the other, which takes no branch that hangs on the data.
#[derive(Debug, Default)]
pub(in crate::build) struct Range<'a> {
    /// Where they are.
    pub here: &'a mut [WardPrimitive],
    /// As much room.
    there: &'a mut [WardPrimitive],
    measure: Measure,
}

impl<'a> Range<'a> {
    /// The range of all `here`; `there` is as long. It is measured if it has more than `most_whole` primitives: others
    /// are not split.
    pub fn new(
        here: &'a mut [WardPrimitive],
        there: &'a mut [WardPrimitive],
        extent: &Extent,
        most_whole: usize,
        params: &BuildParams,
    ) -> Self {
        let measure = if here.len() > most_whole {
            Measure::of(here, extent, params)
        } else {
            Measure::default()
        };
        Self { here, there, measure }
    }

    pub fn len(&self) -> usize {
        self.here.len()
    }

    /// Cost of the range, if it may be split.
    pub fn cost(&self) -> f64 {
        self.measure.cost
    }

    /// Splits at the best plane, if there is one and `fits` holds for the number of primitives on the left; else at
    /// `middle`, a number of primitives. A range of at most twice `most_whole` becomes one of `most_whole` and the rest.
    pub fn split(
        self,
        middle: usize,
        fits: impl Fn(usize) -> bool,
        most_whole: usize,
        params: &BuildParams,
    ) -> [Self; 2] {
        let (mut here, mut there, mut extents, mut at) = (self.here, self.there, None, middle);
        if let Some(plane) = &self.measure.plane {
            let (left, both) = partition(here, there, plane);
            core::mem::swap(&mut here, &mut there);
            let axis = plane.axis as usize;
            let wanted = beside_full(left, here.len(), most_whole);
            if !fits(wanted) {
                halve(here, middle, axis);
            } else {
                at = wanted;
                match wanted.cmp(&left) {
                    Ordering::Less => halve(&mut here[..left], wanted, axis),
                    Ordering::Equal => extents = Some(both),
                    Ordering::Greater => halve(&mut here[left..], wanted - left, axis),
                }
            }
        }
        let (left, right) = here.split_at_mut(at);
        let (left_room, right_room) = there.split_at_mut(at);
        let [l, r] = extents.unwrap_or_else(|| [Extent::of(left), Extent::of(right)]);
        [
            Self::new(left, left_room, &l, most_whole, params),
            Self::new(right, right_room, &r, most_whole, params),
        ]
    }

    /// The range as one per primitive.
    pub fn into_single(self) -> impl Iterator<Item = Self> {
        self.here
            .chunks_mut(1)
            .zip(self.there.chunks_mut(1))
            .map(|(here, there)| Self {
                here,
                there,
                ..Self::default()
            })
    }
}

/// Primitives that are moved, then looked at again for their box, while they are in the nearest cache.
const BLOCK: usize = 256;

/// Copies `from` into `to`, those on the left of `plane` to its front in order, the others to its end in reverse order.
/// Returns the number on the left and the boxes of both sides.
pub(super) fn partition(
    from: &[WardPrimitive],
    to: &mut [WardPrimitive],
    plane: &Plane,
) -> (usize, [Extent; 2]) {
    let to = &mut to[..from.len()];
    let (mut left, mut right) = (0, to.len());
    let mut extents = [Extent::EMPTY; 2];
    let grow = |extent: &mut Extent, primitives: &[WardPrimitive]| {
        let more = Extent::of(primitives);
        extent.grow(&more.low, &more.high);
    };
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

/// Where to split `count` primitives that a plane parts after `left`. Up to two nodes' worth are one full node and the rest,
/// on whichever side the plane is nearer to: half full ones would be a sixth more nodes, for no less variance.
fn beside_full(left: usize, count: usize, full: usize) -> usize {
    if full == 1 || count > 2 * full {
        return left;
    }
    let rest = count - full;
    if left.abs_diff(rest) < left.abs_diff(full) {
        rest
    } else {
        full
    }
}

/// Brings the `middle` least along `axis` to the front; of equal ones those of lesser index.
fn halve(range: &mut [WardPrimitive], middle: usize, axis: usize) {
    range.select_nth_unstable_by(middle, |a, b| {
        (a.c[axis], a.index)
            .partial_cmp(&(b.c[axis], b.index))
            .unwrap_or(Ordering::Equal)
    });
}
