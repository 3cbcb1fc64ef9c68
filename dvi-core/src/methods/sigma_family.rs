//! The σ-family of two-step variational integrators for degenerate Lagrangians.
//!
//! L_d(q0, q1) = h L(q_σ, Δ/h) = α(q_σ)·Δ − h H(q_σ),   Δ = q1 − q0,   q_σ = q0 + σΔ at t + σh
//! (Rowley & Marsden 2002, eqs. 9–10), stepped in position–momentum form p0 = −D₁L_d, p1 = D₂L_d, so that
//! a step evaluates derivatives at one node and not at two. The state is (q, c) with the *defect*
//! c = p − α(q): on the exact flow p = α(q), hence |c| is the amplitude of the parasitic mode in p.
//! With G = (Dα)ᵀΔ − h∇H at q_σ, a step solves the first equation for Δ and evaluates the second:
//!
//! r(Δ) = c0 + α(q0) − α(q_σ) + (1−σ)G = 0        c1 = α(q_σ) + σG − α(q1)

mod admit;
mod affine;
mod begin;
mod leapfrog;
mod memory;
mod parasitic_mode;
mod start;
mod step;
mod together;

use crate::discrete::{Between, Interval, OneNode};
use crate::error::{StartError, StepFailure};
use crate::methods::{self, Carries, Clock, Gauss, Method, PreservedForm, Steps, VariationalMethod, scheme};
use crate::solve::{Ladder, Solver, Stopping};
use crate::state::summation::Summation;
use crate::{DegenerateLagrangian, Real, System, Vector};

pub(crate) use memory::SigmaMemory;
pub use parasitic_mode::ParasiticMode;
pub use start::Start;
use start::one_step;

/// The σ-family: a discrete Lagrangian with one node between the ends.
///
/// ```math
/// L_d(q_0, q_1) = \alpha(q_\sigma) \cdot (q_1 - q_0) - h H(q_\sigma), \qquad q_\sigma = (1 - \sigma) q_0 + \sigma q_1
/// ```
///
/// It is of second order, and for σ = ½ symmetric; for σ = (3 − √3)/6 and σ = (3 + √3)/6 it is of fourth
/// order on linear systems, and of third with the default [`start`](Self::start), whose second point has an
/// error of the order h³. For σ = 0 and σ = 1 it is explicit, with one ∇H a step. Each step preserves the
/// discrete two-form on Q×Q (Rowley & Marsden 2002, eq. 17) and, for symmetries that act by affine maps, the
/// discrete momenta.
///
/// σ = ½ is for all one-forms. Every other σ in \[0, 1\] is for those with a constant antisymmetric Dα, such
/// as ½(p dq − q dp), and refused on others: there it would be of first order, and its parasitic mode would
/// grow by a factor in each step.
///
/// # Limits
/// A two-step map has twice the freedom of the flow. What becomes of the other half, the parasitic mode
/// that alternates from step to step, decides whether a run can be used:
/// - σ = ½, α affine, [`Start::Consistent`]: there is none, c = 0, and the scheme is the implicit
///   midpoint rule. With another start its amplitude stays constant. On an identical pair of vortices at
///   distance d the equation has solutions for h ≤ πd²/Γ only.
/// - σ = ½, α not affine: it grows at a rate of the flow, whatever h.
/// - σ = 0: it grows like the distance of neighbouring trajectories, soon on chaotic data.
/// - other σ: it grows exponentially on many orbits, at a rate of (1 − 2σ)² times one of the flow, whatever
///   h.
///
/// A start by a step leaves a mode of order h³. These have no such mode: σ = ½ if α is affine,
/// [`OneStep`](super::OneStep) and [`OneStepGauss`](super::OneStepGauss) if the system is in their class,
/// [`Projected`](super::Projected) and [`Gauss`](super::Gauss) on all systems.
///
/// The mode is measured while a run goes on ([`ParasiticMode`];
/// `run.memory().parasitic_mode()` reads it), and a run in which it has taken over
/// ends with [`StepFailure::ParasiticMode`](crate::error::StepFailure): see
/// [`parasitic_limit`](Self::parasitic_limit). On a linear oscillation of frequency ω the scheme is stable
/// for |ωh| < 1/|1 − 2σ|.
///
/// ```
#[doc = include_str!("../../docs/hidden/vortices.txt")]
/// // Two equal vortices circle each other in 2π² units of time.
/// let mut run = Integrator::new(&Vortices, Sigma::midpoint(), 0.1, start)?;
/// let angular = run.momentum(0).unwrap();
/// run.take_steps(100_000)?;
/// assert!((run.momentum(0).unwrap() - angular).abs() < 1e-13);
/// assert!(run.memory().defect().iter().all(|c| c.abs() < 1e-14));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sigma<T = f64> {
    /// The point between q0 and q1 at which the Lagrangian is evaluated: 0 is q0, 1 is q1.
    pub sigma: T,
    /// How the second starting value is found. Default: [`Start::Consistent`].
    pub start: Start,
    /// How implicit steps are solved. Default: [`Solver::Automatic`].
    pub solver: Solver,
    /// The criterion by which an implicit step counts as solved. Default: to rounding errors.
    pub stopping: Stopping,
    /// How the increments of the steps are added up. [`Summation::Compensated`] is for affine α and 0 < σ <
    /// 1; what is compensated are the coordinates. Default: [`Summation::Plain`].
    pub summation: Summation,
    /// The largest [relative size](ParasiticMode::relative) of the parasitic mode, above which a step fails
    /// with [`StepFailure::ParasiticMode`](crate::error::StepFailure) and the run stays where it is.
    /// Default: ½. `None` lets the run go on whatever it has become.
    ///
    /// The limit is tested before each step, except in two cases. If α is affine and σ ≠ ½, the mode is
    /// measured after 4 to 256 steps, before it can have reached the limit at a rate of the flow; there a
    /// mode that is large from the first steps on may become three times as large, if that is more than the
    /// limit. If α is affine and σ = ½, where the mode keeps its amplitude, nothing is tested.
    ///
    /// The limit is one of the mode and not of the energy, and has limits of its own:
    /// - A mode that appears from one step to the next is judged when it has been seen several times.
    /// - Where α is far from affine, or the motion passes near a saddle, the energy error of short steps may
    ///   have grown tenfold before.
    /// - The mode is compared with the motion of the coordinates together, and of each that moves at least a
    ///   tenth as much as the largest. In coordinates that are small beside another that is not lost, it is
    ///   seen late or not at all: choose units in which they are of one size.
    /// - A motion that turns by more than 70° in a step cannot be told from the mode, nor can, if α is not
    ///   affine, a path whose curvature changes several times within two or three steps: such a run may be
    ///   stopped.
    ///
    /// [`EnergyLimit`](crate::methods::EnergyLimit) around the method limits the energy.
    pub parasitic_limit: Option<f64>,
}

impl<T: Real> Sigma<T> {
    /// The member `sigma` with default options. The range is checked when a run begins.
    pub fn new(sigma: T) -> Self {
        Self {
            sigma,
            start: Start::default(),
            solver: Solver::default(),
            stopping: Stopping::default(),
            summation: Summation::default(),
            parasitic_limit: Some(PARASITIC_LIMIT),
        }
    }

    /// σ = ½: symmetric; the implicit midpoint rule if α is affine.
    pub fn midpoint() -> Self {
        Self::new(T::lift(0.5))
    }

    /// σ = 0: explicit if α is affine; the leapfrog scheme of Rowley & Marsden for point vortices.
    pub fn leapfrog() -> Self {
        Self::new(T::lift(0.0))
    }

    fn is_midpoint(&self) -> bool {
        self.sigma == T::lift(0.5)
    }

    /// Whether no iteration is needed.
    fn is_end(&self) -> bool {
        self.sigma == T::lift(0.0) || self.sigma == T::lift(1.0)
    }

    /// How many iterations the fixed point gets: a slow contraction is given up as soon as Newton would be
    /// cheaper, whose advantage shrinks with the dimension.
    fn budget<N>(&self, ladder: &Ladder<N>, dimension: usize) -> usize {
        ladder.budget(self.stopping.max_iterations, 12 + dimension)
    }
}

/// The default of [`Sigma::parasitic_limit`].
const PARASITIC_LIMIT: f64 = 0.5;

/// One step: where it starts, how long it is, and which member of the family takes it.
#[derive(Debug)]
struct Step<'a, S, T> {
    system: &'a S,
    method: &'a Sigma<T>,
    t: T,
    h: T,
}

impl<S, T: Real> Step<'_, S, T> {
    /// The time at which the discrete Lagrangian is evaluated.
    fn node_time(&self) -> T {
        self.t + self.method.sigma * self.h
    }

    fn interval(&self) -> Interval<T> {
        Interval { t: self.t, h: self.h }
    }
}

scheme! {
    [T: Real] Sigma<T>, |method|
    order: 2,
    is_symmetric: method.is_midpoint(),
    preserved_form: PreservedForm::Discrete,
}

impl<S: System, T: Real> Carries<S, T> for Sigma<T> {
    type Memory = SigmaMemory<S, T>;
}

impl<S: DegenerateLagrangian<T>, T: Real> Method<S, T> for Sigma<T> {
    type Suited<X> = S::Suited<X>;

    fn begin(&self, system: &S, q: &Vector<S, T>, _v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        self.go_with(system, q, t)?;
        if self.is_midpoint_rule::<S>() {
            return SigmaMemory::without_defect(system, self, q, t, h);
        }
        let q1 = match self.start {
            Start::Consistent => one_step(&Gauss::<1>::new(), system, q, t, h)?,
            Start::RungeKutta(method) => one_step(&method, system, q, t, h)?,
        };
        SigmaMemory::between(system, self, [q, &q1], t, h)
    }

    /// Without a second point.
    fn begin_again(
        &self,
        system: &S,
        q: &Vector<S, T>,
        _v: &[T],
        t: T,
        h: T,
    ) -> Result<Self::Memory, StartError> {
        self.go_with(system, q, t)?;
        SigmaMemory::without_defect(system, self, q, t, h)
    }

    #[inline]
    fn step(&self, step: methods::Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let methods::Step { system, q, t, h, statistics } = step;
        let leap = (Clock::new(t, h), 1);
        if S::AFFINE
            && let Some((_, result)) = leapfrog::steps(system, memory, q, leap, statistics)
        {
            return result;
        }
        step::step(&Step { system, method: self, t, h }, memory, q, statistics)
    }

    fn part_of_step(
        &self,
        part: methods::Step<'_, S, T>,
        whole: T,
        memory: &mut Self::Memory,
        _taken: &Self::Memory,
    ) -> Result<(), StepFailure> {
        memory.shorten(part.system, self, part.q, part.t, [part.h, whole])?;
        self.step(part, memory)
    }

    #[inline]
    fn steps(&self, steps: Steps<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let Steps { system, q, clock, count, statistics } = steps;
        if S::AFFINE
            && let Some((taken, result)) = leapfrog::steps(system, memory, q, (clock, count), statistics)
        {
            statistics.steps += taken;
            return result;
        }
        Steps { system, q, clock, count, statistics }.one_by_one(self, memory)
    }
}

impl<S: DegenerateLagrangian<T>, T: Real> VariationalMethod<S, T> for Sigma<T> {
    type Nodes = Between<T>;

    fn discrete_lagrangian(&self, system: &S) -> OneNode<S, T> {
        OneNode::new(system, self.sigma)
    }
}
