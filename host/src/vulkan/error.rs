//! Everything that can go wrong between the host and a Vulkan device.

use ash::vk;
use lightbvh_gpu::FloatEnvironment;
use lightbvh_gpu::spirv::ModuleError;

/// A failure on the Vulkan side: each variant is one cause and says what, where, and what to do about it.
#[allow(missing_docs, reason = "the messages name the fields")]
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VulkanError {
    #[error(
        "Vulkan cannot be used here: {reason}; install a driver (Debian: mesa-vulkan-drivers) or use the CPU"
    )]
    Unavailable { reason: String },
    #[error(
        "no usable Vulkan device: {notes}; install a driver (Debian: mesa-vulkan-drivers) or use the CPU"
    )]
    NoDevice { notes: String },
    #[error("no Vulkan device matches `{wanted}`; there are: {available}; give an index or a part of a name")]
    UnknownDevice { wanted: String, available: String },
    #[error(
        "the thread that would open {device} calculates otherwise than a thread begins with ({found:?}): software devices \
         inherit its floating-point mode and would round or flush differently; restore it on this thread first"
    )]
    FloatEnvironment { device: String, found: FloatEnvironment },
    #[error(
        "VK_LAYER_KHRONOS_validation is not installed (Debian: vulkan-validationlayers); install it or run without"
    )]
    NoValidationLayer,
    #[error("validation messages on {device}, a bug in this program: {}", messages.join(" | "))]
    Validation { device: String, messages: Vec<String> },
    #[error("{call} failed on {device}: {result}")]
    Call {
        call: &'static str,
        device: String,
        result: vk::Result,
    },
    #[error("{device} was lost in {call}; open it again, and look into the system log if it happens again")]
    DeviceLost { call: &'static str, device: String },
    #[error(
        "no memory for {bytes} bytes on {device} ({reserved} bytes reserved): {reason}; use a smaller scene or fewer queries"
    )]
    OutOfMemory {
        device: String,
        bytes: u64,
        reserved: u64,
        reason: String,
    },
    #[error(
        "a buffer of {bytes} bytes is over {limit_name} = {limit} bytes of {device}; split the work into smaller parts"
    )]
    BufferTooLarge {
        device: String,
        bytes: u64,
        limit_name: &'static str,
        limit: u64,
    },
    #[error("elements up to {given} written to a buffer of {held}; write no more than it holds")]
    WrongLength { given: usize, held: usize },
    #[error("no kernel `{name}` in this program; there are: {known}")]
    UnknownKernel { name: String, known: String },
    #[error("the SPIR-V module of kernel `{kernel}` is not usable: {source}; rebuild the kernels")]
    BadModule { kernel: String, source: ModuleError },
    #[error("kernel `{kernel}` needs {what} {needed}, {device} has {limit}; choose another device")]
    KernelOverLimit {
        kernel: String,
        device: String,
        what: &'static str,
        needed: u32,
        limit: u32,
    },
    #[error("dispatch of kernel `{kernel}`: {what}")]
    BadDispatch { kernel: String, what: String },
    #[error("{what} belongs to another device than {device}; each device has its own kernels and buffers")]
    ForeignObject { what: String, device: String },
    #[error(
        "{device} cannot be closed: {holders} buffer(s) or handle(s) of it are still held; drop them first"
    )]
    StillHeld { device: String, holders: usize },
}

/// Turns Vulkan result codes into errors that name the call and the device.
pub(crate) trait CallContext<T> {
    fn during(self, call: &'static str, device: &str) -> Result<T, VulkanError>;
}

impl<T> CallContext<T> for Result<T, vk::Result> {
    fn during(self, call: &'static str, device: &str) -> Result<T, VulkanError> {
        self.map_err(|result| match result {
            vk::Result::ERROR_DEVICE_LOST => VulkanError::DeviceLost {
                call,
                device: device.into(),
            },
            result => VulkanError::Call {
                call,
                device: device.into(),
                result,
            },
        })
    }
}
