//! The functions of constraints, of positions or of velocities, and of gaps.

use super::super::jet::Sized;
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
        let of = self.system.constrained;
        let [value, jacobian, rate] = of.words().generated;
        // Of velocities there are two derivatives, which the Jacobian adds up with weights.
        let weights = match of {
            Constrained::Velocities => Some([0; 2].map(|_| random.between(-1.7, 1.7))),
            Constrained::Positions | Constrained::Gaps => None,
        };
        let [values, jacobians] = match weights {
            Some(weights) => [self.moving(point), self.moving(point).slice(&weights)],
            None => [self.at_rest(point), self.at_rest(point)],
        };
        self.sets(value, values, m, |k| constraints[k].value)?;
        let set = jacobians.machine.arrays.len();
        let (_, slices) = jacobians.slice(&vec![7.0; m]).slice(&matrix).run(jacobian)?;
        self.same_vector(jacobian, &slices[set], |k| constraints[k].value)?;
        self.same_matrix(jacobian, &slices[set + 1], |row, column| {
            let start = Sized::new(matrix[row * side + column]);
            let Some(one) = constraints.get(row).filter(|_| column < n) else { return start };
            start.plus(match weights {
                Some([by_q, by_v]) => {
                    one.gradient(column).scaled(by_q).plus(one.gradient(n + column).scaled(by_v))
                }
                None => one.gradient(column),
            })
        })?;
        // Along (v, 1), without acceleration.
        self.sets(rate, self.moving(point), m, |k| {
            let terms = (0..n).map(|i| constraints[k].gradient(i).times(Sized::new(point.v[i])));
            terms.fold(constraints[k].gradient(2 * n), Sized::plus)
        })?;
        if of != Constrained::Positions {
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
}
