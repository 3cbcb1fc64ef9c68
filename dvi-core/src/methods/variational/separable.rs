//! L = ½ v·M v − V(q, t): the fixed point that needs forces only.
//!
//! r(q1) = p0 + D₁L_d = p0 + M(A q0 − K q1)/h + h Σ w b F(qʲ),     q1 ← q1 + (h/κ) M⁻¹r,   κ = S/(sin u/u)²
//! p1 = p0 + (D₁ + D₂)L_d = p0 + M((A − K) q0 + (C − K) q1)/h + h Σ w (b + b̄) F(qʲ)
//!
//! κ contains the oscillator of the fitted frequency, so that only what differs from it is iterated. Where
//! no node lies between the ends and the frequency does not depend on q1, r is linear in q1 and the step
//! explicit: p½ = p0 + h Σ w F(q0) + M(A − K)q0/h, q1 = q0 + (h/K) M⁻¹p½, p1 = p½ + h Σ w F(q1) + M(C −
//! K)q1/h.

use super::Step;
use super::coefficients::{Coefficients, Sums};
use crate::discrete::NodeWork;
use crate::discrete::basis::Basis;
use crate::discrete::frequency::{FrequencyIn, Reading};
use crate::discrete::quadrature::Rule;
use crate::error::StepFailure;
use crate::mechanics::mass::Mass;
use crate::mechanics::phase::PhasePoint;
use crate::methods::step::{Carried, Work};
use crate::scalar::blocks::blocks;
use crate::scalar::norm;
use crate::scalar::simd::widest_if;
use crate::solve::{Convergence, Due, Iteration, repeat, sizes};
use crate::space::scratch;
use crate::state::Statistics;
use crate::{NondegenerateLagrangian, Real, Space, Vector};

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn step<S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, R: Rule, T: Real>(
    step: &Step<'_, S, F, R, T>,
    coefficients: &mut Coefficients<T>,
    Carried { phase, inertial, work, weights }: &mut Carried<S, T>,
    q: &mut Vector<S, T>,
    budget: usize,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let Some(mass) = inertial.constant() else { return Err(StepFailure::NO_MATRIX) };
    let mut on_stack;
    let work: &mut Work<S, T> = if <S::Space as Space>::ON_STACK {
        on_stack = Work::new(step.system);
        &mut on_stack
    } else {
        work
    };
    scratch!(weights = step.system, *weights);
    widest_if(
        !<S::Space as Space>::ON_STACK,
        #[cfg_attr(not(debug_assertions), inline(always))]
        || {
            if !F::UNFITTED && step.method.frequency.reading().is_some() {
                // Coefficients that change in each iteration belong into registers.
                let coefficients = &mut Coefficients::linear(&step.method.rule);
                return complete(step, coefficients, mass, phase, (work, weights), q, budget, statistics);
            }
            complete(step, coefficients, mass, phase, (work, weights), q, budget, statistics)
        },
    )
}

#[cfg_attr(not(debug_assertions), inline(always))]
#[allow(clippy::too_many_arguments)]
fn complete<S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, R: Rule, T: Real>(
    step: &Step<'_, S, F, R, T>,
    coefficients: &mut Coefficients<T>,
    mass: &Mass<S, T>,
    phase: &mut PhasePoint<S, T>,
    (work, weights): (&mut Work<S, T>, &mut [T]),
    q: &mut Vector<S, T>,
    budget: usize,
    statistics: &mut Statistics,
) -> Result<(), StepFailure> {
    let start = T::lift(0.0);
    let is_placed = false;
    let mut attempt = Attempt { step, coefficients, mass, phase, q, work, start, is_placed, gradients: 0 };
    let result = attempt.run(weights, budget, statistics);
    statistics.gradients += attempt.gradients;
    result?;
    let Work { node: NodeWork { momentum, gradient, .. }, next, increment, .. } = work;
    phase.arrive(q, [next, momentum, gradient], increment, step.h)
}

/// How much of the impulse of a node is meant. A value and no function: the loop of a node is compiled once
/// for all.
#[derive(Clone, Copy, PartialEq, Eq)]
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

impl<T: Real> Sums<T> {
    /// What is missing in Δ = `delta` where h M⁻¹(p0 + h Σ w b F) is `displacement`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn correction(self, displacement: T, q: T, delta: T) -> T {
        (displacement + self.left * q - self.mixed * delta) * self.inverse_kappa
    }
}

/// A step as it is being solved. In `work`: `increment` is Δ, `next` is q1 and `node.gradient` is F(q1) once
/// they have been asked for, `node.momentum` is p1 in the end.
struct Attempt<'a, S: NondegenerateLagrangian<T>, F, R, T: Real> {
    step: &'a Step<'a, S, F, R, T>,
    coefficients: &'a mut Coefficients<T>,
    mass: &'a Mass<S, T>,
    phase: &'a PhasePoint<S, T>,
    q: &'a [T],
    work: &'a mut Work<S, T>,
    /// The frequency at the start of the step.
    start: T,
    /// Whether `point` is where the only node between the ends is for the present Δ.
    is_placed: bool,
    gradients: u64,
}

impl<S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, R: Rule, T: Real> Attempt<'_, S, F, R, T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(
        &mut self,
        weights: &mut [T],
        budget: usize,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.read_start()?;
        if self.step.method.is_explicit() {
            self.kick_drift_kick();
            return Ok(());
        }
        self.solve(weights, budget, statistics)?;
        self.finish()
    }

    /// The coefficients, as far as the start of the step decides them.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn read_start(&mut self) -> Result<(), StepFailure> {
        if F::UNFITTED {
            return self.coefficients.fix(self.step);
        }
        let Some(reading) = self.step.method.frequency.reading() else {
            return self.coefficients.fix(self.step);
        };
        let NodeWork { velocity, point, .. } = &mut self.work.node;
        self.mass.solve(&self.phase.p, velocity);
        self.mass.solve(&self.phase.force, point);
        self.start = self.step.method.frequency.at(self.q, velocity, point);
        match reading {
            Reading::LeftFrozen => self.coefficients.set(self.step, self.start),
            // Each iteration reads the end.
            Reading::Averaged => Ok(()),
            // Such a step needs more than forces.
            Reading::Variational => Err(StepFailure::Frequency { omega: f64::NAN }),
        }
    }

    /// Δ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn solve(
        &mut self,
        weights: &mut [T],
        budget: usize,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.phase.guess(Some(self.mass), &self.phase.p, self.step.h, &mut self.work.increment);
        let convergence = Convergence::fixed_point(self.step.method.stopping, budget);
        repeat(convergence, statistics, Judged { attempt: self, weights })?;
        norm::finite(&self.work.increment)
    }

    /// q1 and F(q1).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn reach(&mut self) {
        let Work { next, increment, node: NodeWork { gradient, .. }, .. } = &mut *self.work;
        for ((next, &q), &delta) in next.iter_mut().zip(self.q).zip(increment.iter()) {
            *next = q + delta;
        }
        self.step.force(next, 1.0, gradient);
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
    fn improve(&mut self, weights: &[T]) -> T {
        let nodes = self.step.method.rule.nodes();
        // At the end of the step b = 0.
        let mut left = nodes.iter().enumerate().filter(|(_, c)| **c != 1.0);
        match (self.mass.reciprocals(), left.next_back()) {
            (Some(reciprocals), Some((last, &c))) => {
                let is_only = left.next().is_none();
                if !is_only {
                    self.gather(last, Share::Left);
                }
                self.correct_by_last(weights, reciprocals, (last, c), is_only)
            }
            _ => {
                self.gather(nodes.len(), Share::Left);
                let NodeWork { momentum, velocity, .. } = &mut self.work.node;
                self.mass.solve(momentum, velocity);
                self.correct(weights)
            }
        }
    }

    /// Corrects Δ by the velocity that belongs to the impulses of the left end, and returns the size of the
    /// correction.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn correct(&mut self, weights: &[T]) -> T {
        let Work { increment, node: NodeWork { velocity, .. }, .. } = &mut *self.work;
        let sums = self.coefficients.sums;
        // Corrections take the place of velocities, which are of no use any more.
        for ((velocity, delta), &q) in velocity.iter_mut().zip(increment.iter_mut()).zip(self.q) {
            *velocity = sums.correction(self.step.h * *velocity, q, *delta);
            *delta += *velocity;
        }
        sizes::largest(weights, velocity)
    }

    /// The same, with the impulse of the last node that has one at the left end, which is not in `momentum`
    /// yet; if it is the only one, nothing is in `momentum`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn correct_by_last(
        &mut self,
        weights: &[T],
        reciprocals: &[T],
        (node, c): (usize, f64),
        is_only: bool,
    ) -> T {
        self.evaluate(node, c);
        let (h, basis, sums) = (self.step.h, self.coefficients.bases[node], self.coefficients.sums);
        let weight = h * self.coefficients.weights[node];
        let Work { increment, trial, node: NodeWork { momentum, velocity, point, .. }, .. } =
            &mut *self.work;
        let p = if is_only { &self.phase.p } else { &*momentum };
        let force = if c == 0.0 { &self.phase.force } else { &*trial };
        // Where nothing but Δ moves it, the node is followed.
        self.is_placed = c != 0.0 && self.step.method.has_one_node_to_follow();
        let mut largest = T::lift(0.0);
        for block in blocks(self.q.len()) {
            let (q, p) = (&self.q[block.clone()], &p[block.clone()]);
            let (force, reciprocals) = (&force[block.clone()], &reciprocals[block.clone()]);
            let corrections = &mut velocity[..block.len()];
            let increment = &mut increment[block.clone()];
            for i in 0..block.len() {
                let velocity = (p[i] + weight * Share::Left.of(basis) * force[i]) * reciprocals[i];
                corrections[i] = sums.correction(h * velocity, q[i], increment[i]);
                increment[i] += corrections[i];
            }
            largest = norm::larger(largest, sizes::largest(&weights[block.clone()], corrections));
            if self.is_placed {
                place(basis, [q, increment], &mut point[block]);
            }
        }
        largest
    }

    /// Sets `momentum` to p0 and the impulses that the first nodes give to `share`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn gather(&mut self, nodes: usize, share: Share) {
        self.work.node.momentum.copy_from_slice(&self.phase.p);
        for (node, &c) in self.step.method.rule.nodes()[..nodes].iter().enumerate() {
            // The end of the step gives nothing to the left one.
            if share == Share::Both || c != 1.0 {
                self.kick(node, c, share);
            }
        }
    }

    /// Sets `trial` to the force at a node between the ends.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn evaluate(&mut self, node: usize, c: f64) {
        if c == 0.0 || c == 1.0 {
            return;
        }
        let Work { increment, node: NodeWork { point, .. }, trial, .. } = &mut *self.work;
        if !self.is_placed {
            place(self.coefficients.bases[node], [self.q, increment], point);
        }
        self.step.force(point, c, trial);
        self.gradients += 1;
    }

    /// Adds the impulse h w F(qʲ) of a node to `momentum`, as far as it belongs to `share`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn kick(&mut self, node: usize, c: f64, share: Share) {
        self.evaluate(node, c);
        let weight = self.step.h * self.coefficients.weights[node];
        let Work { node: NodeWork { momentum, gradient, .. }, trial, .. } = &mut *self.work;
        let force: &[T] = if c == 0.0 {
            &self.phase.force
        } else if c == 1.0 {
            gradient
        } else {
            trial
        };
        let basis = self.coefficients.bases[node];
        for (p, &f) in momentum.iter_mut().zip(force) {
            *p += weight * share.of(basis) * f;
        }
    }

    /// q1, F(q1) and p1 without iteration, where no node lies between the ends.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn kick_drift_kick(&mut self) {
        self.work.node.momentum.copy_from_slice(&self.phase.p);
        self.kick_at(0.0);
        let Work { increment, node: NodeWork { momentum, velocity, .. }, .. } = &mut *self.work;
        self.mass.solve(momentum, velocity);
        for (delta, &v) in increment.iter_mut().zip(velocity.iter()) {
            *delta = self.step.h * v / self.coefficients.sums.mixed;
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
        let sums = self.coefficients.sums;
        for (v, &q) in velocity.iter_mut().zip(point) {
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
        self.gather(self.step.method.rule.nodes().len(), Share::Both);
        if !F::UNFITTED {
            let Work { next, node: NodeWork { momentum, velocity, .. }, .. } = &mut *self.work;
            let sums = self.coefficients.sums;
            for i in 0..self.q.len() {
                velocity[i] = sums.left * self.q[i] + sums.right * next[i];
            }
            self.mass.multiply_add(T::lift(1.0) / self.step.h, velocity, momentum);
        }
        Ok(())
    }
}

/// The iteration, and what judges it.
struct Judged<'a, 'b, S: NondegenerateLagrangian<T>, F, R, T: Real> {
    attempt: &'a mut Attempt<'b, S, F, R, T>,
    weights: &'a mut [T],
}

impl<S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, R: Rule, T: Real> Iteration<T>
    for Judged<'_, '_, S, F, R, T>
{
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn prepare(&mut self, due: &mut Due) {
        let Self { attempt, weights } = self;
        let (system, increment) = (attempt.step.system, &mut attempt.work.increment);
        attempt.is_placed &= !due.prepare(system, weights, attempt.q, increment);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn improve(&mut self, _due: &mut Due, _statistics: &mut Statistics) -> Result<T, StepFailure> {
        if self.attempt.step.method.reads_both_ends() {
            self.attempt.read_both_ends()?;
        }
        Ok(self.attempt.improve(self.weights))
    }
}

/// Sets `point` to b q0 + b̄ q1.
#[cfg_attr(not(debug_assertions), inline(always))]
fn place<T: Real>(Basis { b, b_bar, .. }: Basis<T>, [q, delta]: [&[T]; 2], point: &mut [T]) {
    for ((point, &q), &delta) in point.iter_mut().zip(q).zip(delta) {
        *point = (b + b_bar) * q + b_bar * delta;
    }
}
