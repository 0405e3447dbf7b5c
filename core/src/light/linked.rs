//! Lights that light some receivers alone.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use super::record::{Each, Light};
use super::{AnyLight, EmissiveTriangle, LightPoint};
use crate::beam::Beam;
use crate::bounds::{LightBounds, LightMoments};
use crate::domain::DomainError;
use crate::instance::Instance;

/// A record of its own for each kind of light: what is generic over the light cannot be plain words without unsafe code.
macro_rules! linked {
    ($(#[$doc:meta])* $linked:ident, $own:ty, $name:literal) => {
        $(#[$doc])*
        #[repr(C)]
        #[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
        pub struct $linked {
            /// The light.
            pub light: $own,
            /// Its bits: it lights the receivers whose mask has one of them. `u32::MAX` for all that have any, 0 for none. Any value will do.
            pub mask: u32,
        }

        impl From<$own> for $linked {
            /// One that lights every receiver with any bit.
            #[inline(always)]
            fn from(light: $own) -> Self {
                Self { light, mask: u32::MAX }
            }
        }

        impl Light for $linked {
            const NAME: &'static str = $name;
            const DARK: Self = Self { light: <$own>::DARK, mask: 0 };
            const MESH_WORD: usize = core::mem::offset_of!(Self, light) / 4 + <$own>::MESH_WORD;
            const FLUX_POWER: u32 = <$own>::FLUX_POWER;
            const HAS_FLUX_POWERS: bool = <$own>::HAS_FLUX_POWERS;
            type Slots<const W: usize> = Each<Self, W>;

            fn checked(self) -> Result<Self, DomainError> {
                let light = self.light.checked()?;
                Ok(Self { light, ..self })
            }

            #[inline(always)]
            fn mesh(&self) -> u32 {
                self.light.mesh()
            }

            #[inline(always)]
            fn of_mesh(self, mesh: u32) -> Self {
                Self { light: self.light.of_mesh(mesh), ..self }
            }

            #[inline(always)]
            fn centroid(&self) -> [f32; 3] {
                self.light.centroid()
            }

            fn reach(&self) -> f32 {
                self.light.reach()
            }

            #[inline(always)]
            fn has_flux(&self) -> bool {
                self.light.has_flux()
            }

            #[inline(always)]
            fn flux_power(&self) -> u32 {
                self.light.flux_power()
            }

            #[inline(always)]
            fn mask(&self) -> u32 {
                self.mask
            }

            #[inline(always)]
            fn end(&self) -> f32 {
                self.light.end()
            }

            #[inline(always)]
            fn beam(&self) -> Beam {
                self.light.beam()
            }

            #[inline(always)]
            fn bounds(&self) -> LightBounds {
                self.light.bounds()
            }

            #[inline(always)]
            fn moments(&self) -> LightMoments {
                self.light.moments()
            }

            #[inline(always)]
            fn in_world(&self, instance: &Instance, index: u32) -> Self {
                Self { light: self.light.in_world(instance, index), ..*self }
            }

            #[inline(always)]
            fn point_for(&self, from: Vec3, uv: [f32; 2]) -> LightPoint {
                self.light.point_for(from, uv)
            }

            #[inline(always)]
            fn point_at(&self, from: Vec3, p: Vec3) -> LightPoint {
                self.light.point_at(from, p)
            }
        }
    };
}

linked!(
    /// An [`EmissiveTriangle`] with a mask: 60 bytes. See [`Linked`](crate::importance::Linked).
    LinkedTriangle,
    EmissiveTriangle,
    "linked emissive triangle"
);
linked!(
    /// A light of any kind with a mask: 72 bytes. See [`Linked`](crate::importance::Linked).
    LinkedAny,
    AnyLight,
    "linked light of any kind"
);

const _: () = assert!(size_of::<LinkedTriangle>() == 60);
const _: () = assert!(size_of::<LinkedAny>() == 72);
