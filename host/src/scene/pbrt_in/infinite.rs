//! Infinite lights: constant, or by a picture.

use std::path::Path;
use std::sync::Arc;

use image::Rgb32FImage;
use lightbvh::light::infinite::Environment;

use super::super::notes::Place;
use super::super::picture_file::{from_srgb, is_linear};
use super::super::shrunk::{clean, shrunk};
use super::super::texels::{Texels, size_for};
use super::super::transform::{Affine, unit_or};
use super::params::Params;
use super::state::Loader;
use super::{equal_area, matrix, resolve};

/// Most pictures of infinite lights, each as large as all pictures of a scene may be.
const MAX_PICTURES: usize = 4;

/// Texels each way of a map of lights without pictures.
const CONSTANT: u32 = 32;

/// An infinite light.
pub(super) struct Infinite {
    /// Factor on the picture, or radiance, W/(m² sr).
    color: [f64; 3],
    picture: Option<Picture>,
}

struct Picture {
    pixels: Rgb32FImage,
    is_equal_area: bool,
    /// From directions of the world to those of the picture, and back.
    to_picture: Affine,
    to_world: Affine,
}

impl Picture {
    fn at(&self, world: [f64; 3]) -> [f64; 3] {
        let direction = unit_or(self.to_picture.vector(world), [0.0, 0.0, 1.0]);
        let (width, height) = self.pixels.dimensions();
        let [u, v] = if self.is_equal_area {
            equal_area::square_of(direction)
        } else {
            longitude_latitude(direction)
        };
        let pixel = |part: f64, count: u32| ((part * f64::from(count)) as u32).min(count - 1);
        let pixel = self.pixels.get_pixel(pixel(u, width), pixel(v, height));
        pixel.0.map(f64::from)
    }

    /// Its light by texel, about as many as it has pixels; `to_scene` leads from directions of the world to those of the scene.
    fn texels(&self, to_scene: &Affine) -> Texels {
        let (width, height) = self.pixels.dimensions();
        let mut texels = Texels::new(size_for([width, height]));
        let pixel = |x, y| self.pixels.get_pixel(x, y).0.map(f64::from);
        // Both at once, for there are many places.
        let mut map = Affine::IDENTITY;
        for axis in 0..3 {
            map.columns[axis] = to_scene.vector(self.to_world.vector(map.columns[axis]));
        }
        // The length of a direction counts for nothing, but words have a range.
        let longest = map.columns[..3]
            .as_flattened()
            .iter()
            .fold(0.0, |most: f64, x| most.max(x.abs()));
        for axis in 0..3 {
            map.columns[axis] = map.columns[axis].map(|x| x / longest);
        }
        if self.is_equal_area {
            let direction = |place| map.vector(equal_area::direction_of(place));
            texels.add_equal_area(width, pixel, direction);
        } else {
            texels.add_longitude_latitude([width, height], pixel, |own| map.vector(own));
        }
        texels
    }

    /// Irradiance of a patch that faces the picture's +z, W/m² where its numbers are W/(m² sr): the sum over the half of the
    /// sphere there.
    fn upward(&self) -> f64 {
        let (width, height) = self.pixels.dimensions();
        let mut sum = 0.0;
        let mut all = 0.0;
        for (x, y, pixel) in self.pixels.enumerate_pixels() {
            let square = [
                (f64::from(x) + 0.5) / f64::from(width),
                (f64::from(y) + 0.5) / f64::from(height),
            ];
            let (z, angle) = if self.is_equal_area {
                (equal_area::direction_of(square)[2], 1.0)
            } else {
                let theta = std::f64::consts::PI * square[1];
                (libm::cos(theta), libm::sin(theta))
            };
            let [r, g, b] = pixel.0.map(f64::from);
            sum += z.max(0.0) * angle * (0.2126 * r + 0.7152 * g + 0.0722 * b);
            all += angle;
        }
        4.0 * std::f64::consts::PI * sum / all
    }
}

/// Where versions before the fourth have a direction: z up, columns counter-clockwise from +x.
fn longitude_latitude([x, y, z]: [f64; 3]) -> [f64; 2] {
    let turns = libm::atan2(y, x) / std::f64::consts::TAU;
    let turns = if turns < 0.0 { turns + 1.0 } else { turns };
    [turns, libm::acos(z.clamp(-1.0, 1.0)) / std::f64::consts::PI]
}

impl Loader<'_> {
    pub fn infinite_light(&mut self, params: &Params) {
        let scale = self.scale(params);
        let lux = self.positive(params, "illuminance");
        let color = self.light_color(params, &["L"]);
        if params.find("portal").is_some() {
            self.note(&params.place, "portals of infinite lights are left out");
        }
        let file = params.string("filename").or_else(|| params.string("mapname"));
        let Some(file) = file else {
            let by = lux.map_or(1.0, |lux| lux / std::f64::consts::PI);
            self.infinite.push(Infinite {
                color: [0, 1, 2].map(|i| color[i] * scale[i] * by),
                picture: None,
            });
            return;
        };
        let found = match resolve(self.folder, file) {
            None => Err(String::from("there is no folder to look in")),
            Some(_) if self.pictures_of_sky() >= MAX_PICTURES => {
                Err(format!("a scene may have {MAX_PICTURES}"))
            }
            Some(path) => self.sky_picture(&path, &params.place),
        };
        match found {
            Ok(picture) => {
                if !picture.is_equal_area {
                    self.note(
                        &params.place,
                        "pictures of infinite lights that are no squares are taken as by longitude and latitude",
                    );
                }
                let by = match (lux, picture.upward()) {
                    (Some(lux), there) if there > 0.0 => lux / there,
                    _ => 1.0,
                };
                self.infinite.push(Infinite {
                    color: [0, 1, 2].map(|i| color[i] * scale[i] * by),
                    picture: Some(picture),
                });
            }
            Err(problem) => self.note(
                &params.place,
                format!("an infinite light by a picture is left out: {problem}"),
            ),
        }
    }

    fn pictures_of_sky(&self) -> usize {
        self.infinite
            .iter()
            .filter(|light| light.picture.is_some())
            .count()
    }

    fn sky_picture(&mut self, path: &Path, place: &Place) -> Result<Picture, String> {
        let map = self.graphics.ctm;
        let to_picture = matrix::inverse(&map).ok_or_else(|| String::from("its transform flattens space"))?;
        let picture = self.pictures.decode(path)?;
        let is_light = is_linear(&picture);
        let mut pixels = picture.into_rgb32f();
        if !is_light {
            for pixel in pixels.pixels_mut() {
                pixel.0 = pixel.0.map(|x| from_srgb(f64::from(x)) as f32);
            }
        }
        let is_equal_area = pixels.width() == pixels.height();
        if let Some(said) = clean(&mut pixels) {
            self.note(place, format!("a picture of an infinite light: {said}"));
        }
        Ok(Picture {
            is_equal_area,
            pixels: shrunk(pixels, is_equal_area),
            to_picture,
            to_world: map,
        })
    }

    /// The sum of all of them; `to_world` leads from directions of the scene to those of the file's world.
    pub fn environment(&self, to_world: &Affine) -> Option<Arc<Environment>> {
        if self.infinite.is_empty() {
            return None;
        }
        let pictures = self.infinite.iter().filter_map(|light| light.picture.as_ref());
        let sizes = pictures.map(|picture| size_for(picture.pixels.dimensions().into()));
        let size = sizes.max().unwrap_or(1).max(CONSTANT);
        // From the world to the scene.
        let back = matrix::inverse(to_world)?;
        let mut constant = [0.0; 3];
        let mut skies = Vec::new();
        for light in &self.infinite {
            match &light.picture {
                Some(picture) => skies.push((light.color, picture, picture.texels(&back))),
                None => constant = [0, 1, 2].map(|i| constant[i] + light.color[i]),
            }
        }
        let radiance = |direction: [f32; 3]| {
            let direction = direction.map(f64::from);
            let mut sum = constant;
            for (color, picture, texels) in &skies {
                let own = texels.radiance(direction, || picture.at(to_world.vector(direction)));
                sum = [0, 1, 2].map(|i| sum[i] + color[i] * own[i]);
            }
            // The greatest radiance that there may be.
            sum.map(|x| x.min(f64::from(lightbvh::light::MAX_RADIANCE)) as f32)
        };
        Environment::from_fn(size, radiance).ok().map(Arc::new)
    }
}
