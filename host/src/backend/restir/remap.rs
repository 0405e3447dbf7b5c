//! Lights that changed their numbers between two frames.

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
    /// From the lights that are in both frames, number and instance then and now, out of `then` and `now`
    /// numbers. The instance of a listed light is not read. A number that is out of range or was given before counts as gone: no two lights become one.
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
