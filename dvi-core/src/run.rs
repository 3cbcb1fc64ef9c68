//! What runs with fixed and with controlled steps have in common: a system, a method, and where they are.

use core::fmt;

use crate::error::{StartError, StepError, StepFailure};
use crate::method::{Method, VariableStep};
use crate::norm::reported;
use crate::statistics::Statistics;
use crate::{Lagrangian, Real, Space, State, Vector};

/// A system, a method that steps it, and the point that they have reached. It does not know the time: who
/// drives it does, an [`Integrator`](crate::Integrator) or a [`ControlledIntegrator`](crate::ControlledIntegrator).
pub struct Run<'a, S: Lagrangian, M: Method<S, T>, T: Real> {
    pub(crate) system: &'a S,
    pub(crate) method: M,
    pub(crate) memory: M::Memory,
    pub(crate) q: Vector<S, T>,
    pub(crate) statistics: Statistics,
    pub(crate) failed: bool,
    /// What can be gone back to; for controls that reject steps.
    pub(crate) checkpoint: Option<(M::Memory, Vector<S, T>)>,
}

impl<'a, S: Lagrangian, M: Method<S, T>, T: Real> Run<'a, S, M, T> {
    pub(crate) fn new(system: &'a S, method: M, memory: M::Memory, q: Vector<S, T>) -> Self {
        Self { system, method, memory, q, statistics: Statistics::default(), failed: false, checkpoint: None }
    }

    /// The system.
    pub fn system(&self) -> &'a S {
        self.system
    }

    /// The current coordinates, flat, in the order of declaration.
    pub fn q(&self) -> &[T] {
        &self.q
    }

    /// Sets `v` to the velocity at the current point, which is reached at time `t`; degenerate systems have
    /// none, and `v` stays as it is.
    ///
    /// # Errors
    /// As [`Method::velocity`].
    #[inline]
    pub fn velocity(&self, t: T, v: &mut Vector<S, T>) -> Result<(), StepFailure> {
        self.method.velocity(self.system, &self.memory, &self.q, t, v)
    }

    /// Takes a step from time `t` to `t + h`, without allocation and without counting it.
    ///
    /// # Errors
    /// [`StepFailure::StepLength`] if `h` is not finite or `t + h` is `t`; else as [`Method::step`]. Nothing
    /// has moved then.
    #[inline]
    pub fn step(&mut self, t: T, h: T) -> Result<(), StepFailure> {
        if !h.is_finite() || t + h == t {
            return Err(StepFailure::StepLength { h: reported(h) });
        }
        self.method.step(self.system, &mut self.memory, &mut self.q, t, h, &mut self.statistics)
    }

    /// Keeps the present point, to [go back](Self::go_back) to it; nothing happens if the control does not
    /// [reject](crate::StepControl::REJECTS) steps.
    pub fn keep(&mut self)
    where
        M: VariableStep<S, T>,
    {
        if let Some((memory, q)) = &mut self.checkpoint {
            self.method.restore(&self.memory, memory);
            q.copy_from_slice(&self.q);
        }
    }

    /// Goes back to the point that was kept.
    pub fn go_back(&mut self)
    where
        M: VariableStep<S, T>,
    {
        if let Some((memory, q)) = &self.checkpoint {
            self.method.restore(memory, &mut self.memory);
            self.q.copy_from_slice(q);
        }
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

impl<S: Lagrangian, M: Method<S, T> + fmt::Debug, T: Real> fmt::Debug for Run<'_, S, M, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Run")
            .field("system", &S::REPORT.system)
            .field("method", &self.method)
            .field("q", &self.q)
            .field("statistics", &self.statistics)
            .finish_non_exhaustive()
    }
}

/// Whether a run can begin at time `t`, and the formulas of `system` stay within its arrays.
pub(crate) fn validate<S: Lagrangian, T: Real>(system: &S, t: T) -> Result<(), StartError> {
    if !t.is_finite() {
        return Err(StartError::Parameter { name: "t", value: reported(t), range: "finite" });
    }
    Ok(system.check()?)
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
