//! Runs generated functions.

use std::collections::HashMap;
use std::rc::Rc;

use syn::BinOp;

use super::arithmetic::{cast, integer_method, kind_of, operation};
use super::code::{Code, Function, Pattern, bind};
use super::functions::Callee;
use super::parse::Expansion;
use super::value::{Kind, Nested, Value};

/// What generated functions find around them.
pub(crate) struct Environment {
    /// The fields of the struct.
    pub(crate) fields: HashMap<String, Rc<Nested>>,
    /// The const generics.
    pub(crate) constants: HashMap<String, usize>,
    /// The functions of the user's, by path.
    pub(crate) own: fn(&str, f64) -> f64,
    /// Their functions of several variables, by place, and derivatives along axes.
    pub(crate) scalar_field: fn(&str, &[usize], &[f64]) -> f64,
}

/// Runs the functions of one expansion. What would panic in Rust is an `Err` with its reason.
pub(crate) struct Machine<'a> {
    pub(crate) expansion: &'a Expansion,
    pub(crate) environment: &'a Environment,
    pub(crate) arrays: Vec<Vec<f64>>,
}

/// Why the next step is not the one below.
pub(super) enum Jump {
    Continue,
    Return(Value),
    Panic(String),
}

pub(super) type Step = Result<Value, Jump>;

pub(super) fn panicked(reason: impl Into<String>) -> Jump {
    Jump::Panic(reason.into())
}

impl Machine<'_> {
    /// An array of the caller's, as a value.
    pub(crate) fn array(&mut self, entries: Vec<f64>) -> Value {
        let length = entries.len();
        self.arrays.push(entries);
        Value::View { array: self.arrays.len() - 1, start: 0, length }
    }

    pub(crate) fn call(&mut self, name: &str, arguments: Vec<Value>) -> Result<Value, String> {
        let expansion = self.expansion;
        let function = expansion.functions.get(name).unwrap_or_else(|| panic!("`{name}` is generated"));
        self.function(function, arguments).map_err(|reason| format!("{name} panics: {reason}"))
    }

    fn function(&mut self, function: &Function, mut arguments: Vec<Value>) -> Result<Value, String> {
        assert_eq!(arguments.len(), function.parameters, "the signature of the trait");
        arguments.resize(function.slots, Value::Unit);
        match self.run(&function.body, &mut arguments) {
            Ok(value) | Err(Jump::Return(value)) => Ok(value),
            Err(Jump::Panic(reason)) => Err(reason),
            Err(Jump::Continue) => panic!("`continue` outside of a loop"),
        }
    }

    fn run(&mut self, code: &Code, slots: &mut Vec<Value>) -> Step {
        match code {
            Code::Value(value) => Ok(value.clone()),
            Code::Slot(slot) => Ok(slots[*slot].clone()),
            Code::Named(name) => {
                let value = self.environment.constants.get(name);
                let value = value.unwrap_or_else(|| panic!("the interpreter does not know the name {name}"));
                Ok(Value::Integer(*value as i128, Kind::Usize))
            }
            Code::Field(base, name) => {
                let base = self.run(base, slots)?;
                Ok(self.field(&base, name))
            }
            Code::Index(base, index) => {
                let (base, index) = (self.run(base, slots)?, self.run(index, slots)?);
                self.indexed(&base, &index)
            }
            Code::Negative(of) => match self.run(of, slots)? {
                Value::Real(value) => Ok(Value::Real(-value)),
                Value::Integer(value, kind) if kind != Kind::Usize => Ok(Value::Integer(-value, kind)),
                other => panic!("the interpreter does not negate {other:?}"),
            },
            Code::Not(of) => match self.run(of, slots)? {
                Value::Bool(value) => Ok(Value::Bool(!value)),
                other => panic!("the interpreter does not invert {other:?}"),
            },
            Code::Binary(operator, left, right) => {
                let left = self.run(left, slots)?;
                match (operator, &left) {
                    (BinOp::And(_), Value::Bool(false)) | (BinOp::Or(_), Value::Bool(true)) => Ok(left),
                    (BinOp::And(_) | BinOp::Or(_), Value::Bool(_)) => self.run(right, slots),
                    _ => {
                        let right = self.run(right, slots)?;
                        operation(*operator, left, right)
                    }
                }
            }
            Code::Assign(operator, place, value) => {
                let value = self.run(value, slots)?;
                let value = match operator {
                    Some(operator) => operation(*operator, self.run(place, slots)?, value)?,
                    None => value,
                };
                self.assign(place, value, slots)
            }
            Code::Call(callee, arguments) => {
                let arguments = self.all(arguments, slots)?;
                self.called(callee, arguments)
            }
            Code::Method(receiver, name, arguments) => {
                let receiver = self.run(receiver, slots)?;
                let arguments = self.all(arguments, slots)?;
                self.method(&receiver, name, &arguments)
            }
            Code::Cast(of, kind) => Ok(cast(&self.run(of, slots)?, *kind)),
            Code::Tuple(parts) => Ok(Value::Tuple(self.all(parts, slots)?)),
            Code::Block(steps) => {
                let mut value = Value::Unit;
                for step in steps {
                    value = self.run(step, slots)?;
                }
                Ok(value)
            }
            Code::Let(pattern, value) => {
                let value = self.run(value, slots)?;
                bind(pattern, value, slots);
                Ok(Value::Unit)
            }
            Code::If(condition, then, otherwise) => match self.run(condition, slots)? {
                Value::Bool(true) => self.run(then, slots),
                Value::Bool(false) => {
                    otherwise.as_ref().map_or(Ok(Value::Unit), |otherwise| self.run(otherwise, slots))
                }
                other => panic!("a condition is {other:?}"),
            },
            Code::Match(value, arms) => {
                let Value::Integer(value, _) = self.run(value, slots)? else {
                    panic!("the interpreter matches integers")
                };
                let arm = arms.iter().find(|(known, _)| known.is_none_or(|known| known == value));
                self.run(&arm.expect("a match is exhaustive").1, slots)
            }
            Code::For(pattern, lower, upper, body) => {
                let (lower, upper) = (self.run(lower, slots)?, self.run(upper, slots)?);
                let kind = kind_of(&lower).joined(kind_of(&upper));
                let (lower, upper) = (lower.integer(), upper.integer());
                for index in lower..upper {
                    bind(pattern, Value::Integer(index, kind), slots);
                    match self.run(body, slots) {
                        Ok(_) | Err(Jump::Continue) => {}
                        Err(other) => return Err(other),
                    }
                }
                Ok(Value::Unit)
            }
            Code::Halves(bodies, entries, patterns, row) => {
                let bodies = self.run(bodies, slots)?.integer() as usize;
                let Value::Tuple(entries) = self.run(entries, slots)? else { panic!("a list of entries") };
                self.halves(bodies, &entries, (patterns, row), slots)
            }
            Code::Return(value) => Err(Jump::Return(self.run(value, slots)?)),
            Code::Continue => Err(Jump::Continue),
            Code::Try(value) => match self.run(value, slots)? {
                failure @ Value::Failure(_) => Err(Jump::Return(failure)),
                value => Ok(value),
            },
        }
    }

    fn all(&mut self, codes: &[Code], slots: &mut Vec<Value>) -> Result<Vec<Value>, Jump> {
        codes.iter().map(|code| self.run(code, slots)).collect()
    }

    /// The pairs of each body with those of the first half that come after it, and with those of the second.
    fn halves(
        &mut self,
        bodies: usize,
        entries: &[Value],
        ([of_body, of_range, of_entries], row): (&[Pattern; 3], &Code),
        slots: &mut Vec<Value>,
    ) -> Step {
        let integer = |value: usize| Value::Integer(value as i128, Kind::Usize);
        let part = |entries: &Value, first: usize, length: usize| match entries {
            Value::View { array, start, .. } => Value::View { array: *array, start: start + first, length },
            other => panic!("{other:?} has no entries"),
        };
        for body in 0..bodies {
            for (first, past) in [(0, bodies / 2), (bodies / 2, bodies)] {
                let lower = first.max(body + 1);
                if lower >= past {
                    continue;
                }
                bind(of_body, integer(body), slots);
                bind(of_range, Value::Tuple([lower, past, first].map(integer).into()), slots);
                let of_others = entries.iter().map(|entries| part(entries, first, past - first));
                bind(of_entries, Value::Tuple(of_others.collect()), slots);
                let Value::Tuple(sums) = self.run(row, slots)? else { panic!("a list of sums") };
                for (entries, sum) in entries.iter().zip(sums) {
                    let Value::View { array, start, .. } = entries else {
                        panic!("{entries:?} has no entries")
                    };
                    self.arrays[*array][start + body] += sum.real();
                }
            }
        }
        Ok(Value::Unit)
    }

    fn field(&self, base: &Value, name: &str) -> Value {
        match (base, name) {
            (Value::System, _) => {
                let field = self.environment.fields.get(name);
                Value::Place(field.unwrap_or_else(|| panic!("the struct has no field {name}")).clone())
            }
            (Value::Weights([weight, ..]), "qq")
            | (Value::Weights([_, weight, ..]), "qv")
            | (Value::Weights([_, _, weight, _]), "vq")
            | (Value::Weights([.., weight]), "vv") => Value::Real(*weight),
            (Value::Expansion { place, at, axes }, "value") => {
                Value::Real((self.environment.scalar_field)(place, axes, at))
            }
            (Value::Expansion { .. }, "gradient" | "hessian") => {
                Value::Derivatives(Box::new(base.clone()), if name == "gradient" { 1 } else { 2 })
            }
            _ => panic!("the interpreter does not know the field {name} of {base:?}"),
        }
    }

    fn indexed(&self, base: &Value, index: &Value) -> Step {
        let position = index.integer();
        match base {
            Value::View { array, start, length } => match usize::try_from(position) {
                Ok(position) if position < *length => Ok(Value::Real(self.arrays[*array][start + position])),
                _ => Err(panicked(format!("index {position} of a slice of length {length}"))),
            },
            Value::Place(place) => match &**place {
                Nested::List(entries) => {
                    let entry = usize::try_from(position).ok().and_then(|position| entries.get(position));
                    let reason =
                        || panicked(format!("index {position} of a field of length {}", entries.len()));
                    Ok(Value::Place(entry.ok_or_else(reason)?.clone()))
                }
                other => panic!("the interpreter does not index {other:?}"),
            },
            Value::Derivatives(of, left) => {
                let Value::Expansion { place, at, axes } = &**of else { panic!("derivatives of {of:?}") };
                let axis = usize::try_from(position).expect("an axis");
                let axes: Vec<usize> = axes.iter().copied().chain([axis]).collect();
                if *left == 1 {
                    return Ok(Value::Real((self.environment.scalar_field)(place, &axes, at)));
                }
                let inside = Value::Expansion { place: place.clone(), at: at.clone(), axes };
                Ok(Value::Derivatives(Box::new(inside), left - 1))
            }
            other => panic!("the interpreter does not index {other:?}"),
        }
    }

    fn assign(&mut self, place: &Code, value: Value, slots: &mut Vec<Value>) -> Step {
        match place {
            Code::Slot(slot) => slots[*slot] = value,
            Code::Index(base, index) => {
                let (base, index) = (self.run(base, slots)?, self.run(index, slots)?);
                let Value::Real(value) = value else { panic!("the interpreter assigns numbers") };
                self.assign_entry(&base, &index, value)?;
            }
            other => panic!("the interpreter does not assign to {other:?}"),
        }
        Ok(Value::Unit)
    }

    fn assign_entry(&mut self, base: &Value, index: &Value, value: f64) -> Step {
        self.indexed(base, index)?;
        let Value::View { array, start, .. } = base else {
            panic!("the interpreter assigns to entries of slices")
        };
        self.arrays[*array][start + index.integer() as usize] = value;
        Ok(Value::Unit)
    }

    fn called(&mut self, callee: &Callee, arguments: Vec<Value>) -> Step {
        let real = |n: usize| arguments[n].real();
        let integer = |n: usize| arguments[n].integer();
        match callee {
            Callee::Number => Ok(Value::Real(real(0))),
            Callee::Unary(function) => Ok(Value::Real(function(real(0)))),
            Callee::Binary(function) => Ok(Value::Real(function(real(0), real(1)))),
            Callee::Power => Ok(Value::Real(real(0).powi(i32::try_from(integer(1)).expect("an exponent")))),
            Callee::Choose => {
                let Value::Text(relation) = &arguments[1] else { panic!("a choice compares") };
                let holds = match relation.as_str() {
                    "Less" => real(0) < real(2),
                    "LessOrEqual" => real(0) <= real(2),
                    "Greater" => real(0) > real(2),
                    "GreaterOrEqual" => real(0) >= real(2),
                    other => panic!("the interpreter does not know the relation {other}"),
                };
                Ok(Value::Real(if holds { real(3) } else { real(4) }))
            }
            Callee::Library(name) => self.library(name, &arguments),
            Callee::AddEntry => {
                let Value::View { array, start, length } = arguments[0] else {
                    panic!("a matrix is a slice")
                };
                let (row, column, n) = (integer(1), integer(2), length.isqrt() as i128);
                if !(0..n).contains(&row) || !(0..n).contains(&column) {
                    return Err(panicked(format!("entry ({row}, {column}) of a matrix of {n} rows")));
                }
                self.arrays[array][start + (row * n + column) as usize] += real(3);
                Ok(Value::Unit)
            }
            Callee::Ok => Ok(arguments.into_iter().next().expect("a value")),
            Callee::Generated(name) => {
                let arguments = arguments.into_iter().filter(|value| !matches!(value, Value::System));
                self.call(name, arguments.collect()).map_err(Jump::Panic)
            }
            Callee::Own(name) => {
                let short = name.trim_start_matches("Self::");
                let path = self
                    .expansion
                    .own
                    .get(short)
                    .unwrap_or_else(|| panic!("no function {name} was declared"));
                Ok(Value::Real((self.environment.own)(path, real(0))))
            }
        }
    }

    fn method(&mut self, receiver: &Value, name: &str, arguments: &[Value]) -> Step {
        match (receiver, name) {
            (Value::View { array, start, length }, "split_at" | "split_at_mut") => {
                let at = usize::try_from(arguments[0].integer()).expect("a length");
                if at > *length {
                    return Err(panicked(format!("a slice of length {length} is cut at {at}")));
                }
                Ok(Value::Tuple(vec![
                    Value::View { array: *array, start: *start, length: at },
                    Value::View { array: *array, start: start + at, length: length - at },
                ]))
            }
            (Value::View { array, start, length }, "fill") => {
                self.arrays[*array][*start..start + length].fill(arguments[0].real());
                Ok(Value::Unit)
            }
            // Packs of one: the first of what waits is exchanged for the term.
            (Value::View { array, .. }, "exchange") => {
                let waiting = &mut self.arrays[*array];
                waiting.push(arguments[0].real());
                Ok(Value::Real(waiting.remove(0)))
            }
            (Value::View { array, .. }, "add_to") => {
                for (place, term) in self.arrays[*array].clone().into_iter().enumerate() {
                    let index = Value::Integer(arguments[1].integer() + place as i128, Kind::Usize);
                    let sum = self.indexed(&arguments[0], &index)?.real() + term;
                    self.assign_entry(&arguments[0], &index, sum)?;
                }
                Ok(Value::Unit)
            }
            (Value::View { length, .. }, "len") => Ok(Value::Integer(*length as i128, Kind::Usize)),
            (Value::Place(place), "len") => match &**place {
                Nested::List(entries) => Ok(Value::Integer(entries.len() as i128, Kind::Usize)),
                other => panic!("{other:?} has no length"),
            },
            (Value::System, name) => {
                let place = self.expansion.scalar_fields.get(name);
                let place = place.unwrap_or_else(|| panic!("the system has no method {name}")).clone();
                let Value::Tuple(at) = &arguments[0] else {
                    panic!("a function of several variables has a point")
                };
                Ok(Value::Expansion { place, at: at.iter().map(Value::real).collect(), axes: Vec::new() })
            }
            (Value::Integer(..) | Value::Place(_), _) => {
                let (kind, value) = (kind_of(receiver), receiver.integer());
                let other = arguments.first().map(Value::integer);
                Ok(Value::Integer(integer_method(name, kind, value, other)?, kind))
            }
            _ => panic!("the interpreter does not know the method `{name}` of {receiver:?}"),
        }
    }
}
