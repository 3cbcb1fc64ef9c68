//! What can be asked of a system with constraints at one state, without a run.

use crate::error::StartError;
use crate::mechanics::at_state::point;
use crate::mechanics::constraints::consistent::{check, project};
use crate::mechanics::constraints::{ConstrainedLagrangian, Multipliers};
use crate::mechanics::motion::constrained::acceleration;
use crate::{Real, State};

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
/// let state: PendulumState = Pendulum.projected(0.0, &PendulumState { x: 0.0, y: -1.1, dot_x: 2.0, dot_y: 0.3 })?;
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
