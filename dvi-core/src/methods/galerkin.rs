//! Variational integrators with interior displacements, of order 4, 6 and 8 for regular Lagrangians.
//!
//! qʲ = bⱼ q0 + b̄ⱼ q1 + δʲ      q̇ʲ = (Bⱼ q0 + B̄ⱼ q1 + Σₖ aⱼₖ δᵏ)/h      δ¹ = δˢ = 0
//! L_d(q0, q1) = h Σⱼ wⱼ L(qʲ, q̇ʲ, t + cⱼh), stationary in the δ of the interior nodes
//!
//! with the nodes cⱼ and weights wⱼ of a Lobatto rule, and aⱼₖ the derivative at cⱼ of the Lagrange polynomial of
//! node k (Kosmas & Vlachos, eqs. 26 to 29). With linear interpolation q(c) is any polynomial of degree s − 1, and
//! the step is the Lobatto IIIA–IIIB pair (Marsden & West 2001, theorem 2.6.1). A step solves p0 = −D₁L_d(q0, q1)
//! together with ∂L_d/∂δ = 0 and evaluates p1 = D₂L_d(q0, q1), as p1 = p0 + (D₁ + D₂)L_d, which rounds less.

mod coefficients;
mod general;
mod lagrangian;
mod memory;
mod separable;

use crate::discrete::frequency::{self, Frequency, FrequencyIn, Reading, Unfitted};
use crate::error::{StartError, StepFailure};
use crate::methods::{Carries, FreeFlight, Method, PreservedForm, Scheme, VariableStep};
use crate::solve::{Solver, Stopping};
use crate::state::Statistics;
use crate::state::summation::Summation;
use crate::{NondegenerateLagrangian, Real, RegularLagrangian, System, Vector};

pub use lagrangian::GalerkinLagrangian;
pub use memory::GalerkinMemory;

/// The discrete Lagrangian of the Lobatto rule with `S` nodes, stationary in displacements of the interior nodes; `S` is 3, 4
/// or 5.
///
/// ```math
/// L_d(q_0, q_1) = \operatorname*{ext}_{\delta_2, \dots, \delta_{S-1}} \; h \sum_{j=1}^{S} w_j\, L(q^j, \dot q^j, t + c_j h)
/// ```
///
/// The order is 2`S` − 2 for every regular L, and the method is symmetric. It preserves dq ∧ dp and the momentum maps of
/// symmetries that act linearly, unless the frequency is read from the motion. For L = ½ v·M v − V(q, t) a step is solved by a
/// fixed point that needs `S` − 2 values of ∂L/∂q an iteration. For any other L it is solved by Newton's method in (`S` − 1) n
/// unknowns for n coordinates, with all second derivatives of L.
///
/// The interpolation may be [fitted](Self::phase_fitted) to a frequency that is [`Constant`](crate::discrete::Constant) or
/// read from the motion as [`Reading::Averaged`]. On the oscillator of that frequency the phase error of a step is then of order
/// 2`S` + 1 in ωh, not 2`S` − 1. It is not zero, as it would be without displacements, because the polynomials of the
/// displacements are not fitted. The fitted interpolation is not translation invariant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Galerkin<const S: usize, F = Unfitted> {
    /// What the interpolation between the ends is fitted to.
    pub frequency: F,
    /// How steps are solved. [`Solver::FixedPoint`] is for L = ½ v·M v − V(q, t) only.
    pub solver: Solver,
    /// The criterion by which a step counts as solved. Default: to rounding errors.
    pub stopping: Stopping,
    /// How the increments of the steps are added up. Default: [`Summation::Plain`].
    pub summation: Summation,
}

impl<const S: usize> Galerkin<S> {
    /// The method with linear interpolation between the ends: Lobatto IIIA–IIIB. A number of nodes other than 3, 4 or 5
    /// does not compile.
    pub fn new() -> Self {
        const { assert!(S >= 3 && S <= 5, "interior displacements are available with 3, 4 or 5 nodes") };
        Self {
            frequency: Unfitted,
            solver: Solver::default(),
            stopping: Stopping::default(),
            summation: Summation::default(),
        }
    }
}

impl<const S: usize> Default for Galerkin<S> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const S: usize, F> Galerkin<S, F> {
    /// The same nodes with interpolation fitted to a frequency.
    pub fn phase_fitted<G>(self, frequency: G) -> Galerkin<S, G> {
        let Self { solver, stopping, summation, .. } = self;
        Galerkin { frequency, solver, stopping, summation }
    }
}

/// One step: where it starts, how long it is, and which method takes it.
#[derive(Debug)]
struct Step<'a, const NODES: usize, S, F, T> {
    system: &'a S,
    method: &'a Galerkin<NODES, F>,
    t: T,
    h: T,
}

impl<const NODES: usize, S: NondegenerateLagrangian<T>, F: Frequency, T: Real> Step<'_, NODES, S, F, T> {
    /// The time of a node.
    #[inline(always)]
    fn node_time(&self, c: f64) -> T {
        self.t + T::lift(c) * self.h
    }
}

impl<const NODES: usize, F: Frequency> Galerkin<NODES, F> {
    fn validate<S: NondegenerateLagrangian<T>, T: Real>(&self, system: &S) -> Result<(), StartError>
    where
        F: FrequencyIn<T>,
    {
        let unsupported = |option, reason| Err(StartError::Unsupported { option, reason });
        let separable =
            "it needs L = ½ v·M v − V(q, t) with a constant matrix M, and forces without velocities";
        if F::PER_COORDINATE {
            return unsupported("PerCoordinate", "displacements go with one frequency for all coordinates");
        }
        match self.frequency.reading() {
            None => {}
            Some(Reading::Averaged) if S::SEPARABLE => {}
            Some(Reading::Averaged) => return unsupported("a frequency read from the motion", separable),
            Some(_) => return unsupported("this reading of the frequency", "take Reading::Averaged"),
        }
        if !S::SEPARABLE && self.solver == Solver::FixedPoint {
            let reason = "it needs L = ½ v·M v − V(q, t) with a constant matrix M, and forces without velocities; take \
                          Solver::Newton";
            return unsupported("Solver::FixedPoint", reason);
        }
        frequency::admit(&self.frequency, system)?;
        self.stopping.validate()
    }
}

impl<const NODES: usize, F: Frequency> Galerkin<NODES, F> {
    fn start<S: NondegenerateLagrangian<T>, T: Real>(
        &self,
        system: &S,
        q: &Vector<S, T>,
        v: &[T],
        [t, h]: [T; 2],
    ) -> Result<GalerkinMemory<NODES, S, T>, StartError>
    where
        F: FrequencyIn<T>,
    {
        const { assert!(NODES >= 3 && NODES <= 5, "interior displacements are available with 3, 4 or 5 nodes") };
        self.validate::<S, T>(system)?;
        GalerkinMemory::new(&Step { system, method: self, t, h }, q, v)
    }

    /// Takes a step from t to t + h.
    #[inline(always)]
    fn take<S: NondegenerateLagrangian<T>, T: Real>(
        &self,
        system: &S,
        memory: &mut GalerkinMemory<NODES, S, T>,
        q: &mut Vector<S, T>,
        [t, h]: [T; 2],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure>
    where
        F: FrequencyIn<T>,
    {
        let step = Step { system, method: self, t, h };
        let GalerkinMemory { ladder, path } = memory;
        let budget = ladder.budget(self.stopping.max_iterations, 24 + q.len());
        let q0 = &*q;
        ladder.solve(
            path,
            statistics,
            |path, statistics| separable::fixed_point(&step, path, q0, budget, statistics),
            |path, newton, guess, statistics| general::newton(&step, path, q0, newton, guess, statistics),
        )?;
        if S::SEPARABLE {
            separable::finish(&step, path, q, statistics)
        } else {
            general::finish(&step, path, q, statistics)
        }
    }
}

impl<const S: usize, F: Frequency> Scheme for Galerkin<S, F> {
    fn order(&self) -> usize {
        2 * S - 2
    }
    fn is_symmetric(&self) -> bool {
        true
    }
    fn preserved_form(&self) -> PreservedForm {
        match self.frequency.reading() {
            None => PreservedForm::Canonical,
            Some(_) => PreservedForm::Nothing,
        }
    }
}

impl<const NODES: usize, S: System, F, T: Real> Carries<S, T> for Galerkin<NODES, F> {
    type Memory = GalerkinMemory<NODES, S, T>;
}

impl<const NODES: usize, S: RegularLagrangian<T>, F: FrequencyIn<T>, T: Real> Method<S, T>
    for Galerkin<NODES, F>
{
    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        self.start(system, q, v, [t, h])
    }

    #[inline]
    fn step(
        &self,
        system: &S,
        memory: &mut Self::Memory,
        q: &mut Vector<S, T>,
        t: T,
        h: T,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.take(system, memory, q, [t, h], statistics)
    }

    fn velocity(
        &self,
        system: &S,
        memory: &Self::Memory,
        q: &Vector<S, T>,
        t: T,
        v: &mut Vector<S, T>,
    ) -> Result<(), StepFailure> {
        memory.path.velocity(system, q, t, v)
    }
}

impl<const NODES: usize, S: RegularLagrangian<T>, F: FrequencyIn<T>, T: Real> VariableStep<S, T>
    for Galerkin<NODES, F>
{
}

impl<const NODES: usize, S: NondegenerateLagrangian<T>, T: Real> FreeFlight<S, T>
    for Galerkin<NODES, Unfitted>
{
    fn depart(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        self.start(system, q, v, [t, h])
    }
    fn fly(
        &self,
        system: &S,
        memory: &mut Self::Memory,
        q: &mut Vector<S, T>,
        interval: [T; 2],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.take(system, memory, q, interval, statistics)
    }
    fn velocity_in_flight(
        &self,
        system: &S,
        memory: &Self::Memory,
        q: &Vector<S, T>,
        t: T,
        v: &mut Vector<S, T>,
    ) -> Result<(), StepFailure> {
        memory.path.velocity(system, q, t, v)
    }
    fn kick(&self, memory: &mut Self::Memory, impulse: &[T], velocity: &[T]) {
        memory.path.phase.jump(impulse, velocity);
    }
}
