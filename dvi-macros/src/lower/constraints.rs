//! Constraints of the positions or of the velocities, and gaps, single ones and families over an index.

use syn::Expr as Syntax;

use super::lints::uses;
use super::sums::natural;
use super::{Lowering, Role};
use crate::formulas::Constraint;
use crate::symbolic::{Expr, Graph, Id, Index, Node};
use crate::syntax::{self, Constrained, Family};

impl Lowering<'_> {
    /// The constraints in the order of declaration.
    pub(crate) fn constraints(
        &mut self,
        of: Constrained,
        declared: &[syntax::Constraint],
    ) -> Option<Vec<Constraint>> {
        let constraints: Vec<Option<Constraint>> =
            declared.iter().map(|one| self.constraint(of, one)).collect();
        let constraints: Vec<Constraint> = constraints.into_iter().collect::<Option<_>>()?;
        let formulas: Vec<&Syntax> = declared.iter().map(|one| &one.formula).collect();
        self.are_different(of, &constraints, &formulas);
        if of != Constrained::Gaps {
            self.leave_room(&constraints, &formulas);
        }
        Some(constraints)
    }

    fn constraint(&mut self, of: Constrained, declared: &syntax::Constraint) -> Option<Constraint> {
        let formula = &declared.formula;
        let constraint = match &declared.family {
            None => Constraint::single(self.formula(formula, Role::Constraint(of))?),
            Some(family) => self.family(of, family, formula)?,
        };
        self.constrains(of, formula, constraint.value)?;
        Some(constraint)
    }

    fn family(
        &mut self,
        of: Constrained,
        Family { index, range }: &Family,
        formula: &Syntax,
    ) -> Option<Constraint> {
        self.begin(formula, Role::Constraint(of));
        let (lower, upper) = self.range(range)?;
        if !uses(formula, index) {
            let message = format!(
                "the index `{index}` stands nowhere in this formula, so that all {} of the family are the same: write `{} = …` for \
                 one",
                of.nouns()[1],
                of.word()
            );
            self.errors.push(index, message);
            return None;
        }
        let (form, over) = natural(0, &lower, &upper);
        let value = self.inside(&[(index.to_string(), form, &over)], formula)?;
        let value = self.number_of(formula, Role::Constraint(of), value)?;
        Some(Constraint { member: Index::open(0).plus(&over.range.lower, -1), over: Some(over), value })
    }

    /// Reports a constraint that stands there before, up to a factor.
    fn are_different(&mut self, of: Constrained, constraints: &[Constraint], formulas: &[&Syntax]) {
        for (number, one) in constraints.iter().enumerate() {
            let is_same = |known: &Constraint| {
                known.over == one.over && are_multiples(self.graph, known.value.node, one.value.node)
            };
            if constraints[..number].iter().any(is_same) {
                let message = match of {
                    Constrained::Positions | Constrained::Velocities => {
                        "this constraint is declared twice, up to a factor: the multipliers of the two would not be determined"
                    }
                    Constrained::Gaps => {
                        "this gap is declared twice, up to a factor: it would be two surfaces at one place, or leave no room between them"
                    }
                };
                self.errors.push(formulas[number], message);
            }
        }
    }

    /// Reports the first constraint beyond the number of coordinates, where both numbers are known.
    fn leave_room(&mut self, constraints: &[Constraint], formulas: &[&Syntax]) {
        let lengths = constraints.iter().map(|constraint| constraint.length().as_literal());
        let (Some(dimension), Some(lengths)) =
            (self.model.dimension().as_literal(), lengths.collect::<Option<Vec<i64>>>())
        else {
            return;
        };
        let counts = lengths.iter().scan(0, |sum, length| {
            *sum += length;
            Some(*sum)
        });
        if let Some(number) = counts.into_iter().position(|count| count > dimension) {
            let (count, coordinates) =
                (lengths.iter().sum::<i64>(), if dimension == 1 { "coordinate" } else { "coordinates" });
            let message = format!(
                "{count} constraints on {dimension} {coordinates} cannot be independent of each other: at most as many as there \
                 are coordinates"
            );
            self.errors.push(formulas[number], message);
        }
    }

    /// Reports a constraint that leaves all positions free, or all velocities.
    fn constrains(&mut self, of: Constrained, formula: &Syntax, value: Expr) -> Option<()> {
        let is_constrained = |node: &Node| match of {
            Constrained::Positions | Constrained::Gaps => matches!(node, Node::Coordinate(_)),
            Constrained::Velocities => matches!(node, Node::Velocity(_)),
        };
        if self.graph.depends(value.node, is_constrained) {
            return Some(());
        }
        let message = match of {
            Constrained::Gaps => {
                "no coordinate stands in this gap, so that no motion closes it: write a function of the coordinates that is zero on the \
                 surface and positive where the motion is"
            }
            Constrained::Positions => {
                "no coordinate stands in this constraint, so that there is nothing to constrain: write a function of the \
                 coordinates that is to be zero"
            }
            Constrained::Velocities => {
                "no velocity `dot(x)` stands in this constraint, or none is left: a constraint of the positions is declared by \
                 `constraint = …`"
            }
        };
        self.errors.push(formula, message);
        None
    }
}

/// Whether one is a multiple of the other: they are the same, or sums of opposite terms.
fn are_multiples(graph: &Graph, one: Id, other: Id) -> bool {
    let opposite = |(a, b): (&Expr, &Expr)| a.node == b.node && a.scale == -b.scale;
    match (graph.node(one), graph.node(other)) {
        _ if one == other => true,
        (Node::Sum(a), Node::Sum(b)) => a.len() == b.len() && a.iter().zip(b).all(opposite),
        _ => false,
    }
}
