//! What can be asked of a system at one state, without a run.

use crate::error::StartError;
use crate::mechanics::motion::Rates;
use crate::system::spinors;
use crate::system::start::{evaluate, flatten, named, validate, velocities};
use crate::{Lagrangian, Real, Space, State, System};

/// A system at a time t. Made by [`AtState::at_time`].
#[derive(Debug)]
pub struct AtTime<'a, S, T = f64> {
    system: &'a S,
    t: T,
}

/// What can be asked of a system at one state.
///
/// Time is 0 where the Lagrangian depends on it; [`at_time`](Self::at_time) asks at another.
///
/// ```
/// use dvi_core::prelude::*;
///
/// #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - x.powi(4) / 4.0)]
/// struct Quartic;
///
/// let state = QuarticState { x: 2.0, dot_x: 3.0 };
/// // x' and dot_x' along the motion.
/// let rates: QuarticState = Quartic.vector_field(&state)?;
/// assert_eq!((rates.x, rates.dot_x), (3.0, -8.0));
/// assert_eq!(Quartic.energy_at(&state)?, 4.5 + 4.0);
/// assert_eq!(Quartic.lagrangian_at(&state)?, 4.5 - 4.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// All of these functions return [`StartError`], as the start of a run does, if an array of the system or of
/// the state has the wrong length, a coordinate is not finite, or energy or first derivatives of L are not
/// finite there.
pub trait AtState<T: Real = f64>: Lagrangian<T> + Sized {
    /// The system at time `t`, of which the same is asked by `vector_field`, `energy` and `lagrangian`.
    fn at_time(&self, t: T) -> AtTime<'_, Self, T> {
        AtTime { system: self, t }
    }

    /// The rates of change of all entries of `state` along the motion, named as they are: X(q), that is q'
    /// of Ω q' = ∇H + ∂α/∂t, for a degenerate system; velocities and accelerations for a regular one.
    ///
    /// # Errors
    /// Besides those of the trait, [`StartError::Undetermined`] where Ω or the mass matrix is singular. With
    /// constraints the state need not keep them: the accelerations are those with which their rates of
    /// change stay as they are, as other integrators need them for states in between.
    fn vector_field(&self, state: &Self::State<T>) -> Result<Self::State<T>, StartError>
    where
        Self: System<Kind: Rates<Self, T>>,
    {
        self.at_time(T::lift(0.0)).vector_field(state)
    }

    /// The energy v·∂L/∂v − L; H for a degenerate system.
    ///
    /// # Errors
    /// Those of the trait.
    fn energy_at(&self, state: &Self::State<T>) -> Result<T, StartError> {
        self.at_time(T::lift(0.0)).energy(state)
    }

    /// L along the motion through `state`; for a degenerate system that is α(q)·X(q) − H(q).
    ///
    /// # Errors
    /// Those of [`vector_field`](Self::vector_field).
    fn lagrangian_at(&self, state: &Self::State<T>) -> Result<T, StartError>
    where
        Self: System<Kind: Rates<Self, T>>,
    {
        self.at_time(T::lift(0.0)).lagrangian(state)
    }
}

impl<S: Lagrangian<T>, T: Real> AtState<T> for S {}

impl<S: AtState<T>, T: Real> AtTime<'_, S, T> {
    /// See [`AtState::vector_field`].
    ///
    /// # Errors
    /// As there.
    pub fn vector_field(&self, state: &S::State<T>) -> Result<S::State<T>, StartError>
    where
        S: System<Kind: Rates<S, T>>,
    {
        let [q, v] = self.point(state)?;
        let [mut rates, accelerations] = self.rates([&q, &v])?;
        spinors::lift_rates(self.system, &q, &mut rates);
        Ok(S::State::read(|block| self.system.block_len(block), &rates, &accelerations))
    }

    /// See [`AtState::energy_at`].
    ///
    /// # Errors
    /// As there.
    pub fn energy(&self, state: &S::State<T>) -> Result<T, StartError> {
        let [q, v] = self.point(state)?;
        Ok(self.system.energy(&q, &v[..velocities(self.system)], self.t))
    }

    /// See [`AtState::lagrangian_at`].
    ///
    /// # Errors
    /// As there.
    pub fn lagrangian(&self, state: &S::State<T>) -> Result<T, StartError>
    where
        S: System<Kind: Rates<S, T>>,
    {
        let Self { system, t } = *self;
        let [q, v] = self.point(state)?;
        // Of either kind the first is the velocity.
        let [velocity, _] = self.rates([&q, &v])?;
        Ok(system.lagrangian(&q, &velocity, t))
    }

    /// dg/dt of declared event `index` along the motion through `state`: ∂g/∂t + ∂g/∂q·q' + ∂g/∂v·v'. Not a
    /// number if there is no such event.
    ///
    /// # Errors
    /// Those of [`vector_field`](Self::vector_field).
    pub fn event_rate(&self, index: usize, state: &S::State<T>) -> Result<T, StartError>
    where
        S: System<Kind: Rates<S, T>>,
    {
        let Self { system, t } = *self;
        let [q, v] = self.point(state)?;
        let rates = self.rates([&q, &v])?;
        let [mut l_q, mut l_v] = [system.space().vector(), system.space().vector()];
        let by_time = system.event_gradient(index, &q, &v[..velocities(system)], t, &mut l_q, &mut l_v);
        let along = l_q.iter().chain(l_v.iter()).zip(rates.iter().flat_map(|half| half.iter()));
        Ok(along.fold(by_time, |sum, (&by, &rate)| sum + by * rate))
    }

    /// The rates of change of coordinates and velocities.
    fn rates(&self, [q, v]: [&crate::Vector<S, T>; 2]) -> Result<[crate::Vector<S, T>; 2], StartError>
    where
        S: System<Kind: Rates<S, T>>,
    {
        let rates = S::Kind::rates(self.system, q, v, self.t);
        rates.map_err(|failure| named(self.system, [q, v], self.t, StartError::Undetermined(failure)))
    }

    /// The coordinates and velocities of a state at which the system is defined.
    fn point(&self, state: &S::State<T>) -> Result<[crate::Vector<S, T>; 2], StartError> {
        validate(self.system, self.t)?;
        let [q, v] = flatten(self.system, state)?;
        evaluate(self.system, &q, &v, self.t)?;
        Ok([q, v])
    }
}
