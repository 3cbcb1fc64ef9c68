//! Whether a step on constraints of positions has come out where the motion leads.
//!
//! The equations of a step on constraints have several solutions: a rod that is to have its length again may
//! point to one side or to the other, and a bead on a narrow loop may sit on its far side. Along the motion
//! gradients turn little in a step, and the displacement Δ leads along the constraints.
//!
//! Of constraints of the velocities none of this holds. How much a row of A turns depends on how the
//! constraints are written: those of a disc that rolls are the same in the directions of the room and of the
//! disc, and one row is turned around in the first and none in the second. A displacement with A Δ = −h b
//! leads off the rows of A wherever b is not zero.

use crate::error::StepFailure;
use crate::mechanics::constraints::scales::scale_coordinates;
use crate::mechanics::constraints::{At, ConstrainedLagrangian, Constraints, Multipliers};
use crate::memory::{Memory, lasting};
use crate::space::RowMatrix;
use crate::space::sink::Places;
use crate::{ConstrainedSystem, Real, Space, System, Vector};

type Rows<S, T> = <<S as System>::Space as Space>::Rows<<S as ConstrainedSystem>::Multipliers, T>;

/// The gradients of the constraints at the current point.
#[derive(Debug)]
pub(crate) struct Gradients<S: ConstrainedSystem, T: Real> {
    here: Rows<S, T>,
    /// At the end of a step.
    next: Rows<S, T>,
    /// One over the diagonal of the mass matrix where the run began: the metric.
    weights: Vector<S, T>,
    /// Work space.
    values: Multipliers<S, T>,
}

impl<S: ConstrainedSystem, T: Real> Memory<T> for Gradients<S, T> {
    lasting!(T; part here, numbers weights);
}

impl<S: ConstrainedLagrangian<T>, T: Real> Gradients<S, T> {
    /// At a point, where the velocity is `v`.
    pub(crate) fn new(system: &S, at: At<'_, T>, v: &[T]) -> Self {
        let mut weights: Vector<S, T> = system.space().vector();
        scale_coordinates(system, [at.q, v], at.t, &mut weights);
        weights.iter_mut().for_each(|weight| *weight *= *weight);
        let mut values: Multipliers<S, T> = system.multipliers().vector();
        let mut rows = || {
            system.space().rows(system.multipliers(), |visit| {
                let mut places = Places(|k: usize, j: usize, _: T| visit(k, j));
                S::Kind::forces(system, at.q, at.t, &mut values, &mut places);
            })
        };
        let (mut here, next): (Rows<S, T>, _) = (rows(), rows());
        S::Kind::forces(system, at.q, at.t, &mut values, &mut here);
        Self { here, next, weights, values }
    }

    /// Goes to another point.
    pub(crate) fn stand(&mut self, system: &S, At { q, t }: At<'_, T>) {
        self.here.clear();
        S::Kind::forces(system, q, t, &mut self.values, &mut self.here);
    }

    /// Looks at the end of a step from `q0` with Δ = `increment`.
    ///
    /// # Errors
    /// [`StepFailure::Turned`].
    pub(crate) fn check(
        &mut self,
        system: &S,
        q0: &[T],
        increment: &[T],
        at: At<'_, T>,
    ) -> Result<(), StepFailure> {
        let Self { here, next, weights, values } = self;
        next.clear();
        S::Kind::forces(system, at.q, at.t, values, next);
        let squared = |x: &[T]| {
            x.iter().zip(weights.iter()).fold(T::lift(0.0), |sum, (&x, &weight)| sum + x * x / weight)
        };
        let length = squared(increment);
        let is_here = |&constraint: &usize| {
            let square = here.dot(constraint, here, weights);
            // What is no number is no turn by less than a right angle either.
            next.dot(constraint, here, weights) > T::lift(0.0)
                && (!S::AUTONOMOUS
                    || is_along(here.times(constraint, increment), square, length, || squared(q0)))
        };
        match (0..values.len()).find(|constraint| !is_here(constraint)) {
            None => Ok(()),
            Some(constraint) => Err(StepFailure::Turned { constraint }),
        }
    }

    /// Moves to the end of the step.
    pub(crate) fn keep(&mut self) {
        core::mem::swap(&mut self.here, &mut self.next);
    }
}

/// Of the size of q: what may be rounding of a displacement.
const ROUNDING: f64 = 1e-12;

/// Whether a displacement makes an angle of at most 45° with a constraint that does not move: |G Δ|² ≤ ½
/// |G|²|Δ|², from its product G Δ with the gradient, |G|², |Δ|² and, where that is needed, |q|², in the
/// metric of the mass matrix. A rod that turns by an angle makes half that angle.
pub(crate) fn is_along<T: Real>(product: T, square: T, length: T, size: impl FnOnce() -> T) -> bool {
    // Twice the square of the part of Δ that is across the constraint.
    let across = product * product / (T::lift(0.5) * square);
    across <= length || across <= length + T::lift(2.0 * ROUNDING * ROUNDING) * size()
}
