//! σ = 0 with affine α: explicit, one ∇H a step.
//!
//! q1 = (q0 + K⁻¹c0) + s   with K = −(Dα)ᵀ, s = −hK⁻¹∇H(q0),   and c1 = −DαΔ,  Δ = q1 − q0.
//!
//! Only s has to wait for the gradient: the point ahead, q0 + K⁻¹c0, was left by the step before. In a
//! symmetric gauge, ½(x dy − y dx), it is the point before: q2 = q0 + 2s, the leapfrog scheme as it is
//! usually written (Rowley & Marsden 2002, eq. 13). Over many steps the points are local arrays, which the
//! compiler can keep in registers, and c, which no step needs, is computed at the end.

use super::memory::{Ahead, SigmaMemory, Work};
use super::monitor::Monitor;
use crate::discrete::NodeWork;
use crate::error::StepFailure;
use crate::mechanics::combination::{Inverse, Product};
use crate::methods::Clock;
use crate::methods::walk::{Walk, walk};
use crate::scalar::norm;
use crate::space::scratch;
use crate::{DegenerateLagrangian, Real, System, Vector};

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn add<T: Real>(q: &[T], increment: &[T], sum: &mut [T]) {
    for ((sum, &q), &delta) in sum.iter_mut().zip(q).zip(increment) {
        *sum = q + delta;
    }
}

/// Takes `count` steps, or as many as succeed, and returns how many; `q` and `memory` are then at the last
/// good point.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn steps<S: DegenerateLagrangian<T>, T: Real>(
    system: &S,
    memory: &mut SigmaMemory<S, T>,
    q: &mut Vector<S, T>,
    clock: Clock<T>,
    count: u64,
) -> (u64, Result<(), StepFailure>) {
    let SigmaMemory { defect, inverse, product, ahead, scale, l_d, work, monitor, .. } = memory;
    // A run with σ = 0 and affine α has both.
    let (Some(product), Some(ahead)) = (product, ahead) else {
        return (0, Err(StepFailure::NO_MATRIX));
    };
    let from = monitor.steps;
    let node = &mut l_d.work;
    let run = Run { system, inverse, product, node, work, monitor: &mut *monitor, defect, q, clock, count };
    let (taken, result) = match ahead {
        Ahead::Reversal => run.steps(|q0, _, ahead| ahead.copy_from_slice(q0)),
        Ahead::Diagonal(factors) => run.steps(|q0, q1, ahead| {
            for i in 0..q0.len() {
                ahead[i] = q1[i] + factors[i] * (q1[i] - q0[i]);
            }
        }),
        Ahead::General([delta, c]) => run.steps(|q0, q1, ahead| {
            for i in 0..q0.len() {
                delta[i] = q1[i] - q0[i];
            }
            product.apply(system, delta, c);
            c.iter_mut().for_each(|c| *c *= *scale);
            inverse.solve(system, c, ahead);
            for i in 0..q0.len() {
                ahead[i] += q1[i];
            }
        }),
    };
    monitor.steps = from + taken;
    (taken, result)
}

/// What the steps work on.
struct Run<'a, S: System, T: Real> {
    system: &'a S,
    inverse: &'a Inverse<S, T>,
    product: &'a Product<S, T>,
    node: &'a mut NodeWork<S, T>,
    work: &'a mut Work<S, T>,
    monitor: &'a mut Monitor<S, T>,
    defect: &'a mut Vector<S, T>,
    q: &'a mut Vector<S, T>,
    clock: Clock<T>,
    count: u64,
}

impl<S: DegenerateLagrangian<T>, T: Real> Run<'_, S, T> {
    /// With the rule that sets the point ahead, its last argument, from q0 and q1.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn steps(self, look_ahead: impl FnMut(&[T], &[T], &mut [T])) -> (u64, Result<(), StepFailure>) {
        let Self { system, inverse, product, node, work, monitor, defect, q, clock, count } = self;
        scratch!(q0 = system, node.point);
        scratch!(q1 = system, work.next);
        scratch!(q2 = system, work.trial);
        scratch!(ahead = system, node.velocity);
        scratch!(gradient = system, node.gradient);
        scratch!(s = system, work.increment);
        let (kept_ahead, spare) = (&mut work.ahead, &mut node.momentum);
        q1.copy_from_slice(q);
        ahead.copy_from_slice(kept_ahead);
        let points = Points { q0, q1, q2, ahead, gradient, s };
        let before = monitor.steps;
        let leapfrog = Leapfrog {
            system,
            inverse,
            product,
            monitor,
            clock,
            look_ahead,
            points,
            q,
            kept_ahead,
            defect,
            spare,
        };
        walk(leapfrog, before, count)
    }
}

/// Arrays that hold the last points.
struct Points<'a, T> {
    q0: &'a mut [T],
    q1: &'a mut [T],
    q2: &'a mut [T],
    ahead: &'a mut [T],
    gradient: &'a mut [T],
    s: &'a mut [T],
}

/// The last points, and where they are kept.
struct Leapfrog<'a, S: System, T: Real, L> {
    system: &'a S,
    inverse: &'a Inverse<S, T>,
    product: &'a Product<S, T>,
    monitor: &'a mut Monitor<S, T>,
    clock: Clock<T>,
    look_ahead: L,
    points: Points<'a, T>,
    q: &'a mut Vector<S, T>,
    kept_ahead: &'a mut Vector<S, T>,
    defect: &'a mut Vector<S, T>,
    spare: &'a mut Vector<S, T>,
}

impl<S: DegenerateLagrangian<T>, T: Real, L: FnMut(&[T], &[T], &mut [T])> Walk for Leapfrog<'_, S, T, L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn step(&mut self, number: u64) {
        let Points { q0, q1, q2, ahead, gradient, s } = &mut self.points;
        self.system.hamiltonian_gradient(q1, self.clock.after(number).time(), gradient);
        self.inverse.solve(self.system, gradient, s);
        add(ahead, s, q2);
        q0.copy_from_slice(q1);
        q1.copy_from_slice(q2);
        (self.look_ahead)(q0, q1, ahead);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn block(&self) -> u64 {
        self.monitor.period()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn watch(&mut self, number: u64) {
        self.monitor.note(self.monitor.steps + number, self.points.q1);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn admit(&mut self, number: u64) -> Result<(), StepFailure> {
        self.monitor.examine(self.monitor.steps + number, self.q)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn examine(&mut self, steps: u64) -> Result<(), StepFailure> {
        // Copies: what is examined must live in memory.
        scratch!(examined = self.system, *self.spare);
        examined.copy_from_slice(self.points.q1);
        norm::finite(examined)?;
        if steps == 1 {
            return Ok(());
        }
        examined.copy_from_slice(self.points.q0);
        norm::finite(examined)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn keep(&mut self) {
        let Points { q0, q1, ahead, s, .. } = &mut self.points;
        self.q.copy_from_slice(q1);
        self.kept_ahead.copy_from_slice(ahead);
        for (s, (&q1, &q0)) in s.iter_mut().zip(q1.iter().zip(q0.iter())) {
            *s = q1 - q0;
        }
        self.product.apply(self.system, s, self.defect);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn go_back(&mut self) {
        self.points.q1.copy_from_slice(self.q);
        self.points.ahead.copy_from_slice(self.kept_ahead);
    }
}
