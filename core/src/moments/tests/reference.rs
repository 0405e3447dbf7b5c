//! Merges in `f64`.

use glam::Vec3;

use crate::kit::{Wide, dot, minus, normalize, wide};
use crate::moments::LightMoments;

/// [`LightMoments`] in `f64`.
pub struct Exact {
    pub phi: f64,
    pub c: Wide,
    pub across: f64,
    pub along: f64,
    pub m: Wide,
    pub h: Wide,
}

/// The merge's definition: sums over the sets, a set's covariance being symmetric about its own normal.
pub fn merged(sets: &[LightMoments]) -> Exact {
    let shining = || sets.iter().filter(|s| s.phi > 0.0);
    let phi: f64 = shining().map(|s| f64::from(s.phi)).sum();
    let share = |s: &LightMoments| f64::from(s.phi) / phi;
    let mean = |of: fn(&LightMoments) -> Vec3| {
        shining().fold([0.0; 3], |sum: Wide, s| {
            let own = wide(of(s));
            [0, 1, 2].map(|k| sum[k] + own[k] * share(s))
        })
    };
    let (c, m) = (mean(|s| s.c), mean(|s| s.m));
    let directed = dot(m, m) > 1.0 / 64.0;
    let axis = if directed { normalize(m) } else { [0.0; 3] };
    let (mut total, mut along, mut h) = (0.0, 0.0, [0.0_f64; 3]);
    for s in shining() {
        let d = minus(wide(s.c), c);
        let (va, vn) = (f64::from(s.across).powi(2), f64::from(s.along).powi(2));
        let own = wide(s.m);
        let squared = dot(own, own);
        let turn = if squared > 1.0 / 64.0 {
            dot(own, axis).powi(2) / squared
        } else {
            0.0
        };
        total += share(s) * (2.0 * va + vn + dot(d, d));
        along += share(s) * (va + (vn - va) * turn + dot(d, axis).powi(2));
        let half = wide(s.h);
        h = [0, 1, 2].map(|k| h[k].max(d[k].abs() + half[k]));
    }
    let along = if directed { along.min(total) } else { total / 3.0 };
    Exact {
        phi,
        c,
        across: ((total - along) / 2.0).sqrt(),
        along: along.sqrt(),
        m,
        h,
    }
}
