//! A receiver that is a piece of a ray, and distances along it.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use super::{PointError, Receiver, ShadingPoint};
use crate::exact::{self, div, pow2};
use crate::instance::Instance;
use crate::light::MIN_OFFSET;
use crate::vector::{abs3, flush3, greatest_exponent, length_squared, max3, vector};

/// A piece of a ray through a volume, from one point to another: light reaches it everywhere. What
/// [`Subtended`](crate::importance::Subtended) is told to choose a light by; [`sample`](Self::sample) then chooses a distance for that light.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct RaySegment {
    /// Where it begins, metres, coordinates of magnitude at most 2^40 ([`RaySegment::checked`]).
    pub from: [f32; 3],
    /// Where it ends, metres. A segment without length is a point in a volume.
    pub to: [f32; 3],
}

/// A place on a [`RaySegment`], and the density with which it was chosen: 8 bytes, the same on devices.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SegmentSample {
    /// Which part of the segment lies before it, 0 to 1: [`RaySegment::at`].
    pub part: f32,
    /// Density over length, 1/m; 0 where the segment is shorter than 2^-60 of its distance, or than 2^-100 m, and the place is worth nothing.
    pub density: f32,
}

/// How often the angle is halved before a place is chosen within a piece.
const HALVINGS: u32 = 2;
/// The density of a piece: all have the same share.
const SHARE: f32 = pow2(-(HALVINGS as i32));
/// Squared distances from the light count as this much more, in units of the scale: 2^-30, about the rounding of coordinates.
const LEAST_SQUARED: f32 = pow2(-30);
/// Least exponent of the scale.
const LEAST_EXPONENT: i32 = -40;
/// Segments shorter than this, in units of the scale, have no length.
const LEAST_LENGTH: f32 = pow2(LEAST_CHORD_EXPONENT);
const LEAST_CHORD_EXPONENT: i32 = -60;

/// A piece of the segment: where it begins and ends, as parts of the segment, and how far from the light.
#[derive(Clone, Copy)]
struct Piece {
    start: f32,
    end: f32,
    from_start: f32,
    from_end: f32,
}

/// The segment as the light sees it, lengths in units of a power of two.
#[derive(Clone, Copy)]
struct View {
    /// From the light to where it begins, and from there to where it ends.
    start: Vec3,
    chord: Vec3,
    exponent: i32,
}

impl RaySegment {
    /// Brings both ends into the domain of this crate, or says why they cannot be; see [`ShadingPoint::checked`].
    ///
    /// # Errors
    /// [`PointError::Coordinate`] for a coordinate that is not finite or beyond 2^40 m.
    pub fn checked(self) -> Result<Self, PointError> {
        let [from, to] = self.ends();
        Ok(Self {
            from: from.checked()?.p,
            to: to.checked()?.p,
        })
    }

    /// The place before which the part `part` of the segment lies, 0 to 1, metres.
    #[inline]
    #[must_use]
    pub fn at(&self, part: f32) -> [f32; 3] {
        let from = flush3(vector(&self.from) * (1.0 - part), MIN_OFFSET);
        let p = from + flush3(vector(&self.to) * part, MIN_OFFSET);
        [p.x, p.y, p.z]
    }

    /// Chooses a place on the segment for light from `center`, metres, such as a point on the light that was chosen, by `u` in [0, 1).
    ///
    /// The density is nearly in proportion to 1/d², d the distance from the light: equiangular sampling (Kulla & Fajardo 2012), without its
    /// tangent. The angle under which the light sees the segment is halved twice, each time by the theorem of the bisector, which takes
    /// one root; the pieces have equal shares. Within a piece the place is even over the chord between the two directions: the density,
    /// the product of the distances of both ends over the square of a linear function, is known without an arc, and is within 11 % of
    /// the equiangular one. It has no step from piece to piece.
    #[inline]
    #[must_use]
    pub fn sample(&self, center: Vec3, u: f32) -> SegmentSample {
        let view = self.view(center);
        let mut piece = view.whole();
        let mut u = exact::flush(exact::clamp(u, 0.0, 1.0), LEAST_LENGTH);
        for _ in 0..HALVINGS {
            let (middle, distance) = view.bisected(&piece);
            let is_after = u >= 0.5;
            u = if is_after { 2.0 * u - 1.0 } else { 2.0 * u };
            piece = piece.half(middle, distance, is_after);
        }
        let share = piece.from_start * u;
        let by = div(
            share,
            exact::max(piece.from_end * (1.0 - u) + share, LEAST_SQUARED),
        );
        let part = exact::min(piece.start + (piece.end - piece.start) * by, piece.end);
        SegmentSample {
            part,
            density: self.density(center, part),
        }
    }

    /// The density over length, 1/m, with which [`sample`](Self::sample) chooses the place at `part` for light from `center`: to the bit the
    /// one that comes with it.
    #[inline]
    #[must_use]
    pub fn density(&self, center: Vec3, part: f32) -> f32 {
        let view = self.view(center);
        let mut piece = view.whole();
        for _ in 0..HALVINGS {
            let (middle, distance) = view.bisected(&piece);
            piece = piece.half(middle, distance, part >= middle);
        }
        let across = (part - piece.start) * piece.from_end + (piece.end - part) * piece.from_start;
        let over = (piece.from_start * piece.from_end) * (piece.end - piece.start);
        // Of about 1, so that its square is precise.
        let e = greatest_exponent(abs3(view.chord), LEAST_CHORD_EXPONENT);
        let chord = flush3(view.chord * pow2(-e), LEAST_LENGTH);
        let length = exact::sqrt(exact::max(length_squared(chord), LEAST_SQUARED));
        let is_within = (across > 0.0) & (over > 0.0) & (length * pow2(e) > LEAST_LENGTH);
        let squared = if is_within { across * across } else { 1.0 };
        let density = div(SHARE * div(over, squared), length) * pow2(-(view.exponent + e));
        if is_within { density } else { 0.0 }
    }

    #[inline(always)]
    fn view(&self, center: Vec3) -> View {
        let (start, end) = (vector(&self.from) - center, vector(&self.to) - center);
        let exponent = greatest_exponent(max3(abs3(start), abs3(end)), LEAST_EXPONENT);
        let to_one = pow2(-exponent);
        View {
            start: start * to_one,
            chord: (vector(&self.to) - vector(&self.from)) * to_one,
            exponent,
        }
    }

    /// Both ends, in a volume.
    #[inline(always)]
    fn ends(&self) -> [ShadingPoint; 2] {
        let n = [0.0; 3];
        [ShadingPoint { p: self.from, n }, ShadingPoint { p: self.to, n }]
    }
}

impl View {
    /// The distance of the light from the place at `part`.
    #[inline(always)]
    fn distance(&self, part: f32) -> f32 {
        exact::sqrt(length_squared(self.start + self.chord * part) + LEAST_SQUARED)
    }

    #[inline(always)]
    fn whole(&self) -> Piece {
        Piece {
            start: 0.0,
            end: 1.0,
            from_start: self.distance(0.0),
            from_end: self.distance(1.0),
        }
    }

    /// Where the bisector of the angle meets the piece, and how far from the light: it divides the piece as the distances of its ends are.
    #[inline(always)]
    fn bisected(&self, piece: &Piece) -> (f32, f32) {
        let by = div(piece.from_start, piece.from_start + piece.from_end);
        let middle = exact::min(piece.start + (piece.end - piece.start) * by, piece.end);
        (middle, self.distance(middle))
    }
}

impl Piece {
    #[inline(always)]
    fn half(&self, middle: f32, distance: f32, is_after: bool) -> Self {
        Self {
            start: if is_after { middle } else { self.start },
            end: if is_after { self.end } else { middle },
            from_start: if is_after { distance } else { self.from_start },
            from_end: if is_after { self.from_end } else { distance },
        }
    }
}

impl Receiver for RaySegment {
    /// A map that is not a similarity changes the distances of lights from the segment: that costs variance.
    #[inline(always)]
    fn to_local(&self, instance: &Instance) -> Self {
        let [from, to] = self.ends();
        Self {
            from: instance.to_local(&from).p,
            to: instance.to_local(&to).p,
        }
    }
}
