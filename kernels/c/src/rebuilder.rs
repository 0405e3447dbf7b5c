//! Builds in the background.

use lightbvh::Rebuilder;
use lightbvh::bvh::{FrameStart, RebuilderParams, Swap};
use lightbvh::tree::{AnyKind, Masked, Triangles};

use crate::error::{Fault, Status};
use crate::held::{Handle, Held, functions};
use crate::raw;
use crate::scene::{Model, Scene, wrong_model};

/// `lightbvh_rebuilder`.
pub type CRebuilder = Held<SceneRebuilder>;

/// A rebuilder for light BVHs of one model.
#[derive(Debug)]
pub enum SceneRebuilder {
    /// Of triangles alone.
    Triangles(Rebuilder<Triangles>),
    /// Of lights of every kind.
    Any(Rebuilder<AnyKind>),
    /// The same with masks.
    Masked(Rebuilder<Masked>),
}

/// `$do` with the rebuilder and a light BVH, which must be of its model.
macro_rules! of_one_model {
    ($rebuilder:expr, $scene:expr, ($own:ident, $bvh:ident) => $do:expr) => {
        match ($rebuilder, $scene) {
            (SceneRebuilder::Triangles($own), Scene::Triangles($bvh)) => Ok($do),
            (SceneRebuilder::Any($own), Scene::Any($bvh)) => Ok($do),
            (SceneRebuilder::Masked($own), Scene::Masked($bvh)) => Ok($do),
            _ => Err(wrong_model("rebuilder")),
        }
    };
}

/// What the start of a frame did: `lightbvh_frame_start`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CFrameStart {
    pub swapped: u32,
    pub meshes: u32,
}

/// A rebuilder. Its trees are swapped in after `after` frames; once they are ready if it is 0.
#[unsafe(no_mangle)]
pub extern "C" fn lightbvh_rebuilder_create(model: u32, after: u32) -> *mut CRebuilder {
    let swap = match after {
        0 => Swap::WhenReady,
        _ => Swap::Deterministic,
    };
    let params = RebuilderParams {
        after,
        swap,
        ..RebuilderParams::default()
    };
    Held::create("rebuilder", || {
        Ok(match Model::of(model)? {
            Model::Triangles => SceneRebuilder::Triangles(Rebuilder::new(params)),
            Model::Any => SceneRebuilder::Any(Rebuilder::new(params)),
            Model::Masked => SceneRebuilder::Masked(Rebuilder::new(params)),
        })
    })
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

functions! {
    /// Swaps in finished trees.
    fn lightbvh_begin_frame(rebuilder: *mut CRebuilder, bvh: *mut Handle, start: *mut CFrameStart) {
        let places = raw::places_if_any(start, 1, "start")?;
        let begun = Handle::change(bvh, "bvh", |scene| {
            let begin = |own: &mut _| of_one_model!(own, scene, (own, bvh) => own.begin_frame(bvh));
            Held::change(rebuilder, "rebuilder", begin)
        })?;
        let begun: FrameStart = begun.map_err(|error| Fault::new(Status::NoRebuild, error))?;
        let start = CFrameStart { swapped: begun.swapped.into(), meshes: begun.meshes };
        places.iter_mut().for_each(|place| _ = place.write(start));
        Ok(())
    }

    /// Starts the next build.
    fn lightbvh_end_frame(rebuilder: *mut CRebuilder, bvh: *const Handle) {
        let scene = Handle::of(bvh, "bvh")?;
        let end = |own: &mut _| of_one_model!(own, scene, (own, bvh) => own.end_frame(bvh));
        Held::change(rebuilder, "rebuilder", end)
    }
}
