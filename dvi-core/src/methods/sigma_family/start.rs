//! Starting values: a two-step map needs a second point.
//!
//! Each start gives q1, and the run begins with p0 = −D₁L_d(q0, q1), so that its first step arrives
//! there.

use super::{Sigma, SigmaMemory};
use crate::error::StartError;
use crate::methods::{Method, RungeKutta, Step};
use crate::state::Statistics;
use crate::system::spinors;
use crate::{DegenerateLagrangian, Real, Vector};

/// How the second point of a run is found. A given second point goes to
/// [`Integrator::from_two_points`](crate::run::Integrator::from_two_points).
///
/// ```
#[doc = include_str!("../../../docs/hidden/vortices.txt")]
/// let heun = Sigma { start: Start::RungeKutta(RungeKutta::heun()), ..Sigma::midpoint() };
/// let mut consistent = Integrator::new(&Vortices, Sigma::midpoint(), 0.5, start.clone())?;
/// let mut heun = Integrator::new(&Vortices, heun, 0.5, start)?;
/// consistent.take_steps(1000)?;
/// heun.take_steps(1000)?;
/// assert!(consistent.memory().defect().iter().all(|c| c.abs() < 1e-14));
/// assert!(heun.memory().defect().iter().any(|c| c.abs() > 1e-6)); // what the start has left stays
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Start {
    /// One step of the implicit midpoint rule on q' = X(q). For σ = ½ and affine α this is p0 = α(q0).
    #[default]
    Consistent,
    /// One step of a Runge–Kutta method on q' = X(q); Rowley & Marsden use [`RungeKutta::midpoint`].
    RungeKutta(RungeKutta),
}

/// Where a step of `method` leads to.
pub(super) fn one_step<S: DegenerateLagrangian<T>, T: Real, M: Method<S, T>>(
    method: &M,
    system: &S,
    q: &Vector<S, T>,
    t: T,
    h: T,
) -> Result<Vector<S, T>, StartError> {
    let mut memory = method.begin(system, q, &[], t, h)?;
    let mut q = q.clone();
    let statistics = &mut Statistics::default();
    let step = Step { system, q: &mut q, t, h, statistics };
    method.step(step, &mut memory).map_err(StartError::Starter)?;
    Ok(q)
}

impl<T: Real> Sigma<T> {
    /// Prepares a run from `q0` at `t` whose first step arrives at `q1`.
    pub(crate) fn begin_between<S: DegenerateLagrangian<T>>(
        &self,
        system: &S,
        [q0, q1]: [&Vector<S, T>; 2],
        t: T,
        h: T,
    ) -> Result<SigmaMemory<S, T>, StartError> {
        // The phases between two states of unit vectors are not known.
        spinors::refuse::<S>("a run from two points")?;
        self.go_with(system, q0, t)?;
        SigmaMemory::between(system, self, [q0, q1], t, h)
    }
}
