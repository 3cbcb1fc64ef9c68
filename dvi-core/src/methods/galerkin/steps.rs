//! Steps with interior displacements: which equations are solved, and how.

use super::displaced::Displaced;
use super::interior::{Departure, InteriorNodes};
use super::memory::{GalerkinMemory, Path};
use super::{Galerkin, NodeEvaluation};
use crate::discrete::frequency::{self, Frequency, FrequencyIn, Reading, Unfitted};
use crate::discrete::{Interval, NodeWork};
use crate::error::{StartError, StepFailure};
use crate::mechanics::phase::{Arrival, Increments};
use crate::methods::{Carries, FreeFlight, Method, PreservedForm, Scheme, VariableStep};
use crate::scalar::norm;
use crate::solve::{CoupledEquations, Guess, Solver, Stopping, solve_coupled};
use crate::state::Statistics;
use crate::{Coupled, NondegenerateLagrangian, Real, RegularLagrangian, System, Vector};

impl<const NODES: usize, F: Frequency, E> Galerkin<NODES, F, E> {
    pub(super) fn validate<S: NondegenerateLagrangian<T>, T: Real>(
        &self,
        system: &S,
    ) -> Result<(), StartError>
    where
        F: FrequencyIn<T>,
    {
        let unsupported = |option, reason| Err(StartError::Unsupported { option, reason });
        let separable =
            "it needs L = ½ v·M v − V(q, t) with a constant matrix M, and forces without velocities";
        match self.frequency.reading() {
            None => {}
            Some(Reading::Averaged) if S::SEPARABLE => {}
            Some(Reading::Averaged) => return unsupported("a frequency read from the motion", separable),
            Some(_) => return unsupported("this reading of the frequency", "take Reading::Averaged"),
        }
        if !S::SEPARABLE && self.solver == Solver::FixedPoint {
            let reason = "it needs L = ½ v·M v − V(q, t) with a constant matrix M, and forces without velocities; take \
                          Solver::Newton";
            return unsupported("Solver::FixedPoint", reason);
        }
        frequency::admit(&self.frequency, system)?;
        self.stopping.validate()
    }
}

impl<const NODES: usize, F: Frequency, E> Galerkin<NODES, F, E> {
    /// Takes a step from t to t + h.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take<S: NondegenerateLagrangian<T>, T: Real>(
        &self,
        system: &S,
        memory: &mut GalerkinMemory<NODES, S, T, E::Interior>,
        q: &mut Vector<S, T>,
        [t, h]: [T; 2],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure>
    where
        F: FrequencyIn<T>,
        E: NodeEvaluation<NODES, S, T, Interior: InteriorNodes<NODES, S, T>>,
    {
        let GalerkinMemory { ladder, path } = memory;
        let (interval, Self { frequency, stopping, .. }) = (Interval { t, h }, self);
        let budget = ladder.budget(stopping.max_iterations, 24 + q.len());
        E::run(
            #[cfg_attr(not(debug_assertions), inline(always))]
            || {
                let mut step = Attempt { system, frequency, stopping: *stopping, interval, q, path };
                ladder.solve(
                    &mut step,
                    statistics,
                    #[cfg_attr(not(debug_assertions), inline(always))]
                    |step, statistics| step.by_fixed_point(budget, statistics),
                    |step, solver, guess, statistics| step.by_newton(solver, guess, statistics),
                )?;
                step.arrive(statistics)
            },
        )
    }
}

/// A step, and what it changes.
struct Attempt<'a, const NODES: usize, S: System, F, T: Real, I> {
    system: &'a S,
    frequency: &'a F,
    stopping: Stopping,
    interval: Interval<T>,
    q: &'a mut Vector<S, T>,
    path: &'a mut Path<NODES, S, T, I>,
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
    fn by_fixed_point(&mut self, budget: usize, statistics: &mut Statistics) -> Result<(), StepFailure> {
        let limits = (self.stopping, budget);
        if let Some((interior, at, [unknowns, residuals])) = self.nodes() {
            let increments = [&mut unknowns[NODES - 1], &mut residuals[0]];
            return interior.solve(&at, limits, increments, statistics);
        }
        self.guess();
        let (mut equations, _, residuals, [weights, _]) = self.pose();
        equations.iterate((residuals, weights), limits, statistics)?;
        equations.evaluate(residuals, statistics)
    }

    /// The same by Newton's method.
    fn by_newton(
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
        equations.evaluate(residuals, statistics)
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
        let at = Departure { system: *system, interval: *interval, q, phase, mass: inertial.constant()? };
        Some((interior.as_mut()?, at, [unknowns, residuals]))
    }

    /// The equations of any L.
    fn pose(&mut self) -> Posed<'_, NODES, S, F, T> {
        let Self { system, frequency, interval, q, path, .. } = self;
        let Path { phase, inertial, fit, unknowns, residuals, weights, node, .. } = &mut **path;
        let (mass, interval) = (inertial.constant(), *interval);
        let equations = Displaced {
            system: *system,
            frequency: *frequency,
            interval,
            phase,
            mass,
            fit,
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
        phase.guess(inertial.constant(), &phase.p, h, &mut delta[0]);
    }

    /// Moves to q1 = q0 + Δ and p1 = p0 + (D₁ + D₂)L_d, if they are numbers and the mass matrix has kept its
    /// orientation.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn arrive(&mut self, statistics: &mut Statistics) -> Result<(), StepFailure> {
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

impl<const S: usize, F: Frequency, E> Scheme for Galerkin<S, F, E> {
    fn order(&self) -> usize {
        2 * S - 2
    }
    fn is_symmetric(&self) -> bool {
        true
    }
    fn preserved_form(&self) -> PreservedForm {
        match self.frequency.reading() {
            None => PreservedForm::Canonical,
            Some(_) => PreservedForm::Nothing,
        }
    }
}

impl<const NODES: usize, S: System, F, T: Real, E: NodeEvaluation<NODES, S, T>> Carries<S, T>
    for Galerkin<NODES, F, E>
{
    type Memory = GalerkinMemory<NODES, S, T, E::Interior>;
}

impl<const NODES: usize, S, F, T: Real, E> Method<S, T> for Galerkin<NODES, F, E>
where
    S: RegularLagrangian<T>,
    F: FrequencyIn<T>,
    E: NodeEvaluation<NODES, S, T, Interior: InteriorNodes<NODES, S, T>>,
{
    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        self.validate::<S, T>(system)?;
        GalerkinMemory::new(self, system, [q, v], [t, h])
    }

    #[inline]
    fn step(
        &self,
        system: &S,
        memory: &mut Self::Memory,
        q: &mut Vector<S, T>,
        t: T,
        h: T,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.take(system, memory, q, [t, h], statistics)
    }

    fn velocity(
        &self,
        system: &S,
        memory: &Self::Memory,
        q: &Vector<S, T>,
        t: T,
        v: &mut Vector<S, T>,
    ) -> Result<(), StepFailure> {
        memory.velocity(system, q, t, v)
    }
}

impl<const NODES: usize, S, F, T: Real, E> VariableStep<S, T> for Galerkin<NODES, F, E>
where
    S: RegularLagrangian<T>,
    F: FrequencyIn<T>,
    E: NodeEvaluation<NODES, S, T, Interior: InteriorNodes<NODES, S, T>>,
{
}

impl<const NODES: usize, S, T: Real, E> FreeFlight<S, T> for Galerkin<NODES, Unfitted, E>
where
    S: NondegenerateLagrangian<T>,
    E: NodeEvaluation<NODES, S, T, Interior: InteriorNodes<NODES, S, T>>,
{
    fn depart(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        self.validate::<S, T>(system)?;
        GalerkinMemory::new(self, system, [q, v], [t, h])
    }
    fn fly(
        &self,
        system: &S,
        memory: &mut Self::Memory,
        q: &mut Vector<S, T>,
        interval: [T; 2],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.take(system, memory, q, interval, statistics)
    }
    fn velocity_in_flight(
        &self,
        system: &S,
        memory: &Self::Memory,
        q: &Vector<S, T>,
        t: T,
        v: &mut Vector<S, T>,
    ) -> Result<(), StepFailure> {
        memory.velocity(system, q, t, v)
    }
    fn kick(&self, memory: &mut Self::Memory, impulse: &[T], velocity: &[T]) {
        memory.jump(impulse, velocity);
    }
}
