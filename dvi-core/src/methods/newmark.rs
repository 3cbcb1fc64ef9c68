//! Newmark's method with γ = ½, which is variational in coordinates of its own.
//!
//! x1 = x0 + h v0 + h²[(½ − β) a0 + β a1]      v1 = v0 + (h/2)(a0 + a1)      a = M⁻¹F(x, t), F = −∇V
//!
//! In q = x − βh² a(x) this is Störmer–Verlet with the acceleration a(x), which as a function of q is that
//! of the potential Ṽ(q) = V(x) + ½βh² ∇V·M⁻¹∇V: dṼ = ∇V·(1 + βh² M⁻¹V″)dx = ∇V·dq. So the method is
//! symplectic, for dq ∧ dp (Kane, Marsden, Ortiz & West 2000, section 3.2; Newmark 1959). Here it is written
//! with momenta, as p½ = p0 + (h/2)F0, x1 = x0 + h M⁻¹[p½ + βh(F1 − F0)], p1 = p½ + (h/2)F1,
//!
//! which is the general step of the discrete Lagrangian in x with both of its equations divided by η′ᵀ, so
//! that no second derivatives are left in them.

mod lagrangian;

use crate::discrete::Interval;
use crate::error::{StartError, StepFailure};
use crate::mechanics::mass::Mass;
use crate::mechanics::pattern::of_second_derivatives;
use crate::mechanics::phase::{Arrival, Increments, PhasePoint};
use crate::methods::{Carries, Method, PreservedForm, Scheme};
use crate::scalar::norm::{self, reported};
use crate::solve::{Convergence, Due, Guess, Ladder, Solver, Stopping, iterate, sizes};
use crate::space::{LinearEquations, LinearSolver, Sink, linear};
use crate::state::Statistics;
use crate::state::memory::{Memory, lasting};
use crate::state::summation::Summation;
use crate::{
    Lagrangian, Linear, Real, RegularLagrangian, Scalar, Separable, Space, System, Vector, Weights,
};

pub use lagrangian::NewmarkLagrangian;

/// Newmark's method with γ = ½ for L = ½ v·M v − V(q, t): for [`Separable`] systems.
///
/// ```math
/// \begin{aligned}
/// q_1 &= q_0 + h v_0 + h^2 \left[ (\tfrac12 - \beta) a_0 + \beta a_1 \right] \\
/// v_1 &= v_0 + \tfrac{h}{2} (a_0 + a_1), \qquad\qquad a = -M^{-1} \nabla V(q, t)
/// \end{aligned}
/// ```
///
/// The method is symmetric and of order 2. With β = 0 it is Störmer–Verlet, and explicit. With β = ¼ it is
/// the average acceleration method, which is stable on linear oscillators at every step. With other β > 0 it
/// is implicit too, and stable on them for (¼ − β)(ωh)² < 1. An iteration evaluates ∂L/∂q once.
///
/// It preserves d(q − βh² a(q)) ∧ dp, a form that depends on h. Steps of different lengths would preserve
/// nothing, so the method is no [`VariableStep`](crate::methods::VariableStep) and cannot be composed.
/// Momenta of symmetries that act linearly are preserved in the form that they have at q − βh² a(q).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Newmark<T = f64> {
    /// β, from 0 to ½.
    pub beta: T,
    /// How steps are solved; of no concern for β = 0.
    pub solver: Solver,
    /// The criterion by which a step counts as solved. Default: to rounding errors.
    pub stopping: Stopping,
    /// How the increments of the steps are added up. Default: [`Summation::Plain`].
    pub summation: Summation,
}

impl<T> Newmark<T> {
    /// The method with the parameter β; a run refuses one that is not in \[0, ½\].
    pub fn new(beta: T) -> Self {
        Self {
            beta,
            solver: Solver::default(),
            stopping: Stopping::default(),
            summation: Summation::default(),
        }
    }
}

/// The phase point of a run of Newmark's method, and its work space.
#[derive(Debug)]
pub struct NewmarkMemory<S: System, T: Real> {
    phase: PhasePoint<S, T>,
    mass: Mass<S, T>,
    /// With the matrix of Newton's method; explicit steps do not use it.
    ladder: Ladder<Linear<S, T>>,
    work: Work<S, T>,
}

/// Vectors that are written before they are read in each step.
#[derive(Debug)]
struct Work<S: System, T: Real> {
    /// p½
    half: Vector<S, T>,
    /// d of Newton's method.
    correction: Vector<S, T>,
    increment: Vector<S, T>,
    /// In which iterations judge coordinates.
    weights: Vector<S, T>,
    next: Vector<S, T>,
    next_force: Vector<S, T>,
    /// The momentum that takes q0 to q1, or the residual, or what is added to the momentum.
    transfer: Vector<S, T>,
    velocity: Vector<S, T>,
    /// p1
    momentum: Vector<S, T>,
}

impl<S: RegularLagrangian<T>, T: Real> NewmarkMemory<S, T> {
    /// p = ∂L/∂v at the current point, one entry per coordinate.
    pub fn p(&self) -> &[T] {
        &self.phase.p
    }
}

impl<S: System, T: Real> Memory<T> for NewmarkMemory<S, T> {
    lasting!(T; part phase, part ladder);
}

/// A step as it is being solved: `work.increment` becomes Δ.
struct Attempt<'a, S: Separable<T>, T: Real> {
    system: &'a S,
    beta: T,
    interval: Interval<T>,
    stopping: Stopping,
    budget: usize,
    q: &'a [T],
    phase: &'a PhasePoint<S, T>,
    mass: &'a Mass<S, T>,
    work: &'a mut Work<S, T>,
}

impl<S: Separable<T>, T: Real> Attempt<'_, S, T> {
    /// Δ ← h M⁻¹[p½ + βh(F1 − F0)].
    fn fixed_point(&mut self, statistics: &mut Statistics) -> Result<(), StepFailure> {
        self.guess();
        let convergence = Convergence::fixed_point(self.stopping, self.budget);
        iterate(convergence, statistics, |due, statistics| {
            self.prepare(due);
            self.place(statistics);
            self.carry();
            let Work { weights, increment, velocity, .. } = &mut *self.work;
            Ok(sizes::renew(weights, increment, velocity))
        })?;
        norm::finite(&self.work.increment)
    }

    /// The same by Newton: (M − βh² ∂²L/∂q∂q)d = MΔ − h[p½ + βh(F1 − F0)], Δ ← Δ − d.
    fn newton(
        &mut self,
        solver: &mut Linear<S, T>,
        guess: Guess,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Work { half, increment, .. } = &mut *self.work;
        guess.begin(increment, |increment| {
            self.phase.guess(Some(self.mass), half, self.interval.h, increment);
        });
        let max = self.stopping.max_iterations;
        let convergence = Convergence::new(self.stopping, max);
        iterate(convergence, statistics, |due, statistics| {
            self.prepare(due);
            self.place(statistics);
            self.improve(solver, *due, statistics)
        })?;
        norm::finite(&self.work.increment)
    }

    fn prepare(&mut self, due: &mut Due) {
        let Work { weights, increment, .. } = &mut *self.work;
        due.prepare(self.system, weights, self.q, increment);
    }

    fn guess(&mut self) {
        let Work { half, increment, .. } = &mut *self.work;
        self.phase.guess(Some(self.mass), half, self.interval.h, increment);
    }

    /// Sets `next` to q1, `next_force` to F(q1), and `transfer` to p½ + βh(F1 − F0).
    fn place(&mut self, statistics: &mut Statistics) {
        let Work { half, increment, next, next_force, transfer, .. } = &mut *self.work;
        self.phase.reach(self.q, increment, next);
        self.system.force(next, &[], self.interval.time(T::lift(1.0)), next_force);
        statistics.gradients += 1;
        for i in 0..self.q.len() {
            transfer[i] = half[i] + self.beta * self.interval.h * (next_force[i] - self.phase.force[i]);
        }
    }

    /// Sets `velocity` to h M⁻¹`transfer`, the new increment.
    fn carry(&mut self) {
        let Work { transfer, velocity, .. } = &mut *self.work;
        self.mass.solve(transfer, velocity);
        velocity.iter_mut().for_each(|velocity| *velocity *= self.interval.h);
    }

    /// One iteration of Newton's method; returns the size of d.
    fn improve(
        &mut self,
        solver: &mut Linear<S, T>,
        due: Due,
        statistics: &mut Statistics,
    ) -> Result<T, StepFailure> {
        let Work { increment, weights, next, transfer, velocity, momentum, next_force, correction, .. } =
            &mut *self.work;
        for transfer in transfer.iter_mut() {
            *transfer *= -self.interval.h;
        }
        self.mass.multiply_add(T::lift(1.0), increment, transfer);
        let (system, interval, beta) = (self.system, self.interval, self.beta);
        let unused: [&mut [T]; 3] = [velocity, next_force, momentum];
        statistics.linearizations += 1;
        statistics.factorisations += 1;
        let size = |j: usize| Scalar::abs(self.q[j]) + Scalar::abs(increment[j]);
        let mut equations = Equations { system, interval, beta, x1: next, b: transfer, unused };
        if due == Due::Residual {
            return linear::residual(&mut equations, size, |_| T::lift(0.0), [correction, weights]);
        }
        solver.solve(&mut equations, weights, correction)?;
        Ok(sizes::reduce(system, weights, increment, correction))
    }
}

/// (M − βh² ∂²L/∂q∂q)d = b, at q1.
struct Equations<'a, S, T> {
    system: &'a S,
    interval: Interval<T>,
    beta: T,
    x1: &'a [T],
    b: &'a [T],
    /// A velocity, and the first derivatives of L.
    unused: [&'a mut [T]; 3],
}

impl<S: Separable<T>, T: Real> LinearEquations<T> for Equations<'_, S, T> {
    fn evaluate<K: Sink<T>>(&mut self, b: &mut [T], sink: &mut K) -> Result<(), StepFailure> {
        let (zero, one, h) = (T::lift(0.0), T::lift(1.0), self.interval.h);
        b.copy_from_slice(self.b);
        let weights = Weights { qq: -(self.beta * h * h), qv: zero, vq: zero, vv: one };
        let [velocity, l_q, l_v] = &mut self.unused;
        self.system.linearize(self.x1, velocity, self.interval.time(one), weights, l_q, l_v, sink);
        Ok(())
    }
}

impl<T: Real> Newmark<T> {
    fn validate(&self) -> Result<(), StartError> {
        if !(self.beta >= T::lift(0.0) && self.beta <= T::lift(0.5)) {
            let (value, range) = (reported(self.beta), "0 <= beta <= 1/2");
            return Err(StartError::Parameter { name: "beta", value, range });
        }
        self.stopping.validate()
    }

    fn is_explicit(&self) -> bool {
        self.beta == T::lift(0.0)
    }
}

impl<T: Real> Scheme for Newmark<T> {
    fn order(&self) -> usize {
        2
    }
    fn is_symmetric(&self) -> bool {
        true
    }
    fn preserved_form(&self) -> PreservedForm {
        if self.is_explicit() { PreservedForm::Canonical } else { PreservedForm::Conjugate }
    }
}

impl<S: System, T: Real> Carries<S, T> for Newmark<T> {
    type Memory = NewmarkMemory<S, T>;
}

impl<S: Separable<T> + RegularLagrangian<T>, T: Real> Method<S, T> for Newmark<T> {
    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, _h: T) -> Result<Self::Memory, StartError> {
        self.validate()?;
        let solver = if self.is_explicit() { Solver::FixedPoint } else { self.solver.in_numbers::<T>() };
        Ok(NewmarkMemory {
            phase: PhasePoint::new(system, q, v, t, self.summation)?,
            mass: Mass::new(system, q, t).map_err(StartError::Starter)?,
            ladder: Ladder::new(solver, || of_second_derivatives(system, q, v, t, solver.storing())),
            work: Work::new(system),
        })
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
        let NewmarkMemory { phase, mass, ladder, work } = memory;
        let kick = T::lift(0.5) * h;
        for (impulse, &f) in work.transfer.iter_mut().zip(phase.force.iter()) {
            *impulse = kick * f;
        }
        phase.kick(&work.transfer, &mut work.half);
        let budget = ladder.budget(self.stopping.max_iterations, 24 + q.len());
        let (beta, interval, stopping) = (self.beta, Interval { t, h }, self.stopping);
        let mut attempt = Attempt { system, beta, interval, stopping, budget, q, phase, mass, work };
        if self.is_explicit() {
            attempt.work.transfer.copy_from_slice(&attempt.work.half);
            attempt.carry();
            attempt.work.increment.copy_from_slice(&attempt.work.velocity);
        } else {
            ladder.solve(&mut attempt, statistics, Attempt::fixed_point, Attempt::newton)?;
        }
        attempt.place(statistics);
        let Work { momentum, next, next_force, increment, transfer: sum, .. } = work;
        for i in 0..q.len() {
            sum[i] = kick * (phase.force[i] + next_force[i]);
        }
        phase.kick(sum, momentum);
        let by = Increments { q: increment, p: sum };
        phase.advance(q, &Arrival { q: next, p: momentum, force: next_force }, by, h)
    }

    fn velocity(
        &self,
        _system: &S,
        memory: &Self::Memory,
        _q: &Vector<S, T>,
        _t: T,
        v: &mut Vector<S, T>,
    ) -> Result<(), StepFailure> {
        memory.mass.solve(&memory.phase.p, v);
        Ok(())
    }
}

impl<S: Lagrangian<T>, T: Real> Work<S, T> {
    fn new(system: &S) -> Self {
        let vector = || system.space().vector();
        Self {
            half: vector(),
            correction: vector(),
            increment: vector(),
            weights: vector(),
            next: vector(),
            next_force: vector(),
            transfer: vector(),
            velocity: vector(),
            momentum: vector(),
        }
    }
}
