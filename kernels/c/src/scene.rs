//! The light BVH behind a handle: one of three models, and its life from creation to words.

use lightbvh::tree::{AnyKind, Masked};
use lightbvh::{AnyLights, LightBvh, MaskedLights, Rebuilder};

use crate::error::{Fault, Status};
use crate::held::{Handle, Held};
use crate::raw;

/// `lightbvh_model`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Model {
    Triangles,
    Any,
    Masked,
}

impl Model {
    pub(crate) fn of(word: u32) -> Result<Self, Fault> {
        let all = [Self::Triangles, Self::Any, Self::Masked];
        let unknown = || format!("model {word}, expected one of lightbvh_model");
        let found = all.get(word as usize).copied();
        found.ok_or_else(|| Fault::new(Status::BadTag, unknown()))
    }
}

/// `lightbvh`. A rebuilder starts no thread before the end of a frame.
#[derive(Debug)]
pub enum Scene {
    /// `LIGHTBVH_TRIANGLES`.
    Triangles(LightBvh, Rebuilder),
    /// `LIGHTBVH_ANY_LIGHTS`.
    Any(AnyLights, Rebuilder<AnyKind>),
    /// `LIGHTBVH_MASKED_LIGHTS`.
    Masked(MaskedLights, Rebuilder<Masked>),
}

/// `$do` with the light BVH, and its rebuilder if that is named, whatever its model.
macro_rules! by_model {
    ($scene:expr, $bvh:ident $(, $rebuilder:ident)? => $do:expr) => {
        match $scene {
            $crate::scene::Scene::Triangles($bvh, $($rebuilder,)? ..) => $do,
            $crate::scene::Scene::Any($bvh, $($rebuilder,)? ..) => $do,
            $crate::scene::Scene::Masked($bvh, $($rebuilder,)? ..) => $do,
        }
    };
}
pub(crate) use by_model;

impl Scene {
    fn new(model: Model) -> Self {
        match model {
            Model::Triangles => Self::Triangles(Default::default(), Default::default()),
            Model::Any => Self::Any(Default::default(), Default::default()),
            Model::Masked => Self::Masked(Default::default(), Default::default()),
        }
    }

    pub(crate) fn model(&self) -> Model {
        match self {
            Self::Triangles(..) => Model::Triangles,
            Self::Any(..) => Model::Any,
            Self::Masked(..) => Model::Masked,
        }
    }
}

/// A light BVH without lights.
#[unsafe(no_mangle)]
pub extern "C" fn lightbvh_create(model: u32) -> *mut Handle {
    Held::create("light BVH", || Ok(Scene::new(Model::of(model)?)))
}

/// A light BVH that `lightbvh_words` wrote.
///
/// # Safety
/// `words` is null, not aligned, or points to `count` of them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_create_from_words(
    model: u32,
    words: *const u32,
    count: usize,
) -> *mut Handle {
    Held::create("light BVH", || {
        // SAFETY: the caller's promise.
        let words = unsafe { raw::array(words, count, "words") }?;
        let mut scene = Scene::new(Model::of(model)?);
        by_model!(&mut scene, bvh => {
            let bad = |error| Fault::new(Status::BadWords, error);
            *bvh = lightbvh::Bvh::from_words(words).map_err(bad)?;
        });
        Ok(scene)
    })
}

/// Frees it.
///
/// # Safety
/// `bvh` is null, or what `lightbvh_create` or `lightbvh_create_from_words` returned, and not used any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_free(bvh: *mut Handle) {
    // SAFETY: the caller's promise.
    unsafe { Held::free(bvh) }
}
