//! Spectra as linear sRGB.

use std::ops::RangeInclusive;

/// Wavelengths that sums go over, nanometres.
const FIRST: u32 = 360;
const LAST: u32 = 830;

/// Colour matching functions of 1931, as sums of Gaussians (Wyman, Sloan and Shirley 2013, "Simple Analytic Approximations to
/// the CIE XYZ Color Matching Functions", section 2.2).
fn matching(nm: f64) -> [f64; 3] {
    let lobe = |scale: f64, mean: f64, below: f64, above: f64| {
        let t = (nm - mean) * if nm < mean { below } else { above };
        scale * libm::exp(-0.5 * t * t)
    };
    [
        lobe(0.362, 442.0, 0.0624, 0.0374)
            + lobe(1.056, 599.8, 0.0264, 0.0323)
            + lobe(-0.065, 501.1, 0.0490, 0.0382),
        lobe(0.821, 568.8, 0.0213, 0.0247) + lobe(0.286, 530.9, 0.0613, 0.0322),
        lobe(1.217, 437.0, 0.0845, 0.0278) + lobe(0.681, 459.0, 0.0385, 0.0725),
    ]
}

/// The tristimulus values of a spectrum; equal energy has Y = 1.
pub(super) fn xyz_of(spectrum: impl Fn(f64) -> f64) -> [f64; 3] {
    let mut sums = [0.0; 3];
    let mut all = 0.0;
    for nm in FIRST..=LAST {
        let nm = f64::from(nm);
        let (matching, value) = (matching(nm), spectrum(nm));
        for (sum, weight) in sums.iter_mut().zip(matching) {
            *sum += weight * value;
        }
        all += matching[1];
    }
    sums.map(|sum| sum / all)
}

/// Linear sRGB (IEC 61966-2-1).
pub(super) fn rgb_of_xyz([x, y, z]: [f64; 3]) -> [f64; 3] {
    [
        3.240_97 * x - 1.537_383 * y - 0.498_611 * z,
        -0.969_244 * x + 1.875_968 * y + 0.041_555 * z,
        0.055_63 * x - 0.203_977 * y + 1.056_972 * z,
    ]
}

/// Light of luminance 1 with the colour of tristimulus values; `None` where they are those of no light.
fn light_of_xyz(xyz: [f64; 3]) -> Option<[f64; 3]> {
    let [_, y, _] = xyz;
    if !(y > 0.0 && y.is_finite()) {
        return None;
    }
    let rgb = rgb_of_xyz(xyz.map(|x| x / y)).map(|x| x.max(0.0));
    // What lies outside sRGB is cut, and its luminance kept.
    let luminance = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
    Some(rgb.map(|x| x / luminance))
}

/// Light of luminance 1 with the chromaticity `x`, `y`.
pub(super) fn light_of_chromaticity(x: f64, y: f64) -> [f64; 3] {
    light_of_xyz([x / y, 1.0, (1.0 - x - y) / y]).unwrap_or([1.0; 3])
}

/// Black bodies whose colours are worked out, kelvin.
pub(super) const BODIES: RangeInclusive<f64> = 500.0..=1e6;

/// Light of luminance 1 of a black body of that many kelvin, within [`BODIES`].
pub(super) fn blackbody(kelvin: f64) -> [f64; 3] {
    // The second radiation constant, nanometres times kelvin. Taken relative to 560 nm, so that nothing overflows.
    const C2: f64 = 1.438_776_877e7;
    let kelvin = kelvin.clamp(*BODIES.start(), *BODIES.end());
    let at = |nm: f64| {
        let x = C2 / (nm * kelvin);
        libm::pow(nm / 560.0, -5.0) * libm::exp(-x) / (1.0 - libm::exp(-x))
    };
    let middle = at(560.0);
    light_of_xyz(xyz_of(|nm| at(nm) / middle)).unwrap_or([1.0; 3])
}

/// Between samples by straight lines, 0 outside; wavelengths ascend.
pub(super) fn interpolated(samples: &[(f64, f64)], nm: f64) -> f64 {
    let after = samples.partition_point(|&(at, _)| at < nm);
    match (after.checked_sub(1).map(|i| samples[i]), samples.get(after)) {
        (_, Some(&(at, value))) if at == nm => value,
        (Some((a, va)), Some(&(b, vb))) => va + (vb - va) * (nm - a) / (b - a),
        _ => 0.0,
    }
}

/// Reflected light in white light, each channel in [0, 1]: grey stays grey.
pub(super) fn reflectance(samples: &[(f64, f64)]) -> [f64; 3] {
    let rgb = rgb_of_xyz(xyz_of(|nm| interpolated(samples, nm)));
    let white = rgb_of_xyz(xyz_of(|_| 1.0));
    [0, 1, 2].map(|i| (rgb[i] / white[i]).clamp(0.0, 1.0))
}

/// Light of luminance 1 with the colour of samples; `None` where they have nothing that is visible.
pub(super) fn light(samples: &[(f64, f64)]) -> Option<[f64; 3]> {
    light_of_xyz(xyz_of(|nm| interpolated(samples, nm)))
}
