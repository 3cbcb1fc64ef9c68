//! Which members of the family, with which options, go with a system.

use super::{Sigma, Start};
use crate::error::StartError;
use crate::mechanics::VectorField;
use crate::scalar::norm;
use crate::space::sink::Places;
use crate::state::summation::Summation;
use crate::system::spinors;
use crate::{DegenerateLagrangian, Real, Scalar, Space, Vector};

impl<T: Real> Sigma<T> {
    pub(super) fn validate(&self, is_affine: bool) -> Result<(), StartError> {
        let in_range = self.sigma >= T::lift(0.0) && self.sigma <= T::lift(1.0);
        if !in_range {
            let value = norm::reported(self.sigma);
            return Err(StartError::Parameter { name: "sigma", value, range: "0 <= sigma <= 1" });
        }
        if self.summation == Summation::Compensated && (!is_affine || self.is_end()) {
            let reason = "it is for affine one-forms and 0 < sigma < 1";
            return Err(StartError::Unsupported { option: "Summation::Compensated", reason });
        }
        match self.parasitic_limit {
            Some(value) if value.is_nan() || value <= 0.0 => {
                Err(StartError::Parameter { name: "parasitic_limit", value, range: "positive" })
            }
            _ => self.stopping.validate(),
        }
    }

    /// Whether the lengths of unit vectors are kept, if there are some: the implicit midpoint rule keeps
    /// them.
    pub(super) fn keeps_lengths<S: DegenerateLagrangian<T>>(&self) -> Result<(), StartError> {
        let is_midpoint_rule = S::AFFINE && self.is_midpoint() && self.start == Start::Consistent;
        if is_midpoint_rule {
            return Ok(());
        }
        spinors::refuse::<S>("a `Sigma` that is not the implicit midpoint rule")
    }

    /// Whether the equations of σ = 0 or 1 can have a solution: not if a row of Dα is zero.
    pub(super) fn go_with<S: DegenerateLagrangian<T>>(
        &self,
        system: &S,
        q: &Vector<S, T>,
        t: T,
    ) -> Result<(), StartError> {
        self.keeps_lengths::<S>()?;
        // The matrix of σ = 1 is that of the end of a step.
        if !self.is_end() || (self.sigma == T::lift(1.0) && !S::AFFINE) {
            return Ok(());
        }
        let (zero, mut sizes): (T, Vector<S, T>) = (T::lift(0.0), system.space().vector());
        let mut sink = Places(|row: usize, _: usize, entry: T| {
            sizes[row] = norm::larger(sizes[row], Scalar::abs(entry));
        });
        system.one_form_jacobian(q, t, T::lift(1.0), zero, &mut sink);
        if sizes.contains(&zero) {
            // Where Ω is singular too, none of these helps.
            VectorField::new(system, q, t).map_err(StartError::Starter)?;
            let reason = "the one-form has no component along some coordinate, or one that is constant at the start, so \
                          that the equations are singular; take `Sigma::midpoint()`, `OneStep` if the system is in its class, or a \
                          one-form such as (p dq - q dp) / 2 in place of p dq";
            return Err(StartError::Unsupported { option: "sigma = 0 or 1", reason });
        }
        Ok(())
    }
}
