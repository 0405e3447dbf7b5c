//! Pointers from C, checked as far as a pointer can be.

use std::mem::MaybeUninit;

use lightbvh::error::MAX_LIGHTS;

use crate::error::{Fault, Status};

fn bad(what: &str) -> Fault {
    Fault::new(Status::BadPointer, what)
}

/// A pointer to be read.
///
/// # Safety
/// It is null, not aligned, or points to a `T` that nobody writes meanwhile.
pub(crate) unsafe fn shared<'a, T>(pointer: *const T, what: &str) -> Result<&'a T, Fault> {
    if pointer.is_null() || !pointer.is_aligned() {
        return Err(bad(&format!("{what} is null or not aligned")));
    }
    // SAFETY: neither null nor unaligned; the rest is the caller's promise.
    Ok(unsafe { &*pointer })
}

/// A pointer to be changed.
///
/// # Safety
/// It is null, not aligned, or points to a `T` that nobody else uses meanwhile.
pub(crate) unsafe fn exclusive<'a, T>(pointer: *mut T, what: &str) -> Result<&'a mut T, Fault> {
    if pointer.is_null() || !pointer.is_aligned() {
        return Err(bad(&format!("{what} is null or not aligned")));
    }
    // SAFETY: neither null nor unaligned; the rest is the caller's promise.
    Ok(unsafe { &mut *pointer })
}

/// A place for a result.
///
/// # Safety
/// It is null, not aligned, or points to memory of a `T` that nobody else uses meanwhile.
pub(crate) unsafe fn place<'a, T>(pointer: *mut T, what: &str) -> Result<&'a mut MaybeUninit<T>, Fault> {
    // SAFETY: memory of a `T` is one of a `MaybeUninit<T>`, whatever it holds.
    unsafe { exclusive(pointer.cast::<MaybeUninit<T>>(), what) }
}

/// An array to be read; null where it has no elements.
///
/// # Safety
/// It is null, not aligned, or points to `count` of `T` that nobody writes meanwhile.
pub(crate) unsafe fn array<'a, T>(pointer: *const T, count: usize, what: &str) -> Result<&'a [T], Fault> {
    if count == 0 {
        return Ok(&[]);
    }
    fits::<T>(count, what)?;
    // SAFETY: the caller's promise, of which an array's first element is a part.
    unsafe { shared(pointer, what) }?;
    // SAFETY: not null, aligned, not longer than memory; the rest is the caller's promise.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// An array of no more elements than a light BVH may have lights, to be copied.
///
/// # Safety
/// As [`array`].
pub(crate) unsafe fn at_most<'a, T>(pointer: *const T, count: usize, what: &str) -> Result<&'a [T], Fault> {
    fits::<T>(count, what)?;
    if count > MAX_LIGHTS {
        let message = format!("{count} {what}, expected at most {MAX_LIGHTS}");
        return Err(Fault::new(Status::TooMany, message));
    }
    // SAFETY: the caller's promise.
    unsafe { array(pointer, count, what) }
}

/// An array of plain words to be written; null where it has no elements.
///
/// # Safety
/// It is null, not aligned, or points to memory of `count` of `T` that nobody else uses meanwhile.
pub(crate) unsafe fn places<'a, T>(
    pointer: *mut T,
    count: usize,
    what: &str,
) -> Result<&'a mut [MaybeUninit<T>], Fault> {
    if count == 0 {
        return Ok(&mut []);
    }
    fits::<T>(count, what)?;
    // SAFETY: the caller's promise, of which an array's first element is a part.
    unsafe { place(pointer, what) }?;
    // SAFETY: not null, aligned, not longer than memory; the rest is the caller's promise.
    Ok(unsafe { std::slice::from_raw_parts_mut(pointer.cast(), count) })
}

/// The same, or no places where the pointer is null.
///
/// # Safety
/// As [`places`].
pub(crate) unsafe fn places_if_any<'a, T>(
    pointer: *mut T,
    count: usize,
    what: &str,
) -> Result<&'a mut [MaybeUninit<T>], Fault> {
    let count = if pointer.is_null() { 0 } else { count };
    // SAFETY: the caller's promise.
    unsafe { places(pointer, count, what) }
}

/// Writes the first `capacity` elements of a list, and how many it has.
///
/// # Safety
/// As [`places`], and `count` as [`place`].
pub(crate) unsafe fn list<T>(
    pointer: *mut T,
    capacity: usize,
    count: *mut usize,
    elements: impl ExactSizeIterator<Item = T>,
) -> Result<(), Fault> {
    // SAFETY: the caller's promise.
    let (places, count) = unsafe { (places(pointer, capacity, "results")?, place(count, "count")?) };
    count.write(elements.len());
    for (place, element) in places.iter_mut().zip(elements) {
        place.write(element);
    }
    Ok(())
}

fn fits<T>(count: usize, what: &str) -> Result<(), Fault> {
    match count.checked_mul(size_of::<T>()) {
        Some(bytes) if bytes <= isize::MAX as usize => Ok(()),
        _ => Err(bad(&format!("{what} of {count} elements is beyond all memory"))),
    }
}
