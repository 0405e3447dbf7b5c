//! Area lights: what shapes emit.

use super::super::picture_file::Encoding;
use super::params::Params;
use super::state::Loader;
use super::{resolve, shown};

/// What a shape emits.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct AreaLight {
    /// W/(m² sr) where there is no power, else a factor on it.
    pub radiance: [f64; 3],
    /// Of each triangle, sphere, disc or cylinder, W, where it is given.
    pub power: Option<f64>,
    pub is_two_sided: bool,
}

impl AreaLight {
    /// Radiance of a surface of `area` m².
    pub fn radiance_of(&self, area: f64) -> [f32; 3] {
        let factor = match self.power {
            None => 1.0,
            Some(_) if area <= 0.0 => 0.0,
            Some(power) => {
                let sides = if self.is_two_sided { 2.0 } else { 1.0 };
                power / (sides * std::f64::consts::PI * area)
            }
        };
        self.radiance.map(|x| (x * factor) as f32)
    }
}

impl Loader<'_> {
    /// `AreaLightSource "kind"`.
    pub fn area_light(&mut self, kind: &str, params: &Params) -> Option<AreaLight> {
        if !matches!(kind, "diffuse" | "area") {
            self.note(
                &params.place,
                format!("area lights of kind `{}` are left out", shown(kind)),
            );
            return None;
        }
        let mut radiance = self.light_color(params, &["L"]);
        if let Some(file) = params.string("filename") {
            let path = resolve(self.folder, file);
            let mean = path.map_or(Err(String::from("there is no folder to look in")), |path| {
                self.pictures.mean(&path, Encoding::Srgb)
            });
            match mean {
                Ok(mean) => {
                    self.note(
                        &params.place,
                        "pictures of area lights are replaced by their mean colours",
                    );
                    let luminance = 0.2126 * mean.rgb[0] + 0.7152 * mean.rgb[1] + 0.0722 * mean.rgb[2];
                    // A power is that of the picture.
                    let by = if params.number("power").is_some_and(|power| power > 0.0) && luminance > 0.0 {
                        1.0 / luminance
                    } else {
                        1.0
                    };
                    radiance = mean.rgb.map(|x| x * by);
                }
                Err(problem) => {
                    self.note(
                        &params.place,
                        format!("the picture of an area light counts as black: {problem}"),
                    );
                    radiance = [0.0; 3];
                }
            }
        }
        let scale = self.scale(params);
        Some(AreaLight {
            radiance: [0, 1, 2].map(|i| radiance[i] * scale[i]),
            power: self.positive(params, "power"),
            is_two_sided: params.flag("twosided"),
        })
    }

    /// `scale`, which in version 3 is a colour.
    pub fn scale(&mut self, params: &Params) -> [f64; 3] {
        let scale = match *params.numbers("scale") {
            [x] => [x; 3],
            [r, g, b] => [r, g, b],
            _ => [1.0; 3],
        };
        if scale.iter().any(|&x| x < 0.0) {
            self.note(&params.place, "a negative `scale` of a light counts as 0");
        }
        scale.map(|x| x.max(0.0))
    }
}
