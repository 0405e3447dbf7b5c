//! Lights as moments: what the default importance knows of a set of lights.
//!
//! A child is chosen by a *mean* of what its lights send, not by a bound on it: total flux, flux-weighted centre, standard
//! deviations of position across and along the mean normal, and the mean normal itself, whose length says how the normals
//! spread. Merging them is exact up to rounding: they are sums. The box serves for one thing: how much of the set can lie above
//! the receiver's horizon.

use glam::Vec3;

use crate::bounds::{LightBounds, MAX_SUM};
use crate::cone::Cone;
use crate::exact::{self, exponent, pow2};
use crate::instance::Instance;
use crate::light::EmissiveTriangle;
use crate::summary::{SUMMARY_WORDS, Summary};
use crate::vector::{abs3, cross, dot, flush3, greatest_exponent, max3};

/// Flux below this part of the greatest among its siblings moves no centre: 2^-40. It keeps products of flux and squared
/// lengths normal.
const LEAST_SHARE: f32 = pow2(-40);
/// Squares below this, in units of the set's size squared, count as zero: what a device flushes is far below it.
const LEAST_SQUARE: f32 = pow2(-60);
/// Squared length of a mean normal below which it has no direction: 2^-6.
const LEAST_NORMAL: f32 = pow2(-6);
/// Least exponent of a set's size: 2^-100 m, the least difference of coordinates.
pub(crate) const LEAST_EXPONENT: i32 = -100;

/// A constant of its own: rust-gpu does not fold an expression of literals.
const TWENTY_FOURTH: f32 = 1.0 / 24.0;

/// What is known of a set of lights.
///
/// Standard deviations, not variances: the squares of the accepted lengths (2^-100 m to 2^41 m) leave the range of `f32`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightMoments {
    /// Radiant flux Φ, W, weighted by luminance; zero, or in 2^-100..=2^126.
    pub phi: f32,
    /// Flux-weighted centre, metres.
    pub c: Vec3,
    /// Standard deviation of position across the mean normal, per axis, metres.
    pub across: f32,
    /// Standard deviation of position along the mean normal, metres; equal to `across` where there is no such direction.
    pub along: f32,
    /// Flux-weighted mean of the unit normals; zero for lights that shine from both sides.
    pub m: Vec3,
    /// Half extents, about the centre, of a box around the lights, metres.
    pub h: Vec3,
}

impl LightMoments {
    /// No light at all.
    pub const EMPTY: Self = Self {
        phi: 0.0,
        c: Vec3::new(0.0, 0.0, 0.0),
        across: 0.0,
        along: 0.0,
        m: Vec3::new(0.0, 0.0, 0.0),
        h: Vec3::new(0.0, 0.0, 0.0),
    };

    /// Moments of one triangle; its flux is that of [`LightBounds::of_triangle`].
    #[inline(always)]
    #[must_use]
    pub fn of_triangle(triangle: &EmissiveTriangle) -> Self {
        const THIRD: f32 = 0.333_333_34;
        let phi = LightBounds::of_triangle(triangle).phi;
        let p0 = triangle.vertex(0);
        let (e1, e2) = (triangle.vertex(1) - p0, triangle.vertex(2) - p0);
        // Edges of about 1 by a power of two, so that no product leaves the range.
        let e = greatest_exponent(e1, greatest_exponent(e2, LEAST_EXPONENT));
        let (a, b) = (e1 * pow2(-e), e2 * pow2(-e));
        let mean = (a + b) * THIRD;
        let (da, db) = (a - mean, b - mean);
        // The variance of a triangle is the sum of its vertices' squares over 12, of all axes; it has two.
        let sum = (dot(mean, mean) + dot(da, da)) + dot(db, db);
        let spread = exact::sqrt(sum * TWENTY_FOURTH);
        let unit = pow2(e);
        let normal = cross(a, b);
        let ne = greatest_exponent(normal, -60);
        let n = normal * pow2(-ne);
        let n_squared = dot(n, n);
        let sides = if triangle.is_two_sided() | (n_squared < 0.5) {
            0.0
        } else {
            exact::rsqrt(n_squared)
        };
        let flat = if sides > 0.0 { 0.0 } else { spread };
        let moments = Self {
            phi,
            c: p0 + mean * unit,
            across: spread * unit,
            along: flat * unit,
            m: n * sides,
            h: max3(abs3(mean), max3(abs3(da), abs3(db))) * unit,
        };
        if phi > 0.0 { moments } else { Self::EMPTY }
    }

    /// The moments of `W` sets together, summed in slot order; sets without flux are ignored.
    #[inline]
    #[must_use]
    pub fn merge<const W: usize>(sets: &[Self; W]) -> Self {
        // Flux and lengths on scales of their own by powers of two. The reference is the brightest set's centre: what
        // cancels in the differences from it is less than what is far away could bring.
        let mut greatest = 0.0;
        let mut origin = Vec3::new(0.0, 0.0, 0.0);
        for i in 0..W {
            let brighter = sets[i].phi > greatest;
            greatest = if brighter { sets[i].phi } else { greatest };
            origin = if brighter { sets[i].c } else { origin };
        }
        let mut size = LEAST_EXPONENT;
        for i in 0..W {
            let s = &sets[i];
            let reach = abs3(from(s, origin)) + max3(s.h, Vec3::new(s.across, s.along, 0.0));
            let e = greatest_exponent(reach, size);
            size = if s.phi > 0.0 { e } else { size };
        }
        // One more, so that sums of a centre's offset and an extent stay below 2.
        let size = size + 1;
        let (to_one, unit) = (pow2(-size), pow2(size));
        let phi_exponent = exponent(greatest);
        // In two steps: from 2^126 to 2^-100 is more than one power of two.
        let half = phi_exponent / 2;
        let (first, second) = (pow2(-half), pow2(half - phi_exponent));

        let mut flux = 0.0;
        let mut c = Vec3::new(0.0, 0.0, 0.0);
        let mut m = Vec3::new(0.0, 0.0, 0.0);
        for i in 0..W {
            let s = &sets[i];
            let f = exact::flush((s.phi * first) * second, LEAST_SHARE);
            flux += f;
            c += (from(s, origin) * to_one) * f;
            m += s.m * f;
        }
        let shines = flux > 0.0;
        let per_flux = exact::div(1.0, if shines { flux } else { 1.0 });
        let center = c * per_flux;
        let mean = flush3(m * per_flux, LEAST_SQUARE);
        let length_squared = dot(mean, mean);
        let directed = length_squared > LEAST_NORMAL;
        let axis = if directed {
            mean * exact::rsqrt(length_squared)
        } else {
            Vec3::new(0.0, 0.0, 0.0)
        };

        let mut total = 0.0;
        let mut along = 0.0;
        let mut h = Vec3::new(0.0, 0.0, 0.0);
        let mut phi = 0.0;
        for i in 0..W {
            let s = &sets[i];
            let f = exact::flush((s.phi * first) * second, LEAST_SHARE);
            let d = from(s, origin) * to_one - center;
            let (sa, sn) = (s.across * to_one, s.along * to_one);
            let (va, vn) = (sa * sa, sn * sn);
            let own = dot(s.m, s.m);
            let cosine = dot(s.m, axis);
            // The child's covariance is axially symmetric about its own normal; none has no axis to turn.
            let turn = if own > LEAST_NORMAL {
                cosine * cosine * exact::recip(exact::max(own, LEAST_NORMAL))
            } else {
                0.0
            };
            let off = dot(d, axis);
            total += f * ((va + va + vn) + dot(d, d));
            along += f * ((va + (vn - va) * turn) + off * off);
            let reach = abs3(d) + s.h * to_one;
            h = if s.phi > 0.0 { max3(h, reach) } else { h };
            phi += s.phi;
            // Each is at most 2^126, so the sum of two does not overflow.
            phi = exact::min(phi, MAX_SUM);
        }
        let total = exact::flush(total * per_flux, LEAST_SQUARE);
        let third = total * 0.333_333_34;
        let along = exact::flush(exact::max(along * per_flux, 0.0), LEAST_SQUARE);
        let along = if directed { exact::min(along, total) } else { third };
        let across = exact::flush((total - along) * 0.5, LEAST_SQUARE);
        if shines {
            Self {
                phi,
                c: origin + flush3(center, LEAST_SQUARE) * unit,
                across: exact::sqrt(across) * unit,
                along: exact::sqrt(along) * unit,
                m: mean,
                h: flush3(h, LEAST_SQUARE) * unit,
            }
        } else {
            Self::EMPTY
        }
    }
}

/// Where a set's centre lies from `origin`; there, for a set without flux, whose numbers mean nothing.
#[inline(always)]
fn from(set: &LightMoments, origin: Vec3) -> Vec3 {
    if set.phi > 0.0 {
        set.c - origin
    } else {
        Vec3::new(0.0, 0.0, 0.0)
    }
}

impl Summary for LightMoments {
    const EMPTY: Self = Self::EMPTY;
    const NAMES: [&'static str; SUMMARY_WORDS] = [
        "flux",
        "centre x",
        "centre y",
        "centre z",
        "deviation across",
        "deviation along",
        "normal x",
        "normal y",
        "normal z",
        "half extent x",
        "half extent y",
        "half extent z",
    ];

    #[inline(always)]
    fn of_triangle(triangle: &EmissiveTriangle) -> Self {
        Self::of_triangle(triangle)
    }

    #[inline(always)]
    fn merged<const W: usize>(children: &[Self; W]) -> Self {
        Self::merge(children)
    }

    #[inline(always)]
    fn to_world(&self, instance: &Instance) -> Self {
        instance.moments_to_world(self)
    }

    #[inline(always)]
    fn phi(&self) -> f32 {
        self.phi
    }

    #[inline(always)]
    fn center(&self) -> Vec3 {
        self.c
    }

    /// Zero for lights nearer together than 2^-60 m.
    #[inline(always)]
    fn spread(&self) -> f32 {
        let (across, along) = (
            exact::flush(self.across, pow2(-60)),
            exact::flush(self.along, pow2(-60)),
        );
        2.0 * (across * across) + along * along
    }

    /// The box, and the cone of one direction where all normals are alike; else all directions.
    fn bounds(&self) -> LightBounds {
        let length_squared = dot(self.m, self.m);
        let alike = length_squared > 0.999;
        LightBounds {
            min: self.c - self.h,
            max: self.c + self.h,
            axis: if alike { self.m } else { Cone::SPHERE.axis },
            cos_theta_o: if alike { 1.0 } else { -1.0 },
            cos_theta_e: 0.0,
            phi: self.phi,
        }
    }

    /// Means need not contain their parts.
    fn uncontained(&self, _child: &Self) -> Option<usize> {
        None
    }

    #[inline(always)]
    fn to_words(&self) -> [f32; SUMMARY_WORDS] {
        let (c, m, h) = (self.c, self.m, self.h);
        [
            self.phi,
            c.x,
            c.y,
            c.z,
            self.across,
            self.along,
            m.x,
            m.y,
            m.z,
            h.x,
            h.y,
            h.z,
        ]
    }

    #[inline(always)]
    fn from_words(words: &[f32; SUMMARY_WORDS]) -> Self {
        Self {
            phi: words[0],
            c: Vec3::new(words[1], words[2], words[3]),
            across: words[4],
            along: words[5],
            m: Vec3::new(words[6], words[7], words[8]),
            h: Vec3::new(words[9], words[10], words[11]),
        }
    }
}
