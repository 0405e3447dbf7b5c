//! Arrays that a device holds from frame to frame: what differs is written, and nothing else.

use std::collections::BTreeMap;
use std::ops::Range;

use bytemuck::{Pod, cast_slice};

use crate::vulkan::{Binding, Buffer, Device, Pass, VulkanError};

/// Equal words between two changes that are written with them: a region of its own costs more.
const GAP: usize = 16;

/// Arrays on a device by name, and what they hold there.
#[derive(Default)]
pub(super) struct Held(BTreeMap<&'static str, Array>);

#[derive(Default)]
struct Array {
    words: Vec<u32>,
    buffer: Option<Buffer<u32>>,
}

impl Held {
    /// The array `name` as `data`, once `pass` has run. If `pass` does not run, what is held is not known: begin with a new one.
    pub fn bring<'a, T: Pod>(
        &mut self,
        device: &Device,
        name: &'static str,
        data: &'a [T],
        pass: &mut Pass<'a>,
    ) -> Result<Binding, VulkanError> {
        let words: &'a [u32] = cast_slice(data);
        let held = self.0.entry(name).or_default();
        if !held.buffer.as_mut().is_some_and(|own| own.set_len(words.len())) {
            *held = Array {
                words: Vec::new(),
                buffer: Some(device.buffer(words.len(), words.len() + words.len() / 8)?),
            };
        }
        let Some(buffer) = &held.buffer else {
            unreachable!("just made")
        };
        for range in changes(&held.words, words) {
            pass.write(buffer, range.start, &words[range])?;
        }
        held.words.clear();
        held.words.extend_from_slice(words);
        Ok(buffer.bind().of_elements(size_of::<T>() as u32))
    }
}

/// Words of `now` that differ from those of `then` or come after them, in ranges.
fn changes(then: &[u32], now: &[u32]) -> Vec<Range<usize>> {
    let mut out: Vec<Range<usize>> = Vec::new();
    let mut add = |range: Range<usize>| match out.last_mut() {
        _ if range.is_empty() => {}
        Some(last) if range.start - last.end <= GAP => last.end = range.end,
        _ => out.push(range),
    };
    // Most arrays are equal over long stretches, which are compared as a whole.
    const STRETCH: usize = 512;
    let both = then.len().min(now.len());
    for start in (0..both).step_by(STRETCH) {
        let end = both.min(start + STRETCH);
        if then[start..end] == now[start..end] {
            continue;
        }
        for at in start..end {
            if then[at] != now[at] {
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
        let then: Vec<u32> = (0..1000).collect();
        assert_eq!(changes(&then, &then), []);
        assert_eq!(changes(&then, &then[..7]), []);
        assert_eq!(changes(&[], &then), [0..1000]);
        assert_eq!(changes(&then[..900], &then), [900..1000]);
        let mut now = then.clone();
        for at in [0, 17, 35, 500, 503, 999] {
            now[at] = 7_000;
        }
        // Sixteen words between two changes are written with them, seventeen are not.
        assert_eq!(changes(&then, &now), [0..18, 35..36, 500..504, 999..1000]);
    }
}
