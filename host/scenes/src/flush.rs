//! Numbers that are too small to matter become zero.

use lightbvh::light::{MIN_COORDINATE, MIN_RADIANCE};

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
            let [a, b, c, d] = [paint.metallic, paint.roughness, paint.bump, paint.transmission]
                .map(|factor| flush(factor, SMALLEST_FACTOR));
            (paint.metallic, paint.roughness) = (a, b);
            (paint.bump, paint.transmission) = (c, d);
            let (base, rough) = (&mut paint.base_texture, &mut paint.rough_texture);
            let textures = [base, rough, &mut paint.bump_texture, &mut paint.glow_texture];
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
    let (lights, warnings) = (&mut data.analytic, &mut data.warnings);
    let mut index = 0;
    lights.retain_mut(|light| {
        let emission = light.wide_emission();
        // What is negative or no number stays, to be reported; what is off too: it may be switched on.
        let is_dim = |&sent: &f64| (0.0..f64::from(MIN_RADIANCE)).contains(&sent);
        let is_left_out = light.intensity > 0.0 && emits(light.color) && emission.iter().all(is_dim);
        if is_left_out {
            let (name, sent) = (&light.name, emission.into_iter().fold(0.0, f64::max));
            warnings.push(format!(
                "light {index} `{name}` is left out: it sends {sent:.1e}, and 2^-100 is the least that counts; give it more intensity, or remove it"
            ));
        }
        for (color, sent) in light.color.iter_mut().zip(&emission) {
            *color = if is_dim(sent) { 0.0 } else { *color };
        }
        index += 1;
        !is_left_out
    });
}

#[cfg(test)]
mod tests {
    use super::super::analytic::{AnalyticKind, AnalyticLight};
    use super::super::builder::{STILL, SceneBuilder};
    use super::super::model::Scene;

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

    #[test]
    fn dim_lights_are_left_out_by_name() {
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
        let scene = room(&lights, 1e-35);
        let left = scene.data().analytic.iter().map(|light| light.name.as_str());
        assert_eq!(left.collect::<Vec<_>>(), ["bulb", "off", "red"]);
        assert_eq!(scene.data().analytic[2].color, [1.0, 0.0, 0.0]);
        assert_eq!(scene.emissive_count(), 0);
        let warnings = scene.warnings();
        assert_eq!(warnings.len(), 4, "{warnings:?}");
        assert!(warnings[0].contains("light 1 `ghost`") && warnings[3].contains("material 0 `ember`"));
        assert!(lightbvh::Lights::new(scene.frame(0).lights::<lightbvh::light::AnyLight>()).is_ok());
        // Once: what is left out is not there when the scene is checked again.
        let again = Scene::new(scene.into_data()).expect("a scene");
        assert_eq!(again.warnings().len(), 4);
        assert_eq!(room(&[], 1e-20).warnings(), [""; 0]);
    }
}
