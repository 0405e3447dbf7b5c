//! Lights that are no more, for what keeps numbers of lights over frames.

use crate::error::Status;
use crate::handle::Handle;
use crate::raw;

/// Numbers of lights, one after another: `lightbvh_range`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CRange {
    /// The first of them.
    pub first: u32,
    /// How many they are.
    pub count: u32,
}

/// The numbers of lights that are no more.
///
/// # Safety
/// `bvh` is null or a light BVH that nobody changes meanwhile; `ranges` has memory of `capacity` ranges, `count` of one number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_removed_lights(
    bvh: *const Handle,
    ranges: *mut CRange,
    capacity: usize,
    count: *mut usize,
) -> Status {
    // SAFETY: the caller's promise, here and below.
    unsafe {
        Handle::ask(bvh, |bvh| {
            let places = raw::places(ranges, capacity, "ranges")?;
            let count = raw::place(count, "count")?;
            let removed = bvh.removed_lights();
            for (place, range) in places.iter_mut().zip(removed) {
                place.write(CRange {
                    first: range.start,
                    count: range.end - range.start,
                });
            }
            count.write(removed.len());
            Ok(())
        })
    }
}

/// From now on new lights may get those numbers.
///
/// # Safety
/// `bvh` is null or a light BVH that nobody else uses meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_forget_removed_lights(bvh: *mut Handle) -> Status {
    // SAFETY: the caller's promise.
    unsafe {
        Handle::change(bvh, |bvh| {
            bvh.take_removed_lights();
            Ok(())
        })
    }
}
