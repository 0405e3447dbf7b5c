//! A receiver that is many points.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use super::{MAX_REACH, NORMAL_TOLERANCE, Receiver, ShadingPoint};
use crate::domain::{DomainError, MAX_COORDINATE, MIN_COORDINATE, checked_place};
use crate::exact::{self, flush, pow2};
use crate::instance::{FAR, Instance, flushed};
use crate::vector::{abs3, length_squared, max3, min3, vector};

/// A box of points that share their candidates: a tile of the screen, a cell of a cache, a part of a volume. The default importance,
/// [`Moments`](crate::importance::Moments), takes it as it takes a [`ShadingPoint`]: [`LightTree::sample_many`](crate::LightTree::sample_many)
/// chooses lights for all of its points, each with its exact probability, and a light with flux has a positive one wherever the point lies and
/// whichever its normal is.
///
/// A cell of one surface, or of normals about one axis, has little more variance at its points than walks of their own; a corner of floor and
/// wall is better split in two.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Cell {
    /// The middle of the box, metres, coordinates of magnitude at most 2^40.
    pub center: [f32; 3],
    /// Half the box's sides, metres, from 0 to 2^40.
    pub half: [f32; 3],
    /// The mean of the points' normals: of length 1 where they are alike, the shorter the more they spread. Zero in a volume.
    pub n: [f32; 3],
}

impl Cell {
    /// A box in a volume, between two opposite corners.
    #[must_use]
    pub fn volume(low: [f32; 3], high: [f32; 3]) -> Self {
        let (low, high) = (vector(&low), vector(&high));
        let center = low * 0.5 + high * 0.5;
        Self {
            center: center.to_array(),
            half: (abs3(high - low) * 0.5).to_array(),
            n: [0.0; 3],
        }
    }

    /// The box around [checked](ShadingPoint::checked) points, and the sum of their normals by the sum of the normals' lengths, of which a zero
    /// normal has 1. `None` if there are no points.
    #[must_use]
    pub fn around(points: &[ShadingPoint]) -> Option<Self> {
        let first = points.first()?.position();
        let (mut low, mut high, mut sum, mut lengths) = (first, first, [0.0; 3], 0.0);
        for point in points {
            low = min3(low, point.position());
            high = max3(high, point.position());
            // In f64: there may be more points than an f32 counts.
            let squared = length_squared(point.normal());
            lengths += f64::from(if squared > 0.0 { exact::sqrt(squared) } else { 1.0 });
            (0..3).for_each(|axis| sum[axis] += f64::from(point.n[axis]));
        }
        Some(Self {
            n: sum.map(|x| (x / lengths) as f32),
            ..Self::volume(low.to_array(), high.to_array())
        })
    }

    /// Brings the cell into the domain of this crate, or says why it cannot be; see [`ShadingPoint::checked`].
    ///
    /// # Errors
    /// [`DomainError`] for a middle that is not finite or beyond 2^40 m, half a side that is negative, not finite or beyond 2^40 m, and a mean
    /// normal longer than 1.
    pub fn checked(self) -> Result<Self, DomainError> {
        let small = |v: [f32; 3]| v.map(|x| flush(x, MIN_COORDINATE));
        let cell = Self {
            center: checked_place("middle of a cell", self.center)?,
            half: small(self.half),
            n: small(self.n),
        };
        if !are_sides(&cell.half, MAX_COORDINATE) {
            let what = "half the sides of a cell";
            return Err(DomainError::vector(what, cell.half, "0 to 2^40 (1.1e12) each"));
        }
        if cell.has_sound_normal() {
            Ok(cell)
        } else {
            let expected = "length at most 1; take the mean of unit normals";
            Err(DomainError::vector("the mean normal of a cell", cell.n, expected))
        }
    }

    fn has_sound_normal(&self) -> bool {
        length_squared(vector(&self.n)) <= 1.0 + NORMAL_TOLERANCE
    }
}

/// Whether all are from 0 to `most`.
fn are_sides(half: &[f32; 3], most: f32) -> bool {
    let within = |x: f32| (0.0..=most).contains(&x);
    within(half[0]) & within(half[1]) & within(half[2])
}

impl Receiver for Cell {
    /// The box around the mapped one. Under a map that bends angles normals are spread otherwise, which costs variance.
    #[inline(always)]
    fn to_local(&self, instance: &Instance) -> Self {
        let point = instance.to_local(&ShadingPoint {
            p: self.center,
            n: self.n,
        });
        let squared = exact::max(length_squared(flushed(vector(&self.n))), pow2(-119));
        let n = flushed(point.normal() * (squared * exact::rsqrt(squared)));
        let half = flushed(vector(&self.half));
        let [x, y, z] = &instance.inverse;
        let half = (abs3(vector(x)) * half.x + abs3(vector(y)) * half.y) + abs3(vector(z)) * half.z;
        let far = Vec3::new(FAR, FAR, FAR);
        Self {
            center: point.p,
            half: flushed(min3(half, far)).to_array(),
            n: n.to_array(),
        }
    }

    fn is_within_reach(&self) -> bool {
        let mut within = self.has_sound_normal() & are_sides(&self.half, MAX_REACH);
        for axis in 0..3 {
            within &= (-MAX_REACH..=MAX_REACH).contains(&self.center[axis]);
        }
        within
    }
}
