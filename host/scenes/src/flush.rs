//! Numbers that are too small to matter become zero.

use lightbvh::light::{MIN_COORDINATE, MIN_RADIANCE};

use super::analytic::AnalyticLight;
use super::frame::emits;
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
    leave_out_dim_lights(data);
    for (index, material) in data.materials.iter_mut().enumerate() {
        let emitted = emits(material.radiance);
        flush_all(&mut material.radiance, MIN_RADIANCE);
        if emitted && material.radiance == [0.0; 3] {
            data.warnings.push(format!(
                "material {index} `{}` emits less than 2^-100 W/(m² sr), and counts as dark; give it more emission, or none",
                material.name
            ));
        }
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

/// Lights by formula that send less than a tree takes are left out, each by name; of others a channel that small becomes 0.
fn leave_out_dim_lights(data: &mut SceneData) {
    let SceneData {
        analytic, warnings, ..
    } = data;
    let mut index = 0;
    analytic.retain_mut(|light| {
        let number = index;
        index += 1;
        let is_kept = !is_dim(light);
        if is_kept {
            darken_dim_channels(light);
        } else {
            warnings.push(format!(
                "light {number} `{}` is left out: it sends {:.1e}, and 2^-100 is the least that counts; give it more \
                 intensity, or remove it",
                light.name,
                greatest(light),
            ));
        }
        is_kept
    });
}

/// What it sends in its strongest channel, in `f64`, where nothing is lost.
fn greatest(light: &AnalyticLight) -> f64 {
    let emission = light.wide_emission();
    emission.into_iter().fold(0.0, f64::max)
}

/// Whether it shines, and all of that is too little. What is negative or no number stays, to be reported.
fn is_dim(light: &AnalyticLight) -> bool {
    let emission = light.wide_emission();
    let is_sound = emission.iter().all(|&channel| channel >= 0.0);
    let shines = light.intensity > 0.0 && emits(light.color);
    is_sound && shines && emission.iter().all(|&channel| channel < f64::from(MIN_RADIANCE))
}

fn darken_dim_channels(light: &mut AnalyticLight) {
    let emission = light.wide_emission();
    for (color, sent) in light.color.iter_mut().zip(emission) {
        if (0.0..f64::from(MIN_RADIANCE)).contains(&sent) {
            *color = 0.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::analytic::AnalyticKind;
    use super::super::builder::{STILL, SceneBuilder};
    use super::super::model::Scene;
    use super::*;

    fn lamp(name: &str, color: [f32; 3], intensity: f32) -> AnalyticLight {
        AnalyticLight {
            name: name.to_owned(),
            node: 0,
            kind: AnalyticKind::Point,
            color,
            intensity,
            range: None,
        }
    }

    fn room(lights: &[AnalyticLight], glow: f32) -> Scene {
        let mut b = SceneBuilder::new("room", [0.0; 3]);
        let mut floor = super::super::shapes::Shape::new();
        floor.cuboid([-1.0, -0.1, -1.0], [1.0, 0.0, 1.0]);
        let glow = b.glow("ember", [glow; 3]);
        let mesh = b.mesh("floor", &[(&floor, glow)]);
        b.node("floor", None, [0.0; 3], STILL, Some(mesh));
        for light in lights {
            b.analytic(light.clone());
        }
        b.finish().expect("a scene")
    }

    /// A light of 1e-35 W/sr was no light that a tree takes, and the whole scene was refused.
    #[test]
    fn a_light_that_is_too_dim_is_left_out_by_name() {
        let lights = [
            lamp("bulb", [1.0; 3], 5.0),
            lamp("ghost", [1.0; 3], 1e-35),
            // Subnormal, and a product that is 0 in `f32`.
            lamp("spirit", [1.0, 0.0, 0.0], 1e-38),
            lamp("shade", [1e-30; 3], 1e-30),
            // Off: it may be switched on.
            lamp("off", [1.0; 3], 0.0),
            lamp("red", [1.0, 1e-31, 0.0], 1.0),
        ];
        let scene = room(&lights, 0.0);
        let left: Vec<&str> = scene
            .data()
            .analytic
            .iter()
            .map(|light| light.name.as_str())
            .collect();
        assert_eq!(left, ["bulb", "off", "red"]);
        assert_eq!(scene.data().analytic[2].color, [1.0, 0.0, 0.0]);
        let warnings = scene.warnings();
        assert_eq!(warnings.len(), 3, "{warnings:?}");
        assert!(
            warnings[0].contains("light 1 `ghost`") && warnings[0].contains("give it more intensity"),
            "{warnings:?}"
        );
        assert!(lightbvh::Lights::new(scene.frame(0).lights::<lightbvh::light::AnyLight>()).is_ok());
        // Once: what is left out is not there when the scene is checked again.
        let again = Scene::new(scene.into_data()).expect("a scene");
        assert_eq!(again.warnings().len(), 3);
    }

    #[test]
    fn a_material_that_is_too_dim_is_named() {
        assert_eq!(room(&[], 1e-20).warnings(), [""; 0]);
        let scene = room(&[], 1e-35);
        assert_eq!(scene.emissive_count(), 0);
        assert!(
            scene.warnings()[0].contains("material 0 `ember`"),
            "{:?}",
            scene.warnings()
        );
    }
}
