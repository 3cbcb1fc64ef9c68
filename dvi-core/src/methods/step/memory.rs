//! What a run on T*Q carries from step to step.

use crate::discrete::NodeWork;
use crate::error::{StartError, StepFailure};
use crate::mechanics::pattern::of_second_derivatives;
use crate::mechanics::phase::{Inertial, PhasePoint};
use crate::memory::{Memory, lasting};
use crate::methods::Here;
use crate::solve::{Ladder, Solver};
use crate::state::summation::Summation;
use crate::{Lagrangian, Linear, NondegenerateLagrangian, Real, Space, System, Vector};

/// What a run carries from step to step, and its work space.
#[derive(Debug)]
pub struct Carried<S: System, T: Real> {
    pub(in crate::methods) phase: PhasePoint<S, T>,
    pub(in crate::methods) inertial: Inertial<S, T>,
    pub(in crate::methods) work: Work<S, T>,
}

/// Vectors that are written before they are read in each step.
#[derive(Debug)]
pub(in crate::methods) struct Work<S: System, T: Real> {
    pub(in crate::methods) node: NodeWork<S, T>,
    /// Δ
    pub(in crate::methods) increment: Vector<S, T>,
    pub(in crate::methods) next: Vector<S, T>,
    /// The residual, then the correction, or a force.
    pub(in crate::methods) trial: Vector<S, T>,
    /// s
    pub(in crate::methods) sum: Vector<S, T>,
    /// In which iterations judge coordinates.
    pub(super) weights: Vector<S, T>,
}

impl<S: Lagrangian<T>, T: Real> Work<S, T> {
    #[inline]
    pub(in crate::methods) fn new(system: &S) -> Self {
        let vector = || system.space().vector();
        Self {
            node: NodeWork::new(system),
            increment: vector(),
            next: vector(),
            trial: vector(),
            sum: vector(),
            weights: vector(),
        }
    }
}

impl<S: NondegenerateLagrangian<T>, T: Real> Carried<S, T> {
    /// Of a run from (`q`, `v`, `t`).
    ///
    /// # Errors
    /// [`StartError::Starter`] where momentum or force is no number, or the mass matrix is singular.
    pub(in crate::methods) fn new(
        system: &S,
        q: &[T],
        v: &[T],
        t: T,
        summation: Summation,
    ) -> Result<Self, StartError> {
        Ok(Self {
            phase: PhasePoint::new(system, q, v, t, summation)?,
            inertial: Inertial::new(system, q, v, t)?,
            work: Work::new(system),
        })
    }

    /// Sets `v` to the velocity at the present point.
    #[inline]
    pub(in crate::methods) fn velocity(&self, here: Here<'_, S, T>, v: &mut [T]) -> Result<(), StepFailure> {
        let Here { system, q, t } = here;
        self.inertial.velocity(system, &self.phase, q, t, v)
    }
}

lasting!([S: System, T: Real] Carried<S, T>, T; part phase, part inertial);

/// What a run carries, how its steps are solved, and what its method has of its own.
#[derive(Debug)]
pub struct PhaseMemory<S: System, T: Real, X = (), N = Linear<S, T>> {
    pub(in crate::methods) carried: Carried<S, T>,
    /// With the matrix of Newton's method; explicit steps do not use it.
    pub(in crate::methods) ladder: Ladder<N>,
    pub(in crate::methods) own: X,
}

impl<S: NondegenerateLagrangian<T>, T: Real, X, N> PhaseMemory<S, T, X, N> {
    /// p = ∂L/∂v at the current point, one entry per coordinate.
    pub fn p(&self) -> &[T] {
        &self.carried.phase.p
    }
}

impl<S: NondegenerateLagrangian<T>, T: Real, X> PhaseMemory<S, T, X> {
    /// Of a run from (`q`, `v`, `t`).
    pub(in crate::methods) fn new(
        system: &S,
        (q, v, t): (&[T], &[T], T),
        (solver, summation): (Solver, Summation),
        own: X,
    ) -> Result<Self, StartError> {
        let newton = || of_second_derivatives(system, q, v, t, solver.storing());
        let carried = Carried::new(system, q, v, t, summation)?;
        Ok(Self { carried, ladder: Ladder::new(solver, newton), own })
    }
}

lasting!([S: System, T: Real, X: Memory<T>, N] PhaseMemory<S, T, X, N>, T;
    part carried, part own, part ladder);
