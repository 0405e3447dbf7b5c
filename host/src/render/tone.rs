//! From radiance to what a screen shows.

/// Radiance (after exposure) that is shown as white.
const WHITE: f32 = 4.0;

/// The curve `x (1 + x / w^2) / (1 + x)`: nearly linear in the dark, white at `w` (E. Reinhard et al., "Photographic Tone
/// Reproduction for Digital Images", 2002, equation 4), on each channel by itself, so that bright lights lose their colour.
fn compress(x: f32) -> f32 {
    x * (1.0 + x / (WHITE * WHITE)) / (1.0 + x)
}

/// The sRGB transfer function (IEC 61966-2-1) to 8 bits.
fn encode_srgb(x: f32) -> u8 {
    let x = x.clamp(0.0, 1.0);
    let encoded = if x <= 0.003_130_8 {
        12.92 * x
    } else {
        1.055 * x.powf(1.0 / 2.4) - 0.055
    };
    (encoded * 255.0 + 0.5) as u8
}

/// One linear channel as an sRGB byte, scaled by `exposure` first.
pub fn display(radiance: f32, exposure: f32) -> u8 {
    // What is not a number shows as black, infinity as white.
    encode_srgb(compress((radiance * exposure).clamp(0.0, 1e6)))
}
