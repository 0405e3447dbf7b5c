//! Numbers that are too small to matter become zero.

use lightbvh::light::{MIN_COORDINATE, MIN_RADIANCE};

use super::model::SceneData;

/// +0 below `smallest` in magnitude and for -0: devices may flush subnormal numbers where the CPU does not.
pub(super) fn flush(x: f32, smallest: f32) -> f32 {
    if x.abs() < smallest { 0.0 } else { x }
}

/// Factors and texture coordinates below this are none: 2^-40.
const SMALLEST_FACTOR: f32 = 1.0 / (1_u64 << 40) as f32;

/// +0 for what is too small to matter: devices may flush subnormal numbers where the CPU does not.
pub(super) fn flush_tiny(data: &mut SceneData) {
    // NaN and infinity stay, to be reported.
    let flush_all =
        |values: &mut [f32], smallest: f32| values.iter_mut().for_each(|x| *x = flush(*x, smallest));
    flush_all(&mut data.background, MIN_RADIANCE);
    for material in &mut data.materials {
        flush_all(&mut material.radiance, MIN_RADIANCE);
        flush_all(&mut material.base_color, MIN_RADIANCE);
        if let Some(paint) = &mut material.paint {
            flush_all(&mut paint.radiance, MIN_RADIANCE);
            flush_all(&mut paint.base, SMALLEST_FACTOR);
            for factor in [
                &mut paint.metallic,
                &mut paint.roughness,
                &mut paint.bump,
                &mut paint.transmission,
            ] {
                *factor = flush(*factor, SMALLEST_FACTOR);
            }
            let textures = [
                &mut paint.base_texture,
                &mut paint.rough_texture,
                &mut paint.bump_texture,
                &mut paint.glow_texture,
            ];
            for texture in textures.into_iter().flatten() {
                flush_all(texture.transform.as_flattened_mut(), SMALLEST_FACTOR);
            }
        }
    }
    for primitive in data.meshes.iter_mut().flat_map(|mesh| &mut mesh.primitives) {
        flush_all(primitive.positions.as_flattened_mut(), MIN_COORDINATE);
        if let Some(coordinates) = &mut primitive.coordinates {
            flush_all(coordinates.as_flattened_mut(), SMALLEST_FACTOR);
        }
        for target in &mut primitive.targets {
            flush_all(target.as_flattened_mut(), MIN_COORDINATE);
        }
        if let Some(radiance) = &mut primitive.radiance {
            flush_all(radiance.as_flattened_mut(), MIN_RADIANCE);
        }
    }
}
