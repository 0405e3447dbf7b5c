//! Directives, one after the other.

use std::rc::Rc;

use super::super::error::SceneError;
use super::super::transform::Affine;
use super::params::Params;
use super::state::{Loader, Placed, Scope};
use super::token::{Lexer, Token};
use super::{REPAIR, known, matrix, shown, wrong};

/// Most parameters by `Attribute` that hold at once.
const MAX_ATTRIBUTES: usize = 256;

impl Loader<'_> {
    /// All of a file.
    pub fn file(&mut self, lexer: &mut Lexer<'_>, depth: u32) -> Result<(), SceneError> {
        while let Some(token) = lexer.next()? {
            match token {
                Token::Word(word) => self.directive(&word, lexer, depth)?,
                Token::Quoted(text) => {
                    let problem = format!("expected a directive, found \"{}\"", shown(&text));
                    return Err(wrong(&lexer.place(), problem, REPAIR));
                }
                Token::Open | Token::Close => {
                    return Err(wrong(
                        &lexer.place(),
                        "expected a directive, found a bracket",
                        REPAIR,
                    ));
                }
            }
        }
        Ok(())
    }

    fn directive(&mut self, word: &str, lexer: &mut Lexer<'_>, depth: u32) -> Result<(), SceneError> {
        match word {
            "Identity" => self.set(Affine::IDENTITY),
            "Translate" => self.concat(matrix::translation(lexer.numbers()?)),
            "Scale" => self.concat(matrix::scaling(lexer.numbers()?)),
            "Rotate" => {
                let [degrees, x, y, z] = lexer.numbers()?;
                self.concat(matrix::rotation(degrees, [x, y, z]));
            }
            "LookAt" => {
                let [ex, ey, ez, tx, ty, tz, ux, uy, uz] = lexer.numbers()?;
                match matrix::look_at([ex, ey, ez], [tx, ty, tz], [ux, uy, uz]) {
                    Some(map) => self.concat(map),
                    None => self.note(
                        &lexer.place(),
                        "LookAt that looks nowhere, or along its up direction, is left out",
                    ),
                }
            }
            "Transform" | "ConcatTransform" => {
                let (map, is_affine) = matrix::of_columns(lexer.numbers()?);
                if !is_affine {
                    self.note(&lexer.place(), "the perspective of a matrix is left out");
                }
                if word == "Transform" {
                    self.set(map);
                } else {
                    self.concat(map);
                }
            }
            "CoordinateSystem" => {
                let name = lexer.string()?;
                self.spaces.insert(name, self.graphics.ctm);
            }
            "CoordSysTransform" => {
                let name = lexer.string()?;
                match self.spaces.get(&name) {
                    Some(&map) => self.set(map),
                    None => self.note(
                        &lexer.place(),
                        format!("coordinate system `{}` is not defined", shown(&name)),
                    ),
                }
            }
            "TransformTimes" => {
                let _: [f64; 2] = lexer.numbers()?;
                self.note(&lexer.place(), "motion is left out; all is where it starts");
            }
            "ActiveTransform" => match lexer.next()? {
                Some(Token::Word(which)) => self.graphics.is_start_active = which != "EndTime",
                _ => {
                    return Err(wrong(
                        &lexer.place(),
                        "expected StartTime, EndTime or All",
                        REPAIR,
                    ));
                }
            },
            "ReverseOrientation" => self.graphics.is_reversed = !self.graphics.is_reversed,
            "AttributeBegin" => self.push(Scope::Attributes, lexer)?,
            "TransformBegin" => self.push(Scope::Transforms, lexer)?,
            "AttributeEnd" => self.pop(Scope::Attributes, lexer)?,
            "TransformEnd" => self.pop(Scope::Transforms, lexer)?,
            "ObjectBegin" => self.begin_object(lexer)?,
            "ObjectEnd" => self.end_object(lexer)?,
            "ObjectInstance" => {
                let name = lexer.string()?;
                match self.objects.get(&name) {
                    Some(_) if self.object.is_some() => {
                        self.note(&lexer.place(), "instances in objects are left out");
                    }
                    Some(&mesh) => self.placed.push(Placed {
                        map: self.graphics.ctm,
                        mesh,
                        name: name.into(),
                    }),
                    None => self.note(
                        &lexer.place(),
                        format!("object `{}` is not defined before its instance", shown(&name)),
                    ),
                }
            }
            "WorldBegin" => {
                self.graphics.ctm = Affine::IDENTITY;
                self.graphics.is_start_active = true;
                self.spaces.insert(String::from("world"), Affine::IDENTITY);
            }
            "WorldEnd" => {}
            "Include" | "Import" => self.include(word, lexer, depth)?,
            "Attribute" => {
                let target = lexer.string()?;
                let params = Params::read(lexer, std::iter::empty())?;
                let place = params.place.clone();
                let attributes = Rc::make_mut(&mut self.graphics.attributes);
                for param in params.into_list() {
                    attributes.retain(|(of, old)| *of != target || old.name != param.name);
                    attributes.push((target.clone(), param));
                }
                if attributes.len() > MAX_ATTRIBUTES {
                    attributes.truncate(MAX_ATTRIBUTES);
                    self.note(
                        &place,
                        format!("parameters by Attribute are left out after {MAX_ATTRIBUTES}"),
                    );
                }
            }
            "MediumInterface" => {
                let place = lexer.place();
                while lexer.is_at_string() {
                    lexer.string()?;
                }
                self.note(&place, "media are left out");
            }
            "NamedMaterial" => {
                let name = lexer.string()?;
                match self.materials.get(&name) {
                    Some(&material) => self.graphics.material = material,
                    None => self.note(
                        &lexer.place(),
                        format!(
                            "material `{}` is not defined, and the one before stays",
                            shown(&name)
                        ),
                    ),
                }
            }
            "Texture" => {
                let name = lexer.string()?;
                let kind = lexer.string()?;
                let class = lexer.string()?;
                let params = self.params(lexer, "texture")?;
                self.note_unknown("Texture", &class, &params);
                self.texture(name, &kind, &class, &params);
            }
            "Option" => {
                Params::read(lexer, std::iter::empty())?;
            }
            _ => self.named(word, lexer)?,
        }
        Ok(())
    }

    /// Directives with one name and parameters, and those that are not known.
    fn named(&mut self, word: &str, lexer: &mut Lexer<'_>) -> Result<(), SceneError> {
        match word {
            "Camera" | "Film" | "Shape" | "Material" | "MakeNamedMaterial" | "LightSource"
            | "AreaLightSource" => {}
            "Sampler" | "Integrator" | "SurfaceIntegrator" | "VolumeIntegrator" | "PixelFilter"
            | "Accelerator" | "Renderer" => {
                lexer.string()?;
                Params::read(lexer, std::iter::empty())?;
                return Ok(());
            }
            "ColorSpace" => {
                let name = lexer.string()?;
                if name != "srgb" {
                    self.note(
                        &lexer.place(),
                        format!("colour space `{}` is taken as srgb", shown(&name)),
                    );
                }
                return Ok(());
            }
            "MakeNamedMedium" => {
                lexer.string()?;
                let params = Params::read(lexer, std::iter::empty())?;
                self.note(&params.place, "media are left out");
                return Ok(());
            }
            _ => {
                let is_number = word.parse::<f64>().is_ok();
                if is_number {
                    let problem = format!("expected a directive, found `{}`", shown(word));
                    return Err(wrong(&lexer.place(), problem, REPAIR));
                }
                self.note(
                    &lexer.place(),
                    format!("directives `{}` are not known", shown(word)),
                );
                while !lexer.is_at_directive_or_end() {
                    lexer.next()?;
                }
                return Ok(());
            }
        }
        let name = lexer.string()?;
        let target = match word {
            "Shape" => "shape",
            "Material" | "MakeNamedMaterial" => "material",
            "LightSource" | "AreaLightSource" => "light",
            _ => "",
        };
        let params = self.params(lexer, target)?;
        self.note_unknown(word, &name, &params);
        match word {
            "Camera" => self.camera(&name, &params),
            "Film" => self.film(&params),
            "Shape" => self.shape(&name, &params)?,
            "Material" => self.graphics.material = self.material("", &name, &params),
            "MakeNamedMaterial" => {
                let kind = params.string("type").unwrap_or_default().to_owned();
                let material = self.material(&name, &kind, &params);
                self.materials.insert(name, material);
            }
            "LightSource" => self.light(&name, &params),
            _ => self.graphics.area = self.area_light(&name, &params).map(Rc::new),
        }
        Ok(())
    }

    /// Parameters, with those by `Attribute` after them.
    fn params(&self, lexer: &mut Lexer<'_>, target: &str) -> Result<Params, SceneError> {
        let attributes = Rc::clone(&self.graphics.attributes);
        let own = attributes
            .iter()
            .filter(|(of, _)| of == target)
            .map(|(_, param)| param);
        Params::read(lexer, own)
    }

    /// Names parameters that the directive does not have.
    fn note_unknown(&mut self, directive: &str, kind: &str, params: &Params) {
        for param in params.own() {
            if !known::is_known(directive, kind, &param.name) {
                self.note(
                    &params.place,
                    format!(
                        "ignored parameter `{}` of {directive}: it has none of that name; correct the name",
                        shown(&param.name)
                    ),
                );
            }
        }
    }

    fn set(&mut self, map: Affine) {
        if self.graphics.is_start_active {
            self.graphics.ctm = map;
        }
    }

    /// The map that comes last in the file is applied first.
    fn concat(&mut self, map: Affine) {
        self.set(self.graphics.ctm.then_after(&map));
    }
}
