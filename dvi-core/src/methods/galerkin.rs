//! Variational integrators with interior displacements, of even orders 4 to 16 for regular Lagrangians.
//!
//! qʲ = bⱼ q0 + b̄ⱼ q1 + δʲ      q̇ʲ = (Bⱼ q0 + B̄ⱼ q1 + Σₖ aⱼₖ δᵏ)/h      δ¹ = δˢ = 0
//! L_d(q0, q1) = h Σⱼ wⱼ L(qʲ, q̇ʲ, t + cⱼh), stationary in the δ of the interior nodes
//!
//! with the nodes cⱼ and weights wⱼ of a Lobatto rule, and aⱼₖ the derivative at cⱼ of the Lagrange
//! polynomial of node k (Kosmas & Vlachos, eqs. 26 to 29). With linear interpolation q(c) is any polynomial
//! of degree s − 1, and the step is the Lobatto IIIA–IIIB pair (Marsden & West 2001, theorem 2.6.1). A step
//! solves p0 = −D₁L_d(q0, q1) together with ∂L_d/∂δ = 0 and evaluates p1 = D₂L_d(q0, q1), as p1 = p0 + (D₁ +
//! D₂)L_d, which rounds less.

mod attempt;
mod coefficients;
mod displaced;
mod evaluation;
mod interior;
mod memory;
mod steps;

use crate::discrete::frequency::Unfitted;
use crate::mechanics::motion::{InLanes, OneByOne};
use crate::methods::Tabulated;
use crate::solve::{Solver, Stopping};
use crate::state::summation::Summation;
use evaluation::NodeEvaluation;

/// The discrete Lagrangian of the Lobatto rule with `S` nodes, 3 ≤ `S` ≤ 9, stationary in displacements of
/// the interior nodes.
///
/// ```math
/// L_d(q_0, q_1) = \operatorname*{ext}_{\delta_2, \dots, \delta_{S-1}} \; h \sum_{j=1}^{S} w_j\, L(q^j, \dot q^j, t + c_j h)
/// ```
///
/// The order is 2`S` − 2 for every regular L, and the method is symmetric. It preserves dq ∧ dp and the
/// momentum maps of symmetries that act linearly, unless the frequency is read from the motion. For L = ½
/// v·M v − V(q, t) a step is solved by a fixed point that needs `S` − 2 values of ∂L/∂q an iteration, and
/// one more for the step. For any other L it is solved by Newton's method in (`S` − 1) n unknowns for n
/// coordinates, with all second derivatives of L: about `S`² n² numbers where n is known when compiled.
///
/// [`in_lanes`](Self::in_lanes) evaluates ∂L/∂q at all interior nodes at once, in SIMD lanes, and gives the
/// same numbers, bit for bit. [`Summation::Compensated`] goes with high orders, whose steps are long: with
/// it energies are kept to rounding errors.
///
/// The interpolation may be [fitted](Self::phase_fitted) to a frequency that is
/// [`Constant`](crate::discrete::Constant) or read from the motion as
/// [`Reading::Averaged`](crate::discrete::Reading::Averaged). On the oscillator of that frequency the phase
/// error of a step is then of order 2`S` + 1 in ωh, not 2`S` − 1. It is not zero, as it would be without
/// displacements, because the polynomials of the displacements are not fitted. The fitted interpolation is
/// not translation invariant.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// let mut run = Integrator::new(&Pendulum, Galerkin::<5>::new(), 0.2, start)?;
/// assert_eq!(run.method().order(), 8);
/// let energy = run.energy();
/// run.take_steps(10_000)?;
/// assert!((run.energy() - energy).abs() < 1e-10);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Galerkin<const S: usize, F = Unfitted, E = OneByOne> {
    /// What the interpolation between the ends is fitted to.
    pub frequency: F,
    /// How steps are solved. [`Solver::FixedPoint`] is for L = ½ v·M v − V(q, t) only.
    pub solver: Solver,
    /// The criterion by which a step counts as solved. Default: to rounding errors.
    pub stopping: Stopping,
    /// How the increments of the steps are added up. Default: [`Summation::Plain`].
    pub summation: Summation,
    /// How ∂L/∂q is evaluated at the interior nodes.
    pub evaluation: E,
}

impl<const S: usize> Galerkin<S> {
    /// The method with linear interpolation between the ends: Lobatto IIIA–IIIB. A number of nodes below 3
    /// or above 9 does not compile.
    pub fn new() -> Self
    where
        Self: Tabulated,
    {
        Self::default()
    }

    /// The same with ∂L/∂q at all interior nodes evaluated at once, for 4 ≤ `S`.
    ///
    /// It has to do with L = ½ v·M v − V(q, t) solved by the fixed point. Steps of other L, those with a
    /// frequency, and those that are left to Newton's method are solved as without.
    #[must_use]
    pub fn in_lanes(self) -> Galerkin<S, Unfitted, InLanes> {
        let Self { frequency, solver, stopping, summation, .. } = self;
        Galerkin { frequency, solver, stopping, summation, evaluation: InLanes }
    }
}

impl<const S: usize, F> Galerkin<S, F> {
    /// The same nodes with interpolation fitted to a frequency.
    pub fn phase_fitted<G>(self, frequency: G) -> Galerkin<S, G> {
        let Self { solver, stopping, summation, evaluation, .. } = self;
        Galerkin { frequency, solver, stopping, summation, evaluation }
    }
}
