//! The differential of a function of the coordinates, and one-forms that contain one.
//!
//! A one-form is an expression that is linear in the velocities: α·v. With a function F added to it as a
//! gauge it is (α + ∂F/∂q)·v, in which components cancel that neither of the two shows by itself.

use super::derivative::Contribution;
use super::functions::Unary;
use super::graph::{Expr, Fold, Graph, Id, Node};
use super::index::{Atom, Loop};

impl Graph {
    /// (α + ∂F/∂q)·v from α·v and F.
    pub(crate) fn with_differential(&mut self, one_form: Expr, function: Expr) -> Expr {
        let components = self.components(one_form, function);
        let terms: Vec<Expr> = components.into_iter().map(|component| self.term(component)).collect();
        self.sum(&terms)
    }

    /// The components of α + ∂F/∂q that do not vanish, each as the value at a velocity, in loops.
    pub(crate) fn components(&mut self, one_form: Expr, function: Expr) -> Vec<Contribution> {
        let form = self.gradient(one_form, &[]);
        let form = form.into_iter().filter(|part| self.node(part.target).is_velocity());
        let mut parts: Vec<Contribution> = form.collect();
        for part in self.gradient(function, &[]) {
            let target = self.velocity_of(part.target);
            parts.push(Contribution { target, ..part });
        }
        // Their values stay apart until it is known what cancels: of a sum, what rounding has left cannot be
        // told from a term.
        let mut components: Vec<(Contribution, Vec<Expr>)> = Vec::new();
        for part in parts {
            let part = self.with_inner_sums(part);
            let same = |(known, _): &&mut (Contribution, Vec<Expr>)| {
                known.target == part.target && known.loops == part.loops
            };
            match components.iter_mut().find(same) {
                Some((_, values)) => values.push(part.value),
                None => {
                    let values = vec![part.value];
                    components.push((part, values));
                }
            }
        }
        let mut found = Vec::new();
        for (component, values) in components {
            if !self.vanishes(&values) {
                found.push(Contribution { value: self.shorter(&values), ..component });
            }
        }
        found
    }

    /// v·∂f/∂q + ∂f/∂t of a function that stands inside `loops`: its rate of change along a motion. No
    /// velocity in it changes: there is no acceleration.
    pub(crate) fn rate(&mut self, of: Expr, loops: &[Loop]) -> Expr {
        let time = self.intern(Node::Time);
        let mut terms = vec![self.derivative(of, time)];
        for mut part in self.gradient(of, loops) {
            if !self.node(part.target).is_velocity() {
                part.loops = part.loops.into_iter().skip(loops.len()).collect();
                part.target = self.velocity_of(part.target);
                terms.push(self.term(part));
            }
        }
        self.factored_sum(&terms)
    }

    /// Innermost loops that the target does not depend on become sums in the value.
    fn with_inner_sums(&mut self, mut part: Contribution) -> Contribution {
        let needed = self.free(part.target).open;
        while let Some(inner) = part.loops.pop_if(|inner| needed & (1 << inner.depth) == 0) {
            part.value = self.summed(part.value, inner);
        }
        part
    }

    /// The sum of the values as it is or multiplied out, whichever has fewer nodes.
    fn shorter(&mut self, values: &[Expr]) -> Expr {
        let value = self.sum(values);
        let Some(other) = self.multiplied_out(values) else { return value };
        let length = |expr: Expr| if expr.is_zero() { 0 } else { self.reachable([expr.node]).len() };
        if length(other) < length(value) { other } else { value }
    }

    fn term(&mut self, component: Contribution) -> Expr {
        let term = self.multiply(component.value, component.target.into());
        component.loops.into_iter().rev().fold(term, |term, outer| self.summed(term, outer))
    }

    /// The sum over a loop; factors that do not change in it stay outside, where no empty range hides them.
    pub(crate) fn summed(&mut self, term: Expr, outer: Loop) -> Expr {
        let changes = |graph: &Self, id: Id| graph.free(id).open & (1 << outer.depth) != 0;
        let (inside, outside): (Vec<_>, Vec<_>) =
            self.factors(term.node).into_iter().partition(|(factor, _)| changes(self, *factor));
        let [inside, outside] = [inside, outside].map(|factors| {
            let powers: Vec<Expr> =
                factors.into_iter().map(|(factor, exponent)| self.power(factor.into(), exponent)).collect();
            self.product(&powers)
        });
        let sum = self.fold(Fold::Sum, Atom::Open(outer.depth), outer.range, inside);
        self.multiply(outside, sum).scaled(term.scale)
    }

    /// What is positive where these expressions have a value: they take its logarithm or its root, and not
    /// in one branch of a choice only.
    pub(crate) fn positive(&self, roots: impl IntoIterator<Item = Id>) -> Vec<Id> {
        let always = |node: &Node| match node {
            Node::Choose { .. } => Vec::new(),
            node => node.operands(),
        };
        let argument = |id| match self.node(id) {
            Node::Unary(Unary::Ln | Unary::Log2 | Unary::Log10 | Unary::Sqrt, w) => {
                (w.scale > 0.0).then_some(w.node)
            }
            _ => None,
        };
        self.reachable_by(roots, always).into_iter().filter_map(argument).collect()
    }
}
