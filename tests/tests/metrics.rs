//! Images against references: answers known beforehand, and what is refused.

use lightbvh::exact::{hash, unit_f32};
use lightbvh_host::metrics::{Judge, MetricError};
use lightbvh_host::render::Film;

const WIDTH: u32 = 40;
const HEIGHT: u32 = 24;

fn noise(seed: u32) -> Vec<[f32; 3]> {
    (0..WIDTH * HEIGHT)
        .map(|i| std::array::from_fn(|k| unit_f32(hash(hash(seed) ^ (3 * i + k as u32)))))
        .collect()
}

fn film(pixels: Vec<[f32; 3]>) -> Film {
    Film::new(WIDTH, HEIGHT, pixels).expect("as many pixels as the image has")
}

#[test]
fn a_grey_step_has_the_error_of_its_bytes() {
    // Exposure 1: 0.18 shows as byte 109 and 0.36 as 147 by the display curve in f64 (0.36 -> 0.27070 -> 0.55751).
    let judge = Judge::new(film(vec![[0.18; 3]; 960]), 1.0).expect("finite");
    let quality = judge
        .judge(&film(vec![[0.36; 3]; 960]))
        .expect("one size")
        .quality;
    let shown = |x: f64| {
        let compressed = x * (1.0 + x / 16.0) / (1.0 + x);
        ((1.055 * compressed.powf(1.0 / 2.4) - 0.055) * 255.0 + 0.5).floor()
    };
    let (a, b) = (shown(0.18), shown(0.36));
    assert_eq!(quality.mse, (a - b) * (a - b));
    assert!((quality.linear_mse - 0.18 * 0.18).abs() < 1e-8);
    assert!((quality.relative_mse - 0.18 * 0.18 / (0.18 * 0.18 + 0.01)).abs() < 1e-6);
    // Flat images: the luminance term alone is left.
    let c1 = 6.5025;
    assert!((quality.ssim - (2.0 * a * b + c1) / (a * a + b * b + c1)).abs() < 1e-9);
}

#[test]
fn what_cannot_be_measured_is_refused() {
    let judge = Judge::new(film(noise(3)), 1.0).expect("finite");
    let small = Film::new(4, 4, vec![[0.0; 3]; 16]).expect("16 pixels");
    let error = judge.judge(&small).expect_err("another size");
    assert!(
        matches!(error, MetricError::Shapes { image: (4, 4), .. }),
        "{error}"
    );
    let mut pixels = noise(3);
    pixels[77][1] = f32::NAN;
    let error = judge.judge(&film(pixels.clone())).expect_err("not a number");
    assert_eq!(error, MetricError::NotFinite { pixel: 77 });
    assert!(Judge::new(film(pixels), 1.0).is_err());
}
