//! The light BVH behind the pointer that C holds.

use lightbvh::LightBvh;

use crate::error::{Fault, Status, guard};
use crate::held::Held;
use crate::raw;

/// `lightbvh`.
pub type Handle = Held<LightBvh>;

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
