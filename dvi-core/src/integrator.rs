//! A run: a system, a method, a step, and where they have got to.

use core::fmt;

use crate::error::{StartError, StepError, StepFailure};
use crate::method::{Carries, Clock, Method, TwoPoint};
use crate::norm::reported;
use crate::run::{Run, evaluate, flatten, velocities};
use crate::sigma_family::{ParasiticMode, Sigma, SigmaMemory};
use crate::statistics::Statistics;
use crate::vector_field::VectorField;
use crate::{DegenerateLagrangian, Lagrangian, Real, Space, Vector};

/// A run of a method on a system with a fixed step.
///
/// As an iterator it yields the state after each step, for ever, or up to the first failure; after that
/// it yields `None`, and [`state`](Self::state) is the last good one. [`advance`](Self::advance) takes a
/// step without building a state.
pub struct Integrator<'a, S: Lagrangian, M: Carries<S, T>, T: Real = f64> {
    run: Run<'a, S, M, T>,
    /// At the start of the run.
    clock: Clock<T>,
}

impl<'a, S: Lagrangian, M: Method<S, T>, T: Real> Integrator<'a, S, M, T> {
    /// A run from `start` at time 0 with step `h`, which may be negative.
    ///
    /// # Errors
    /// [`StartError`] if a parameter array of the system or an array of the state has the wrong length,
    /// `h` is zero or not finite, a coordinate is not finite, an option of the method is out of range,
    /// the energy or a first derivative of L is not finite at the start ([`StartError::Undefined`]), or the
    /// starting values cannot be computed.
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
        evaluate(system, &q, &v, t)?;
        let memory = method.begin(system, &q, &v[..velocities(system)], t, h)?;
        Ok(Self::assemble(system, method, memory, q, t, h))
    }

    fn assemble(system: &'a S, method: M, memory: M::Memory, q: Vector<S, T>, t: T, h: T) -> Self {
        Self { run: Run::new(system, method, memory, q), clock: Clock::new(t, h) }
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
        let clock = self.clock.after(self.run.statistics.steps);
        self.run.steps(clock, count).map_err(|failure| self.error(failure))
    }

    #[cold]
    fn error(&mut self, failure: StepFailure) -> StepError {
        self.run.error(self.time(), failure)
    }

    /// The current state. The velocities of a regular system are not a number where the mass matrix is
    /// singular and the momenta have no velocity; an iterator yields an error there.
    pub fn state(&self) -> S::State<T> {
        self.run.state(self.time())
    }

    /// The energy v·∂L/∂v − L at the current state; H for a degenerate system.
    pub fn energy(&self) -> T {
        self.run.energy(self.time())
    }

    /// The current coordinates, flat, in the order of declaration.
    pub fn q(&self) -> &[T] {
        &self.run.q
    }

    /// The current coordinates in the storage of their space.
    pub(crate) fn vector(&self) -> &Vector<S, T> {
        &self.run.q
    }

    /// The current time, t₀ + steps · h, which does not accumulate rounding errors.
    #[inline]
    pub fn time(&self) -> T {
        self.clock.after(self.run.statistics.steps).time()
    }

    /// The number of completed steps.
    pub fn steps(&self) -> u64 {
        self.run.statistics.steps
    }

    /// The step h.
    pub fn step_size(&self) -> T {
        self.clock.step_size()
    }

    /// The system.
    pub fn system(&self) -> &'a S {
        self.run.system
    }

    /// The method.
    pub fn method(&self) -> &M {
        &self.run.method
    }

    /// What the method carries from step to step.
    pub fn memory(&self) -> &M::Memory {
        &self.run.memory
    }

    /// What the run has cost so far.
    pub fn statistics(&self) -> Statistics {
        self.run.statistics
    }

    /// The value of declared momentum `index`, in the order of
    /// [`Report::momenta`](crate::Report::momenta); `None` if there is no such momentum.
    pub fn momentum(&self, index: usize) -> Option<T> {
        self.run.momentum(index, self.time())
    }

    /// The names and values of all declared momenta.
    pub fn momenta(&self) -> impl Iterator<Item = (&'static str, T)> + '_ {
        self.run.momenta(self.time())
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
        evaluate(system, &q0, &system.space().vector(), t)?;
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
        let mut field = VectorField::new(self.run.system, &self.run.q, self.time())?;
        let mut xi = self.run.system.space().vector();
        field.generator(self.run.system, index, &self.run.q, self.time(), &mut xi)?;
        let along = self.run.memory.defect().iter().zip(xi.iter());
        Ok(Some(along.fold(momentum, |sum, (&c, &xi)| sum + c * xi)))
    }

    /// The parasitic mode as it was measured last: see [`SigmaMemory::parasitic_mode`].
    pub fn parasitic_mode(&self) -> Option<ParasiticMode<T>> {
        self.run.memory.parasitic_mode()
    }

    /// max |p − α(q)|. If σ = ½ and α is affine, this is the amplitude of the parasitic mode in p. Elsewhere it is of
    /// order h(1 − 2σ) on an orbit without such a mode and does not tell whether a run can be trusted; take
    /// [`parasitic_mode`](Self::parasitic_mode).
    pub fn parasitic_amplitude(&self) -> T {
        SigmaMemory::parasitic_amplitude(&self.run.memory)
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
        if self.run.failed {
            return None;
        }
        Some(self.advance_by(n as u64 + 1).and_then(|()| self.run.try_state(self.time())))
    }
}

impl<S: Lagrangian, M: Method<S, T>, T: Real> core::iter::FusedIterator for Integrator<'_, S, M, T> {}

impl<S: Lagrangian, M: Method<S, T> + fmt::Debug, T: Real> fmt::Debug for Integrator<'_, S, M, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Integrator")
            .field("system", &S::REPORT.system)
            .field("method", &self.run.method)
            .field("time", &self.time())
            .field("step_size", &self.step_size())
            .field("state", &self.state())
            .field("statistics", &self.run.statistics)
            .finish_non_exhaustive()
    }
}

fn validate<S: Lagrangian, T: Real>(system: &S, t: T, h: T) -> Result<(), StartError> {
    if !h.is_finite() || h == T::lift(0.0) {
        return Err(StartError::Step { h: reported(h) });
    }
    crate::run::validate(system, t)
}
