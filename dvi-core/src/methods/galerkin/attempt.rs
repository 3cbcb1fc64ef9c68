//! A step with interior displacements: its guess, the equations that are solved, and what is looked at where
//! it ends.

use super::displaced::Displaced;
use super::interior::{Departure, InteriorNodes};
use super::memory::Path;
use crate::discrete::frequency::FrequencyIn;
use crate::discrete::{Interval, NodeWork};
use crate::error::StepFailure;
use crate::mechanics::phase::{Arrival, Increments};
use crate::scalar::norm;
use crate::solve::{Guess, Stopping, solve_coupled};
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
}

/// The equations of a step, where it begins, and storage for the residuals and for weights.
type Posed<'a, const NODES: usize, S, F, T> =
    (Displaced<'a, NODES, S, F, T>, &'a [T], &'a mut [Vector<S, T>; NODES], &'a mut [Vector<S, T>; 2]);

/// What [`Attempt::nodes`] returns.
type Nodes<'a, const NODES: usize, S, T, I> =
    (&'a mut I, Departure<'a, S, T>, [&'a mut [Vector<S, T>; NODES]; 2]);

impl<const NODES: usize, S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, T: Real, I>
    Attempt<'_, NODES, S, F, T, I>
where
    I: InteriorNodes<NODES, S, T>,
{
    /// The unknowns, and p1 − p0 but for the kick at the end, by the fixed point.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn by_fixed_point(
        &mut self,
        budget: usize,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let limits = (self.stopping, budget);
        if let Some((interior, at, [unknowns, residuals])) = self.nodes() {
            let increments = [&mut unknowns[NODES - 1], &mut residuals[0]];
            return interior.solve(&at, limits, increments, statistics);
        }
        self.guess();
        let (mut equations, _, residuals, [weights, _]) = self.pose();
        equations.iterate((residuals, weights), limits, statistics)?;
        equations.differentiate(0, residuals, statistics)
    }

    /// The same by Newton's method.
    pub(super) fn by_newton(
        &mut self,
        solver: &mut Coupled<NODES, S, T>,
        guess: Guess,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.guess();
        if guess == Guess::Zero {
            self.path.unknowns[1..].iter_mut().for_each(|unknown| unknown.fill(T::lift(0.0)));
        }
        let (system, stopping) = (self.system, self.stopping);
        let (mut equations, q, residuals, weights) = self.pose();
        solve_coupled(&mut equations, (system, q), solver, (residuals, weights), stopping, statistics)?;
        if let Some((interior, at, [unknowns, residuals])) = self.nodes() {
            interior.visit(&at, unknowns, &mut residuals[0], statistics);
            return Ok(());
        }
        let (mut equations, _, residuals, _) = self.pose();
        equations.differentiate(0, residuals, statistics)
    }

    /// The interior nodes, where L = ½ v·M v − V(q, t) and there is no frequency, and beside them where the
    /// step begins, and unknowns and residuals.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn nodes(&mut self) -> Option<Nodes<'_, NODES, S, T, I>> {
        if !(S::SEPARABLE && F::UNFITTED) {
            return None;
        }
        let Self { system, interval, q, path, .. } = self;
        let Path { phase, inertial, interior, unknowns, residuals, .. } = &mut **path;
        let at = Departure { system: *system, interval: *interval, q, phase, mass: &inertial.mass };
        Some((interior.as_mut()?, at, [unknowns, residuals]))
    }

    /// The equations of any L.
    fn pose(&mut self) -> Posed<'_, NODES, S, F, T> {
        let Self { system, frequency, interval, q, path, .. } = self;
        let Path { phase, inertial, fit, ends, unknowns, residuals, weights, node, .. } = &mut **path;
        let (mass, interval) = (&inertial.mass, *interval);
        let equations = Displaced {
            system: *system,
            frequency: *frequency,
            interval,
            phase,
            mass,
            fit,
            ends,
            unknowns,
            node,
            j: 0,
        };
        (equations, q, residuals, weights)
    }

    /// Sets the unknowns to their guess. Where there are interior nodes, the step before is continued. Else
    /// they are extrapolated from the steps before if these had about this length; if not, the path is
    /// straight, and its velocity is taken from the momentum if L is separable.
    fn guess(&mut self) {
        self.path.unknowns[0].copy_from_slice(self.q);
        if let Some((interior, at, [unknowns, _])) = self.nodes() {
            return interior.guess(&at, unknowns);
        }
        let (h, Path { phase, inertial, displacements, unknowns, .. }) = (self.interval.h, &mut *self.path);
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
        let Self { system, interval, q, path, .. } = self;
        let Path { phase, inertial, interior, displacements, fit, unknowns, residuals, node, .. } =
            &mut **path;
        let NodeWork { point: next, velocity, gradient: force, momentum } = node;
        let (h, end, delta) = (interval.h, interval.time(T::lift(1.0)), &unknowns[NODES - 1]);
        phase.reach(q, delta, next);
        if S::SEPARABLE {
            system.force(next, &[], end, force);
            statistics.gradients += 1;
            let by = h * fit.coefficients.weights[NODES - 1];
            residuals[0].iter_mut().zip(force.iter()).for_each(|(sum, &force)| *sum += by * force);
        }
        phase.kick(&residuals[0], momentum);
        norm::finite(next).and(norm::finite(momentum))?;
        inertial.check(system, [next, delta], [end, h], velocity)?;
        let similar = phase.extrapolates_to(h);
        let by = Increments { q: delta, p: &residuals[0] };
        phase.advance(q, &Arrival { q: next, p: momentum, force }, by, h)?;
        if let Some(interior) = interior {
            interior.remember(h);
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
