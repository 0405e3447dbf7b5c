//! How long something took, where there is a clock.

use core::time::Duration;
#[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
use std::time::Instant;

/// A moment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clock(#[cfg(not(all(target_family = "wasm", target_os = "unknown")))] Instant);

impl Clock {
    /// Now.
    pub fn start() -> Self {
        Self(
            #[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
            Instant::now(),
        )
    }

    /// The time since then; zero in `wasm32-unknown-unknown`, which has no clock and ends a program that asks for one.
    pub fn elapsed(self) -> Duration {
        #[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
        return self.0.elapsed();
        #[cfg(all(target_family = "wasm", target_os = "unknown"))]
        Duration::ZERO
    }
}
