//! What a device does to follow a light BVH.

use std::ffi::c_void;
use std::ptr::null;

use lightbvh::tree::Model as LightModel;
use lightbvh::{Bvh, TreeWords};
use lightbvh_gpu::{DeviceBuffer, Mirror, Step, query_push};

use crate::error::{Fault, Status};
use crate::held::{Handle, Held, functions};
use crate::kernel::BUFFERS;
use crate::raw;
use crate::scene::{Model, Scene, by_model};

/// `lightbvh_mirror`.
pub type CMirror = Held<Follower>;

/// What a device holds of light BVHs of one model, and its last frame.
#[derive(Debug)]
pub struct Follower {
    model: Model,
    mirror: Mirror,
    steps: Vec<CStep>,
    /// The list of a refit, which the light BVH does not hold.
    list: Vec<u8>,
}

/// `lightbvh_step`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct CStep {
    pub kind: u32,
    pub which: u32,
    pub at: u64,
    pub bytes: u64,
    pub data: *const c_void,
    pub push: [u32; 3],
    pub count: u32,
}

/// `lightbvh_frame`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct CFrame {
    pub steps: *const CStep,
    pub count: usize,
    pub push: [u32; 10],
}

impl Follower {
    fn expect(&self, scene: &Scene) -> Result<(), Fault> {
        let message = "this mirror is for another model than the light BVH; make another mirror";
        match self.model == scene.model() {
            true => Ok(()),
            false => Err(Fault::new(Status::WrongModel, message)),
        }
    }

    #[rustfmt::skip]
    fn follow<M: LightModel<8>>(&mut self, bvh: &Bvh<M>) -> TreeWords {
        let frame = self.mirror.frame(bvh);
        let none = CStep { kind: 0, which: 0, at: 0, bytes: 0, data: null(), push: [0; 3], count: 0 };
        let step = |own: Step<'_>| match own {
            Step::Resize { buffer, bytes } => CStep { which: buffer as u32, bytes, ..none },
            Step::Upload { buffer, at, bytes: own } => {
                let mut data = own.as_ptr();
                if buffer == DeviceBuffer::List {
                    self.list = own.to_vec();
                    data = self.list.as_ptr();
                }
                let (which, bytes) = (buffer as u32, own.len() as u64);
                CStep { kind: 1, which, at, bytes, data: data.cast(), ..none }
            }
            Step::Dispatch { pass, push, count } => CStep { kind: 2, which: pass as u32, push, count, ..none },
        };
        self.steps = frame.steps().map(step).collect();
        frame.words
    }
}

/// A mirror of light BVHs of a model.
#[unsafe(no_mangle)]
pub extern "C" fn lightbvh_mirror_create(model: u32) -> *mut CMirror {
    Held::create("mirror", || {
        Ok(Follower {
            model: Model::of(model)?,
            mirror: Mirror::default(),
            steps: Vec::new(),
            list: Vec::new(),
        })
    })
}

/// Frees it.
///
/// # Safety
/// `mirror` is null, or what `lightbvh_mirror_create` returned, and not used any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn lightbvh_mirror_free(mirror: *mut CMirror) {
    // SAFETY: the caller's promise.
    unsafe { Held::free(mirror) }
}

functions! {
    /// The steps of a frame.
    fn lightbvh_mirror_frame(mirror: *mut CMirror, bvh: *const Handle, frame: *mut CFrame) {
        let (scene, place) = (Handle::of(bvh, "bvh")?, raw::place(frame, "frame")?);
        Held::change(mirror, "mirror", |own| {
            own.expect(scene)?;
            let push = query_push(0, by_model!(scene, bvh => own.follow(bvh)));
            place.write(CFrame { steps: own.steps.as_ptr(), count: own.steps.len(), push });
            Ok(())
        })
    }

    /// Compares a device's buffer with the light BVH: the words in use.
    fn lightbvh_mirror_compare(
        mirror: *const CMirror, bvh: *const Handle, buffer: u32, held: *const u8, bytes: usize,
        compared: *mut u64, different: *mut u64
    ) {
        let (own, scene) = (Held::of(mirror, "mirror")?, Handle::of(bvh, "bvh")?);
        let held = raw::array(held, bytes, "the buffer's bytes")?;
        let (compared, different) = (raw::place(compared, "compared")?, raw::place(different, "different")?);
        own.expect(scene)?;
        if buffer >= BUFFERS {
            let message = format!("buffer {buffer}, expected one of lightbvh_buffer");
            return Err(Fault::new(Status::BadTag, message));
        }
        let used = by_model!(scene, bvh => own.mirror.in_use(bvh)).into_iter();
        let used = used.filter(|(own, ..)| *own as u32 == buffer);
        let words = used.flat_map(|(_, at, bytes)| (at as usize..).step_by(4).zip(bytes.chunks_exact(4)));
        let differs = |(at, word): &(usize, &[u8])| held.get(*at..at + 4) != Some(word);
        compared.write(words.clone().count() as u64);
        different.write(words.filter(differs).count() as u64);
        Ok(())
    }
}
