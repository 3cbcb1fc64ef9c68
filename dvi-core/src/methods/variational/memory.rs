//! What a run of the quadrature family carries from step to step.

use super::Variational;
use super::coefficients::Coefficients;
use crate::discrete::frequency::{FrequencyIn, Local, Reading};
use crate::discrete::quadrature::Rule;
use crate::error::StartError;
use crate::memory::{Memory, lasting};
use crate::methods::step::{Carried, ladder};
use crate::solve::{Ladder, Solver};
use crate::{Linear, NondegenerateLagrangian, Real, System, Vector};

/// The phase point of a run of the quadrature family, its interpolation and its work space.
#[derive(Debug)]
pub struct VariationalMemory<S: System, T: Real> {
    /// The coefficients for a frequency that is given.
    pub(super) given: Coefficients<T>,
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
        let reading = method.frequency.reading();
        let solver = match method.solver.in_numbers::<T>() {
            _ if S::SEPARABLE && method.is_explicit() => Solver::FixedPoint,
            // Without a constant M there is no fixed point, and a variational frequency is stiff in Δ.
            Solver::Automatic if !S::CONSTANT_MASS || reading == Some(Reading::Variational) => {
                Solver::Newton
            }
            solver => solver,
        };
        let mut given = Coefficients::linear(&method.rule);
        if reading.is_none() {
            given.fix(method, h).map_err(StartError::Starter)?;
        }
        Ok(Self {
            given,
            ends: [Local::new(system, reading), Local::new(system, reading)],
            carried: Carried::new(system, q, v, t, method.summation)?,
            ladder: ladder(system, q, v, t, solver),
        })
    }
}

impl<S: System, T: Real> Memory<T> for VariationalMemory<S, T> {
    lasting!(T; part carried, part ladder);
}
