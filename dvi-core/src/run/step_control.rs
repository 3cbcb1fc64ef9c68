//! What decides how long the steps of a run are.
//!
//! A method keeps its good long-time behaviour under variable steps if the whole map, step control included,
//! is symmetric or comes from a transformed system; choosing each step by the error of the one before
//! destroys it (Hairer, Lubich & Wanner 2006, section VIII.1). [`Reversible`] is of the first kind,
//! [`ErrorControl`] of the other. With [`EnergyMomentum`] the length of a step is an unknown of its
//! equations.

mod breaks;
mod controlled;
mod energy_momentum;
mod error_control;
mod one_length;
mod reversible;
mod seams;
mod search;
mod turns;
mod verdict;

use core::fmt::Debug;

use crate::error::{StartError, StepFailure};
#[cfg(doc)]
use crate::memory::Memory;
use crate::methods::{Carries, Method};
use crate::system::Same;
use crate::{Lagrangian, Real};

pub use controlled::ControlledRun;
pub use energy_momentum::EnergyMomentum;
pub use error_control::ErrorControl;
pub use one_length::OneLength;
pub use reversible::Reversible;

/// A rule for the length of each step of a run on `S`; [`OneLength`] for all of them is one.
///
/// The control takes the steps itself, so that it sees the run before and after each, and may take one back.
///
/// ```
#[doc = include_str!("../../docs/hidden/kepler.txt")]
/// /// How far 50 steps lead, under any control.
/// fn reached(control: impl StepControl<Kepler, f64>) -> Result<f64, Box<dyn std::error::Error>> {
///     let start = KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.2 };
///     let mut run = Integrator::controlled(&Kepler, Gauss::<4>::new(), control, start)?;
///     run.take_steps(50)?;
///     Ok(run.time())
/// }
/// assert!(reached(ErrorControl::new(1e-6, 0.1))? > reached(ErrorControl::new(1e-12, 0.1))?);
/// assert!(reached(Reversible::power(0.1, 1.5))? > reached(Reversible::power(0.05, 1.5))?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait StepControl<S: Lagrangian<T>, T: Real>: Carries<S, T> + Debug {
    /// As [`Method::Suited`](crate::methods::Method::Suited).
    type Suited<C>: Same<C, As = C>;

    /// Whether steps may be taken back, so that the run has to keep what it takes.
    const REJECTS: bool = false;

    /// Whether all steps have the length of the first, so that their times are known.
    const ONE_LENGTH: bool = false;

    /// Prepares a run from (`q`, `t`) with velocity `v`, which is empty for degenerate systems. Returns the
    /// length of the first step too. Everything that needs memory is allocated here.
    ///
    /// # Errors
    /// [`StartError::Parameter`] if an option is out of range, [`StartError::Unsupported`] if the control
    /// needs what the system does not have, [`StartError::Starter`] if its formulas fail at the start.
    fn begin(&self, system: &S, q: &[T], v: &[T], t: T) -> Result<(Self::Memory, T), StartError>;

    /// Prepares the control of a run that goes on from a checkpoint, for a memory that is
    /// [loaded](Memory::load) next.
    ///
    /// # Errors
    /// As [`begin`](Self::begin).
    fn begin_again(&self, system: &S, q: &[T], v: &[T], t: T) -> Result<Self::Memory, StartError> {
        self.begin(system, q, v, t).map(|(memory, _)| memory)
    }

    /// Whether a method of type `M` has what the control needs.
    ///
    /// # Errors
    /// [`StartError::Unsupported`].
    fn admit<M: Method<S, T>>(&self) -> Result<(), StartError> {
        Ok(())
    }

    /// Takes `run` one step on from time `t`, without allocation, and returns the length of the step.
    ///
    /// # Errors
    /// Any [`StepFailure`]; `memory` is then as it was before, and `run` goes back.
    fn step<M: Method<S, T>>(
        &self,
        memory: &mut Self::Memory,
        run: &mut ControlledRun<'_, S, M, T>,
        t: T,
    ) -> Result<T, StepFailure>;

    /// Takes `count` steps, one after the other, or as many as succeed.
    ///
    /// # Errors
    /// As [`step`](Self::step), from the first step that fails.
    #[inline]
    fn steps<M: Method<S, T>>(
        &self,
        memory: &mut Self::Memory,
        run: &mut ControlledRun<'_, S, M, T>,
        count: u64,
    ) -> Result<(), StepFailure> {
        for _ in 0..count {
            let t = run.stepper.clock().time();
            run.stepper.keep();
            let h = self.step(memory, run, t).inspect_err(|_| run.stepper.go_back())?;
            run.stepper.statistics.steps += 1;
            run.stepper.time.advance(h, run.stepper.statistics.steps);
        }
        Ok(())
    }
}

/// A method under the [`StepControl`] `X` for `S`, which is `C`, as a method
/// [suits](crate::methods::Suits) a system.
///
/// It is a trait of the method, so that rustc asks for it only where it knows that the method suits the
/// system.
pub trait Obeys<X, S: Lagrangian<T>, T: Real, C: Carries<S, T>> {
    /// `C`, of which it is known here that it controls steps on `S`.
    type Control: StepControl<S, T, Memory = C::Memory>;
    /// The control as it is.
    fn suited(control: X) -> C;
    /// The control as it is, as what controls steps on `S`.
    fn lengths(control: &C) -> &Self::Control;
}

impl<M, S: Lagrangian<T>, T: Real, C, X> Obeys<X, S, T, C> for M
where
    X: StepControl<S, T, Suited<X>: Same<X, As = C>>,
    C: StepControl<S, T>,
{
    type Control = C;
    #[inline]
    fn suited(control: X) -> C {
        X::Suited::<X>::same(control)
    }
    #[inline]
    fn lengths(control: &C) -> &C {
        control
    }
}
