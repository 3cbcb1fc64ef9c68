//! L = ½ v·M v − V(q, t): the fixed point that needs forces only.
//!
//! r(q1) = p0 + D₁L_d = p0 + M(A q0 − K q1)/h + h Σ w b F(qʲ),     q1 ← q1 + (h/κ) M⁻¹r,   κ = S/(sin u/u)²
//! p1 = p0 + (D₁ + D₂)L_d = p0 + M((A − K) q0 + (C − K) q1)/h + h Σ w (b + b̄) F(qʲ)
//!
//! κ contains the oscillator of the fitted frequency, so that only what differs from it is iterated. Where no
//! node lies between the ends and the frequency does not depend on q1, r is linear in q1 and the step explicit:
//! p½ = p0 + h Σ w F(q0) + M(A − K)q0/h,   q1 = q0 + (h/K) M⁻¹p½,   p1 = p½ + h Σ w F(q1) + M(C − K)q1/h.

use super::Step;
use super::coefficients::{Adjustable, Uniform};
use super::memory::{Interpolation, Parts, Work};
use crate::discrete::NodeWork;
use crate::discrete::basis::Basis;
use crate::discrete::frequency::{FrequencyIn, Reading};
use crate::discrete::quadrature::Rule;
use crate::error::StepFailure;
use crate::mechanics::mass::Mass;
use crate::mechanics::phase::{Arrival, PhasePoint};
use crate::scalar::norm;
use crate::scalar::simd::widest_if;
use crate::solve::{Convergence, iterate};
use crate::state::Statistics;
use crate::{NondegenerateLagrangian, Real, Space, Vector};

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn step<S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, R: Rule, T: Real>(
    step: &Step<'_, S, F, R, T>,
    Parts { interpolation, phase, inertial, work, q, .. }: &mut Parts<'_, S, T>,
    budget: usize,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    // L is separable.
    let Some(mass) = inertial.constant() else {
        return Err(StepFailure::Singular { column: 0, pivot: f64::NAN });
    };
    let mut on_stack;
    let work: &mut Work<S, T> = if <S::Space as Space>::ON_STACK {
        on_stack = Work::new(step.system);
        &mut on_stack
    } else {
        work
    };
    widest_if(
        !<S::Space as Space>::ON_STACK,
        #[cfg_attr(not(debug_assertions), inline(always))]
        || match interpolation {
            // Coefficients that change in each iteration belong into registers.
            Interpolation::Uniform(_) if step.method.frequency.reading().is_some() => {
                let coefficients = &mut Uniform::linear(&step.method.rule);
                complete(step, coefficients, mass, phase, work, q, budget, statistics)
            }
            Interpolation::Uniform(uniform) => {
                complete(step, uniform, mass, phase, work, q, budget, statistics)
            }
            Interpolation::Each(each) => complete(step, each, mass, phase, work, q, budget, statistics),
        },
    )
}

#[cfg_attr(not(debug_assertions), inline(always))]
#[allow(clippy::too_many_arguments)]
fn complete<S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, R: Rule, C: Adjustable<S, T>, T: Real>(
    step: &Step<'_, S, F, R, T>,
    coefficients: &mut C,
    mass: &Mass<S, T>,
    phase: &mut PhasePoint<S, T>,
    work: &mut Work<S, T>,
    q: &mut Vector<S, T>,
    budget: usize,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let start = T::lift(0.0);
    let mut attempt = Attempt { step, coefficients, mass, phase, q, work, start, gradients: 0 };
    let result = attempt.run(budget, statistics);
    statistics.gradients += attempt.gradients;
    result?;
    let Work { node, next, increment, .. } = work;
    phase.arrive(q, &Arrival { q: next, p: &node.momentum, force: &node.gradient }, increment, step.h)
}

/// How much of the impulse of a node is meant. A value and no function: the loop of a node is compiled once for all.
#[derive(Clone, Copy)]
enum Share {
    /// What belongs to the left end: b.
    Left,
    /// What belongs to both ends: b + b̄.
    Both,
    /// All of it: the node is an end.
    Whole,
}

impl Share {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of<T: Real>(self, Basis { b, b_bar, .. }: Basis<T>) -> T {
        match self {
            Self::Left => b,
            Self::Both => b + b_bar,
            Self::Whole => T::lift(1.0),
        }
    }
}

/// A step as it is being solved. In `work`: `increment` is Δ, `next` is q1 and `node.gradient` is F(q1) once they have
/// been asked for, `node.momentum` is p1 in the end.
struct Attempt<'a, S: NondegenerateLagrangian<T>, F, R, C, T: Real> {
    step: &'a Step<'a, S, F, R, T>,
    coefficients: &'a mut C,
    mass: &'a Mass<S, T>,
    phase: &'a PhasePoint<S, T>,
    q: &'a [T],
    work: &'a mut Work<S, T>,
    /// The frequency at the start of the step.
    start: T,
    gradients: u64,
}

impl<S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, R: Rule, C: Adjustable<S, T>, T: Real>
    Attempt<'_, S, F, R, C, T>
{
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(&mut self, budget: usize, statistics: &mut Statistics) -> Result<(), StepFailure> {
        self.read_start()?;
        if self.step.method.is_explicit() {
            self.kick_drift_kick();
            return Ok(());
        }
        self.solve(budget, statistics)?;
        self.finish()
    }

    /// The coefficients, as far as the start of the step decides them.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn read_start(&mut self) -> Result<(), StepFailure> {
        let Some(reading) = self.step.method.frequency.reading() else {
            return self.coefficients.fix(self.step);
        };
        let NodeWork { velocity, point, .. } = &mut self.work.node;
        self.mass.solve(&self.phase.p, velocity);
        self.mass.solve(&self.phase.force, point);
        self.start = self.step.method.frequency.at(self.q, velocity, point);
        match reading {
            Reading::LeftFrozen => self.coefficients.set(self.step, self.start),
            _ => Ok(()),
        }
    }

    /// Δ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn solve(&mut self, budget: usize, statistics: &mut Statistics) -> Result<(), StepFailure> {
        self.phase.guess(Some(self.mass), &self.phase.p, self.step.h, &mut self.work.increment);
        let scale = norm::largest(self.q) + norm::largest(&self.work.increment);
        let convergence = Convergence::fixed_point(self.step.method.stopping, scale, self.q, budget);
        iterate(
            convergence,
            statistics,
            #[cfg_attr(not(debug_assertions), inline(always))]
            |_| {
                if self.step.method.reads_both_ends() {
                    self.read_both_ends()?;
                }
                Ok(self.improve())
            },
        )?;
        norm::finite(&self.work.increment)
    }

    /// q1 and F(q1).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn reach(&mut self) {
        let Work { next, increment, node: NodeWork { gradient, .. }, .. } = &mut *self.work;
        for ((next, &q), &delta) in next.iter_mut().zip(self.q).zip(increment.iter()) {
            *next = q + delta;
        }
        self.step.system.force(next, &[], self.step.node_time(1.0), gradient);
        self.gradients += 1;
    }

    /// The coefficients for the mean of the frequencies at both ends.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn read_both_ends(&mut self) -> Result<(), StepFailure> {
        self.reach();
        let frequency = &self.step.method.frequency;
        let Work { next, increment, node, .. } = &mut *self.work;
        let NodeWork { gradient, velocity, point, .. } = node;
        if F::OF_VELOCITY {
            let per_h = T::lift(1.0) / self.step.h;
            for (v, &delta) in velocity.iter_mut().zip(increment.iter()) {
                *v = delta * per_h;
            }
            self.mass.solve(&self.phase.force, point);
            self.start = frequency.at(self.q, velocity, point);
        }
        self.mass.solve(gradient, point);
        let end = frequency.at(next, velocity, point);
        self.coefficients.set(self.step, T::lift(0.5) * (self.start + end))
    }

    /// One iteration; returns the size of its correction.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn improve(&mut self) -> T {
        let h = self.step.h;
        self.work.node.momentum.copy_from_slice(&self.phase.p);
        for (node, &c) in self.step.method.rule.nodes().iter().enumerate() {
            // At the end of the step b = 0.
            if c != 1.0 {
                self.kick(node, c, Share::Left);
            }
        }
        let Work { increment, node: NodeWork { momentum, velocity, .. }, .. } = &mut *self.work;
        let sums = self.coefficients.sums();
        let correct = |i: usize, velocity: T, q: T, delta: &mut T| {
            let sums = sums(i);
            let correction = (h * velocity + sums.left * q - sums.mixed * *delta) * sums.inverse_kappa;
            *delta += correction;
            correction
        };
        // Corrections take the place of velocities, which are of no use any more.
        if let Some(reciprocals) = self.mass.reciprocals() {
            let unknowns = velocity.iter_mut().zip(increment.iter_mut()).zip(self.q);
            for (i, (((velocity, delta), &q), (&p, &reciprocal))) in
                unknowns.zip(momentum.iter().zip(reciprocals)).enumerate()
            {
                *velocity = correct(i, p * reciprocal, q, delta);
            }
        } else {
            self.mass.solve(momentum, velocity);
            for (i, ((velocity, delta), &q)) in
                velocity.iter_mut().zip(increment.iter_mut()).zip(self.q).enumerate()
            {
                *velocity = correct(i, *velocity, q, delta);
            }
        }
        norm::largest(velocity)
    }

    /// Adds the impulse h w F(qʲ) of a node to `momentum`, as far as it belongs to `share`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn kick(&mut self, node: usize, c: f64, share: Share) {
        let weight = self.step.h * self.coefficients.weight(node);
        let Work { increment, node: work, trial, .. } = &mut *self.work;
        let NodeWork { momentum, point, gradient, .. } = work;
        let force: &[T] = if c == 0.0 {
            &self.phase.force
        } else if c == 1.0 {
            gradient
        } else {
            let basis = self.coefficients.bases(node);
            for (i, ((point, &q), &delta)) in point.iter_mut().zip(self.q).zip(increment.iter()).enumerate() {
                let Basis { b, b_bar, .. } = basis(i);
                *point = (b + b_bar) * q + b_bar * delta;
            }
            self.step.system.force(point, &[], self.step.node_time(c), trial);
            self.gradients += 1;
            trial
        };
        let basis = self.coefficients.bases(node);
        for (i, (p, &f)) in momentum.iter_mut().zip(force).enumerate() {
            *p += weight * share.of(basis(i)) * f;
        }
    }

    /// q1, F(q1) and p1 without iteration, where no node lies between the ends.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn kick_drift_kick(&mut self) {
        self.work.node.momentum.copy_from_slice(&self.phase.p);
        self.kick_at(0.0);
        let Work { increment, node: NodeWork { momentum, velocity, .. }, .. } = &mut *self.work;
        self.mass.solve(momentum, velocity);
        {
            let (h, sums) = (self.step.h, self.coefficients.sums());
            for (i, (delta, &v)) in increment.iter_mut().zip(velocity.iter()).enumerate() {
                *delta = h * v / sums(i).mixed;
            }
        }
        self.reach();
        self.kick_at(1.0);
    }

    /// What the end `c` of the step adds to `momentum`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn kick_at(&mut self, c: f64) {
        for node in 0..self.step.method.rule.nodes().len() {
            if self.step.method.rule.nodes()[node] == c {
                self.kick(node, c, Share::Whole);
            }
        }
        if F::UNFITTED {
            return;
        }
        let Work { next, node: NodeWork { momentum, velocity, .. }, .. } = &mut *self.work;
        let point: &[T] = if c == 0.0 { self.q } else { next };
        let sums = self.coefficients.sums();
        for (i, (v, &q)) in velocity.iter_mut().zip(point).enumerate() {
            let sums = sums(i);
            *v = if c == 0.0 { sums.left } else { sums.right } * q;
        }
        self.mass.multiply_add(T::lift(1.0) / self.step.h, velocity, momentum);
    }

    /// q1, F(q1) and p1.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn finish(&mut self) -> Result<(), StepFailure> {
        if self.step.method.reads_both_ends() {
            self.read_both_ends()?;
        } else {
            self.reach();
        }
        self.work.node.momentum.copy_from_slice(&self.phase.p);
        for (node, &c) in self.step.method.rule.nodes().iter().enumerate() {
            self.kick(node, c, Share::Both);
        }
        if !F::UNFITTED {
            let Work { next, node: NodeWork { momentum, velocity, .. }, .. } = &mut *self.work;
            let sums = self.coefficients.sums();
            for i in 0..self.q.len() {
                let sums = sums(i);
                velocity[i] = sums.left * self.q[i] + sums.right * next[i];
            }
            self.mass.multiply_add(T::lift(1.0) / self.step.h, velocity, momentum);
        }
        Ok(())
    }
}
