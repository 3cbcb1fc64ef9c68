//! Constraints as they are written, one after the other.

use syn::Expr;

use super::super::jet::Jet;
use super::{Binding, Evaluation, Value, unknown};
use crate::syntax::{Constraint, Member};

/// All constraints, each times the component of its row along a direction: what they add up to.
pub(in super::super) struct Combination {
    pub(in super::super) value: Jet,
    /// The rate along the motion.
    pub(in super::super) rate: Jet,
}

impl Combination {
    pub(in super::super) fn is_moderate(&self) -> bool {
        self.value.is_moderate() && self.rate.is_moderate()
    }
}

impl Evaluation<'_> {
    /// The constraints along the first direction of rows.
    pub(in super::super) fn constraints(&mut self, declared: &[Constraint]) -> Value<Combination> {
        (self.moves, self.follows) = (true, true);
        let mut value = Jet::number(0.0);
        for (number, constraint) in declared.iter().enumerate() {
            for (member, entry) in self.members(constraint)? {
                let weight = self.point.row(self.directions.first, number, member);
                value = value.plus(&entry.scaled(weight));
            }
        }
        (self.moves, self.follows) = (false, false);
        // Where g has no value, its rate has none, even if it does not change.
        let rate = if value.is_moderate() { value.rate() } else { Jet::number(f64::NAN) };
        Ok(Combination { value, rate })
    }

    /// The members of a declared constraint with their numbers.
    fn members(&mut self, Constraint { family, formula }: &Constraint) -> Value<Vec<(i64, Jet)>> {
        let mut members = Vec::new();
        self.passes(family, formula, 0, &mut members)?;
        Ok(members)
    }

    /// Takes down the members of the rest of a family, with so many before them, and counts them.
    fn passes(
        &mut self,
        family: &[Member],
        formula: &Expr,
        before: i64,
        members: &mut Vec<(i64, Jet)>,
    ) -> Value<i64> {
        let [Member { index, range }, inner @ ..] = family else {
            members.push((before, self.number(formula)?));
            return Ok(1);
        };
        let Expr::Range(bounds) = range else { unknown(range) };
        let (lower, upper) = self.bounds(bounds)?;
        let name = self.texts.of(index, || index.to_string());
        let mut count = 0;
        for at in self.point.visited(lower, upper) {
            let outside = self.scope.len();
            self.scope.push(name.clone(), Binding::Index(at));
            let inside = self.passes(inner, formula, before + count, members);
            self.scope.truncate(outside);
            count += inside?;
        }
        // Those of a long range that are not visited count too.
        Ok(if inner.is_empty() { (upper - lower).max(0) } else { count })
    }
}
