//! What a `let` of the text binds, in a formula or for all of them: values, pairs of them, and functions.

use syn::punctuated::Punctuated;
use syn::{BinOp, Expr, ExprClosure, Lit, Local, Pat, Token};

use super::super::functions;
use super::words::pattern;
use super::{Binding, Evaluation, Quantity, Shared, Value, place_text, unknown, written};
use crate::syntax::{closure, value};

impl<'a> Evaluation<'a> {
    /// Opens the names that all formulas share.
    pub(super) fn share(&mut self, definitions: &'a [Local]) {
        for definition in definitions {
            let (names, sees) = (&definition.pat, self.scope.len());
            let Some(init) = value(definition) else { unknown(definition) };
            if let Some(closure) = closure(init) {
                self.define(names, closure);
                continue;
            }
            for (part, name) in parts(names).into_iter().enumerate() {
                self.bind(name, Binding::Shared(Shared { names, init, sees, part }));
            }
        }
    }

    /// What a shared name stands for, found where it is first used: it sees the names before it.
    pub(super) fn shared(&mut self, Shared { names, init, sees, part }: Shared<'a>) -> Value<Quantity> {
        let key = (std::ptr::from_ref(init) as usize, [self.is_still, self.moves, self.follows]);
        if let Some(values) = self.known.get(&key) {
            return Ok(values[part].clone());
        }
        let aside = self.scope.set_aside(sees);
        let values = self.values(names, init);
        self.scope.put_back(aside);
        let values = values?;
        let value = values[part].clone();
        self.known.insert(key, values);
        Ok(value)
    }

    pub(super) fn binding(&mut self, names: &Pat, init: &Expr) -> Value<()> {
        if let Some(closure) = closure(init) {
            self.define(names, closure);
            return Ok(());
        }
        let values = self.values(names, init)?;
        for (name, value) in parts(names).into_iter().zip(values) {
            self.bind(name, Binding::Value(value));
        }
        Ok(())
    }

    fn define(&mut self, name: &Pat, closure: &ExprClosure) {
        let (function, sees) = (self.texts.function(closure), self.scope.len());
        self.bind(name, Binding::Function(function, sees));
    }

    /// As many values as there are names.
    fn values(&mut self, names: &Pat, init: &Expr) -> Value<Vec<Quantity>> {
        match (names, init) {
            (_, Expr::Paren(inner)) => self.values(names, &inner.expr),
            (Pat::Tuple(_), Expr::Tuple(values)) => {
                values.elems.iter().map(|value| self.quantity(value)).collect()
            }
            (Pat::Tuple(_), Expr::MethodCall(call)) => {
                let x = self.number(&call.receiver)?;
                let function = |name| functions::unary(name, &x).unwrap_or_else(|| unknown(call));
                Ok(["sin", "cos"].map(|name| Quantity::Number(function(name))).into())
            }
            _ => Ok(vec![self.quantity(init)?]),
        }
    }

    fn bind(&mut self, name: &Pat, binding: Binding<'a>) {
        let name = self.texts.of(name, || pattern(name));
        self.scope.push(name, binding);
    }

    /// The value of a body that sees the first names of the scope, and its parameters.
    pub(super) fn call_function(
        &mut self,
        closure: &ExprClosure,
        sees: usize,
        arguments: &Punctuated<Expr, Token![,]>,
    ) -> Value<Quantity> {
        let mut bindings = Vec::new();
        for argument in arguments {
            bindings.push(self.argument(argument)?);
        }
        let aside = self.scope.set_aside(sees);
        for (input, binding) in closure.inputs.iter().zip(bindings) {
            self.bind(input, binding);
        }
        let value = self.quantity(&closure.body);
        self.scope.truncate(sees);
        self.scope.put_back(aside);
        value
    }

    /// An argument as a number and as an index, as far as it is one.
    fn argument(&mut self, syntax: &Expr) -> Value<Binding<'a>> {
        let index = if self.is_integer(syntax) { Some(self.index(syntax)?) } else { None };
        let number = if self.is_number(syntax) { Some(self.quantity(syntax)?) } else { None };
        Ok(Binding::Argument(number, index))
    }

    fn is_integer(&self, syntax: &Expr) -> bool {
        match syntax {
            Expr::Lit(literal) => matches!(&literal.lit, Lit::Int(_)),
            Expr::Paren(inner) => self.is_integer(&inner.expr),
            Expr::Unary(unary) => self.is_integer(&unary.expr),
            Expr::Binary(binary) => {
                let is_exact = !matches!(binary.op, BinOp::Div(_));
                is_exact && self.is_integer(&binary.left) && self.is_integer(&binary.right)
            }
            Expr::Path(_) | Expr::Field(_) | Expr::MethodCall(_) => {
                let text = self.texts.of(syntax, || place_text(syntax));
                match self.bound(&text) {
                    Some(Binding::Index(_) | Binding::Argument(_, Some(_))) => true,
                    Some(
                        Binding::Value(_)
                        | Binding::Shared(_)
                        | Binding::Argument(_, None)
                        | Binding::Function(..),
                    ) => false,
                    None => self.size(&text).is_some(),
                }
            }
            _ => false,
        }
    }

    /// Whether an expression is a number where it stands: indices and lengths are made ones by `as f64`.
    fn is_number(&self, syntax: &Expr) -> bool {
        match syntax {
            Expr::Paren(inner) => self.is_number(&inner.expr),
            Expr::Unary(unary) => self.is_number(&unary.expr),
            Expr::Binary(binary) => {
                let is_index = matches!(binary.op, BinOp::Rem(_));
                !is_index && self.is_number(&binary.left) && self.is_number(&binary.right)
            }
            Expr::Path(path) => {
                let text = self.texts.of(syntax, || written(path));
                !matches!(self.bound(&text), Some(Binding::Index(_) | Binding::Argument(None, _)))
            }
            Expr::MethodCall(call) => call.method != "len",
            _ => true,
        }
    }
}

/// The names of a pattern.
fn parts(names: &Pat) -> Vec<&Pat> {
    match names {
        Pat::Tuple(list) => list.elems.iter().collect(),
        name => vec![name],
    }
}
