//! Lights that changed their numbers between two frames.

use std::ops::Range;

use lightbvh::{Bvh, LightNode};
use lightbvh_kernels::shading::trace::NONE;

/// Number and instance of a light, as a [`SampledLight`](lightbvh::SampledLight) names it.
type Name = [u32; 2];

const GONE: Name = [NONE; 2];

/// Which lights of the frame before are which of this one's, where lights came, went or changed their number.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LightRemap {
    to_current: Vec<Name>,
    to_previous: Vec<Name>,
}

impl LightRemap {
    /// From the lights that are in both frames, number and instance then and now, out of `then` and `now` numbers. The instance
    /// of a listed light is not read. A number that is out of range or was given before counts as gone: no two lights become
    /// one.
    pub fn new(then: usize, now: usize, kept: impl IntoIterator<Item = (Name, Name)>) -> Self {
        let (mut to_current, mut to_previous) = (vec![GONE; then], vec![GONE; now]);
        for (before, after) in kept {
            let slots = (
                to_current.get_mut(before[0] as usize),
                to_previous.get_mut(after[0] as usize),
            );
            if let (Some(current), Some(previous)) = slots
                && *current == GONE
                && *previous == GONE
            {
                (*current, *previous) = (after, before);
            }
        }
        Self {
            to_current,
            to_previous,
        }
    }

    /// Of a light BVH whose lights went and came since the frame before: `then` is what
    /// [`light_end`](lightbvh::Bvh::light_end) was in that frame, `removed` are all numbers that
    /// [`take_removed_lights`](lightbvh::Bvh::take_removed_lights) has given since. All others are the lights that they were.
    ///
    /// Needed only where numbers were taken between two frames that are resampled, for new lights may have them since. Where
    /// they are taken after the frame was resampled, no number has become another light's, and a frame needs no remap: samples
    /// of lights that are no more find none. Takes time in proportion to the lights.
    pub fn after<N: LightNode<W>, I, const W: usize>(
        bvh: &Bvh<N, I, W>,
        then: u32,
        removed: &[Range<u32>],
    ) -> Self {
        let (then, now) = (then as usize, bvh.light_end() as usize);
        let mut is_new = vec![false; now];
        for range in removed {
            is_new[now.min(range.start as usize)..now.min(range.end as usize)].fill(true);
        }
        let placed = (0..).zip(bvh.instances());
        let placed = placed.filter(|&(index, _)| bvh.instance_id(index).is_some());
        let names = placed.flat_map(|(index, instance)| {
            (instance.first..instance.first + instance.count).map(move |light| [light, index])
        });
        let kept = names.filter(|name| !is_new[name[0] as usize]);
        Self::new(then, now, kept.map(|name| (name, name)))
    }

    /// By number in the frame before.
    pub fn to_current(&self) -> &[Name] {
        &self.to_current
    }

    /// By number now.
    pub fn to_previous(&self) -> &[Name] {
        &self.to_previous
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_remap_is_one_to_one_whatever_it_is_made_from() {
        let first = |names: &[Name]| names.iter().map(|name| name[0]).collect::<Vec<_>>();
        let kept = [(0, 2), (1, NONE), (2, 0), (3, 2), (4, 7), (2, 1)];
        let remap = LightRemap::new(5, 4, kept.map(|(before, after)| ([before; 2], [after; 2])));
        assert_eq!(first(remap.to_current()), [2, NONE, 0, NONE, NONE]);
        assert_eq!(first(remap.to_previous()), [2, NONE, 0, NONE]);
    }

    #[test]
    fn a_remap_carries_instances_both_ways() {
        let kept = [([0, 5], [3, 1]), ([0, 6], [2, 1]), ([1, 5], [9, 0])];
        let remap = LightRemap::new(2, 4, kept);
        assert_eq!(remap.to_current(), [[3, 1], GONE]);
        assert_eq!(remap.to_previous(), [GONE, GONE, GONE, [0, 5]]);
    }
}
