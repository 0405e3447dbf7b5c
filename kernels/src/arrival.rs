//! Counters at which invocations of one dispatch meet: the only memory through which they speak to each other.

#[cfg(target_arch = "spirv")]
use spirv_std::arch::atomic_i_add;
#[cfg(target_arch = "spirv")]
use spirv_std::memory::{Scope, Semantics};

/// All invocations of a dispatch run on one queue. The wider scope, `Device`, is a feature that a device may lack
/// (`vulkanMemoryModelDeviceScope`).
#[cfg(target_arch = "spirv")]
const SCOPE: u32 = Scope::QueueFamily as u32;

/// What makes the writes of the invocations that arrived before visible to the one that arrives (Vulkan specification,
/// appendix "Memory Model"):
/// - `ACQUIRE_RELEASE`: an arrival that reads the count left by another one synchronizes with it, and with all before it,
///   because arrivals are read-modify-writes and so one release sequence;
/// - `UNIFORM_MEMORY`: this orders the accesses to storage buffers;
/// - `MAKE_AVAILABLE`: what this invocation wrote so far can be seen by the queue family's others from here on;
/// - `MAKE_VISIBLE`: what others made available is seen by this invocation's reads from here on.
///
/// It covers only accesses marked `NonPrivatePointer`; rust-gpu marks none, so the builder's post-pass does.
#[cfg(target_arch = "spirv")]
const SEMANTICS: u32 = Semantics::ACQUIRE_RELEASE.bits()
    | Semantics::UNIFORM_MEMORY.bits()
    | Semantics::MAKE_AVAILABLE.bits()
    | Semantics::MAKE_VISIBLE.bits();

/// Adds one to counter `index`, which must be in range, and returns how many had arrived before. What these wrote is
/// visible to what follows. On the CPU, invocations run one after the other.
#[inline(always)]
pub(crate) fn arrive(counters: &mut [u32], index: u32) -> u32 {
    #[cfg(target_arch = "spirv")]
    {
        // SAFETY: an exclusive reference to a word of a storage buffer; the instruction is the one way in which
        // invocations reach this word at the same time.
        unsafe { atomic_i_add::<u32, SCOPE, SEMANTICS>(&mut counters[index as usize], 1) }
    }
    #[cfg(not(target_arch = "spirv"))]
    {
        let before = counters[index as usize];
        counters[index as usize] = before.wrapping_add(1);
        before
    }
}
