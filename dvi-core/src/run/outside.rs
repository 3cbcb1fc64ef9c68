//! Whether a step has failed because a function that holds data is not known where the step has looked.
//!
//! Outside of its table such a function is not a number, and what fails then is an iteration or a
//! coordinate. The points at which it was evaluated are gone, so they are looked for along the parabola q +
//! vτ + ½aτ² from the last good state, with its velocity and, of a regular system, its acceleration at rest.
//! On a manifold, where no parabola leads on, they are looked for at that state.

use crate::error::{OutsideError, StepFailure};
use crate::methods::Method;
use crate::run::Stepper;
use crate::space::elimination::eliminate;
use crate::system::Factor;
use crate::{Lagrangian, Matrix, Real, Space, Vector, Weights};

/// The parts of a step at which is looked: stages lie within the step, guesses and iterates beyond it.
const PARTS: [f64; 8] = [0.0, 0.125, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0];

/// Of the step, over which ∂α/∂t is a difference quotient.
const SHORT: f64 = 1.0 / 1024.0;

/// A failure by its name, of so many coordinates, and whether a number that is none can have led to it.
fn named(failure: StepFailure, dimension: usize) -> (StepFailure, bool) {
    let failure = match failure {
        // A matrix with entries that are no numbers is not singular: a formula has left its domain.
        StepFailure::Singular { column, pivot, .. } if pivot.is_nan() && column < dimension => {
            StepFailure::NotFinite { coordinate: column, value: pivot }
        }
        other => other,
    };
    let is_suspect = match failure {
        StepFailure::NotFinite { .. }
        | StepFailure::NotConverged { .. }
        | StepFailure::Singular { .. }
        | StepFailure::RedundantConstraint { .. }
        | StepFailure::Turned { .. }
        | StepFailure::Branch
        | StepFailure::OffConstraint { .. }
        | StepFailure::UndefinedConstraint { .. }
        | StepFailure::Frequency { .. }
        | StepFailure::StepLength { .. }
        | StepFailure::LeftDomain
        | StepFailure::Gap { .. }
        | StepFailure::Density { .. } => true,
        StepFailure::TimeRate { rate } => rate.is_nan(),
        StepFailure::Tolerance { error, .. } => error.is_nan(),
        StepFailure::EnergyStep { defect, .. } => defect.is_nan(),
        StepFailure::Energy { now, .. } => now.is_nan(),
        StepFailure::Orientation { after, .. } => after.is_nan(),
        StepFailure::Resonance { .. }
        | StepFailure::Pattern { .. }
        | StepFailure::ParasiticMode { .. }
        | StepFailure::Accumulation { .. }
        | StepFailure::Contact { .. }
        | StepFailure::HalfTurn { .. }
        | StepFailure::Unreachable { .. }
        | StepFailure::UndefinedEvent { .. }
        | StepFailure::Hops { .. }
        | StepFailure::Seam { .. }
        | StepFailure::Outside(_) => false,
    };
    (failure, is_suspect)
}

impl<S: Lagrangian<T>, M: Method<S, T>, T: Real> Stepper<S, M, T> {
    /// Why the step from time `t` to `t + h` has failed.
    pub(super) fn explained(&self, system: &S, failure: StepFailure, t: T, h: T) -> StepFailure {
        let (failure, is_suspect) = named(failure, self.q.len());
        if !S::HAS_SCALAR_FIELDS || !is_suspect {
            return failure;
        }
        self.outside(system, t, h).map_or(failure, StepFailure::Outside)
    }

    /// The first function that is not known on the way of a step from time `t` to `t + h`.
    fn outside(&self, system: &S, t: T, h: T) -> Option<OutsideError> {
        let is_flat = S::REPORT.coordinates.iter().all(|block| block.factor == Factor::Line);
        let parts = if is_flat { &PARTS[..] } else { &PARTS[..1] };
        let [velocity, acceleration] = self.motion(system, t, h);
        parts.iter().find_map(|&part| {
            let elapsed = T::lift(part) * h;
            let (mut q, mut v) = (self.q.clone(), velocity.clone());
            if part > 0.0 {
                let half = T::lift(0.5) * elapsed * elapsed;
                for i in 0..q.len() {
                    q[i] += elapsed * velocity[i] + half * acceleration[i];
                    v[i] += elapsed * acceleration[i];
                }
            }
            system.outside(&q, &v, t + elapsed).filter(|outside| outside.value.is_finite())
        })
    }

    /// Velocity and acceleration at the current point; zero where they are not determined.
    fn motion(&self, system: &S, t: T, h: T) -> [Vector<S, T>; 2] {
        let space = system.space();
        let [mut velocity, nothing, rest]: [Vector<S, T>; 3] = space.vectors();
        let (none, one) = (Weights::none(), T::lift(1.0));
        let mut matrix = space.matrix();
        if S::REGULAR {
            if self.velocity(system, t, &mut velocity).is_err() {
                velocity.fill(T::lift(0.0));
            }
            // M a = ∂L/∂q, but for what velocities add.
            let (force, _) = linearized(system, [&self.q, &rest], t, Weights::mass(), &mut matrix);
            return [velocity, solved(matrix, force)];
        }
        // ∂²L/∂qⁱ∂vʲ is ∂ᵢαⱼ, ∂L/∂q at rest is −∇H, and ∂L/∂v is α.
        let weights = Weights { qv: one, vq: -one, ..none };
        let short = T::lift(SHORT) * h;
        let (_, later) = linearized(system, [&self.q, &rest], t + short, none, &mut space.matrix());
        let (mut source, now) = linearized(system, [&self.q, &rest], t, weights, &mut matrix);
        for i in 0..source.len() {
            source[i] = (later[i] - now[i]) / short - source[i];
        }
        [solved(matrix, source), nothing]
    }
}

/// ∂L/∂q and ∂L/∂v, with the weighted second derivatives added to `matrix`.
fn linearized<S: Lagrangian<T>, T: Real>(
    system: &S,
    [q, v]: [&Vector<S, T>; 2],
    t: T,
    weights: Weights<T>,
    matrix: &mut Matrix<S, T>,
) -> (Vector<S, T>, Vector<S, T>) {
    let (mut l_q, mut l_v) = (system.space().vector(), system.space().vector());
    system.linearize(q, v, t, weights, &mut l_q, &mut l_v, matrix);
    (l_q, l_v)
}

/// The solution of matrix · x = b, or zero.
fn solved<T: Real, V: core::ops::DerefMut<Target = [T]>>(
    mut matrix: impl core::ops::DerefMut<Target = [T]>,
    mut b: V,
) -> V {
    if eliminate(&mut matrix, &mut [], &mut b).is_err() || b.iter().any(|b| !b.is_finite()) {
        b.fill(T::lift(0.0));
    }
    b
}
