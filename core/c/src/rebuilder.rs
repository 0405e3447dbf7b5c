//! Rebuilds beside the frames.

use lightbvh::bvh::{FrameStart, RebuilderParams, Swap};
use lightbvh::{MomentNode, Rebuilder};

use crate::error::{Fault, Status};
use crate::handle::Handle;
use crate::held::Held;
use crate::raw;

/// `lightbvh_rebuilder`.
pub type CRebuilder = Held<Rebuilder<MomentNode<8>, 8>>;

/// What the start of a frame did: `lightbvh_frame_start`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CFrameStart {
    /// 1 where parts of the top level or small meshes came in.
    pub swapped: u32,
    /// Large meshes whose trees came in since the last frame.
    pub adopted: u32,
    /// Parts of large meshes that did.
    pub parts: u32,
    /// Trees that came to nothing.
    pub dropped: u32,
    /// Meshes under way, or waiting.
    pub under_way: u32,
    /// Bytes that this call copied for them.
    pub copied: u32,
}

/// A rebuilder: of trees that come in once they are built, or after so many frames.
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

/// Ends its threads, and frees it.
///
/// # Safety
/// `rebuilder` is null, or what `lightbvh_rebuilder_create` gave, and not used any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_rebuilder_free(rebuilder: *mut CRebuilder) {
    // SAFETY: the caller's promise.
    unsafe { Held::free(rebuilder) }
}

/// Puts in place what was built.
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
                    adopted: begun.adopted,
                    parts: begun.parts,
                    dropped: begun.dropped,
                    under_way: begun.under_way,
                    copied: begun.copied,
                });
            }
            Ok(())
        })
    }
}

/// Has what is due built.
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
