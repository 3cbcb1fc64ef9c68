//! What is admitted as a formula: of a reasonable size, and affine in the velocities where a degenerate
//! system or a nonholonomic constraint asks for it, reported on the smallest term that is not.

use rustc_hash::FxHashMap as HashMap;

use quote::ToTokens;
use syn::Expr as Syntax;

use super::{Lowering, Role};
use crate::symbolic::{Expr, Fold, Graph, Id, Node};
use crate::syntax::{Constrained, Kind};

/// Far beyond what floating point can tell from 0 or ∞, and far from overflow.
pub(super) const LARGEST_EXPONENT: u32 = 4096;

/// Derivatives of functions of functions of functions grow with the depth: at this one an expansion takes
/// seconds.
const DEEPEST_FUNCTION: u32 = 128;

/// The degree of everything that is no polynomial of degree 0, 1 or 2.
const BEYOND: u8 = 3;

/// What is measured of each node.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Measure {
    /// The degree as a polynomial in the velocities, or [`BEYOND`].
    degree: u8,
    /// How deep functions nest.
    functions: u32,
    /// How deep anything nests.
    depth: u32,
}

/// Operands come before the nodes that use them.
fn measure(graph: &Graph, root: Id, known: &mut HashMap<Id, Measure>) -> Measure {
    let mut open = vec![root];
    while let Some(&node) = open.last() {
        let unknown = |id: &Id| !known.contains_key(id);
        let waiting: Vec<Id> = graph.node(node).operands().into_iter().filter(unknown).collect();
        if waiting.is_empty() || known.contains_key(&node) {
            let measured = measure_above(graph, node, known);
            known.insert(node, measured);
            open.pop();
        } else {
            open.extend(waiting);
        }
    }
    known[&root]
}

fn measure_above(graph: &Graph, node: Id, known: &HashMap<Id, Measure>) -> Measure {
    let operands: Vec<Measure> = graph.node(node).operands().iter().map(|id| known[id]).collect();
    let largest = operands.iter().map(|operand| operand.degree).max().unwrap_or(0);
    let deepest = operands.iter().map(|operand| operand.functions).max().unwrap_or(0);
    let degree = match graph.node(node) {
        Node::Velocity(_) => 1,
        Node::Sum(_) | Node::Reduce { fold: Fold::Sum, .. } => largest,
        Node::Product(factors) => {
            let degrees = factors.iter().zip(&operands);
            let sum: u32 = degrees.map(|((_, e), of)| e.saturating_mul(u32::from(of.degree))).sum();
            u8::try_from(sum).unwrap_or(BEYOND).min(BEYOND)
        }
        // Left, right, then, otherwise.
        Node::Choose { .. } if operands[0].degree == 0 && operands[1].degree == 0 => largest,
        _ if largest > 0 => BEYOND,
        _ => 0,
    };
    let function = matches!(
        graph.node(node),
        Node::Unary(..)
            | Node::Binary(..)
            | Node::Call(..)
            | Node::ScalarField(..)
            | Node::Reciprocal(_)
            | Node::Choose { .. }
    );
    let depth = 1 + operands.iter().map(|operand| operand.depth).max().unwrap_or(0);
    Measure { degree, functions: deepest + u32::from(function), depth }
}

impl Lowering<'_> {
    fn measured(&mut self, value: Expr) -> Measure {
        measure(self.graph, value.node, &mut self.measures)
    }

    pub(super) fn degree(&mut self, value: Expr) -> u8 {
        self.measured(value).degree
    }

    /// Whether an expression is a polynomial of degree at most two in the velocities.
    pub(crate) fn is_quadratic(&mut self, value: Expr) -> bool {
        self.degree(value) <= 2
    }

    /// How deep an expression nests, the values of its names included.
    pub(super) fn nesting(&mut self, value: Expr) -> u32 {
        self.measured(value).depth
    }

    /// Passes `value` on if it is of a reasonable size and of a degree that its formula may have.
    pub(super) fn admitted(&mut self, syntax: &impl ToTokens, value: Expr) -> Option<Expr> {
        if let Node::Product(factors) = self.graph.node(value.node)
            && factors.iter().any(|(_, exponent)| *exponent > LARGEST_EXPONENT)
        {
            let message = format!("this power is too large: exponents go up to {LARGEST_EXPONENT}");
            return self.refuse(syntax, message);
        }
        if self.measured(value).functions > DEEPEST_FUNCTION {
            let message = format!(
                "more than {DEEPEST_FUNCTION} functions stand inside one another here; declare the inner ones \
                     as a function of your own, with its derivatives: `functions(f = [f, df, d2f])`"
            );
            return self.errors.refuse_once("depth of functions", syntax, message);
        }
        if !self.is_to_be_affine() || self.degree(value) < 2 {
            return Some(value);
        }
        let message = match self.role {
            _ if self.is_one_form() => "a one-form is linear in d(·): this term is not",
            Role::Constraint(_) => {
                "this term is not affine in the velocities: a nonholonomic constraint is A(q, t) v + b(q, t) = 0, so that no \
                 velocity is multiplied by another one or stands in a function"
            }
            _ => {
                "this term is not affine in the velocities, so the Lagrangian is not degenerate in the sense of \
                 `#[degenerate_lagrangian]`; a regular Lagrangian belongs to `#[lagrangian]`"
            }
        };
        self.refuse(syntax, message)
    }

    /// Whether the formula is to be affine in the velocities.
    fn is_to_be_affine(&self) -> bool {
        self.model.kind == Kind::Degenerate || self.role == Role::Constraint(Constrained::Velocities)
    }

    /// What is compared does not depend on velocities, where the formula is to be affine in them.
    pub(super) fn check_at_rest(&mut self, at: &impl ToTokens, what: &str, sides: &[Expr]) -> Option<()> {
        if !self.is_to_be_affine() || sides.iter().all(|side| self.degree(*side) == 0) {
            return Some(());
        }
        let formula = match self.role {
            Role::Constraint(_) => "this constraint",
            _ => "L",
        };
        let message = format!(
            "{what} depends on a velocity, so {formula} is not affine in the velocities; \
             a condition compares coordinates, parameters and `t`"
        );
        self.refuse(at, message)
    }

    /// Whether this is a one-form, or a name that may stand in one.
    fn is_one_form(&self) -> bool {
        self.role == Role::OneForm || (self.role == Role::Shared && self.shared.velocity == "d")
    }

    /// In a one-form, a term without d(·) cannot be added to one with it.
    pub(super) fn check_homogeneous(&mut self, left: (&Syntax, Expr), right: (&Syntax, Expr)) -> Option<()> {
        if !self.is_one_form() {
            return Some(());
        }
        let stray = match (self.degree(left.1), self.degree(right.1)) {
            (0, 1) if !left.1.is_zero() => left.0,
            (1, 0) if !right.1.is_zero() => right.0,
            _ => return Some(()),
        };
        self.errors
            .refuse(stray, "this term of the one-form has no d(·): write `… * d(x)` for a coordinate x")
    }
}
