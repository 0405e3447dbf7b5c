//! The light BVH behind the pointer that C holds.

use lightbvh::LightBvh;

use crate::error::{Fault, Status, guard};
use crate::raw;

/// `lightbvh`.
pub struct Handle {
    bvh: LightBvh,
    /// A change panicked, so nothing is known of the trees any more.
    broken: bool,
}

impl Handle {
    fn sound(&self) -> Result<(), Fault> {
        if self.broken {
            let message = "a function panicked while it changed this light BVH; free it and make another";
            return Err(Fault::new(Status::Panicked, message));
        }
        Ok(())
    }

    /// Runs a function that asks.
    ///
    /// # Safety
    /// `bvh` is null or a light BVH that nobody changes meanwhile.
    pub(crate) unsafe fn ask(
        bvh: *const Self,
        question: impl FnOnce(&LightBvh) -> Result<(), Fault>,
    ) -> Status {
        guard(|| {
            // SAFETY: the caller's promise.
            let handle = unsafe { raw::shared(bvh, "bvh") }?;
            handle.sound()?;
            question(&handle.bvh)
        })
    }

    /// Runs a function that changes.
    ///
    /// # Safety
    /// `bvh` is null or a light BVH that nobody else uses meanwhile.
    pub(crate) unsafe fn change(
        bvh: *mut Self,
        edit: impl FnOnce(&mut LightBvh) -> Result<(), Fault>,
    ) -> Status {
        guard(|| {
            // SAFETY: the caller's promise.
            let handle = unsafe { raw::exclusive(bvh, "bvh") }?;
            handle.sound()?;
            handle.broken = true;
            let done = edit(&mut handle.bvh);
            // Not after a panic.
            handle.broken = false;
            done
        })
    }
}

/// A light BVH without lights.
#[unsafe(no_mangle)]
pub extern "C" fn lightbvh_create() -> *mut Handle {
    let mut made = std::ptr::null_mut();
    guard(|| {
        let handle = Handle {
            bvh: LightBvh::default(),
            broken: false,
        };
        made = Box::into_raw(Box::new(handle));
        Ok(())
    });
    made
}

/// Frees it.
///
/// # Safety
/// `bvh` is null, or what `lightbvh_create` gave, and not used any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_free(bvh: *mut Handle) {
    guard(|| {
        if !bvh.is_null() {
            // SAFETY: the caller's promise: it came out of a box, and goes back once.
            drop(unsafe { Box::from_raw(bvh) });
        }
        Ok(())
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn after_a_panic_it_can_only_be_freed() {
        let bvh = lightbvh_create();
        // SAFETY: it was just made, and is freed last.
        unsafe {
            assert_eq!(Handle::change(bvh, |_| Ok(())), Status::Ok);
            assert_eq!(Handle::ask(bvh, |_| panic!("while asked")), Status::Panicked);
            assert_eq!(Handle::ask(bvh, |_| Ok(())), Status::Ok);
            assert_eq!(Handle::change(bvh, |_| panic!("while changed")), Status::Panicked);
            assert_eq!(Handle::ask(bvh, |_| Ok(())), Status::Panicked);
            assert_eq!(Handle::change(bvh, |_| Ok(())), Status::Panicked);
            lightbvh_free(bvh);
        }
    }
}
