//! Schemes that are the discrete Euler–Lagrange equations of a discrete Lagrangian.

use super::Scheme;
#[cfg(doc)]
use super::{Constrained, EnergyLimit, Method};
use crate::discrete::DiscreteLagrangian;
use crate::error::StartError;
use crate::system::Same;
use crate::{Lagrangian, Real};

/// A scheme whose steps are the discrete Euler–Lagrange equations of a discrete Lagrangian.
///
/// Its [`TangentMap`](crate::diagnostics::TangentMap) and its
/// [`LyapunovExponent`](crate::diagnostics::LyapunovExponent) come from its second derivatives.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no discrete Lagrangian",
    label = "its steps are not variational, it has a frequency, or displacements within a step",
    note = "such methods are `Sigma`, `Variational` without a frequency, and `EnergyLimit` around them",
    note = "the tangent map of any method is its run in dual numbers"
)]
pub trait VariationalMethod<S: Lagrangian<T>, T: Real>: Scheme {
    /// What one interval contributes.
    type DiscreteLagrangian: DiscreteLagrangian<S, T>;

    /// The discrete Lagrangian on `system`, with the storage that it needs.
    fn discrete_lagrangian(&self, system: &S) -> Self::DiscreteLagrangian;
}

/// A variational method that [`Constrained`] takes steps of: all that this knows of it is its discrete
/// Lagrangian.
///
/// [`EnergyLimit`] is none, because its limit would not be watched: it goes around `Constrained`, as in
/// `EnergyLimit { method: Constrained::new(…), limit }`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no discrete Lagrangian that `Constrained` could take steps of",
    label = "its steps are not variational, it has a frequency, or it watches steps",
    note = "such a method is `Variational`; `EnergyLimit` goes around `Constrained`"
)]
pub trait InnerScheme<S: Lagrangian<T>, T: Real>: VariationalMethod<S, T> {
    /// As [`Method::Suited`].
    type Suited<M>: Same<M, As = M>;

    /// Whether the compiler knows that without constraints the steps would be those of Störmer and Verlet.
    const IS_VERLET: bool;

    /// The discrete Lagrangian on `system`, if the options are in range and none is set that has no effect
    /// there.
    ///
    /// # Errors
    /// [`StartError::Parameter`] names the option that is out of range, [`StartError::Unsupported`] what
    /// does not go with the system, or is not left at its default.
    fn inside(&self, system: &S) -> Result<Self::DiscreteLagrangian, StartError>;
}
