//! A run: a system, a method, and where they have got to, whatever chooses the lengths of the steps.

mod begun;
mod between;
mod borrowed;
#[cfg(feature = "alloc")]
mod checkpoint;
mod clock;
mod dense;
mod events;
mod integrator;
mod kept;
mod outside;
#[cfg(feature = "alloc")]
mod resume;
mod step_control;
mod stepper;
mod steps;
#[cfg(feature = "alloc")]
mod together;

use core::iter::FusedIterator;

use crate::error::{StartError, StepError};
use crate::mechanics::motion::Rates;
use crate::methods::Clock;
use crate::state::Statistics;
use crate::{Lagrangian, Real, Scalar as _, Space, State, System, Vector};

use between::Between;
#[cfg(feature = "alloc")]
pub use checkpoint::Checkpoint;
pub use dense::Dense;
#[cfg(feature = "ensembles")]
pub(crate) use dense::is_now;
use events::{Conditions, Declared};
pub use events::{Direction, Event, Events};
pub use integrator::Integrator;
pub use step_control::{
    ControlledRun, EnergyMomentum, ErrorControl, Obeys, OneLength, Reversible, StepControl,
};
pub(crate) use stepper::Stepper;
#[cfg(feature = "alloc")]
pub use together::Together;

/// A run of a method on a system: what an [`Integrator`] can do.
///
/// `dyn Run<System = S, Scalar = f64>` is a run of any method: [one that is chosen at run
/// time](crate::guide::choosing_a_method#a-method-that-is-chosen-at-run-time) is one line. In a `Box` or
/// behind `&mut` it is a run too.
///
/// ```
#[doc = include_str!("../docs/hidden/kepler.txt")]
/// /// The largest change of energy in `steps` steps of any run.
/// fn change<R: Run<Scalar = f64>>(run: &mut R, steps: u64) -> Result<f64, StepError> {
///     let (energy, mut largest) = (run.energy(), 0.0_f64);
///     for _ in 0..steps {
///         run.advance()?;
///         largest = largest.max((run.energy() - energy).abs());
///     }
///     Ok(largest)
/// }
/// let mut run = Integrator::new(&Kepler, Gauss::<4>::new(), 0.05, start)?;
/// assert!(change(&mut run, 1000)? < 1e-10);
/// assert_eq!(run.momenta().next(), Some(("angular", run.momentum(0).unwrap())));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Run {
    /// The system that is stepped.
    type System: Lagrangian<Self::Scalar>;
    /// The numbers that it is done with.
    type Scalar: Real;

    /// The system.
    fn system(&self) -> &Self::System;

    /// The system, and what takes its last step again in part: see [`Dense`].
    fn between(&mut self) -> (&Self::System, &mut dyn Between<Self::System, Self::Scalar>);

    /// The current coordinates, flat, in the order of declaration.
    fn q(&self) -> &[Self::Scalar];

    /// The current velocities, flat, in the order of declaration: not a number where the mass matrix is
    /// singular and the momenta have no velocity, and zero for a degenerate system, whose states have none.
    fn v(&self) -> Vector<Self::System, Self::Scalar>;

    /// What the run has cost so far.
    fn statistics(&self) -> Statistics;

    /// Takes `count` steps, as so many calls of [`advance`](Self::advance) would, bit by bit.
    ///
    /// # Errors
    /// [`StepError`] of the first step that fails; the run stays at the last good state.
    fn take_steps(&mut self, count: u64) -> Result<(), StepError>;

    /// The current time: τ of a system whose time is transformed, whose t is in its state.
    fn time(&self) -> Self::Scalar;

    /// The length h of the latest step; before the first, the one that it will have or, if a step control
    /// may reject it, be tried with.
    fn step_size(&self) -> Self::Scalar;

    /// The times of the next steps, if they are known: those of a step control are not.
    fn clock(&self) -> Option<Clock<Self::Scalar>>;

    /// Goes on from another state, at time `t`: as a run that begins there, in the same direction, with its
    /// momenta from the velocities, no parasitic mode, and no guess from steps before. Of
    /// [`Langevin`](crate::methods::Langevin) the noise goes on. A step control begins anew too, with its
    /// first step. What the run has cost counts on, and a run that has failed can go on. It allocates what a
    /// new run allocates.
    ///
    /// # Errors
    /// [`StartError`], as of a run that begins; the run is then where it was.
    fn set_state(
        &mut self,
        t: Self::Scalar,
        state: <Self::System as System>::State<Self::Scalar>,
    ) -> Result<(), StartError>;

    /// The states at the given `times`, which do not decrease in the direction of the run, as an iterator of
    /// times and states, which takes steps as it must and ends with the first error: see [`Dense`].
    ///
    /// # Errors
    /// [`StartError`] if no run of the method can begin at the present point.
    fn states_at<I>(&mut self, times: I) -> Result<impl FusedIterator<Item = dense::Timed<Self>>, StartError>
    where
        Self: Sized,
        I: IntoIterator<Item = Self::Scalar>,
    {
        let (mut dense, mut failed) = (self.dense()?, false);
        let state_at = move |t| {
            if failed {
                return None;
            }
            let state = dense.state_at(t).map(|state| (t, state));
            failed = state.is_err();
            Some(state)
        };
        Ok(times.into_iter().map_while(state_at).fuse())
    }

    /// The events of the run: where conditions `g(t, state)` cross zero, each in its direction: see
    /// [`Events`].
    ///
    /// # Errors
    /// [`StartError`] if no run of the method can begin at the present point, or a condition is no number
    /// there.
    fn events<G, const N: usize>(
        &mut self,
        directions: [Direction; N],
        g: G,
    ) -> Result<Events<&mut Self, G, N>, StartError>
    where
        Self: Sized,
        G: FnMut(Self::Scalar, &<Self::System as System>::State<Self::Scalar>) -> [Self::Scalar; N],
    {
        Events::new(self.dense()?, directions, g)
    }

    /// The [events](Run::events) that are declared by `events(name = g, …)` in the attribute of the system, a
    /// direction for each of them, which the compiler asks for; their names are in
    /// [`Report::events`](crate::Report::events).
    ///
    /// # Errors
    /// As [`events`](Self::events).
    fn declared_events<const N: usize>(
        &mut self,
        directions: [Direction; N],
    ) -> Result<Events<&mut Self, impl Conditions<Self::System, Self::Scalar, N>, N>, StartError>
    where
        Self: Sized,
    {
        const {
            assert!(Self::System::REPORT.events.len() == N, "there is a direction for each declared event");
        }
        Events::new(self.dense()?, directions, Declared)
    }

    /// The run with the state at any time of its last step: see [`Dense`].
    ///
    /// # Errors
    /// [`StartError`] if no run of the method can begin at the present point.
    fn dense(&mut self) -> Result<Dense<&mut Self>, StartError>
    where
        Self: Sized,
    {
        Dense::new(self)
    }

    /// Takes one step. Nothing is allocated.
    ///
    /// # Errors
    /// [`StepError`]; the run stays at the last good state, and the step can be tried again.
    #[inline]
    fn advance(&mut self) -> Result<(), StepError> {
        self.take_steps(1)
    }

    /// The current state. The velocities of a regular system are not a number where the mass matrix is
    /// singular and the momenta have no velocity; an iterator yields an error there.
    fn state(&self) -> <Self::System as System>::State<Self::Scalar> {
        State::read(&|block| self.system().block_len(block), self.q(), &self.v())
    }

    /// The energy v·∂L/∂v − L at the current state; H for a degenerate system.
    fn energy(&self) -> Self::Scalar {
        self.system().energy(self.q(), &self.v(), self.time())
    }

    /// The power F·q' of the [forces](Lagrangian::applied_force) at the current state; zero if there are
    /// none. Not a number where the velocities are not determined. [`Work`](crate::diagnostics::Work) is its
    /// integral.
    fn power(&self) -> Self::Scalar
    where
        Self: Sized,
        <Self::System as System>::Kind: Rates<Self::System, Self::Scalar>,
    {
        let (system, t, v, zero) = (self.system(), self.time(), self.v(), Self::Scalar::lift(0.0));
        if !Self::System::FORCED {
            return zero;
        }
        let [mut q, mut force] = system.space().vectors();
        q.copy_from_slice(self.q());
        system.applied_force(&q, &v, t, &mut force);
        let rates = || <Self::System as System>::Kind::rates(system, &q, &[], t);
        let Ok(velocity) = (if Self::System::REGULAR { Ok(v) } else { rates() }) else {
            return Self::Scalar::lift(f64::NAN);
        };
        force.iter().zip(velocity.iter()).fold(zero, |sum, (&force, &v)| sum + force * v)
    }

    /// The run as data, from which another one can go on as if this had not stopped.
    #[cfg(feature = "alloc")]
    fn checkpoint(&self) -> Checkpoint<Self::Scalar>;

    /// The number of completed steps.
    #[inline]
    fn steps(&self) -> u64 {
        self.statistics().steps
    }

    /// The value of declared momentum `index`, in the order of
    /// [`Report::momenta`](crate::Report::momenta); `None` if there is no such momentum.
    fn momentum(&self, index: usize) -> Option<Self::Scalar> {
        (index < Self::System::REPORT.momenta.len())
            .then(|| self.system().momentum(index, self.q(), &self.v(), self.time()))
    }

    /// The names and values of all declared momenta.
    fn momenta(&self) -> impl Iterator<Item = (&'static str, Self::Scalar)> + '_
    where
        Self: Sized,
    {
        let names = Self::System::REPORT.momenta.iter().enumerate();
        names.filter_map(|(index, &name)| self.momentum(index).map(|value| (name, value)))
    }
}
