//! What the compiler knows of constraints of the velocities, a(q, v, t) = 0.

use crate::Scalar;
use crate::space::Sink;
use crate::system::{ConstrainedSystem, NondegenerateLagrangian, Nonholonomic, System};

/// A regular Lagrangian with nonholonomic constraints a(q, v, t) = A(q, t) v + b(q, t) = 0, declared by
/// `nonholonomic = …`: a blade that does not slip to the side, a disc that rolls.
///
/// ```math
/// \frac{\mathrm{d}}{\mathrm{d}t} \frac{\partial L}{\partial v} = \frac{\partial L}{\partial q} + F + A^\mathsf{T} \lambda, \qquad
/// A(q, t)\, v + b(q, t) = 0
/// ```
///
/// By the principle of Lagrange and d'Alembert the forces of the constraints do no work on the displacements
/// that they admit (Bloch 2015, chapter 5). Constraint k is counted from 0 in the order of declaration, the
/// members of `nonholonomic(i in …)` one after the other in its place. All functions take slices of n
/// coordinates and m constraints.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no nonholonomic constraints in `{T}`",
    label = "its attribute has no `nonholonomic`, or a parameter is no number",
    note = "regular systems without constraints are stepped by `Variational`, `Galerkin` or `Newmark`, \
        and degenerate ones by `Sigma` or `OneStep`"
)]
pub trait NonholonomicLagrangian<T: Scalar = f64>:
    NondegenerateLagrangian<T> + ConstrainedSystem + System<Kind = Nonholonomic>
{
    /// Sets `out` to a(q, v, t), one entry for each constraint, in the units of its formula.
    fn velocity_constraint(&self, q: &[T], v: &[T], t: T, out: &mut [T]);
    /// Sets `out` to a(q, v, t), and **adds** the entries of w₀ ∂a/∂q + w₁ ∂a/∂v to `sink`, with a row for
    /// each constraint and a column for each coordinate. ∂a/∂v is A.
    fn velocity_constraint_jacobian<K: Sink<T>>(
        &self,
        q: &[T],
        v: &[T],
        t: T,
        weights: [T; 2],
        out: &mut [T],
        sink: &mut K,
    );
    /// Sets `out` to v·∂a/∂q + ∂a/∂t: the rate of change of a along a motion with velocity `v` and without
    /// acceleration.
    fn velocity_constraint_rate(&self, q: &[T], v: &[T], t: T, out: &mut [T]);
}
