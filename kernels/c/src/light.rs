//! Lights as C has them: one structure for all kinds.

use std::f32::consts::PI;

use lightbvh::EmissiveTriangle;
use lightbvh::light::{AnyLight, DiscLight, Light, PointLight, RectangleLight, SphereLight, SpotLight};

use crate::error::{Fault, Status};

/// `lightbvh_light`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CLight {
    pub kind: u32,
    pub flags: u32,
    pub p: [f32; 3],
    pub a: [f32; 3],
    pub b: [f32; 3],
    pub emission: [f32; 3],
    pub radius: f32,
    pub range: f32,
    pub inner: f32,
    pub outer: f32,
}

/// Lights that can be made of those of C.
pub(crate) trait FromC: Light {
    fn from_c(light: &CLight) -> Result<Self, Fault>;
}

impl FromC for AnyLight {
    #[rustfmt::skip]
    fn from_c(light: &CLight) -> Result<Self, Fault> {
        let CLight { kind, flags, p, a, b, emission, radius, range, .. } = *light;
        let (radiance, intensity, half, mesh) = (emission, emission, [a, b], 0);
        let own: Self = match kind {
            Self::TRIANGLE => EmissiveTriangle { p: [p, a, b], radiance, mesh, flags }.into(),
            Self::POINT => PointLight { p, intensity, range, mesh }.into(),
            Self::SPOT => spot(light)?.into(),
            Self::SPHERE => SphereLight { p, radius, radiance, mesh }.into(),
            Self::RECTANGLE => RectangleLight { p, half, radiance, mesh, flags }.into(),
            Self::DISC => DiscLight { p, half, radiance, mesh, flags }.into(),
            _ => {
                let message = format!("kind {kind} of a light, expected one of lightbvh_kind");
                return Err(Fault::new(Status::BadTag, message));
            }
        };
        let has_sides = [Self::TRIANGLE, Self::RECTANGLE, Self::DISC].contains(&kind);
        if flags > u32::from(has_sides) {
            let or = if has_sides { " or LIGHTBVH_TWO_SIDED" } else { "" };
            let message = format!("the word of flags is {flags:#x}, expected 0{or}");
            return Err(Fault::new(Status::BadLight, message));
        }
        Ok(own)
    }
}

impl FromC for EmissiveTriangle {
    fn from_c(light: &CLight) -> Result<Self, Fault> {
        let any = AnyLight::from_c(light)?;
        Self::try_from(any).map_err(|any| {
            let found = format!("kind {} in a light BVH of triangles alone", any.kind());
            let message = format!("{found}; create one with LIGHTBVH_ANY_LIGHTS");
            Fault::new(Status::WrongModel, message)
        })
    }
}

#[rustfmt::skip]
fn spot(light: &CLight) -> Result<SpotLight, Fault> {
    let CLight { p, a: axis, emission: intensity, range, inner, outer, .. } = *light;
    // NaN is in no range.
    if !((0.0..=PI).contains(&outer) && (0.0..=outer).contains(&inner)) {
        let found = format!("half angles of a spot are {inner} and {outer}");
        let message = format!("{found}, expected 0 <= inner <= outer <= pi radians");
        return Err(Fault::new(Status::BadLight, message));
    }
    Ok(SpotLight { p, intensity, axis, range, ..SpotLight::DARK }.with_cone(inner, outer))
}

/// Those of a mesh.
pub(crate) fn all_from_c<L: FromC>(lights: &[CLight]) -> Result<Vec<L>, Fault> {
    let mut own = Vec::with_capacity(lights.len());
    for (index, light) in lights.iter().enumerate() {
        own.push(L::from_c(light).map_err(|fault| fault.at("light", index))?);
    }
    Ok(own)
}
