//! How many constraints a system has.

use crate::Space;
use crate::system::System;

/// A system with constraints, whatever numbers it is computed in: how many there are.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no constraints",
    label = "its attribute has neither `constraint` nor `nonholonomic`",
    note = "regular systems without constraints are stepped by `Variational`, `Galerkin` or `Newmark`"
)]
pub trait ConstrainedSystem: System {
    /// The space of the Lagrange multipliers λ: one for each constraint.
    type Multipliers: Space;
    /// The space of (q, λ).
    type Augmented: Space;

    /// The space of the multipliers of this system. Its dimension m is the number of constraints.
    fn multipliers(&self) -> Self::Multipliers;
    /// The space of (q, λ), of dimension n + m.
    fn augmented(&self) -> Self::Augmented;
}
