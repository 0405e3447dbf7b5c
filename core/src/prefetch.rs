//! Memory asked for early.

use bytemuck::Pod;

/// Bytes in a line of the caches.
#[cfg(feature = "std")]
const LINE: usize = 64;

/// Asks for an item that will be read soon, line by line; without the feature `std`, for nothing.
#[inline(always)]
pub(crate) fn fetch<T: Pod>(items: &[T], index: u32) {
    #[cfg(feature = "std")]
    {
        let bytes: &[u8] = bytemuck::cast_slice(items);
        // An index out of range, from malformed words, asks for a line that is not read.
        let first = (index as usize).wrapping_mul(size_of::<T>());
        for line in 0..size_of::<T>().div_ceil(LINE) {
            prefetch_index::prefetch_index(bytes, first.wrapping_add(line * LINE));
        }
        // An item need not begin with a line.
        if align_of::<T>() < LINE {
            prefetch_index::prefetch_index(bytes, first.wrapping_add(size_of::<T>() - 1));
        }
    }
    #[cfg(not(feature = "std"))]
    {
        let _ = (items, index);
    }
}
