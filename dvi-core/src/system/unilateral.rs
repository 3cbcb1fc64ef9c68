//! What the compiler knows of impacts: gap functions g(q, t), which no motion makes negative.

use crate::Scalar;
use crate::space::Sink;
use crate::system::{ConstrainedSystem, NondegenerateLagrangian, Same, System, Unilateral};

/// A regular Lagrangian whose motion stays where g(q, t) ≥ 0, declared by `impact = g`. Between impacts it
/// is that of L; where a gap function g becomes zero, the momentum jumps by a multiple of ∂g/∂q.
///
/// ```math
/// p^+ - p^- = \lambda\, \frac{\partial g}{\partial q}, \qquad E^+ - E^- = -\lambda\, \frac{\partial g}{\partial t}, \qquad \lambda > 0
/// ```
///
/// These are the conditions under which the action is stationary with respect to place and time of the
/// impact, with the energy $`E = v \cdot \partial L/\partial v - L`$ (Fetecau, Marsden, Ortiz & West 2003,
/// section 2.3; with a wall that moves, by the same variation along g(q, t) = 0).
///
/// Surface k is counted from 0 in the order of declaration, the members of `impact(i in …)` one after the
/// other in its place. All functions take slices of n coordinates and m gaps.
///
/// ```
/// use dvi_core::prelude::*;
///
/// #[lagrangian(coordinates(y), lagrangian = dot(y).powi(2) / 2.0 - y, impact = y)]
/// struct Ball;
///
/// let start = BallState { y: 1.0, dot_y: 0.0 };
/// let mut run = Integrator::new(&Ball, Impacts::reflecting(Variational::midpoint()), 0.01, start)?;
/// run.take_steps(1000)?;
/// let mut gap = [0.0];
/// Ball.gap(run.q(), run.time(), &mut gap);
/// assert!(gap[0] > 0.0 && (run.energy() - 1.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no impacts in `{T}`",
    label = "its attribute has no `impact`, or a parameter is no number",
    note = "regular systems without impacts are stepped by `Variational`, `Galerkin` or `Newmark`, and \
        degenerate ones by `Sigma` or `OneStep`"
)]
pub trait UnilateralLagrangian<T: Scalar = f64>:
    NondegenerateLagrangian<T> + ConstrainedSystem + System<Kind = Unilateral>
{
    /// `M`, which steps systems of this kind: see [`Method::Suited`](crate::methods::Method::Suited).
    type Suited<M>: Same<M, As = M>;

    /// Sets `out` to g(q, t), one entry for each surface, in the units of its formula.
    fn gap(&self, q: &[T], t: T, out: &mut [T]);
    /// Sets `out` to g(q, t), and **adds** the entries of ∂g/∂q to `sink`, with a row for each surface and a
    /// column for each coordinate.
    fn gap_jacobian<K: Sink<T>>(&self, q: &[T], t: T, out: &mut [T], sink: &mut K);
    /// Sets `out` to v·∂g/∂q + ∂g/∂t, the rate of change of g along a motion with velocity `v`.
    fn gap_rate(&self, q: &[T], v: &[T], t: T, out: &mut [T]);
}
