//! Numbers that are too small to matter become zero, and texture coordinates are bounded.

use lightbvh::light::{MIN_COORDINATE, MIN_RADIANCE};

use super::model::SceneData;

/// +0 below `smallest` in magnitude and for -0: devices may flush subnormal numbers where the CPU does not.
pub(super) fn flush(x: f32, smallest: f32) -> f32 {
    if x.abs() < smallest { 0.0 } else { x }
}

/// A place, rounded once from `f64`.
pub(super) fn rounded(p: [f64; 3]) -> [f32; 3] {
    p.map(|x| flush(x as f32, MIN_COORDINATE))
}

/// Factors and texture coordinates below this are none: 2^-40.
const SMALLEST_FACTOR: f32 = 1.0 / (1_u64 << 40) as f32;

/// Greatest magnitude of a texture coordinate, and of a number of a texture's transform: 2^20.
const MAX_TEXTURE_COORDINATE: f32 = 1_048_576.0;

/// +0 for what is too small to matter: devices may flush subnormal numbers where the CPU does not. Numbers that place textures
/// are bounded, which is noted.
pub(super) fn flush_tiny(data: &mut SceneData) {
    // NaN and infinity stay, to be reported.
    let flush_all =
        |values: &mut [f32], smallest: f32| values.iter_mut().for_each(|x| *x = flush(*x, smallest));
    let mut is_far = false;
    let mut place_all = |values: &mut [f32]| {
        for x in values {
            let far = MAX_TEXTURE_COORDINATE;
            is_far |= x.is_nan() || x.abs() > far;
            *x = if x.is_nan() {
                0.0
            } else {
                flush(x.clamp(-far, far), SMALLEST_FACTOR)
            };
        }
    };
    flush_all(&mut data.background, MIN_RADIANCE);
    for light in &mut data.analytic {
        let emission = light.emission();
        for (color, sent) in light.color.iter_mut().zip(emission) {
            *color = if (0.0..MIN_RADIANCE).contains(&sent) {
                0.0
            } else {
                *color
            };
        }
    }
    for material in &mut data.materials {
        flush_all(&mut material.radiance, MIN_RADIANCE);
        flush_all(&mut material.base_color, MIN_RADIANCE);
        if let Some(textures) = &mut material.textures {
            flush_all(&mut textures.radiance, MIN_RADIANCE);
            flush_all(&mut textures.base, SMALLEST_FACTOR);
            let textures = [&mut textures.base_texture, &mut textures.glow_texture];
            for texture in textures.into_iter().flatten() {
                place_all(texture.transform.as_flattened_mut());
            }
        }
    }
    for primitive in data.meshes.iter_mut().flat_map(|mesh| &mut mesh.primitives) {
        flush_all(primitive.positions.as_flattened_mut(), MIN_COORDINATE);
        if let Some(coordinates) = &mut primitive.coordinates {
            place_all(coordinates.as_flattened_mut());
        }
        if let Some(radiance) = &mut primitive.radiance {
            flush_all(radiance.as_flattened_mut(), MIN_RADIANCE);
        }
    }
    if is_far {
        data.warnings.push(String::from(
            "texture coordinates and their transforms beyond 2^20 count as 2^20, and NaN as 0; repair them",
        ));
    }
}
