//! What is checked and laid out before a run begins.

use crate::error::{StartError, StepError, StepFailure};
use crate::name::Name;
use crate::scalar::norm::{self, reported};
use crate::scalar::smallest_normal;
use crate::system::names::entries;
use crate::system::{Factor, TimeTransform, TimeTransformed, spinors};
use crate::{Lagrangian, Real, Scalar, Space, State, System, Vector, Weights};

/// Whether a run can begin at time `t`, and the formulas of `system` stay within its arrays.
pub(crate) fn validate<S: Lagrangian<T>, T: Real>(system: &S, t: T) -> Result<(), StartError> {
    StartError::unless(t.is_finite(), "t", reported(t), "finite")?;
    Ok(system.check()?)
}

/// More steps than a run takes.
const MOST_STEPS: f64 = 9_223_372_036_854_775_808.0;

/// Whether steps can have the length `h`: below the smallest number that has all digits, 1/h may be
/// infinite.
pub(crate) fn is_length<T: Real>(h: T) -> bool {
    h.is_finite() && Scalar::abs(h) >= smallest_normal()
}

/// Whether steps of the length `h`, however many, lead from `t` to times that are finite.
///
/// # Errors
/// [`StartError::Step`].
pub(crate) fn validate_step<T: Real>(t: T, h: T) -> Result<(), StartError> {
    let is_usable = is_length(h) && (t + T::lift(MOST_STEPS) * h).is_finite();
    if is_usable { Ok(()) } else { Err(StartError::Step { h: reported(h) }) }
}

/// `error`, with the name of the first coordinate without a mass, or whose row of Ω is zero or depends on
/// those before it, where a matrix is singular at (`q`, `v`, `t`).
#[cold]
pub(crate) fn named<S: Lagrangian<T>, T: Real>(
    system: &S,
    [q, v]: [&[T]; 2],
    t: T,
    error: StartError,
) -> StartError {
    let (StartError::Starter(StepFailure::Singular { matrix: solved, column, pivot })
    | StartError::Undetermined(StepFailure::Singular { matrix: solved, column, pivot })) = error
    else {
        return error;
    };
    if !has_rows_of_coordinates::<S>() {
        return error;
    }
    let one = T::lift(1.0);
    let space = system.space();
    let [mut sizes, mut velocity, mut l_q, mut l_v]: [Vector<S, T>; 4] = space.vectors();
    let (matrix, weights) = if S::REGULAR {
        velocity.copy_from_slice(v);
        (StepFailure::MASS, Weights::mass())
    } else {
        (StepFailure::OMEGA, Weights { qv: one, vq: -one, ..Weights::none() })
    };
    let mut sink: &mut dyn FnMut(usize, usize, T) = &mut |row, _, entry| sizes[row] += Scalar::abs(entry);
    system.linearize(q, &velocity, t, weights, &mut l_q, &mut l_v, &mut sink);
    let empty = sizes.iter().position(|&size| !(one / size).is_finite());
    match (empty, coordinate(system, empty.unwrap_or(column))) {
        (Some(row), Some(entry)) => StartError::Singular { matrix, entry, size: reported(sizes[row]) },
        (None, Some(entry)) if solved == matrix && pivot.is_finite() => {
            StartError::Dependent { matrix, entry, pivot }
        }
        _ => error,
    }
}

/// The error of the step after `step` others, from time `t`, with the name of the coordinate that `failure`
/// counts.
#[cold]
pub(crate) fn step_error<S: System, T: Real>(
    system: &S,
    step: u64,
    t: T,
    failure: StepFailure,
) -> StepError {
    let is_entry = matches!(failure, StepFailure::NotFinite { .. });
    let is_counted = is_entry || has_rows_of_coordinates::<S>();
    let counted = failure.coordinate().filter(|_| is_counted);
    let coordinate = counted.and_then(|place| coordinate(system, place));
    StepError { step, time: reported(t), failure, coordinate }
}

/// Whether rows and columns of matrices are those of coordinates, which are not more than velocities.
fn has_rows_of_coordinates<S: System>() -> bool {
    spinors::has::<S>() || S::REPORT.coordinates.iter().all(|block| block.factor == Factor::Line)
}

/// The name of the coordinate at a place in the flat state; of a spinor that of its vector.
fn coordinate<S: System>(system: &S, place: usize) -> Option<Name> {
    if spinors::has::<S>()
        && let Some(vector) = spinors::at_place(system, place)
    {
        return Some(vector);
    }
    entries(system).find(|(name, at)| !name.is_velocity && *at == place).map(|(name, _)| name)
}

/// Whether energy and derivatives of L are finite at the start of a run.
///
/// # Errors
/// [`StartError::Outside`] where that is because a function that holds data is not known; else
/// [`StartError::Undefined`] names the first of ∂L/∂v, which is α for a degenerate system, the applied
/// force, ∂L/∂q, which is −∇H for one, and the energy that is not.
pub(crate) fn evaluate<S: Lagrangian<T>, T: Real>(
    system: &S,
    q: &[T],
    v: &[T],
    t: T,
) -> Result<(), StartError> {
    let [mut l_q, mut l_v, mut applied]: [Vector<S, T>; 3] = system.space().vectors();
    // Of a degenerate system v is zero here, and ∂L/∂q is −∇H.
    system.gradient(q, v, t, &mut l_q, &mut l_v);
    system.applied_force(q, v, t, &mut applied);
    let undefined = first_undefined(S::REGULAR, [&l_v, &l_q, &applied], system.energy(q, v, t));
    let Some((quantity, place, value)) = undefined else { return Ok(()) };
    let coordinate = place.and_then(|place| coordinate(system, place));
    let error = StartError::Undefined { quantity, coordinate, value };
    Err(system.outside(q, v, t).map_or(error, StartError::Outside))
}

/// What is not a number of friction such as R = μ|v| at rest.
const APPLIED: &str = "the applied force (`force`, and −∂R/∂v of `dissipation`)";

/// The first of momentum, force and energy that is not finite, with its place and its value.
fn first_undefined<T: Real>(
    is_regular: bool,
    [momentum, force, applied]: [&[T]; 3],
    energy: T,
) -> Option<(&'static str, Option<usize>, f64)> {
    let [of_momentum, of_force, of_energy] = if is_regular {
        ["the momentum ∂L/∂v", "the force ∂L/∂q", "the energy"]
    } else {
        ["the one-form α", "the gradient of H", "the Hamiltonian"]
    };
    for (quantity, values) in [(of_momentum, momentum), (of_force, force)] {
        if let Some(place) = values.iter().position(|x| !x.is_finite()) {
            let is_applied = quantity == of_force && !applied[place].is_finite();
            let quantity = if is_applied { APPLIED } else { quantity };
            return Some((quantity, Some(place), reported(values[place])));
        }
    }
    (!energy.is_finite()).then(|| (of_energy, None, reported(energy)))
}

/// H and the coordinate `energy` may differ by this part of them where a run begins.
const ENERGY_TOLERANCE: f64 = 1e-6;
/// And by this part of the terms of H, where these cancel.
const ROUNDING: f64 = 1e-12;

/// The places of `t` and of `energy` in a state of a system whose time is transformed.
pub(crate) fn extended<S: System>(system: &S) -> [usize; 2] {
    let dimension = system.space().dimension();
    [dimension - 2, dimension - 1]
}

/// If the time is transformed: whether it passes at the start of a run, and `energy` is the value of H. On
/// another level of H − `energy` the motion would be that of another system.
///
/// # Errors
/// [`StartError::TimeRate`] and [`StartError::EnergyCoordinate`].
pub(crate) fn consistent<S: Lagrangian<T>, T: Real>(
    system: &S,
    q: &Vector<S, T>,
    t: T,
) -> Result<(), StartError> {
    if !S::TIME_TRANSFORMED {
        return Ok(());
    }
    let Some(transform) = system.time_transform(q) else { return Ok(()) };
    let [rate, hamiltonian] = [transform.rate, transform.hamiltonian].map(reported);
    if rate.is_nan() || rate <= 0.0 || rate.is_infinite() {
        return Err(StartError::TimeRate { rate });
    }
    let space = system.space();
    let (rest, mut l_q, mut l_v): (Vector<S, T>, Vector<S, T>, Vector<S, T>) =
        (space.vector(), space.vector(), space.vector());
    system.gradient(q, &rest, t, &mut l_q, &mut l_v);
    // ∂L/∂q is −ρ∇H: the terms of H are of the size of q·∇H.
    let terms =
        q.iter().zip(l_q.iter()).fold(0.0, |sum, (&q, &l)| sum + (reported(q) * reported(l) / rate).abs());
    let energy = reported(q[extended(system)[1]]);
    let tolerance = ENERGY_TOLERANCE * hamiltonian.abs().max(energy.abs()) + ROUNDING * terms;
    let is_close = (hamiltonian - energy).abs() <= tolerance;
    if is_close { Ok(()) } else { Err(StartError::EnergyCoordinate { energy, hamiltonian }) }
}

/// `state` with the coordinate `energy` set to H.
pub(crate) fn with_energy<S: TimeTransformed<T>, T: Real>(
    system: &S,
    state: &S::State<T>,
) -> Result<S::State<T>, StartError> {
    system.check()?;
    let (mut q, mut v) = (system.space().vector(), system.space().vector());
    state.write(&|block| system.block_len(block), &mut q, &mut v)?;
    let [_, energy] = extended(system);
    q[energy] = T::lift(0.0);
    finite(system, &q, &v)?;
    let TimeTransform { rate, hamiltonian } = system.time_transform_at(&q);
    if !hamiltonian.is_finite() || !rate.is_finite() {
        evaluate(system, &q, &v, T::lift(0.0))?;
    }
    q[energy] = hamiltonian;
    Ok(S::State::read(&|block| system.block_len(block), &q, &v))
}

/// Checks that the entries of a state are finite.
pub(crate) fn finite<S: System, T: Real>(system: &S, q: &[T], v: &[T]) -> Result<(), StartError> {
    // To walk through their names takes a sixth of the start of four vortices.
    if !spinors::has::<S>() && norm::finite(q).and(norm::finite(v)).is_ok() {
        return Ok(());
    }
    for (entry, value) in system.names().zip(system.values_of(q, v)) {
        if !value.is_finite() {
            return Err(StartError::NotFinite { entry, value: reported(value) });
        }
    }
    Ok(())
}

/// The number of velocities that a state carries.
pub(crate) fn velocities<S: System>(system: &S) -> usize {
    if S::REGULAR { system.space().dimension() } else { 0 }
}

/// The coordinates and, if the system is regular, the velocities of a state that is one of the system, and
/// at which it is defined at time `t`.
pub(crate) fn flatten<S: Lagrangian<T>, T: Real>(
    system: &S,
    t: T,
    state: &S::State<T>,
) -> Result<[Vector<S, T>; 2], StartError> {
    let [mut q, mut v] = system.space().vectors();
    state.write(&|block| system.block_len(block), &mut q, &mut v)?;
    finite(system, &q, &v)?;
    spinors::check(system, &q)?;
    evaluate(system, &q, &v, t)?;
    Ok([q, v])
}
