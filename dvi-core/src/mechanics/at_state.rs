//! What can be asked of a system at one state, without a run.

use crate::error::StartError;
use crate::mechanics::constraints::consistent::{check, project};
use crate::mechanics::constraints::{ConstrainedLagrangian, Multipliers};
use crate::mechanics::motion::Rates;
use crate::mechanics::motion::constrained::acceleration;
use crate::system::start::{flatten, named, validate, velocities};
use crate::system::{Kind, System, spinors};
use crate::{Lagrangian, Real, Space, State, Vector};

/// What can be asked of a system at one state, at a time `t`, which counts where the Lagrangian depends on it.
///
/// ```
/// use dvi_core::prelude::*;
///
/// #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - x.powi(4) / 4.0)]
/// struct Quartic;
///
/// let state = QuarticState { x: 2.0, dot_x: 3.0 };
/// // x' and dot_x' along the motion.
/// let rates: QuarticState = Quartic.vector_field(0.0, &state)?;
/// assert_eq!((rates.x, rates.dot_x), (3.0, -8.0));
/// assert_eq!(Quartic.energy_at(0.0, &state)?, 4.5 + 4.0);
/// assert_eq!(Quartic.lagrangian_at(0.0, &state)?, 4.5 - 4.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// All of these functions return [`StartError`], as the start of a run does, if an array of the system or of
/// the state has the wrong length, a coordinate is not finite, or energy or first derivatives of L are not
/// finite there.
pub trait AtState<T: Real = f64>: Lagrangian<T> + Sized {
    /// The rates of change of all entries of `state` along the motion, named as they are: X(q), that is q'
    /// of Ω q' = ∇H + ∂α/∂t, for a degenerate system; velocities and accelerations for a regular one.
    ///
    /// # Errors
    /// Besides those of the trait, [`StartError::Undetermined`] where Ω or the mass matrix is singular. With
    /// constraints the state need not keep them: the accelerations are those with which their rates of
    /// change stay as they are, as other integrators need them for states in between.
    fn vector_field(&self, t: T, state: &Self::State<T>) -> Result<Self::State<T>, StartError>
    where
        Self: System<Kind: Rates<Self, T>>,
    {
        let at @ [q, _] = &point(self, t, state)?;
        let [mut rates, accelerations] = rates(self, t, at)?;
        spinors::lift_rates(self, q, &mut rates);
        Ok(State::read(&|block| self.block_len(block), &rates, &accelerations))
    }

    /// The energy v·∂L/∂v − L; H for a degenerate system.
    ///
    /// # Errors
    /// Those of the trait.
    fn energy_at(&self, t: T, state: &Self::State<T>) -> Result<T, StartError> {
        let [q, v] = point(self, t, state)?;
        Ok(self.energy(&q, &v[..velocities(self)], t))
    }

    /// L along the motion through `state`; for a degenerate system that is α(q)·X(q) − H(q).
    ///
    /// # Errors
    /// Those of [`vector_field`](Self::vector_field).
    fn lagrangian_at(&self, t: T, state: &Self::State<T>) -> Result<T, StartError>
    where
        Self: System<Kind: Rates<Self, T>>,
    {
        let at = point(self, t, state)?;
        let [velocity, _] = rates(self, t, &at)?;
        Ok(self.lagrangian(&at[0], &velocity, t))
    }

    /// dg/dt of declared event `index` along the motion through `state`: ∂g/∂t + ∂g/∂q·q' + ∂g/∂v·v'. Not a
    /// number if there is no such event.
    ///
    /// # Errors
    /// Those of [`vector_field`](Self::vector_field).
    fn event_rate(&self, t: T, index: usize, state: &Self::State<T>) -> Result<T, StartError>
    where
        Self: System<Kind: Rates<Self, T>>,
    {
        let at @ [q, v] = &point(self, t, state)?;
        let rates = rates(self, t, at)?;
        let [mut l_q, mut l_v]: [Vector<Self, T>; 2] = self.space().vectors();
        let by_time = self.event_gradient(index, q, &v[..velocities(self)], t, &mut l_q, &mut l_v);
        let along = l_q.iter().chain(l_v.iter()).zip(rates.iter().flat_map(|half| half.iter()));
        Ok(along.fold(by_time, |sum, (&by, &rate)| sum + by * rate))
    }
}

impl<S: Lagrangian<T>, T: Real> AtState<T> for S {}

/// What can be asked of a system with constraints at one state.
///
/// ```
/// use dvi_core::prelude::*;
///
/// /// A mass on a rod.
/// #[lagrangian(
///     coordinates(x, y),
///     lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - y,
///     constraint = x * x + y * y - 1.0,
/// )]
/// struct Pendulum;
///
/// let near = PendulumState { x: 0.0, y: -1.1, dot_x: 2.0, dot_y: 0.3 };
/// let state: PendulumState = Pendulum.projected(0.0, &near)?;
/// assert_eq!((state.y, state.dot_y), (-1.0, 0.0));
/// // The rod pulls by v² + 1 upwards, as the force 2λ(x, y).
/// let multipliers = Pendulum.multipliers_at(0.0, &state)?;
/// assert!((multipliers[0] + 2.5).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait OnConstraints<T: Real = f64>: ConstrainedLagrangian<T> {
    /// A state near `state` that the constraints admit at time `t`. Newton's method moves the positions
    /// until the constraints are kept up to rounding, from however far away, with steps that are the
    /// shortest in the metric of the mass matrix; the velocity is then changed by as little as possible. A
    /// run can begin at what is returned, and what it returns of that is the same but for rounding.
    ///
    /// # Errors
    /// [`StartError::Inconsistent`] where no position is found in 1500 iterations, or no velocity;
    /// [`StartError::Projection`] where a constraint is redundant; others as the start of a run has.
    fn projected(&self, t: T, state: &Self::State<T>) -> Result<Self::State<T>, StartError> {
        let [mut q, mut v] = point(self, t, state)?;
        project(self, [&mut q, &mut v], t)?;
        Ok(State::read(&|block| self.block_len(block), &q, &v))
    }

    /// The Lagrange multipliers λ at a state that the constraints admit at time `t`, one for each
    /// constraint: Gᵀλ is the force of the constraints, with G = ∂g/∂q or, of constraints of velocities, A.
    ///
    /// # Errors
    /// [`StartError::OffConstraint`] and [`StartError::AcrossConstraint`] at other states;
    /// [`StartError::Undetermined`] where a constraint is redundant or the mass matrix singular; others as
    /// the start of a run has.
    fn multipliers_at(&self, t: T, state: &Self::State<T>) -> Result<Multipliers<Self, T>, StartError> {
        let [q, v] = point(self, t, state)?;
        check(self, [&q, &v], t, None)?;
        let (_, multipliers) = acceleration(self, [&q, &v], t).map_err(StartError::Undetermined)?;
        Ok(multipliers)
    }
}

impl<S: ConstrainedLagrangian<T>, T: Real> OnConstraints<T> for S {}

/// The rates of change of coordinates and velocities.
fn rates<S: Lagrangian<T> + System<Kind: Rates<S, T>>, T: Real>(
    system: &S,
    t: T,
    [q, v]: &[Vector<S, T>; 2],
) -> Result<[Vector<S, T>; 2], StartError> {
    match S::Kind::rates(system, q, v, t) {
        Ok(acceleration) if S::Kind::REGULAR => Ok([v.clone(), acceleration]),
        Ok(velocity) => Ok([velocity, system.space().vector()]),
        Err(failure) => Err(named(system, [q, v], t, StartError::Undetermined(failure))),
    }
}

/// The coordinates and velocities of a state at which the system is defined.
fn point<S: Lagrangian<T>, T: Real>(
    system: &S,
    t: T,
    state: &S::State<T>,
) -> Result<[Vector<S, T>; 2], StartError> {
    validate(system, t)?;
    flatten(system, t, state)
}
