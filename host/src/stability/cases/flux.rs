//! How much lights emit: nothing, 1e-30 to 1e30, one more than all others.

use lightbvh::exact;

use super::super::case::Case;
use super::scattered;

pub(super) fn cases() -> Vec<Case> {
    let with = |name: &str, radiance: &dyn Fn(usize) -> f32| {
        let mut lights = scattered(200, 17);
        for (i, light) in lights.iter_mut().enumerate() {
            light.radiance = [radiance(i); 3];
        }
        Case::new(name, lights)
    };
    vec![
        with("flux from 1e-30 to 1e30", &|i| {
            10f32.powi(i as i32 * 37 % 61 - 30)
        }),
        with("one light brighter by 2^100", &|i| {
            exact::pow2(if i == 77 { 100 } else { 0 })
        }),
        with("every third light without flux", &|i| {
            if i.is_multiple_of(3) { 0.0 } else { 1.0 }
        }),
        with("no light has flux", &|_| 0.0),
        with("least radiance, 2^-100", &|_| exact::pow2(-100)),
        with("greatest radiance, 2^100", &|_| exact::pow2(100)),
    ]
}
