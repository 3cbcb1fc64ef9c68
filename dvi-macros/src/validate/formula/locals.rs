//! What a `let` of the text binds: values, pairs of them, and functions.

use syn::punctuated::Punctuated;
use syn::{BinOp, Expr, ExprClosure, Lit, Pat, Token};

use super::super::functions;
use super::words::pattern;
use super::{Binding, Evaluation, Quantity, Value, place_text, unknown, written};

impl Evaluation<'_> {
    pub(super) fn binding(&mut self, names: &Pat, init: &Expr) -> Value<()> {
        match (names, init) {
            (_, Expr::Paren(inner)) => self.binding(names, &inner.expr),
            (_, Expr::Closure(closure)) => {
                let (function, sees) = (self.texts.function(closure), self.scope.len());
                self.bind(names, Binding::Function(function, sees));
                Ok(())
            }
            (Pat::Tuple(names), Expr::Tuple(values)) => {
                let values: Result<Vec<Quantity>, _> =
                    values.elems.iter().map(|value| self.quantity(value)).collect();
                for (name, value) in names.elems.iter().zip(values?) {
                    self.bind(name, Binding::Value(value));
                }
                Ok(())
            }
            (Pat::Tuple(names), Expr::MethodCall(call)) => {
                let x = self.number(&call.receiver)?;
                for (name, function) in names.elems.iter().zip(["sin", "cos"]) {
                    let value = functions::unary(function, &x).unwrap_or_else(|| unknown(call));
                    self.bind(name, Binding::Value(Quantity::Number(value)));
                }
                Ok(())
            }
            _ => {
                let value = self.quantity(init)?;
                self.bind(names, Binding::Value(value));
                Ok(())
            }
        }
    }

    fn bind(&mut self, name: &Pat, binding: Binding) {
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
    fn argument(&mut self, syntax: &Expr) -> Value<Binding> {
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
                    Some(Binding::Value(_) | Binding::Argument(_, None) | Binding::Function(..)) => false,
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
