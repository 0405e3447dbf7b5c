//! Copies a kernel's function into one without invocations, and folds the values that this fixes.

use naga::{
    BinaryOperator, Block, Constant, Expression, Function, FunctionArgument, FunctionResult, GlobalVariable,
    Handle, Literal, LocalVariable, Module, Range, Span, Statement, SwitchCase, Type,
};
use std::collections::HashMap;

use super::types::{Types, insert};
use crate::Error;

/// The role of a kernel's global variable in a function.
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

/// The value or place of an expression, if the translation fixes it.
#[derive(Clone, Copy)]
enum Known {
    /// A part of a global variable of this role: the number of accesses that lead to it.
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
    /// The local variable that it returns.
    pub result: Option<Handle<LocalVariable>>,
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
            result: None,
        }
    }

    pub(super) fn local(&mut self, name: &str, ty: Handle<Type>) -> Handle<LocalVariable> {
        let own = LocalVariable {
            name: Some(name.to_owned()),
            ty,
            init: None,
        };
        self.out.local_variables.append(own, Span::UNDEFINED)
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
            let (own, ty) = self.constant(init)?;
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
        self.out.body.extend_block(body);
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

    pub(super) fn append(&mut self, expression: Expression) -> Handle<Expression> {
        self.out.expressions.append(expression, Span::UNDEFINED)
    }

    pub(super) fn push(&mut self, statement: Statement) {
        self.out.body.push(statement, Span::UNDEFINED);
    }

    /// Statements that compute all expressions from the place `before` on.
    pub(super) fn emitted_since(&self, before: usize) -> Vec<Statement> {
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

    /// A constant of a copied value, and its type.
    fn constant(&mut self, init: Handle<Expression>) -> Result<(Handle<Constant>, Handle<Type>), Error> {
        let (init, ty) = constant_value(self.to, self.types, init)?;
        let own = Constant { name: None, ty, init };
        Ok((self.to.constants.append(own, Span::UNDEFINED), ty))
    }

    /// An expression over copies.
    fn translated(&mut self, expression: &Expression) -> Result<Expression, Error> {
        let mut out = expression.clone();
        match &mut out {
            Expression::Literal(_) | Expression::FunctionArgument(_) => {}
            Expression::Constant(constant) => {
                (*constant, _) = self.constant(self.types.from.constants[*constant].init)?;
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
            out.extend_block(statements);
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
                _ => Statement::If {
                    condition: self.at(*condition)?,
                    accept: self.block(accept)?,
                    reject: self.block(reject)?,
                },
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
}

/// The copy of a constant expression, and its type.
fn constant_value(
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
