//! What a device, its buffers and its kernels hold in common, destroyed when the last of them goes.

use super::error::VulkanError;
use super::fault::Faults;
use super::instance::Instance;
use super::kernel::Kernel;
use super::probe::{Candidate, Probe};
use super::queue::Queue;
use gpu_allocator::vulkan::{Allocator, AllocatorCreateDesc};
use gpu_allocator::{AllocationSizes, AllocatorDebugSettings};
use std::mem::ManuallyDrop;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard};

/// Memory is asked of the driver in blocks of this size; larger buffers get their own.
const MEMORY_BLOCK: u64 = 32 << 20;

/// Tells open devices apart, so that a kernel of one is never used with another.
static NEXT_ID: AtomicU64 = AtomicU64::new(0);

pub(crate) struct Shared {
    pub(crate) id: u64,
    pub(crate) probe: Probe,
    pub(crate) raw: ash::Device,
    pub(super) faults: Faults,
    queue: Mutex<Queue>,
    /// The last of a name is in use; a pass may still name others' pipelines.
    kernels: Mutex<Vec<Arc<Kernel>>>,
    allocator: Mutex<ManuallyDrop<Allocator>>,
    /// Dropped after all that was made from it.
    pub(crate) instance: ManuallyDrop<Instance>,
}

impl Shared {
    /// Takes over a fresh logical device; on failure everything made so far is destroyed.
    pub(crate) fn new(
        instance: Instance,
        raw: ash::Device,
        candidate: Candidate,
    ) -> Result<Self, VulkanError> {
        let Candidate {
            physical,
            queue_family,
            probe,
        } = candidate;
        let has_clock = probe.timestamp_valid_bits > 0;
        let parts = Queue::new(&raw, queue_family, has_clock, &probe.name).and_then(|queue| {
            let allocator = Allocator::new(&AllocatorCreateDesc {
                instance: instance.raw.clone(),
                device: raw.clone(),
                physical_device: physical,
                debug_settings: AllocatorDebugSettings::default(),
                buffer_device_address: false,
                allocation_sizes: AllocationSizes::new(MEMORY_BLOCK, MEMORY_BLOCK),
            });
            allocator
                .map_err(|error| {
                    queue.destroy(&raw);
                    VulkanError::OutOfMemory {
                        device: probe.name.clone(),
                        bytes: 0,
                        reserved: 0,
                        reason: error.to_string(),
                    }
                })
                .map(|allocator| (queue, allocator))
        });
        match parts {
            Ok((queue, allocator)) => Ok(Self {
                id: NEXT_ID.fetch_add(1, Ordering::Relaxed),
                probe,
                faults: Faults::default(),
                raw,
                queue: Mutex::new(queue),
                kernels: Mutex::default(),
                allocator: Mutex::new(ManuallyDrop::new(allocator)),
                instance: ManuallyDrop::new(instance),
            }),
            Err(error) => {
                // SAFETY: nothing made from the device is left: the queue's objects are destroyed above, the allocator
                // was not made. The instance goes after it, at the end of this function.
                unsafe { raw.destroy_device(None) };
                Err(error)
            }
        }
    }

    /// The queue, for one submission or one host access at a time.
    pub(crate) fn queue(&self) -> MutexGuard<'_, Queue> {
        self.queue.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
    }

    pub(crate) fn kernels(&self) -> MutexGuard<'_, Vec<Arc<Kernel>>> {
        self.kernels
            .lock()
            .unwrap_or_else(|poisoned| poisoned.into_inner())
    }

    pub(crate) fn allocator(&self) -> MutexGuard<'_, ManuallyDrop<Allocator>> {
        self.allocator
            .lock()
            .unwrap_or_else(|poisoned| poisoned.into_inner())
    }

    /// An error once the validation layer has said anything.
    pub(crate) fn check_validation(&self) -> Result<(), VulkanError> {
        let messages = self.instance.messages();
        messages.map_or(Ok(()), |messages| messages.check(&self.probe.name))
    }
}

impl Drop for Shared {
    fn drop(&mut self) {
        // SAFETY: the device is alive, and no other thread can use it: this is its last owner. A lost device is an
        // error here, and is safe to destroy all the same.
        let _ = unsafe { self.raw.device_wait_idle() };
        for kernel in self.kernels().drain(..) {
            kernel.destroy(&self.raw);
        }
        self.queue().destroy(&self.raw);
        // SAFETY: taken once, here; every buffer held this structure, so all of them are gone.
        drop(unsafe { ManuallyDrop::take(&mut *self.allocator()) });
        // SAFETY: all objects made from the device are destroyed: buffers (as above), kernels, queue objects, memory.
        unsafe { self.raw.destroy_device(None) };
        // SAFETY: dropped once, here, after the last thing made from it.
        unsafe { ManuallyDrop::drop(&mut self.instance) };
    }
}
