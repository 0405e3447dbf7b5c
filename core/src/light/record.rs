//! What every kind of light is to a tree: words in an array, of which flux, place and direction can be known.

use core::fmt::Debug;

use bytemuck::Pod;
use glam::Vec3;

use super::{INVALID, LightPoint, MAX_RADIANCE, MIN_RADIANCE, TWO_SIDED};
use crate::beam::{Beam, Limits};
use crate::bounds::{LightBounds, LightMoments};
use crate::cone::Cone;
use crate::domain::{DomainError, NORMAL_TOLERANCE};
use crate::exact::{self, pow2};
use crate::instance::Instance;
use crate::vector::{flush3, greatest_exponent, length_squared, vector};

/// A light as the arrays of a light BVH hold it: plain words, the same on devices.
///
/// A tree is over lights of one such type, so what a scene lacks costs neither bytes nor instructions.
pub trait Light: Pod + PartialEq + Debug + Send + Sync {
    /// Name for messages and files.
    const NAME: &'static str;
    /// A light without flux, of no mesh.
    const DARK: Self;
    /// Which of its words is the [`mesh`](Self::mesh); all others are its own.
    const MESH_WORD: usize;
    /// The lights of a node's slots, as processors compute several of them at a time.
    #[doc(hidden)]
    type Slots<const W: usize>: LightSlots<Self, W>;

    /// Brings the light into the domain of this crate, or says why it cannot be. Coordinates smaller than
    /// [`MIN_COORDINATE`](super::MIN_COORDINATE) become zero; nothing else changes.
    ///
    /// # Errors
    /// [`DomainError`], naming the number.
    fn checked(self) -> Result<Self, DomainError>;
    /// Index of the mesh light that owns it.
    fn mesh(&self) -> u32;
    /// The same light of another mesh.
    #[must_use]
    fn of_mesh(self, mesh: u32) -> Self;
    /// What a builder takes for its centre of flux, metres.
    fn centroid(&self) -> [f32; 3];
    /// Greatest magnitude of a coordinate that it reaches, metres.
    fn reach(&self) -> f32;
    /// Whether it has flux.
    fn has_flux(&self) -> bool;
    /// Whether it emits from a surface: its flux then grows with area where an instance scales, else not at all.
    #[inline(always)]
    fn is_surface(&self) -> bool {
        true
    }
    /// Its light ends at this distance from its box, metres: [`Limits::ENDLESS`], unless it has a range. Read where nodes store beams alone.
    #[inline(always)]
    fn end(&self) -> f32 {
        Limits::ENDLESS
    }
    /// Where its light goes: anywhere, unless it is a spot. Read where nodes store beams, by nothing else.
    #[inline(always)]
    fn beam(&self) -> Beam {
        Beam::ANYWHERE
    }
    /// Bounds of its emission.
    fn bounds(&self) -> LightBounds;
    /// Moments of its emission; its flux is that of [`bounds`](Self::bounds).
    fn moments(&self) -> LightMoments;
    /// The light of a mesh as it stands in the world, where `instance` puts it, as part of mesh light `index`.
    #[must_use]
    fn in_world(&self, instance: &Instance, index: u32) -> Self;
    /// A point on the light, from two numbers in [0, 1), for a receiver at `from`: one that sends light there, if the kind can tell.
    fn point_for(&self, from: Vec3, uv: [f32; 2]) -> LightPoint;
    /// The place `p` on the light, where a ray has met it, as [`point_for`](Self::point_for) finds places for a receiver at `from`.
    #[inline(always)]
    fn point_at(&self, from: Vec3, p: Vec3) -> LightPoint {
        LightPoint {
            p: [p.x, p.y, p.z],
            ..self.point_for(from, [0.5; 2])
        }
    }
}

/// The lights of up to `W` slots.
#[doc(hidden)]
pub trait LightSlots<L, const W: usize>: Copy + Debug {
    /// No light.
    const NONE: Self;
    /// Puts `light` into `slot`.
    fn set(&mut self, slot: usize, light: &L);
    /// Leaves no light in `slot`: its words stay, and mean nothing.
    fn remove(&mut self, slot: usize);
    /// All ones where there is a light in `slot`, else zero.
    fn present(&self, slot: usize) -> u32;
    /// The light in `slot`, of mesh 0; any other where there is none.
    fn get(&self, slot: usize) -> L;
}

/// Lights one after another.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct Each<L, const W: usize> {
    lights: [L; W],
    present: [u32; W],
}

impl<L: Light, const W: usize> LightSlots<L, W> for Each<L, W> {
    const NONE: Self = Self {
        lights: [L::DARK; W],
        present: [0; W],
    };

    #[inline(always)]
    fn set(&mut self, slot: usize, light: &L) {
        self.lights[slot] = *light;
        self.present[slot] = u32::MAX;
    }

    #[inline(always)]
    fn remove(&mut self, slot: usize) {
        self.present[slot] = 0;
    }

    #[inline(always)]
    fn present(&self, slot: usize) -> u32 {
        self.present[slot]
    }

    #[inline(always)]
    fn get(&self, slot: usize) -> L {
        self.lights[slot]
    }
}

/// Light `light` of instance `instance` in the world, as a [`SampledLight`](crate::SampledLight) names them: `lights` are those
/// of all bottom levels, in the spaces of their meshes. Without radiance where there is no such light. In a single-level tree
/// `instance` is `u32::MAX`, and its one instance is meant.
#[inline]
#[must_use]
pub fn world_light<L: Light>(lights: &[L], instances: &[Instance], light: u32, instance: u32) -> L {
    let index = if instance == INVALID { 0 } else { instance };
    let mut out = L::DARK;
    if index < instances.len() as u32 {
        let own = instances[index as usize];
        let triangle = own.triangle_of(light);
        let is_own = light.wrapping_sub(own.first) < own.count;
        if is_own && triangle < lights.len() as u32 {
            let local = lights[triangle as usize];
            out = local.in_world(&own, index);
        }
    }
    out
}

/// Greatest magnitude among coordinates.
pub(super) fn greatest(coordinates: &[f32]) -> f32 {
    coordinates
        .iter()
        .fold(0.0, |most, &x| exact::max(most, exact::abs(x)))
}

/// Refuses flags of a light with sides that are no [`TWO_SIDED`].
pub(super) fn checked_sides(flags: u32) -> Result<(), DomainError> {
    if flags & !TWO_SIDED == 0 {
        return Ok(());
    }
    let expected = "0 or TWO_SIDED (1); clear the other bits";
    Err(DomainError::bits("the word of flags", flags, expected))
}

/// A direction of length 1, up to [`NORMAL_TOLERANCE`], at length 1.
pub(in crate::light) fn checked_axis(axis: [f32; 3]) -> Result<[f32; 3], DomainError> {
    let squared = length_squared(vector(&axis));
    // NaN is in no range.
    if (1.0 - NORMAL_TOLERANCE..=1.0 + NORMAL_TOLERANCE).contains(&squared) {
        Ok(unit(axis))
    } else {
        let what = "the axis of a spot";
        Err(DomainError::vector(what, axis, "length 1; normalize it"))
    }
}

/// Bounds of lights in a box about `p`.
#[inline(always)]
pub(super) fn bounds(p: &[f32; 3], half: Vec3, cone: Cone, phi: f32) -> LightBounds {
    LightBounds {
        min: vector(p) - half,
        max: vector(p) + half,
        axis: cone.axis,
        cos_theta_o: cone.cos_theta_o,
        phi,
    }
}

/// What a light of a mesh sends in the world: `factor` times as much, within the range; nothing where it has no flux in the mesh.
#[inline(always)]
pub(super) fn shining(emission: &[f32; 3], factor: &[f32; 3], has_flux: bool) -> [f32; 3] {
    let shine = |l: f32, factor: f32| {
        let scaled = exact::clamp(l * factor, MIN_RADIANCE, MAX_RADIANCE);
        let shines = (l > 0.0) & (factor > 0.0) & has_flux;
        if shines { scaled } else { 0.0 }
    };
    [
        shine(emission[0], factor[0]),
        shine(emission[1], factor[1]),
        shine(emission[2], factor[2]),
    ]
}

/// A direction at length 1, up to 2^-22; one that is so already stays.
fn unit(direction: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = direction.map(|x| exact::flush(x, pow2(-60)));
    let squared = x * x + y * y + z * z;
    let is_unit = squared > 1.0 - UNIT && squared < 1.0 + UNIT;
    let length = exact::sqrt(squared);
    let own = |x: f32| {
        if is_unit {
            x
        } else {
            exact::flush(exact::div(x, length), pow2(-60))
        }
    };
    [own(x), own(y), own(z)]
}

/// How far the square of a length is from 1 where it counts as 1.
const UNIT: f32 = pow2(-20);

/// The direction from `p` to `q`, of length 1 within 1e-5; zero where they are one point.
#[inline(always)]
pub(super) fn towards(p: Vec3, q: Vec3) -> Vec3 {
    let away = q - p;
    let scaled = flush3(away * pow2(-greatest_exponent(away, -100)), pow2(-60));
    scaled * exact::rsqrt(exact::max(length_squared(scaled), pow2(-60)))
}

/// What all kinds with a `mesh` have alike.
macro_rules! of_mesh {
    () => {
        const MESH_WORD: usize = core::mem::offset_of!(Self, mesh) / 4;

        #[inline(always)]
        fn mesh(&self) -> u32 {
            self.mesh
        }

        #[inline(always)]
        fn of_mesh(self, mesh: u32) -> Self {
            Self { mesh, ..self }
        }
    };
}

/// What all kinds with a place `p` and a `mesh` have alike.
macro_rules! of_mesh_at_place {
    () => {
        $crate::light::record::of_mesh!();

        #[inline(always)]
        fn centroid(&self) -> [f32; 3] {
            self.p
        }
    };
}

pub(super) use {of_mesh, of_mesh_at_place};
