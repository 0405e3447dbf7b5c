//! What C holds behind a pointer.

use crate::error::{Fault, Status, guard};
use crate::raw;
use crate::scene::Scene;

/// `lightbvh`.
pub type Handle = Held<Scene>;

/// A value that a panic breaks while it is changed: nothing is known of it then, and it can only be freed.
pub struct Held<T> {
    value: T,
    what: &'static str,
    broken: bool,
}

impl<T> Held<T> {
    /// A new one, called `what` in messages; null where making it fails or panics.
    pub(crate) fn create(what: &'static str, make: impl FnOnce() -> Result<T, Fault>) -> *mut Self {
        let mut made = std::ptr::null_mut();
        guard(|| {
            let held = Self {
                value: make()?,
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

    /// The value behind a pointer, called `what` in messages.
    ///
    /// # Safety
    /// `pointer` is null, or what [`Held::create`] gave and nobody changes meanwhile.
    pub(crate) unsafe fn of<'a>(pointer: *const Self, what: &str) -> Result<&'a T, Fault> {
        // SAFETY: the caller's promise.
        unsafe { raw::shared(pointer, what) }?.sound()
    }

    /// Changes the value behind a pointer, called `what` in messages.
    ///
    /// # Safety
    /// `pointer` is null, or what [`Held::create`] gave and nobody else uses meanwhile.
    pub(crate) unsafe fn change<R>(
        pointer: *mut Self,
        what: &str,
        change: impl FnOnce(&mut T) -> Result<R, Fault>,
    ) -> Result<R, Fault> {
        // SAFETY: the caller's promise.
        unsafe { raw::exclusive(pointer, what) }?.run(change)?
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

/// Functions of the header. Their bodies may use pointers by [`raw`] and [`Held`].
macro_rules! functions {
    ($($(#[$doc:meta])* fn $name:ident($($argument:ident: $type:ty),*) $body:block)*) => {$(
        $(#[$doc])*
        ///
        /// # Safety
        /// Each pointer is null, not aligned, or as `lightbvh.h` says.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name($($argument: $type),*) -> $crate::error::Status {
            // SAFETY: the caller's promise.
            $crate::error::guard(|| unsafe { $body })
        }
    )*};
}
pub(crate) use functions;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn after_a_panic_it_can_only_be_freed() {
        let pointer = Held::create("number", || Ok(7));
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
        assert!(Held::create("number", || -> Result<i32, Fault> { panic!("while it was made") }).is_null());
    }
}
