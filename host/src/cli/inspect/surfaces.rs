//! What the surfaces of a scene are: what is lit, and what of it is cut out.

use serde::Serialize;

use crate::scene::Scene;

/// Roughness up to which a surface counts as glossy: its lobe then covers less than a tenth of the hemisphere.
const GLOSSY: f32 = 0.5;

/// Materials by what matters to the choice of a light.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Surfaces {
    pub materials: usize,
    pub glossy: usize,
    /// Cut out by alpha, and those of them that emit.
    pub masked: usize,
    pub masked_lights: usize,
}

impl Surfaces {
    pub fn of(scene: &Scene) -> Self {
        let materials = &scene.data().materials;
        let masked = materials.iter().filter(|material| material.masked);
        Self {
            materials: materials.len(),
            glossy: materials
                .iter()
                .filter(|material| material.roughness <= GLOSSY)
                .count(),
            masked: masked.clone().count(),
            masked_lights: masked
                .filter(|material| material.radiance.iter().any(|&channel| channel > 0.0))
                .count(),
        }
    }

    /// In words: of gloss, and of masks.
    pub fn said(&self) -> [String; 2] {
        let Self {
            materials,
            glossy,
            masked,
            masked_lights,
        } = self;
        let cut = match masked {
            0 => format!("no: of {materials} materials none is cut out by alpha"),
            _ => format!(
                "yes: {masked} of {materials} materials, taken as opaque; emitting: {masked_lights}; what is cut out of a light keeps its \
                 probability, which costs variance and no bias where the shader masks it"
            ),
        };
        [
            format!("of {materials} materials {glossy} have a roughness of {GLOSSY} or less"),
            cut,
        ]
    }
}
