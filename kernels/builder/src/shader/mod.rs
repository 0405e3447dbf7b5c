//! Libraries of functions for shaders in other languages, out of the tree's compiled kernels.
//!
//! A kernel answers a query for each invocation. As a function it takes the query as arguments, and returns the answer; what all
//! invocations share stays a buffer. Nothing of a walk is written twice.

mod function;
mod print;
mod query;
mod types;

use naga::{
    AddressSpace, Block, Function, GlobalVariable, Handle, Module, ResourceBinding, Span, Statement,
    StorageAccess, Type, TypeInner,
};
use std::collections::HashMap;

pub use print::Language;

use crate::Error;
use function::{Role, Translation};
use types::{Names, Types};

/// A function: its kernel, its name, what a query's words after the receiver are, and its answer.
#[derive(Clone, Copy, Debug)]
struct Signature {
    kernel: &'static str,
    name: &'static str,
    /// As of [`Translation::arguments`].
    words: &'static [&'static str],
    answer: Names,
}

const SAMPLE: Signature = Signature {
    kernel: "sample",
    name: "sample",
    words: &["number.xy"],
    answer: ("LightSample", &["light", "instance", "pmf"]),
};
const PMF: Signature = Signature {
    kernel: "pmf",
    name: "pmf",
    words: &["light", "instance"],
    answer: ("", &[]),
};
const LIGHT_POINT: Signature = Signature {
    kernel: "light_points",
    name: "light_point",
    words: &["_", "_"],
    answer: ("LightPoint", &["p", "density", "normal", "flags", "radiance"]),
};
const SAMPLE_CELL: Signature = Signature {
    kernel: "sample_cell",
    name: "sample_cell",
    ..SAMPLE
};
const PMF_CELL: Signature = Signature {
    kernel: "pmf_cell",
    name: "pmf_cell",
    ..PMF
};

const POINT: &[&str] = &["p.xyz", "n.xyz"];
const CELL: &[&str] = &["center.xyz", "half.xyz", "n.xyz"];

/// A set of kernels over the same nodes.
#[derive(Clone, Copy, Debug)]
pub struct Set {
    /// What the names of its kernels end in.
    pub suffix: &'static str,
    /// Its functions, each with the names of a receiver's words.
    functions: &'static [(Signature, &'static [&'static str])],
}

/// The sets of kernels: those of `LightBvh`, `AnyLights`, and `MaskedLights`.
pub const SETS: [Set; 3] = [
    Set {
        suffix: "",
        functions: &[
            (SAMPLE, POINT),
            (PMF, POINT),
            (SAMPLE_CELL, CELL),
            (PMF_CELL, CELL),
            (LIGHT_POINT, POINT),
        ],
    },
    Set {
        suffix: "_any",
        functions: &[(SAMPLE, POINT), (PMF, POINT), (LIGHT_POINT, POINT)],
    },
    Set {
        suffix: "_linked",
        functions: &[(SAMPLE, LINKED), (PMF, LINKED), (LIGHT_POINT, LINKED)],
    },
];

const LINKED: &[&str] = &["p.xyz", "n.xyz", "mask"];

/// A sample as an argument: its probability is not needed. And two numbers in [0, 1).
const SAMPLES: [&str; 3] = ["light", "instance", "_"];
const NUMBERS: [&str; 1] = ["numbers.xy"];

/// The library's buffers in the order of their bindings, and the names of the structs around them and of their elements; the tree's words last.
const BUFFERS: [(&str, &str, Names); 5] = [
    ("nodes", "Nodes", ("Node", &[])),
    (
        "instances",
        "Instances",
        (
            "Instance",
            &[
                "root",
                "blas",
                "first",
                "first_light",
                "count",
                "listed",
                "columns",
                "translation",
                "inverse",
                "per_inverse",
                "flux",
                "radiance",
                "mask",
                "mirrored",
            ],
        ),
    ),
    ("trails", "Trails", ("Trails", &[])),
    ("lights", "Lights", ("Light", &["p", "radiance", "mesh", "flags"])),
    (
        "tree",
        "",
        (
            "Tree",
            &[
                "root",
                "trail_words",
                "live",
                "lights",
                "depth",
                "top",
                "above",
                "places",
                "parts",
            ],
        ),
    ),
];

/// Place of the tree's words in [`BUFFERS`].
const TREE: usize = 4;

/// What an engine chooses of a library.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Naming {
    /// What the names of the library's functions, buffers and types begin with: lower-case words joined by `_`; in types each word has a capital.
    pub prefix: String,
    /// Bind group (descriptor set, register space) of its buffers.
    pub group: u8,
    /// Bindings of nodes, instances, trails, lights, and the tree's words: five different numbers.
    pub bindings: [u8; 5],
}

impl Naming {
    fn check(&self) -> Result<(), Error> {
        let own = &self.prefix;
        let is_letter =
            |letter: char| letter.is_ascii_lowercase() || letter.is_ascii_digit() || letter == '_';
        let is_prefix = own.starts_with(|first: char| first.is_ascii_lowercase())
            && own.chars().all(is_letter)
            && !own.contains("__")
            && !own.ends_with('_')
            // Some compilers of shaders refuse names of 1,024 letters.
            && own.len() <= 64;
        if !is_prefix {
            return Err(Error(format!(
                "{own:?} is no prefix: lower-case words joined by _, at most 64 letters"
            )));
        }
        match (1..5).all(|k| !self.bindings[..k].contains(&self.bindings[k])) {
            true => Ok(()),
            false => Err(Error(format!(
                "the bindings {:?} are not different",
                self.bindings
            ))),
        }
    }
}

impl Default for Naming {
    fn default() -> Self {
        Self {
            prefix: "lightbvh".to_owned(),
            group: 0,
            bindings: [0, 1, 2, 3, 4],
        }
    }
}

/// A library of functions.
#[derive(Debug)]
pub struct Library {
    module: Module,
    naming: Naming,
}

impl Library {
    /// The functions of a set of kernels: by the name of a kernel without the set's suffix, `read` gives the words of its module and
    /// the names of its buffers by binding.
    ///
    /// # Errors
    /// When the prefix or the bindings are not as [`Naming`] says, or a module has something that no function can have.
    pub fn new(
        naming: Naming,
        set: &Set,
        mut read: impl FnMut(&str) -> Result<(Vec<u32>, Vec<String>), Error>,
    ) -> Result<Self, Error> {
        naming.check()?;
        let mut library = Self {
            module: Module::default(),
            naming,
        };
        for (own, receiver) in set.functions {
            let (words, buffers) = read(own.kernel)?;
            let added = library.add(own, receiver, &words, &buffers);
            added.map_err(|error| Error(format!("{}: {error}", own.kernel)))?;
        }
        library.name_types();
        Ok(library)
    }

    /// The library as text.
    ///
    /// # Errors
    /// When the language cannot express it, or keeps names of that prefix for itself.
    pub fn print(&self, language: Language) -> Result<String, Error> {
        let text = language.print(&self.module)?;
        let prefix = &self.naming.prefix;
        match text.contains(&format!(" {prefix}_sample(")) {
            true => Ok(text),
            false => Err(Error(format!(
                "{language:?} keeps names that begin with {prefix} for itself: choose another prefix"
            ))),
        }
    }

    fn add(
        &mut self,
        own: &Signature,
        receiver: &[&str],
        words: &[u32],
        buffers: &[String],
    ) -> Result<(), Error> {
        let from = parsed(words)?;
        let entry = from.entry_points.first();
        let root = entry.and_then(|entry| called_by(&entry.function.body));
        let root = root.ok_or_else(|| Error("no entry point that calls a function".to_owned()))?;
        let mut types = Types::new(&from);
        let mut called = HashMap::new();
        let shared = self.shared(&mut types, buffers)?;
        for (old, function) in from.functions.iter().filter(|(old, _)| *old != root) {
            let mut copy = Translation::new(&mut self.module, &mut types, function, &called);
            copy.roles.clone_from(&shared);
            let mut function = copy.copy()?;
            function.name = Some(format!("{}_{}_{}", self.naming.prefix, own.name, old.index()));
            called.insert(old, self.module.functions.append(function, Span::UNDEFINED));
        }
        let mut copy = Translation::new(&mut self.module, &mut types, &from.functions[root], &called);
        copy.roles = shared;
        for (global, name) in bound(&from, buffers) {
            if BUFFERS.iter().any(|(shared, ..)| *shared == name) {
                continue;
            }
            let array = copy.types.held(from.global_variables[global].ty)?;
            let TypeInner::Array { base, .. } = from.types[array].inner else {
                return Err(Error(format!("{name} is no array")));
            };
            let local = copy.own(name, base)?;
            copy.roles.insert(global, Role::Own(local));
            match name {
                "results" => copy.returns(local, own.answer)?,
                "queries" => copy.arguments(local, receiver.iter().chain(own.words))?,
                "samples" => copy.arguments(local, &SAMPLES)?,
                "numbers" => copy.arguments(local, &NUMBERS)?,
                _ => return Err(Error(format!("no function knows a buffer {name}"))),
            }
        }
        let mut function = copy.copy()?;
        function.name = Some(format!("{}_{}", self.naming.prefix, own.name));
        self.module.functions.append(function, Span::UNDEFINED);
        Ok(())
    }

    /// What the globals are that no query has: buffers that all share, push constants, the number of the invocation.
    fn shared(
        &mut self,
        types: &mut Types<'_>,
        buffers: &[String],
    ) -> Result<HashMap<Handle<GlobalVariable>, Role>, Error> {
        let mut roles = HashMap::new();
        for (global, own) in types.from.global_variables.iter() {
            match own.space {
                AddressSpace::Immediate => {
                    // A struct within a struct: the number of queries, then the tree's words if there are any.
                    let push = types.held(own.ty)?;
                    let tree = match &types.from.types[push].inner {
                        TypeInner::Struct { members, .. } => members.get(1).map(|member| member.ty),
                        _ => None,
                    };
                    let tree = tree.map(|tree| self.buffer(types, TREE, tree)).transpose()?;
                    roles.insert(global, Role::Push(tree));
                }
                AddressSpace::Private => {
                    // One that has a value is a constant.
                    roles.insert(global, own.init.map_or(Role::Invocation, Role::Constant));
                }
                _ => {}
            }
        }
        for (global, name) in bound(types.from, buffers) {
            if let Some(place) = BUFFERS.iter().position(|(shared, ..)| *shared == name) {
                let own = self.buffer(types, place, types.from.global_variables[global].ty)?;
                roles.insert(global, Role::Shared(own));
            }
        }
        Ok(roles)
    }

    /// A buffer of the library, of a type of `types.from`.
    fn buffer(
        &mut self,
        types: &mut Types<'_>,
        place: usize,
        ty: Handle<Type>,
    ) -> Result<Handle<GlobalVariable>, Error> {
        let (name, list, names) = BUFFERS[place];
        let ty = if place == TREE {
            types.copy(&mut self.module, ty, Some(names))?
        } else {
            // The struct around the array.
            let held = types.held(ty)?;
            types.copy(&mut self.module, held, Some(names))?;
            types.copy(&mut self.module, ty, Some((list, &["list"])))?
        };
        let own = GlobalVariable {
            name: Some(format!("{}_{name}", self.naming.prefix)),
            space: if place == TREE {
                AddressSpace::Uniform
            } else {
                AddressSpace::Storage {
                    access: StorageAccess::LOAD,
                }
            },
            binding: Some(ResourceBinding {
                group: self.naming.group.into(),
                binding: self.naming.bindings[place].into(),
            }),
            ty,
            init: None,
            memory_decorations: naga::MemoryDecorations::empty(),
        };
        let is_same = |have: &GlobalVariable, own: &GlobalVariable| have.name == own.name;
        Ok(self
            .module
            .global_variables
            .fetch_if_or_append(own, Span::UNDEFINED, is_same))
    }

    /// Begins the names of structs with the prefix.
    fn name_types(&mut self) {
        let words = self.naming.prefix.split('_');
        let prefix: String = words.map(capital).collect();
        let all: Vec<_> = self
            .module
            .types
            .iter()
            .map(|(own, ty)| (own, ty.clone()))
            .collect();
        for (own, ty) in all {
            if let TypeInner::Struct { .. } = ty.inner {
                let name = ty.name.unwrap_or_else(|| format!("Type{}", own.index()));
                let named = Type {
                    name: Some(format!("{prefix}{name}")),
                    inner: ty.inner,
                };
                self.module.types.replace(own, named);
            }
        }
    }
}

/// A kernel in WGSL, for devices that take nothing else: buffers named as its parameters, at their bindings in group 0, then push
/// constants as a buffer that is read.
///
/// # Errors
/// When naga cannot translate it.
pub fn kernel(words: &[u32], buffers: &[String]) -> Result<String, Error> {
    let mut module = parsed(words)?;
    let names: HashMap<_, _> = bound(&module, buffers).into_iter().collect();
    for (own, global) in module.global_variables.iter_mut() {
        if let Some(name) = names.get(&own) {
            global.name = Some((*name).to_owned());
        }
        if global.space == AddressSpace::Immediate {
            global.name = Some("push".to_owned());
            global.space = AddressSpace::Storage {
                access: StorageAccess::LOAD,
            };
            global.binding = Some(ResourceBinding {
                group: 0,
                binding: buffers.len() as u32,
            });
        }
    }
    Language::Wgsl.print(&module)
}

fn parsed(words: &[u32]) -> Result<Module, Error> {
    let options = naga::front::spv::Options {
        adjust_coordinate_space: false,
        ..Default::default()
    };
    let frontend = naga::front::spv::Frontend::new(words.iter().copied(), &options);
    frontend.parse().map_err(|error| Error(error.to_string()))
}

fn capital(word: &str) -> String {
    let mut letters = word.chars();
    letters
        .next()
        .map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// The globals that are bound, with their names, by binding.
fn bound<'a>(from: &Module, buffers: &'a [String]) -> Vec<(Handle<GlobalVariable>, &'a str)> {
    let globals = from.global_variables.iter();
    let mut bound: Vec<_> = globals
        .filter_map(|(own, global)| Some((own, global.binding?.binding)))
        .collect();
    bound.sort_by_key(|(_, binding)| *binding);
    let named = bound.into_iter();
    named
        .filter_map(|(own, binding)| Some((own, &**buffers.get(binding as usize)?)))
        .collect()
}

/// The function that an entry point calls.
fn called_by(body: &Block) -> Option<Handle<Function>> {
    body.iter().find_map(|statement| match statement {
        Statement::Call { function, .. } => Some(*function),
        _ => None,
    })
}
