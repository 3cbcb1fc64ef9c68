//! Names that a formula gives to functions and to pairs of values.
//!
//! `let gap = |a, b| …;` is called as `gap(i, j)`. A call is the body with its parameters bound to the
//! arguments: to indices where the body takes a parameter for one, else to values. The body sees the names
//! that stand before the function, and not those around the call.

use std::cell::Cell;
use std::ops::Range;
use std::rc::Rc;

use syn::visit::{self, Visit};
use syn::{Expr as Syntax, ExprCall, ExprClosure, Pat, Stmt};

use super::{Binding, Lowering, Written, bound_name};
use crate::errors::here;
use crate::symbolic::{Expr, Unary};
use crate::words::SUMS;

/// So many calls of functions of their own have the formulas of a system.
const MOST_CALLS: u32 = 10_000;

#[derive(Debug)]
pub(super) struct Local {
    /// The names of the parameters, and whether they are indices.
    parameters: Vec<(String, bool)>,
    body: Syntax,
    /// The length of the scope behind the name of the function.
    sees: usize,
    /// Whether a mistake in the body has been reported.
    is_wrong: Cell<bool>,
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
                    let is_index = self.is_index_in(&closure.body, &parameter);
                    parameters.push((parameter, is_index));
                }
                None => {
                    self.errors.push(input, "a parameter is a name: write `|a, b| …`");
                    is_wrong = true;
                }
            }
        }
        let (body, sees) = ((*closure.body).clone(), self.scope.len() + 1);
        let local = Local { parameters, body, sees, is_wrong: Cell::new(is_wrong) };
        self.scope.push((name, Binding::Function(Rc::new(local))));
    }

    /// Whether a name stands for an index in a formula.
    fn is_index_in(&self, formula: &Syntax, name: &str) -> bool {
        let mut places = Places { lowering: self, name, in_index: false, is_index: false };
        places.visit_expr(formula);
        places.is_index
    }

    pub(super) fn local(&self, name: &str) -> Option<Rc<Local>> {
        match self.binding_of(name)? {
            Binding::Function(local) => Some(local.clone()),
            Binding::Value { .. } | Binding::Index { .. } => None,
        }
    }

    pub(super) fn call_local(&mut self, name: &str, local: &Rc<Local>, call: &ExprCall) -> Option<Expr> {
        if self.calls.open.iter().any(|(open, _)| Rc::ptr_eq(open, local)) {
            self.errors.push(&call.func, format!("`{name}` calls itself: a formula has no recursion"));
            return None;
        }
        if local.is_wrong.get() {
            return None;
        }
        if call.args.len() != local.parameters.len() {
            let takes = match local.parameters.len() {
                1 => "one argument".to_string(),
                many => format!("{many} arguments"),
            };
            self.errors.push(&call.func, format!("`{name}` takes {takes}; {}", here(call.args.len())));
            return None;
        }
        self.calls.count += 1;
        if self.calls.count > MOST_CALLS {
            let message = format!("the functions of these formulas are called more than {MOST_CALLS} times");
            self.errors.push_once("calls", call, message);
            return None;
        }
        let (outside, mut arguments) = (self.scope.len(), Vec::new());
        for ((parameter, is_index), argument) in local.parameters.iter().zip(&call.args) {
            let binding = if *is_index {
                self.index(argument).map(|form| Binding::Index { form, over: None })
            } else {
                let written = self.written(argument);
                self.expr(argument).map(|value| Binding::Value { value: Some(value), written })
            };
            arguments.push(binding.map(|binding| (parameter.clone(), binding)));
        }
        let arguments: Vec<_> = arguments.into_iter().collect::<Option<_>>()?;
        let before = self.errors.count();
        self.scope.extend(arguments);
        self.calls.open.push((local.clone(), local.sees..outside));
        let value = self.expr(&local.body);
        self.calls.open.pop();
        self.scope.truncate(outside);
        local.is_wrong.set(self.errors.count() > before);
        value
    }

    /// `let (s, c) = x.sin_cos();` and `let (a, b) = (…, …);`
    pub(super) fn bind_tuple(&mut self, names: &syn::PatTuple, init: Option<&Syntax>) {
        let values: Option<Vec<(Option<Expr>, Written)>> = match init {
            Some(Syntax::Tuple(list)) if list.elems.len() == names.elems.len() => {
                Some(list.elems.iter().map(|value| (self.expr(value), self.written(value))).collect())
            }
            Some(Syntax::MethodCall(call)) if is_sin_cos(call) && names.elems.len() == 2 => {
                let x = self.expr(&call.receiver);
                let functions = [Unary::Sin, Unary::Cos];
                Some(functions.map(|f| (x.map(|x| self.graph.unary(f, x)), Written::Real)).into())
            }
            _ => None,
        };
        if values.is_none() {
            let message = "several names are bound by `let (s, c) = x.sin_cos();`, or by as many values in \
                           parentheses";
            self.errors.push(names, message);
        }
        let mut values = values.into_iter().flatten();
        for name in &names.elems {
            let (value, written) = values.next().unwrap_or((None, Written::Real));
            match bound_name(name) {
                Some(name) => self.scope.push((name, Binding::Value { value, written })),
                None => self.errors.push(name, "expected a name: write `let (a, b) = (…, …);`"),
            }
        }
    }
}

fn is_sin_cos(call: &syn::ExprMethodCall) -> bool {
    call.method == "sin_cos" && call.args.is_empty()
}

/// Looks for a name where an index stands.
struct Places<'a, 'b> {
    lowering: &'a Lowering<'b>,
    name: &'a str,
    in_index: bool,
    is_index: bool,
}

impl Places<'_, '_> {
    fn visit(&mut self, syntax: &Syntax, in_index: bool) {
        let around = std::mem::replace(&mut self.in_index, in_index);
        self.visit_expr(syntax);
        self.in_index = around;
    }

    fn binds(&self, pattern: &Pat) -> bool {
        match pattern {
            Pat::Tuple(names) => names.elems.iter().any(|name| self.binds(name)),
            name => bound_name(name).is_some_and(|name| name == self.name),
        }
    }
}

impl<'ast> Visit<'ast> for Places<'_, '_> {
    fn visit_expr_path(&mut self, path: &'ast syn::ExprPath) {
        self.is_index |= self.in_index && path.path.is_ident(self.name);
    }

    fn visit_expr_index(&mut self, index: &'ast syn::ExprIndex) {
        self.visit(&index.expr, false);
        self.visit(&index.index, true);
    }

    fn visit_expr_cast(&mut self, cast: &'ast syn::ExprCast) {
        self.visit(&cast.expr, false);
    }

    fn visit_expr_call(&mut self, call: &'ast ExprCall) {
        let name = match &*call.func {
            Syntax::Path(path) => path.path.get_ident().map(ToString::to_string).unwrap_or_default(),
            _ => String::new(),
        };
        let local = self.lowering.local(&name);
        for (place, argument) in call.args.iter().enumerate() {
            let in_index = match &local {
                Some(local) => local.parameters.get(place).is_some_and(|(_, is_index)| *is_index),
                None => place == 0 && SUMS.contains(&name.as_str()),
            };
            self.visit(argument, in_index);
        }
    }

    /// What a name inside hides is another one.
    fn visit_expr_closure(&mut self, closure: &'ast ExprClosure) {
        if !closure.inputs.iter().any(|input| self.binds(input)) {
            self.visit(&closure.body, false);
        }
    }

    fn visit_block(&mut self, block: &'ast syn::Block) {
        for statement in &block.stmts {
            visit::visit_stmt(self, statement);
            if matches!(statement, Stmt::Local(local) if self.binds(&local.pat)) {
                return;
            }
        }
    }
}
