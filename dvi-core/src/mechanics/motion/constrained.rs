//! ∂²L/∂v∂v a = ∂L/∂q + F − ∂²L/∂v∂q v − ∂²L/∂t∂v + Gᵀλ, with the G a that keeps the constraints: for those
//! of positions G a + v·∂²g/∂q∂q v + 2 ∂²g/∂t∂q v + ∂²g/∂t∂t = 0.

use super::Rates;
use super::hamilton::SecondOrder;
use crate::error::StepFailure;
use crate::mechanics::constraints::{At, Bordered, ConstrainedLagrangian, ConstraintSolver, OfAcceleration};
use crate::scalar::norm;
use crate::system::{Holonomic, Nonholonomic};
use crate::{HolonomicLagrangian, NonholonomicLagrangian, Real, Space, Vector};

/// Returns the acceleration of the motion through (`q`, `v`, `t`), and sets `multipliers` to λ.
///
/// # Errors
/// [`StepFailure::RedundantConstraint`]; [`StepFailure::Singular`] where the mass matrix is.
pub(crate) fn acceleration<S: ConstrainedLagrangian<T>, T: Real>(
    system: &S,
    [q, v]: [&[T]; 2],
    t: T,
    multipliers: &mut [T],
) -> Result<Vector<S, T>, StepFailure> {
    let [mut acceleration, mut l_v]: [Vector<S, T>; 2] = system.space().vectors();
    let mut solver = ConstraintSolver::new(system, q, v, t);
    multipliers.fill(T::lift(0.0));
    let upper = SecondOrder { system, q, v, t, l_v: &mut l_v };
    let lower = OfAcceleration { system, at: At { q, t }, v };
    let active = multipliers.len();
    let equations = &mut Bordered { system, upper, lower, multipliers, forces: None, active };
    solver.solve(equations, T::lift(1.0))?;
    let (found, of_constraints) = solver.parts(q.len());
    norm::finite(found)?;
    acceleration.copy_from_slice(found);
    // In the equations Gᵀλ stands on the left.
    for (multiplier, &found) in multipliers.iter_mut().zip(of_constraints) {
        *multiplier = -found;
    }
    Ok(acceleration)
}

fn rates<S: ConstrainedLagrangian<T>, T: Real>(
    system: &S,
    q: &[T],
    v: &[T],
    t: T,
) -> Result<[Vector<S, T>; 2], StepFailure> {
    let mut velocity: Vector<S, T> = system.space().vector();
    velocity.copy_from_slice(v);
    let mut multipliers = system.multipliers().vector();
    let acceleration = acceleration(system, [q, v], t, &mut multipliers)?;
    Ok([velocity, acceleration])
}

impl<S: HolonomicLagrangian<T>, T: Real> Rates<S, T> for Holonomic {
    fn rates(system: &S, q: &Vector<S, T>, v: &[T], t: T) -> Result<[Vector<S, T>; 2], StepFailure> {
        rates(system, q, v, t)
    }
}

impl<S: NonholonomicLagrangian<T>, T: Real> Rates<S, T> for Nonholonomic {
    fn rates(system: &S, q: &Vector<S, T>, v: &[T], t: T) -> Result<[Vector<S, T>; 2], StepFailure> {
        rates(system, q, v, t)
    }
}
