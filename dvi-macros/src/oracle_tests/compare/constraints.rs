//! The functions of constraints, of positions or of velocities, and of gaps.

use super::super::jet::{Jet, Sized};
use super::super::random::Random;
use super::{Comparison, Difference, Expected};
use crate::syntax::Constrained;

impl Comparison<'_> {
    pub(super) fn constraints(
        &mut self,
        expected: &Expected,
        random: &mut Random,
    ) -> Result<(), Difference> {
        let Expected { point, constraints, .. } = expected;
        let (n, m) = (self.system.dimension(), constraints.len());
        if m == 0 {
            return Ok(());
        }
        // With room for more rows or columns than there are.
        let side = n.max(m);
        let matrix: Vec<f64> = (0..side * side).map(|_| random.between(-1.0, 1.0)).collect();
        if self.system.constrained == Constrained::Velocities {
            return self.velocity_constraints(expected, random, &matrix);
        }
        let [value, jacobian, rate] = self.system.constrained.words().generated;
        self.sets(value, self.at_rest(point), m, |k| constraints[k].value)?;
        let (_, slices) = self.at_rest(point).slice(&vec![7.0; m]).slice(&matrix).run(jacobian)?;
        self.same_vector(jacobian, &slices[1], |k| constraints[k].value)?;
        self.same_rows(jacobian, &slices[2], &matrix, constraints, |constraint, column| {
            constraint.gradient(column)
        })?;

        self.constraint_rate(expected, rate)?;
        if self.system.constrained == Constrained::Gaps {
            return Ok(());
        }
        let along = |i: usize| Sized::new(if i < n { point.v[i] } else { 1.0 });
        let variables = || (0..n).chain([2 * n]);
        self.sets("constraint_curvature", self.moving(point), m, |k| {
            let pairs = variables().flat_map(|i| variables().map(move |j| (i, j)));
            let terms = pairs.map(|(i, j)| constraints[k].hessian(i, j).times(along(i)).times(along(j)));
            terms.fold(Sized::default(), Sized::plus)
        })
    }

    fn velocity_constraints(
        &mut self,
        expected: &Expected,
        random: &mut Random,
        matrix: &[f64],
    ) -> Result<(), Difference> {
        let Expected { point, constraints, .. } = expected;
        let (n, m) = (self.system.dimension(), constraints.len());
        self.sets("velocity_constraint", self.moving(point), m, |k| constraints[k].value)?;

        let weights = [0; 2].map(|_| random.between(-1.7, 1.7));
        let call = self.moving(point).slice(&weights).slice(&vec![7.0; m]).slice(matrix);
        let (_, slices) = call.run("velocity_constraint_jacobian")?;
        self.same_vector("velocity_constraint_jacobian, a", &slices[3], |k| constraints[k].value)?;
        let [by_q, by_v] = weights;
        self.same_rows("velocity_constraint_jacobian", &slices[4], matrix, constraints, |constraint, j| {
            constraint.gradient(j).scaled(by_q).plus(constraint.gradient(n + j).scaled(by_v))
        })?;
        self.constraint_rate(expected, "velocity_constraint_rate")
    }

    /// The rates of change of all constraints along (v, 1).
    fn constraint_rate(&mut self, expected: &Expected, function: &str) -> Result<(), Difference> {
        let Expected { point, constraints, .. } = expected;
        let n = self.system.dimension();
        self.sets(function, self.moving(point), constraints.len(), |k| {
            let terms = (0..n).map(|i| constraints[k].gradient(i).times(Sized::new(point.v[i])));
            terms.fold(constraints[k].gradient(2 * n), Sized::plus)
        })
    }

    /// A square matrix with an entry for each constraint and each coordinate added to what was there before.
    fn same_rows(
        &mut self,
        what: &str,
        found: &[f64],
        before: &[f64],
        constraints: &[Jet],
        entry: impl Fn(&Jet, usize) -> Sized,
    ) -> Result<(), Difference> {
        let (n, side) = (self.system.dimension(), before.len().isqrt());
        for (place, found) in found.iter().enumerate() {
            let (row, column) = (place / side, place % side);
            let start = Sized::new(before[place]);
            let constraint = constraints.get(row).filter(|_| column < n);
            let wanted = constraint.map_or(start, |constraint| start.plus(entry(constraint, column)));
            self.same(what, &[row, column], wanted, *found)?;
        }
        Ok(())
    }
}
