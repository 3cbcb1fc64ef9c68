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
use crate::memory::lasting;
use crate::space::RowMatrix;
use crate::{ConstrainedSystem, Real, Space, System, Vector};

type Rows<S, T> = <<S as System>::Space as Space>::Rows<<S as ConstrainedSystem>::Multipliers, T>;

/// What compares the gradients of the constraints at both ends of a step.
#[derive(Debug)]
pub(crate) struct Gradients<S: ConstrainedSystem, T: Real> {
    /// Work space: the gradients at both ends, and what comes with them.
    ends: [Rows<S, T>; 2],
    values: Multipliers<S, T>,
    /// One over the diagonal of the mass matrix where the run began: the metric.
    weights: Vector<S, T>,
}

lasting!([S: ConstrainedSystem, T: Real] Gradients<S, T>, T; numbers weights);

impl<S: ConstrainedLagrangian<T>, T: Real> Gradients<S, T> {
    /// At a point, where the velocity is `v`.
    pub(crate) fn new(system: &S, at: At<'_, T>, v: &[T]) -> Self {
        let mut weights: Vector<S, T> = system.space().vector();
        scale_coordinates(system, [at.q, v], at.t, &mut weights);
        weights.iter_mut().for_each(|weight| *weight *= *weight);
        let mut values: Multipliers<S, T> = system.multipliers().vector();
        let mut rows = || {
            system.space().rows(system.multipliers(), |visit| {
                let mut places = |k: usize, j: usize, _: T| visit(k, j);
                S::Kind::forces(system, at.q, at.t, &mut values, &mut places);
            })
        };
        Self { ends: [rows(), rows()], values, weights }
    }

    /// Looks at a step with Δ = `increment` from one point to another.
    ///
    /// # Errors
    /// [`StepFailure::Turned`].
    pub(crate) fn check(
        &mut self,
        system: &S,
        points: [At<'_, T>; 2],
        increment: &[T],
    ) -> Result<(), StepFailure> {
        let Self { ends, values, weights } = self;
        for (rows, At { q, t }) in ends.iter_mut().zip(points) {
            rows.clear();
            S::Kind::forces(system, q, t, values, rows);
        }
        let [here, next] = ends;
        let squared = |x: &[T]| {
            x.iter().zip(weights.iter()).fold(T::lift(0.0), |sum, (&x, &weight)| sum + x * x / weight)
        };
        let length = squared(increment);
        let is_here = |&constraint: &usize| {
            let square = here.dot(constraint, here, weights);
            // What is no number is no turn by less than a right angle either.
            next.dot(constraint, here, weights) > T::lift(0.0)
                && (!S::AUTONOMOUS
                    || is_along(here.times(constraint, increment), square, length, || squared(points[0].q)))
        };
        match (0..values.len()).find(|constraint| !is_here(constraint)) {
            None => Ok(()),
            Some(constraint) => Err(StepFailure::Turned { constraint }),
        }
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
