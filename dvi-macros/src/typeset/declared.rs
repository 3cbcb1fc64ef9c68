//! What an attribute declares, as equations.

use syn::Expr;

use super::{Equation, Typesetter};
use crate::syntax::{Attribute, Constrained, Constraint, Force, bound};

/// The formulas of a system as they were written.
pub(crate) fn declared(attribute: &Attribute, typesetter: &mut Typesetter) -> Vec<Equation> {
    let mut equations = Vec::new();
    let Attribute { one_form, hamiltonian, lagrangian, time_transform, dissipation, .. } = attribute;
    let rate = time_transform.as_ref().map(|transform| &transform.rate);
    let dynamics = [
        ("L", lagrangian.as_ref()),
        (r"\alpha", one_form.as_ref()),
        ("H", hamiltonian.as_ref()),
        ("F", attribute.gauge()),
        (r"\rho", rate),
        ("R", dissipation.as_ref()),
    ];
    for (name, formula) in dynamics {
        match formula {
            Some(Expr::Array(list)) => equations.extend(components(attribute, name, list, typesetter)),
            formula => equations.extend(formula.map(|formula| typesetter.equation(name, formula))),
        }
    }
    for force in &attribute.forces {
        match force {
            Force::Components(list) => equations.extend(components(attribute, "F", list, typesetter)),
            Force::On(name, formula) => {
                equations.push(component("F", &name.to_string(), formula, typesetter));
            }
        }
    }
    let constraints = attribute.constraints.iter();
    equations.extend(constraints.map(|one| constraint(attribute.constrained, one, typesetter)));
    for named in attribute.momenta.iter().chain(&attribute.events) {
        // Upright, as a `let` may have the same name.
        let name = format!(r"\text{{{}}}", named.name.to_string().replace('_', r"\_"));
        equations.push(typesetter.equation(name, &named.formula));
    }
    equations.extend(attribute.shared.iter().flat_map(|local| typesetter.definition(local)));
    equations
}

/// One for each block of coordinates.
fn components(
    attribute: &Attribute,
    of: &str,
    list: &syn::ExprArray,
    typesetter: &mut Typesetter,
) -> Vec<Equation> {
    let blocks = attribute.coordinates.iter().zip(&list.elems);
    blocks.map(|(block, formula)| component(of, &block.name.to_string(), formula, typesetter)).collect()
}

/// The component along a coordinate, or `|i| …` or `|i, j| …` along those of an array.
fn component(of: &str, coordinate: &str, formula: &Expr, typesetter: &mut Typesetter) -> Equation {
    match formula {
        Expr::Closure(closure) => {
            let names = closure.inputs.iter().flat_map(bound);
            let indices: Vec<String> = names.map(|name| typesetter.symbol(&name.to_string())).collect();
            let entry = typesetter.placed(coordinate, None, &indices);
            typesetter.equation(format!("{of}_{{{entry}}}"), &closure.body)
        }
        formula => {
            let name = typesetter.symbol(coordinate);
            typesetter.equation(format!("{of}_{{{name}}}"), formula)
        }
    }
}

/// 0 = g(q, t), or 0 ≤ g(q, t).
fn constraint(of: Option<Constrained>, one: &Constraint, typesetter: &mut Typesetter) -> Equation {
    let relation = match of {
        Some(Constrained::Gaps) => r"\le",
        Some(Constrained::Positions | Constrained::Velocities) | None => "=",
    };
    let ranges = one.family.iter().map(|member| typesetter.range(&member.index.to_string(), &member.range));
    let range = Some(ranges.collect::<Vec<_>>().join(r", \ ")).filter(|range| !range.is_empty());
    Equation { relation, range, ..typesetter.equation("0", &one.formula) }
}
