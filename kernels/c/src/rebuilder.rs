//! Builds in the background.

use lightbvh::Rebuilder;
use lightbvh::bvh::{RebuilderParams, Swap};

use crate::error::{Fault, Status};
use crate::held::{Handle, functions};
use crate::raw;
use crate::scene::by_model;

/// What the start of a frame did: `lightbvh_frame_start`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CFrameStart {
    pub swapped: u32,
    pub meshes: u32,
}

functions! {
    /// When trees are swapped in: after `frames`, or once they are ready if it is 0.
    fn lightbvh_swap_after(bvh: *mut Handle, frames: u32) {
        let swap = if frames == 0 { Swap::WhenReady } else { Swap::Deterministic };
        let params = RebuilderParams { after: frames, swap, ..RebuilderParams::default() };
        Handle::change(bvh, "bvh", |scene| {
            by_model!(scene, _bvh, own => *own = Rebuilder::new(params));
            Ok(())
        })
    }

    /// Swaps in finished trees.
    fn lightbvh_begin_frame(bvh: *mut Handle, start: *mut CFrameStart) {
        let places = raw::places_if_any(start, 1, "start")?;
        let begin = |scene: &mut _| {
            let begun = by_model!(scene, bvh, own => own.begin_frame(bvh));
            begun.map_err(|error| Fault::new(Status::NoRebuild, error))
        };
        let begun = Handle::change(bvh, "bvh", begin)?;
        let start = CFrameStart { swapped: begun.swapped.into(), meshes: begun.meshes };
        places.iter_mut().for_each(|place| _ = place.write(start));
        Ok(())
    }

    /// Starts the next build.
    fn lightbvh_end_frame(bvh: *mut Handle) {
        Handle::change(bvh, "bvh", |scene| {
            by_model!(scene, bvh, own => own.end_frame(bvh));
            Ok(())
        })
    }
}
