//! Schemes that are the discrete Euler–Lagrange equations of a discrete Lagrangian.

use super::Scheme;
use crate::discrete::{DiscreteLagrangian, Nodes};
use crate::{Lagrangian, Real};

/// A scheme whose steps are the discrete Euler–Lagrange equations of a discrete Lagrangian.
///
/// Its [`TangentMap`](crate::diagnostics::TangentMap) and its
/// [`LyapunovExponent`](crate::diagnostics::LyapunovExponent) come from its second derivatives.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no discrete Lagrangian",
    label = "its steps are not variational, it has a frequency, or displacements within a step",
    note = "such methods are `Sigma` and `Variational` without a frequency",
    note = "the tangent map of any method is its run in dual numbers"
)]
pub trait VariationalMethod<S: Lagrangian<T>, T: Real>: Scheme {
    /// Where L is evaluated.
    type Nodes: Nodes<T>;

    /// The discrete Lagrangian on `system`, with the storage that it needs.
    fn discrete_lagrangian(&self, system: &S) -> DiscreteLagrangian<S, Self::Nodes, T>;
}
