//! Builds in the background.

use lightbvh::Rebuilder;
use lightbvh::bvh::{FrameStart, RebuilderParams, Swap};

use crate::error::{Fault, Status};
use crate::held::{Handle, Held};
use crate::raw;

/// `lightbvh_rebuilder`.
pub type CRebuilder = Held<Rebuilder>;

/// What the start of a frame did: `lightbvh_frame_start`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CFrameStart {
    /// 1 if a new top level was swapped in.
    pub swapped: u32,
    /// Number of meshes that got new trees.
    pub meshes: u32,
}

/// A rebuilder. Its trees are swapped in after `after` frames; once they are ready if it is 0.
#[unsafe(no_mangle)]
pub extern "C" fn lightbvh_rebuilder_create(after: u32) -> *mut CRebuilder {
    let swap = match after {
        0 => Swap::WhenReady,
        _ => Swap::Deterministic,
    };
    let params = RebuilderParams {
        after,
        swap,
        ..RebuilderParams::default()
    };
    Held::create("rebuilder", || Rebuilder::new(params))
}

/// Ends its thread, and frees it.
///
/// # Safety
/// `rebuilder` is null, or what `lightbvh_rebuilder_create` gave, and not used any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_rebuilder_free(rebuilder: *mut CRebuilder) {
    // SAFETY: the caller's promise.
    unsafe { Held::free(rebuilder) }
}

/// Swaps in finished trees.
///
/// # Safety
/// `rebuilder` and `bvh` are null or what their functions gave, and nobody else uses them meanwhile; `start` is null, not
/// aligned, or points to memory of one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_begin_frame(
    rebuilder: *mut CRebuilder,
    bvh: *mut Handle,
    start: *mut CFrameStart,
) -> Status {
    // SAFETY: the caller's promise, here and below.
    unsafe {
        Handle::change(bvh, |bvh| {
            let rebuilder = raw::exclusive(rebuilder, "rebuilder")?;
            let place = match start.is_null() {
                true => None,
                false => Some(raw::place(start, "start")?),
            };
            let begun = rebuilder.run(|rebuilder| rebuilder.begin_frame(bvh))?;
            let begun: FrameStart = begun.map_err(|error| Fault::new(Status::NoRebuild, error))?;
            if let Some(place) = place {
                place.write(CFrameStart {
                    swapped: begun.swapped.into(),
                    meshes: begun.meshes,
                });
            }
            Ok(())
        })
    }
}

/// Starts the next build.
///
/// # Safety
/// As [`lightbvh_begin_frame`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_end_frame(rebuilder: *mut CRebuilder, bvh: *const Handle) -> Status {
    // SAFETY: the caller's promise, here and below.
    unsafe {
        Handle::ask(bvh, |bvh| {
            let rebuilder = raw::exclusive(rebuilder, "rebuilder")?;
            rebuilder.run(|rebuilder| rebuilder.end_frame(bvh))
        })
    }
}
