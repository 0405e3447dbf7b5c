//! The compiled kernels of each model.

use std::ffi::c_char;

use lightbvh_gpu::{
    Access, Binding, DeviceBuffer, FloatControls, Kernel, KernelSet, MOMENTS, STORAGE_BUFFERS, groups,
    self_test, spirv, without_vulkan_memory_model,
};

use crate::error::{Fault, Status};
use crate::held::functions;
use crate::raw;
use crate::scene::Model;

/// The kernels in the order of `lightbvh_kernel_id`; those of a refit come first, in the order of `Pass::ALL`.
fn kernel(model: u32, which: u32) -> Result<&'static Kernel, Fault> {
    let set = match Model::of(model)? {
        Model::Triangles => MOMENTS,
        Model::Any => KernelSet::ANY,
        Model::Masked => KernelSet::LINKED,
    };
    let all = [
        set.refit_bottom,
        set.refit_top,
        set.refit_nodes,
        set.sample,
        set.pmf,
        set.light_points,
        &self_test::SELF_TEST,
    ];
    let unknown = || format!("kernel {which}, expected one of lightbvh_kernel_id");
    let found = all.get(which as usize).copied();
    found.ok_or_else(|| Fault::new(Status::BadTag, unknown()))
}

/// Buffers that an engine has besides those of [`DeviceBuffer`], in the order of `lightbvh_buffer` after those.
const OTHERS: [&str; 6] = ["queries", "results", "samples", "numbers", "operands", "answers"];

/// Number of buffers in `lightbvh_buffer`.
pub(crate) const BUFFERS: u32 = (DeviceBuffer::ALL.len() + OTHERS.len()) as u32;

/// `lightbvh_kernel`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CKernel {
    pub name: [c_char; 32],
    pub push_bytes: u32,
    pub binding_count: u32,
    pub bindings: [CBinding; STORAGE_BUFFERS as usize],
}

/// `lightbvh_binding`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CBinding {
    pub buffer: u32,
    pub writes: u32,
    pub stride: u32,
}

impl From<&Kernel> for CKernel {
    fn from(kernel: &Kernel) -> Self {
        let binding = |own: &Binding| {
            let other = || OTHERS.iter().position(|name| *name == own.name);
            let other = || other().map_or(u32::MAX, |at| (DeviceBuffer::ALL.len() + at) as u32);
            CBinding {
                buffer: DeviceBuffer::named(own.name).map_or_else(other, |buffer| buffer as u32),
                writes: (own.access == Access::Write).into(),
                stride: own.stride,
            }
        };
        let mut out = Self {
            name: [0; 32],
            push_bytes: kernel.push_constants,
            binding_count: kernel.bindings.len() as u32,
            bindings: Default::default(),
        };
        // The last byte stays zero.
        let name = kernel.name.bytes().take(31);
        out.name
            .iter_mut()
            .zip(name)
            .for_each(|(place, byte)| *place = byte as c_char);
        out.bindings
            .iter_mut()
            .zip(kernel.bindings)
            .for_each(|(place, own)| *place = binding(own));
        out
    }
}

functions! {
    /// What a kernel takes.
    fn lightbvh_kernel_of(model: u32, which: u32, out: *mut CKernel) {
        raw::place(out, "kernel")?.write(kernel(model, which)?.into());
        Ok(())
    }

    /// The module of a kernel.
    fn lightbvh_kernel_words(
        model: u32, which: u32, device: u32, words: *mut u32, capacity: usize, count: *mut usize
    ) {
        if device > 7 {
            let message = format!("{device:#x} of a device, expected bits of lightbvh_device");
            return Err(Fault::new(Status::BadTag, message));
        }
        let controls = FloatControls {
            signed_zero_inf_nan_preserve_32: device & 1 != 0,
            rounding_mode_rte_32: device & 2 != 0,
        };
        let mut module = kernel(model, which)?.words_for(controls);
        if device & 4 != 0 {
            module = without_vulkan_memory_model(&module).map_err(|error| Fault::new(Status::BadTag, error))?;
        }
        raw::list(words, capacity, count, module.into_iter())
    }

    /// What the kernel `LIGHTBVH_SELF_TEST` reads.
    fn lightbvh_self_test_operands(words: *mut u32, capacity: usize, count: *mut usize) {
        raw::list(words, capacity, count, spirv::words(self_test::operands()).into_iter())
    }

    /// Whether the answers of that kernel are the CPU's.
    fn lightbvh_self_test_check(answers: *const u8, bytes: usize) {
        match self_test::defect(raw::array(answers, bytes, "answers")?) {
            Some(defect) => Err(Fault::new(Status::Inexact, defect)),
            None => Ok(()),
        }
    }

    /// Workgroups of a dispatch.
    fn lightbvh_groups(count: u32, out: *mut [u32; 3]) {
        let place = raw::place(out, "groups")?;
        let too_many = || Fault::new(Status::TooMany, format!("{count} invocations; dispatch several times"));
        place.write(groups(count, 64).ok_or_else(too_many)?);
        Ok(())
    }
}
