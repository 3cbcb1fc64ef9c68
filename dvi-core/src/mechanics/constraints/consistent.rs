//! Whether a state is on the constraints, and the state on them that is near another one.

use crate::error::{StartError, StepFailure};
use crate::mechanics::constraints::{
    At, Bordered, ConstrainedLagrangian, ConstraintSolver, Constraints, Multipliers, OfVelocity,
};
use crate::mechanics::legendre;
use crate::scalar::norm::{self, reported};
use crate::solve::{Convergence, Stopping, iterate};
use crate::space::sink::Places;
use crate::space::{LinearEquations, Sink};
use crate::state::Statistics;
use crate::system::start::{evaluate, flatten, validate};
use crate::{Real, Space, State, Vector};

/// A start may be so far from the constraints, relative to its largest coordinate or velocity.
const TOLERANCE: f64 = 1e-8;

/// ∂²L/∂v∂v as A, and b = 0: the solution is the shortest change in the metric of the mass matrix.
struct Shortest<'a, S, T>(legendre::Equations<'a, S, T>);

impl<S: ConstrainedLagrangian<T>, T: Real> LinearEquations<T> for Shortest<'_, S, T> {
    fn evaluate<K: Sink<T>>(&mut self, b: &mut [T], sink: &mut K) -> Result<(), StepFailure> {
        self.0.evaluate(b, sink)?;
        b.fill(T::lift(0.0));
        Ok(())
    }
}

/// A state that is moved to the constraints.
struct Projection<'a, S: ConstrainedLagrangian<T>, T: Real> {
    system: &'a S,
    t: T,
    solver: ConstraintSolver<S, T>,
    none: Multipliers<S, T>,
    /// Work space: ∂L/∂q, and a momentum that is not used.
    work: [Vector<S, T>; 2],
}

impl<'a, S: ConstrainedLagrangian<T>, T: Real> Projection<'a, S, T> {
    fn new(system: &'a S, q: &[T], v: &[T], t: T) -> Self {
        let work = [0, 1].map(|_| system.space().vector());
        let solver = ConstraintSolver::new(system, q, v, t);
        Self { system, t, solver, none: system.multipliers().vector(), work }
    }

    /// By how much q is to be changed.
    fn of_position(&mut self, q: &[T], v: &[T]) -> Result<&[T], StepFailure> {
        let lower = OfPosition { system: self.system, at: At { q, t: self.t } };
        self.change([q, v], lower)
    }

    /// By how much v is to be changed.
    fn of_velocity(&mut self, q: &[T], v: &[T]) -> Result<&[T], StepFailure> {
        let lower = OfVelocity { system: self.system, at: At { q, t: self.t }, v };
        self.change([q, v], lower)
    }

    fn change(&mut self, [q, v]: [&[T]; 2], lower: impl LinearEquations<T>) -> Result<&[T], StepFailure> {
        let Self { system, t, solver, none, work: [l_q, p] } = self;
        let upper = Shortest(legendre::Equations { system: *system, points: [q, v, p], t: *t, l_q });
        let (multipliers, active) = (&**none, none.len());
        solver.solve(&mut Bordered { system: *system, upper, lower, multipliers, forces: None, active })?;
        let (change, _) = solver.parts(q.len());
        norm::finite(change)?;
        Ok(change)
    }

    /// The constraint whose value is farthest from zero, and that value.
    fn worst(&self, mut of: impl LinearEquations<T>) -> (usize, f64) {
        let mut values: Multipliers<S, T> = self.system.multipliers().vector();
        // None of what is evaluated here can fail.
        let evaluated = of.evaluate(&mut values, &mut Places(|_, _, _: T| {}));
        let mut worst = (0, if evaluated.is_ok() { 0.0 } else { f64::NAN });
        for (constraint, value) in values.iter().map(|&value| reported(value)).enumerate() {
            if value.is_nan() {
                return (constraint, value);
            }
            if value.abs() > f64::abs(worst.1) {
                worst = (constraint, value);
            }
        }
        worst
    }
}

/// What vanishes at a position.
struct OfPosition<'a, S, T> {
    system: &'a S,
    at: At<'a, T>,
}

impl<S: ConstrainedLagrangian<T>, T: Real> LinearEquations<T> for OfPosition<'_, S, T> {
    fn evaluate<K: Sink<T>>(&mut self, c: &mut [T], sink: &mut K) -> Result<(), StepFailure> {
        S::Kind::of_position(self.system, self.at.q, self.at.t, c, sink);
        Ok(())
    }
}

/// Whether a run can begin at (`q`, `v`, `t`).
///
/// # Errors
/// [`StartError::OffConstraint`] and [`StartError::AcrossConstraint`] with the constraint that is farthest from being kept;
/// [`StartError::Starter`] with the constraint that is redundant, or a singular mass matrix.
pub(crate) fn check<S: ConstrainedLagrangian<T>, T: Real>(
    system: &S,
    q: &[T],
    v: &[T],
    t: T,
) -> Result<(), StartError> {
    let mut projection = Projection::new(system, q, v, t);
    let (tolerance, at) = (T::lift(TOLERANCE), At { q, t });
    if S::Kind::OF_POSITIONS {
        let off = norm::largest(projection.of_position(q, v).map_err(StartError::Starter)?);
        if off > tolerance * norm::largest(q) {
            let (constraint, value) = projection.worst(OfPosition { system, at });
            return Err(StartError::OffConstraint { constraint, value });
        }
    }
    let across = norm::largest(projection.of_velocity(q, v).map_err(StartError::Starter)?);
    if across > tolerance * norm::largest(v) {
        let (constraint, rate) = projection.worst(OfVelocity { system, at, v });
        return Err(StartError::AcrossConstraint { constraint, rate });
    }
    Ok(())
}

/// See [`OnConstraints::projected`](super::OnConstraints::projected).
pub(crate) fn projected<S: ConstrainedLagrangian<T>, T: Real>(
    system: &S,
    t: T,
    state: &S::State<T>,
) -> Result<S::State<T>, StartError> {
    validate(system, t)?;
    let [mut q, mut v] = flatten(system, state)?;
    evaluate(system, &q, &v, t)?;
    let mut projection = Projection::new(system, &q, &v, t);
    if S::Kind::OF_POSITIONS {
        move_to(&mut projection, &mut q, &v)?;
    }
    // What vanishes is affine in v.
    let change = projection.of_velocity(&q, &v).map_err(StartError::Starter)?;
    for (v, &change) in v.iter_mut().zip(change) {
        *v -= change;
    }
    Ok(S::State::read(|block| system.block_len(block), &q, &v))
}

/// Moves q to the constraints.
fn move_to<S: ConstrainedLagrangian<T>, T: Real>(
    projection: &mut Projection<'_, S, T>,
    q: &mut Vector<S, T>,
    v: &[T],
) -> Result<(), StartError> {
    let stopping = Stopping::default();
    let convergence = Convergence::new(stopping, norm::largest(q), q, stopping.max_iterations);
    let result = iterate(convergence, &mut Statistics::default(), |_| {
        let change = projection.of_position(q, v)?;
        for (q, &change) in q.iter_mut().zip(change) {
            *q -= change;
        }
        Ok(norm::largest(change))
    });
    match result.and(norm::finite(q)) {
        Ok(()) => Ok(()),
        Err(StepFailure::NotConverged { .. } | StepFailure::NotFinite { .. }) => {
            let at = At { q, t: projection.t };
            let (constraint, value) = projection.worst(OfPosition { system: projection.system, at });
            Err(StartError::Inconsistent { constraint, value })
        }
        Err(failure) => Err(StartError::Starter(failure)),
    }
}
