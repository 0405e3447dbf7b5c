//! The query of an invocation as arguments, and its answer as a result.

use naga::{
    Block, Expression, FunctionArgument, FunctionResult, Handle, LocalVariable, Statement, Type, TypeInner,
};

use super::function::Translation;
use super::types::{Names, as_vector, insert, returned, vector_size};
use crate::Error;

impl Translation<'_, '_> {
    /// A local variable for the element of a buffer that belongs to an invocation.
    pub fn own(&mut self, name: &str, element: Handle<Type>) -> Result<Handle<LocalVariable>, Error> {
        let ty = self.types.copy(self.to, element, None)?;
        Ok(self.local(name, ty))
    }

    /// Sets an element from arguments, as `names` say in the order of its words: `p.xyz` is a vector, `light` a number, `_` zero.
    pub fn arguments<'n>(
        &mut self,
        local: Handle<LocalVariable>,
        names: impl IntoIterator<Item = &'n &'n str>,
    ) -> Result<(), Error> {
        let ty = self.out.local_variables[local].ty;
        let before = self.out.expressions.len();
        let mut words = Vec::new();
        self.words(ty, &mut words)?;
        let (mut words, mut names) = (words.into_iter().peekable(), names.into_iter().copied());
        let mut values = Vec::new();
        while let Some(&scalar) = words.peek() {
            let missing = || Error("fewer names of arguments than words of a query".to_owned());
            let name = names.next().ok_or_else(missing)?;
            let (name, parts) = name.split_once('.').unwrap_or((name, "x"));
            for _ in parts.chars() {
                words.next().ok_or_else(missing)?;
            }
            if name == "_" {
                let ty = insert(self.to, None, TypeInner::Scalar(scalar));
                values.push(self.append(Expression::ZeroValue(ty)));
                continue;
            }
            let vector = vector_size(parts.len() as u32).map(|size| TypeInner::Vector { size, scalar });
            let inner = vector.unwrap_or(TypeInner::Scalar(scalar));
            let argument = FunctionArgument {
                name: Some(name.to_owned()),
                ty: insert(self.to, None, inner),
                binding: None,
            };
            let base = self.append(Expression::FunctionArgument(self.out.arguments.len() as u32));
            self.out.arguments.push(argument);
            match parts.len() {
                1 => values.push(base),
                count => {
                    let parts =
                        (0..count as u32).map(|index| self.append(Expression::AccessIndex { base, index }));
                    values.extend(parts.collect::<Vec<_>>());
                }
            }
        }
        if let Some(name) = names.next() {
            return Err(Error(format!("no word of a query is {name}")));
        }
        let value = self.compose(ty, &mut values.into_iter())?;
        let pointer = self.append(Expression::LocalVariable(local));
        let computed = self.emitted_since(before);
        computed.into_iter().for_each(|statement| self.push(statement));
        self.push(Statement::Store { pointer, value });
        Ok(())
    }

    /// The scalars of a type, in order.
    fn words(&self, ty: Handle<Type>, out: &mut Vec<naga::Scalar>) -> Result<(), Error> {
        match &self.to.types[ty].inner {
            TypeInner::Scalar(scalar) => out.push(*scalar),
            TypeInner::Array {
                base,
                size: naga::ArraySize::Constant(count),
                ..
            } => {
                (0..count.get()).try_for_each(|_| self.words(*base, out))?;
            }
            TypeInner::Struct { members, .. } => {
                members.iter().try_for_each(|member| self.words(member.ty, out))?;
            }
            other => return Err(Error(format!("a query holds {other:?}"))),
        }
        Ok(())
    }

    /// A value of a type from its scalars.
    fn compose(
        &mut self,
        ty: Handle<Type>,
        words: &mut dyn Iterator<Item = Handle<Expression>>,
    ) -> Result<Handle<Expression>, Error> {
        let parts = match &self.to.types[ty].inner {
            TypeInner::Array {
                base,
                size: naga::ArraySize::Constant(count),
                ..
            } => vec![*base; count.get() as usize],
            TypeInner::Struct { members, .. } => members.iter().map(|member| member.ty).collect(),
            _ => {
                return words
                    .next()
                    .ok_or_else(|| Error("a query is longer than its words".to_owned()));
            }
        };
        let components: Result<_, Error> = parts.into_iter().map(|part| self.compose(part, words)).collect();
        Ok(self.append(Expression::Compose {
            ty,
            components: components?,
        }))
    }

    /// Makes the function return the variable, its members under these names.
    pub fn returns(&mut self, local: Handle<LocalVariable>, names: Names) -> Result<(), Error> {
        let ty = returned(self.to, self.out.local_variables[local].ty, names)?;
        self.result = Some(local);
        self.out.result = Some(FunctionResult { ty, binding: None });
        Ok(())
    }

    /// Returns the result, arrays as vectors.
    pub(super) fn returning(&mut self) -> Result<Block, Error> {
        let (Some(local), Some(result)) = (self.result, &self.out.result) else {
            return Ok(Block::new());
        };
        let (ty, out) = (self.out.local_variables[local].ty, result.ty);
        let before = self.out.expressions.len();
        let pointer = self.append(Expression::LocalVariable(local));
        let mut value = self.append(Expression::Load { pointer });
        if let TypeInner::Struct { members, .. } = self.to.types[ty].inner.clone() {
            let mut components = Vec::new();
            for (index, member) in (0..).zip(members) {
                let part = self.append(Expression::AccessIndex { base: value, index });
                components.push(self.vector(member.ty, part));
            }
            value = self.append(Expression::Compose { ty: out, components });
        } else {
            value = self.vector(ty, value);
        }
        let mut statements = self.emitted_since(before);
        statements.push(Statement::Return { value: Some(value) });
        Ok(Block::from_vec(statements))
    }

    /// The value of an array as a vector; other values as they are.
    fn vector(&mut self, ty: Handle<Type>, base: Handle<Expression>) -> Handle<Expression> {
        let Some(vector @ TypeInner::Vector { size, .. }) = as_vector(self.to, ty) else {
            return base;
        };
        let ty = insert(self.to, None, vector);
        let parts = (0..size as u32).map(|index| self.append(Expression::AccessIndex { base, index }));
        let components = parts.collect();
        self.append(Expression::Compose { ty, components })
    }
}
