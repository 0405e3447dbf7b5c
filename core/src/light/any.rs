//! A light of any kind, for trees over several of them.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use super::record::{Each, Light, of_mesh};
use super::{
    DiscLight, EmissiveTriangle, INVALID, LightPoint, PointLight, RectangleLight, SphereLight, SpotLight,
    TWO_SIDED,
};
use crate::beam::{Beam, Limits};
use crate::bounds::{LightBounds, LightMoments};
use crate::domain::DomainError;
use crate::instance::Instance;

/// A light of any kind: 56 bytes, read by [`kind`](Self::kind). `From` makes it of a light of one kind, `TryFrom` that light
/// of it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct AnyLight {
    /// A place, then axes, edges, radius and cosines as the kind has them, in the order of its fields; zero where it has fewer.
    words: [[f32; 3]; 3],
    /// Radiance or intensity, linear RGB.
    emission: [f32; 3],
    /// Index of the mesh light that owns it.
    mesh: u32,
    /// The kind, and above it [`TWO_SIDED`](EmissiveTriangle::TWO_SIDED) where it has sides.
    kind: u32,
}

/// Bits of the kind; the flags stand above them.
const KIND_BITS: u32 = 8;

impl AnyLight {
    /// An [`EmissiveTriangle`].
    pub const TRIANGLE: u32 = 0;
    /// A [`PointLight`].
    pub const POINT: u32 = 1;
    /// A [`SpotLight`].
    pub const SPOT: u32 = 2;
    /// A [`SphereLight`].
    pub const SPHERE: u32 = 3;
    /// A [`RectangleLight`].
    pub const RECTANGLE: u32 = 4;
    /// A [`DiscLight`].
    pub const DISC: u32 = 5;

    /// Which kind it is: one of the constants.
    #[inline(always)]
    #[must_use]
    pub fn kind(&self) -> u32 {
        self.kind & ((1 << KIND_BITS) - 1)
    }

    /// Radiance of its surface, W/(m² sr), or where the kind has no surface its intensity, W/sr. Linear RGB.
    #[inline(always)]
    #[must_use]
    pub fn emission(&self) -> [f32; 3] {
        self.emission
    }

    /// The light with another [`emission`](Self::emission), in the range of its kind.
    #[inline(always)]
    #[must_use]
    pub fn with_emission(self, emission: [f32; 3]) -> Self {
        Self { emission, ..self }
    }

    /// Whether both of its sides emit.
    #[inline(always)]
    #[must_use]
    pub fn is_two_sided(&self) -> bool {
        self.flags() & TWO_SIDED != 0
    }

    #[inline(always)]
    fn flags(&self) -> u32 {
        self.kind >> KIND_BITS
    }
}

/// Words that a kind has not.
const NONE: [f32; 3] = [0.0; 3];

/// For each kind the light that the words say, by a function of this name, and the flags and words of a light.
macro_rules! kinds {
    ($any:ident, $own:ident: $($as:ident: $light:ident $kind:ident $emission:ident {
        $($field:ident: $of:expr),*
    } $flags:expr, $words:expr;)*) => {
        impl AnyLight {
            $(#[inline(always)]
            fn $as(&self) -> $light {
                let $any = self;
                $light { $emission: $any.emission, mesh: $any.mesh, $($field: $of),* }
            })*
        }

        $(impl From<$light> for AnyLight {
            #[inline(always)]
            fn from($own: $light) -> Self {
                Self {
                    words: $words,
                    emission: $own.$emission,
                    mesh: $own.mesh,
                    kind: Self::$kind | ($flags << KIND_BITS),
                }
            }
        }

        impl TryFrom<AnyLight> for $light {
            type Error = AnyLight;

            /// The light itself where it is of another kind.
            fn try_from(any: AnyLight) -> Result<Self, AnyLight> {
                if any.kind() == AnyLight::$kind { Ok(any.$as()) } else { Err(any) }
            }
        })*
    };
}

kinds!(any, own:
    triangle: EmissiveTriangle TRIANGLE radiance {
        p: [any.words[0], any.words[1], any.words[2]], flags: any.flags()
    } own.flags, [own.p[0], own.p[1], own.p[2]];
    point: PointLight POINT intensity {
        p: any.words[0], range: any.words[1][0]
    } 0, [own.p, [own.range, 0.0, 0.0], NONE];
    spot: SpotLight SPOT intensity {
        p: any.words[0], axis: any.words[1],
        cos_inner: any.words[2][0], cos_outer: any.words[2][1], range: any.words[2][2]
    } 0, [own.p, own.axis, [own.cos_inner, own.cos_outer, own.range]];
    sphere: SphereLight SPHERE radiance {
        p: any.words[0], radius: any.words[1][0]
    } 0, [own.p, [own.radius, 0.0, 0.0], NONE];
    rectangle: RectangleLight RECTANGLE radiance {
        p: any.words[0], half: [any.words[1], any.words[2]], flags: any.flags()
    } own.flags, [own.p, own.half[0], own.half[1]];
    disc: DiscLight DISC radiance {
        p: any.words[0], half: [any.words[1], any.words[2]], flags: any.flags()
    } own.flags, [own.p, own.half[0], own.half[1]];
);

/// Evaluates `$of` on the light as its own type; one of an unknown kind is a triangle without area and radiance.
macro_rules! by_kind {
    ($self:ident, $own:ident => $of:expr, $none:expr) => {
        by_kind!(
            $self, $own => $of, $none;
            TRIANGLE triangle, POINT point, SPOT spot, SPHERE sphere, RECTANGLE rectangle, DISC disc
        )
    };
    ($self:ident, $own:ident => $of:expr, $none:expr; $($kind:ident $as:ident),*) => {
        match $self.kind() {
            $(AnyLight::$kind => {
                let $own = $self.$as();
                $of
            })*
            _ => $none,
        }
    };
}

/// [`Light::in_world`]. On devices a function of its own with arguments by value: inlined, rust-gpu took more than 10 GB.
#[cfg_attr(target_arch = "spirv", inline(never))]
#[cfg_attr(not(target_arch = "spirv"), inline(always))]
fn placed(light: AnyLight, instance: Instance, index: u32) -> AnyLight {
    by_kind!(light, own => own.in_world(&instance, index).into(), AnyLight { mesh: index, ..AnyLight::DARK })
}

/// [`Light::point_for`], as [`placed`].
#[cfg_attr(target_arch = "spirv", inline(never))]
#[cfg_attr(not(target_arch = "spirv"), inline(always))]
fn point_on(light: AnyLight, from: Vec3, uv: [f32; 2]) -> LightPoint {
    by_kind!(light, own => own.point_for(from, uv), EmissiveTriangle::DARK.point_for(from, uv))
}

impl Light for AnyLight {
    const NAME: &'static str = "light of any kind";
    const DARK: Self = Self {
        words: [NONE; 3],
        emission: [0.0; 3],
        mesh: INVALID,
        kind: Self::TRIANGLE,
    };
    of_mesh!();
    type Slots<const W: usize> = Each<Self, W>;

    fn checked(self) -> Result<Self, DomainError> {
        let unknown = "one of AnyLight's; make it by `AnyLight::from`";
        let light: Self = by_kind!(self, own => own.checked()?.into(), {
            return Err(DomainError::bits("the kind of a light", self.kind(), unknown));
        });
        // A kind without flags has left them out.
        if light.kind != self.kind {
            let expected = "0 for a light of this kind; clear all bits";
            return Err(DomainError::bits("the word of flags", self.flags(), expected));
        }
        Ok(light)
    }

    #[inline(always)]
    fn centroid(&self) -> [f32; 3] {
        by_kind!(self, own => own.centroid(), self.words[0])
    }

    fn reach(&self) -> f32 {
        by_kind!(self, own => own.reach(), 0.0)
    }

    #[inline(always)]
    fn has_flux(&self) -> bool {
        by_kind!(self, own => own.has_flux(), false)
    }

    #[inline(always)]
    fn is_surface(&self) -> bool {
        by_kind!(self, own => own.is_surface(), false)
    }

    #[inline(always)]
    fn end(&self) -> f32 {
        by_kind!(self, own => own.end(), Limits::ENDLESS)
    }

    #[inline(always)]
    fn beam(&self) -> Beam {
        by_kind!(self, own => own.beam(), Beam::ANYWHERE)
    }

    #[inline(always)]
    fn bounds(&self) -> LightBounds {
        by_kind!(self, own => own.bounds(), LightBounds::EMPTY)
    }

    #[inline(always)]
    fn moments(&self) -> LightMoments {
        by_kind!(self, own => own.moments(), LightMoments::EMPTY)
    }

    #[inline(always)]
    fn in_world(&self, instance: &Instance, index: u32) -> Self {
        placed(*self, *instance, index)
    }

    #[inline(always)]
    fn point_for(&self, from: Vec3, uv: [f32; 2]) -> LightPoint {
        point_on(*self, from, uv)
    }

    fn point_at(&self, from: Vec3, p: Vec3) -> LightPoint {
        by_kind!(self, own => own.point_at(from, p), EmissiveTriangle::DARK.point_at(from, p))
    }
}
