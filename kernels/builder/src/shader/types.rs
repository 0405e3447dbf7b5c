//! Types of a library of functions.

use naga::proc::{Alignment, Layouter};
use naga::{ArraySize, Handle, Module, StructMember, Type, TypeInner, VectorSize};
use std::collections::HashMap;

use crate::Error;

/// A name for a struct, and for its members.
pub(super) type Names = (&'static str, &'static [&'static str]);

/// Copies types of one module into another.
pub(super) struct Types<'a> {
    pub from: &'a Module,
    copied: HashMap<Handle<Type>, Handle<Type>>,
}

impl<'a> Types<'a> {
    pub fn new(from: &'a Module) -> Self {
        Self {
            from,
            copied: HashMap::new(),
        }
    }

    /// The copy of a type; structs get a name if there is one, unless they were copied before.
    pub fn copy(
        &mut self,
        to: &mut Module,
        own: Handle<Type>,
        names: Option<Names>,
    ) -> Result<Handle<Type>, Error> {
        if let Some(&copied) = self.copied.get(&own) {
            return Ok(copied);
        }
        let inner = match &self.from.types[own].inner {
            inner @ (TypeInner::Scalar(_) | TypeInner::Vector { .. }) => inner.clone(),
            &TypeInner::Array { base, size, stride } => TypeInner::Array {
                base: self.copy(to, base, names)?,
                size,
                stride,
            },
            &TypeInner::Pointer { base, space } => TypeInner::Pointer {
                base: self.copy(to, base, names)?,
                space,
            },
            TypeInner::Struct { members, span } => {
                if let Some((name, own)) = names
                    && !own.is_empty()
                    && own.len() != members.len()
                {
                    return Err(Error(format!(
                        "{name} has {} members, not {own:?}",
                        members.len()
                    )));
                }
                let mut copies = Vec::new();
                for (k, member) in members.iter().enumerate() {
                    let name = names.and_then(|(_, own)| own.get(k));
                    copies.push(StructMember {
                        name: name.map(|&name| name.to_owned()),
                        ty: self.copy(to, member.ty, None)?,
                        ..member.clone()
                    });
                }
                TypeInner::Struct {
                    members: copies,
                    span: *span,
                }
            }
            other => return Err(Error(format!("functions take no type {other:?}"))),
        };
        let is_struct = matches!(inner, TypeInner::Struct { .. });
        let name = names.filter(|_| is_struct).map(|(name, _)| name.to_owned());
        let copied = insert(to, name, inner);
        self.copied.insert(own, copied);
        Ok(copied)
    }

    /// The only member of a buffer's struct, the array or struct that it holds.
    pub fn held(&self, buffer: Handle<Type>) -> Result<Handle<Type>, Error> {
        match &self.from.types[buffer].inner {
            TypeInner::Struct { members, .. } => Ok(members[0].ty),
            other => Err(Error(format!("a buffer of type {other:?}"))),
        }
    }
}

/// The type in a module.
pub(super) fn insert(to: &mut Module, name: Option<String>, inner: TypeInner) -> Handle<Type> {
    to.types.insert(Type { name, inner }, naga::Span::UNDEFINED)
}

/// An array of two to four as the vector that a shader's author expects; other types have none.
pub(super) fn as_vector(module: &Module, own: Handle<Type>) -> Option<TypeInner> {
    let TypeInner::Array {
        base,
        size: ArraySize::Constant(count),
        ..
    } = module.types[own].inner
    else {
        return None;
    };
    let TypeInner::Scalar(scalar) = module.types[base].inner else {
        return None;
    };
    vector_size(count.get()).map(|size| TypeInner::Vector { size, scalar })
}

/// The size of a vector of two to four.
pub(super) fn vector_size(count: u32) -> Option<VectorSize> {
    match count {
        2 => Some(VectorSize::Bi),
        3 => Some(VectorSize::Tri),
        4 => Some(VectorSize::Quad),
        _ => None,
    }
}

/// The type of what a function returns: with names, and vectors in place of such arrays.
pub(super) fn returned(
    to: &mut Module,
    own: Handle<Type>,
    (name, parts): Names,
) -> Result<Handle<Type>, Error> {
    let TypeInner::Struct { mut members, .. } = to.types[own].inner.clone() else {
        return Ok(as_vector(to, own).map_or(own, |vector| insert(to, None, vector)));
    };
    for (member, part) in members.iter_mut().zip(parts) {
        member.name = Some((*part).to_owned());
        if let Some(vector) = as_vector(to, member.ty) {
            member.ty = insert(to, None, vector);
        }
    }
    let mut layouter = Layouter::default();
    layouter
        .update(to.to_ctx())
        .map_err(|error| Error(format!("{name}: {error}")))?;
    let (mut end, mut alignment) = (0, Alignment::ONE);
    for member in &mut members {
        let layout = layouter[member.ty];
        member.offset = layout.alignment.round_up(end);
        end = member.offset + layout.size;
        alignment = alignment.max(layout.alignment);
    }
    let span = alignment.round_up(end);
    Ok(insert(
        to,
        Some(name.to_owned()),
        TypeInner::Struct { members, span },
    ))
}
