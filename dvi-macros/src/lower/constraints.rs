//! Constraints of the positions or of the velocities, and gaps, single ones and families over an index.

use syn::Expr as Syntax;

use super::lints::uses;
use super::sums::natural;
use super::{Binding, Lowering, Role, all};
use crate::formulas::Constraint;
use crate::symbolic::{Atom, Expr, Graph, Id, Index, Loop, Node};
use crate::syntax::{self, Constrained, Member};

impl Lowering<'_> {
    /// The constraints in the order of declaration.
    pub(crate) fn constraints(
        &mut self,
        of: Constrained,
        declared: &[syntax::Constraint],
    ) -> Option<Vec<Constraint>> {
        let constraints = all(declared.iter().map(|one| self.constraint(of, one)))?;
        let formulas: Vec<&Syntax> = declared.iter().map(|one| &one.formula).collect();
        self.are_different(of, &constraints, &formulas);
        if of != Constrained::Gaps {
            self.leave_room(&constraints, &formulas);
        }
        Some(constraints)
    }

    fn constraint(&mut self, of: Constrained, declared: &syntax::Constraint) -> Option<Constraint> {
        let formula = &declared.formula;
        let constraint = match declared.family.as_slice() {
            [] => Constraint { loops: Vec::new(), value: self.formula(formula, Role::Constraint(of))? },
            family => self.family(of, family, formula)?,
        };
        self.constrains(of, formula, constraint.value)?;
        Some(constraint)
    }

    fn family(&mut self, of: Constrained, family: &[Member], formula: &Syntax) -> Option<Constraint> {
        self.begin(formula, Role::Constraint(of));
        let (outside, mut loops) = (self.scope.len(), Vec::new());
        let indices: Option<Vec<_>> = family.iter().map(|member| self.member(member, &mut loops)).collect();
        self.loops = 0;
        self.scope.truncate(outside);
        let indices = indices?;
        if let Some(Member { index, .. }) = family.iter().find(|member| !uses(formula, &member.index)) {
            let nouns = of.words().nouns[1];
            let message = match family {
                [_] => format!(
                    "the index `{index}` stands nowhere in this formula, so that all {nouns} of the family are the same: write \
                     `{} = …` for one",
                    of.words().word
                ),
                _ => format!(
                    "the index `{index}` stands nowhere in this formula, so that {nouns} of the family are the same for all of its \
                     values"
                ),
            };
            return self.refuse(index, message);
        }
        let over = indices.into_iter().zip(&loops).map(|((name, form), over)| (name, form, over));
        let value = self.inside(&over.collect::<Vec<_>>(), formula)?;
        let value = self.number_of(formula, Role::Constraint(of), value)?;
        Some(Constraint { loops, value })
    }

    /// Opens the loop over an index of a family, with the index as a form in that of the loop.
    fn member(
        &mut self,
        Member { index, range }: &Member,
        loops: &mut Vec<Loop>,
    ) -> Option<(String, Index)> {
        let (lower, upper) = self.range(range)?;
        let depth = loops.len() as u32;
        let (form, over) = natural(depth, &lower, &upper);
        let length = over.range.upper.plus(&over.range.lower, -1);
        let is_turned = |atom: &Atom| {
            let is_known = matches!(atom, Atom::Open(_));
            !is_known && Index::atom(atom.clone()).free().open != 0
        };
        if length.terms.iter().any(|(atom, _)| is_turned(atom)) {
            let message =
                "the range of an index of a family depends on the other one by sums and literal multiples";
            return self.refuse(range, message);
        }
        let name = index.to_string();
        self.scope.push((name.clone(), Binding::Index { form: form.clone(), over: Some(over.clone()) }));
        self.loops = depth + 1;
        loops.push(over);
        Some((name, form))
    }

    /// Reports a constraint that stands there before, up to a factor.
    fn are_different(&mut self, of: Constrained, constraints: &[Constraint], formulas: &[&Syntax]) {
        for (number, one) in constraints.iter().enumerate() {
            let is_same = |known: &Constraint| {
                known.loops == one.loops && are_multiples(self.graph, known.value.node, one.value.node)
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
        let is_constrained = match of {
            Constrained::Positions | Constrained::Gaps => Node::is_position,
            Constrained::Velocities => Node::is_velocity,
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
        self.refuse(formula, message)
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
