//! ∂²L/∂v∂v a = ∂L/∂q + F − ∂²L/∂v∂q v − ∂²L/∂t∂v + Gᵀλ, with the G a that keeps the constraints: for those
//! of positions G a + v·∂²g/∂q∂q v + 2 ∂²g/∂t∂q v + ∂²g/∂t∂t = 0.

use super::Rates;
use super::hamilton::SecondOrder;
use crate::error::StepFailure;
use crate::mechanics::constraints::{
    At, Bordered, ConstrainedLagrangian, ConstraintSolver, Lower, Multipliers,
};
use crate::scalar::norm;
use crate::system::{Holonomic, Nonholonomic};
use crate::{HolonomicLagrangian, NonholonomicLagrangian, Real, Space, Vector};

/// An acceleration, and λ.
type Accelerated<S, T> = (Vector<S, T>, Multipliers<S, T>);

/// Returns the acceleration of the motion through (`q`, `v`, `t`), and λ.
///
/// # Errors
/// [`StepFailure::RedundantConstraint`]; [`StepFailure::Singular`] where the mass matrix is.
pub(crate) fn acceleration<S: ConstrainedLagrangian<T>, T: Real>(
    system: &S,
    [q, v]: [&[T]; 2],
    t: T,
) -> Result<Accelerated<S, T>, StepFailure> {
    let mut acceleration: Vector<S, T> = system.space().vector();
    let mut multipliers: Multipliers<S, T> = system.multipliers().vector();
    let mut solver = ConstraintSolver::new(system, q, v, t);
    let upper = SecondOrder { system, q, v, t };
    let (lower, active) = (Lower::Acceleration(At { q, t }, v), multipliers.len());
    let equations = &mut Bordered { system, upper, lower, multipliers: &multipliers, forces: None, active };
    solver.solve(equations, T::lift(1.0))?;
    let (found, of_constraints) = solver.parts(q.len());
    norm::finite(found)?;
    acceleration.copy_from_slice(found);
    // In the equations Gᵀλ stands on the left.
    multipliers.iter_mut().zip(of_constraints).for_each(|(multiplier, &found)| *multiplier = -found);
    Ok((acceleration, multipliers))
}

impl<S: HolonomicLagrangian<T>, T: Real> Rates<S, T> for Holonomic {
    fn rates(system: &S, q: &Vector<S, T>, v: &[T], t: T) -> Result<Vector<S, T>, StepFailure> {
        acceleration(system, [q, v], t).map(|(acceleration, _)| acceleration)
    }
}

impl<S: NonholonomicLagrangian<T>, T: Real> Rates<S, T> for Nonholonomic {
    fn rates(system: &S, q: &Vector<S, T>, v: &[T], t: T) -> Result<Vector<S, T>, StepFailure> {
        acceleration(system, [q, v], t).map(|(acceleration, _)| acceleration)
    }
}
