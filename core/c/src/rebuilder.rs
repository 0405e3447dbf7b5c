//! Rebuilds beside the frames.

use lightbvh::bvh::{FrameStart, RebuilderParams, Swap};
use lightbvh::{MomentNode, Rebuilder};

use crate::error::{Fault, Status, guard};
use crate::handle::Handle;
use crate::raw;

/// `lightbvh_rebuilder`.
pub struct CRebuilder {
    rebuilder: Rebuilder<MomentNode<8>, 8>,
    /// A call panicked, so nothing is known of it any more.
    broken: bool,
}

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

impl CRebuilder {
    fn new(after: u32) -> Self {
        let swap = match after {
            0 => Swap::WhenReady,
            _ => Swap::Deterministic,
        };
        Self {
            rebuilder: Rebuilder::new(RebuilderParams {
                after,
                swap,
                ..RebuilderParams::default()
            }),
            broken: false,
        }
    }

    /// Runs a call.
    fn run<T>(&mut self, call: impl FnOnce(&mut Rebuilder<MomentNode<8>, 8>) -> T) -> Result<T, Fault> {
        if self.broken {
            let message = "a function panicked while it used this rebuilder; free it and make another";
            return Err(Fault::new(Status::Panicked, message));
        }
        self.broken = true;
        let done = call(&mut self.rebuilder);
        // Not after a panic.
        self.broken = false;
        Ok(done)
    }
}

/// A rebuilder: of trees that come in once they are built, or after so many frames.
#[unsafe(no_mangle)]
pub extern "C" fn lightbvh_rebuilder_create(after: u32) -> *mut CRebuilder {
    let mut made = std::ptr::null_mut();
    guard(|| {
        made = Box::into_raw(Box::new(CRebuilder::new(after)));
        Ok(())
    });
    made
}

/// Ends its threads, and frees it.
///
/// # Safety
/// `rebuilder` is null, or what `lightbvh_rebuilder_create` gave, and not used any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_rebuilder_free(rebuilder: *mut CRebuilder) {
    guard(|| {
        if !rebuilder.is_null() {
            // SAFETY: the caller's promise: it came out of a box, and goes back once.
            drop(unsafe { Box::from_raw(rebuilder) });
        }
        Ok(())
    });
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn after_a_panic_it_can_only_be_freed() {
        let mut own = CRebuilder::new(0);
        assert!(own.run(|_| ()).is_ok());
        let seen = guard(|| own.run(|_| panic!("while it ran")));
        assert_eq!(seen, Status::Panicked);
        assert_eq!(own.run(|_| ()).unwrap_err().status, Status::Panicked);
    }
}
