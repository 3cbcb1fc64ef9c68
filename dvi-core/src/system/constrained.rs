//! How many constraints a system has.

use crate::Space;
use crate::system::System;

/// A system with constraints or impacts, whatever numbers it is computed in: how many there are.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no constraints and no impacts",
    label = "its attribute has none of `constraint`, `nonholonomic` and `impact`",
    note = "regular systems without these are stepped by `Variational`, `Galerkin` or `Newmark`, and \
        degenerate ones by `Sigma` or `OneStep`"
)]
pub trait ConstrainedSystem: System {
    /// The space of the Lagrange multipliers λ: one for each constraint, or for each surface of impacts.
    type Multipliers: Space;
    /// The space of (q, λ).
    type Augmented: Space;

    /// The space of the multipliers of this system. Its dimension m is the number of constraints or
    /// surfaces.
    fn multipliers(&self) -> Self::Multipliers;
    /// The space of (q, λ), of dimension n + m.
    fn augmented(&self) -> Self::Augmented;
}
