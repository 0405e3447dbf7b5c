//! The table by which the power sampler chooses.

use lightbvh_kernels::shading::pick::MAX_PICKABLE;

use crate::scene::SceneLight;

/// The thresholds of [`Power`](lightbvh_kernels::shading::pick::Power) for these lights.
///
/// Of the 2^24 units of probability each light that emits gets one, so that none is left out, and the others are shared
/// out by flux. All entries are 0 where no light emits; there is no table if more lights emit than it has units.
pub fn power_thresholds<L: SceneLight>(lights: &[L]) -> Option<Vec<u32>> {
    let fluxes: Vec<f64> = lights.iter().map(SceneLight::flux).collect();
    let emitters = fluxes.iter().filter(|&&f| f > 0.0).count();
    if emitters > MAX_PICKABLE as usize {
        return None;
    }
    let total: f64 = fluxes.iter().sum();
    let shared = f64::from(MAX_PICKABLE) - emitters as f64;

    let (mut sum, mut before) = (0.0, 0_u32);
    let mut thresholds = Vec::with_capacity(lights.len() + 1);
    thresholds.push(0);
    for flux in fluxes {
        if flux > 0.0 {
            sum += flux;
            before += 1;
        }
        // The sums agree at the end, being taken in the same order: the ratio is then 1 and nothing is lost.
        let part = if total > 0.0 { sum / total * shared } else { 0.0 };
        thresholds.push(before + part as u32);
    }
    Some(thresholds)
}
