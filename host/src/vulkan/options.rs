//! How devices are opened.

/// How to open a device.
#[derive(Clone, Copy, Debug, Default)]
pub struct Options {
    /// Run under `VK_LAYER_KHRONOS_validation`: any message of it becomes an error of the call that drew it.
    pub validation: bool,
}
