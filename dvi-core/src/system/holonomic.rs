//! What the compiler knows of holonomic constraints g(q, t) = 0.

use crate::Scalar;
use crate::space::Sink;
use crate::system::{ConstrainedSystem, Holonomic, NondegenerateLagrangian, System};

/// A regular Lagrangian with holonomic constraints g(q, t) = 0, declared by `constraint = …`.
///
/// ```math
/// \frac{\mathrm{d}}{\mathrm{d}t} \frac{\partial L}{\partial v} = \frac{\partial L}{\partial q} + F + G^\mathsf{T} \lambda, \qquad
/// g(q, t) = 0, \qquad G = \frac{\partial g}{\partial q}
/// ```
///
/// Constraint k is counted from 0 in the order of declaration, the members of `constraint(i in …)` one after
/// the other in its place. All functions take slices of n coordinates and m constraints.
///
/// ```
/// use dvi_core::prelude::*;
///
/// #[lagrangian(
///     coordinates(x, y),
///     lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - y,
///     constraint = x * x + y * y - 1.0,
/// )]
/// struct Rod;
///
/// let mut g = [0.0_f64];
/// Rod.constraint(&[0.6, -0.8], 0.0, &mut g);
/// assert!(g[0].abs() < 1e-15); // the rod has length 1
/// let start = RodState { x: 0.6, y: -0.8, dot_x: 0.0, dot_y: 0.0 };
/// let mut run = Integrator::new(&Rod, Rattle::default(), 0.01, start)?;
/// run.take_steps(1000)?;
/// assert!((run.state().x.hypot(run.state().y) - 1.0).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no constraints of positions in `{T}`",
    label = "its attribute has no `constraint`, or a parameter is no number",
    note = "regular systems without constraints are stepped by `Variational`, `Galerkin` or `Newmark`, \
        and degenerate ones by `Sigma` or `OneStep`",
    note = "systems with `nonholonomic = …` are stepped by `Constrained` with any rule"
)]
pub trait HolonomicLagrangian<T: Scalar = f64>:
    NondegenerateLagrangian<T> + ConstrainedSystem + System<Kind = Holonomic>
{
    /// Sets `out` to g(q, t), one entry for each constraint, in the units of its formula.
    fn constraint(&self, q: &[T], t: T, out: &mut [T]);
    /// Sets `out` to g(q, t), and **adds** the entries of G = ∂g/∂q to `sink`, with a row for each
    /// constraint and a column for each coordinate.
    fn constraint_jacobian<K: Sink<T>>(&self, q: &[T], t: T, out: &mut [T], sink: &mut K);
    /// Sets `out` to G v + ∂g/∂t, the rate of change of g along a motion with velocity `v`.
    fn constraint_rate(&self, q: &[T], v: &[T], t: T, out: &mut [T]);
    /// Sets `out` to v·∂²g/∂q∂q v + 2 ∂²g/∂t∂q v + ∂²g/∂t∂t: the second derivative of g along a motion with
    /// velocity `v` and without acceleration.
    fn constraint_curvature(&self, q: &[T], v: &[T], t: T, out: &mut [T]);
}
