//! Newmark's method with γ = ½, which is variational in coordinates of its own.
//!
//! x1 = x0 + h v0 + h²[(½ − β) a0 + β a1]      v1 = v0 + (h/2)(a0 + a1)      a = M⁻¹F(x, t), F = −∇V
//!
//! In q = x − βh² a(x) this is Störmer–Verlet with the acceleration a(x), which as a function of q is that of the
//! potential Ṽ(q) = V(x) + ½βh² ∇V·M⁻¹∇V: dṼ = ∇V·(1 + βh² M⁻¹V″)dx = ∇V·dq. So the method is symplectic, for
//! dq ∧ dp (Kane, Marsden, Ortiz & West 2000, section 3.2; Newmark 1959). Here it is written with momenta, as
//! p½ = p0 + (h/2)F0,   x1 = x0 + h M⁻¹[p½ + βh(F1 − F0)],   p1 = p½ + (h/2)F1.

use crate::error::{StartError, StepFailure};
use crate::history::{History, is_similar};
use crate::mass::Mass;
use crate::method::{Carries, Method, PreservedForm, Scheme};
use crate::norm::{self, reported};
use crate::solver::{Convergence, STEPS_BEFORE_RETRY, Solver, Stopping, Verdict};
use crate::statistics::Statistics;
use crate::{Lagrangian, Matrix, Real, RegularLagrangian, Scalar, Space, Vector, Weights, elimination};

/// Newmark's method with γ = ½ for L = ½ v·M v − V(q, t); [`StartError::Unsupported`] for any other L.
///
/// Order 2, symmetric. β = 0 is Störmer–Verlet, explicit; β = ¼ the average acceleration method, stable on linear
/// oscillators at every step; other β > 0 are implicit too and stable on them for (¼ − β)(ωh)² < 1. One ∂L/∂q an
/// iteration.
///
/// Preserves d(q − βh² a(q)) ∧ dp, which depends on h: steps of different lengths would preserve nothing, so the
/// method is no [`VariableStep`](crate::VariableStep) and cannot be composed. Momenta of symmetries that act
/// linearly are preserved in the form that they have at q − βh² a(q).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Newmark<T = f64> {
    /// β, from 0 to ½.
    pub beta: T,
    /// How steps are solved; of no concern for β = 0.
    pub solver: Solver,
    /// When a step counts as solved. Default: to rounding errors.
    pub stopping: Stopping,
}

impl<T> Newmark<T> {
    /// With any β; a run refuses one that is not in \[0, ½\].
    pub fn new(beta: T) -> Self {
        Self { beta, solver: Solver::default(), stopping: Stopping::default() }
    }
}

/// The momentum of a run of Newmark's method, its guesses and its work space.
#[derive(Debug)]
pub struct NewmarkMemory<S: Lagrangian, T: Real> {
    /// p at the current point.
    p: Vector<S, T>,
    /// ∂L/∂q at the current point.
    force: Vector<S, T>,
    mass: Mass<S, T>,
    /// The mean velocities Δ/h of the last steps.
    history: History<S, T>,
    /// The length of the step before; zero before the first.
    last_step: T,
    newton: Option<Matrix<S, T>>,
    /// How many steps Newton takes before the fixed point is tried again.
    newton_steps: u32,
    work: Work<S, T>,
}

/// Vectors that are written before they are read in each step.
#[derive(Debug)]
struct Work<S: Lagrangian, T: Real> {
    /// p½
    half: Vector<S, T>,
    increment: Vector<S, T>,
    next: Vector<S, T>,
    next_force: Vector<S, T>,
    /// The momentum that carries q0 to q1, or the residual.
    carrier: Vector<S, T>,
    velocity: Vector<S, T>,
    /// p1
    momentum: Vector<S, T>,
}

impl<S: RegularLagrangian, T: Real> NewmarkMemory<S, T> {
    /// p = ∂L/∂v at the current point, one entry per coordinate.
    pub fn p(&self) -> &[T] {
        &self.p
    }

    /// Sets `increment` to the guess of Δ: extrapolated from the steps before if they had about this length, and
    /// that of a free motion elsewhere.
    fn guess(&mut self, h: T) {
        if is_similar(h, self.last_step) {
            self.history.extrapolate(&mut self.work.increment);
        } else {
            self.mass.solve(&self.work.half, &mut self.work.increment);
        }
        for delta in self.work.increment.iter_mut() {
            *delta *= h;
        }
    }

    /// Sets `next` to q1, `next_force` to F(q1), and `carrier` to p½ + βh(F1 − F0).
    fn place(&mut self, system: &S, beta: T, q: &[T], [t, h]: [T; 2], statistics: &mut Statistics) {
        let Work { half, increment, next, next_force, carrier, .. } = &mut self.work;
        for i in 0..q.len() {
            next[i] = q[i] + increment[i];
        }
        system.force(next, &[], t + h, next_force);
        statistics.gradients += 1;
        for i in 0..q.len() {
            carrier[i] = half[i] + beta * h * (next_force[i] - self.force[i]);
        }
    }

    /// Sets `increment` to h M⁻¹`carrier` and returns by how much it has changed.
    fn carry(&mut self, h: T) -> T {
        let Work { increment, carrier, velocity, .. } = &mut self.work;
        self.mass.solve(carrier, velocity);
        let mut change = T::lift(0.0);
        for (delta, &velocity) in increment.iter_mut().zip(velocity.iter()) {
            let new = h * velocity;
            change = norm::larger(change, Scalar::abs(new - *delta));
            *delta = new;
        }
        change
    }

    /// Improves `increment` by Newton: (M − βh² ∂²L/∂q∂q)d = MΔ − h `carrier`, Δ ← Δ − d. Returns the size of d.
    fn improve(
        &mut self,
        system: &S,
        beta: T,
        [t, h]: [T; 2],
        statistics: &mut Statistics,
    ) -> Result<T, StepFailure> {
        let (zero, one) = (T::lift(0.0), T::lift(1.0));
        let Some(matrix) = &mut self.newton else { return Ok(zero) };
        let Work { increment, next, carrier, velocity, momentum, next_force, .. } = &mut self.work;
        for carrier in carrier.iter_mut() {
            *carrier *= -h;
        }
        self.mass.multiply_add(one, increment, carrier);
        norm::finite(carrier)?;
        matrix.fill(zero);
        let weights = Weights { qq: -(beta * h * h), qv: zero, vq: zero, vv: one };
        system.linearize(next, velocity, t + h, weights, next_force, momentum, matrix);
        statistics.linearizations += 1;
        statistics.factorisations += 1;
        elimination::eliminate(matrix, carrier)?;
        for (delta, &change) in increment.iter_mut().zip(carrier.iter()) {
            *delta -= change;
        }
        Ok(norm::largest(carrier))
    }

    /// Moves to `next`, `momentum` and `next_force`, if they are numbers.
    fn complete(&mut self, h: T, q: &mut Vector<S, T>) -> Result<(), StepFailure> {
        let Work { increment, next, momentum, next_force, .. } = &mut self.work;
        norm::finite(next).and(norm::finite(momentum)).and(norm::finite(next_force))?;
        q.copy_from_slice(next);
        self.p.copy_from_slice(momentum);
        self.force.copy_from_slice(next_force);
        if !is_similar(h, self.last_step) {
            self.history.clear();
        }
        self.last_step = h;
        self.history.push_scaled(increment, T::lift(1.0) / h);
        Ok(())
    }
}

impl<T: Real> Newmark<T> {
    fn is_explicit(&self) -> bool {
        self.beta == T::lift(0.0)
    }

    /// Δ, in `work.increment`, and q1 with its force.
    fn solve<S: RegularLagrangian>(
        &self,
        system: &S,
        memory: &mut NewmarkMemory<S, T>,
        q: &[T],
        [t, h]: [T; 2],
        solver: Solver,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        memory.guess(h);
        let max = self.stopping.max_iterations;
        let budget = if solver == Solver::Automatic { max.min(24 + q.len()) } else { max };
        let scale = norm::largest(q) + norm::largest(&memory.work.increment);
        let mut convergence = if solver == Solver::Newton {
            Convergence::new(self.stopping, scale, q, budget)
        } else {
            Convergence::fixed_point(self.stopping, scale, q, budget)
        };
        let verdict = loop {
            memory.place(system, self.beta, q, [t, h], statistics);
            let correction = if solver == Solver::Newton {
                memory.improve(system, self.beta, [t, h], statistics)?
            } else {
                memory.carry(h)
            };
            match convergence.judge(correction) {
                Verdict::Continue => {}
                verdict => break verdict,
            }
        };
        statistics.iterations += convergence.iterations as u64;
        match verdict {
            Verdict::GiveUp => Err(convergence.failure()),
            _ => norm::finite(&memory.work.increment),
        }
    }

    /// Newton where it has been asked for or where the fixed point has failed.
    fn solve_by_any<S: RegularLagrangian>(
        &self,
        system: &S,
        memory: &mut NewmarkMemory<S, T>,
        q: &[T],
        at: [T; 2],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        if self.solver != Solver::Newton && memory.newton_steps == 0 {
            match self.solve(system, memory, q, at, self.solver, statistics) {
                Err(StepFailure::NotConverged { .. } | StepFailure::NotFinite { .. })
                    if memory.newton.is_some() =>
                {
                    memory.newton_steps = STEPS_BEFORE_RETRY;
                }
                result => return result,
            }
        }
        memory.newton_steps = memory.newton_steps.saturating_sub(1);
        self.solve(system, memory, q, at, Solver::Newton, statistics)
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

impl<S: Lagrangian, T: Real> Carries<S, T> for Newmark<T> {
    type Memory = NewmarkMemory<S, T>;
}

impl<S: RegularLagrangian, T: Real> Method<S, T> for Newmark<T> {
    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, _h: T) -> Result<Self::Memory, StartError> {
        if !(self.beta >= T::lift(0.0) && self.beta <= T::lift(0.5)) {
            let (value, range) = (reported(self.beta), "0 <= beta <= 1/2");
            return Err(StartError::Parameter { name: "beta", value, range });
        }
        if !S::SEPARABLE {
            let reason =
                "it needs L = ½ v·M v − V(q, t) with a constant matrix M; take Variational or Galerkin";
            return Err(StartError::Unsupported { option: "Newmark", reason });
        }
        self.stopping.validate()?;
        let space = system.space();
        let [mut force, mut p, mut mean]: [Vector<S, T>; 3] = core::array::from_fn(|_| space.vector());
        system.gradient(q, v, t, &mut force, &mut p);
        norm::finite(&p).and(norm::finite(&force)).map_err(StartError::Starter)?;
        mean.copy_from_slice(v);
        let newton = !self.is_explicit() && self.solver != Solver::FixedPoint;
        Ok(NewmarkMemory {
            p,
            force,
            mass: Mass::new(system, q, t).map_err(StartError::Starter)?,
            history: History::new(system, Some(mean)),
            last_step: T::lift(0.0),
            newton: newton.then(|| space.matrix()),
            newton_steps: 0,
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
        let kick = T::lift(0.5) * h;
        for i in 0..q.len() {
            memory.work.half[i] = memory.p[i] + kick * memory.force[i];
        }
        if self.is_explicit() {
            memory.work.carrier.copy_from_slice(&memory.work.half);
            memory.carry(h);
        } else {
            self.solve_by_any(system, memory, q, [t, h], statistics)?;
        }
        memory.place(system, self.beta, q, [t, h], statistics);
        let Work { half, momentum, next_force, .. } = &mut memory.work;
        for i in 0..q.len() {
            momentum[i] = half[i] + kick * next_force[i];
        }
        memory.complete(h, q)
    }

    fn restore(&self, from: &Self::Memory, to: &mut Self::Memory) {
        to.p.copy_from_slice(&from.p);
        to.force.copy_from_slice(&from.force);
        to.history.restore(&from.history);
        (to.last_step, to.newton_steps) = (from.last_step, from.newton_steps);
    }

    fn velocity(
        &self,
        _system: &S,
        memory: &Self::Memory,
        _q: &Vector<S, T>,
        _t: T,
        v: &mut Vector<S, T>,
    ) -> Result<(), StepFailure> {
        memory.mass.solve(&memory.p, v);
        Ok(())
    }
}

impl<S: Lagrangian, T: Real> Work<S, T> {
    fn new(system: &S) -> Self {
        let vector = || system.space().vector();
        Self {
            half: vector(),
            increment: vector(),
            next: vector(),
            next_force: vector(),
            carrier: vector(),
            velocity: vector(),
            momentum: vector(),
        }
    }
}
