//! What a run of the quadrature family carries from step to step.

use super::Variational;
use super::coefficients::Coefficients;
use crate::discrete::frequency::{Frequency, FrequencyIn, Local, Reading};
use crate::discrete::quadrature::Rule;
use crate::error::StartError;
use crate::memory::{Memory, lasting};
use crate::methods::step::PhaseMemory;
use crate::solve::Solver;
use crate::{NondegenerateLagrangian, Real, System};

/// The interpolation of a run.
#[derive(Debug)]
pub struct Interpolation<S: System, T: Real> {
    /// The coefficients for a frequency that is given.
    pub(super) given: Coefficients<T>,
    /// The frequencies at both ends of the step.
    pub(super) ends: [Local<S, T>; 2],
}

impl<S: System, T: Real> Memory<T> for Interpolation<S, T> {
    lasting!(T;);
}

impl<F: Frequency, R: Rule> Variational<F, R> {
    /// The memory of a run from (`q`, `v`, `t`) whose steps have the length `h`.
    pub(super) fn depart_from<S: NondegenerateLagrangian<T>, T: Real>(
        &self,
        system: &S,
        (q, v, t): (&[T], &[T], T),
        h: T,
    ) -> Result<PhaseMemory<S, T, Interpolation<S, T>>, StartError>
    where
        F: FrequencyIn<T>,
    {
        self.validate::<S, T>(system)?;
        let reading = self.frequency.reading();
        let solver = match self.solver.in_numbers::<T>() {
            _ if S::SEPARABLE && self.is_explicit() => Solver::FixedPoint,
            // Without a constant M there is no fixed point, and a variational frequency is stiff in Δ.
            Solver::Automatic if !S::CONSTANT_MASS || reading == Some(Reading::Variational) => {
                Solver::Newton
            }
            solver => solver,
        };
        let mut given = Coefficients::linear(&self.rule);
        if reading.is_none() {
            given.fix(self, h).map_err(StartError::Starter)?;
        }
        let own = Interpolation { given, ends: [Local::new(system), Local::new(system)] };
        PhaseMemory::new(system, (q, v, t), (solver, self.summation), own)
    }
}
