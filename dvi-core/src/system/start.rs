//! What is checked and laid out before a run begins.

use crate::error::StartError;
use crate::scalar::norm::reported;
use crate::system::TimeTransform;
use crate::{Lagrangian, Real, Space, State, System, Vector};

/// Whether a run can begin at time `t`, and the formulas of `system` stay within its arrays.
pub(crate) fn validate<S: Lagrangian<T>, T: Real>(system: &S, t: T) -> Result<(), StartError> {
    if !t.is_finite() {
        return Err(StartError::Parameter { name: "t", value: reported(t), range: "finite" });
    }
    Ok(system.check()?)
}

/// Whether energy and derivatives of L are finite at the start of a run.
///
/// # Errors
/// [`StartError::Outside`] where a function that holds data is not known; [`StartError::Undefined`] names the first of ∂L/∂v, which is α for a degenerate system, ∂L/∂q, which is −∇H for
/// one, and the energy that is not.
pub(crate) fn evaluate<S: Lagrangian<T>, T: Real>(
    system: &S,
    q: &[T],
    v: &[T],
    t: T,
) -> Result<(), StartError> {
    let (mut l_q, mut l_v) = (system.space().vector(), system.space().vector());
    if let Some(transform) = system.time_transform(q) {
        consistent(system, q, transform)?;
    }
    if let Some(outside) = system.outside(q, v, t) {
        return Err(outside.into());
    }
    // Of a degenerate system v is zero here, and ∂L/∂q is −∇H.
    system.gradient(q, v, t, &mut l_q, &mut l_v);
    let [momentum, force] = if S::REGULAR {
        ["the momentum ∂L/∂v", "the force ∂L/∂q"]
    } else {
        ["the one-form α", "the gradient of H"]
    };
    for (quantity, values) in [(momentum, &l_v), (force, &l_q)] {
        if let Some(coordinate) = values.iter().position(|x| !x.is_finite()) {
            let value = reported(values[coordinate]);
            return Err(StartError::Undefined { quantity, coordinate: Some(coordinate), value });
        }
    }
    let energy = system.energy(q, v, t);
    if energy.is_finite() {
        return Ok(());
    }
    let quantity = if S::REGULAR { "the energy" } else { "the Hamiltonian" };
    Err(StartError::Undefined { quantity, coordinate: None, value: reported(energy) })
}

/// H and the coordinate `energy` may differ by this part of them where a run begins.
const ENERGY_TOLERANCE: f64 = 1e-6;

/// The places of `t` and of `energy` in a state of a system whose time is transformed.
pub(crate) fn extended<S: System>(system: &S) -> [usize; 2] {
    let dimension = system.space().dimension();
    [dimension - 2, dimension - 1]
}

/// Whether the time passes at the start of a run, and `energy` is the value of H. On another level of H − `energy` the motion would
/// be that of another system.
///
/// # Errors
/// [`StartError::TimeRate`] and [`StartError::EnergyCoordinate`].
fn consistent<S: Lagrangian<T>, T: Real>(
    system: &S,
    q: &[T],
    transform: TimeTransform<T>,
) -> Result<(), StartError> {
    let [rate, hamiltonian] = [transform.rate, transform.hamiltonian].map(reported);
    if rate.is_nan() || rate <= 0.0 || rate.is_infinite() {
        return Err(StartError::TimeRate { rate });
    }
    let energy = reported(q[extended(system)[1]]);
    let is_close = (hamiltonian - energy).abs() <= ENERGY_TOLERANCE * hamiltonian.abs().max(energy.abs());
    // What is no number is reported as such.
    if is_close || hamiltonian.is_nan() {
        Ok(())
    } else {
        Err(StartError::EnergyCoordinate { energy, hamiltonian })
    }
}

/// `state` with the coordinate `energy` set to H.
pub(crate) fn with_energy<S: Lagrangian<T>, T: Real>(
    system: &S,
    state: &S::State<T>,
) -> Result<S::State<T>, StartError> {
    system.check()?;
    let (mut q, mut v) = (system.space().vector(), system.space().vector());
    state.write(|block| system.block_len(block), &mut q, &mut v)?;
    let [_, energy] = extended(system);
    q[energy] = T::lift(0.0);
    finite(system, q.iter().copied())?;
    if let Some(TimeTransform { hamiltonian, .. }) = system.time_transform(&q) {
        q[energy] = hamiltonian;
    }
    Ok(S::State::read(|block| system.block_len(block), &q, &v))
}

/// Checks that the entries of a state, in the order of [`System::names`], are finite.
pub(crate) fn finite<S: System, T: Real>(
    system: &S,
    entries: impl Iterator<Item = T>,
) -> Result<(), StartError> {
    match system.names().zip(entries).find(|(_, x)| !x.is_finite()) {
        Some((entry, value)) => Err(StartError::NotFinite { entry, value: reported(value) }),
        None => Ok(()),
    }
}

/// The number of velocities that a state carries.
pub(crate) fn velocities<S: System>(system: &S) -> usize {
    if S::REGULAR { system.space().dimension() } else { 0 }
}

/// The coordinates and, if the system is regular, the velocities of a state.
pub(crate) fn flatten<S: Lagrangian<T>, T: Real>(
    system: &S,
    state: &S::State<T>,
) -> Result<[Vector<S, T>; 2], StartError> {
    let (mut q, mut v) = (system.space().vector(), system.space().vector());
    state.write(|block| system.block_len(block), &mut q, &mut v)?;
    finite(system, q.iter().chain(v.iter()).copied())?;
    Ok([q, v])
}
