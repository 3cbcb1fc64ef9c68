//! Which members of the family, with which options, go with a system.

use super::{Sigma, Start};
use crate::error::StartError;
use crate::mechanics::combination::{Combination, Product};
use crate::scalar::norm;
use crate::state::summation::Summation;
use crate::system::spinors;
use crate::{DegenerateLagrangian, Real, Vector};

impl<T: Real> Sigma<T> {
    /// Whether options are in range and go together, with each other and with the system at (`q`, `t`). The
    /// implicit midpoint rule alone keeps the lengths of unit vectors, and where Dα is not constant and
    /// antisymmetric, σ = ½ alone is zero-stable: of other members the matrix K'K⁻¹, by which a step
    /// multiplies the defect, has eigenvalues outside of the unit circle.
    pub(super) fn go_with<S: DegenerateLagrangian<T>>(
        &self,
        system: &S,
        q: &Vector<S, T>,
        t: T,
    ) -> Result<(), StartError> {
        let in_range = self.sigma >= T::lift(0.0) && self.sigma <= T::lift(1.0);
        StartError::unless(in_range, "sigma", norm::reported(self.sigma), "0 <= sigma <= 1")?;
        let goes = self.summation == Summation::Plain || (S::AFFINE && !self.is_end());
        let reason = "it is for affine one-forms and 0 < sigma < 1";
        StartError::unless_it(goes, "Summation::Compensated", reason)?;
        if let Some(limit) = self.parasitic_limit {
            StartError::unless(limit > 0.0, "parasitic_limit", limit, "positive")?;
        }
        self.stopping.validate()?;
        if self.is_midpoint_rule::<S>() {
            return Ok(());
        }
        spinors::refuse::<S>("a `Sigma` that is not the implicit midpoint rule")?;
        let symmetric_part = Combination { a: T::lift(1.0), b: T::lift(1.0) };
        if self.is_midpoint() || (S::AFFINE && Product::new(system, q, t, symmetric_part).vanishes(system)) {
            return Ok(());
        }
        let reason = "it is for one-forms with a constant antisymmetric Dα: of others, the parasitic mode grows by a \
                      factor in each step; take `Sigma::midpoint()`, `OneStep` if the system is in its class, or a \
                      one-form such as (p dq - q dp) / 2 in place of p dq";
        Err(StartError::Unsupported { option: "a sigma that is not 1/2", reason })
    }

    pub(super) fn is_midpoint_rule<S: DegenerateLagrangian<T>>(&self) -> bool {
        S::AFFINE && self.is_midpoint() && self.start == Start::Consistent
    }
}
