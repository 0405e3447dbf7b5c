//! Textures: their mean colours, and pictures that the renderer shows.

use super::super::check::MAX_TEXTURE_COORDINATE;
use super::super::paint::{Texture as Shown, Wrap};
use super::super::picture_file::Encoding;
use super::params::Params;
use super::state::Loader;
use super::{resolve, shown};

/// What is known of a texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Texture {
    /// Linear RGB; all three the same of numbers.
    pub mean: [f64; 3],
    /// Whether it is of numbers, and not of colours.
    pub is_number: bool,
    /// A picture and a factor on it, of which that is the mean.
    pub shown: Option<(Shown, [f64; 3])>,
}

impl Loader<'_> {
    /// `Texture "name" "kind" "class"`.
    pub fn texture(&mut self, name: String, kind: &str, class: &str, params: &Params) {
        let mean = self.mean_of(class, params);
        let shown = match class {
            "imagemap" => self.shown_picture(params),
            "scale" => self.scaled_picture(params),
            _ => None,
        };
        let texture = Texture {
            mean,
            is_number: kind == "float",
            shown,
        };
        self.textures.insert(name, texture);
    }

    /// A picture times a number or a colour, either of them named first.
    fn scaled_picture(&mut self, params: &Params) -> Option<(Shown, [f64; 3])> {
        let pairs = [
            (["tex", "tex1"], ["scale", "tex2"]),
            (["scale", "tex2"], ["tex", "tex1"]),
        ];
        for (of, by) in pairs {
            let named = |params: &Params, names: &[&str]| {
                let word = params.find_any(names)?.words.first()?;
                self.textures.get(word)?.shown
            };
            let Some((picture, factor)) = named(params, &of) else {
                continue;
            };
            if named(params, &by).is_some() {
                self.note(
                    &params.place,
                    "pictures that are multiplied by pictures are replaced by their mean colours",
                );
                return None;
            }
            let scale = by.iter().find_map(|name| self.unclamped(params, name));
            let scale = scale.unwrap_or([1.0; 3]);
            return Some((picture, [0, 1, 2].map(|k| factor[k] * scale[k])));
        }
        None
    }

    /// The picture of an `imagemap`, where the renderer can show it as it is.
    fn shown_picture(&mut self, params: &Params) -> Option<(Shown, [f64; 3])> {
        let is_plain = params.string("mapping").is_none_or(|mapping| mapping == "uv");
        if !is_plain || params.flag("invert") {
            self.note(
                &params.place,
                "textures that are inverted, or lie by another mapping than uv, are replaced by their mean colours",
            );
            return None;
        }
        let path = resolve(self.folder, params.string("filename").unwrap_or_default())?;
        let kept = self.pictures.keep(&path, None);
        for problem in self.pictures.take_unshown() {
            self.note(&params.place, problem);
        }
        let kept = kept?;
        let number = |name: &str, default: f64| params.number(name).unwrap_or(default);
        let [us, vs] = [number("uscale", 1.0), number("vscale", 1.0)];
        let [ud, vd] = [number("udelta", 0.0), number("vdelta", 0.0)];
        let wrap = match params.string("wrap") {
            Some("clamp") => Wrap::Clamp,
            Some("black") => {
                self.note(
                    &params.place,
                    "textures that end in black go on as at their edges",
                );
                Wrap::Clamp
            }
            _ => Wrap::Repeat,
        };
        // The second coordinate grows upward, rows go down.
        let given = [us, 0.0, 0.0, -vs, ud, 1.0 - vd];
        let most = f64::from(MAX_TEXTURE_COORDINATE);
        let bounded = given.map(|x| x.clamp(-most, most) as f32);
        if given.iter().any(|x| x.abs() > most) {
            self.note(
                &params.place,
                "scales and deltas of textures beyond 2^20 count as 2^20",
            );
        }
        let [a, b, c, d, e, f] = bounded;
        let shown = Shown {
            picture: kept.picture,
            is_color: encoding(params) == Encoding::Srgb,
            is_nearest: false,
            wrap: [wrap; 2],
            transform: [[a, b], [c, d], [e, f]],
        };
        Some((shown, [number("scale", 1.0); 3]))
    }

    fn mean_of(&mut self, class: &str, params: &Params) -> [f64; 3] {
        let mixed = |a: [f64; 3], b: [f64; 3], t: f64| [0, 1, 2].map(|i| (1.0 - t) * a[i] + t * b[i]);
        match class {
            "constant" => self.unclamped(params, "value").unwrap_or([1.0; 3]),
            "scale" => {
                let tex = self
                    .unclamped(params, "tex")
                    .or_else(|| self.unclamped(params, "tex1"));
                let scale = self
                    .unclamped(params, "scale")
                    .or_else(|| self.unclamped(params, "tex2"));
                let (tex, scale) = (tex.unwrap_or([1.0; 3]), scale.unwrap_or([1.0; 3]));
                [0, 1, 2].map(|i| tex[i] * scale[i])
            }
            "mix" => {
                let a = self.unclamped(params, "tex1").unwrap_or([0.0; 3]);
                let b = self.unclamped(params, "tex2").unwrap_or([1.0; 3]);
                let amount = self.unclamped(params, "amount").unwrap_or([0.5; 3])[0];
                mixed(a, b, amount)
            }
            "checkerboard" => {
                self.note(
                    &params.place,
                    "textures of checkers are replaced by their mean colours",
                );
                let a = self.unclamped(params, "tex1").unwrap_or([1.0; 3]);
                let b = self.unclamped(params, "tex2").unwrap_or([0.0; 3]);
                mixed(a, b, 0.5)
            }
            "dots" => {
                self.note(
                    &params.place,
                    "textures of dots are replaced by the colour around them",
                );
                self.unclamped(params, "outside").unwrap_or([0.0; 3])
            }
            "directionmix" => {
                self.note(
                    &params.place,
                    "textures `directionmix` are replaced by their mean colours",
                );
                let a = self.unclamped(params, "tex1").unwrap_or([0.0; 3]);
                let b = self.unclamped(params, "tex2").unwrap_or([1.0; 3]);
                mixed(a, b, 0.5)
            }
            "imagemap" => self.picture(params),
            _ => {
                self.note(
                    &params.place,
                    format!("textures of class `{}` are taken as grey", shown(class)),
                );
                [0.5; 3]
            }
        }
    }

    /// A colour that may be above 1, as factors are.
    fn unclamped(&mut self, params: &Params, name: &str) -> Option<[f64; 3]> {
        let param = params.find(name)?;
        if let Some(texture) = param.words.first().and_then(|name| self.textures.get(name)) {
            return Some(texture.mean);
        }
        match (param.kind.as_str(), &param.numbers[..]) {
            ("rgb" | "color", &[r, g, b]) => Some([r, g, b]),
            ("float", &[x]) => Some([x; 3]),
            _ => self.surface_color(params, &[name]),
        }
    }

    fn picture(&mut self, params: &Params) -> [f64; 3] {
        let file = params.string("filename").unwrap_or_default().to_owned();
        let encoding = encoding(params);
        let scale = params.number("scale").unwrap_or(1.0);
        let mean = match resolve(self.folder, &file) {
            Some(path) => self.pictures.mean(&path, encoding),
            None if file.is_empty() => Err(String::from(
                "an `imagemap` has no `filename`; name a picture, or remove the texture",
            )),
            None => Err(String::from("there is no folder to look in")),
        };
        match mean {
            Ok(mean) => {
                let is_inverted = params.flag("invert");
                mean.rgb.map(|x| {
                    let x = x * scale;
                    if is_inverted { (1.0 - x).max(0.0) } else { x }
                })
            }
            Err(problem) => {
                self.note(&params.place, format!("a texture is taken as grey: {problem}"));
                [0.5; 3]
            }
        }
    }
}

fn encoding(params: &Params) -> Encoding {
    match params.string("encoding") {
        Some("linear") => Encoding::Linear,
        _ => Encoding::Srgb,
    }
}
