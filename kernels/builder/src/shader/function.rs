//! From a kernel that answers a query of each invocation to a function that answers one: arguments in place of the query, a result
//! in place of the answer, no invocation.

use naga::{
    BinaryOperator, Block, Expression, Function, FunctionArgument, FunctionResult, GlobalVariable, Handle,
    Literal, LocalVariable, Module, Range, Span, Statement, SwitchCase, Type, TypeInner,
};
use std::collections::{HashMap, HashSet};

use super::types::{Names, Types, as_vector, insert, returned};
use crate::Error;

/// What a global variable of a kernel is to a function.
#[derive(Clone, Copy)]
pub(super) enum Role {
    /// The number of the invocation: zero.
    Invocation,
    /// Push constants: the number of queries, which is one, and a buffer of the library for the member after it.
    Push(Option<Handle<GlobalVariable>>),
    /// One element for each invocation, in a local variable.
    Own(Handle<LocalVariable>),
    /// A buffer of the library.
    Shared(Handle<GlobalVariable>),
    /// A constant of this value, which is read by address.
    Constant(Handle<Expression>),
    /// That, in a local variable.
    Local(Handle<LocalVariable>),
}

/// What is known of an expression without computing it.
#[derive(Clone, Copy)]
enum Known {
    /// Something within a global variable of this role, so many members deep.
    Within(Role, usize),
    Word(u32),
    Bool(bool),
}

/// A function in the making, out of one of `types.from`.
pub(super) struct Translation<'a, 'b> {
    pub to: &'b mut Module,
    pub types: &'b mut Types<'a>,
    pub roles: HashMap<Handle<GlobalVariable>, Role>,
    /// The functions that it may call.
    pub called: &'b HashMap<Handle<Function>, Handle<Function>>,
    pub out: Function,
    own: &'a Function,
    locals: HashMap<Handle<LocalVariable>, Handle<LocalVariable>>,
    known: HashMap<Handle<Expression>, Known>,
    new: HashMap<Handle<Expression>, Handle<Expression>>,
    /// Conditions that hold where the statement stands.
    holds: HashSet<Handle<Expression>>,
    /// What is returned in place of nothing.
    result: Option<(Handle<LocalVariable>, Handle<Type>, Handle<Type>)>,
}

impl<'a, 'b> Translation<'a, 'b> {
    pub fn new(
        to: &'b mut Module,
        types: &'b mut Types<'a>,
        own: &'a Function,
        called: &'b HashMap<Handle<Function>, Handle<Function>>,
    ) -> Self {
        Self {
            to,
            types,
            roles: HashMap::new(),
            called,
            out: Function::default(),
            own,
            locals: HashMap::new(),
            known: HashMap::new(),
            new: HashMap::new(),
            holds: HashSet::new(),
            result: None,
        }
    }

    /// A local variable for the element of a buffer that belongs to an invocation, and its type.
    pub fn own(&mut self, name: &str, element: Handle<Type>) -> Result<(Role, Handle<Type>), Error> {
        let ty = self.types.copy(self.to, element, None)?;
        Ok((Role::Own(self.local(name, ty)), ty))
    }

    fn local(&mut self, name: &str, ty: Handle<Type>) -> Handle<LocalVariable> {
        let own = LocalVariable {
            name: Some(name.to_owned()),
            ty,
            init: None,
        };
        self.out.local_variables.append(own, Span::UNDEFINED)
    }

    /// Sets an element from arguments, as `names` say in the order of its words: `p.xyz` is a vector, `light` a number, `_` zero.
    pub fn arguments<'n>(
        &mut self,
        own: Role,
        ty: Handle<Type>,
        names: impl IntoIterator<Item = &'n &'n str>,
    ) -> Result<(), Error> {
        let Role::Own(local) = own else {
            return Err(Error("arguments for a buffer that all share".to_owned()));
        };
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
            let inner = match parts.len() {
                1 => TypeInner::Scalar(scalar),
                2 => TypeInner::Vector {
                    size: naga::VectorSize::Bi,
                    scalar,
                },
                _ => TypeInner::Vector {
                    size: naga::VectorSize::Tri,
                    scalar,
                },
            };
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

    /// What is stored to the element of `own` is returned, under these names.
    pub fn returns(&mut self, own: Role, ty: Handle<Type>, names: Names) -> Result<(), Error> {
        let Role::Own(local) = own else {
            return Err(Error("a result in a buffer that all share".to_owned()));
        };
        let out = returned(self.to, ty, names)?;
        self.result = Some((local, ty, out));
        self.out.result = Some(FunctionResult {
            ty: out,
            binding: None,
        });
        Ok(())
    }

    /// Copies the function.
    pub fn copy(mut self) -> Result<Function, Error> {
        for argument in &self.own.arguments {
            let ty = self.types.copy(self.to, argument.ty, None)?;
            let name = format!("a{}", self.out.arguments.len());
            self.out.arguments.push(FunctionArgument {
                name: Some(name),
                ty,
                binding: None,
            });
        }
        if let Some(result) = &self.own.result {
            let ty = self.types.copy(self.to, result.ty, None)?;
            self.out.result = Some(FunctionResult { ty, binding: None });
        }
        for (old, local) in self.own.local_variables.iter() {
            let ty = self.types.copy(self.to, local.ty, None)?;
            let new = self.local(&format!("v{}", old.index()), ty);
            self.locals.insert(old, new);
        }
        let mut constants: Vec<_> = (self.roles.iter())
            .filter_map(|(&global, &role)| match role {
                Role::Constant(init) => Some((global, init)),
                _ => None,
            })
            .collect();
        // In one order each time.
        constants.sort_by_key(|(global, _)| global.index());
        for (global, init) in constants {
            let (init, ty) = constant_value(self.to, self.types, init)?;
            let own = naga::Constant { name: None, ty, init };
            let own = self.to.constants.append(own, Span::UNDEFINED);
            let init = self.append(Expression::Constant(own));
            let local = self.local("constant", ty);
            self.out.local_variables[local].init = Some(init);
            self.roles.insert(global, Role::Local(local));
        }
        for (old, expression) in self.own.expressions.iter() {
            // Each function lists all globals; a use of one that is not there is an error.
            if matches!(expression, Expression::GlobalVariable(own) if !self.roles.contains_key(own)) {
                continue;
            }
            if let Some(known) = self.know(expression) {
                self.known.insert(old, known);
                if let Some(place) = self.place(known) {
                    let new = self.append(place);
                    self.new.insert(old, new);
                }
                continue;
            }
            let new = self.translated(expression)?;
            let new = self.append(new);
            self.new.insert(old, new);
        }
        // Initial values refer to expressions.
        for (old, local) in self.own.local_variables.iter() {
            if let Some(init) = local.init {
                let init = self.at(init)?;
                self.out.local_variables[self.locals[&old]].init = Some(init);
            }
        }
        let body = self.block(&self.own.body)?;
        let mut whole = std::mem::take(&mut self.out.body);
        append(&mut whole, body);
        self.out.body = whole;
        Ok(self.out)
    }

    /// The variable that a known place is, if it is one.
    fn place(&self, known: Known) -> Option<Expression> {
        match known {
            Known::Within(Role::Own(local), 2) | Known::Within(Role::Local(local), 0) => {
                Some(Expression::LocalVariable(local))
            }
            Known::Within(Role::Shared(global), 0) | Known::Within(Role::Push(Some(global)), 2) => {
                Some(Expression::GlobalVariable(global))
            }
            _ => None,
        }
    }

    fn append(&mut self, expression: Expression) -> Handle<Expression> {
        self.out.expressions.append(expression, Span::UNDEFINED)
    }

    fn push(&mut self, statement: Statement) {
        self.out.body.push(statement, Span::UNDEFINED);
    }

    /// Statements that compute all expressions from the place `before` on.
    fn emitted_since(&self, before: usize) -> Vec<Statement> {
        let new = self.out.expressions.iter().skip(before).map(|(new, _)| new);
        self.emitted(new.collect())
    }

    /// Statements that compute expressions, given in their order.
    fn emitted(&self, new: Vec<Handle<Expression>>) -> Vec<Statement> {
        let computed = new
            .into_iter()
            .filter(|&new| !self.out.expressions[new].needs_pre_emit());
        let mut runs: Vec<(Handle<Expression>, Handle<Expression>)> = Vec::new();
        for new in computed {
            match runs.last_mut() {
                Some((_, last)) if last.index() + 1 == new.index() => *last = new,
                _ => runs.push((new, new)),
            }
        }
        let runs = runs.into_iter();
        runs.map(|(first, last)| Statement::Emit(Range::new_from_bounds(first, last)))
            .collect()
    }

    /// The copy of an expression.
    fn at(&mut self, old: Handle<Expression>) -> Result<Handle<Expression>, Error> {
        if let Some(&new) = self.new.get(&old) {
            return Ok(new);
        }
        let literal = match self.known.get(&old) {
            Some(&Known::Word(word)) => Literal::U32(word),
            Some(&Known::Bool(truth)) => Literal::Bool(truth),
            _ => {
                return Err(Error(format!(
                    "an expression of the invocation is left: {:?}",
                    self.own.expressions[old]
                )));
            }
        };
        let new = self.append(Expression::Literal(literal));
        self.new.insert(old, new);
        Ok(new)
    }

    /// What the arguments make known of an expression.
    fn know(&self, expression: &Expression) -> Option<Known> {
        let known = |old: &Handle<Expression>| self.known.get(old).copied();
        match expression {
            Expression::GlobalVariable(global) => self.roles.get(global).map(|&role| Known::Within(role, 0)),
            Expression::AccessIndex { base, index } => match (known(base)?, index) {
                (Known::Within(Role::Invocation, _), _) => Some(Known::Word(0)),
                // The struct around the push constants; their first member is the number of queries.
                (Known::Within(Role::Push(tree), 0), _) => Some(Known::Within(Role::Push(tree), 1)),
                (Known::Within(Role::Push(_), 1), 0) => Some(Known::Word(1)),
                (Known::Within(role @ (Role::Push(_) | Role::Own(_)), depth @ 0..2), _) => {
                    Some(Known::Within(role, depth + 1))
                }
                _ => None,
            },
            Expression::Access { base, index } => match known(base)? {
                Known::Within(role @ Role::Own(_), 1) if self.word(*index) == Some(0) => {
                    Some(Known::Within(role, 2))
                }
                _ => None,
            },
            Expression::ArrayLength(array) => match known(array)? {
                Known::Within(Role::Own(_), 1) => Some(Known::Word(1)),
                _ => None,
            },
            Expression::Load { pointer } => match known(pointer)? {
                own @ (Known::Within(Role::Invocation, _) | Known::Word(_)) => Some(own),
                _ => None,
            },
            Expression::Binary { op, left, right } => match (op, known(left)?, self.word(*right)?) {
                (BinaryOperator::Add, Known::Word(a), b) => Some(Known::Word(a.wrapping_add(b))),
                (BinaryOperator::Multiply, Known::Word(a), b) => Some(Known::Word(a.wrapping_mul(b))),
                (BinaryOperator::Less, Known::Word(a), b) => Some(Known::Bool(a < b)),
                _ => None,
            },
            _ => None,
        }
    }

    /// The value of a word that is known, or a constant.
    fn word(&self, old: Handle<Expression>) -> Option<u32> {
        match (self.known.get(&old), &self.own.expressions[old]) {
            (Some(&Known::Word(word)), _) => Some(word),
            (_, Expression::Literal(Literal::U32(word))) => Some(*word),
            (_, &Expression::Constant(constant)) => {
                let from = self.types.from;
                match from.global_expressions[from.constants[constant].init] {
                    Expression::Literal(Literal::U32(word)) => Some(word),
                    _ => None,
                }
            }
            _ => None,
        }
    }

    /// An expression over copies.
    fn translated(&mut self, expression: &Expression) -> Result<Expression, Error> {
        let mut out = expression.clone();
        match &mut out {
            Expression::Literal(_) | Expression::FunctionArgument(_) => {}
            Expression::Constant(constant) => {
                let init = self.types.from.constants[*constant].init;
                let (init, ty) = constant_value(self.to, self.types, init)?;
                let own = naga::Constant { name: None, ty, init };
                *constant = self.to.constants.append(own, Span::UNDEFINED);
            }
            Expression::ZeroValue(ty) => *ty = self.types.copy(self.to, *ty, None)?,
            Expression::Compose { ty, components } => {
                *ty = self.types.copy(self.to, *ty, None)?;
                for component in components {
                    *component = self.at(*component)?;
                }
            }
            Expression::Access { base, index } => (*base, *index) = (self.at(*base)?, self.at(*index)?),
            Expression::AccessIndex { base: own, .. }
            | Expression::Splat { value: own, .. }
            | Expression::Swizzle { vector: own, .. }
            | Expression::Load { pointer: own }
            | Expression::Unary { expr: own, .. }
            | Expression::Relational { argument: own, .. }
            | Expression::As { expr: own, .. }
            | Expression::ArrayLength(own) => *own = self.at(*own)?,
            Expression::LocalVariable(local) => *local = self.locals[local],
            Expression::Binary { left, right, .. } => (*left, *right) = (self.at(*left)?, self.at(*right)?),
            Expression::Select {
                condition,
                accept,
                reject,
            } => {
                (*condition, *accept, *reject) = (self.at(*condition)?, self.at(*accept)?, self.at(*reject)?);
            }
            Expression::Math {
                arg,
                arg1,
                arg2,
                arg3,
                ..
            } => {
                *arg = self.at(*arg)?;
                for own in [arg1, arg2, arg3].into_iter().flatten() {
                    *own = self.at(*own)?;
                }
            }
            Expression::CallResult(function) => *function = self.called(*function)?,
            other => return Err(Error(format!("functions take no {other:?}"))),
        }
        Ok(out)
    }

    fn called(&self, function: Handle<Function>) -> Result<Handle<Function>, Error> {
        let missing = || Error("a function is called before it is there".to_owned());
        self.called.get(&function).copied().ok_or_else(missing)
    }

    fn block(&mut self, block: &Block) -> Result<Block, Error> {
        let mut out = Block::new();
        for statement in block.iter() {
            let statements = self.statement(statement)?;
            append(&mut out, statements);
        }
        Ok(out)
    }

    fn statement(&mut self, statement: &Statement) -> Result<Block, Error> {
        let one = match statement {
            Statement::Emit(range) => {
                let copies: Vec<_> = range
                    .clone()
                    .filter_map(|old| self.new.get(&old).copied())
                    .collect();
                return Ok(Block::from_vec(self.emitted(copies)));
            }
            Statement::Block(block) => return self.block(block),
            Statement::If {
                condition,
                accept,
                reject,
            } => match self.known.get(condition) {
                Some(Known::Bool(true)) => return self.block(accept),
                Some(Known::Bool(false)) => return self.block(reject),
                // A check of an index that is checked already.
                _ if self.holds.contains(condition) => return self.block(accept),
                _ => {
                    self.holds.insert(*condition);
                    let accept = self.block(accept)?;
                    self.holds.remove(condition);
                    Statement::If {
                        condition: self.at(*condition)?,
                        accept,
                        reject: self.block(reject)?,
                    }
                }
            },
            Statement::Switch { selector, cases } => {
                let cases = cases.iter().map(|case| {
                    Ok(SwitchCase {
                        body: self.block(&case.body)?,
                        ..case.clone()
                    })
                });
                let cases = cases.collect::<Result<_, Error>>()?;
                Statement::Switch {
                    selector: self.at(*selector)?,
                    cases,
                }
            }
            Statement::Loop {
                body,
                continuing,
                break_if,
            } => Statement::Loop {
                body: self.block(body)?,
                continuing: self.block(continuing)?,
                break_if: break_if.map(|own| self.at(own)).transpose()?,
            },
            Statement::Store { pointer, value } => Statement::Store {
                pointer: self.at(*pointer)?,
                value: self.at(*value)?,
            },
            Statement::Call {
                function,
                arguments,
                result,
            } => Statement::Call {
                function: self.called(*function)?,
                arguments: arguments
                    .iter()
                    .map(|&own| self.at(own))
                    .collect::<Result<_, _>>()?,
                result: result.map(|own| self.at(own)).transpose()?,
            },
            Statement::Return { value: None } if self.result.is_some() => return self.returning(),
            Statement::Return { value } => Statement::Return {
                value: value.map(|own| self.at(own)).transpose()?,
            },
            Statement::Break | Statement::Continue => statement.clone(),
            other => return Err(Error(format!("functions take no {other:?}"))),
        };
        Ok(Block::from_vec(vec![one]))
    }

    /// Returns the result, arrays as vectors.
    fn returning(&mut self) -> Result<Block, Error> {
        let Some((local, ty, out)) = self.result else {
            return Ok(Block::new());
        };
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

fn append(to: &mut Block, mut more: Block) {
    to.append(&mut more);
}

/// The copy of a constant expression, and its type.
pub(super) fn constant_value(
    to: &mut Module,
    types: &mut Types<'_>,
    old: Handle<Expression>,
) -> Result<(Handle<Expression>, Handle<Type>), Error> {
    let (own, ty) = match &types.from.global_expressions[old] {
        &Expression::Literal(literal) => (Expression::Literal(literal), insert(to, None, literal.ty_inner())),
        &Expression::Constant(constant) => {
            return constant_value(to, types, types.from.constants[constant].init);
        }
        &Expression::ZeroValue(ty) => {
            let ty = types.copy(to, ty, None)?;
            (Expression::ZeroValue(ty), ty)
        }
        Expression::Compose { ty, components } => {
            let ty = types.copy(to, *ty, None)?;
            let components = components
                .iter()
                .map(|&own| Ok(constant_value(to, types, own)?.0));
            let components = components.collect::<Result<_, Error>>()?;
            (Expression::Compose { ty, components }, ty)
        }
        other => return Err(Error(format!("functions take no constant {other:?}"))),
    };
    Ok((to.global_expressions.append(own, Span::UNDEFINED), ty))
}
