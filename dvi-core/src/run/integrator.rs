//! A run: a system, a method, a step, and where they have got to.

use core::fmt;

use crate::error::{StartError, StepError, StepFailure};
use crate::mechanics::VectorField;
use crate::memory::Aside;
use crate::methods::{BeginsBetween, Carries, Clock, Method, Suits};
use crate::methods::{ParasiticMode, Sigma, SigmaMemory};
#[cfg(feature = "alloc")]
use crate::run::Checkpoint;
use crate::run::kept::Kept;
use crate::run::{Between, Run, Stepper, WithMethod};
use crate::scalar::norm::reported;
use crate::state::Statistics;
use crate::system::StateOf;
use crate::system::start::{consistent, evaluate, flatten, named, validate_step, velocities};
use crate::{DegenerateLagrangian, Held, Lagrangian, Real, Space, System, Vector};

/// A run of a method on a system with a fixed step.
///
/// As an iterator it yields the state after each step, for ever, or up to the first failure; after that
/// it yields `None`, and [`state`](Run::state) is the last good one: no step ends outside of the domain of
/// L, whatever its equations need of that place ([`StepFailure::LeftDomain`]). [`advance`](Run::advance)
/// takes a step without building a state. What can be asked of a run are the methods of the trait [`Run`].
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// let mut run = Integrator::new(&Pendulum, Gauss::<4>::new(), 0.1, start)?;
/// let third = run.nth(2).unwrap()?; // the state after the third step
/// assert_eq!((run.steps(), run.state()), (3, third));
/// run.take_steps(997)?;
/// assert_eq!(run.time(), 100.0);
/// assert!((run.energy() + 1_f64.cos()).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Integrator<H: Held, M: Carries<H::System, T>, T: Real = f64> {
    pub(super) system: H,
    pub(super) stepper: Stepper<H::System, M, T>,
    /// At the start of the run.
    clock: Clock<T>,
    /// If steps are looked at: where those at hand have begun.
    kept: Option<Aside<Kept<H::System, M, T>>>,
}

impl<H: Held<System: Lagrangian<T>>, M: Carries<H::System, T>, T: Real> Integrator<H, M, T> {
    /// A run from `start` at time 0 with step `h`, which may be negative.
    ///
    /// # Errors
    /// [`StartError`] if a parameter array of the system or an array of the state has the wrong length,
    /// `h` is zero or not finite, a coordinate is not finite, an option of the method is out of range,
    /// the energy or a first derivative of L is not finite at the start ([`StartError::Undefined`]), or the
    /// starting values cannot be computed.
    pub fn new<X>(system: H, method: X, h: T, start: StateOf<H, T>) -> Result<Self, StartError>
    where
        X: Suits<H::System, T, M>,
    {
        Self::new_at(system, method, T::lift(0.0), h, start)
    }

    /// A run from `start` at time `t`; else as [`new`](Self::new).
    ///
    /// # Errors
    /// As [`new`](Self::new), and [`StartError::Parameter`] if `t` is not finite.
    pub fn new_at<X>(system: H, method: X, t: T, h: T, start: StateOf<H, T>) -> Result<Self, StartError>
    where
        X: Suits<H::System, T, M>,
    {
        let (held, method) = (system.held(), method.suited());
        let steps = X::steps(&method);
        let [q, v] = checked(held, t, h, &start)?;
        let begin = || {
            let begun = steps.begin(held, &q, &v[..velocities(held)], t, h);
            begun.map_err(|error| named(held, [&q, &v], t, error))
        };
        let (memory, kept) = (begin()?, Kept::if_looked_at(&q, begin)?);
        Ok(Self { system, stepper: Stepper::new(method, memory, q), clock: Clock::new(t, h), kept })
    }

    /// A run of [`Sigma`] that starts at `first`, time 0, and whose first step leads to `second`.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn from_two_points<X>(
        system: H,
        method: X,
        h: T,
        first: StateOf<H, T>,
        second: StateOf<H, T>,
    ) -> Result<Self, StartError>
    where
        X: BeginsBetween<H::System, T, M>,
    {
        let (held, t) = (system.held(), T::lift(0.0));
        validate(held, t, h)?;
        let ([q0, _], [q1, _]) = (flatten(held, &first)?, flatten(held, &second)?);
        let rest = held.space().vector();
        evaluate(held, &q0, &rest, t)?;
        consistent(held, &q0, t)?;
        evaluate(held, &q1, &rest, t + h)?;
        let begin = || {
            let begun = method.begin_between(held, &q0, &q1, t, h);
            begun.map_err(|error| named(held, [&q0, &rest], t, error))
        };
        let (memory, kept) = (begin()?, Kept::if_looked_at(&q0, begin)?);
        let stepper = Stepper::new(method.suited(), memory, q0);
        Ok(Self { system, stepper, clock: Clock::new(t, h), kept })
    }

    /// A run that goes on from `checkpoint`, bit by bit as if the other had not stopped; with another
    /// [step](Checkpoint::with_step_size) from the same momenta.
    ///
    /// # Errors
    /// As [`new_at`](Self::new_at), and [`StartError::Checkpoint`] if it has more or less than this method
    /// carries on this system, or numbers that no run has.
    #[cfg(feature = "alloc")]
    pub fn resume<X>(system: H, method: X, checkpoint: &Checkpoint<T>) -> Result<Self, StartError>
    where
        X: Suits<H::System, T, M>,
    {
        let (t, h) = (checkpoint.time(), checkpoint.step_size());
        let (held, method) = (system.held(), method.suited());
        let steps = X::steps(&method);
        crate::system::start::validate(held, t)?;
        validate_step(t, h)?;
        let [q, v] = checkpoint.point(held)?;
        let begin = || {
            let begun = steps.begin_again(held, &q, &v[..velocities(held)], t, h);
            begun.map_err(|error| named(held, [&q, &v], t, error))
        };
        let (mut memory, kept) = (begin()?, Kept::if_looked_at(&q, begin)?);
        let mut clock = Clock::new(t, h);
        checkpoint.load::<H::System, M>(&mut memory, |reader| {
            clock = Clock::load(checkpoint, reader)?;
            Ok(())
        })?;
        let mut run = Self { system, stepper: Stepper::new(method, memory, q), clock, kept };
        run.stepper.statistics = checkpoint.statistics();
        Ok(run)
    }
}

impl<H: Held<System: Lagrangian<T>>, M: Method<H::System, T>, T: Real> Run for Integrator<H, M, T> {
    type System = H::System;
    type Scalar = T;

    #[inline]
    fn system(&self) -> &H::System {
        self.system.held()
    }

    #[inline]
    fn between(&mut self) -> (&H::System, &mut dyn Between<H::System, T>) {
        (self.system.held(), &mut self.stepper)
    }

    #[inline]
    fn q(&self) -> &[T] {
        &self.stepper.q
    }

    fn v(&self) -> Vector<H::System, T> {
        self.stepper.known_velocity(self.system(), self.time())
    }

    #[inline]
    fn statistics(&self) -> Statistics {
        self.stepper.statistics
    }

    /// Takes `count` steps, as so many calls of [`advance`](Run::advance) would. It is faster than
    /// these where a method can keep its state in registers.
    #[inline]
    fn take_steps(&mut self, count: u64) -> Result<(), StepError> {
        let (system, clock) = (self.system.held(), self.clock.after(self.stepper.statistics.steps));
        // One of the two is not compiled.
        let taken = if Self::System::TIME_TRANSFORMED || Self::System::HAS_DOMAIN {
            let kept = self.kept.as_mut().map(|kept| -> &mut Kept<H::System, M, T> { kept });
            self.stepper.steps_looked_at(system, clock, count, kept)
        } else {
            self.stepper.steps(system, clock, count)
        };
        taken.map_err(|failure| self.error(failure))
    }

    #[cfg(feature = "alloc")]
    fn checkpoint(&self) -> Checkpoint<T> {
        let at = [self.time(), self.step_size()];
        Checkpoint::of(self.system(), &self.stepper, at, |record| self.clock.save(record))
    }

    /// t₀ + steps · h, which does not accumulate rounding errors.
    #[inline]
    fn time(&self) -> T {
        self.clock.after(self.stepper.statistics.steps).time()
    }

    #[inline]
    fn step_size(&self) -> T {
        self.clock.step_size()
    }

    #[inline]
    fn clock(&self) -> Option<Clock<T>> {
        Some(self.present())
    }

    fn set_state(&mut self, t: T, state: StateOf<H, T>) -> Result<(), StartError> {
        let (system, h) = (self.system.held(), self.step_size());
        let Stepper { method, memory, statistics, .. } = &self.stepper;
        let [q, v] = checked(system, t, h, &state)?;
        let begun = method.begin(system, &q, &v[..velocities(system)], t, h);
        let memory = method.begun_anew(memory, begun.map_err(|error| named(system, [&q, &v], t, error))?);
        self.clock = Clock::new(t, h).after(statistics.steps.wrapping_neg());
        self.stepper.move_to(memory, q);
        Ok(())
    }
}

impl<H: Held<System: Lagrangian<T>>, M: Method<H::System, T>, T: Real> WithMethod for Integrator<H, M, T> {
    type Method = M;

    #[inline]
    fn method(&self) -> &M {
        &self.stepper.method
    }

    #[inline]
    fn memory(&self) -> &M::Memory {
        &self.stepper.memory
    }
}

impl<H: Held<System = S>, S: Lagrangian<T>, M: Method<S, T>, T: Real> Integrator<H, M, T> {
    /// The clock at the present time.
    pub(super) fn present(&self) -> Clock<T> {
        self.clock.after(self.stepper.statistics.steps)
    }

    /// Whether steps may be taken many at once, without a look at the end of each.
    #[cfg(feature = "alloc")]
    pub(super) fn is_unwatched(&self) -> bool {
        self.kept.is_none()
    }

    #[cold]
    fn error(&mut self, failure: StepFailure) -> StepError {
        let (time, h) = (self.time(), self.step_size());
        self.stepper.error(self.system.held(), time, h, failure)
    }
}

impl<H: Held<System = S>, S: DegenerateLagrangian<T>, T: Real> Integrator<H, Sigma<T>, T> {
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
        let (system, q, t) = (self.system(), &self.stepper.q, self.time());
        let mut field = VectorField::new(system, q, t)?;
        let mut xi = system.space().vector();
        field.generator(system, index, q, t, &mut xi)?;
        let along = self.stepper.memory.defect().iter().zip(xi.iter());
        Ok(Some(along.fold(momentum, |sum, (&c, &xi)| sum + c * xi)))
    }

    /// The parasitic mode as it was measured last: see [`ParasiticMode`].
    pub fn parasitic_mode(&self) -> Option<ParasiticMode<T>> {
        self.stepper.memory.parasitic_mode()
    }

    /// max |p − α(q)|. If σ = ½ and α is affine, this is the amplitude of the parasitic mode in p. Elsewhere
    /// it is of order h(1 − 2σ) on an orbit without such a mode and does not tell whether a run can be
    /// trusted; take [`parasitic_mode`](Self::parasitic_mode).
    pub fn parasitic_amplitude(&self) -> T {
        SigmaMemory::parasitic_amplitude(&self.stepper.memory)
    }
}

impl<H: Held<System = S>, S: Lagrangian<T>, M: Method<S, T>, T: Real> Iterator for Integrator<H, M, T> {
    type Item = Result<S::State<T>, StepError>;

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        self.nth(0)
    }

    /// Skips `n` states without building them and yields the next. Unlike elsewhere, a failure on the way is
    /// not skipped but yielded.
    #[inline]
    fn nth(&mut self, n: usize) -> Option<Self::Item> {
        if self.stepper.failed {
            return None;
        }
        Some(self.take_steps(n as u64 + 1).and_then(|()| {
            let time = self.time();
            self.stepper.try_state(self.system.held(), time)
        }))
    }
}

impl<H: Held<System = S>, S: Lagrangian<T>, M: Method<S, T>, T: Real> core::iter::FusedIterator
    for Integrator<H, M, T>
{
}

impl<H: Held<System = S>, S: Lagrangian<T>, M: Method<S, T> + fmt::Debug, T: Real> fmt::Debug
    for Integrator<H, M, T>
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Integrator")
            .field("system", &S::REPORT.system)
            .field("method", &self.stepper.method)
            .field("time", &self.time())
            .field("step_size", &self.step_size())
            .field("state", &self.state())
            .field("statistics", &self.stepper.statistics)
            .finish_non_exhaustive()
    }
}

/// The coordinates and velocities of a state that a run can begin from.
fn checked<S: Lagrangian<T>, T: Real>(
    system: &S,
    t: T,
    h: T,
    start: &S::State<T>,
) -> Result<[Vector<S, T>; 2], StartError> {
    validate(system, t, h)?;
    let [q, v] = flatten(system, start)?;
    evaluate(system, &q, &v, t)?;
    consistent(system, &q, t)?;
    Ok([q, v])
}

fn validate<S: Lagrangian<T>, T: Real>(system: &S, t: T, h: T) -> Result<(), StartError> {
    crate::system::start::validate(system, t)?;
    validate_step(t, h)?;
    if t + h == t { Err(StartError::Step { h: reported(h) }) } else { Ok(()) }
}
