//! The growth of a perturbation beside the run of a member, for methods that have tangent maps.

use std::vec::Vec;

use crate::Lagrangian;
use crate::diagnostics::LyapunovExponent;
use crate::discrete::DiscreteLagrangian;
use crate::error::StepError;
use crate::methods::{Method, VariationalMethod};
use crate::run::Integrator;

/// A [`LyapunovExponent`]. It hides the discrete Lagrangian of the method.
pub(super) trait Growth<'a, S: Lagrangian, M: Method<S, f64>> {
    fn take_steps(&mut self, run: &mut Integrator<&'a S, M>, count: u64) -> Result<(), StepError>;
    fn exponent(&self) -> Option<f64>;
    fn save(&self) -> Vec<f64>;
    fn load(&mut self, saved: &[f64]) -> Option<()>;
}

impl<'a, S, M, L> Growth<'a, S, M> for LyapunovExponent<S, L>
where
    S: Lagrangian,
    M: Method<S, f64> + VariationalMethod<S, f64, DiscreteLagrangian = L>,
    L: DiscreteLagrangian<S, f64>,
{
    fn take_steps(&mut self, run: &mut Integrator<&'a S, M>, count: u64) -> Result<(), StepError> {
        (0..count).try_for_each(|_| self.advance(run))
    }

    fn exponent(&self) -> Option<f64> {
        LyapunovExponent::exponent(self)
    }

    fn save(&self) -> Vec<f64> {
        LyapunovExponent::save(self)
    }

    fn load(&mut self, saved: &[f64]) -> Option<()> {
        LyapunovExponent::load(self, saved)
    }
}
