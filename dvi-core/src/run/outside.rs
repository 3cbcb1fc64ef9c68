//! Whether a step has failed because a function that holds data is not known where the motion goes.
//!
//! Outside of its table such a function is not a number, and what fails then is an iteration or a coordinate. The points at
//! which it was evaluated are gone, so they are looked for along the straight line from the last good state with its velocity.

use crate::error::{OutsideError, StepFailure};
use crate::methods::Method;
use crate::run::Stepper;
use crate::space::elimination::eliminate;
use crate::{Lagrangian, Real, Space, Vector, Weights};

/// The parts of a step at which is looked: stages lie within the step, guesses and iterates beyond it.
const PARTS: [f64; 6] = [0.0, 0.25, 0.5, 0.75, 1.0, 2.0];

impl<S: Lagrangian<T>, M: Method<S, T>, T: Real> Stepper<'_, S, M, T> {
    /// Why the step from time `t` to `t + h` has failed.
    pub(super) fn explained(&self, failure: StepFailure, t: T, h: T) -> StepFailure {
        // What a number that is none can lead to.
        let is_suspect = matches!(
            failure,
            StepFailure::NotFinite { .. }
                | StepFailure::NotConverged { .. }
                | StepFailure::Singular { .. }
                | StepFailure::Frequency { .. }
                | StepFailure::StepLength { .. }
                | StepFailure::Density { .. }
        );
        if !S::HAS_SCALAR_FIELDS || !is_suspect {
            return failure;
        }
        self.outside(t, h).map_or(failure, StepFailure::Outside)
    }

    /// The first function that is not known on the way of a step from time `t` to `t + h`.
    fn outside(&self, t: T, h: T) -> Option<OutsideError> {
        let velocity = self.present_velocity(t);
        PARTS.into_iter().find_map(|part| {
            let elapsed = T::lift(part) * h;
            let mut q = self.q.clone();
            for (q, &v) in q.iter_mut().zip(velocity.iter()) {
                if part > 0.0 {
                    *q += elapsed * v;
                }
            }
            self.system.outside(&q, &velocity, t + elapsed).filter(|outside| outside.value.is_finite())
        })
    }

    /// The velocity at the current point; of a degenerate system that of Ω q' = ∇H, without ∂α/∂t. It is not a number, or zero,
    /// where it is not determined.
    fn present_velocity(&self, t: T) -> Vector<S, T> {
        let space = self.system.space();
        let mut velocity = space.vector();
        if S::REGULAR {
            if self.velocity(t, &mut velocity).is_err() {
                velocity.fill(T::lift(0.0));
            }
            return velocity;
        }
        let (rest, mut unused, mut omega) = (space.vector(), space.vector(), space.matrix());
        let [zero, one] = [0.0, 1.0].map(T::lift);
        // ∂²L/∂qⁱ∂vʲ is ∂ᵢαⱼ, and ∂L/∂q at rest is −∇H.
        let weights = Weights { qq: zero, qv: one, vq: -one, vv: zero };
        self.system.linearize(&self.q, &rest, t, weights, &mut velocity, &mut unused, &mut omega);
        match eliminate(&mut omega, &mut velocity) {
            Ok(()) => velocity.iter_mut().for_each(|v| *v = -*v),
            Err(_) => velocity.fill(zero),
        }
        velocity
    }
}
