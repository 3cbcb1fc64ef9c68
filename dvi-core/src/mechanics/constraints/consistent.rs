//! Whether a state is on the constraints, and the state on them that is near another one.

use crate::error::{StartError, StepFailure};
use crate::mechanics::constraints::residuals::{ROUNDINGS, farthest};
use crate::mechanics::constraints::scales::scale_coordinates;
use crate::mechanics::constraints::{
    At, Bordered, ConstrainedLagrangian, ConstraintSolver, Constraints, Lower, Multipliers,
};
use crate::scalar::norm::{self, reported};
use crate::scalar::passes::subtract;
use crate::scalar::smallest_normal;
use crate::space::{LinearEquations, Sink};
use crate::{Real, Scalar, Space, Vector, Weights};

/// ∂²L/∂v∂v as A, and b = 0: the solution is the shortest change in the metric of the mass matrix.
struct Shortest<'a, S, T> {
    system: &'a S,
    at: [&'a [T]; 2],
    t: T,
}

impl<S: ConstrainedLagrangian<T>, T: Real> LinearEquations<T> for Shortest<'_, S, T> {
    fn evaluate<K: Sink<T>>(&mut self, b: &mut [T], sink: &mut K) -> Result<(), StepFailure> {
        let Self { system, at: [q, v], t } = *self;
        let mut l_q: Vector<S, T> = system.space().vector();
        system.linearize(q, v, t, Weights::mass(), &mut l_q, b, sink);
        b.fill(T::lift(0.0));
        Ok(())
    }
}

/// By how much q or v is to be changed.
fn change<'a, S: ConstrainedLagrangian<T>, T: Real>(
    solver: &'a mut ConstraintSolver<S, T>,
    system: &S,
    at: [&[T]; 2],
    t: T,
    lower: Lower<'_, S, T>,
) -> Result<&'a [T], StepFailure> {
    let multipliers: &Multipliers<S, T> = &system.multipliers().vector();
    let (upper, active) = (Shortest { system, at, t }, multipliers.len());
    let equations = &mut Bordered { system, upper, lower, multipliers, forces: None, active };
    solver.solve(equations, T::lift(1.0))?;
    let (change, _) = solver.parts(at[0].len());
    norm::finite(change)?;
    Ok(change)
}

/// The constraint of positions that is farthest from being kept, of those that are off by more than the
/// errors of the coordinates, `error`, times the derivatives by them explain, and its value.
fn worst<S: ConstrainedLagrangian<T>, T: Real>(
    system: &S,
    At { q, t }: At<'_, T>,
    error: impl Fn(usize) -> T,
) -> Option<(usize, f64)> {
    let [mut values, mut sizes]: [Multipliers<S, T>; 2] = system.multipliers().vectors();
    let mut terms = |k: usize, j: usize, entry: T| sizes[k] += Scalar::abs(entry) * error(j);
    S::Kind::forces(system, q, t, &mut values, &mut terms);
    farthest(&values, &sizes, 1.0)
}

/// Whether a motion along the constraints leads through (`q`, `v`, `t`): at a state, or where a run with
/// steps of a length h begins, whose iterations leave a tolerance. Velocities are rounded relative to
/// themselves and to what forces make in a step, what a run at rest leaves, or on a way of the size of the
/// coordinates.
///
/// # Errors
/// [`StartError::OffConstraint`] and [`StartError::AcrossConstraint`] with the constraint that is farthest
/// from being kept, relative to its rounding errors; [`StartError::UndefinedConstraint`], and
/// [`StartError::Outside`] where that is because a function that holds data is not known;
/// [`StartError::Starter`] or [`StartError::Undetermined`] where a constraint is redundant.
pub(crate) fn check<S: ConstrainedLagrangian<T>, T: Real>(
    system: &S,
    [q, v]: [&[T]; 2],
    t: T,
    of_run: Option<(T, f64)>,
) -> Result<(), StartError> {
    let at = At { q, t };
    let undefined = |constraint, value| {
        let error = StartError::UndefinedConstraint { constraint, value };
        Err(system.outside(q, v, t).map_or(error, StartError::Outside))
    };
    if S::Kind::OF_POSITIONS {
        let rounding = T::lift(ROUNDINGS) * T::default_epsilon();
        // Where a run asks for rounding errors they are all that there is.
        let left_over = match of_run {
            Some((h, tolerance)) if tolerance > reported(T::default_epsilon()) => {
                T::lift(tolerance) * (norm::largest(q) + Scalar::abs(h) * norm::largest(v))
            }
            Some(_) | None => T::lift(0.0),
        };
        match worst(system, at, |j| rounding * Scalar::abs(q[j]) + left_over) {
            Some((constraint, value)) if value.is_finite() => {
                return Err(StartError::OffConstraint { constraint, value });
            }
            Some((constraint, value)) => return undefined(constraint, value),
            None => {}
        }
    }
    let [mut sizes, mut force, mut momentum]: [Vector<S, T>; 3] = system.space().vectors();
    scale_coordinates(system, [q, v], t, &mut sizes);
    system.gradient(q, v, t, &mut force, &mut momentum);
    for ((scale, &force), (&q, &v)) in sizes.iter_mut().zip(force.iter()).zip(q.iter().zip(v)) {
        let acceleration = Scalar::abs(force) * *scale * *scale;
        let of_force = match of_run {
            Some((h, _)) => Scalar::abs(h) * acceleration,
            None => Scalar::sqrt(acceleration * Scalar::abs(q)),
        };
        *scale = Scalar::abs(v) + of_force + smallest_normal();
    }
    // A redundant constraint is named by these equations.
    let mut solver = ConstraintSolver::new(system, q, v, t);
    let determined = change(&mut solver, system, [q, v], t, Lower::Velocity(at, v)).map(|_| ());
    let ConstraintSolver { residuals, scales, .. } = &mut solver;
    residuals.evaluate(system, at, v, scales, |j| sizes[j]);
    match residuals.worst(system, at, v) {
        None if of_run.is_none() => determined.map_err(StartError::Undetermined),
        None => determined.map_err(StartError::Starter),
        Some((constraint, rate)) if rate.is_finite() => {
            Err(StartError::AcrossConstraint { constraint, rate })
        }
        Some((constraint, value)) => undefined(constraint, value),
    }
}

/// Moves a state to the constraints.
///
/// # Errors
/// [`StartError::Inconsistent`] and [`StartError::Projection`].
pub(crate) fn project<S: ConstrainedLagrangian<T>, T: Real>(
    system: &S,
    [q, v]: [&mut Vector<S, T>; 2],
    t: T,
) -> Result<(), StartError> {
    if S::Kind::OF_POSITIONS {
        move_to(system, q, v, t)?;
    }
    align(system, q, v, t)
}

/// What vanishes is affine in the velocity: one iteration is enough, but for rounding errors of what it has
/// taken away. Where little or nothing is left of a velocity they are large beside it, and each iteration
/// leaves 10⁻¹⁶ of them, down to the smallest numbers.
const ITERATIONS: usize = 40;

/// Makes `v` a velocity that the constraints admit at `q`.
fn align<S: ConstrainedLagrangian<T>, T: Real>(
    system: &S,
    q: &[T],
    v: &mut [T],
    t: T,
) -> Result<(), StartError> {
    let (mut solver, at) = (ConstraintSolver::new(system, q, v, t), At { q, t });
    let mut worst = None;
    for iteration in 0..ITERATIONS {
        let change = change(&mut solver, system, [q, v], t, Lower::Velocity(at, v));
        subtract(v, change.map_err(StartError::Projection)?);
        let ConstraintSolver { residuals, scales, .. } = &mut solver;
        residuals.evaluate(system, at, v, scales, |j| Scalar::abs(v[j]) + smallest_normal());
        worst = residuals.worst(system, at, v);
        if iteration > 0 && worst.is_none() {
            break;
        }
    }
    worst.map_or(Ok(()), |(constraint, value)| Err(StartError::Inconsistent { constraint, value }))
}

/// From far away an iteration for one constraint of degree d leaves (1 − 1/d) of the distance, so that at
/// most 710 lead from the largest value of the constraint that can be represented to one, and as many to
/// the smallest. Several constraints may hinder each other.
const MOVES: usize = 1500;

/// Where the constraints are kept the next iteration leaves rounding errors, and one more brings
/// derivatives of up to third order.
const LAST_MOVES: usize = 2;

/// Moves q to the constraints.
fn move_to<S: ConstrainedLagrangian<T>, T: Real>(
    system: &S,
    q: &mut [T],
    v: &[T],
    t: T,
) -> Result<(), StartError> {
    let mut solver = ConstraintSolver::new(system, q, v, t);
    let rounding = T::lift(ROUNDINGS) * T::default_epsilon();
    let (mut off, mut kept) = (None, 0);
    for _ in 0..MOVES {
        solver.balance(system, At { q, t }, v);
        let change = match (change(&mut solver, system, [q, v], t, Lower::Position(At { q, t })), off) {
            (Ok(change), _) => change,
            // The way there has ended where the equations have no solution, which says nothing of the
            // constraints.
            (Err(_), Some((constraint, value))) => {
                return Err(StartError::Inconsistent { constraint, value });
            }
            (Err(failure), None) => return Err(StartError::Projection(failure)),
        };
        subtract(q, change);
        off = worst(system, At { q, t }, |j| rounding * Scalar::abs(q[j]));
        kept = if off.is_none() { kept + 1 } else { 0 };
        if kept > LAST_MOVES {
            return Ok(());
        }
    }
    match off {
        None => Ok(()),
        Some((constraint, value)) => Err(StartError::Inconsistent { constraint, value }),
    }
}
