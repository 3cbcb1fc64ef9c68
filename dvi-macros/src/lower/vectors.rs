//! Values of formulas: numbers, and vectors of so many of them.
//!
//! A vector is its components: each operation on vectors is that on the components, defined here once.

use syn::{Expr as Syntax, ExprMethodCall};

use super::habits::as_receiver;
use super::{Lowering, Role, all};
use crate::errors::text;
use crate::model::{COMPONENTS, Shape};
use crate::symbolic::{Expr, Unary};
use crate::syntax::ident;
use crate::words::VectorMethod;

/// What an expression stands for.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value {
    Number(Expr),
    Vector(Vec<Expr>),
}

impl From<Expr> for Value {
    fn from(number: Expr) -> Self {
        Self::Number(number)
    }
}

impl Value {
    /// The number, or the components.
    pub(super) fn entries(&self) -> &[Expr] {
        match self {
            Self::Number(value) => std::slice::from_ref(value),
            Self::Vector(components) => components,
        }
    }

    pub(super) fn map(self, mut f: impl FnMut(Expr) -> Option<Expr>) -> Option<Self> {
        match self {
            Self::Number(value) => f(value).map(Self::Number),
            Self::Vector(components) => {
                components.into_iter().map(f).collect::<Option<_>>().map(Self::Vector)
            }
        }
    }

    /// `f` of the entries of both, which are alike.
    pub(super) fn zip(self, other: Self, mut f: impl FnMut(Expr, Expr) -> Option<Expr>) -> Option<Self> {
        let mut others = other.entries().iter();
        self.map(|entry| f(entry, *others.next()?))
    }

    /// `a number`, or `a vector of 3 components`.
    fn kind(&self) -> String {
        match self {
            Self::Number(_) => "a number".to_string(),
            Self::Vector(components) => format!("a vector of {} components", components.len()),
        }
    }
}

/// An expression in front of a method or an index, unless it is long.
fn name_of(syntax: &Syntax) -> String {
    let text = as_receiver(syntax);
    if text.chars().count() > 24 { "(…)".to_string() } else { text }
}

impl Lowering<'_> {
    /// The value at `at` where a number is expected.
    pub(super) fn number(&mut self, at: &Syntax, value: Value) -> Option<Expr> {
        if let Value::Number(value) = value {
            return Some(value);
        }
        let (kind, name) = (value.kind(), name_of(at));
        let message = format!(
            "this is {kind}, where a number is expected: write a component, as `{name}[0]`, `{name}.norm()` or \
             `{name}.norm_squared()`"
        );
        self.refuse(at, message)
    }

    /// The number that a formula is.
    pub(super) fn number_of(&mut self, formula: &Syntax, role: Role, value: Value) -> Option<Expr> {
        if let Value::Number(value) = value {
            return Some(value);
        }
        let message = format!(
            "{} is a number, and this is {}: write one that is made of it, as `{2}.norm_squared()` or `{2}[0]`",
            role.name(),
            value.kind(),
            name_of(formula)
        );
        self.refuse(formula, message)
    }

    /// The values of two expressions that are to be of one kind: `joined`, as in "a sum".
    pub(super) fn alike(
        &mut self,
        (left, a): (&Syntax, Value),
        (right, b): (&Syntax, Value),
        joined: &str,
    ) -> Option<[Value; 2]> {
        if a.entries().len() == b.entries().len()
            && matches!(a, Value::Number(_)) == matches!(b, Value::Number(_))
        {
            return Some([a, b]);
        }
        let (at, vector) = if matches!(a, Value::Number(_)) { (left, right) } else { (right, left) };
        let advice = match (&a, &b) {
            (Value::Vector(_), Value::Vector(_)) => "both need the same number of components".to_string(),
            _ => format!(
                "write a component of the vector, as `{0}[0]`, or a number that is made of it, as `{0}.norm()`",
                name_of(vector)
            ),
        };
        self.refuse(at, format!("{joined} of {} and {}: {advice}", a.kind(), b.kind()))
    }

    /// a b, where one of them may be a vector.
    pub(super) fn product(&mut self, syntax: &syn::ExprBinary, left: Value, right: Value) -> Option<Value> {
        if let (Value::Number(a), Value::Number(b)) = (&left, &right) {
            self.check_strength(*a, (&syntax.right, *b))?;
            self.check_strength(*b, (&syntax.left, *a))?;
        }
        let (vector, factor) = match (left, right) {
            (Value::Number(factor), other) | (other, Value::Number(factor)) => (other, factor),
            (Value::Vector(left), Value::Vector(_)) => {
                let (a, b) = (name_of(&syntax.left), text(&syntax.right));
                let cross = format!(", and `{a}.cross({b})` where a vector is");
                let cross = if left.len() == 3 { &cross[..] } else { "" };
                let message = format!(
                    "a product of two vectors is written `{a}.dot({b})` where a number is meant{cross}"
                );
                return self.refuse(syntax, message);
            }
        };
        vector.map(|component| {
            let value = self.graph.multiply(component, factor);
            self.admitted(syntax, value)
        })
    }

    /// a / b for a number b.
    pub(super) fn quotient(&mut self, syntax: &syn::ExprBinary, left: Value, right: Value) -> Option<Value> {
        let Value::Number(right) = right else {
            let name = name_of(&syntax.right);
            let message = format!(
                "nothing is divided by {}: write `{name}.norm()` for its length, or divide by a component, as `{name}[0]`",
                right.kind()
            );
            return self.refuse(&syntax.right, message);
        };
        if right.is_zero() {
            return self.refuse(&syntax.right, "division by zero");
        }
        left.map(|left| {
            self.check_strength(left, (&syntax.right, right))?;
            let value = self.graph.divide(left, right);
            self.admitted(syntax, value)
        })
    }

    /// `[a, b, c]`
    pub(super) fn list(&mut self, list: &syn::ExprArray) -> Option<Value> {
        let components = all(list.elems.iter().map(|component| self.expr(component)));
        if !COMPONENTS.contains(&(list.elems.len() as i64)) {
            let message = format!(
                "a list is a vector, which has from {} to {} components",
                COMPONENTS.start(),
                COMPONENTS.end()
            );
            return self.refuse(list, message);
        }
        components.map(Value::Vector)
    }

    /// `v[k]`, where v is no place in an array.
    pub(super) fn component(&mut self, base: &Syntax, indices: &[&Syntax]) -> Option<Value> {
        let value = self.value(base)?;
        self.component_of(value, base, indices)
    }

    /// A component of the value of `base`.
    pub(super) fn component_of(
        &mut self,
        value: Value,
        base: &Syntax,
        indices: &[&Syntax],
    ) -> Option<Value> {
        let Value::Vector(components) = value else {
            let message = match base {
                Syntax::Path(name) => format!("`{}` is a number here: it takes no index", text(name)),
                _ => "only coordinates, fields of the struct and vectors take an index".to_string(),
            };
            return self.refuse(base, message);
        };
        let [index] = indices else {
            return self.refuse(indices[1], "a component of a vector is a number: it takes no index");
        };
        let place = self.axis(index, components.len(), &name_of(base))?;
        Some(components[place].into())
    }

    /// The index of a component, which is known.
    pub(super) fn axis(&mut self, index: &Syntax, count: usize, name: &str) -> Option<usize> {
        let Some(literal) = self.index(index)?.as_literal() else {
            // What was declared may be no vector.
            if !self.model.lost_coordinates {
                let message = format!(
                    "a component has a literal for its index, as in `{name}[0]`, or that of a sum over \
                 literals, as in \
                     `sum(0..{count}, |k| {name}[k])`"
                );
                self.errors.push(index, message);
            }
            return None;
        };
        let place = usize::try_from(literal).ok().filter(|place| *place < count);
        if place.is_none() && !self.model.lost_coordinates {
            let message = format!(
                "index {literal} is out of range: the components of `{name}` are numbered 0 to {}",
                count - 1
            );
            self.errors.push(index, message);
        }
        place
    }

    /// `v.norm()` and its like.
    pub(super) fn vector_method(
        &mut self,
        method: VectorMethod,
        call: &ExprMethodCall,
        arguments: &[&Syntax],
    ) -> Option<Value> {
        let receiver = self.value(&call.receiver);
        let others: Vec<Option<Value>> = arguments.iter().map(|argument| self.value(argument)).collect();
        let Value::Vector(a) = receiver? else {
            let (name, of) = (&call.method, name_of(&call.receiver));
            let advice = match method {
                VectorMethod::Norm => format!("write `{of}.abs()`"),
                VectorMethod::NormSquared => format!("write `{of}.powi(2)`"),
                VectorMethod::Dot | VectorMethod::Cross => "numbers are multiplied by `*`".to_string(),
            };
            return self
                .refuse(&call.receiver, format!("`{name}` is of vectors, and this is a number: {advice}"));
        };
        let value = match (method, others.into_iter().next()) {
            (VectorMethod::Norm, _) => {
                let square = self.sum_of_products(&a, &a);
                self.graph.unary(Unary::Sqrt, square).into()
            }
            (VectorMethod::NormSquared, _) => self.sum_of_products(&a, &a).into(),
            (VectorMethod::Dot | VectorMethod::Cross, other) => {
                let b = self.other(call, arguments, &a, other??)?;
                match method {
                    VectorMethod::Cross => Value::Vector(self.cross(call, &a, &b)?),
                    _ => self.sum_of_products(&a, &b).into(),
                }
            }
        };
        value.map(|entry| self.admitted(call, entry))
    }

    /// The argument of `a.dot(b)` and `a.cross(b)`.
    fn other(
        &mut self,
        call: &ExprMethodCall,
        arguments: &[&Syntax],
        a: &[Expr],
        other: Value,
    ) -> Option<Vec<Expr>> {
        match other {
            Value::Vector(b) if b.len() == a.len() => Some(b),
            other => {
                let (method, count, kind) = (&call.method, a.len(), other.kind());
                let message =
                    format!("`{method}` is of two vectors of {count} components, and this is {kind}");
                self.refuse(arguments[0], message)
            }
        }
    }

    /// As it is written: term after term.
    fn sum_of_products(&mut self, a: &[Expr], b: &[Expr]) -> Expr {
        a.iter().zip(b).fold(Expr::ZERO, |sum, (a, b)| {
            let term = self.graph.multiply(*a, *b);
            self.graph.add(sum, term)
        })
    }

    fn cross(&mut self, call: &ExprMethodCall, a: &[Expr], b: &[Expr]) -> Option<Vec<Expr>> {
        let (&[a0, a1, a2], &[b0, b1, b2]) = (a, b) else {
            let message = if a.len() == 2 {
                let [a, b] = [name_of(&call.receiver), call.args.first().map_or_else(String::new, name_of)];
                format!(
                    "in the plane the cross product is a number: write `{a}[0] * {b}[1] - {a}[1] * {b}[0]`"
                )
            } else {
                format!("the cross product is of vectors in space, and these have {} components", a.len())
            };
            return self.refuse(&call.method, message);
        };
        let mut minor = |a: Expr, b: Expr, c: Expr, d: Expr| {
            let (first, second) = (self.graph.multiply(a, d), self.graph.multiply(b, c));
            self.graph.subtract(first, second)
        };
        Some(vec![minor(a1, a2, b1, b2), minor(a2, a0, b2, b0), minor(a0, a1, b0, b1)])
    }

    /// Reports a method of numbers that is called of a vector.
    pub(super) fn no_method<T>(&mut self, call: &ExprMethodCall, value: &Value) -> Option<T> {
        let (method, name) = (call.method.to_string(), name_of(&call.receiver));
        let lower = method.to_lowercase();
        let is_square = call.args.first().is_some_and(|exponent| text(exponent) == "2");
        let meant = match lower.as_str() {
            "dot" => format!("the velocity of a coordinate is written `dot({})`", text(&call.receiver)),
            "abs" | "length" | "len" | "magnitude" | "mag" | "norm2" => format!("write `{name}.norm()`"),
            "norm_sq" | "normsq" | "norm2_squared" | "length_squared" | "magnitude_squared" | "square" => {
                format!("write `{name}.norm_squared()`")
            }
            "powi" | "powf" | "pow" if is_square => format!("write `{name}.norm_squared()`"),
            "normalize" | "normalized" | "unit" => format!("write `{name} / {name}.norm()`"),
            "inner" | "scalar" => format!("write `{name}.dot(…)`"),
            "add" | "sub" | "mul" | "div" => {
                "vectors are added by `+`, and multiplied with numbers by `*`".to_string()
            }
            _ => format!(
                "of a vector there are `norm`, `norm_squared`, `dot` and `cross`; a component is a number, as `{name}[0]`"
            ),
        };
        self.refuse(&call.method, format!("this is {}, which has no `{method}`: {meant}", value.kind()))
    }

    /// Whether this is an array of numbers that is no vector: sums are taken over it.
    pub(super) fn is_long_array(&self, syntax: &Syntax) -> bool {
        let name = ident(syntax).filter(|name| self.binding_of(&name.to_string()).is_none());
        let Some(name) = name else { return false };
        match self.model.coordinate_of(name) {
            Some(blocks) => {
                let block = &self.model.blocks[blocks.start];
                block.array.is_some() && block.axis.is_none() && self.model.whole(blocks.start).is_none()
            }
            None => self.model.parameters.iter().any(|parameter| {
                *name == parameter.text && matches!(parameter.shape, Shape::Array(None, _))
            }),
        }
    }

    /// The value of what is reported elsewhere, if it is wrong.
    pub(super) fn quietly(&mut self, syntax: &Syntax) -> Option<Value> {
        let said = std::mem::take(self.errors);
        let value = self.value(syntax);
        *self.errors = said;
        value
    }
}
