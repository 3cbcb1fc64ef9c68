//! What a run of the quadrature family carries from step to step.

use super::coefficients::Coefficients;
use super::{Step, Variational};
use crate::discrete::frequency::{FrequencyIn, Local};
use crate::discrete::quadrature::Rule;
use crate::error::StartError;
use crate::memory::{Memory, lasting};
use crate::methods::step::{Carried, ladder};
use crate::solve::{Ladder, Solver};
use crate::{Linear, NondegenerateLagrangian, Real, System, Vector};

/// The phase point of a run of the quadrature family, its interpolation and its work space.
#[derive(Debug)]
pub struct VariationalMemory<S: System, T: Real> {
    /// The latest coefficients of the interpolation.
    pub(super) coefficients: Coefficients<T>,
    /// The frequencies at both ends of the step.
    pub(super) ends: [Local<S, T>; 2],
    pub(super) carried: Carried<S, T>,
    /// With the matrix of Newton's method; explicit steps do not use it.
    pub(super) ladder: Ladder<Linear<S, T>>,
}

impl<S: NondegenerateLagrangian<T>, T: Real> VariationalMemory<S, T> {
    /// p = ∂L/∂v at the current point, one entry per coordinate.
    pub fn p(&self) -> &[T] {
        &self.carried.phase.p
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
            carried: Carried::new(system, q, v, t, method.summation)?,
            ladder: ladder(system, q, v, t, solver),
        })
    }
}

impl<S: System, T: Real> Memory<T> for VariationalMemory<S, T> {
    lasting!(T; part carried, part ladder);
}
