//! Formulas to graph: the last stage that can fail.
//!
//! A formula is a Rust expression, admitted node by node. Each mistake is reported on the
//! sub-expression at fault; `None` stands for an expression that was reported, and silences everything
//! above it while its siblings are still read.

use std::rc::Rc;

use rustc_hash::{FxHashMap as HashMap, FxHashSet as HashSet};

use syn::visit::Visit;
use syn::{BinOp, Expr as Syntax, Ident, Lit, Pat, UnOp};

use crate::errors::{Errors, listed, nearest};
use crate::model::{Model, Shape};
use crate::symbolic::{Expr, Graph, Id, Index, Loop, Node, Parameter};
use crate::syntax::{Constrained, closure};

mod admit;
mod blocks;
mod calls;
mod components;
mod constraints;
mod habits;
mod inside;
mod integers;
pub(crate) mod lints;
mod local;
mod names;
mod reach;
mod shared;
pub(crate) mod spinors;
mod sums;
mod unsupported;
mod vectors;
mod velocities;

use crate::words;
use local::{Calls, Local};
use shared::Shared;
use vectors::Value;

/// What a formula is for; it decides whether velocities may stand in it and how they are written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Role {
    OneForm,
    Component,
    Hamiltonian,
    Gauge,
    TimeTransform,
    Lagrangian,
    Force,
    Dissipation,
    Constraint(Constrained),
    Momentum,
    Event,
    /// What formulas share, for whichever it is used in.
    Shared,
}

impl Role {
    fn name(self) -> &'static str {
        match self {
            Self::OneForm => "the one-form",
            Self::Component => "a component of the one-form",
            Self::Hamiltonian => "the Hamiltonian",
            Self::Gauge => "the gauge",
            Self::TimeTransform => "the time transformation",
            Self::Lagrangian => "the Lagrangian",
            Self::Force => "a force",
            Self::Dissipation => "the dissipation function",
            Self::Constraint(Constrained::Positions) => "a holonomic constraint",
            Self::Constraint(Constrained::Velocities) => "a nonholonomic constraint",
            Self::Constraint(Constrained::Gaps) => "a gap function",
            Self::Momentum => "a momentum",
            Self::Event => "an event",
            Self::Shared => "a name that formulas share",
        }
    }
}

/// What Rust takes a value for that a `let` names.
#[derive(Clone, Debug)]
enum Written {
    Real,
    Integer,
    /// An integer with a division of integers in it, this one.
    Quotient(Box<syn::ExprBinary>),
}

/// What a name of an inner scope stands for.
#[derive(Clone, Debug)]
enum Binding {
    Value {
        value: Option<Value>,
        written: Written,
    },
    /// An index: its form in the open indices of loops, and the loop that it counts if it is no argument.
    Index {
        form: Index,
        over: Option<Loop>,
    },
    Function(Rc<Local>),
}

pub(crate) struct Lowering<'a> {
    pub(crate) graph: &'a mut Graph,
    pub(crate) model: &'a mut Model,
    pub(crate) errors: &'a mut Errors,
    role: Role,
    /// The names that are open, those that the formulas share first.
    scope: Vec<(String, Binding)>,
    shared: Shared,
    calls: Calls,
    /// The number of sums around.
    loops: u32,
    /// How many indices were tied to loops that may be empty.
    ties: usize,
    depth: u32,
    /// Names that some closure of the formula binds, to recognise an index outside of its sum.
    index_names: HashSet<String>,
    measures: HashMap<Id, admit::Measure>,
    /// Pairs of numbers: where two are equal, a formula of the motion is not smooth.
    pub(crate) seams: Vec<[Expr; 2]>,
}

const DEEPEST: u32 = 400;
const DEEPEST_SUM: u32 = 24;

struct IndexNames(HashSet<String>);

impl<'ast> Visit<'ast> for IndexNames {
    fn visit_expr_closure(&mut self, closure: &'ast syn::ExprClosure) {
        for input in &closure.inputs {
            self.0.extend(bound_name(input));
        }
        syn::visit::visit_expr_closure(self, closure);
    }

    /// The parameters of a function are no indices of a sum.
    fn visit_local(&mut self, local: &'ast syn::Local) {
        if let Some(init) = &local.init {
            self.visit_expr(closure(&init.expr).map_or(&init.expr, |function| &function.body));
        }
    }
}

/// All values if none is missing: each is asked for in any case, and says what is wrong with it.
pub(crate) fn all<T>(values: impl Iterator<Item = Option<T>>) -> Option<Vec<T>> {
    let values: Vec<Option<T>> = values.collect();
    values.into_iter().collect()
}

/// The name in `name`, `name: type` and `_`.
fn bound_name(pattern: &Pat) -> Option<String> {
    match pattern {
        Pat::Ident(name) if name.by_ref.is_none() && name.mutability.is_none() && name.subpat.is_none() => {
            Some(name.ident.to_string())
        }
        Pat::Type(typed) => bound_name(&typed.pat),
        Pat::Wild(_) => Some("_".to_string()),
        _ => None,
    }
}

/// Whether a suffix is that of a number in Rust.
fn is_number_type(suffix: &str) -> bool {
    let digits = suffix.trim_start_matches(['i', 'u', 'f']);
    suffix.len() > digits.len() && (digits == "size" || digits.parse::<u32>().is_ok())
}

impl<'a> Lowering<'a> {
    pub(crate) fn new(graph: &'a mut Graph, model: &'a mut Model, errors: &'a mut Errors) -> Self {
        Self {
            graph,
            model,
            errors,
            role: Role::Hamiltonian,
            scope: Vec::new(),
            shared: Shared::default(),
            calls: Calls::default(),
            loops: 0,
            ties: 0,
            depth: 0,
            index_names: HashSet::default(),
            measures: HashMap::default(),
            seams: Vec::new(),
        }
    }

    pub(crate) fn formula(&mut self, formula: &Syntax, role: Role) -> Option<Expr> {
        self.begin(formula, role);
        let value = self.value(formula)?;
        self.number_of(formula, role, value)
    }

    fn begin(&mut self, formula: &Syntax, role: Role) {
        self.role = role;
        let mut names = IndexNames(HashSet::default());
        names.visit_expr(formula);
        self.index_names = names.0;
    }

    /// An error, and nothing in the place of what it is on.
    fn refuse<T>(&mut self, at: impl quote::ToTokens, message: impl std::fmt::Display) -> Option<T> {
        self.errors.refuse(at, message)
    }

    /// The value of a number.
    fn expr(&mut self, syntax: &Syntax) -> Option<Expr> {
        let value = self.value(syntax)?;
        self.number(syntax, value)
    }

    fn value(&mut self, syntax: &Syntax) -> Option<Value> {
        if self.depth >= DEEPEST {
            return self.too_deep(syntax);
        }
        self.depth += 1;
        let value = self.value_inside(syntax);
        self.depth -= 1;
        let value = value?;
        if value.entries().iter().any(|entry| !entry.scale.is_finite()) {
            return self.refuse(syntax, "the value of this is not a finite number");
        }
        let is_deep = value.entries().iter().any(|entry| self.nesting(*entry) > DEEPEST);
        if is_deep { self.too_deep(syntax) } else { Some(value) }
    }

    fn too_deep(&mut self, syntax: &Syntax) -> Option<Value> {
        let message = format!(
            "more than {DEEPEST} operations stand inside one another here; write a long chain as \
             `sum(0..n, |j| …)`, or declare a part as a function of your own, with its derivatives: \
             `functions(f = [f, df, d2f])`"
        );
        self.errors.refuse_once("depth", syntax, message)
    }

    fn value_inside(&mut self, syntax: &Syntax) -> Option<Value> {
        match syntax {
            Syntax::Lit(literal) => self.literal(&literal.lit).map(Value::Number),
            Syntax::Paren(inner) => self.value(&inner.expr),
            Syntax::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
                self.value(&unary.expr)?.map(|entry| Some(entry.negated()))
            }
            Syntax::Binary(binary) => self.binary(binary),
            Syntax::Path(path) if path.qself.is_none() => self.path(&path.path),
            Syntax::Field(_) => self.field(syntax),
            Syntax::Index(_) => self.indexed(syntax),
            Syntax::Array(list) => self.list(list),
            Syntax::MethodCall(call) => self.method(call),
            Syntax::Call(call) => self.call(call),
            Syntax::Cast(cast) => self.cast(cast).map(Value::Number),
            Syntax::Block(block) => self.statements(&block.block),
            Syntax::If(choice) => self.choice(choice),
            // What stood here was reported.
            Syntax::Verbatim(nothing) if nothing.is_empty() => None,
            other => self.unsupported(other),
        }
    }

    fn literal(&mut self, literal: &Lit) -> Option<Expr> {
        let (digits, suffix) = match literal {
            Lit::Float(value) => (value.base10_digits(), value.suffix()),
            Lit::Int(value) => (value.base10_digits(), value.suffix()),
            Lit::Str(_) => return self.refuse(literal, "a formula is written as it is, without quotes"),
            _ => return self.refuse(literal, "expected a number"),
        };
        if !matches!(suffix, "" | "f64") {
            let message = if is_number_type(suffix) {
                format!("formulas are real: write this number without `{suffix}`")
            } else if let Some(exponent) =
                suffix.strip_prefix(['d', 'D']).filter(|e| e.parse::<i32>().is_ok())
            {
                format!("an exponent of ten is written with `e`: `{digits}e{exponent}`")
            } else {
                format!("a product is written with `*`: `{digits} * {suffix}`")
            };
            return self.refuse(literal, message);
        }
        match digits.parse() {
            Ok(value) => Some(Expr::number(value)),
            Err(_) => self.refuse(literal, "expected a number"),
        }
    }

    fn binary(&mut self, syntax: &syn::ExprBinary) -> Option<Value> {
        let is_dereferenced =
            matches!(&*syntax.right, Syntax::Unary(power) if matches!(power.op, UnOp::Deref(_)));
        if matches!(syntax.op, BinOp::BitXor(_)) || (matches!(syntax.op, BinOp::Mul(_)) && is_dereferenced) {
            return self.not_a_power(syntax);
        }
        let (left, right) = (self.value(&syntax.left), self.value(&syntax.right));
        match syntax.op {
            BinOp::Add(_) | BinOp::Sub(_) => {
                let is_sum = matches!(syntax.op, BinOp::Add(_));
                let joined = if is_sum { "a sum" } else { "a difference" };
                let [left, right] = self.alike((&syntax.left, left?), (&syntax.right, right?), joined)?;
                left.zip(right, |left, right| {
                    self.check_homogeneous((&syntax.left, left), (&syntax.right, right))?;
                    Some(self.graph.add(left, if is_sum { right } else { right.negated() }))
                })
            }
            BinOp::Mul(_) => self.product(syntax, left?, right?),
            BinOp::Div(_) => self.quotient(syntax, left?, right?),
            _ => self.unsupported(&Syntax::Binary(syntax.clone())),
        }
    }

    fn binding_of(&self, name: &str) -> Option<&Binding> {
        self.position_of(name).map(|position| &self.scope[position].1)
    }

    /// The place in the scope of what a name stands for.
    fn position_of(&self, name: &str) -> Option<usize> {
        (0..self.scope.len()).rev().find(|place| self.scope[*place].0 == name && !self.calls.hide(*place))
    }

    fn parameter(&mut self, name: &Ident) -> Option<u32> {
        let position = self.model.parameters.iter().position(|parameter| *name == parameter.text);
        position.map(|position| position as u32)
    }

    fn parameter_node(&mut self, field: u32, indices: Vec<Index>) -> Expr {
        self.graph.intern(Node::Parameter(Parameter { field, indices })).into()
    }

    /// Reports an unknown name once; where declarations were lost, it may be one of them.
    fn unknown_name<T>(&mut self, at: impl quote::ToTokens, name: &str, what: &str) -> Option<T> {
        if self.model.lost_coordinates || self.model.lost_names {
            return None;
        }
        let blocks = &self.model.blocks[..self.model.declared_blocks()];
        let mut declared: Vec<String> = blocks.iter().map(|block| block.name.to_string()).collect();
        let coordinates = declared.len();
        declared.extend(self.model.parameters.iter().map(|parameter| parameter.text.clone()));
        declared.extend(self.model.sizes.iter().map(|size| size.text.clone()));
        declared.extend(self.scope.iter().map(|(name, _)| name.clone()));
        declared.push(words::PI.to_string());
        let called = self.velocity_called(name).or_else(|| self.name_called(name).map(str::to_string));
        let hint = match (called, nearest(name, declared.iter().map(String::as_str))) {
            (Some(written), _) => written,
            (None, Some(near)) => format!("did you mean `{near}`?"),
            (None, None) if name.chars().all(|letter| letter.is_uppercase() || letter == '_') => {
                format!("a constant of your own is written with its path: `self::{name}` or `Self::{name}`")
            }
            (None, None) => format!(
                "a formula may use the coordinates {}, the fields of the struct, constants such as `PI`, and `t`",
                listed(declared.iter().take(coordinates))
            ),
        };
        self.errors.refuse_once(&format!("name {name}"), at, format!("{what} `{name}`; {hint}"))
    }

    fn shape_of(&self, field: u32) -> &Shape {
        &self.model.parameters[field as usize].shape
    }
}
