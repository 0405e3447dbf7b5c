//! Objects that are no longer wanted, destroyed as soon as the device can no longer be using them.

use super::shared::Shared;
use ash::vk;
use gpu_allocator::vulkan::Allocation;

/// An object whose owner has gone.
pub(crate) enum Retired {
    Buffer(vk::Buffer, Option<Allocation>),
    Sets(vk::DescriptorPool),
    Queries(vk::QueryPool),
}

impl Shared {
    /// Destroys an object now, or, if work that ran into its time limit may still use it, once that has ended.
    pub(crate) fn retire(&self, object: Retired) {
        let mut queue = self.queue();
        queue.retired.push(object);
        if queue.settle(&self.raw, &self.probe.name).is_ok() {
            self.destroy_retired(queue.retired.drain(..));
        }
    }

    /// Nothing may be running.
    pub(super) fn destroy_retired(&self, objects: impl Iterator<Item = Retired>) {
        for object in objects {
            // SAFETY: the objects belong to this device or are null, their owners gave them up, and nothing that uses
            // them is running: submissions borrow them until they end, and one that ran into its time limit has ended
            // before this is called.
            unsafe {
                match object {
                    Retired::Sets(pool) => self.raw.destroy_descriptor_pool(pool, None),
                    Retired::Queries(pool) => self.raw.destroy_query_pool(pool, None),
                    Retired::Buffer(buffer, allocation) => {
                        self.raw.destroy_buffer(buffer, None);
                        // An error would be an inconsistency of the allocator itself; there is nothing to undo.
                        let _ = allocation.map(|allocation| self.allocator().free(allocation));
                    }
                }
            }
        }
    }
}
