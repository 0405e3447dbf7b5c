//! Images of known error and known time.

use std::time::Duration;

use super::*;

/// Half of the pixels too bright and half too dark, by a step that falls as the root of the rays.
struct Known {
    /// Time of a ray of all pixels, ms.
    ray_ms: f64,
    /// Of one ray, as radiance.
    step: f32,
}

impl Known {
    fn render(&self, params: RenderParams) -> Timed<Vec<[f32; 3]>> {
        let rays = params.samples;
        let off = match params.seed {
            REFERENCE_SEED.. => 0.0,
            _ => self.step / (rays as f32).sqrt(),
        };
        let value = |k: u32| 1.0 + if k.is_multiple_of(2) { off } else { -off };
        Timed {
            value: (0..params.width * params.height).map(|k| [value(k); 3]).collect(),
            time: Duration::from_secs_f64(1e-3 * self.ray_ms * f64::from(rays)),
        }
    }
}

const BUDGET: Budget = Budget {
    turns: 1,
    passes: 1,
    points: 1,
    width: 16,
    height: 16,
    samples: 12,
    frames: 1,
    seeds: 2,
    reference: 16,
};

fn measured(others: Vec<(Known, f64)>, update_ms: f64) -> Vec<Images> {
    let all: Vec<(Known, f64)> = [(known(1.0, STEP), update_ms)]
        .into_iter()
        .chain(others)
        .collect();
    let updates: Vec<f64> = all.iter().map(|(_, update)| *update).collect();
    let mut measured = Measured::default();
    measured
        .add(&updates, [0.0; 3], &BUDGET, |at, params| all[at].0.render(params))
        .expect("images");
    measured.finish().0
}

/// Several steps of a byte by twelve rays, and far from what a display bends by one.
const STEP: f32 = 0.2;

fn known(ray_ms: f64, step: f32) -> Known {
    Known { ray_ms, step }
}

fn near(found: f64, expected: f64, part: f64) {
    assert!(
        (found / expected - 1.0).abs() <= part,
        "{found} is not {expected}"
    );
}

/// Errors fall as the inverse of the rays, so that those at equal time are known: to the steps of a byte.
#[test]
fn equal_time_is_what_fits_beside_the_update() {
    const BYTES: f64 = 0.15;
    let images = measured(
        vec![
            (known(1.0, STEP), 1.0),
            // Twice the time of a ray, twice the squared error.
            (known(2.0, STEP * 2f32.sqrt()), 1.0),
            // Four milliseconds more for an update: 8 rays of 12.
            (known(1.0, STEP), 5.0),
            // No time for half a ray.
            (known(40.0, 0.5), 1.0),
            // Two rays and a half.
            (known(4.8, STEP), 1.0),
        ],
        1.0,
    );
    let [default, same, slow, late, slowest, between] = &images[..] else {
        panic!("{}", images.len());
    };
    assert_eq!(
        (default.samples_equal_time, default.equal_time_ratio.median),
        (12.0, 1.0)
    );
    near(same.equal_time_ratio.median, 1.0, 1e-9);
    near(slow.time_ratio.median, 2.0, 1e-9);
    near(slow.frame_ratio.median, 25.0 / 13.0, 1e-9);
    near(slow.samples_equal_time, 6.0, 1e-9);
    near(slow.error_ratio.median, 2.0, BYTES);
    near(slow.equal_time_ratio.median, 4.0, BYTES);
    near(late.frame_ratio.median, 17.0 / 13.0, 1e-9);
    near(late.samples_equal_time, 8.0, 1e-9);
    near(late.equal_time_ratio.median, 1.5, BYTES);
    near(between.samples_equal_time, 2.5, 1e-9);
    near(between.equal_time_ratio.median, 12.0 / 2.5, BYTES);
    assert_eq!(between.shown.1, 3);
    // The error of one ray, which a display bends, by what fits of it.
    near(slowest.samples_equal_time, 12.0 / 40.0, 1e-9);
    let one = slowest.error_equal_time * 0.3;
    assert!(one > 12.0 * (1.0 - BYTES) * default.error_equal_time && one < 255.0 * 255.0);
    assert!(
        images
            .iter()
            .all(|images| images.bias.expect("images").mean.abs() < 1e-3)
    );
}
