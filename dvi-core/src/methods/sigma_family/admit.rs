//! Which members of the family, with which options, go with a system.

use super::{Sigma, Start};
use crate::error::StartError;
use crate::mechanics::VectorField;
use crate::scalar::norm;
use crate::state::summation::Summation;
use crate::system::spinors;
use crate::{DegenerateLagrangian, Real, Scalar, Space, Vector};

impl<T: Real> Sigma<T> {
    /// Whether options are in range and go together, and the lengths of unit vectors are kept, if there are
    /// some: the implicit midpoint rule keeps them.
    pub(super) fn validate<S: DegenerateLagrangian<T>>(&self) -> Result<(), StartError> {
        let in_range = self.sigma >= T::lift(0.0) && self.sigma <= T::lift(1.0);
        if !in_range {
            let value = norm::reported(self.sigma);
            return Err(StartError::Parameter { name: "sigma", value, range: "0 <= sigma <= 1" });
        }
        if self.summation == Summation::Compensated && (!S::AFFINE || self.is_end()) {
            let reason = "it is for affine one-forms and 0 < sigma < 1";
            return Err(StartError::Unsupported { option: "Summation::Compensated", reason });
        }
        match self.parasitic_limit {
            Some(value) if value.is_nan() || value <= 0.0 => {
                return Err(StartError::Parameter { name: "parasitic_limit", value, range: "positive" });
            }
            _ => self.stopping.validate()?,
        }
        if self.is_midpoint_rule::<S>() {
            return Ok(());
        }
        spinors::refuse::<S>("a `Sigma` that is not the implicit midpoint rule")
    }

    pub(super) fn is_midpoint_rule<S: DegenerateLagrangian<T>>(&self) -> bool {
        S::AFFINE && self.is_midpoint() && self.start == Start::Consistent
    }

    /// Whether its equations can have a solution too: those of σ = 0 or 1 not if a row of Dα is zero.
    pub(super) fn go_with<S: DegenerateLagrangian<T>>(
        &self,
        system: &S,
        q: &Vector<S, T>,
        t: T,
    ) -> Result<(), StartError> {
        self.validate::<S>()?;
        // The matrix of σ = 1 is that of the end of a step.
        if !self.is_end() || (self.sigma == T::lift(1.0) && !S::AFFINE) {
            return Ok(());
        }
        let (zero, mut sizes): (T, Vector<S, T>) = (T::lift(0.0), system.space().vector());
        let mut sink = |row: usize, _: usize, entry: T| {
            sizes[row] = norm::larger(sizes[row], Scalar::abs(entry));
        };
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
