//! Names that all formulas of a system share: `let = { let r2 = x * x + y * y; let gap = |a, b| …; }`.
//!
//! Each is read once, before the formulas, and sees the names before it, but no index of a formula. What is
//! read may hold velocities. Whether a formula may is asked where it uses the name: there is the mistake, and
//! where it does not use the name it is none.

use quote::ToTokens;
use syn::Ident;

use super::{Lowering, Role, Value};
use crate::syntax::{Attribute, bound, closure, value};
use crate::words::{self, VELOCITIES};

impl Lowering<'_> {
    /// Reads the definitions, for all formulas that follow.
    pub(crate) fn share(&mut self, attribute: &Attribute) {
        let [of_one_form, of_lagrangian] = VELOCITIES;
        self.shared.velocity = if attribute.one_form.is_some() { of_one_form } else { of_lagrangian };
        let names: Vec<Vec<&Ident>> = attribute.shared.iter().map(|local| bound(&local.pat)).collect();
        self.shared.names = names.iter().flatten().map(|name| name.to_string()).collect();
        let mut before = Vec::new();
        for (local, names) in attribute.shared.iter().zip(names) {
            let (Some(value), true) = (value(local), self.are_free(&names, &mut before)) else { continue };
            self.begin(closure(value).map_or(value, |function| &function.body), Role::Shared);
            self.binding(local);
        }
        self.shared.count = self.scope.len();
    }

    /// Reports names that formulas have for something else, or that stand `before`.
    fn are_free<'b>(&mut self, names: &[&'b Ident], before: &mut Vec<&'b Ident>) -> bool {
        let mut are_free = true;
        for name in names {
            let other = if before.contains(name) {
                Some("the name of another definition")
            } else {
                self.meaning(&name.to_string())
            };
            if let Some(other) = other {
                let message = format!("`{name}` is {other} in all formulas: give this one another name");
                self.errors.push(name, message);
                are_free = false;
            }
            before.push(name);
        }
        are_free
    }

    /// What formulas have a name for, if they do.
    fn meaning(&mut self, name: &str) -> Option<&'static str> {
        let model = &mut *self.model;
        let is_function = model.functions.iter().any(|function| function.name == name);
        Some(if model.blocks.iter().any(|block| block.name == name) {
            "a coordinate"
        } else if model.parameters.iter().any(|parameter| parameter.text == name) {
            "a field of the struct"
        } else if model.named_size(name).is_some() {
            "a size"
        } else if is_function || model.is_declared_scalar_field(name) {
            "a function of the system"
        } else if name == words::TIME {
            "the time"
        } else if name == words::PI || words::reserved().any(|word| word == name) {
            "a word of the language"
        } else {
            return None;
        })
    }

    /// The value of a name, or of a call of it, where a formula uses it.
    pub(super) fn used(&mut self, at: &impl ToTokens, name: &str, value: Value) -> Option<Value> {
        if value.entries().iter().any(|entry| self.degree(*entry) > 0)
            && let Err(reason) = self.velocity_word()
        {
            let message =
                format!("velocities stand in `{name}`, which `let = {{ … }}` defines, and {reason}");
            return self.refuse(at, message);
        }
        value.map(|entry| self.admitted(at, entry))
    }

    /// Whether all formulas share the name at a position of the scope, and this is one of them.
    pub(super) fn is_shared(&self, position: usize) -> bool {
        self.role != Role::Shared && position < self.shared.count
    }

    /// Whether a name that is not seen here stands further behind, which is reported. What formulas have for
    /// something else was refused where it is defined.
    pub(super) fn stands_behind(&mut self, at: &impl ToTokens, name: &str) -> bool {
        let is_behind = self.scope.iter().any(|(known, _)| known == name)
            || self.shared.names.iter().any(|known| known == name);
        if is_behind && self.meaning(name).is_none() {
            let message = format!("a definition sees the names before it: `{name}` stands behind this one");
            self.errors.push(at, message);
        }
        is_behind
    }
}

/// The names that formulas share.
#[derive(Default)]
pub(super) struct Shared {
    names: Vec<String>,
    /// So many names of the scope are theirs.
    count: usize,
    /// How velocities are written in them.
    pub(super) velocity: &'static str,
}
