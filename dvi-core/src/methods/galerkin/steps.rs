//! Which L and which options are stepped, by the traits of a method.

use super::attempt::Attempt;
use super::interior::InteriorNodes;
use super::memory::GalerkinMemory;
use super::{Galerkin, NodeEvaluation};
use crate::discrete::Interval;
use crate::discrete::frequency::{self, Frequency, Reading, Unfitted};
use crate::error::{StartError, StepFailure};
use crate::methods::step::PhaseMemory;
use crate::methods::{Carries, FreeFlight, Here, Method, PreservedForm, Step, VariableStep, scheme};
use crate::scalar::simd::widest_if;
use crate::solve::Solver;
use crate::{NondegenerateLagrangian, Real, RegularLagrangian, System, Vector};

impl<const NODES: usize, F: Frequency, E> Galerkin<NODES, F, E> {
    pub(super) fn validate<S: NondegenerateLagrangian<T>, T: Real>(
        &self,
        system: &S,
    ) -> Result<(), StartError> {
        let unsupported = |option, reason| Err(StartError::Unsupported { option, reason });
        frequency::admit(&self.frequency, system)?;
        if let Some(Reading::LeftFrozen | Reading::Variational) = self.frequency.reading() {
            return unsupported("this reading of the frequency", "take Reading::Averaged");
        }
        if !S::SEPARABLE && self.solver == Solver::FixedPoint {
            let reason = "it needs L = ½ v·M v − V(q, t) with a constant matrix M, and forces without velocities; take \
                          Solver::Newton";
            return unsupported("Solver::FixedPoint", reason);
        }
        self.stopping.validate()
    }

    /// Takes a step from t to t + h.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take<S: NondegenerateLagrangian<T>, T: Real>(
        &self,
        step: Step<'_, S, T>,
        memory: &mut GalerkinMemory<NODES, S, T, E::Interior>,
    ) -> Result<(), StepFailure>
    where
        E: NodeEvaluation<NODES, S, T, Interior: InteriorNodes<NODES, S, T>>,
    {
        let Step { system, q, t, h, statistics } = step;
        let PhaseMemory { carried, ladder, own: path } = memory;
        let (interval, Self { frequency, stopping, .. }) = (Interval { t, h }, self);
        let budget = ladder.budget(stopping.max_iterations, 24 + q.len());
        widest_if(
            E::WIDE,
            #[cfg_attr(not(debug_assertions), inline(always))]
            || {
                let mut step = Attempt {
                    system,
                    frequency,
                    stopping: *stopping,
                    interval,
                    q,
                    carried,
                    path,
                    by_newton: true,
                };
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

scheme! {
    [const S: usize, F: Frequency, E] Galerkin<S, F, E>, |method|
    order: 2 * S - 2,
    is_symmetric: true,
    preserved_form: match method.frequency.reading() {
        None => PreservedForm::Canonical,
        Some(_) => PreservedForm::Nothing,
    },
}

impl<const NODES: usize, S: System, F, T: Real, E: NodeEvaluation<NODES, S, T>> Carries<S, T>
    for Galerkin<NODES, F, E>
{
    type Memory = GalerkinMemory<NODES, S, T, E::Interior>;
}

impl<const NODES: usize, S, F, T: Real, E> Method<S, T> for Galerkin<NODES, F, E>
where
    S: RegularLagrangian<T>,
    F: Frequency,
    E: NodeEvaluation<NODES, S, T, Interior: InteriorNodes<NODES, S, T>>,
{
    type Suited<X> = S::Suited<X>;

    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        self.depart_from(system, [q, v], [t, h])
    }

    #[inline]
    fn step(&self, step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        self.take(step, memory)
    }

    fn velocity(&self, here: Here<'_, S, T>, memory: &Self::Memory, v: &mut [T]) -> Result<(), StepFailure> {
        memory.carried.velocity(here, v)
    }
}

impl<const NODES: usize, S, F, T: Real, E> VariableStep<S, T> for Galerkin<NODES, F, E>
where
    S: RegularLagrangian<T>,
    F: Frequency,
    E: NodeEvaluation<NODES, S, T, Interior: InteriorNodes<NODES, S, T>>,
{
    type SuitedToAnyStep<X> = <Self as Method<S, T>>::Suited<X>;
}

impl<const NODES: usize, S, T: Real, E> FreeFlight<S, T> for Galerkin<NODES, Unfitted, E>
where
    S: NondegenerateLagrangian<T>,
    E: NodeEvaluation<NODES, S, T, Interior: InteriorNodes<NODES, S, T>>,
{
    fn depart(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        self.depart_from(system, [q, v], [t, h])
    }
    fn fly(&self, step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        self.take(step, memory)
    }
    fn velocity_in_flight(
        &self,
        here: Here<'_, S, T>,
        memory: &Self::Memory,
        v: &mut [T],
    ) -> Result<(), StepFailure> {
        memory.carried.velocity(here, v)
    }
    fn kick(&self, memory: &mut Self::Memory, impulse: &[T], velocity: &[T]) {
        memory.carried.phase.jump(impulse, velocity);
        if let Some(interior) = &mut memory.own.interior {
            interior.remember(T::lift(0.0));
        }
    }
}
