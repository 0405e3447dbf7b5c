//! Rectangles and discs that shine from one side or from both.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use super::record::{Each, Light, bounds, checked_sides, greatest, of_mesh_at_place, shining};
use super::round::disc;
use super::{INVALID, LightPoint, MIN_OFFSET, TWO_SIDED};
use crate::bounds::{LightBounds, LightMoments};
use crate::cone::{Cone, normalized};
use crate::domain::{DomainError, checked_emission, checked_place};
use crate::emission::{Emission, flux_of, luminance_of};
use crate::exact::{self, pow2};
use crate::instance::Instance;
use crate::vector::{abs3, dot, flush3, greatest_exponent, max3, vector};

/// The difference of the two shapes.
#[derive(Clone, Copy)]
struct Shape {
    /// The inverse of area over the length of the half axes' product.
    per_area: f32,
    /// Flux over luminance and that length: π times the area, of one side.
    flux: f32,
    /// Variance over the squares of the half axes, halved: a flat light has two axes of it.
    half_variance: f32,
}

const PI: f32 = core::f32::consts::PI;

const RECTANGLE: Shape = Shape {
    per_area: 0.25,
    flux: 4.0 * PI,
    half_variance: 1.0 / 6.0,
};

const DISC: Shape = Shape {
    per_area: core::f32::consts::FRAC_1_PI,
    flux: PI * PI,
    half_variance: 1.0 / 8.0,
};

/// Least exponent of a set's size, as of triangles.
const LEAST_EXPONENT: i32 = -100;
/// Exponent of the least cross product, in units of the longest axis squared, that has a direction.
const LEAST_CROSS: i32 = -60;
/// The normal of axes whose product is less than this part of the longer one squared may be turned by rounding: its cone is all directions.
const LEAST_NORMAL: i32 = -16;
/// What rounding turns the normal of others by at most, 2^-5 rad: half its square.
const TURN: f32 = pow2(-11);

/// The axes by a power of two, so that no product of theirs leaves the range; and the light's emission.
struct Scaled {
    a: Vec3,
    b: Vec3,
    e: i32,
    emission: Emission,
}

/// Half extents of a rectangle: the sums of its axes' magnitudes.
#[inline(always)]
fn box_of(a: Vec3, b: Vec3) -> Vec3 {
    abs3(a) + abs3(b)
}

/// Half extents of an ellipse with these half axes.
#[inline(always)]
fn ellipse_of(a: Vec3, b: Vec3) -> Vec3 {
    let (a, b) = (abs3(a), abs3(b));
    let e = greatest_exponent(max3(a, b), LEAST_EXPONENT);
    let (to_one, unit) = (exact::power(-e), exact::power(e));
    let half = |a: f32, b: f32| {
        let (a, b) = (
            exact::flush(a * to_one, pow2(-60)),
            exact::flush(b * to_one, pow2(-60)),
        );
        exact::sqrt(a * a + b * b) * unit
    };
    Vec3::new(half(a.x, b.x), half(a.y, b.y), half(a.z, b.z))
}

macro_rules! flat_light {
    ($(#[$doc:meta])* $name:ident, $text:literal, $shape:expr, $half:expr, $place:expr) => {
        $(#[$doc])*
        #[repr(C)]
        #[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
        pub struct $name {
            /// Its centre, metres, in the space of its mesh.
            pub p: [f32; 3],
            /// From the centre to the middles of two neighbouring sides, metres; their cross product points to the front.
            pub half: [[f32; 3]; 2],
            /// Radiance, W/(m² sr), linear RGB; zero or from 2^-100 to 2^100.
            pub radiance: [f32; 3],
            /// Index of the mesh light that owns it.
            pub mesh: u32,
            /// [`TWO_SIDED`](super::EmissiveTriangle::TWO_SIDED) or 0.
            pub flags: u32,
        }

        impl $name {
            #[inline(always)]
            fn is_two_sided(&self) -> bool {
                self.flags & TWO_SIDED != 0
            }

            #[inline(always)]
            fn scaled(&self) -> Scaled {
                let (a, b) = (vector(&self.half[0]), vector(&self.half[1]));
                let e = greatest_exponent(max3(abs3(a), abs3(b)), LEAST_EXPONENT);
                let to_one = exact::power(-e);
                let (a, b) = (a * to_one, b * to_one);
                let sides = if self.is_two_sided() { 2.0 } else { 1.0 };
                let emission = flux_of(a, b, e, luminance_of(&self.radiance), $shape.flux * sides);
                Scaled { a, b, e, emission }
            }

            /// Half extents.
            #[inline(always)]
            fn extent(&self) -> Vec3 {
                $half(vector(&self.half[0]), vector(&self.half[1]))
            }
        }

        impl Light for $name {
            const NAME: &'static str = $text;
            const DARK: Self = Self {
                p: [0.0; 3],
                half: [[0.0; 3]; 2],
                radiance: [0.0; 3],
                mesh: INVALID,
                flags: 0,
            };
            of_mesh_at_place!();
            type Slots<const W: usize> = Each<Self, W>;

            fn checked(mut self) -> Result<Self, DomainError> {
                self.p = checked_place(concat!("centre of a ", $text), self.p)?;
                for k in 0..2 {
                    self.half[k] = checked_place(concat!("half axis of a ", $text), self.half[k])?;
                }
                self.radiance = checked_emission(concat!("radiance of a ", $text), self.radiance)?;
                checked_sides(self.flags)?;
                Ok(self)
            }

            fn reach(&self) -> f32 {
                let edges = greatest(&self.half[0]) + greatest(&self.half[1]);
                exact::min(greatest(&self.p) + edges, super::MAX_COORDINATE)
            }

            #[inline(always)]
            fn has_flux(&self) -> bool {
                self.scaled().emission.phi > 0.0
            }

            #[inline(always)]
            fn bounds(&self) -> LightBounds {
                let own = self.scaled();
                let directed = !self.is_two_sided() & (own.emission.exponent >= LEAST_NORMAL);
                let cone = if directed {
                    Cone {
                        axis: normalized(own.emission.normal),
                        cos_theta_o: 1.0 - TURN,
                    }
                } else {
                    Cone::SPHERE
                };
                bounds(&self.p, self.extent(), cone, own.emission.phi)
            }

            #[inline(always)]
            fn moments(&self) -> LightMoments {
                let own = self.scaled();
                let sum = dot(own.a, own.a) + dot(own.b, own.b);
                let across = exact::sqrt(sum * $shape.half_variance) * exact::power(own.e);
                let directed = !self.is_two_sided() & (own.emission.exponent >= LEAST_CROSS);
                let directed = exact::mask_of(directed);
                LightMoments {
                    phi: own.emission.phi,
                    c: vector(&self.p),
                    across,
                    along: exact::masked(!directed, across),
                    m: own.emission.normal * exact::masked(directed, exact::rsqrt(own.emission.squared)),
                    h: self.extent(),
                }
            }

            /// Where the map mirrors, the axes change places, so that the front stays in front.
            #[inline(always)]
            fn in_world(&self, instance: &Instance, index: u32) -> Self {
                let a = instance.edge_to_world(vector(&self.half[0]));
                let b = instance.edge_to_world(vector(&self.half[1]));
                let mirrored = instance.mirrors();
                let (first, second) = if mirrored { (b, a) } else { (a, b) };
                Self {
                    p: instance.vertex(self.p),
                    half: [[first.x, first.y, first.z], [second.x, second.y, second.z]],
                    radiance: shining(&self.radiance, &instance.radiance, self.has_flux()),
                    mesh: index,
                    flags: self.flags,
                }
            }

            #[inline(always)]
            fn point_for(&self, _from: Vec3, uv: [f32; 2]) -> LightPoint {
                let own = self.scaled();
                let [x, y] = $place(uv);
                let has_area = own.emission.exponent >= -100;
                let per_length = exact::div(1.0, exact::sqrt(own.emission.squared));
                let exponent = own.emission.exponent + own.e + own.e;
                let density = (per_length * $shape.per_area) * pow2(-exponent);
                let along = flush3(vector(&self.half[0]) * x, MIN_OFFSET);
                let p = vector(&self.p) + (along + flush3(vector(&self.half[1]) * y, MIN_OFFSET));
                let n = own.emission.normal * per_length;
                LightPoint::on_surface((p, n), has_area, density, self.flags, self.radiance)
            }
        }
    };
}

#[inline(always)]
fn square(uv: [f32; 2]) -> [f32; 2] {
    [2.0 * uv[0] - 1.0, 2.0 * uv[1] - 1.0]
}

flat_light!(
    /// A parallelogram, a rectangle where its axes are square to each other, that emits the same radiance in every direction of its
    /// front side (or of both sides).
    RectangleLight,
    "rectangle",
    RECTANGLE,
    box_of,
    square
);

flat_light!(
    /// An ellipse, a disc where its half axes are of one length and square to each other, that emits the same radiance in every direction
    /// of its front side (or of both sides).
    DiscLight,
    "disc",
    DISC,
    ellipse_of,
    disc
);
