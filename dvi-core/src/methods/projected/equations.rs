//! The equations of a step from `q` at `t`, with q̃ = (q̃0 + q̃1)/2:
//!
//! r₁ = α(q0) + Dα(q0)ᵀλ − α(q̃) + ½h ∂L/∂q(q̃, Δ/h)      r₂ = α(q̃) + ½h ∂L/∂q(q̃, Δ/h) − α(q1) − Dα(q1)ᵀλ

use crate::error::StepFailure;
use crate::scalar::passes::subtract;
use crate::solve::CoupledEquations;
use crate::space::{NodeSum, Sink};
use crate::state::Statistics;
use crate::{DegenerateLagrangian, Real, System, Vector, Weights};

/// The points q0, q̃ and q1, at which second derivatives are taken. The equations are as many as
/// unknown vectors, one less.
pub(super) const NODES: usize = 3;

#[derive(Debug)]
pub(super) struct Work<S: System, T: Real> {
    /// q̃, Δ/h and q1.
    pub(super) middle: Vector<S, T>,
    pub(super) velocity: Vector<S, T>,
    pub(super) end: Vector<S, T>,
    pub(super) gradient: Vector<S, T>,
    pub(super) one_form: Vector<S, T>,
    /// λ/h.
    pub(super) slope: Vector<S, T>,
    pub(super) rest: Vector<S, T>,
}

/// A step, and where its equations are evaluated.
pub(super) struct Step<'a, S: System, T: Real> {
    pub(super) system: &'a S,
    pub(super) q: &'a [T],
    /// α(q0)
    pub(super) p: &'a [T],
    pub(super) t: T,
    pub(super) h: T,
    pub(super) unknowns: &'a mut [Vector<S, T>; NODES],
    pub(super) work: &'a mut Work<S, T>,
    /// Where second derivatives are taken.
    pub(super) node: usize,
}

impl<S: DegenerateLagrangian<T>, T: Real> Step<'_, S, T> {
    /// Sets the points and velocities.
    pub(super) fn place(&mut self) {
        let Self { q, h, unknowns: [_, delta, lambda], work, .. } = self;
        for i in 0..q.len() {
            work.middle[i] = q[i] + T::lift(0.5) * delta[i] + lambda[i];
            work.velocity[i] = delta[i] / *h;
            work.end[i] = q[i] + delta[i];
            work.slope[i] = lambda[i] / *h;
        }
    }

    /// The time in the middle and at the end.
    pub(super) fn times(&self) -> [T; 2] {
        [self.t + T::lift(0.5) * self.h, self.t + self.h]
    }
}

impl<S: DegenerateLagrangian<T>, T: Real> CoupledEquations<NODES, S, T> for Step<'_, S, T> {
    fn unknowns(&mut self) -> &mut [Vector<S, T>; NODES] {
        self.unknowns
    }

    fn evaluate(
        &mut self,
        [_, r1, r2]: &mut [Vector<S, T>; NODES],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.place();
        let [centre, after] = self.times();
        let Self { system, q, p, t, h, unknowns: [_, _, lambda], work, .. } = self;
        let Work { middle, velocity, end, gradient, one_form, .. } = &mut **work;
        let (zero, one, half) = (T::lift(0.0), T::lift(1.0), T::lift(0.5) * *h);
        system.gradient(middle, velocity, centre, gradient, one_form);
        for i in 0..q.len() {
            r1[i] = p[i] - one_form[i] + half * gradient[i];
            r2[i] = one_form[i] + half * gradient[i];
        }
        for (row, factor, point, time) in [(&mut *r1, one, *q, *t), (&mut *r2, -one, &**end, after)] {
            // Dα(q)ᵀλ
            let mut product = |i: usize, j: usize, entry: T| row[i] += entry * lambda[j];
            system.one_form_jacobian(point, time, zero, factor, &mut product);
        }
        system.one_form(end, after, one_form);
        subtract(r2, one_form);
        statistics.gradients += 1;
        Ok(())
    }
}

/// The derivatives of r₁ and r₂ by Δ and λ. L_qq of node 2, at q1, stands for the second derivative of α·λ.
impl<S: DegenerateLagrangian<T>, T: Real> NodeSum<NODES, T> for Step<'_, S, T> {
    const FIRST: usize = 1;

    fn place(&mut self, j: usize) {
        self.node = j;
    }

    fn given(&self, i: usize) -> T {
        self.p[i]
    }

    fn weights(&self, r: usize, k: usize) -> Weights<T> {
        let (zero, one, half) = (T::lift(0.0), T::lift(1.0), T::lift(0.5));
        let none = Weights::none();
        match (self.node, r, k) {
            (0, 1, 2) => Weights { qv: one, ..none },
            (1, r, k) => {
                // What the unknown does to q̃ and to Δ; α(q̃) stands in r₁ and r₂ with opposite signs.
                let [point, motion] = if k == 1 { [half, one] } else { [one, zero] };
                let sign = if r == 1 { -one } else { one };
                Weights { qq: half * self.h * point, qv: half * motion, vq: sign * point, vv: zero }
            }
            (2, 2, 1) => Weights { qq: -one, vq: -one, ..none },
            (2, 2, 2) => Weights { qv: -one, ..none },
            _ => none,
        }
    }

    fn second_derivatives(&mut self, qq: &mut impl Sink<T>, qv: &mut impl Sink<T>, _vv: &mut impl Sink<T>) {
        let [centre, after] = self.times();
        let Self { system, q, t, h, work, .. } = self;
        let Work { middle, velocity, end, gradient, one_form, slope, rest } = &mut **work;
        let (none, one) = (Weights::none(), T::lift(1.0));
        let (point, time): (&[T], T) = [(*q, *t), (&**middle, centre), (&**end, after)][self.node];
        system.linearize(point, rest, time, Weights { qv: one, ..none }, gradient, one_form, qv);
        match self.node {
            1 => {
                system.linearize(point, velocity, time, Weights { qq: one, ..none }, gradient, one_form, qq);
            }
            2 => {
                // h L_qq at (q, λ/h) without that at (q, 0), which is of H.
                let w = Weights { qq: *h, ..none };
                system.linearize(point, slope, time, w, gradient, one_form, qq);
                let w = Weights { qq: -*h, ..none };
                system.linearize(point, rest, time, w, gradient, one_form, qq);
            }
            _ => {}
        }
    }
}
