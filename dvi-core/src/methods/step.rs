//! The step of equations for the increment Δ of a motion on T*Q,
//!
//! 0 = p0 + r(q0, Δ)      q1 = q0 + Δ      p1 = p0 + s(q0, Δ)
//!
//! A scheme says r, its derivative, and s: of a discrete Lagrangian r = D₁L_d and s = (D₁ + D₂)L_d. What
//! belongs to no scheme stands here: the guess of Δ; the fixed point Δ ← Δ + (h/κ)M⁻¹(p0 + r) where M is
//! constant, and Newton's method behind it or alone; what is looked at where a step ends; and the sums.

use crate::discrete::{DiscreteLagrangian, Interval, NodeWork, Span, solve_by_newton};
use crate::error::{StartError, StepFailure};
use crate::mechanics::mass::Mass;
use crate::mechanics::pattern::of_second_derivatives;
use crate::mechanics::phase::{Arrival, Increments, Inertial, PhasePoint};
use crate::memory::{Memory, lasting};
use crate::scalar::norm;
use crate::scalar::simd::apart_if;
use crate::solve::{Convergence, Guess, Ladder, Solver, Stopping, iterate, sizes};
use crate::space::Sink;
use crate::state::Statistics;
use crate::state::summation::Summation;
use crate::{Lagrangian, Linear, NondegenerateLagrangian, Real, Space, System, Vector};

/// Where a step begins.
pub(super) struct Begin<'a, S: System, T: Real> {
    pub(super) system: &'a S,
    pub(super) interval: Interval<T>,
    pub(super) q: &'a [T],
    pub(super) phase: &'a PhasePoint<S, T>,
    /// M, if it is constant.
    pub(super) mass: Option<&'a Mass<S, T>>,
}

/// What a scheme says of its step. All is **added** to what is passed; `node` is storage.
pub(super) trait Equations<S: Lagrangian<T>, T: Real> {
    /// Adds r to `r` and s to `sum`.
    ///
    /// # Errors
    /// Those of a frequency that is read.
    fn evaluate(
        &mut self,
        begin: &Begin<'_, S, T>,
        delta: &[T],
        node: &mut NodeWork<S, T>,
        to: [&mut [T]; 2],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure>;

    /// Adds r to `r` and ∂r/∂Δ to `sink`.
    ///
    /// # Errors
    /// As [`evaluate`](Self::evaluate).
    fn linearize<K: Sink<T>>(
        &mut self,
        begin: &Begin<'_, S, T>,
        delta: &[T],
        node: &mut NodeWork<S, T>,
        r: &mut [T],
        sink: &mut K,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure>;

    /// Whether [`evaluate`](Self::evaluate) leaves F(q1) in `node.gradient`, of a separable L.
    const LEAVES_FORCE: bool = false;

    /// 1/κ, where −(κ/h)M is about ∂r/∂Δ.
    fn per_stiffness(&self) -> T {
        T::lift(1.0)
    }
}

/// What a run carries from step to step, and its work space.
#[derive(Debug)]
pub(super) struct Carried<S: System, T: Real> {
    pub(super) phase: PhasePoint<S, T>,
    pub(super) inertial: Inertial<S, T>,
    pub(super) work: Work<S, T>,
    /// In which iterations judge coordinates; work space.
    pub(super) weights: Vector<S, T>,
}

/// Vectors that are written before they are read in each step.
#[derive(Debug)]
pub(super) struct Work<S: System, T: Real> {
    pub(super) node: NodeWork<S, T>,
    /// Δ
    pub(super) increment: Vector<S, T>,
    pub(super) next: Vector<S, T>,
    /// The residual, then the correction, or a force.
    pub(super) trial: Vector<S, T>,
    /// s
    pub(super) sum: Vector<S, T>,
}

impl<S: Lagrangian<T>, T: Real> Work<S, T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn new(system: &S) -> Self {
        let vector = || system.space().vector();
        Self {
            node: NodeWork::new(system),
            increment: vector(),
            next: vector(),
            trial: vector(),
            sum: vector(),
        }
    }
}

impl<S: NondegenerateLagrangian<T>, T: Real> Carried<S, T> {
    /// Of a run from (`q`, `v`, `t`).
    ///
    /// # Errors
    /// [`StartError::Starter`] where momentum or force is no number, or the mass matrix is singular.
    pub(super) fn new(
        system: &S,
        q: &Vector<S, T>,
        v: &[T],
        t: T,
        summation: Summation,
    ) -> Result<Self, StartError> {
        Ok(Self {
            phase: PhasePoint::new(system, q, v, t, summation)?,
            inertial: Inertial::new(system, q, v, t)?,
            work: Work::new(system),
            weights: system.space().vector(),
        })
    }

    /// Sets `v` to the velocity at the present point.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn velocity(&self, system: &S, q: &[T], t: T, v: &mut [T]) -> Result<(), StepFailure> {
        self.inertial.velocity(system, &self.phase, q, t, v)
    }
}

impl<S: System, T: Real> Memory<T> for Carried<S, T> {
    lasting!(T; part phase, part inertial);
}

/// The fixed point of a run from (`q`, `v`, `t`) and Newton's method behind it, with its matrix, as far as
/// `solver` has them.
pub(super) fn ladder<S: NondegenerateLagrangian<T>, T: Real>(
    system: &S,
    q: &Vector<S, T>,
    v: &[T],
    t: T,
    solver: Solver,
) -> Ladder<Linear<S, T>> {
    Ladder::new(solver, || of_second_derivatives(system, q, v, t, solver.storing()))
}

/// Sets `force` to that at a point at time `t`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn set_force<S: NondegenerateLagrangian<T>, T: Real>(
    system: &S,
    point: &[T],
    t: T,
    force: &mut [T],
) {
    apart_if(
        !<S::Space as Space>::ON_STACK,
        #[cfg_attr(not(debug_assertions), inline(always))]
        || system.force(point, &[], t, force),
    );
}

/// A step, and what it changes.
pub(super) struct Attempt<'a, S: System, T: Real> {
    pub(super) system: &'a S,
    pub(super) interval: Interval<T>,
    pub(super) stopping: Stopping,
    pub(super) summation: Summation,
    /// How many iterations the fixed point gets.
    pub(super) budget: usize,
    pub(super) q: &'a mut Vector<S, T>,
    pub(super) carried: &'a mut Carried<S, T>,
}

impl<S: NondegenerateLagrangian<T>, T: Real> Attempt<'_, S, T> {
    /// A step by the fixed point, with M as its matrix.
    ///
    /// # Errors
    /// [`StepFailure::NotConverged`], or what is found at the end of the step.
    #[inline(never)]
    pub(super) fn by_fixed_point<E: Equations<S, T>>(
        &mut self,
        equations: &mut E,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { system, interval, stopping, summation, budget, q, carried } = self;
        let Carried { phase, inertial, work, weights } = &mut **carried;
        let Some(mass) = inertial.constant() else { return Err(StepFailure::NO_MATRIX) };
        let begin = Begin { system: *system, interval: *interval, q, phase, mass: Some(mass) };
        let Work { node, increment, trial, sum, .. } = work;
        phase.guess(Some(mass), &phase.p, interval.h, increment);
        let stopping = match summation {
            Summation::Plain => *stopping,
            Summation::Compensated => stopping.exhaustive(),
        };
        iterate(Convergence::fixed_point(stopping, *budget), statistics, |due, statistics| {
            due.prepare(*system, weights, q, increment);
            trial.copy_from_slice(&phase.p);
            equations.evaluate(&begin, increment, node, [trial, sum], statistics)?;
            mass.solve(trial, &mut node.velocity);
            let scale = -(interval.h * equations.per_stiffness());
            node.velocity.iter_mut().for_each(|velocity| *velocity *= scale);
            Ok(sizes::reduce(*system, weights, increment, &node.velocity))
        })?;
        norm::finite(increment)?;
        sum.fill(T::lift(0.0));
        equations.evaluate(&begin, increment, node, [trial, sum], statistics)?;
        self.arrive(E::LEAVES_FORCE, statistics)
    }

    /// A step by Newton's method from a guess.
    ///
    /// # Errors
    /// As those of [`solve_by_newton`], or what is found at the end of the step.
    #[inline(never)]
    pub(super) fn by_newton<E: Equations<S, T>>(
        &mut self,
        equations: &mut E,
        solver: &mut Linear<S, T>,
        guess: Guess,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { system, interval, stopping, q, carried, .. } = self;
        let Carried { phase, inertial, work, weights } = &mut **carried;
        let mass = inertial.constant();
        let begin = Begin { system: *system, interval: *interval, q, phase, mass };
        let Work { node, increment, trial, sum, .. } = work;
        guess.begin(increment, |increment| phase.guess(mass, &phase.p, interval.h, increment));
        let mut posed = Posed { equations, begin: &begin, node };
        let (points, storage) = ([&***q, &phase.p], (solver, [&mut *trial, weights]));
        solve_by_newton(&mut posed, *system, *interval, points, increment, storage, *stopping, statistics)?;
        sum.fill(T::lift(0.0));
        posed.equations.evaluate(&begin, increment, posed.node, [trial, sum], statistics)?;
        self.arrive(E::LEAVES_FORCE, statistics)
    }

    /// Moves to q1 = q0 + Δ and p1 = p0 + s; `has_force` says that F(q1) is in `node.gradient`.
    fn arrive(&mut self, has_force: bool, statistics: &mut Statistics) -> Result<(), StepFailure> {
        let Self { system, interval, q, carried, .. } = self;
        let Carried { phase, inertial, work, .. } = &mut **carried;
        let Work { node, next, increment, trial, sum, .. } = work;
        phase.reach(q, increment, next);
        phase.kick(sum, &mut node.momentum);
        norm::finite(next).and(norm::finite(&node.momentum))?;
        let end = interval.time(T::lift(1.0));
        if S::SEPARABLE && has_force {
            trial.copy_from_slice(&node.gradient);
        } else if S::SEPARABLE {
            set_force(*system, next, end, trial);
            statistics.gradients += 1;
        }
        inertial.check(*system, [next, increment], [end, interval.h], &mut node.velocity)?;
        let by = Increments { q: increment, p: sum };
        phase.advance(q, &Arrival { q: next, p: &node.momentum, force: trial }, by, interval.h)
    }
}

/// Equations where a step begins, as Newton's method asks for them.
struct Posed<'a, 'b, S: Lagrangian<T>, T: Real, E> {
    equations: &'a mut E,
    begin: &'a Begin<'b, S, T>,
    node: &'a mut NodeWork<S, T>,
}

impl<S: Lagrangian<T>, T: Real, E: Equations<S, T>> DiscreteLagrangian<S, T> for Posed<'_, '_, S, T, E> {
    fn derivatives(
        &mut self,
        span: Span<'_, S, T>,
        r: &mut [T],
        sum: &mut [T],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.equations.evaluate(self.begin, span.ends.delta, self.node, [r, sum], statistics)
    }

    fn linearize<K: Sink<T>>(
        &mut self,
        span: Span<'_, S, T>,
        r: &mut [T],
        sink: &mut K,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.equations.linearize(self.begin, span.ends.delta, self.node, r, sink, statistics)
    }
}
