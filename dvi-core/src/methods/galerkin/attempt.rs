//! A step with interior displacements: its guess, the equations that are solved, and what is looked at where
//! it ends.

use super::displaced::Displaced;
use super::fitted::Fitted;
use super::interior::{Departure, InteriorNodes};
use super::memory::Path;
use crate::discrete::frequency::FrequencyIn;
use crate::discrete::{Interval, NodeWork};
use crate::error::StepFailure;
use crate::mechanics::phase::{Arrival, Increments};
use crate::scalar::norm;
use crate::solve::{CoupledEquations, Guess, Stopping, solve_coupled};
use crate::state::Statistics;
use crate::{Coupled, NondegenerateLagrangian, Real, System, Vector};

/// A step, and what it changes.
pub(super) struct Attempt<'a, const NODES: usize, S: System, F, T: Real, I> {
    pub(super) system: &'a S,
    pub(super) frequency: &'a F,
    pub(super) stopping: Stopping,
    pub(super) interval: Interval<T>,
    pub(super) q: &'a mut Vector<S, T>,
    pub(super) path: &'a mut Path<NODES, S, T, I>,
    /// Whether p1 − p0 contains the kick at the end.
    pub(super) is_kicked: bool,
}

impl<const NODES: usize, S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, T: Real, I>
    Attempt<'_, NODES, S, F, T, I>
where
    I: InteriorNodes<NODES, S, T>,
{
    /// The unknowns, and p1 − p0 but for the kick at the end, by the fixed point of a separable L.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn by_fixed_point(
        &mut self,
        budget: usize,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.is_kicked = false;
        if !F::UNFITTED {
            self.guess();
        }
        let Self { system, frequency, stopping, interval, q, path, .. } = self;
        let Path { phase, inertial, interior, fit, ends, unknowns, residuals, weights, node, .. } =
            &mut **path;
        let (system, interval, mass, limits) = (*system, *interval, &inertial.mass, (*stopping, budget));
        match interior {
            Some(interior) if F::UNFITTED => {
                let at = Departure { system, interval, q, phase, mass };
                let increments = [&mut unknowns[NODES - 1], &mut residuals[0]];
                interior.solve(&at, limits, increments, statistics)
            }
            _ => {
                let mut fitted = Fitted { system, frequency: *frequency, interval, phase, mass, ends };
                fitted.solve(fit, unknowns, (residuals, &mut weights[0], node), limits, statistics)
            }
        }
    }

    /// The unknowns and p1 − p0 by Newton's method.
    pub(super) fn by_newton(
        &mut self,
        solver: &mut Coupled<NODES, S, T>,
        guess: Guess,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.is_kicked = true;
        self.guess();
        let Self { system, frequency, stopping, interval, q, path, .. } = self;
        let Path { phase, inertial, fit, ends, unknowns, residuals, weights, node, .. } = &mut **path;
        if guess == Guess::Zero {
            unknowns[1..].iter_mut().for_each(|unknown| unknown.fill(T::lift(0.0)));
        }
        let (system, interval, mass) = (*system, *interval, &inertial.mass);
        let fitted = Some(Fitted { system, frequency: *frequency, interval, phase, mass, ends });
        let path = &mut Displaced { system, interval, p0: &phase.p, fitted, fit, unknowns, node, j: 0 };
        solve_coupled(path, (system, q), solver, (residuals, weights), *stopping, statistics)?;
        path.evaluate(residuals, statistics)
    }

    /// Sets the unknowns to their guess. Where there are interior nodes, the step before is continued. Else
    /// they are extrapolated from the steps before if these had about this length; if not, the path is
    /// straight, and its velocity is taken from the momentum if L is separable.
    fn guess(&mut self) {
        let Self { system, interval, q, path, .. } = self;
        let (h, Path { phase, inertial, interior, displacements, unknowns, .. }) = (interval.h, &mut **path);
        unknowns[0].copy_from_slice(q);
        if let Some(interior) = interior {
            let at = Departure { system: *system, interval: *interval, q, phase, mass: &inertial.mass };
            return interior.guess(&at, unknowns);
        }
        let (inside, delta) = unknowns.split_at_mut(NODES - 1);
        let histories = displacements.iter().flat_map(|displacements| &displacements.nodes);
        for (displacement, history) in inside.iter_mut().zip(histories).skip(1) {
            if phase.extrapolates_to(h) {
                history.extrapolate(displacement);
                displacement.iter_mut().for_each(|delta| *delta *= h * h);
            } else {
                displacement.fill(T::lift(0.0));
            }
        }
        phase.guess(&inertial.mass, &phase.p, h, &mut delta[0]);
    }

    /// Moves to q1 = q0 + Δ and p1 = p0 + (D₁ + D₂)L_d, if they are numbers and the mass matrix has kept its
    /// orientation.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn arrive(&mut self, statistics: &mut Statistics) -> Result<(), StepFailure> {
        let Self { system, interval, q, path, is_kicked, .. } = self;
        let Path { phase, inertial, interior, displacements, fit, unknowns, residuals, node, .. } =
            &mut **path;
        let NodeWork { point: next, velocity, gradient: force, momentum } = node;
        let (h, end, delta) = (interval.h, interval.time(T::lift(1.0)), &unknowns[NODES - 1]);
        phase.reach(q, delta, next);
        if S::SEPARABLE {
            system.force(next, &[], end, force);
            statistics.gradients += 1;
            let weight = if *is_kicked { T::lift(0.0) } else { fit.coefficients.weights[NODES - 1] };
            let by = h * weight;
            residuals[0].iter_mut().zip(force.iter()).for_each(|(sum, &force)| *sum += by * force);
        }
        phase.kick(&residuals[0], momentum);
        norm::finite(next).and(norm::finite(momentum))?;
        inertial.check(system, [next, delta], [end, h], velocity)?;
        let similar = phase.extrapolates_to(h);
        let by = Increments { q: delta, p: &residuals[0] };
        phase.advance(q, &Arrival { q: next, p: momentum, force }, by, h)?;
        if let Some(interior) = interior {
            interior.remember(if *is_kicked { T::lift(0.0) } else { h });
        }
        let per_h = T::lift(1.0) / h;
        let histories = displacements.iter_mut().flat_map(|displacements| &mut displacements.nodes);
        for (history, displacement) in histories.zip(unknowns).take(NODES - 1).skip(1) {
            if !similar {
                history.clear();
            }
            history.push_scaled(displacement, per_h * per_h);
        }
        Ok(())
    }
}
