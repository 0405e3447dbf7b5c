//! Everything that can go wrong between the host and a Vulkan device.

use ash::vk;
use lightbvh_gpu::FloatEnvironment;
use lightbvh_gpu::spirv::ModuleError;
use std::time::Duration;

/// A failure on the Vulkan side: each variant is one cause and says what, where, and what to do about it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VulkanError {
    /// No Vulkan loader on this machine, or one without a driver behind it.
    #[error(
        "Vulkan cannot be used here: {reason}; install a driver (Debian: mesa-vulkan-drivers) or use the CPU"
    )]
    Unavailable {
        /// What was missing.
        reason: String,
    },
    /// There is no device at all to choose from.
    #[error(
        "no usable Vulkan device: {notes}; install a driver (Debian: mesa-vulkan-drivers) or use the CPU"
    )]
    NoDevice {
        /// Why there is none, device by device where some were passed over.
        notes: String,
    },
    /// The device asked for is not among those found.
    #[error("no Vulkan device matches `{wanted}`; there are: {available}; give an index or a part of a name")]
    UnknownDevice {
        /// What was asked for.
        wanted: String,
        /// `index: name` of each device found.
        available: String,
    },
    /// The thread's floating-point mode is not the default one.
    #[error(
        "the thread that would open {device} calculates otherwise than a thread begins with ({found:?}): software devices \
         inherit its floating-point mode and would round or flush differently; restore it on this thread first"
    )]
    FloatEnvironment {
        /// Name of the device that was not opened.
        device: String,
        /// How the thread calculates.
        found: FloatEnvironment,
    },
    /// Validation was requested on a machine without the layer.
    #[error(
        "VK_LAYER_KHRONOS_validation is not installed (Debian: vulkan-validationlayers); install it or run without"
    )]
    NoValidationLayer,
    /// The validation layer had something to say: the program misuses Vulkan.
    #[error("{count} validation message(s) on {device}, a bug in this program; the first: {}", first.join(" | "))]
    Validation {
        /// Name of the device in use.
        device: String,
        /// Messages so far.
        count: u64,
        /// The first few of them.
        first: Vec<String>,
    },
    /// A Vulkan call returned an error.
    #[error("{call} failed on {device}: {result}")]
    Call {
        /// The Vulkan function.
        call: &'static str,
        /// Name of the device, or `the instance`.
        device: String,
        /// What it returned.
        result: vk::Result,
    },
    /// The device was lost; nothing it holds can be used any more.
    #[error("{device} was lost in {call}; open it again, and look into the system log if it happens again")]
    DeviceLost {
        /// The Vulkan function that noticed.
        call: &'static str,
        /// Name of the device.
        device: String,
    },
    /// Submitted work did not end in time.
    #[error("{device} did not finish within {after:?} ({work}); give it less work or a longer time limit")]
    Timeout {
        /// Name of the device.
        device: String,
        /// The limit that passed.
        after: Duration,
        /// The kernels or the copy that was under way.
        work: String,
    },
    /// Earlier work that hit its time limit is still running.
    #[error("{device} is still busy with work that ran into its time limit; wait, or open another device")]
    Busy {
        /// Name of the device.
        device: String,
    },
    /// The device memory manager refused.
    #[error(
        "no memory for {bytes} bytes on {device} ({reserved} bytes reserved): {reason}; use a smaller scene or fewer queries"
    )]
    OutOfMemory {
        /// Name of the device.
        device: String,
        /// Bytes asked for.
        bytes: u64,
        /// Bytes this program has already reserved there.
        reserved: u64,
        /// What the memory manager says.
        reason: String,
    },
    /// A buffer is over a limit of the device.
    #[error(
        "a buffer of {bytes} bytes is over {limit_name} = {limit} bytes of {device}; split the work into smaller parts"
    )]
    BufferTooLarge {
        /// Name of the device.
        device: String,
        /// Bytes asked for.
        bytes: u64,
        /// Vulkan's name of the limit.
        limit_name: &'static str,
        /// Its value, bytes.
        limit: u64,
    },
    /// A write goes beyond the buffer's end.
    #[error("elements up to {given} written to a buffer of {held}; write no more than it holds")]
    WrongLength {
        /// Where the elements given would end.
        given: usize,
        /// Elements of the buffer.
        held: usize,
    },
    /// No module of that name is built in.
    #[error("no kernel `{name}` in this program; there are: {known}")]
    UnknownKernel {
        /// The name asked for.
        name: String,
        /// The names there are.
        known: String,
    },
    /// A SPIR-V module does not parse or asks for something this host does not serve.
    #[error("the SPIR-V module of kernel `{kernel}` is not usable: {source}; rebuild the kernels")]
    BadModule {
        /// The kernel's name.
        kernel: String,
        /// What is wrong, and at which word.
        source: ModuleError,
    },
    /// A kernel needs more than the device has.
    #[error("kernel `{kernel}` needs {what} {needed}, {device} has {limit}; choose another device")]
    KernelOverLimit {
        /// The kernel's name.
        kernel: String,
        /// Name of the device.
        device: String,
        /// The quantity.
        what: &'static str,
        /// What the kernel needs.
        needed: u32,
        /// What the device has.
        limit: u32,
    },
    /// A dispatch does not fit the kernel's declared interface.
    #[error("dispatch of kernel `{kernel}`: {what}")]
    BadDispatch {
        /// The kernel's name.
        kernel: String,
        /// What does not fit: expected and given.
        what: String,
    },
    /// A kernel or buffer was used with a device that does not own it.
    #[error("{what} belongs to another device than {device}; each device has its own kernels and buffers")]
    ForeignObject {
        /// The object.
        what: String,
        /// Name of the device it was used with.
        device: String,
    },
    /// The device was closed while buffers or handles of it are still held.
    #[error(
        "{device} cannot be closed: {holders} buffer(s) or handle(s) of it are still held; drop them first"
    )]
    StillHeld {
        /// Name of the device.
        device: String,
        /// How many.
        holders: usize,
    },
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
