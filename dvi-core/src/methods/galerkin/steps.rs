//! Steps with interior displacements: which equations are solved, and how.

use super::interior::InteriorNodes;
use super::memory::GalerkinMemory;
use super::{Galerkin, NodeEvaluation, eliminated, fitted, general};
use crate::discrete::frequency::{self, Frequency, FrequencyIn, Reading, Unfitted};
use crate::error::{StartError, StepFailure};
use crate::methods::collocation::steps::Steps;
use crate::methods::{Carries, Clock, FreeFlight, Method, PreservedForm, Scheme, VariableStep};
use crate::solve::Solver;
use crate::state::Statistics;
use crate::{NondegenerateLagrangian, Real, RegularLagrangian, System, Vector};

/// One step: where it starts, how long it is, and which method takes it.
#[derive(Debug)]
pub(super) struct Step<'a, const NODES: usize, S, F, T, E> {
    pub(super) system: &'a S,
    pub(super) method: &'a Galerkin<NODES, F, E>,
    pub(super) t: T,
    pub(super) h: T,
}

impl<const NODES: usize, S: NondegenerateLagrangian<T>, F, T: Real, E> Step<'_, NODES, S, F, T, E> {
    /// The time of a node.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn node_time(&self, c: f64) -> T {
        self.t + T::lift(c) * self.h
    }
}

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
    fn start<S: NondegenerateLagrangian<T>, T: Real, I: InteriorNodes<NODES, S, T>>(
        &self,
        system: &S,
        q: &Vector<S, T>,
        v: &[T],
        [t, h]: [T; 2],
    ) -> Result<GalerkinMemory<NODES, S, T, I>, StartError>
    where
        F: FrequencyIn<T>,
    {
        self.validate::<S, T>(system)?;
        GalerkinMemory::new(&Step { system, method: self, t, h }, q, v)
    }

    /// Takes up to `count` steps, and returns how many have succeeded.
    fn take_several<S: NondegenerateLagrangian<T>, T: Real, I: InteriorNodes<NODES, S, T>>(
        &self,
        system: &S,
        memory: &mut GalerkinMemory<NODES, S, T, I>,
        q: &mut Vector<S, T>,
        clock: Clock<T>,
        count: u64,
        statistics: &mut Statistics,
    ) -> (u64, Result<(), StepFailure>)
    where
        F: FrequencyIn<T>,
    {
        I::run(Steps::new(
            clock,
            count,
            #[cfg_attr(not(debug_assertions), inline(always))]
            |interval| self.take(system, memory, q, interval, statistics),
        ))
    }

    /// Takes a step from t to t + h.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take<S: NondegenerateLagrangian<T>, T: Real, I: InteriorNodes<NODES, S, T>>(
        &self,
        system: &S,
        memory: &mut GalerkinMemory<NODES, S, T, I>,
        q: &mut Vector<S, T>,
        [t, h]: [T; 2],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure>
    where
        F: FrequencyIn<T>,
    {
        let step = Step { system, method: self, t, h };
        let GalerkinMemory { ladder, path } = memory;
        let budget = ladder.budget(self.stopping.max_iterations, 24 + q.len());
        let q0 = &*q;
        ladder.solve(
            path,
            statistics,
            #[cfg_attr(not(debug_assertions), inline(always))]
            |path, statistics| {
                if S::SEPARABLE && F::UNFITTED {
                    eliminated::fixed_point(&step, path, q0, budget, statistics)
                } else if S::SEPARABLE {
                    fitted::fixed_point(&step, path, q0, budget, statistics)
                } else {
                    Err(StepFailure::NO_MATRIX)
                }
            },
            |path, newton, guess, statistics| {
                general::newton(&step, path, q0, newton, guess, statistics)?;
                if S::SEPARABLE && F::UNFITTED {
                    eliminated::settle(&step, path, statistics)?;
                }
                Ok(())
            },
        )?;
        if S::SEPARABLE && F::UNFITTED {
            eliminated::finish(&step, path, q, statistics)
        } else if S::SEPARABLE {
            fitted::finish(&step, path, q, statistics)
        } else {
            general::finish(&step, path, q, statistics)
        }
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
        self.start(system, q, v, [t, h])
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
        self.take_several(system, memory, q, Clock::new(t, h), 1, statistics).1
    }

    fn steps(
        &self,
        system: &S,
        memory: &mut Self::Memory,
        q: &mut Vector<S, T>,
        clock: Clock<T>,
        count: u64,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let (taken, result) = self.take_several(system, memory, q, clock, count, statistics);
        statistics.steps += taken;
        result
    }

    fn velocity(
        &self,
        system: &S,
        memory: &Self::Memory,
        q: &Vector<S, T>,
        t: T,
        v: &mut Vector<S, T>,
    ) -> Result<(), StepFailure> {
        memory.path.velocity(system, q, t, v)
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
        self.start(system, q, v, [t, h])
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
        memory.path.velocity(system, q, t, v)
    }
    fn kick(&self, memory: &mut Self::Memory, impulse: &[T], velocity: &[T]) {
        memory.path.jump(impulse, velocity);
    }
}
