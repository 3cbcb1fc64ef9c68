//! Variational integrators of the quadrature family, for regular Lagrangians.
//!
//! L_d(q0, q1) = h Σⱼ wⱼ L(qʲ, q̇ʲ, t + cⱼh),   qʲ = bⱼ q0 + b̄ⱼ q1,   q̇ʲ = (Bⱼ q0 + B̄ⱼ q1)/h
//!
//! with the nodes and weights of a [`Quadrature`] and an interpolation that is linear, or fitted to a
//! [`Frequency`] (Marsden & West 2001, section 2.3; Kosmas & Vlachos, eqs. 9, 11 and 15). A step solves p0 =
//! −D₁L_d(q0, q1) for q1 and evaluates p1 = D₂L_d(q0, q1), as p1 = p0 + (D₁ + D₂)L_d, which rounds less.

mod coefficients;
mod lagrangian;
mod steps;
mod together;
mod verlet;

use crate::discrete::frequency::{self, Frequency, Local, Reading, Unfitted};
use crate::discrete::quadrature::{Midpoint, Quadrature, Rule, Simpson, Trapezoid};
use crate::error::StartError;
#[cfg(doc)]
use crate::error::StepFailure;
use crate::memory::lasting;
use crate::solve::{Solver, Stopping};
use crate::state::summation::Summation;
use crate::{NondegenerateLagrangian, Real, System};

use coefficients::Coefficients;
pub use coefficients::Fitting;

/// The quadrature family: the discrete Lagrangian is a quadrature rule of L on an interpolation between the
/// two ends.
///
/// ```math
/// L_d(q_0, q_1) = h \sum_j w_j\, L(q^j, \dot q^j, t + c_j h), \qquad
/// q^j = q_0 + c_j (q_1 - q_0), \quad \dot q^j = \frac{q_1 - q_0}{h}
/// ```
///
/// [`phase_fitted`](Self::phase_fitted) replaces the straight line by one that is exact on an oscillator.
///
/// | rule | step if L = ½ v·M v − V(q, t) | order |
/// |---|---|---|
/// | [`trapezoid`](Self::trapezoid), unfitted: Störmer–Verlet | explicit: one ∂L/∂q, no iteration, no factorisation | 2 |
/// | [`sigma`](Self::sigma) with σ = 0 or 1: symplectic Euler | explicit | 1 |
/// | the same two, fitted to a frequency that is given or left-frozen | explicit | 2 and 1 |
/// | others with Σ w c = ½, such as symmetric rules | implicit in q1 | 2 |
/// | others | implicit in q1 | 1 |
///
/// For other Lagrangians every step is implicit. The order is two for every rule that is exact for linear
/// functions, however many nodes it has, because the interpolation is linear;
/// [`Galerkin`](crate::methods::Galerkin) has higher orders. A run starts from p0 = ∂L/∂v(q0, v0).
///
/// The steps preserve dq ∧ dp, unless a frequency is read from the motion without being differentiated
/// ([`Reading`]). They conserve the momentum maps of symmetries that act linearly and leave the frequency as
/// it is.
///
/// On the oscillator of the fitted frequency ω the points of steps of one length lie on one of its motions,
/// whatever the rule, if sin u ≠ 0 and S ≠ 0 for u = ωh; near a zero of either a step ends with
/// [`StepFailure::Resonance`]. With symmetric rules it is the motion that begins at (q0, v0) if v0 = 0 or
/// with [`Fitting::PhaseAndMomentum`]; else it has another amplitude, because the momentum is off by a
/// factor that depends on the length. So steps of different lengths, and states between two points, are
/// exact with the latter only. With other rules it has another amplitude and phase. A fitted interpolation
/// is not translation invariant: constants are not among the functions that it interpolates.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// let mut run = Integrator::new(&Pendulum, Variational::trapezoid(), 0.1, start)?;
/// let energy = run.energy();
/// let mut change = |steps| -> Result<f64, StepError> {
///     let mut largest = 0.0_f64;
///     for _ in 0..steps {
///         run.advance()?;
///         largest = largest.max((run.energy() - energy).abs());
///     }
///     Ok(largest)
/// };
/// let (first, all) = (change(100)?, change(100_000)?); // some swings, and some 1500
/// assert!(all < 1.01 * first); // it does not drift
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Variational<F = Unfitted, R = Quadrature> {
    /// Nodes and weights.
    pub rule: R,
    /// What the interpolation is fitted to.
    pub frequency: F,
    /// Whether momenta are fitted too. Default: [`Fitting::Phase`].
    pub fitting: Fitting,
    /// How implicit steps are solved. [`Solver::FixedPoint`] is for L = ½ v·M v − V(q, t) only.
    pub solver: Solver,
    /// The criterion by which an implicit step counts as solved. Default: to rounding errors.
    pub stopping: Stopping,
    /// How the increments of the steps are added up. Default:
    /// [`Summation::Plain`].
    pub summation: Summation,
}

impl<R> Variational<Unfitted, R> {
    /// Any rule, with linear interpolation.
    pub fn new(rule: R) -> Self {
        Self {
            rule,
            frequency: Unfitted,
            fitting: Fitting::default(),
            solver: Solver::default(),
            stopping: Stopping::default(),
            summation: Summation::default(),
        }
    }
}

impl Variational {
    /// L_d = h L((q0 + q1)/2, Δ/h): the implicit midpoint rule.
    pub fn midpoint() -> Variational<Unfitted, Midpoint> {
        Variational::new(Midpoint)
    }

    /// L_d = (h/2)[L(q0, Δ/h) + L(q1, Δ/h)]: Störmer–Verlet, in the form kick–drift–kick, if L is separable.
    pub fn trapezoid() -> Variational<Unfitted, Trapezoid> {
        Variational::new(Trapezoid)
    }

    /// L_d = h L((1 − σ)q0 + σq1, Δ/h).
    pub fn sigma(sigma: f64) -> Self {
        Self::new(Quadrature::sigma(sigma))
    }

    /// Nodes 0, ½, 1 with weights 1/6, 2/3, 1/6.
    pub fn simpson() -> Variational<Unfitted, Simpson> {
        Variational::new(Simpson)
    }
}

impl<F, R> Variational<F, R> {
    /// The same rule with interpolation fitted to a frequency.
    pub fn phase_fitted<G>(self, frequency: G) -> Variational<G, R> {
        let Self { rule, fitting, solver, stopping, summation, .. } = self;
        Variational { rule, frequency, fitting, solver, stopping, summation }
    }
}

impl<F: Frequency, R: Rule> Variational<F, R> {
    /// Whether the step is Störmer–Verlet with plain sums, for separable systems.
    #[inline]
    fn is_verlet(&self) -> bool {
        F::UNFITTED
            && self.summation == Summation::Plain
            && self.rule.nodes() == Trapezoid.nodes()
            && self.rule.weights() == Trapezoid.weights()
    }

    /// Whether p0 = −D₁L_d is linear in q1, for separable systems.
    #[inline]
    fn is_explicit(&self) -> bool {
        self.rule.interior_nodes() == 0 && !self.reads_both_ends()
    }

    #[inline]
    fn reads_both_ends(&self) -> bool {
        matches!(self.frequency.reading(), Some(Reading::Averaged | Reading::Variational))
    }

    fn validate<S: NondegenerateLagrangian<T>, T: Real>(&self, system: &S) -> Result<(), StartError> {
        Quadrature::new(self.rule.nodes(), self.rule.weights())?;
        frequency::admit(&self.frequency, system)?;
        let goes = self.solver != Solver::FixedPoint || S::CONSTANT_MASS;
        let reason = "it needs L = ½ v·M v − V(q, t) with a constant matrix M; take Solver::Newton";
        StartError::unless_it(goes, "Solver::FixedPoint", reason)?;
        let goes = self.fitting == Fitting::Phase || self.frequency.reading() != Some(Reading::Variational);
        let reason = "its weights are not differentiated with the frequency; take Fitting::Phase";
        StartError::unless_it(goes, "Fitting::PhaseAndMomentum", reason)?;
        self.stopping.validate()
    }
}

/// The interpolation of a run.
#[derive(Debug)]
pub struct Interpolation<S: System, T: Real> {
    /// The coefficients for a frequency that is given.
    given: Coefficients<T>,
    /// The frequencies at both ends of the step.
    ends: [Local<S, T>; 2],
}

lasting!([S: System, T: Real] Interpolation<S, T>, T;);
