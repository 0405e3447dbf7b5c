//! Colours as pictures encode them.

/// IEC 61966-2-1, the transfer function that glTF names for colour textures.
pub(super) fn linear_from_srgb(encoded: u8) -> f32 {
    let x = f64::from(encoded) / 255.0;
    let linear = if x <= 0.04045 {
        x / 12.92
    } else {
        libm::pow((x + 0.055) / 1.055, 2.4)
    };
    linear as f32
}
