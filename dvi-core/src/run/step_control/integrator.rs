//! A run with steps of different lengths.

use core::fmt;

use super::clock::VariableClock;
use super::controlled::{ControlledRun, KeptSteps};
use super::{ErrorControl, Obeys, Reversible, StepControl, reversible};
#[cfg(feature = "alloc")]
use crate::error::CheckpointError;
use crate::error::{StartError, StepError, StepFailure};
use crate::memory::Memory;
use crate::methods::{Carries, Clock, Method, SuitsAnyStep, VariableStep};
#[cfg(feature = "alloc")]
use crate::run::Checkpoint;
use crate::run::{Between, Run, Stepper, WithMethod};
use crate::scalar::norm::reported;
use crate::state::Statistics;
use crate::system::StateOf;
use crate::system::start::{evaluate, flatten, named, step_error, validate, velocities};
use crate::{Held, Lagrangian, Real, RegularLagrangian, Scalar, System, Vector};

/// A run of a method on a system with steps chosen by a [`StepControl`].
///
/// Like [`Integrator`](crate::run::Integrator) it is a [`Run`], and an iterator that yields the state after
/// each step, up to the first failure; [`state`](Run::state) is always the last good one. The velocity is
/// taken along, so that a control can read it; for L = ½ v·M v − V(q, t) that is one product with M⁻¹ a
/// step.
///
/// ```
#[doc = include_str!("../../../docs/hidden/kepler.txt")]
/// // An orbit of eccentricity 0.9, from its pericentre.
/// let start = KeplerState { x: 0.1, y: 0.0, dot_x: 0.0, dot_y: 19_f64.sqrt() };
/// let control = Reversible::power(0.02, 1.5);
/// let mut run = ControlledIntegrator::new(&Kepler, Variational::trapezoid(), control, start)?;
/// let (energy, first) = (run.energy(), run.step_size());
/// run.take_steps(200)?;
/// assert!(run.step_size() > 10.0 * first); // further out steps are longer
/// assert!((run.energy() - energy).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct ControlledIntegrator<H, M, C, T = f64>
where
    H: Held,
    M: Carries<H::System, T>,
    C: Carries<H::System, T>,
    T: Real,
{
    pub(in crate::run) system: H,
    stepper: Stepper<H::System, M, T>,
    kept: KeptSteps<H::System, M, T>,
    control: C,
    control_memory: C::Memory,
    clock: VariableClock<T>,
    /// The length of the latest step, or of the first if there is none.
    h: T,
}

impl<H, M, C, T: Real> ControlledIntegrator<H, M, C, T>
where
    H: Held<System: Lagrangian<T>>,
    M: Carries<H::System, T>,
    C: Carries<H::System, T>,
{
    /// A run from `start` at time 0.
    ///
    /// # Errors
    /// [`StartError`] if an array has the wrong length, a coordinate is not finite, an option of the method
    /// or of the control is out of range, or their starting values cannot be computed.
    pub fn new<X, Y>(system: H, method: X, control: Y, start: StateOf<H, T>) -> Result<Self, StartError>
    where
        X: SuitsAnyStep<H::System, T, M>,
        M: Obeys<Y, H::System, T, C>,
    {
        Self::new_at(system, method, control, T::lift(0.0), start)
    }

    /// A run from `start` at time `t`; else as [`new`](Self::new).
    ///
    /// # Errors
    /// As [`new`](Self::new), and [`StartError::Parameter`] if `t` is not finite.
    pub fn new_at<X, Y>(
        system: H,
        method: X,
        control: Y,
        t: T,
        start: StateOf<H, T>,
    ) -> Result<Self, StartError>
    where
        X: SuitsAnyStep<H::System, T, M>,
        M: Obeys<Y, H::System, T, C>,
    {
        let (held, method, control) = (system.held(), method.suited(), M::suited(control));
        let (steps, lengths) = (X::steps(&method), M::lengths(&control));
        if H::System::TIME_TRANSFORMED {
            let reason = "the time of the system is transformed, which sets the lengths of its steps";
            return Err(StartError::Unsupported { option: "a step control", reason });
        }
        let [q, all] = begun(held, t, &start)?;
        let v = &all[..velocities(held)];
        lengths.admit(steps)?;
        let explained = |error| named(held, [&q, &all], t, error);
        let (control_memory, h) = lengths.begin(held, &q, v, t).map_err(explained)?;
        let begin = || steps.begin(held, &q, v, t, h).map_err(explained);
        let (memory, kept) = (begin()?, KeptSteps::new(&q, M::Control::REJECTS, begin)?);
        let (stepper, clock) = (Stepper::new(method, memory, q), VariableClock::new(t));
        Ok(Self { system, stepper, kept, control, control_memory, clock, h })
    }

    /// A run that goes on from `checkpoint`, bit by bit as if the other had not stopped. What a control
    /// carries from step to step, the length and the direction of the next step among it, is that of the
    /// checkpoint.
    ///
    /// # Errors
    /// As [`new_at`](Self::new_at), and [`StartError::Checkpoint`] if it has more or less than method and
    /// control carry on this system, or numbers that no run has.
    #[cfg(feature = "alloc")]
    pub fn resume<X, Y>(
        system: H,
        method: X,
        control: Y,
        checkpoint: &Checkpoint<T>,
    ) -> Result<Self, StartError>
    where
        X: SuitsAnyStep<H::System, T, M>,
        M: Obeys<Y, H::System, T, C>,
    {
        let (t, mut h) = (checkpoint.time(), checkpoint.step_size());
        let (held, method, control) = (system.held(), method.suited(), M::suited(control));
        let (steps, lengths) = (X::steps(&method), M::lengths(&control));
        validate(held, t)?;
        let [q, all] = checkpoint.point(held)?;
        let v = &all[..velocities(held)];
        lengths.admit(steps)?;
        let explained = |error| named(held, [&q, &all], t, error);
        let mut control_memory = lengths.begin_again(held, &q, v, t).map_err(explained)?;
        let begin = || steps.begin_again(held, &q, v, t, h).map_err(explained);
        let (mut memory, kept) = (begin()?, KeptSteps::new(&q, M::Control::REJECTS, begin)?);
        let mut clock = VariableClock::new(t);
        checkpoint.load::<H::System, M>(&mut memory, |reader| {
            control_memory.load(reader)?;
            clock.load(reader)?;
            reader.numbers(core::slice::from_mut(&mut h))?;
            let is_sound = clock.time() == t && h == checkpoint.step_size() && h != T::lift(0.0);
            if is_sound { Ok(()) } else { Err(CheckpointError::Damaged) }
        })?;
        let mut stepper = Stepper::new(method, memory, q);
        stepper.statistics = checkpoint.statistics();
        Ok(Self { system, stepper, kept, control, control_memory, clock, h })
    }

    /// The step control.
    pub fn control(&self) -> &C {
        &self.control
    }

    /// What the step control carries from step to step. Of [`EnergyMomentum`](super::EnergyMomentum) one
    /// reads here `discrete_energy()`, and its `defect()` in the last step; of
    /// [`ErrorControl`](super::ErrorControl) the `error()` of the last step in units of the tolerance, and
    /// the length of the `next_step()`.
    pub fn control_memory(&self) -> &C::Memory {
        &self.control_memory
    }
}

impl<H, M, C, T: Real> Run for ControlledIntegrator<H, M, C, T>
where
    H: Held<System: Lagrangian<T>>,
    M: VariableStep<H::System, T>,
    C: StepControl<H::System, T>,
{
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

    #[inline]
    fn take_steps(&mut self, count: u64) -> Result<(), StepError> {
        let Self { system, stepper, kept, control, control_memory, clock, h } = self;
        let mut run = ControlledRun::new(system.held(), stepper, kept);
        for _ in 0..count {
            let t = clock.time();
            match control.step(control_memory, &mut run, t) {
                Ok(length) => {
                    *h = length;
                    clock.advance(length);
                    run.stepper.statistics.steps += 1;
                }
                Err(failure) => return Err(run.stepper.error(run.system(), t, *h, failure)),
            }
        }
        Ok(())
    }

    #[cfg(feature = "alloc")]
    fn checkpoint(&self) -> Checkpoint<T> {
        Checkpoint::of(self.system(), &self.stepper, [self.time(), self.h], |record| {
            self.control_memory.save(record);
            self.clock.save(record);
            record.numbers(&[self.h]);
        })
    }

    /// The sum of all steps, compensated, so that its error does not grow with their number.
    #[inline]
    fn time(&self) -> T {
        self.clock.time()
    }

    #[inline]
    fn step_size(&self) -> T {
        self.h
    }

    #[inline]
    fn clock(&self) -> Option<Clock<T>> {
        None
    }

    fn set_state(&mut self, t: T, state: StateOf<H, T>) -> Result<(), StartError> {
        let (system, Stepper { method, memory, .. }) = (self.system.held(), &self.stepper);
        let [q, all] = begun(system, t, &state)?;
        let v = &all[..velocities(system)];
        let explained = |error| named(system, [&q, &all], t, error);
        let (control_memory, h) = self.control.begin(system, &q, v, t).map_err(explained)?;
        let begun = method.begin(system, &q, v, t, h).map_err(explained)?;
        let memory = method.begun_anew(memory, begun);
        self.stepper.move_to(memory, q);
        (self.control_memory, self.clock, self.h) = (control_memory, VariableClock::new(t), h);
        Ok(())
    }
}

impl<H, M, C, T: Real> WithMethod for ControlledIntegrator<H, M, C, T>
where
    H: Held<System: Lagrangian<T>>,
    M: VariableStep<H::System, T>,
    C: StepControl<H::System, T>,
{
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

impl<H, S: RegularLagrangian<T>, M, D, T: Real> ControlledIntegrator<H, M, Reversible<D>, T>
where
    H: Held<System = S>,
    M: VariableStep<S, T>,
    D: reversible::Density<T>,
{
    /// ρ at the current point, as the control has carried it along: a run from here with
    /// [`Reversible::start`] at this value goes on with the same steps, and with the velocity reversed it
    /// comes back by the same steps. Not a number where the momenta have no velocity.
    pub fn density(&self) -> T {
        self.control.density_at(&self.control_memory, self.q(), &self.v())
    }
}

impl<H, S: Lagrangian<T>, M, T: Real> ControlledIntegrator<H, M, ErrorControl<'_>, T>
where
    H: Held<System = S>,
    M: VariableStep<S, T>,
{
    /// Takes steps up to time `t`, of which the last one is as long as it takes to get there, to the
    /// rounding of the time. Nothing is allocated. The present time takes no step.
    ///
    /// # Errors
    /// [`StepFailure::Unreachable`] if `t` is past, in the direction of the next
    /// step, or not finite; the run can go on to another time.
    /// [`StepError`] of the first step that fails; the run stays at the last good state.
    pub fn advance_to(&mut self, t: T) -> Result<(), StepError> {
        let now = self.time();
        // A run that has come to a time may have passed it by rounding.
        let rounding = T::lift(2.0) * T::default_epsilon() * (Scalar::abs(t) + Scalar::abs(self.h));
        if !t.is_finite() || !(self.is_before(t) || Scalar::abs(now - t) <= rounding) {
            let failure = StepFailure::Unreachable { now: reported(now), target: reported(t) };
            return Err(step_error(self.system(), self.steps(), now, failure));
        }
        self.control_memory.set_end(Some(t));
        let result = self.steps_to(t);
        self.control_memory.set_end(None);
        result
    }

    /// Whether time `t` lies ahead, in the direction of the run.
    fn is_before(&self, t: T) -> bool {
        let now = self.time();
        if self.control_memory.next_step() > T::lift(0.0) { now < t } else { now > t }
    }

    fn steps_to(&mut self, t: T) -> Result<(), StepError> {
        while self.is_before(t) && self.time() + (t - self.time()) != self.time() {
            self.advance()?;
        }
        Ok(())
    }
}

impl<H: Held<System = S>, S: Lagrangian<T>, M, C, T: Real> Iterator for ControlledIntegrator<H, M, C, T>
where
    M: VariableStep<S, T>,
    C: StepControl<S, T>,
{
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
        let taken = self.take_steps(n as u64 + 1);
        Some(taken.and_then(|()| self.stepper.try_state(self.system.held(), self.clock.time())))
    }
}

impl<H: Held<System = S>, S: Lagrangian<T>, M, C, T: Real> core::iter::FusedIterator
    for ControlledIntegrator<H, M, C, T>
where
    M: VariableStep<S, T>,
    C: StepControl<S, T>,
{
}

impl<H: Held<System = S>, S: Lagrangian<T>, M, C, T: Real> fmt::Debug for ControlledIntegrator<H, M, C, T>
where
    M: VariableStep<S, T> + fmt::Debug,
    C: StepControl<S, T>,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ControlledIntegrator")
            .field("system", &S::REPORT.system)
            .field("method", &self.stepper.method)
            .field("control", &self.control)
            .field("time", &self.time())
            .field("step_size", &self.step_size())
            .field("state", &self.state())
            .field("statistics", &self.statistics())
            .finish_non_exhaustive()
    }
}

/// The coordinates and velocities of a state that a run can begin from.
fn begun<S: Lagrangian<T>, T: Real>(
    system: &S,
    t: T,
    start: &S::State<T>,
) -> Result<[Vector<S, T>; 2], StartError> {
    validate(system, t)?;
    let [q, v] = flatten(system, start)?;
    evaluate(system, &q, &v, t)?;
    Ok([q, v])
}
