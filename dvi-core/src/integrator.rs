//! A run: a system, a method, a step, and where they have got to.

use core::fmt;

use crate::error::{StartError, StepError, StepFailure};
use crate::method::{Clock, Method, TwoPoint};
use crate::norm::reported;
use crate::sigma_family::{Sigma, SigmaMemory};
use crate::statistics::Statistics;
use crate::vector_field::VectorField;
use crate::{DegenerateLagrangian, Lagrangian, Real, Space, State, Vector};

/// A run of a method on a system with a fixed step.
///
/// As an iterator it yields the state after each step, for ever, or up to the first failure; after that
/// it yields `None`, and [`state`](Self::state) is the last good one. [`advance`](Self::advance) takes a
/// step without building a state.
pub struct Integrator<'a, S: Lagrangian, M: Method<S, T>, T: Real = f64> {
    system: &'a S,
    method: M,
    memory: M::Memory,
    q: Vector<S, T>,
    /// At the start of the run.
    clock: Clock<T>,
    failed: bool,
    statistics: Statistics,
}

impl<'a, S: Lagrangian, M: Method<S, T>, T: Real> Integrator<'a, S, M, T> {
    /// A run from `start` at time 0 with step `h`, which may be negative.
    ///
    /// # Errors
    /// [`StartError`] if a parameter array of the system or an array of the state has the wrong length,
    /// `h` is zero or not finite, a coordinate is not finite, an option of the method is out of range,
    /// or the starting values cannot be computed.
    pub fn new(system: &'a S, method: M, h: T, start: S::State<T>) -> Result<Self, StartError> {
        Self::new_at(system, method, T::lift(0.0), h, start)
    }

    /// A run from `start` at time `t`; else as [`new`](Self::new).
    ///
    /// # Errors
    /// As [`new`](Self::new), and [`StartError::Parameter`] if `t` is not finite.
    pub fn new_at(system: &'a S, method: M, t: T, h: T, start: S::State<T>) -> Result<Self, StartError> {
        validate(system, t, h)?;
        let [q, v] = flatten(system, &start)?;
        let memory = method.begin(system, &q, &v[..velocities(system)], t, h)?;
        Ok(Self::assemble(system, method, memory, q, t, h))
    }

    fn assemble(system: &'a S, method: M, memory: M::Memory, q: Vector<S, T>, t: T, h: T) -> Self {
        Self {
            system,
            method,
            memory,
            q,
            clock: Clock::new(t, h),
            failed: false,
            statistics: Statistics::default(),
        }
    }

    /// Takes one step. Nothing is allocated.
    ///
    /// # Errors
    /// [`StepError`]; the run stays at the last good state, and the step can be tried again.
    #[inline]
    pub fn advance(&mut self) -> Result<(), StepError> {
        self.advance_by(1)
    }

    /// Takes `count` steps, as so many calls of [`advance`](Self::advance) would, bit by bit, but faster
    /// where a method can keep its state in registers.
    ///
    /// # Errors
    /// [`StepError`] of the first step that fails; the run stays at the last good state.
    #[inline]
    pub fn advance_by(&mut self, count: u64) -> Result<(), StepError> {
        let clock = self.clock.after(self.statistics.steps);
        self.method
            .steps(self.system, &mut self.memory, &mut self.q, clock, count, &mut self.statistics)
            .map_err(|failure| self.error(failure))
    }

    #[cold]
    fn error(&mut self, failure: StepFailure) -> StepError {
        self.failed = true;
        StepError { step: self.statistics.steps, time: reported(self.time()), failure }
    }

    /// The current state. The velocities of a regular system are not a number where the mass matrix is
    /// singular and the momenta have no velocity; an iterator yields an error there.
    pub fn state(&self) -> S::State<T> {
        self.with_velocity(|v| S::State::read(|block| self.system.block_len(block), &self.q, v))
    }

    /// The energy v·∂L/∂v − L at the current state; H for a degenerate system.
    pub fn energy(&self) -> T {
        self.with_velocity(|v| self.system.energy(&self.q, v, self.time()))
    }

    /// Passes the velocity on, or nothing if the system is degenerate.
    fn with_velocity<R>(&self, read: impl FnOnce(&[T]) -> R) -> R {
        if !S::REGULAR {
            return read(&[]);
        }
        let mut v = self.system.space().vector();
        if self.velocity(&mut v).is_err() {
            v.fill(T::lift(f64::NAN));
        }
        read(&v)
    }

    fn try_state(&mut self) -> Result<S::State<T>, StepError> {
        let system = self.system;
        if !S::REGULAR {
            return Ok(self.state());
        }
        let mut v = system.space().vector();
        match self.velocity(&mut v) {
            Ok(()) => Ok(S::State::read(|block| system.block_len(block), &self.q, &v)),
            Err(failure) => Err(self.error(failure)),
        }
    }

    fn velocity(&self, v: &mut Vector<S, T>) -> Result<(), StepFailure> {
        self.method.velocity(self.system, &self.memory, &self.q, self.time(), v)
    }

    /// The current coordinates, flat, in the order of declaration.
    pub fn q(&self) -> &[T] {
        &self.q
    }

    /// The current coordinates in the storage of their space.
    pub(crate) fn vector(&self) -> &Vector<S, T> {
        &self.q
    }

    /// The current time, t₀ + steps · h, which does not accumulate rounding errors.
    #[inline]
    pub fn time(&self) -> T {
        self.clock.after(self.statistics.steps).time()
    }

    /// The number of completed steps.
    pub fn steps(&self) -> u64 {
        self.statistics.steps
    }

    /// The step h.
    pub fn step_size(&self) -> T {
        self.clock.step_size()
    }

    /// The system.
    pub fn system(&self) -> &'a S {
        self.system
    }

    /// The method.
    pub fn method(&self) -> &M {
        &self.method
    }

    /// What the method carries from step to step.
    pub fn memory(&self) -> &M::Memory {
        &self.memory
    }

    /// What the run has cost so far.
    pub fn statistics(&self) -> Statistics {
        self.statistics
    }

    /// The value of declared momentum `index`, in the order of
    /// [`Report::momenta`](crate::Report::momenta); `None` if there is no such momentum.
    pub fn momentum(&self, index: usize) -> Option<T> {
        let declared = index < S::REPORT.momenta.len();
        declared.then(|| self.with_velocity(|v| self.system.momentum(index, &self.q, v, self.time())))
    }

    /// The names and values of all declared momenta.
    pub fn momenta(&self) -> impl Iterator<Item = (&'static str, T)> + '_ {
        let names = S::REPORT.momenta.iter().enumerate();
        names.map(|(index, &name)| {
            (name, self.with_velocity(|v| self.system.momentum(index, &self.q, v, self.time())))
        })
    }
}

impl<'a, S: Lagrangian, M: TwoPoint<S, T>, T: Real> Integrator<'a, S, M, T> {
    /// A run of a two-step method that starts at `first`, time 0, and whose first step leads to `second`.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn from_two_points(
        system: &'a S,
        method: M,
        h: T,
        first: S::State<T>,
        second: S::State<T>,
    ) -> Result<Self, StartError> {
        let t = T::lift(0.0);
        validate(system, t, h)?;
        let ([q0, _], [q1, _]) = (flatten(system, &first)?, flatten(system, &second)?);
        let memory = method.begin_between(system, &q0, &q1, t, h)?;
        Ok(Self::assemble(system, method, memory, q0, t, h))
    }
}

impl<S: DegenerateLagrangian, T: Real> Integrator<'_, S, Sigma<T>, T> {
    /// The discrete momentum J_d = J(q) + c·ξ(q), ξ = B⁻¹∇J, of declared momentum `index`.
    ///
    /// By the discrete Noether theorem D₂L_d·ξ − f is conserved, where f is defined by
    /// L_ξ α = df (Marsden & West 2001, section 1.3.3). As D₂L_d = p = α + c and df = d(α·ξ − J), this is
    /// J_d up to a constant. Exact if ξ is affine in q and f affine, or quadratic with σ = ½.
    ///
    /// # Errors
    /// [`StepFailure::Singular`] if Ω is singular at the current point. `Ok(None)` if there is no such
    /// momentum.
    pub fn discrete_momentum(&self, index: usize) -> Result<Option<T>, StepFailure> {
        let Some(momentum) = self.momentum(index) else { return Ok(None) };
        let mut field = VectorField::new(self.system, &self.q, self.time())?;
        let mut xi = self.system.space().vector();
        field.generator(self.system, index, &self.q, self.time(), &mut xi)?;
        let along = self.memory.defect().iter().zip(xi.iter());
        Ok(Some(along.fold(momentum, |sum, (&c, &xi)| sum + c * xi)))
    }

    /// max |p − α(q)|, the amplitude of the parasitic mode in p.
    pub fn parasitic_amplitude(&self) -> T {
        SigmaMemory::parasitic_amplitude(&self.memory)
    }
}

impl<S: Lagrangian, M: Method<S, T>, T: Real> Iterator for Integrator<'_, S, M, T> {
    type Item = Result<S::State<T>, StepError>;

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        self.nth(0)
    }

    /// Skips `n` states without building them and yields the next. Unlike elsewhere, a failure on the way is
    /// not skipped but yielded.
    #[inline]
    fn nth(&mut self, n: usize) -> Option<Self::Item> {
        if self.failed {
            return None;
        }
        Some(self.advance_by(n as u64 + 1).and_then(|()| self.try_state()))
    }
}

impl<S: Lagrangian, M: Method<S, T>, T: Real> core::iter::FusedIterator for Integrator<'_, S, M, T> {}

impl<S: Lagrangian, M: Method<S, T> + fmt::Debug, T: Real> fmt::Debug for Integrator<'_, S, M, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Integrator")
            .field("system", &S::REPORT.system)
            .field("method", &self.method)
            .field("time", &self.time())
            .field("step_size", &self.step_size())
            .field("state", &self.state())
            .field("statistics", &self.statistics)
            .finish_non_exhaustive()
    }
}

fn validate<S: Lagrangian, T: Real>(system: &S, t: T, h: T) -> Result<(), StartError> {
    if !h.is_finite() || h == T::lift(0.0) {
        return Err(StartError::Step { h: reported(h) });
    }
    if !t.is_finite() {
        return Err(StartError::Parameter { name: "t", value: reported(t), range: "finite" });
    }
    Ok(system.check()?)
}

/// The number of velocities that a state carries.
fn velocities<S: Lagrangian>(system: &S) -> usize {
    if S::REGULAR { system.space().dimension() } else { 0 }
}

/// The coordinates and, if the system is regular, the velocities of a state.
fn flatten<S: Lagrangian, T: Real>(system: &S, state: &S::State<T>) -> Result<[Vector<S, T>; 2], StartError> {
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
