//! How a device is opened.

use std::time::Duration;

/// How to open a device.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Run under `VK_LAYER_KHRONOS_validation`: any message of it becomes an error of the call that drew it.
    pub validation: bool,
    /// Copy through staging buffers even where host and device share memory; for tests of that path.
    pub force_staging: bool,
    /// How long submitted work may take.
    pub time_limit: Duration,
}

impl Default for Options {
    /// No validation, staging only where needed, ten minutes: far beyond any sensible pass, even on two
    /// slow cores.
    fn default() -> Self {
        Self {
            validation: false,
            force_staging: false,
            time_limit: Duration::from_secs(600),
        }
    }
}
