//! The fixed point Δ ← Δ + (h/κ)M⁻¹(p0 + r), where M is constant.

use super::equations::{Begin, Equations, Kinetic, Share};
use super::{WithCoefficients, Work};
use crate::error::StepFailure;
use crate::scalar::norm;
use crate::solve::{Convergence, Due, Iteration, Stopping, repeat, sizes};
use crate::state::Statistics;
use crate::{NondegenerateLagrangian, Real};

/// Sets the increment.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn iterate_by_mass<S: NondegenerateLagrangian<T>, T: Real, E: Equations<S, T>>(
    scheme: &mut WithCoefficients<'_, S, T, E>,
    begin: &Begin<'_, S, T>,
    work: &mut Work<S, T>,
    (stopping, budget): (Stopping, usize),
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let is_explicit = S::SEPARABLE && scheme.0.is_explicit();
    if is_explicit {
        work.increment.fill(T::lift(0.0));
        return ByMass { scheme, begin, work }.correct(statistics);
    }
    begin.phase.guess(begin.mass, &begin.phase.p, begin.interval.h, &mut work.increment);
    let convergence = Convergence::fixed_point(stopping, budget);
    repeat(convergence, statistics, ByMass { scheme, begin, work })?;
    norm::finite(&work.increment)
}

/// The fixed point.
struct ByMass<'a, 'b, 'c, S: NondegenerateLagrangian<T>, T: Real, E: Equations<S, T>> {
    scheme: &'a mut WithCoefficients<'b, S, T, E>,
    begin: &'a Begin<'c, S, T>,
    work: &'a mut Work<S, T>,
}

impl<S: NondegenerateLagrangian<T>, T: Real, E: Equations<S, T>> ByMass<'_, '_, '_, S, T, E> {
    /// Corrects the increment, and leaves the correction in `node.velocity`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn correct(&mut self, statistics: &mut Statistics) -> Result<(), StepFailure> {
        let Self { scheme: (equations, coefficients), begin, work } = self;
        let Work { node, increment, trial: impulse, .. } = &mut **work;
        let h = begin.interval.h;
        impulse.copy_from_slice(&begin.phase.p);
        equations.evaluate(begin, increment, Share::Left, (coefficients, node), impulse, statistics)?;
        begin.mass.solve(impulse, &mut node.velocity);
        let Kinetic { mixed, left, per_stiffness, .. } = equations.kinetic(coefficients);
        for ((v, delta), &q) in node.velocity.iter_mut().zip(increment.iter_mut()).zip(begin.q) {
            let displacement = h * *v;
            let missing = if S::SEPARABLE { displacement + left * q - mixed * *delta } else { displacement };
            *v = missing * per_stiffness;
            *delta += *v;
        }
        Ok(())
    }
}

impl<S: NondegenerateLagrangian<T>, T: Real, E: Equations<S, T>> Iteration<T>
    for ByMass<'_, '_, '_, S, T, E>
{
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn prepare(&mut self, due: &mut Due) {
        let Self { begin, work: Work { weights, increment, .. }, .. } = self;
        due.prepare(begin.system, weights, begin.q, increment);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn improve(&mut self, _due: &mut Due, statistics: &mut Statistics) -> Result<T, StepFailure> {
        self.correct(statistics)?;
        Ok(sizes::largest(&self.work.weights, &self.work.node.velocity))
    }
}
