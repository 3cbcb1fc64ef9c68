//! The formulas of a system as expressions; reports everything that is missing or wrong.

use syn::Expr as Syntax;

use super::Stages;
use crate::lower::{Lowering, Role};
use crate::program::{DegenerateFormulas, RegularFormulas};
use crate::symbolic::{Expr, Graph, Node};
use crate::syntax::Attribute;

impl Stages {
    /// α·v, H and the momenta.
    pub(super) fn degenerate_formulas(&mut self) -> Option<DegenerateFormulas> {
        let clean = self.check_coordinates()?;
        let mut lowering = Lowering::new(&mut self.graph, &mut self.model, &mut self.errors);
        let pair = one_form_and_hamiltonian(&self.attribute, &mut lowering, clean);
        let momenta = momenta(&self.attribute, &mut lowering);
        let (one_form, hamiltonian) = pair?;
        Some(DegenerateFormulas { one_form, hamiltonian, momenta: momenta? })
    }

    /// L and the momenta.
    pub(super) fn regular_formulas(&mut self) -> Option<RegularFormulas> {
        let clean = self.check_coordinates()?;
        let mut lowering = Lowering::new(&mut self.graph, &mut self.model, &mut self.errors);
        let lagrangian = match &self.attribute.lagrangian {
            Some(lagrangian) => lowering.formula(lagrangian, Role::Lagrangian),
            None => {
                if clean {
                    let name = lowering.model.item.ident.clone();
                    lowering.errors.push(&name, "no dynamics: write `lagrangian = …`");
                }
                None
            }
        };
        let momenta = momenta(&self.attribute, &mut lowering);
        let lagrangian = lagrangian?;
        let quadratic = lowering.is_quadratic(lagrangian);
        Some(RegularFormulas { lagrangian, quadratic, momenta: momenta? })
    }

    /// Whether no mistake was found so far; `None` without coordinates, over which formulas would only
    /// repeat that error.
    fn check_coordinates(&mut self) -> Option<bool> {
        if self.attribute.coordinates.is_empty() && self.errors.is_empty() {
            let message =
                "no coordinates: write `coordinates(x, y)`, or `coordinates(x[N], y[N])` for arrays";
            self.errors.push(&self.model.item.ident, message);
        }
        (!self.model.blocks.is_empty()).then(|| self.errors.is_empty())
    }
}

fn momenta(attribute: &Attribute, lowering: &mut Lowering<'_>) -> Option<Vec<Expr>> {
    let momenta = attribute.momenta.iter();
    let momenta: Vec<Option<Expr>> =
        momenta.map(|momentum| lowering.formula(&momentum.formula, Role::Momentum)).collect();
    momenta.into_iter().collect()
}

/// α·v and H, declared as they are, or split from L; `clean` if no mistake was found before.
fn one_form_and_hamiltonian(
    attribute: &Attribute,
    lowering: &mut Lowering<'_>,
    clean: bool,
) -> Option<(Expr, Expr)> {
    match (&attribute.lagrangian, &attribute.one_form, &attribute.hamiltonian) {
        (Some(lagrangian), None, None) => {
            let lagrangian = lowering.formula(lagrangian, Role::Lagrangian);
            lagrangian.map(|lagrangian| split(lowering.graph, lagrangian))
        }
        (None, Some(one_form), Some(hamiltonian)) => {
            let one_form = lower_one_form(lowering, one_form);
            let hamiltonian = lowering.formula(hamiltonian, Role::Hamiltonian);
            one_form.zip(hamiltonian)
        }
        (Some(_), one_form, hamiltonian) => {
            let second = one_form.as_ref().or(hamiltonian.as_ref());
            second.inspect(|second| {
                lowering
                    .errors
                    .push(second, "give either `lagrangian`, or `one_form` and `hamiltonian`, not both");
            });
            None
        }
        (None, one_form, hamiltonian) => {
            one_form.as_ref().and_then(|one_form| lower_one_form(lowering, one_form));
            hamiltonian.as_ref().and_then(|hamiltonian| lowering.formula(hamiltonian, Role::Hamiltonian));
            if clean {
                let missing = match (one_form, hamiltonian) {
                    (Some(_), None) => "no Hamiltonian: write `hamiltonian = …`",
                    (None, Some(_)) => "no one-form: write `one_form = … * d(x) + …`",
                    _ => "no dynamics: write `one_form = …` and `hamiltonian = …`, or `lagrangian = …`",
                };
                let name = lowering.model.item.ident.clone();
                lowering.errors.push(&name, missing);
            }
            None
        }
    }
}

fn lower_one_form(lowering: &mut Lowering<'_>, one_form: &Syntax) -> Option<Expr> {
    match one_form {
        Syntax::Array(components) => lowering.components(components),
        _ => {
            let value = lowering.formula(one_form, Role::OneForm)?;
            let (stray, _) = split_parts(lowering.graph, value);
            if !stray.is_zero() {
                lowering
                    .errors
                    .push(one_form, "this one-form has no d(·): write `… * d(x)` for a coordinate x");
                return None;
            }
            Some(value)
        }
    }
}

/// L = α·v − H: −H is what is left at v = 0.
fn split(graph: &mut Graph, lagrangian: Expr) -> (Expr, Expr) {
    let (rest, one_form) = split_parts(graph, lagrangian);
    (one_form, rest.negated())
}

/// An affine expression as (its value at v = 0, what is linear in v).
fn split_parts(graph: &mut Graph, value: Expr) -> (Expr, Expr) {
    let at_rest = |graph: &mut Graph, id| matches!(graph.node(id), Node::Velocity(_)).then_some(Expr::ZERO);
    let rest = graph.rebuild(value.node, at_rest).scaled(value.scale);
    let linear = match graph.node(value.node).clone() {
        // Term by term, so that what has no velocity disappears instead of being subtracted.
        Node::Sum(terms) => {
            let parts: Vec<Expr> = terms.iter().map(|term| split_parts(graph, *term).1).collect();
            graph.sum(&parts).scaled(value.scale)
        }
        _ if rest.is_zero() => value,
        _ => graph.subtract(value, rest),
    };
    (rest, linear)
}
