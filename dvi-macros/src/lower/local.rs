//! Names that a formula gives to functions and to pairs of values.
//!
//! `let gap = |a, b| …;` is called as `gap(i, j)`. A call is the body with its parameters bound to the
//! arguments: to indices where the body takes a parameter for one, to values where it takes it for one, and
//! to what the argument is where it does neither. The body sees the names that stand before the function, and
//! not those around the call.

use std::cell::Cell;
use std::ops::Range;
use std::rc::Rc;

use syn::visit::{self, Visit};
use syn::{Expr as Syntax, ExprCall, ExprClosure, Pat, Stmt};

use super::{Binding, Lowering, Role, Value, Written, bound_name};
use crate::errors::{Errors, here};
use crate::symbolic::Unary;
use crate::syntax::{bound, closure, ident};
use crate::words::SUMS;

/// So many calls of functions of their own have the formulas of a system.
const MOST_CALLS: u32 = 10_000;

#[derive(Debug)]
pub(super) struct Local {
    name: String,
    parameters: Vec<(String, Use)>,
    body: Syntax,
    /// The length of the scope before the function.
    sees: usize,
    /// Whether a mistake in the body has been reported.
    is_wrong: Cell<bool>,
}

/// What a body takes a parameter for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Use {
    index: bool,
    /// Elsewhere than in `a as f64` and `(a + 1) as f64`.
    number: bool,
}

/// The functions that are being called, and the names around each call that its body does not see.
#[derive(Default)]
pub(super) struct Calls {
    open: Vec<(Rc<Local>, Range<usize>)>,
    count: u32,
}

impl Calls {
    pub(super) fn hide(&self, position: usize) -> bool {
        self.open.iter().any(|(_, hidden)| hidden.contains(&position))
    }

    /// Counts a call of a function, or a term of a sum over components, and reports those that are too many.
    pub(super) fn counted(&mut self, call: &ExprCall, errors: &mut Errors) -> Option<()> {
        self.count += 1;
        if self.count > MOST_CALLS {
            let message = format!(
                "the functions of these formulas are called more than {MOST_CALLS} times, terms of sums \
                 over components included"
            );
            errors.push_once("calls", call, message);
            return None;
        }
        Some(())
    }

    /// Whether a function of this name is being called.
    pub(super) fn are_of(&self, name: &str) -> bool {
        self.open.iter().any(|(local, _)| local.name == name)
    }
}

impl Lowering<'_> {
    /// `let name = |a, b| body;`
    pub(super) fn define(&mut self, pattern: &Pat, closure: &ExprClosure) {
        let Some(name) = bound_name(pattern) else {
            self.errors.push(pattern, "a function has a name: write `let f = |a, b| …;`");
            return;
        };
        let (mut parameters, mut is_wrong) = (Vec::new(), false);
        for input in &closure.inputs {
            match bound_name(input) {
                Some(parameter) => {
                    if parameter != "_" && parameters.iter().any(|(known, _)| *known == parameter) {
                        self.errors.push(input, "two parameters have this name");
                        is_wrong = true;
                    }
                    let used = Places::of(self, &[], &parameter, &closure.body);
                    parameters.push((parameter, used));
                }
                None => {
                    self.errors.push(input, "a parameter is a name: write `|a, b| …`");
                    is_wrong = true;
                }
            }
        }
        let (body, sees) = ((*closure.body).clone(), self.scope.len());
        let local = Local { name: name.clone(), parameters, body, sees, is_wrong: Cell::new(is_wrong) };
        self.scope.push((name, Binding::Function(Rc::new(local))));
    }

    pub(super) fn local(&self, name: &str) -> Option<Rc<Local>> {
        match self.binding_of(name)? {
            Binding::Function(local) => Some(local.clone()),
            Binding::Value { .. } | Binding::Index { .. } => None,
        }
    }

    pub(super) fn call_local(&mut self, name: &str, local: &Rc<Local>, call: &ExprCall) -> Option<Value> {
        if local.is_wrong.get() {
            return None;
        }
        if call.args.len() != local.parameters.len() {
            let takes = match local.parameters.len() {
                1 => "one argument".to_string(),
                many => format!("{many} arguments"),
            };
            return self.refuse(&call.func, format!("`{name}` takes {takes}; {}", here(call.args.len())));
        }
        self.calls.counted(call, self.errors)?;
        let (outside, mut arguments) = (self.scope.len(), Vec::new());
        for ((parameter, used), argument) in local.parameters.iter().zip(&call.args) {
            let binding = if used.index || (!used.number && self.is_index(argument)) {
                self.index(argument).map(|form| Binding::Index { form, over: None })
            } else {
                let written = self.written(argument);
                self.value(argument).map(|value| Binding::Value { value: Some(value), written })
            };
            arguments.push(binding.map(|binding| (parameter.clone(), binding)));
        }
        let arguments: Vec<_> = arguments.into_iter().collect::<Option<_>>()?;
        let before = self.errors.count();
        self.scope.extend(arguments);
        self.calls.open.push((local.clone(), local.sees..outside));
        let (is_shared, role) = (self.is_shared(local.sees), self.role);
        if is_shared {
            self.role = Role::Shared;
        }
        let value = self.value(&local.body);
        self.role = role;
        self.calls.open.pop();
        self.scope.truncate(outside);
        local.is_wrong.set(self.errors.count() > before);
        if is_shared { self.used(call, name, value?) } else { value }
    }

    /// `let (s, c) = x.sin_cos();` and `let (a, b) = (…, …);`
    pub(super) fn bind_tuple(&mut self, names: &syn::PatTuple, init: Option<&Syntax>) {
        let values: Option<Vec<(Option<Value>, Written)>> = match init {
            Some(Syntax::Tuple(list)) if list.elems.len() == names.elems.len() => {
                Some(list.elems.iter().map(|value| (self.value(value), self.written(value))).collect())
            }
            Some(Syntax::MethodCall(call)) if is_sin_cos(call) && names.elems.len() == 2 => {
                let x = self.expr(&call.receiver);
                let functions = [Unary::Sin, Unary::Cos];
                Some(functions.map(|f| (x.map(|x| self.graph.unary(f, x).into()), Written::Real)).into())
            }
            _ => None,
        };
        if values.is_none() {
            let message = "several names are bound by `let (s, c) = x.sin_cos();`, or by as many values in \
                           parentheses";
            self.errors.push(names, message);
        }
        let mut values = values.into_iter().flatten();
        let mut before = Vec::new();
        for pattern in &names.elems {
            let (value, written) = values.next().unwrap_or((None, Written::Real));
            match bound_name(pattern) {
                Some(name) if name != "_" && before.contains(&name) => {
                    self.errors.push(pattern, "two values have this name");
                }
                Some(name) => {
                    before.push(name.clone());
                    self.scope.push((name, Binding::Value { value, written }));
                }
                None => self.errors.push(pattern, "expected a name: write `let (a, b) = (…, …);`"),
            }
        }
    }
}

fn is_sin_cos(call: &syn::ExprMethodCall) -> bool {
    call.method == "sin_cos" && call.args.is_empty()
}

/// Looks for what a name is taken for.
struct Places<'a, 'b> {
    lowering: &'a Lowering<'b>,
    /// The functions inside of the body, with what they take their parameters for.
    inside: Vec<(String, Vec<Use>)>,
    name: &'a str,
    in_index: bool,
    used: Use,
}

impl<'a, 'b> Places<'a, 'b> {
    fn of(lowering: &'a Lowering<'b>, inside: &[(String, Vec<Use>)], name: &'a str, body: &Syntax) -> Use {
        let mut places =
            Places { lowering, inside: inside.to_vec(), name, in_index: false, used: Use::default() };
        places.visit_expr(body);
        places.used
    }

    fn visit(&mut self, syntax: &Syntax, in_index: bool) {
        let around = std::mem::replace(&mut self.in_index, in_index);
        self.visit_expr(syntax);
        self.in_index = around;
    }

    fn binds(&self, pattern: &Pat) -> bool {
        bound(pattern).into_iter().any(|name| name == self.name)
    }

    /// What a function takes its parameters for, if there is one of this name.
    fn uses(&self, function: &str) -> Option<Vec<Use>> {
        let inside = self.inside.iter().rev().find(|(name, _)| name == function);
        inside.map(|(_, uses)| uses.clone()).or_else(|| {
            let local = self.lowering.local(function)?;
            Some(local.parameters.iter().map(|(_, used)| *used).collect())
        })
    }

    /// Takes down what a function of the body takes its parameters for.
    fn define(&mut self, pattern: &Pat, closure: &ExprClosure) {
        let Some(function) = bound_name(pattern) else { return };
        let names = closure.inputs.iter().map(|input| bound_name(input).unwrap_or_default());
        let uses = names.map(|name| Places::of(self.lowering, &self.inside, &name, &closure.body)).collect();
        self.inside.push((function, uses));
    }
}

impl<'ast> Visit<'ast> for Places<'_, '_> {
    fn visit_expr_path(&mut self, path: &'ast syn::ExprPath) {
        if path.path.is_ident(self.name) {
            self.used.index |= self.in_index;
            self.used.number |= !self.in_index;
        }
    }

    fn visit_expr_index(&mut self, index: &'ast syn::ExprIndex) {
        self.visit(&index.expr, false);
        self.visit(&index.index, true);
    }

    fn visit_expr_cast(&mut self, cast: &'ast syn::ExprCast) {
        if !is_arithmetic(&cast.expr) {
            self.visit(&cast.expr, false);
        }
    }

    fn visit_expr_call(&mut self, call: &'ast ExprCall) {
        let name = ident(&call.func).map(ToString::to_string).unwrap_or_default();
        let uses = self.uses(&name);
        for (place, argument) in call.args.iter().enumerate() {
            match uses.as_ref().and_then(|uses| uses.get(place)) {
                // What is nothing in particular there is nothing in particular here.
                Some(used) if *used == Use::default() && is_arithmetic(argument) => {}
                Some(used) => self.visit(argument, used.index),
                None => self.visit(argument, place == 0 && SUMS.contains(&name.as_str())),
            }
        }
    }

    /// What a name inside hides is another one.
    fn visit_expr_closure(&mut self, closure: &'ast ExprClosure) {
        if !closure.inputs.iter().any(|input| self.binds(input)) {
            self.visit(&closure.body, false);
        }
    }

    fn visit_block(&mut self, block: &'ast syn::Block) {
        let outside = self.inside.len();
        for statement in &block.stmts {
            visit::visit_stmt(self, statement);
            let Stmt::Local(local) = statement else { continue };
            if let Some(closure) = local.init.as_ref().and_then(|init| closure(&init.expr)) {
                self.define(&local.pat, closure);
            }
            if self.binds(&local.pat) {
                break;
            }
        }
        self.inside.truncate(outside);
    }
}

/// Whether it is made of names, lengths and literals alone, so that it is an index where these are.
fn is_arithmetic(syntax: &Syntax) -> bool {
    match syntax {
        Syntax::Paren(inner) => is_arithmetic(&inner.expr),
        Syntax::Unary(unary) => is_arithmetic(&unary.expr),
        Syntax::Binary(binary) => is_arithmetic(&binary.left) && is_arithmetic(&binary.right),
        Syntax::Path(_) | Syntax::Lit(_) => true,
        Syntax::MethodCall(call) => call.method == "len",
        _ => false,
    }
}
