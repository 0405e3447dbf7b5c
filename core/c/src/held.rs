//! What C holds behind a pointer.

use lightbvh::LightBvh;

use crate::error::{Fault, Status, guard};
use crate::raw;

/// `lightbvh`.
pub type Handle = Held<LightBvh>;

/// A value that a panic breaks while it is changed: nothing is known of it then, and it can only be freed.
pub struct Held<T> {
    value: T,
    what: &'static str,
    broken: bool,
}

impl<T> Held<T> {
    /// A new one, called `what` in messages; null where making it panics.
    pub(crate) fn create(what: &'static str, make: impl FnOnce() -> T) -> *mut Self {
        let mut made = std::ptr::null_mut();
        guard(|| {
            let held = Self {
                value: make(),
                what,
                broken: false,
            };
            made = Box::into_raw(Box::new(held));
            Ok(())
        });
        made
    }

    /// Frees one.
    ///
    /// # Safety
    /// `pointer` is null, or what [`Held::create`] gave, and not used any more.
    pub(crate) unsafe fn free(pointer: *mut Self) {
        guard(|| {
            if !pointer.is_null() {
                // SAFETY: the caller's promise: it came out of a box, and goes back once.
                drop(unsafe { Box::from_raw(pointer) });
            }
            Ok(())
        });
    }

    /// The value, unless a panic broke it.
    pub(crate) fn sound(&self) -> Result<&T, Fault> {
        if self.broken {
            let what = self.what;
            let message =
                format!("a function panicked while it changed this {what}; free it and make another");
            return Err(Fault::new(Status::Panicked, message));
        }
        Ok(&self.value)
    }

    /// Runs a change, which breaks the value if it panics.
    pub(crate) fn run<R>(&mut self, change: impl FnOnce(&mut T) -> R) -> Result<R, Fault> {
        self.sound()?;
        self.broken = true;
        let done = change(&mut self.value);
        // Not after a panic.
        self.broken = false;
        Ok(done)
    }
}

impl Handle {
    /// Runs a function that asks.
    ///
    /// # Safety
    /// `bvh` is null or a light BVH that nobody changes meanwhile.
    pub(crate) unsafe fn ask(
        bvh: *const Self,
        question: impl FnOnce(&LightBvh) -> Result<(), Fault>,
    ) -> Status {
        // SAFETY: the caller's promise.
        guard(|| question(unsafe { raw::shared(bvh, "bvh") }?.sound()?))
    }

    /// Runs a function that changes.
    ///
    /// # Safety
    /// `bvh` is null or a light BVH that nobody else uses meanwhile.
    pub(crate) unsafe fn change(
        bvh: *mut Self,
        edit: impl FnOnce(&mut LightBvh) -> Result<(), Fault>,
    ) -> Status {
        // SAFETY: the caller's promise.
        guard(|| unsafe { raw::exclusive(bvh, "bvh") }?.run(edit)?)
    }
}

/// A light BVH without lights.
#[unsafe(no_mangle)]
pub extern "C" fn lightbvh_create() -> *mut Handle {
    Held::create("light BVH", LightBvh::default)
}

/// Frees it.
///
/// # Safety
/// `bvh` is null, or what `lightbvh_create` gave, and not used any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_free(bvh: *mut Handle) {
    // SAFETY: the caller's promise.
    unsafe { Held::free(bvh) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn after_a_panic_it_can_only_be_freed() {
        let pointer = Held::create("number", || 7);
        // SAFETY: it was just made, and is freed last.
        unsafe {
            let held = &mut *pointer;
            assert_eq!(held.run(|number| *number += 1).ok(), Some(()));
            assert_eq!(held.sound().ok(), Some(&8));
            let panicking = guard(|| held.run(|_| panic!("while it ran")));
            assert_eq!(panicking, Status::Panicked);
            assert_eq!(held.run(|_| ()).unwrap_err().status, Status::Panicked);
            let fault = held.sound().unwrap_err();
            assert!(fault.message.contains("this number"), "{}", fault.message);
            Held::free(pointer);
        }
        assert!(Held::create("number", || -> i32 { panic!("while it was made") }).is_null());
    }
}
