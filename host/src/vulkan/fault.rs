//! Devices that are lost on purpose, for tests. Where debug assertions are off there is nothing of it.

use ash::vk;

/// Before which call a device is lost.
#[derive(Debug, Default)]
pub(super) struct Faults {
    /// Calls that may find the device lost until it is; 0 for never.
    #[cfg(debug_assertions)]
    left: std::sync::atomic::AtomicU32,
    #[cfg(debug_assertions)]
    lost: std::sync::atomic::AtomicBool,
}

#[cfg(debug_assertions)]
impl Faults {
    /// The device, which is there again, is lost in the call after `calls` more.
    pub fn lose_after(&self, calls: u32) {
        use std::sync::atomic::Ordering::Relaxed;
        self.lost.store(false, Relaxed);
        self.left.store(calls.saturating_add(1), Relaxed);
    }

    /// Counts a call that can return that the device is lost; an error from the call on by which it is. The device is idle by
    /// then, for what it used may be destroyed after such an error.
    pub fn before(&self, device: &ash::Device) -> Result<(), vk::Result> {
        use std::sync::atomic::Ordering::Relaxed;
        let left = self.left.load(Relaxed);
        if left > 0 {
            self.left.store(left - 1, Relaxed);
            if left == 1 {
                // SAFETY: the device is alive.
                let _ = unsafe { device.device_wait_idle() };
                self.lost.store(true, Relaxed);
            }
        }
        match self.lost.load(Relaxed) {
            true => Err(vk::Result::ERROR_DEVICE_LOST),
            false => Ok(()),
        }
    }
}

#[cfg(not(debug_assertions))]
impl Faults {
    #[inline(always)]
    pub fn before(&self, _: &ash::Device) -> Result<(), vk::Result> {
        Ok(())
    }
}
