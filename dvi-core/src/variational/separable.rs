//! L = ½ v·M v − V(q, t): the fixed point that needs forces only.
//!
//! r(q1) = p0 + D₁L_d = p0 + M(A q0 − K q1)/h + h Σ w b F(qʲ),     q1 ← q1 + (h/κ) M⁻¹r,   κ = S/(sin u/u)²
//! p1 = p0 + (D₁ + D₂)L_d = p0 + M((A − K) q0 + (C − K) q1)/h + h Σ w (b + b̄) F(qʲ)
//!
//! κ contains the oscillator of the fitted frequency, so that only what differs from it is iterated. Where no
//! node lies between the ends and the frequency does not depend on q1, r is linear in q1 and the step explicit:
//! p½ = p0 + h Σ w F(q0) + M(A − K)q0/h,   q1 = q0 + (h/K) M⁻¹p½,   p1 = p½ + h Σ w F(q1) + M(C − K)q1/h.

use super::coefficients::{Adjustable, Uniform};
use super::memory::{Interpolation, Motion, VariationalMemory, Work};
use super::{Step, general};
use crate::basis::Basis;
use crate::error::StepFailure;
use crate::frequency::{FrequencyIn, Reading};
use crate::mass::Mass;
use crate::quadrature::Rule;
use crate::solver::{Convergence, STEPS_BEFORE_RETRY, Solver, Verdict};
use crate::statistics::Statistics;
use crate::{Real, RegularLagrangian, Scalar, Space, Vector, norm};

pub(super) fn step<S: RegularLagrangian, F: FrequencyIn<T>, R: Rule, T: Real>(
    step: &Step<'_, S, F, R, T>,
    memory: &mut VariationalMemory<S, T>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let by_newton = step.method.solver == Solver::Newton && !step.method.is_explicit();
    if by_newton || memory.motion.newton_steps > 0 {
        return general::step(step, memory, q, statistics);
    }
    let VariationalMemory { interpolation, motion, work, .. } = memory;
    let mut on_stack;
    let work = if <S::Space as Space>::ON_STACK {
        on_stack = Work::new(step.system);
        &mut on_stack
    } else {
        work
    };
    let result = match interpolation {
        // Coefficients that change in each iteration belong into registers.
        Interpolation::Uniform(_) if step.method.frequency.reading().is_some() => {
            let mut uniform = Uniform::linear(&step.method.rule);
            advance(step, &mut uniform, motion, work, q, statistics)
        }
        Interpolation::Uniform(uniform) => advance(step, uniform, motion, work, q, statistics),
        Interpolation::Each(each) => advance(step, each, motion, work, q, statistics),
    };
    match result {
        Err(StepFailure::NotConverged { .. } | StepFailure::NotFinite { .. }) if motion.newton.is_some() => {
            motion.newton_steps = STEPS_BEFORE_RETRY;
            general::step(step, memory, q, statistics)
        }
        result => result,
    }
}

#[inline(always)]
fn advance<S: RegularLagrangian, F: FrequencyIn<T>, R: Rule, T: Real>(
    step: &Step<'_, S, F, R, T>,
    coefficients: &mut impl Adjustable<S, T>,
    motion: &mut Motion<S, T>,
    work: &mut Work<S, T>,
    q: &mut Vector<S, T>,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    if !step.method.is_explicit() {
        motion.guess(step.h, &mut work.increment);
    }
    // Every run of a separable system has it.
    let Motion { p, force, mass: Some(mass), .. } = motion else { return Ok(()) };
    let mut attempt =
        Attempt { step, coefficients, mass, p, force, q, work, start: T::lift(0.0), gradients: 0 };
    let result = attempt.read_start().and_then(|()| {
        if step.method.is_explicit() {
            attempt.kick_drift_kick();
            return Ok(());
        }
        attempt.solve(statistics)?;
        attempt.finish()
    });
    statistics.gradients += attempt.gradients;
    result?;
    norm::finite(&work.next).and(norm::finite(&work.momentum)).and(norm::finite(&work.gradient))?;
    q.copy_from_slice(&work.next);
    motion.p.copy_from_slice(&work.momentum);
    motion.force.copy_from_slice(&work.gradient);
    motion.remember(step.h, &work.increment);
    Ok(())
}

/// A step as it is being solved. In `work`: `increment` is Δ, `next` is q1 and `gradient` is F(q1) once they have
/// been asked for, `momentum` is p1 in the end.
struct Attempt<'a, S: RegularLagrangian, F, R, C, T: Real> {
    step: &'a Step<'a, S, F, R, T>,
    coefficients: &'a mut C,
    mass: &'a Mass<S, T>,
    p: &'a [T],
    force: &'a [T],
    q: &'a [T],
    work: &'a mut Work<S, T>,
    /// The frequency at the start of the step.
    start: T,
    gradients: u64,
}

impl<S: RegularLagrangian, F: FrequencyIn<T>, R: Rule, C: Adjustable<S, T>, T: Real>
    Attempt<'_, S, F, R, C, T>
{
    /// The coefficients, as far as the start of the step decides them.
    #[inline(always)]
    fn read_start(&mut self) -> Result<(), StepFailure> {
        let Some(reading) = self.step.method.frequency.reading() else {
            return self.coefficients.fix(self.step);
        };
        let Work { velocity, point, .. } = &mut *self.work;
        self.mass.solve(self.p, velocity);
        self.mass.solve(self.force, point);
        self.start = self.step.method.frequency.at(self.q, velocity, point);
        match reading {
            Reading::LeftFrozen => self.coefficients.set(self.step, self.start),
            _ => Ok(()),
        }
    }

    /// Δ.
    #[inline(always)]
    fn solve(&mut self, statistics: &mut Statistics) -> Result<(), StepFailure> {
        let scale = norm::largest(self.q) + norm::largest(&self.work.increment);
        let stopping = self.step.method.stopping;
        let mut convergence =
            Convergence::fixed_point(stopping, scale, self.q, self.step.budget(self.q.len()));
        let verdict = loop {
            if self.step.method.reads_both_ends() {
                self.read_both_ends()?;
            }
            let correction = self.improve();
            match convergence.judge(correction) {
                Verdict::Continue => {}
                verdict => break verdict,
            }
        };
        statistics.iterations += convergence.iterations as u64;
        match verdict {
            Verdict::GiveUp => Err(convergence.failure()),
            _ => norm::finite(&self.work.increment),
        }
    }

    /// q1 and F(q1).
    #[inline(always)]
    fn reach(&mut self) {
        let Work { next, increment, gradient, .. } = &mut *self.work;
        for ((next, &q), &delta) in next.iter_mut().zip(self.q).zip(increment.iter()) {
            *next = q + delta;
        }
        self.step.system.force(next, &[], self.step.node_time(1.0), gradient);
        self.gradients += 1;
    }

    /// The coefficients for the mean of the frequencies at both ends.
    #[inline(always)]
    fn read_both_ends(&mut self) -> Result<(), StepFailure> {
        self.reach();
        let frequency = &self.step.method.frequency;
        let Work { next, increment, gradient, velocity, point, .. } = &mut *self.work;
        if F::OF_VELOCITY {
            let per_h = T::lift(1.0) / self.step.h;
            for (v, &delta) in velocity.iter_mut().zip(increment.iter()) {
                *v = delta * per_h;
            }
            self.mass.solve(self.force, point);
            self.start = frequency.at(self.q, velocity, point);
        }
        self.mass.solve(gradient, point);
        let end = frequency.at(next, velocity, point);
        self.coefficients.set(self.step, T::lift(0.5) * (self.start + end))
    }

    /// One iteration; returns the size of its correction.
    #[inline(always)]
    fn improve(&mut self) -> T {
        let h = self.step.h;
        self.work.momentum.copy_from_slice(self.p);
        for (node, &c) in self.step.method.rule.nodes().iter().enumerate() {
            // At the end of the step b = 0.
            if c != 1.0 {
                self.kick(node, c, |basis| basis.b);
            }
        }
        let Work { increment, momentum, velocity, .. } = &mut *self.work;
        self.mass.solve(momentum, velocity);
        let mut correction = T::lift(0.0);
        for i in 0..self.q.len() {
            let sums = self.coefficients.sums(i);
            let residual = h * velocity[i] + sums.left * self.q[i] - sums.mixed * increment[i];
            let change = residual * sums.compliance;
            increment[i] += change;
            correction = norm::larger(correction, Scalar::abs(change));
        }
        correction
    }

    /// Adds the impulse h w F(qʲ) of a node to `momentum`, times the factor that `share` picks.
    #[inline(always)]
    fn kick(&mut self, node: usize, c: f64, share: impl Fn(Basis<T>) -> T) {
        let weight = self.step.h * self.coefficients.weight(node);
        let Work { increment, momentum, point, gradient, trial, .. } = &mut *self.work;
        let force: &[T] = if c == 0.0 {
            self.force
        } else if c == 1.0 {
            gradient
        } else {
            for i in 0..self.q.len() {
                let Basis { b, b_bar, .. } = self.coefficients.basis(node, i);
                point[i] = (b + b_bar) * self.q[i] + b_bar * increment[i];
            }
            self.step.system.force(point, &[], self.step.node_time(c), trial);
            self.gradients += 1;
            trial
        };
        for (i, (p, &f)) in momentum.iter_mut().zip(force).enumerate() {
            *p += weight * share(self.coefficients.basis(node, i)) * f;
        }
    }

    /// q1, F(q1) and p1 without iteration, where no node lies between the ends.
    #[inline(always)]
    fn kick_drift_kick(&mut self) {
        self.work.momentum.copy_from_slice(self.p);
        self.kick_at(0.0);
        let Work { momentum, velocity, increment, .. } = &mut *self.work;
        self.mass.solve(momentum, velocity);
        for (i, (delta, &v)) in increment.iter_mut().zip(velocity.iter()).enumerate() {
            *delta = self.step.h * v / self.coefficients.sums(i).mixed;
        }
        self.reach();
        self.kick_at(1.0);
    }

    /// What the end `c` of the step adds to `momentum`.
    #[inline(always)]
    fn kick_at(&mut self, c: f64) {
        for node in 0..self.step.method.rule.nodes().len() {
            if self.step.method.rule.nodes()[node] == c {
                self.kick(node, c, |_| T::lift(1.0));
            }
        }
        if F::UNFITTED {
            return;
        }
        let Work { next, momentum, velocity, .. } = &mut *self.work;
        let point: &[T] = if c == 0.0 { self.q } else { next };
        for (i, (v, &q)) in velocity.iter_mut().zip(point).enumerate() {
            let sums = self.coefficients.sums(i);
            *v = if c == 0.0 { sums.left } else { sums.right } * q;
        }
        self.mass.multiply_add(T::lift(1.0) / self.step.h, velocity, momentum);
    }

    /// q1, F(q1) and p1.
    #[inline(always)]
    fn finish(&mut self) -> Result<(), StepFailure> {
        if self.step.method.reads_both_ends() {
            self.read_both_ends()?;
        } else {
            self.reach();
        }
        self.work.momentum.copy_from_slice(self.p);
        for (node, &c) in self.step.method.rule.nodes().iter().enumerate() {
            self.kick(node, c, |basis| basis.b + basis.b_bar);
        }
        if !F::UNFITTED {
            let Work { next, momentum, velocity, .. } = &mut *self.work;
            for i in 0..self.q.len() {
                let sums = self.coefficients.sums(i);
                velocity[i] = sums.left * self.q[i] + sums.right * next[i];
            }
            self.mass.multiply_add(T::lift(1.0) / self.step.h, velocity, momentum);
        }
        Ok(())
    }
}
