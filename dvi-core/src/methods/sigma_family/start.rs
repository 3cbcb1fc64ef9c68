//! Starting values: a two-step map needs a second point.
//!
//! Each start gives q1, and the run begins with p0 = −D₁L_d(q0, q1), so that its first step arrives
//! there.

use crate::error::StartError;
use crate::methods::Method;
use crate::methods::RungeKutta;
use crate::state::Statistics;
use crate::{DegenerateLagrangian, Real, Vector};

/// How the second point of a run is found. A given second point goes to
/// [`Integrator::from_two_points`](crate::run::Integrator::from_two_points).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Start {
    /// One step of the implicit midpoint rule on q' = X(q). For σ = ½ and affine α this is p0 = α(q0).
    #[default]
    Consistent,
    /// One step of a Runge–Kutta method on q' = X(q); Rowley & Marsden use [`RungeKutta::midpoint`].
    RungeKutta(RungeKutta),
    /// The point to which the scheme itself leads along the smooth orbit through the first one, so that no parasitic mode is
    /// left but what the truncation of an expansion leaves, of order h⁹ in the coordinates, h¹⁰ if σ = ½.
    ///
    /// The defect c of the first point is determined by the condition that the central difference of eighth order of the
    /// defects along the scheme's own orbit vanishes,
    ///
    /// ```math
    /// F(q_0, c_0) = 2^{-8} \sum_{j=-4}^{4} (-1)^j \binom{8}{4 + j} c_j = 0,
    /// ```
    ///
    /// which is solved by c ← c − W⁻¹F, where W is what F makes of a parasitic solution as h → 0: one if Dα is antisymmetric or
    /// σ = ½. Each iteration takes four steps forward and four backward in time, and gains a factor of order h; there are at
    /// most 64. The system must be defined at these eight points. Where they do not converge, or what they find is not smooth, the
    /// step is too long: [`StepFailure::NotConverged`](crate::error::StepFailure::NotConverged) and
    /// [`StepFailure::NotSmooth`](crate::error::StepFailure::NotSmooth) in a [`StartError::Starter`], or the failure of a step around
    /// that leads out of the domain. If α is affine and σ = ½, this is
    /// [`Consistent`](Self::Consistent), bit by bit.
    ///
    /// On smooth solutions of multistep methods and their parasitic ones: Hairer, Lubich & Wanner 2006, chapter XV.
    Smooth,
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
    method
        .step(system, &mut memory, &mut q, t, h, &mut Statistics::default())
        .map_err(StartError::Starter)?;
    Ok(q)
}
