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
use crate::{Real, Scalar, Space, State, Vector};

/// A start may be off the constraints by so many rounding errors.
const ROUNDINGS: f64 = 1e4;

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
        let equations = &mut Bordered { system: *system, upper, lower, multipliers, forces: None, active };
        solver.solve(equations, T::lift(1.0))?;
        let (change, _) = solver.parts(q.len());
        norm::finite(change)?;
        Ok(change)
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

/// The constraint that is farthest from being kept, of those that are off by more than rounding errors, and its value. Errors of
/// rounding are those of the coordinates, `scale`, times the derivatives by them.
fn worst<S: ConstrainedLagrangian<T>, T: Real>(
    system: &S,
    mut of: impl LinearEquations<T>,
    scale: impl Fn(usize) -> T,
) -> Result<Option<(usize, f64)>, StepFailure> {
    let [mut values, mut sizes]: [Multipliers<S, T>; 2] = [0, 1].map(|_| system.multipliers().vector());
    of.evaluate(
        &mut values,
        &mut Places(|k: usize, j: usize, entry: T| sizes[k] += Scalar::abs(entry) * scale(j)),
    )?;
    let rounding = ROUNDINGS * reported(T::default_epsilon());
    let mut worst = None;
    for (constraint, (&value, &size)) in values.iter().zip(sizes.iter()).enumerate() {
        let (value, size) = (reported(value), reported(size));
        if value.is_nan() {
            return Ok(Some((constraint, value)));
        }
        let off = value.abs() / size;
        let is_worse = worst.is_none_or(|(_, _, known)| off > known);
        if value.abs() > rounding * size && is_worse {
            worst = Some((constraint, value, off));
        }
    }
    Ok(worst.map(|(constraint, value, _)| (constraint, value)))
}

/// Whether a run with steps of length `h` can begin at (`q`, `v`, `t`).
///
/// # Errors
/// [`StartError::OffConstraint`] and [`StartError::AcrossConstraint`] with the constraint that is farthest from being kept, relative
/// to its rounding errors.
pub(crate) fn check<S: ConstrainedLagrangian<T>, T: Real>(
    system: &S,
    [q, v]: [&[T]; 2],
    t: T,
    h: T,
) -> Result<(), StartError> {
    let at = At { q, t };
    if S::Kind::OF_POSITIONS {
        let off = worst(system, OfPosition { system, at }, |j| Scalar::abs(q[j]));
        if let Some((constraint, value)) = off.map_err(StartError::Starter)? {
            return Err(StartError::OffConstraint { constraint, value });
        }
    }
    // A velocity is rounded where it is small against those that move a coordinate by itself in a step.
    let speed = |j: usize| Scalar::abs(v[j]) + Scalar::abs(q[j] / h);
    let across = worst(system, OfVelocity { system, at, v }, speed).map_err(StartError::Starter)?;
    match across {
        None => Ok(()),
        Some((constraint, rate)) => Err(StartError::AcrossConstraint { constraint, rate }),
    }
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
            let Projection { system, t, .. } = *projection;
            let found = worst(system, OfPosition { system, at: At { q, t } }, |_| T::lift(0.0));
            let (constraint, value) = found.map_err(StartError::Starter)?.unwrap_or((0, 0.0));
            Err(StartError::Inconsistent { constraint, value })
        }
        Err(failure) => Err(StartError::Starter(failure)),
    }
}
