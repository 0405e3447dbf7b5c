//! Arrays that a device holds from frame to frame: what differs is written, and nothing else.

use std::ops::Range;
use std::sync::Arc;

use bytemuck::{Pod, bytes_of};

use crate::vulkan::{Buffer, Device, Pass, VulkanError};

/// Equal bytes between two changes that are written with them: a region of its own costs more.
const GAP: usize = 64;

/// An array on the device, and what it holds there.
pub(super) struct Held<T> {
    shadow: Vec<T>,
    buffer: Option<Arc<Buffer<T>>>,
}

impl<T> Default for Held<T> {
    fn default() -> Self {
        Self {
            shadow: Vec::new(),
            buffer: None,
        }
    }
}

impl<T: Pod> Held<T> {
    /// The array as `data`, once `pass` has run: the buffer that there is, or, where something else reads that as it was or it is too
    /// small, another one with a copy of what stays.
    pub fn bring<'a>(
        &mut self,
        device: &Device,
        data: &'a [T],
        pass: &mut Pass<'a>,
    ) -> Result<Arc<Buffer<T>>, VulkanError> {
        let changed = changes(&self.shadow, data);
        if let Some(held) = &self.buffer
            && changed.is_empty()
            && self.shadow.len() == data.len()
        {
            return Ok(Arc::clone(held));
        }
        let mut buffer = self.buffer.take();
        let fits = buffer.as_mut().and_then(Arc::get_mut).is_some_and(|own| own.set_len(data.len()));
        let buffer = match buffer {
            Some(buffer) if fits => buffer,
            old => {
                let new = Arc::new(device.buffer(data.len(), data.len())?);
                if let Some(old) = old.filter(|_| changed != [0..data.len()]) {
                    pass.carry(&old, &new);
                }
                new
            }
        };
        for range in &changed {
            pass.write(&buffer, range.start, &data[range.clone()])?;
        }
        self.shadow.resize(data.len(), T::zeroed());
        for range in changed {
            self.shadow[range.clone()].copy_from_slice(&data[range]);
        }
        self.buffer = Some(Arc::clone(&buffer));
        Ok(buffer)
    }
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
        let is_equal = bytemuck::cast_slice::<T, u8>(&then[start..end]) == bytemuck::cast_slice::<T, u8>(&now[start..end]);
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
}
