//! Which L and which options are stepped, by the traits of a method.

use super::attempt::Attempt;
use super::coefficients::Fit;
use super::interior::InteriorNodes;
use super::memory::{Displacements, GalerkinMemory, Path};
use super::{Galerkin, NodeEvaluation};
use crate::discrete::Interval;
use crate::discrete::frequency::{self, Frequency, Local, Reading, Unfitted};
use crate::error::{StartError, StepFailure};
use crate::mechanics::pattern::coupled_by_second_derivatives;
use crate::memory::aside;
use crate::methods::flight::Flight;
use crate::methods::step::{Carried, PhaseMemory};
use crate::methods::{Carries, FreeFlight, Here, Method, PreservedForm, Step, VariableStep, scheme};
use crate::scalar::simd::wide_if;
use crate::solve::{Ladder, Solver};
use crate::state::history::History;
use crate::{Coupled, NondegenerateLagrangian, Real, RegularLagrangian, Space, System, Vector};

/// Without a heap, a matrix of fixed size is made on the stack, where threads have two megabytes.
const MOST_BYTES: usize = 1 << 20;

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

impl<const NODES: usize, S, F, T: Real, E> Flight<S, T> for Galerkin<NODES, F, E>
where
    S: NondegenerateLagrangian<T>,
    F: Frequency,
    E: NodeEvaluation<NODES, S, T, Interior: InteriorNodes<NODES, S, T>>,
{
    fn carried(memory: &Self::Memory) -> &Carried<S, T> {
        &memory.carried
    }

    fn depart(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        frequency::admit(&self.frequency, system)?;
        let goes = matches!(self.frequency.reading(), None | Some(Reading::Averaged));
        StartError::unless_it(goes, "this reading of the frequency", "take Reading::Averaged")?;
        let goes = S::SEPARABLE || self.solver != Solver::FixedPoint;
        let reason = "it needs L = ½ v·M v − V(q, t) with a constant matrix M, and forces without \
                      velocities; take Solver::Newton";
        StartError::unless_it(goes, "Solver::FixedPoint", reason)?;
        self.stopping.validate()?;
        let solver = match self.solver.in_numbers::<T>() {
            // Any L has no fixed point.
            Solver::Automatic if !S::SEPARABLE => Solver::Newton,
            solver => solver,
        };
        let goes = solver == Solver::FixedPoint || size_of::<Coupled<NODES, S, T>>() <= MOST_BYTES;
        let reason = "its matrix for so many nodes and coordinates takes more than a megabyte of the \
                      stack; take Solver::FixedPoint, fewer nodes, or a heap: the feature `alloc`";
        StartError::unless_it(goes, "Newton's method", reason)?;
        let (space, eliminates) = (system.space(), S::SEPARABLE && F::UNFITTED);
        let histories = || Displacements { nodes: core::array::from_fn(|_| History::new(system, None)) };
        let reading = self.frequency.reading();
        let carried = Carried::new(system, q, v, t, self.summation)?;
        let mut path = Path {
            interior: eliminates.then(|| E::Interior::new(system)),
            displacements: (!eliminates || matches!(solver, Solver::Newton | Solver::NewtonKrylov))
                .then(histories),
            fit: Fit::new(),
            ends: [Local::new(system), Local::new(system)],
            unknowns: space.vectors(),
            residuals: space.vectors(),
            weights: space.vectors(),
        };
        if reading.is_none() {
            path.fit.to(self.frequency.fixed::<T>() * h).map_err(StartError::Starter)?;
        }
        // With nine nodes it is some 80 n² numbers for n coordinates.
        let matrix = || coupled_by_second_derivatives(system, [q, v], t, NODES - 1, solver.storing());
        let ladder = Ladder::new(solver, || aside(matrix));
        Ok(PhaseMemory { carried, ladder, own: path })
    }

    #[inline]
    fn fly(&self, step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let Step { system, q, t, h, statistics } = step;
        let PhaseMemory { carried, ladder, own: path } = memory;
        let (interval, Self { frequency, stopping, .. }) = (Interval { t, h }, self);
        let budget = ladder.budget(stopping.max_iterations, 24 + q.len());
        wide_if!(E::WIDE, {
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
        })
    }
}

impl<const NODES: usize, S, F, T: Real, E> Method<S, T> for Galerkin<NODES, F, E>
where
    S: RegularLagrangian<T>,
    F: Frequency,
    E: NodeEvaluation<NODES, S, T, Interior: InteriorNodes<NODES, S, T>>,
{
    type Suited<X> = S::Suited<X>;

    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        self.depart(system, q, v, t, h)
    }

    #[inline]
    fn step(&self, step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        self.fly(step, memory)
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
    fn kick(&self, memory: &mut Self::Memory, impulse: &[T], velocity: &[T]) {
        memory.carried.phase.jump(impulse, velocity);
        if let Some(interior) = &mut memory.own.interior {
            interior.remember(T::lift(0.0));
        }
    }
}
