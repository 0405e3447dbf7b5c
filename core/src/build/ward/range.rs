//! A range of primitives on its way into a node, and how it becomes two.

use super::bins::Measure;
use super::frame::Extent;
use super::partition::partition;
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

    /// What the range costs, if it is one that may be split.
    pub fn cost(&self) -> f64 {
        self.measure.cost
    }

    /// Splits at the best plane, if there is one and `fits` holds for the number of primitives on the left; else at
    /// `middle`, a number of primitives.
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
            if fits(left) {
                (at, extents) = (left, Some(both));
            } else {
                halve(here, middle, plane.axis as usize);
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

/// Brings the `middle` least along `axis` to the front; of equal ones those of lesser index.
fn halve(range: &mut [WardPrimitive], middle: usize, axis: usize) {
    range.select_nth_unstable_by(middle, |a, b| {
        (a.c[axis], a.index)
            .partial_cmp(&(b.c[axis], b.index))
            .unwrap_or(core::cmp::Ordering::Equal)
    });
}
