//! Alpha of shapes: which part of the light that meets them they stop.

use std::collections::hash_map::Entry;

use super::super::paint::{Opacity, Paint};
use super::params::Params;
use super::shown;
use super::state::Loader;

impl Loader<'_> {
    /// The material of a shape with its `alpha`, which is another one where light goes through a part of it; `None` where the
    /// shape is not there.
    pub fn material_with_alpha(&mut self, params: &Params) -> Option<u32> {
        let own = self.graphics.material;
        if params.find("shadowalpha").is_some() {
            self.note(
                &params.place,
                "`shadowalpha` is left out: shapes stop light on its way as they do seen",
            );
        }
        let Some(alpha) = params.find("alpha") else {
            return Some(own);
        };
        let [share] = alpha.numbers[..] else {
            let problem = match alpha.kind.as_str() {
                "texture" => String::from("textures of alpha are left out, the surfaces taken as opaque"),
                kind => format!(
                    "`{} alpha` is not one number, and left out; the surfaces are taken as opaque",
                    shown(kind)
                ),
            };
            self.note(&params.place, problem);
            return Some(own);
        };
        let is_inside = share > 0.0 && share < 1.0;
        if share <= 0.0 && self.graphics.area.is_none() {
            self.note(&params.place, "shapes whose alpha is 0 are left out");
            return None;
        }
        if share < 1.0 && self.graphics.area.is_some() {
            self.note(
                &params.place,
                "alpha of shapes that shine is left out; they are taken as opaque",
            );
            return Some(own);
        }
        Some(if is_inside {
            self.blended(own, share as f32)
        } else {
            own
        })
    }

    /// A material that covers the part `share` of what is behind it.
    fn blended(&mut self, material: u32, share: f32) -> u32 {
        let vacant = match self.blended.entry((material, share.to_bits())) {
            Entry::Occupied(known) => return *known.get(),
            Entry::Vacant(vacant) => vacant,
        };
        let mut own = self.data.materials[material as usize].clone();
        // Glass is left out as a whole.
        if own.is_clear() {
            return *vacant.insert(material);
        }
        let [r, g, b] = own.base_color;
        let plain = Paint {
            base: [r, g, b, 1.0],
            metallic: own.metallic,
            roughness: own.roughness,
            ..Paint::PLAIN
        };
        let mut paint = own.paint.unwrap_or(plain);
        paint.base[3] = share;
        paint.opacity = Opacity::Blended;
        own.paint = Some(paint);
        // What stands for it where it is not shown.
        own.transmission = own.transmission.max(1.0 - share);
        let index = self.data.materials.len() as u32;
        self.data.materials.push(own);
        *vacant.insert(index)
    }
}
