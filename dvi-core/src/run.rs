//! What runs with fixed and with controlled steps have in common: a system, a method, and where they are.

use crate::error::{StartError, StepError, StepFailure};
use crate::method::{Carries, Clock, Method};
use crate::norm::reported;
use crate::statistics::Statistics;
use crate::{Lagrangian, Real, Space, State, Vector};

/// A system, a method that steps it, and the point that they have reached. It does not know the time: who
/// drives it does, an [`Integrator`](crate::Integrator) or a [`ControlledIntegrator`](crate::ControlledIntegrator).
pub(crate) struct Run<'a, S: Lagrangian, M: Carries<S, T>, T: Real> {
    pub(crate) system: &'a S,
    pub(crate) method: M,
    pub(crate) memory: M::Memory,
    pub(crate) q: Vector<S, T>,
    pub(crate) statistics: Statistics,
    pub(crate) failed: bool,
}

impl<'a, S: Lagrangian, M: Method<S, T>, T: Real> Run<'a, S, M, T> {
    pub(crate) fn new(system: &'a S, method: M, memory: M::Memory, q: Vector<S, T>) -> Self {
        Self { system, method, memory, q, statistics: Statistics::default(), failed: false }
    }

    /// Sets `v` to the velocity at the current point, which is reached at time `t`.
    #[inline]
    pub(crate) fn velocity(&self, t: T, v: &mut Vector<S, T>) -> Result<(), StepFailure> {
        self.method.velocity(self.system, &self.memory, &self.q, t, v)
    }

    /// Takes `count` steps from the present time of `clock`, or as many as succeed.
    #[inline]
    pub(crate) fn steps(&mut self, clock: Clock<T>, count: u64) -> Result<(), StepFailure> {
        self.method.steps(self.system, &mut self.memory, &mut self.q, clock, count, &mut self.statistics)
    }

    #[cold]
    pub(crate) fn error(&mut self, time: T, failure: StepFailure) -> StepError {
        self.failed = true;
        StepError { step: self.statistics.steps, time: reported(time), failure }
    }

    pub(crate) fn state(&self, t: T) -> S::State<T> {
        self.with_velocity(t, |v| S::State::read(|block| self.system.block_len(block), &self.q, v))
    }

    pub(crate) fn try_state(&mut self, t: T) -> Result<S::State<T>, StepError> {
        let system = self.system;
        if !S::REGULAR {
            return Ok(self.state(t));
        }
        let mut v = system.space().vector();
        match self.velocity(t, &mut v) {
            Ok(()) => Ok(S::State::read(|block| system.block_len(block), &self.q, &v)),
            Err(failure) => Err(self.error(t, failure)),
        }
    }

    pub(crate) fn energy(&self, t: T) -> T {
        self.with_velocity(t, |v| self.system.energy(&self.q, v, t))
    }

    pub(crate) fn momentum(&self, index: usize, t: T) -> Option<T> {
        let declared = index < S::REPORT.momenta.len();
        declared.then(|| self.with_velocity(t, |v| self.system.momentum(index, &self.q, v, t)))
    }

    pub(crate) fn momenta(&self, t: T) -> impl Iterator<Item = (&'static str, T)> + '_ {
        let names = S::REPORT.momenta.iter().enumerate();
        names.map(move |(index, &name)| {
            (name, self.with_velocity(t, |v| self.system.momentum(index, &self.q, v, t)))
        })
    }

    /// Passes the velocity on, or nothing if the system is degenerate.
    fn with_velocity<R>(&self, t: T, read: impl FnOnce(&[T]) -> R) -> R {
        if !S::REGULAR {
            return read(&[]);
        }
        let mut v = self.system.space().vector();
        if self.velocity(t, &mut v).is_err() {
            v.fill(T::lift(f64::NAN));
        }
        read(&v)
    }
}

/// Whether a run can begin at time `t`, and the formulas of `system` stay within its arrays.
pub(crate) fn validate<S: Lagrangian, T: Real>(system: &S, t: T) -> Result<(), StartError> {
    if !t.is_finite() {
        return Err(StartError::Parameter { name: "t", value: reported(t), range: "finite" });
    }
    Ok(system.check()?)
}

/// Whether energy and derivatives of L are finite at the start of a run.
///
/// # Errors
/// [`StartError::Undefined`] names the first of ∂L/∂v, which is α for a degenerate system, ∂L/∂q, which is −∇H for
/// one, and the energy that is not.
pub(crate) fn evaluate<S: Lagrangian, T: Real>(system: &S, q: &[T], v: &[T], t: T) -> Result<(), StartError> {
    let (mut l_q, mut l_v) = (system.space().vector(), system.space().vector());
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

/// The number of velocities that a state carries.
pub(crate) fn velocities<S: Lagrangian>(system: &S) -> usize {
    if S::REGULAR { system.space().dimension() } else { 0 }
}

/// The coordinates and, if the system is regular, the velocities of a state.
pub(crate) fn flatten<S: Lagrangian, T: Real>(
    system: &S,
    state: &S::State<T>,
) -> Result<[Vector<S, T>; 2], StartError> {
    let (mut q, mut v) = (system.space().vector(), system.space().vector());
    state.write(|block| system.block_len(block), &mut q, &mut v)?;
    match q.iter().chain(v.iter()).position(|x| !x.is_finite()) {
        Some(coordinate) => {
            let value = if coordinate < q.len() { q[coordinate] } else { v[coordinate - q.len()] };
            Err(StartError::NotFinite { coordinate, value: reported(value) })
        }
        None => Ok([q, v]),
    }
}
