//! Arrays that a device holds from frame to frame: what differs is written, and nothing else.

use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

use bytemuck::{Pod, bytes_of};

use crate::vulkan::{Buffer, Device, Pass, VulkanError};

/// Equal bytes between two changes that are written with them: a region of its own costs more.
const GAP: usize = 64;
/// Changed bytes that are worth looking for elsewhere in what the device holds.
const WORTH_A_SEARCH: usize = 64 << 10;

/// An array on the device, and what it holds there.
pub(super) struct Held<T> {
    shadow: Vec<T>,
    buffer: Option<Arc<Buffer<T>>>,
    /// The buffer before, for the one after this.
    spare: Option<Arc<Buffer<T>>>,
}

impl<T> Default for Held<T> {
    fn default() -> Self {
        Self {
            shadow: Vec::new(),
            buffer: None,
            spare: None,
        }
    }
}

impl<T: Pod> Held<T> {
    /// The array as `data`, once `pass` has run: the buffer that there is, or, where something else reads that as it was or it
    /// is too small, another one with a copy of what stays.
    pub fn bring<'a>(
        &mut self,
        device: &Device,
        data: &'a [T],
        pass: &mut Pass<'a>,
    ) -> Result<Arc<Buffer<T>>, VulkanError> {
        let changed = changes(&self.shadow, data);
        self.follow(device, data, &changed, &[], pass)
    }

    /// [`bring`](Self::bring), where elements change their places from frame to frame: those that the device has somewhere it
    /// copies itself.
    pub fn bring_known<'a>(
        &mut self,
        device: &Device,
        data: &'a [T],
        pass: &mut Pass<'a>,
    ) -> Result<Arc<Buffer<T>>, VulkanError> {
        let changed = changes(&self.shadow, data);
        let elements: usize = changed.iter().map(|range| range.len()).sum();
        if self.buffer.is_none() || elements * size_of::<T>() < WORTH_A_SEARCH {
            return self.follow(device, data, &changed, &[], pass);
        }
        let (known, new) = known(&self.shadow, data, &changed);
        self.follow(device, data, &new, &known, pass)
    }

    /// Writes `new` elements of `data`, and copies `known` ones; the others are where they were.
    fn follow<'a>(
        &mut self,
        device: &Device,
        data: &'a [T],
        new: &[Range<usize>],
        known: &[(usize, Range<usize>)],
        pass: &mut Pass<'a>,
    ) -> Result<Arc<Buffer<T>>, VulkanError> {
        if let Some(held) = &self.buffer
            && new.is_empty()
            && known.is_empty()
            && self.shadow.len() == data.len()
        {
            return Ok(Arc::clone(held));
        }
        let take = |buffer: &mut Option<Arc<Buffer<T>>>| {
            let own = buffer.as_mut().and_then(Arc::get_mut);
            own.is_some_and(|own| own.set_len(data.len()))
                .then(|| buffer.take())
                .flatten()
        };
        let in_place = if known.is_empty() {
            take(&mut self.buffer)
        } else {
            None
        };
        let buffer = match in_place {
            Some(buffer) => buffer,
            None => {
                let other = match take(&mut self.spare) {
                    Some(spare) => spare,
                    None => Arc::new(device.buffer(data.len(), data.len() + data.len() / 8)?),
                };
                if let Some(old) = &self.buffer {
                    let mut parts = known.to_vec();
                    let stays = between(new, known, old.len().min(data.len()));
                    parts.extend(stays.into_iter().map(|range| (range.start, range)));
                    pass.carry_parts(old, &other, &parts)?;
                }
                self.spare = self.buffer.take();
                other
            }
        };
        for range in new {
            pass.write(&buffer, range.start, &data[range.clone()])?;
        }
        self.shadow.clear();
        self.shadow.extend_from_slice(data);
        self.buffer = Some(Arc::clone(&buffer));
        Ok(buffer)
    }
}

/// The elements below `end` that are in none of the ranges.
fn between(new: &[Range<usize>], known: &[(usize, Range<usize>)], end: usize) -> Vec<Range<usize>> {
    let mut taken: Vec<Range<usize>> = new.to_vec();
    taken.extend(known.iter().map(|(_, range)| range.clone()));
    taken.sort_unstable_by_key(|range| range.start);
    let mut out = Vec::new();
    let mut at = 0;
    for range in taken.into_iter().chain(std::iter::once(end..end)) {
        if at < range.start.min(end) {
            out.push(at..range.start.min(end));
        }
        at = at.max(range.end);
    }
    out
}

/// Of the `changed` elements of `now` those that `then` has somewhere, as its first one and their place, and those that it has not.
type Known = (Vec<(usize, Range<usize>)>, Vec<Range<usize>>);

fn known<T: Pod>(then: &[T], now: &[T], changed: &[Range<usize>]) -> Known {
    let places: HashMap<&[u8], usize> = (0..)
        .zip(then)
        .map(|(at, element)| (bytes_of(element), at))
        .collect();
    let places = |at: usize| places.get(bytes_of(&now[at])).copied();
    let (mut known, mut new): Known = Default::default();
    for at in changed.iter().cloned().flatten() {
        // A run goes on as long as it can.
        if let Some((first, place)) = known.last_mut()
            && place.end == at
            && then
                .get(*first + place.len())
                .is_some_and(|next| bytes_of(next) == bytes_of(&now[at]))
        {
            place.end += 1;
        } else if let Some(first) = places(at) {
            known.push((first, at..at + 1));
        } else {
            match new.last_mut() {
                Some(last) if last.end == at => last.end += 1,
                _ => new.push(at..at + 1),
            }
        }
    }
    (known, new)
}

/// Elements of `now` that differ from those of `then` or come after them, in ranges.
fn changes<T: Pod>(then: &[T], now: &[T]) -> Vec<Range<usize>> {
    let mut out: Vec<Range<usize>> = Vec::new();
    let mut add = |range: Range<usize>| match out.last_mut() {
        _ if range.is_empty() => {}
        Some(last) if (range.start - last.end) * size_of::<T>() <= GAP => last.end = range.end,
        _ => out.push(range),
    };
    // Most arrays are equal over long stretches, which are compared as a whole.
    const STRETCH: usize = 64;
    let both = then.len().min(now.len());
    for start in (0..both).step_by(STRETCH) {
        let end = both.min(start + STRETCH);
        let is_equal = bytemuck::cast_slice::<T, u8>(&then[start..end])
            == bytemuck::cast_slice::<T, u8>(&now[start..end]);
        if is_equal {
            continue;
        }
        for at in start..end {
            if bytes_of(&then[at]) != bytes_of(&now[at]) {
                add(at..at + 1);
            }
        }
    }
    add(both..now.len());
    out
}

#[cfg(test)]
// Lists of one range are meant.
#[allow(clippy::single_range_in_vec_init)]
mod tests {
    use super::*;

    #[test]
    fn changes_are_what_differs_and_what_is_new() {
        let then: Vec<[u32; 8]> = (0..1000).map(|i| [i; 8]).collect();
        assert_eq!(changes(&then, &then), []);
        assert_eq!(changes(&then, &then[..7]), []);
        assert_eq!(changes(&[], &then), [0..1000]);
        assert_eq!(changes(&then[..900], &then), [900..1000]);
        let mut now = then.clone();
        for at in [0, 3, 7, 500, 503, 999] {
            now[at][7] = 7_000;
        }
        // Two elements of 32 bytes between two changes are written with them, three are not.
        assert_eq!(changes(&then, &now), [0..4, 7..8, 500..504, 999..1000]);
        let signs = |zero: f32| vec![[zero; 8]; 3];
        assert_eq!(changes(&signs(0.0), &signs(-0.0)), [0..3], "by their bytes");
    }

    #[test]
    fn what_is_known_new_or_where_it_was_makes_the_whole() {
        let then: Vec<u32> = (0..100).collect();
        // Two runs change places, one element is new, ten are gone.
        let mut now: Vec<u32> = (50..80).chain(20..50).chain([7_000]).chain(81..90).collect();
        now.splice(0..0, 0..20);
        let changed = changes(&then, &now);
        let (known, new) = known(&then, &now, &changed);
        let mut made = vec![u32::MAX; now.len()];
        let stays = between(&new, &known, then.len().min(now.len()));
        for (first, place) in known
            .iter()
            .cloned()
            .chain(stays.into_iter().map(|it| (it.start, it)))
        {
            for (k, at) in place.enumerate() {
                assert_eq!(
                    std::mem::replace(&mut made[at], then[first + k]),
                    u32::MAX,
                    "written once"
                );
            }
        }
        for at in new.iter().cloned().flatten() {
            assert_eq!(
                std::mem::replace(&mut made[at], now[at]),
                u32::MAX,
                "written once"
            );
        }
        assert_eq!(made, now);
        assert_eq!(new, [80..81]);
        assert_eq!(known.len(), 2, "{known:?}");
    }
}
