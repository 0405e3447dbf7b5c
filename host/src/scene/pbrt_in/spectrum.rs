//! Colours of parameters: what light has, and what surfaces reflect.

use super::super::notes::Place;
use super::super::read_file::read_file;
use super::params::{Param, Params};
use super::state::Loader;
use super::texture::Texture;
use super::{cie, resolve, shown};

/// Most samples of a spectrum.
const MAX_SAMPLES: usize = 1 << 16;

/// By how much colours that are rounded may leave what they are.
const ROUNDED: f64 = 1e-3;

/// Named illuminants by CIE chromaticity (CIE 15:2004, tables T.3 and 10.1; SMPTE ST 2065-1 for ACES).
const ILLUMINANTS: [(&str, f64, f64); 17] = [
    ("stdillum-A", 0.447_57, 0.407_45),
    ("stdillum-D50", 0.345_67, 0.358_50),
    ("stdillum-D65", 0.312_72, 0.329_03),
    ("illum-acesD60", 0.321_68, 0.337_67),
    ("illum-norm-D60", 0.321_68, 0.337_67),
    ("stdillum-F1", 0.3131, 0.3371),
    ("stdillum-F2", 0.3721, 0.3751),
    ("stdillum-F3", 0.4091, 0.3941),
    ("stdillum-F4", 0.4402, 0.4031),
    ("stdillum-F5", 0.3138, 0.3452),
    ("stdillum-F6", 0.3779, 0.3882),
    ("stdillum-F7", 0.3129, 0.3292),
    ("stdillum-F8", 0.3458, 0.3586),
    ("stdillum-F9", 0.3741, 0.3727),
    ("stdillum-F10", 0.3458, 0.3588),
    ("stdillum-F11", 0.3805, 0.3769),
    ("stdillum-F12", 0.4370, 0.4042),
];

impl Loader<'_> {
    /// Light of a parameter: RGB as it is, all else with luminance 1, as pbrt has it; white where it is not there.
    pub fn light_color(&mut self, params: &Params, names: &[&str]) -> [f64; 3] {
        let Some(param) = params.find_any(names) else {
            return [1.0; 3];
        };
        let rgb = match (param.kind.as_str(), &param.numbers[..]) {
            ("rgb" | "color", &[r, g, b]) => [r, g, b],
            ("xyz", &[x, y, z]) => cie::rgb_of_xyz([x, y, z]),
            ("blackbody", &[kelvin]) => self.blackbody(kelvin, &params.place),
            // Version 3 has a scale after it.
            ("blackbody", &[kelvin, scale]) => self.blackbody(kelvin, &params.place).map(|x| x * scale),
            ("spectrum", _) => self.light_spectrum(param, &params.place),
            (_, &[x]) => [x; 3],
            _ => {
                let kind = format!(
                    "light by `{} {}` is taken as white",
                    shown(&param.kind),
                    shown(&param.name)
                );
                self.note(&params.place, kind);
                [1.0; 3]
            }
        };
        if rgb.iter().any(|&x| x < -ROUNDED) {
            self.note(
                &params.place,
                format!("negative numbers of light by `{}` count as 0", shown(&param.name)),
            );
        }
        rgb.map(|x| x.max(0.0))
    }

    fn blackbody(&mut self, kelvin: f64, place: &Place) -> [f64; 3] {
        if !cie::BODIES.contains(&kelvin) {
            self.note(
                place,
                "blackbodies outside of 500 to 1000000 K have the colour of the nearer of the two",
            );
        }
        cie::blackbody(kelvin)
    }

    fn light_spectrum(&mut self, param: &Param, place: &Place) -> [f64; 3] {
        let Some(name) = param.words.first() else {
            let samples = self.samples(&param.numbers, "white", place);
            return match &samples[..] {
                [] => [1.0; 3],
                samples => self.light_of(samples, place),
            };
        };
        if name == "stdillum-D65" {
            return [1.0; 3];
        }
        if let Some(&(_, x, y)) = ILLUMINANTS.iter().find(|(known, ..)| known == name) {
            return cie::light_of_chromaticity(x, y);
        }
        match self.spectrum_file(name) {
            Some(samples) => self.light_of(&samples, place),
            None => {
                self.note(
                    place,
                    format!("spectrum `{}` is not known, and taken as white", shown(name)),
                );
                [1.0; 3]
            }
        }
    }

    fn light_of(&mut self, samples: &[(f64, f64)], place: &Place) -> [f64; 3] {
        cie::light(samples).unwrap_or_else(|| {
            self.note(
                place,
                "light by spectra that are nothing where it is visible, 360 to 830 nm, is taken as white",
            );
            [1.0; 3]
        })
    }

    /// Pairs of wavelengths, which ascend, and values; none where the numbers are no such pairs, for which the colour `instead`
    /// is taken.
    fn samples(&mut self, numbers: &[f64], instead: &str, place: &Place) -> Vec<(f64, f64)> {
        if numbers.len() % 2 == 1 {
            self.note(
                place,
                "a spectrum with an odd count of numbers is taken without the last one; write pairs of wavelength and value",
            );
        }
        let pairs = samples(numbers);
        if pairs.is_empty() {
            self.note(
                place,
                format!(
                    "a spectrum that is no list of pairs of wavelength and value, at most {MAX_SAMPLES} with wavelengths that ascend, is taken as {instead}"
                ),
            );
        }
        pairs
    }

    /// Samples of a file of wavelengths and values.
    pub fn spectrum_file(&self, name: &str) -> Option<Vec<(f64, f64)>> {
        let bytes = read_file(&resolve(self.folder, name)?).ok()?;
        let text = String::from_utf8_lossy(&bytes);
        let words = text
            .lines()
            .filter_map(|line| line.split('#').next())
            .flat_map(str::split_ascii_whitespace);
        let numbers: Vec<f64> = words
            .take(2 * MAX_SAMPLES)
            .filter_map(|word| word.parse().ok())
            .filter(|x: &f64| x.is_finite())
            .collect();
        Some(samples(&numbers)).filter(|samples| !samples.is_empty())
    }

    /// What a surface reflects, or lets through: each channel in [0, 1]. `None` where the parameter is not there.
    pub fn surface_color(&mut self, params: &Params, names: &[&str]) -> Option<[f64; 3]> {
        self.surface(params, names, "spectrum")
    }

    /// The same, where textures are to be of a kind, `spectrum` or `float`.
    fn surface(&mut self, params: &Params, names: &[&str], kind: &str) -> Option<[f64; 3]> {
        let param = params.find_any(names)?;
        let rgb = match (param.kind.as_str(), &param.numbers[..]) {
            ("texture", _) => {
                let name = param.words.first()?;
                match self.textures.get(name) {
                    Some(&Texture { mean, is_number, .. }) => {
                        if is_number != (kind == "float") {
                            let found = if is_number { "float" } else { "spectrum" };
                            let problem = format!(
                                "`{}` names a texture of kind `{found}`, which is read as one of kind `{kind}`",
                                shown(&param.name)
                            );
                            self.note(&params.place, problem);
                        }
                        mean
                    }
                    None => {
                        self.note(
                            &params.place,
                            format!("texture `{}` is not defined, and taken as grey", shown(name)),
                        );
                        [0.5; 3]
                    }
                }
            }
            ("rgb" | "color", &[r, g, b]) => [r, g, b],
            ("xyz", &[x, y, z]) => cie::rgb_of_xyz([x, y, z]),
            ("spectrum", numbers) if param.words.is_empty() => {
                match &self.samples(numbers, "grey", &params.place)[..] {
                    [] => [0.5; 3],
                    samples => cie::reflectance(samples),
                }
            }
            (_, &[x]) => [x; 3],
            _ => {
                let file = param.words.first().and_then(|name| self.spectrum_file(name));
                match file {
                    Some(samples) => cie::reflectance(&samples),
                    None => {
                        let kind = format!(
                            "a surface's `{} {}` is taken as grey",
                            shown(&param.kind),
                            shown(&param.name)
                        );
                        self.note(&params.place, kind);
                        [0.5; 3]
                    }
                }
            }
        };
        if rgb.iter().any(|&x| !(-ROUNDED..=1.0 + ROUNDED).contains(&x)) {
            self.note(
                &params.place,
                format!(
                    "`{}` of a surface outside of 0 to 1 is taken as the nearer of the two",
                    shown(&param.name)
                ),
            );
        }
        Some(rgb.map(|x| x.clamp(0.0, 1.0)))
    }

    /// A number by itself or by a texture.
    pub fn surface_number(&mut self, params: &Params, names: &[&str]) -> Option<f64> {
        let rgb = self.surface(params, names, "float")?;
        // What a texture says of a number is its red.
        Some(rgb[0])
    }
}

/// Pairs of wavelengths, which ascend, and values.
fn samples(numbers: &[f64]) -> Vec<(f64, f64)> {
    let (pairs, _) = numbers.as_chunks::<2>();
    let out: Vec<(f64, f64)> = pairs.iter().map(|&[at, value]| (at, value)).collect();
    let ascends = out.windows(2).all(|pair| pair[0].0 < pair[1].0);
    if ascends && out.len() <= MAX_SAMPLES {
        out
    } else {
        Vec::new()
    }
}
