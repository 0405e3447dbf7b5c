//! Vectors and merges in `f64`.

use core::iter::Sum;
use core::ops::{Add, Div, Index, Mul, Sub};

use glam::Vec3;

use crate::moments::LightMoments;

#[derive(Clone, Copy)]
pub struct Wide([f64; 3]);

impl Wide {
    pub const ZERO: Self = Self([0.0; 3]);

    pub fn of(v: Vec3) -> Self {
        Self(v.to_array().map(f64::from))
    }

    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self([0, 1, 2].map(|k| f(self.0[k], other.0[k])))
    }

    pub fn dot(self, other: Self) -> f64 {
        (self.0[0] * other.0[0] + self.0[1] * other.0[1]) + self.0[2] * other.0[2]
    }

    pub fn length(self) -> f64 {
        self.dot(self).sqrt()
    }

    pub fn normalize(self) -> Self {
        self / self.length()
    }

    pub fn abs(self) -> Self {
        Self(self.0.map(f64::abs))
    }

    pub fn max(self, other: Self) -> Self {
        self.zip(other, f64::max)
    }

    pub fn cross(self, other: Self) -> Self {
        let (a, b) = (self.0, other.0);
        Self([
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ])
    }
}

impl Add for Wide {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl Sub for Wide {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl Mul<f64> for Wide {
    type Output = Self;
    fn mul(self, by: f64) -> Self {
        Self(self.0.map(|a| a * by))
    }
}

impl Div<f64> for Wide {
    type Output = Self;
    fn div(self, by: f64) -> Self {
        Self(self.0.map(|a| a / by))
    }
}

impl Sum for Wide {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::ZERO, Add::add)
    }
}

impl Index<usize> for Wide {
    type Output = f64;
    fn index(&self, k: usize) -> &f64 {
        &self.0[k]
    }
}

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
    let c: Wide = shining().map(|s| Wide::of(s.c) * share(s)).sum();
    let m: Wide = shining().map(|s| Wide::of(s.m) * share(s)).sum();
    let directed = m.dot(m) > 1.0 / 64.0;
    let axis = if directed { m.normalize() } else { Wide::ZERO };
    let (mut total, mut along, mut h) = (0.0, 0.0, Wide::ZERO);
    for s in shining() {
        let d = Wide::of(s.c) - c;
        let (va, vn) = (f64::from(s.across).powi(2), f64::from(s.along).powi(2));
        let own = Wide::of(s.m);
        let squared = own.dot(own);
        let turn = if squared > 1.0 / 64.0 {
            own.dot(axis).powi(2) / squared
        } else {
            0.0
        };
        total += share(s) * (2.0 * va + vn + d.dot(d));
        along += share(s) * (va + (vn - va) * turn + d.dot(axis).powi(2));
        h = h.max(d.abs() + Wide::of(s.h));
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
