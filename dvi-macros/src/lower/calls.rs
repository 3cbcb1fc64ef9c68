//! Functions: methods of numbers, and the user's own.

use syn::token::Dot;
use syn::{Expr as Syntax, ExprCall, ExprMethodCall, Ident};

use super::admit::LARGEST_EXPONENT;
use super::habits::{as_receiver, meant};
use super::sums::signed_literal;
use super::{Binding, Lowering, Value, all};
use crate::errors::{here, nearest, text};
use crate::internal::internal;
use crate::model::Shape;
use crate::symbolic::{Expr, Partial, Relation, Unary};
use crate::syntax::{elements, ident};
use crate::words::{AREA, Method, SUMS, VELOCITIES, VectorMethod, callable, is_method};

impl Lowering<'_> {
    pub(super) fn method(&mut self, call: &ExprMethodCall) -> Option<Value> {
        let name = call.method.to_string();
        if let Some(turbofish) = &call.turbofish {
            return self.refuse(turbofish, format!("`{name}` takes no types: formulas are real"));
        }
        if self.model.functions.iter().any(|function| function.name == name) {
            return self.refuse(&call.method, format!("a function of your own is called as `{name}(…)`"));
        }
        if matches!(&*call.receiver, Syntax::Path(receiver) if receiver.path.is_ident("self")) {
            let message = format!("what the struct holds is called by its name: write `{name}(…)`");
            return self.refuse(call, message);
        }
        if self.iterated(call) {
            return None;
        }
        let is_velocity = name == "dot" && call.args.is_empty();
        if let Some((method, arity)) = VectorMethod::by_name(&name)
            && !is_velocity
            && !self.is_long_array(&call.receiver)
        {
            if call.args.len() != arity {
                let message = format!("`{name}` takes {}; {}", arguments(arity), here(call.args.len()));
                return self.refuse(&call.method, message);
            }
            let arguments: Vec<&Syntax> = call.args.iter().collect();
            return self.vector_method(method, call, &arguments);
        }
        let Some(method) = Method::by_name(&name) else {
            if let Some(function) = ident(&call.receiver).filter(|function| self.is_scalar_field(function)) {
                let listed = call.args.iter().map(text).collect::<Vec<_>>().join(", ");
                let message = format!(
                    "a function of several variables is called by its name, and derivatives are taken of \
                     it where they are needed: write `{function}({listed})`"
                );
                return self.refuse(&call.method, message);
            }
            if self.model.size(&Syntax::MethodCall(call.clone())).is_some() {
                let size = text(call);
                let message = format!("`{size}` is a size: as a number it is written `{size} as f64`");
                return self.refuse(call, message);
            }
            let arguments: Vec<&Syntax> = call.args.iter().collect();
            let refused = match self.quietly(&call.receiver) {
                Some(vector @ Value::Vector(_)) => self.no_method(call, &vector),
                Some(Value::Number(_)) | None => {
                    self.unknown_function(&call.method, &name, Some(&call.receiver), &arguments)
                }
            };
            for argument in &call.args {
                if !self.is_long_array(argument) {
                    self.value(argument);
                }
            }
            return refused;
        };
        if call.args.len() == method.arity() + 1
            && ident(&call.receiver).is_some_and(|module| !self.is_declared(&module.to_string()))
        {
            let rest: Vec<&Syntax> = call.args.iter().skip(1).collect();
            let written = Self::as_method(&name, call.args.first(), &rest);
            return self.refuse(call, format!("functions are written as methods: `{written}`"));
        }
        if call.args.len() != method.arity() {
            let message = format!("`{name}` takes {}; {}", arguments(method.arity()), here(call.args.len()));
            return self.refuse(&call.method, message);
        }
        let receiver = match self.value(&call.receiver) {
            Some(Value::Number(receiver)) => Some(receiver),
            Some(vector) => return self.no_method(call, &vector),
            None => None,
        };
        if let Method::Arithmetic("powi", _) = method {
            let exponent = self.integer(&call.args[0]);
            let (receiver, exponent) = (receiver?, exponent?);
            let value = self.graph.powi(receiver, exponent);
            return self.admitted(call, value).map(Value::Number);
        }
        let arguments = all(call.args.iter().map(|argument| self.expr(argument)))?;
        let receiver = receiver?;
        if matches!(method, Method::Arithmetic("min" | "max", _)) {
            self.check_at_rest(call, &format!("`{name}`"), &[receiver, arguments[0]])?;
        }
        let value = self.apply(method, receiver, &arguments);
        self.admitted(call, value).map(Value::Number)
    }

    /// The method of `x` and as many `arguments` as it takes.
    fn apply(&mut self, method: Method, x: Expr, arguments: &[Expr]) -> Expr {
        match (method, arguments) {
            (Method::Unary(function), []) => {
                if matches!(function, Unary::Abs | Unary::Signum) {
                    self.note_seam(x, Expr::ZERO);
                }
                self.graph.unary(function, x)
            }
            (Method::Binary(function), [y]) => self.graph.binary(function, x, *y),
            (Method::Arithmetic("mul_add", _), [y, z]) => {
                let product = self.graph.multiply(x, *y);
                self.graph.add(product, *z)
            }
            (Method::Arithmetic("min", _), [y]) => self.smaller(x, *y, (x, *y)),
            (Method::Arithmetic("max", _), [y]) => self.smaller(x, *y, (*y, x)),
            (Method::Arithmetic("to_radians", _), []) => x.scaled(std::f64::consts::PI / 180.0),
            (Method::Arithmetic("to_degrees", _), []) => x.scaled(180.0 / std::f64::consts::PI),
            (Method::Arithmetic("recip", _), []) => self.graph.reciprocal(x),
            (method, arguments) => internal(format!("{method:?} with {} arguments", arguments.len())),
        }
    }

    /// The first of `values` where a ≤ b, the second elsewhere: `a.min(b)` is a where a ≤ b.
    fn smaller(&mut self, a: Expr, b: Expr, values: (Expr, Expr)) -> Expr {
        self.note_seam(a, b);
        self.graph.choose(a, Relation::LessOrEqual, b, values.0, values.1)
    }

    /// A literal exponent.
    fn integer(&mut self, syntax: &Syntax) -> Option<i32> {
        let value = signed_literal(syntax).and_then(|value| i32::try_from(value).ok());
        if value.is_none_or(|value| value.unsigned_abs() > LARGEST_EXPONENT) {
            return self.refuse(
                syntax,
                "`powi` takes a literal integer exponent of moderate size; `powf` takes any expression",
            );
        }
        value
    }

    pub(super) fn call(&mut self, call: &ExprCall) -> Option<Value> {
        let is_factor = match &*call.func {
            Syntax::Lit(_) => true,
            Syntax::Paren(inner) => matches!(&*inner.expr, Syntax::Path(_) | Syntax::Binary(_)),
            _ => false,
        };
        if is_factor {
            let factors = [text(&call.func), call.args.iter().map(text).collect::<Vec<_>>().join(", ")];
            return self.refuse(
                call,
                format!("a product is written with `*`: `{} * ({})`", factors[0], factors[1]),
            );
        }
        let Syntax::Path(path) = &*call.func else {
            return self.refuse(&call.func, "a function is called by its name, as in `x.sin()` or `f(x)`");
        };
        let Some(name) = path.path.get_ident().map(ToString::to_string) else {
            return self.path_call(call, &path.path);
        };
        if let Some(local) = self.local(&name) {
            return self.call_local(&name, &local, call);
        }
        if self.model.functions.iter().any(|function| function.name == name) {
            return self.own_function(&name, call).map(Value::Number);
        }
        if SUMS.contains(&name.as_str()) {
            self.sum(&name, call)
        } else if VELOCITIES.contains(&name.as_str()) {
            self.velocity(&name, call)
        } else if name == AREA && self.model.has_spinors() && !self.is_scalar_field(path.path.get_ident()?) {
            self.area(call)
        } else {
            self.own_function(&name, call).map(Value::Number)
        }
    }

    /// `f64::sin(x)` is `x.sin()`.
    fn path_call(&mut self, call: &ExprCall, path: &syn::Path) -> Option<Value> {
        let segments: Vec<&Ident> = path.segments.iter().map(|segment| &segment.ident).collect();
        match (segments.as_slice(), call.args.first()) {
            ([.., function], receiver) if is_method(&function.to_string()) && *segments[0] != "f64" => {
                let arguments: Vec<&Syntax> = call.args.iter().skip(1).collect();
                let written = Self::as_method(&function.to_string(), receiver, &arguments);
                self.refuse(path, format!("functions are written as methods: `{written}`"))
            }
            ([float, method], Some(receiver)) if *float == "f64" => self.method(&ExprMethodCall {
                attrs: Vec::new(),
                receiver: Box::new(receiver.clone()),
                dot_token: Dot::default(),
                method: (*method).clone(),
                turbofish: None,
                paren_token: call.paren_token,
                args: call.args.iter().skip(1).cloned().collect(),
            }),
            _ => {
                let message = "a function of a formula is declared as `functions(f = [path, derivative, second_derivative])` \
                               and called by its name";
                self.refuse(path, message)
            }
        }
    }

    fn own_function(&mut self, name: &str, call: &ExprCall) -> Option<Expr> {
        let Some(function) = self.model.functions.iter().position(|function| function.name == name) else {
            if let Some(value) = self.scalar_field(name, call) {
                return value;
            }
            let (receiver, arguments) = (call.args.first(), call.args.iter().skip(1).collect::<Vec<_>>());
            let is_vectors = VectorMethod::by_name(name).is_some_and(|(_, arity)| arity == arguments.len());
            let vector = receiver
                .filter(|receiver| is_vectors && matches!(self.quietly(receiver), Some(Value::Vector(_))));
            let written = match vector {
                Some(vector) => {
                    let listed = arguments.iter().map(text).collect::<Vec<_>>().join(", ");
                    format!("{}.{name}({listed})", as_receiver(vector))
                }
                None if is_method(name) => Self::as_method(name, receiver, &arguments),
                None => return self.unknown_function(&call.func, name, receiver, &arguments),
            };
            return self.refuse(&call.func, format!("functions are written as methods: `{written}`"));
        };
        if call.args.len() != 1 {
            return self
                .refuse(&call.func, format!("`{name}` takes one argument; {}", here(call.args.len())));
        }
        let argument = self.expr(&call.args[0])?;
        let value = self.graph.call(function as u32, 0, argument);
        self.admitted(call, value)
    }

    /// A call as it is written; with other arguments if there are too many or too few.
    pub(super) fn as_method(name: &str, receiver: Option<&Syntax>, arguments: &[&Syntax]) -> String {
        let arity = Method::by_name(name).map_or(0, Method::arity);
        match receiver {
            Some(receiver) if arguments.len() == arity => {
                let arguments: Vec<String> = arguments.iter().map(text).collect();
                format!("{}.{name}({})", as_receiver(receiver), arguments.join(", "))
            }
            _ => format!("x.{name}({})", ["a", "b"][..arity.min(2)].join(", ")),
        }
    }

    /// Whether this is a function of several variables: one that is declared, or a field of the struct that
    /// holds no numbers.
    fn is_scalar_field(&self, name: &Ident) -> bool {
        let is_field = self.model.parameters.iter().any(|parameter| {
            *name == parameter.text && matches!(parameter.shape, Shape::Unknown | Shape::Other)
        });
        is_field || self.model.is_declared_scalar_field(&name.to_string())
    }

    /// A function of several variables, if there is one of this name; nothing inside if it is called in a
    /// wrong way.
    fn scalar_field(&mut self, name: &str, call: &ExprCall) -> Option<Option<Expr>> {
        let ident = ident(&call.func).filter(|_| !is_method(name))?;
        if let Some(Shape::Number | Shape::Count | Shape::Array(..)) =
            self.parameter(ident).map(|field| self.shape_of(field))
        {
            return None;
        }
        if let (Some(list), 1, true) =
            (call.args.first().and_then(elements), call.args.len(), self.is_scalar_field(ident))
        {
            let listed = list.iter().map(text).collect::<Vec<_>>().join(", ");
            let message = format!("arguments are written one by one: `{name}({listed})`");
            return Some(self.refuse(&call.args[0], message));
        }
        let arity = call.args.len();
        let field = self.model.scalar_field(ident, arity)?;
        let at = all(call.args.iter().map(|argument| self.expr(argument)));
        let field = match field {
            Ok(_) if arity == 0 => {
                let message = format!("`{name}` takes one argument or more; here are none");
                return Some(self.refuse(call, message));
            }
            Ok(field) => field,
            Err(before) => {
                let message =
                    format!("`{name}` is called with {} elsewhere; {}", arguments(before), here(arity));
                return Some(self.refuse(call, message));
            }
        };
        Some(at.and_then(|at| {
            let value = self.graph.scalar_field(field, Partial::Value, at);
            self.admitted(call, value)
        }))
    }

    fn unknown_function<T>(
        &mut self,
        at: &impl quote::ToTokens,
        name: &str,
        receiver: Option<&Syntax>,
        arguments: &[&Syntax],
    ) -> Option<T> {
        if self.model.lost_functions || self.model.lost_names {
            return None;
        }
        let kind = format!("function {name}");
        if self.calls.are_of(name) {
            return self.refuse(at, format!("`{name}` calls itself: a formula has no recursion"));
        }
        let all = receiver.into_iter().chain(arguments.iter().copied());
        let listed = all.map(text).collect::<Vec<_>>().join(", ");
        if let Some(message) = self.number_called(name, &listed) {
            return self.errors.refuse_once(&kind, at, message);
        }
        if self.stands_behind(at, name) {
            return None;
        }
        if self.model.parameters.iter().any(|parameter| parameter.text == name) {
            let message = format!("what the struct holds is called by its name: write `{name}({listed})`");
            return self.errors.refuse_once(&kind, at, message);
        }
        if let Some(message) = self.call_called(name, receiver, arguments) {
            return self.errors.refuse_once(&kind, at, message);
        }
        let as_number = receiver.filter(|receiver| self.is_index(receiver));
        let as_number: Option<Syntax> = as_number.map(|index| syn::parse_quote!(#index as f64));
        if let Some(meant) = meant(name, as_number.as_ref().or(receiver), arguments) {
            let message = format!("unknown function `{name}`; write `{meant}`");
            return self.errors.refuse_once(&kind, at, message);
        }
        let own: Vec<String> =
            self.model.functions.iter().map(|function| function.name.to_string()).collect();
        let mut known: Vec<&str> = callable().collect();
        known.extend(own.iter().map(String::as_str));
        let is_function = |binding: &Binding| matches!(binding, Binding::Function(_));
        known.extend(self.scope.iter().filter(|(_, b)| is_function(b)).map(|(name, _)| name.as_str()));
        let message = match nearest(name, known) {
            Some(near) => format!("unknown function `{name}`; did you mean `{near}`?"),
            None => format!(
                "unknown function `{name}`; a function of your own is declared with its derivatives: \
                 `functions({name} = [{name}, d{name}, d2{name}])`; one of several numbers, or from a \
                 table, is a field of the struct that implements `ScalarField`"
            ),
        };
        self.errors.refuse_once(&kind, at, message)
    }
}

fn arguments(arity: usize) -> String {
    match arity {
        0 => "no arguments".into(),
        1 => "one argument".into(),
        many => format!("{many} arguments"),
    }
}
