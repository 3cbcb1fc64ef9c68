//! Functions of the text, and sums over its indices.

use quote::ToTokens;
use syn::{Expr, ExprCall, ExprMethodCall, ExprRange, RangeLimits};

use super::super::functions;
use super::super::jet::Jet;
use super::super::point::{Variable, first_of};
use super::words::{exponent, pattern};
use super::{Binding, Evaluation, Quantity, Value, unknown, written};

impl Evaluation<'_> {
    pub(super) fn method(&mut self, call: &ExprMethodCall) -> Value<Quantity> {
        let name = self.texts.of(call, || call.method.to_string());
        let receiver = self.quantity(&call.receiver)?;
        if let Some(value) = self.vector_method(&name, call, &receiver)? {
            return Ok(value);
        }
        let receiver = receiver.number(&call.receiver);
        let value = self.function(call, &name, receiver, &call.args.iter().collect::<Vec<_>>())?;
        Ok(Quantity::Number(value))
    }

    /// A function of the language by its name.
    fn function<T: ToTokens>(&mut self, call: &T, name: &str, receiver: Jet, rest: &[&Expr]) -> Value<Jet> {
        if name == "powi" {
            let power = receiver.power(exponent(rest[0]));
            // Another order of operations may overflow before it divides.
            self.is_delicate |= power.reciprocal().is_huge();
            return Ok(power);
        }
        let mut arguments = Vec::new();
        for argument in rest {
            arguments.push(self.number(argument)?);
        }
        // These see the sign of a zero, which another order of operations may exchange.
        self.is_delicate |= ["signum", "atan2"].contains(&name) && receiver.value().value == 0.0;
        if ["abs", "signum"].contains(&name) {
            self.note_seam(|| receiver.clone());
        }
        let degree = std::f64::consts::PI / 180.0;
        let value = match (name, arguments.as_slice()) {
            ("recip", []) => receiver.reciprocal(),
            ("to_radians", []) => receiver.scaled(degree),
            ("to_degrees", []) => receiver.scaled(1.0 / degree),
            ("mul_add", [factor, term]) => receiver.times(factor).plus(term),
            ("min" | "max", [other]) => {
                let (a, b) = (receiver.value().value, other.value().value);
                self.is_delicate |= !receiver.value().is_distinct_from(other.value());
                self.note_seam(|| receiver.clone().minus(other.clone()));
                let holds = if name == "min" { a <= b } else { a >= b };
                match (self.side(call, holds), a.is_nan() || b.is_nan()) {
                    // Which of the two is taken differs from what Rust does: such a point is drawn again.
                    (_, true) => receiver.plus(other),
                    (true, false) => receiver,
                    (false, false) => other.clone(),
                }
            }
            (name, []) => functions::unary(name, &receiver).unwrap_or_else(|| unknown(call)),
            (name, [other]) => functions::binary(name, &receiver, other).unwrap_or_else(|| unknown(call)),
            _ => unknown(call),
        };
        Ok(value)
    }

    pub(super) fn call(&mut self, call: &ExprCall) -> Value<Quantity> {
        let number = |jet| Ok(Quantity::Number(jet));
        let name = self.texts.of(call, || written(&call.func));
        if let Some(Binding::Function(closure, sees)) = self.bound(&name) {
            return self.call_function(&closure, sees, &call.args);
        }
        if let Some(function) = self.functions.iter().position(|function| *function == name) {
            let argument = self.number(&call.args[0])?;
            return Ok(Quantity::Number(functions::own(function, &argument)));
        }
        if let Some(field) = self.model.scalar_fields.iter().position(|field| field.text == *name) {
            let at: Result<Vec<Jet>, _> = call.args.iter().map(|argument| self.number(argument)).collect();
            return number(functions::scalar_field(field, &at?));
        }
        match &*name {
            "sum" | "product" | "sum_pairs" | "sum_ordered_pairs" => self.fold(&name, call),
            "d" | "dot" => {
                let of = &call.args[0];
                let Some((name, indices)) = self.place(of)? else { unknown(call) };
                if self.block(&name).is_none() {
                    unknown(call)
                }
                self.at_place(Variable::Velocity, of, &name, &indices)
            }
            "area" => {
                let Some((name, indices)) = self.place(&call.args[0])? else { unknown(call) };
                let Some(first) = self.block(&name) else { unknown(call) };
                number(self.area(first, indices.first().copied().unwrap_or(0))?)
            }
            // `f64::sin(x)` is `x.sin()`.
            _ => match name.strip_prefix("f64::") {
                Some(method) => {
                    let receiver = self.number(&call.args[0])?;
                    number(self.function(
                        call,
                        method,
                        receiver,
                        &call.args.iter().skip(1).collect::<Vec<_>>(),
                    )?)
                }
                None => unknown(call),
            },
        }
    }

    fn fold(&mut self, name: &str, call: &ExprCall) -> Value<Quantity> {
        let (Expr::Range(range), Expr::Closure(closure)) = (&call.args[0], &call.args[1]) else {
            unknown(call)
        };
        let (lower, upper) = self.bounds(range)?;
        let mut total = match name {
            "product" => Quantity::Number(Jet::number(1.0)),
            _ => Quantity::Empty(Jet::empty_sum()),
        };
        let plus = |a: &Jet, b: &Jet| a.clone().plus(b);
        let most = match self.model.written_out(&call.args[0], closure) {
            Some(_) => i64::MAX,
            None => self.point.most_visited,
        };
        for first in first_of(lower..upper, most) {
            let seconds = match name {
                "sum" | "product" => {
                    let term = self.closure(closure, &[first])?;
                    total =
                        if name == "sum" { total.with(&term, plus) } else { total.with(&term, Jet::times) };
                    continue;
                }
                "sum_pairs" => first_of(first + 1..upper, most),
                _ => first_of(lower..upper, most),
            };
            for second in seconds.filter(|second| *second != first) {
                total = total.with(&self.closure(closure, &[first, second])?, plus);
            }
        }
        Ok(total)
    }

    /// The first value of a range, and that behind its last one.
    pub(super) fn bounds(&mut self, range: &ExprRange) -> Value<(i64, i64)> {
        let lower = range.start.as_ref().map_or(Ok(0), |start| self.index(start))?;
        let Some(end) = &range.end else { unknown(range) };
        let upper = self.index(end)?;
        Ok(match range.limits {
            RangeLimits::HalfOpen(_) => (lower, upper),
            RangeLimits::Closed(_) => (lower, upper + 1),
        })
    }

    pub(super) fn closure(&mut self, closure: &syn::ExprClosure, indices: &[i64]) -> Value<Quantity> {
        let outside = self.scope.len();
        for (input, index) in closure.inputs.iter().zip(indices) {
            let name = self.texts.of(input, || pattern(input));
            self.scope.push(name, Binding::Index(*index));
        }
        self.closures += 1;
        let value = self.quantity(&closure.body);
        self.closures -= 1;
        self.scope.truncate(outside);
        value
    }
}
