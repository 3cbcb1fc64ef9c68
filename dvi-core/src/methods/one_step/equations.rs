//! The equations of a step for Δ = x1 − x0 and ȳ, by Newton's method:
//!
//! r_x = Σⱼ wⱼ(ϑⱼ − h(1 − cⱼ) f_xⱼ) − p      r_y = −½h Σⱼ wⱼ f_yⱼ
//!
//! at the points (x0 + cⱼΔ, ȳ) with the velocity Δ/h along x. With R = 1 − cⱼ in rows of x and ½ in rows of
//! y, and C = cⱼ in columns of Δ and 1 in those of ȳ, the matrix is Σⱼ wⱼ(C L_vq − R L_qv − h R C L_qq). Of
//! the midpoint scheme, solved for (½Δ, ȳ), it is Dα − (Dα)ᵀ − ½h L_qq. Both stand in the code with the sign
//! of p.

use super::split::is_x;
use crate::error::StepFailure;
use crate::solve::{Linearize, residual};
use crate::space::Sink;
use crate::state::Statistics;
use crate::{ProperlyDegenerate, Real, System, Vector, Weights};

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rule {
    Midpoint,
    Trapezoid,
}

/// A step from x in `q` at `t`.
#[derive(Debug)]
pub(super) struct Step<'a, S: System, T: Real> {
    pub(super) system: &'a S,
    pub(super) q: &'a Vector<S, T>,
    pub(super) t: T,
    pub(super) h: T,
    pub(super) rule: Rule,
}

impl<S: ProperlyDegenerate<T>, T: Real> Step<'_, S, T> {
    /// The part of Δ that is solved for.
    pub(super) fn part(&self) -> T {
        T::lift(if self.rule == Rule::Midpoint { 0.5 } else { 1.0 })
    }

    /// Sets `point` and `velocity` to those after the part `c` of the step, and returns the time there.
    #[inline]
    pub(super) fn place(&self, unknown: &[T], c: T, point: &mut [T], velocity: &mut [T]) -> T {
        let (by, per_time) = (c / self.part(), T::lift(1.0) / (self.part() * self.h));
        for i in 0..unknown.len() {
            [point[i], velocity[i]] = if is_x(self.system, i) {
                [self.q[i] + by * unknown[i], per_time * unknown[i]]
            } else {
                [unknown[i], T::lift(0.0)]
            };
        }
        self.t + c * self.h
    }
}

pub(super) struct Equations<'a, S: System, T: Real> {
    pub(super) step: &'a Step<'a, S, T>,
    /// A point, a velocity, and the first derivatives of L there.
    pub(super) work: [&'a mut Vector<S, T>; 4],
}

impl<S: ProperlyDegenerate<T>, T: Real> Linearize<T> for Equations<'_, S, T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn linearize<K: Sink<T>>(
        &mut self,
        unknown: &[T],
        r: &mut [T],
        sink: &mut K,
        _statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { step, work: [point, velocity, gradient, one_form] } = self;
        let Step { system, h, rule, .. } = **step;
        let (zero, half, one) = (T::lift(0.0), T::lift(0.5), T::lift(1.0));
        if rule == Rule::Midpoint {
            let time = step.place(unknown, half, point, velocity);
            let weights = Weights { qq: half * h, qv: one, vq: -one, vv: zero };
            system.linearize(point, velocity, time, weights, gradient, one_form, sink);
            for i in 0..r.len() {
                r[i] -= one_form[i] - half * h * gradient[i];
            }
            return Ok(());
        }
        for c in [zero, one] {
            let time = step.place(unknown, c, point, velocity);
            let row = |row: usize| half * if is_x(system, row) { one - c } else { half };
            let column = |column: usize| if is_x(system, column) { c } else { one };
            let mut add = |w: Weights<T>, factor: &dyn Fn(usize, usize) -> T| {
                let mut scaled = |i: usize, j: usize, entry: T| sink.add(i, j, factor(i, j) * entry);
                system.linearize(point, velocity, time, w, gradient, one_form, &mut scaled);
            };
            // L_qv is in columns of x alone, and L_vq in rows of x. At either end of the step one of both
            // has the factors of L_qq, as those along x are 0 and 1 there.
            add(Weights { qq: h, qv: c, vq: c - one, vv: zero }, &|i, j| row(i) * column(j));
            let rest = |row: usize| half * if is_x(system, row) { one } else { half };
            add(Weights { qq: zero, qv: one - c, vq: -c, vv: zero }, &|i, _| rest(i));
            for i in 0..r.len() {
                r[i] -= half * one_form[i] - h * row(i) * gradient[i];
            }
        }
        Ok(())
    }

    fn residual(&mut self, at: [&[T]; 3], storage: [&mut [T]; 2]) -> Result<T, StepFailure> {
        // A copy: what another function sees has no place in registers.
        let Self { step, work: [point, velocity, gradient, one_form] } = self;
        residual(&mut Equations { step, work: [point, velocity, gradient, one_form] }, at, storage)
    }

    fn cost(&self) -> [u64; 2] {
        [if self.step.rule == Rule::Midpoint { 1 } else { 2 }, 1]
    }
}
