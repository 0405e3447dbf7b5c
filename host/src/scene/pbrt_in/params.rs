//! Lists of parameters: `"type name" [ values ]`.

use std::rc::Rc;

use super::super::error::SceneError;
use super::super::notes::Place;
use super::token::Lexer;
use super::{REPAIR, shown, wrong};

/// Types whose values are numbers alone.
const OF_NUMBERS: [&str; 12] = [
    "float", "integer", "point", "point2", "point3", "vector", "vector2", "vector3", "normal", "normal3",
    "rgb", "color",
];

/// A parameter.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Param {
    /// As `float`, `rgb` or `texture`.
    pub kind: String,
    pub name: String,
    pub numbers: Vec<f64>,
    /// Strings, and words as `true`.
    pub words: Vec<String>,
}

/// Parameters of a directive.
#[derive(Clone, Debug)]
pub(super) struct Params {
    list: Vec<Rc<Param>>,
    /// How many of them, the first ones, are the directive's own.
    own: usize,
    pub place: Place,
}

impl Params {
    /// All that come next; `defaults` count where there is no other of their name.
    pub fn read<'p>(
        lexer: &mut Lexer<'_>,
        defaults: impl Iterator<Item = &'p Rc<Param>>,
    ) -> Result<Self, SceneError> {
        let place = lexer.place();
        let mut list = Vec::new();
        while lexer.is_at_string() {
            let declared = lexer.string()?;
            let place = lexer.place();
            let mut words = declared.split_ascii_whitespace();
            let (Some(kind), Some(name), None) = (words.next(), words.next(), words.next()) else {
                let problem = format!("`{}` is no type and name of a parameter", shown(&declared));
                return Err(wrong(&place, problem, REPAIR));
            };
            let mut param = Param {
                kind: kind.to_owned(),
                name: name.to_owned(),
                numbers: Vec::new(),
                words: Vec::new(),
            };
            lexer.values(&mut param.numbers, &mut param.words)?;
            if param.numbers.iter().any(|x| !x.is_finite()) {
                let problem = format!("`{}` has a number that is not finite", shown(&declared));
                return Err(wrong(&place, problem, REPAIR));
            }
            if !param.numbers.is_empty() && !param.words.is_empty() {
                let problem = format!(
                    "`{}` mixes numbers with `{}`",
                    shown(&declared),
                    shown(&param.words[0])
                );
                return Err(wrong(&place, problem, REPAIR));
            }
            let expected = match kind {
                "string" | "texture" | "bool" if !param.numbers.is_empty() => "words",
                _ if OF_NUMBERS.contains(&kind) && !param.words.is_empty() => "numbers",
                _ => "",
            };
            if !expected.is_empty() {
                let problem = format!("`{}` has other values than {expected}", shown(&declared));
                return Err(wrong(&place, problem, REPAIR));
            }
            list.push(Rc::new(param));
        }
        let own = list.len();
        list.extend(defaults.cloned());
        Ok(Self { list, own, place })
    }

    /// Those that stand at the directive itself.
    pub fn own(&self) -> &[Rc<Param>] {
        &self.list[..self.own]
    }

    /// All of them.
    pub fn into_list(self) -> Vec<Rc<Param>> {
        self.list
    }

    pub fn find(&self, name: &str) -> Option<&Param> {
        self.list
            .iter()
            .find(|param| param.name == name)
            .map(|param| &**param)
    }

    /// The first of several names that there is.
    pub fn find_any(&self, names: &[&str]) -> Option<&Param> {
        names.iter().find_map(|name| self.find(name))
    }

    /// The numbers of a parameter; none where it is not there.
    pub fn numbers(&self, name: &str) -> &[f64] {
        self.find(name).map_or(&[], |param| &param.numbers)
    }

    pub fn number(&self, name: &str) -> Option<f64> {
        self.numbers(name).first().copied()
    }

    pub fn string(&self, name: &str) -> Option<&str> {
        let param = self.find(name)?;
        param.words.first().map(String::as_str)
    }

    pub fn flag(&self, name: &str) -> bool {
        self.string(name) == Some("true")
    }

    pub fn point(&self, name: &str) -> Option<[f64; 3]> {
        let numbers = self.numbers(name);
        numbers.first_chunk().copied().filter(|_| numbers.len() == 3)
    }

    /// Points in threes, as the mesh has them.
    pub fn points(&self, name: &str) -> Result<Vec<[f32; 3]>, SceneError> {
        let (points, rest) = self.numbers(name).as_chunks::<3>();
        if !rest.is_empty() {
            let problem = format!(
                "`{name}` has {} numbers, not a multiple of 3",
                self.numbers(name).len()
            );
            return Err(wrong(&self.place, problem, REPAIR));
        }
        Ok(points.iter().map(|point| point.map(|x| x as f32)).collect())
    }

    /// Vertex indices, each below `vertices`.
    pub fn indices(&self, name: &str, vertices: usize) -> Result<Vec<u32>, SceneError> {
        let index = |&number: &f64| {
            let fits = number >= 0.0 && number < vertices as f64 && number.fract() == 0.0;
            fits.then_some(number as u32).ok_or_else(|| {
                let problem = format!("`{name}` refers to vertex {number}, but there are only {vertices}");
                wrong(&self.place, problem, REPAIR)
            })
        };
        self.numbers(name).iter().map(index).collect()
    }
}
