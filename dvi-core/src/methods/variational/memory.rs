//! What a run of the quadrature family carries from step to step.

use super::coefficients::Coefficients;
use super::{Step, Variational};
use crate::discrete::NodeWork;
use crate::discrete::frequency::{FrequencyIn, Local};
use crate::discrete::quadrature::Rule;
use crate::error::{StartError, StepFailure};
use crate::mechanics::pattern::of_second_derivatives;
use crate::mechanics::phase::{Inertial, PhasePoint};
use crate::solve::{Ladder, Solver};
use crate::state::memory::{Memory, lasting};
use crate::{Lagrangian, Linear, NondegenerateLagrangian, Real, Space, System, Vector};

/// The phase point of a run of the quadrature family, its interpolation and its work space.
#[derive(Debug)]
pub struct VariationalMemory<S: System, T: Real> {
    /// The latest coefficients of the interpolation.
    pub(super) coefficients: Coefficients<T>,
    /// The frequencies at both ends of the step.
    pub(super) ends: [Local<S, T>; 2],
    pub(super) phase: PhasePoint<S, T>,
    pub(super) inertial: Inertial<S, T>,
    /// With the matrix of Newton's method; explicit steps do not use it.
    pub(super) ladder: Ladder<Linear<S, T>>,
    pub(super) work: Work<S, T>,
    /// In which iterations judge coordinates; work space.
    pub(super) weights: Vector<S, T>,
}

/// What a step changes, the coordinates among it.
pub(super) struct Parts<'a, S: System, T: Real> {
    pub(super) coefficients: &'a mut Coefficients<T>,
    pub(super) ends: &'a mut [Local<S, T>; 2],
    pub(super) phase: &'a mut PhasePoint<S, T>,
    pub(super) inertial: &'a mut Inertial<S, T>,
    pub(super) work: &'a mut Work<S, T>,
    pub(super) weights: &'a mut Vector<S, T>,
    pub(super) q: &'a mut Vector<S, T>,
}

/// Vectors that are written before they are read in each step.
#[derive(Debug)]
pub(super) struct Work<S: System, T: Real> {
    pub(super) node: NodeWork<S, T>,
    pub(super) increment: Vector<S, T>,
    pub(super) next: Vector<S, T>,
    /// The residual, then the correction, or a force.
    pub(super) trial: Vector<S, T>,
    /// (D₁ + D₂)L_d
    pub(super) sum: Vector<S, T>,
}

impl<S: NondegenerateLagrangian<T>, T: Real> VariationalMemory<S, T> {
    /// p = ∂L/∂v at the current point, one entry per coordinate.
    pub fn p(&self) -> &[T] {
        &self.phase.p
    }

    /// Sets `v` to the velocity at the present point.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn velocity(&self, system: &S, q: &[T], t: T, v: &mut [T]) -> Result<(), StepFailure> {
        self.inertial.velocity(system, &self.phase, q, t, v)
    }

    pub(super) fn new<F: FrequencyIn<T>, R: Rule>(
        system: &S,
        method: &Variational<F, R>,
        q: &Vector<S, T>,
        v: &[T],
        t: T,
        h: T,
    ) -> Result<Self, StartError> {
        let explicit = method.is_explicit();
        let solver = match (method.needs_forces_only::<S, T>(), method.solver.in_numbers::<T>()) {
            (true, _) if explicit => Solver::FixedPoint,
            (true, solver) => solver,
            // Forces that depend on velocities leave the fixed point as it is.
            (false, Solver::Automatic) if !S::SEPARABLE && method.has_fixed_point::<S, T>() => {
                Solver::Automatic
            }
            // Any L has no fixed point.
            (false, Solver::Automatic | Solver::Newton) => Solver::Newton,
            (false, solver @ (Solver::FixedPoint | Solver::NewtonKrylov)) => solver,
        };
        let reading = method.frequency.reading();
        let mut coefficients = Coefficients::linear(&method.rule);
        if reading.is_none() {
            coefficients.fix(&Step { system, method, t, h }).map_err(StartError::Starter)?;
        }
        Ok(Self {
            coefficients,
            ends: [Local::new(system, reading), Local::new(system, reading)],
            phase: PhasePoint::new(system, q, v, t, method.summation)?,
            inertial: Inertial::new(system, q, v, t)?,
            ladder: Ladder::new(solver, || of_second_derivatives(system, q, v, t, solver.storing())),
            work: Work::new(system),
            weights: system.space().vector(),
        })
    }
}

impl<S: System, T: Real> Memory<T> for VariationalMemory<S, T> {
    lasting!(T; part phase, part inertial, part ladder);
}

impl<S: Lagrangian<T>, T: Real> Work<S, T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn new(system: &S) -> Self {
        let vector = || system.space().vector();
        Self {
            node: NodeWork::new(system),
            increment: vector(),
            next: vector(),
            trial: vector(),
            sum: vector(),
        }
    }
}
