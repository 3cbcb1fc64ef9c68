//! How far a step turns the gradients of the constraints.
//!
//! The equations of a step on constraints have several solutions: a rod that is to have its length again may point to one side or to
//! the other. Along the motion the gradients turn little in a step.

use crate::error::StepFailure;
use crate::mechanics::constraints::{At, ConstrainedLagrangian, Constraints, Multipliers, mass_matrix};
use crate::space::RowMatrix;
use crate::space::sink::Places;
use crate::state::memory::{Memory, lasting};
use crate::{ConstrainedSystem, Real, Scalar, Space, System, Vector};

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
    lasting!(T; part here);
}

impl<S: ConstrainedLagrangian<T>, T: Real> Gradients<S, T> {
    /// At a point, with a velocity there.
    pub(crate) fn new(system: &S, at: At<'_, T>, v: &[T]) -> Self {
        let [mut weights, mut l_q, mut l_v]: [Vector<S, T>; 3] =
            core::array::from_fn(|_| system.space().vector());
        let diagonal = |i: usize, j: usize, entry: T| {
            if i == j {
                weights[i] += entry;
            }
        };
        system.linearize(at.q, v, at.t, mass_matrix(), &mut l_q, &mut l_v, &mut Places(diagonal));
        for weight in weights.iter_mut() {
            let mass = Scalar::abs(*weight);
            // A zero on the diagonal says nothing of the metric.
            *weight = T::lift(1.0) / if mass > T::lift(0.0) { mass } else { T::lift(1.0) };
        }
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

    /// Looks at the gradients at the end of a step.
    ///
    /// # Errors
    /// [`StepFailure::Turned`].
    pub(crate) fn check(&mut self, system: &S, at: At<'_, T>) -> Result<(), StepFailure> {
        let Self { here, next, weights, values } = self;
        next.clear();
        S::Kind::forces(system, at.q, at.t, values, next);
        // What is no number is no turn by less than a right angle either.
        let is_small = |&constraint: &usize| next.dot(constraint, here, weights) > T::lift(0.0);
        match (0..values.len()).find(|constraint| !is_small(constraint)) {
            None => Ok(()),
            Some(constraint) => Err(StepFailure::Turned { constraint }),
        }
    }

    /// Moves to the end of the step.
    pub(crate) fn keep(&mut self) {
        core::mem::swap(&mut self.here, &mut self.next);
    }
}
