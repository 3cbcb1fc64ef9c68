//! The equations of a path for its displacements and Δ, of any L.
//!
//! rᵣ = Σⱼ wⱼ (h φ̂ⱼᵣ ∂L/∂q + ψ̂ⱼᵣ ∂L/∂v), for Δ with p0 added
//! ∂rᵣ/∂xₖ = Σⱼ wⱼ (h φ̂ⱼᵣφⱼₖ L_qq + φ̂ⱼᵣψⱼₖ L_qv + ψ̂ⱼᵣφⱼₖ L_vq + ψ̂ⱼᵣψⱼₖ L_vv/h)
//!
//! Where the frequency is read from the motion, the residual is exact, and the matrix is that of ω held
//! constant, which is close enough for Newton's method to contract.

use super::coefficients::Fit;
use super::fitted::Fitted;
use crate::discrete::frequency::FrequencyIn;
use crate::discrete::{Interval, NodeWork};
use crate::error::StepFailure;
use crate::solve::CoupledEquations;
use crate::space::{NodeSum, Sink, scratch};
use crate::state::Statistics;
use crate::{Lagrangian, NondegenerateLagrangian, Real, System, Vector, Weights};

/// A path from the first of the unknowns.
pub(super) struct Displaced<'a, const NODES: usize, S: System, F, T: Real> {
    pub(super) system: &'a S,
    pub(super) interval: Interval<T>,
    pub(super) p0: &'a [T],
    /// What the coefficients are fitted by, unless they are given.
    pub(super) fitted: Option<Fitted<'a, S, F, T>>,
    pub(super) fit: &'a mut Fit<NODES, T>,
    /// q0, the displacements of the interior nodes, and Δ.
    pub(super) unknowns: &'a mut [Vector<S, T>; NODES],
    /// Work space.
    pub(super) node: &'a mut NodeWork<S, T>,
    /// Where second derivatives are taken.
    pub(super) j: usize,
}

impl<const NODES: usize, S: Lagrangian<T>, F, T: Real> Displaced<'_, NODES, S, F, T> {
    /// Sets `residuals`, of which that of the ends is (D₁ + D₂)L_d.
    pub(super) fn differentiate(
        &mut self,
        residuals: &mut [Vector<S, T>; NODES],
        statistics: &mut Statistics,
    ) {
        let Self { system, interval, p0, fit, unknowns, node, .. } = self;
        let NodeWork { point, velocity, gradient, momentum } = &mut **node;
        residuals.iter_mut().for_each(|residual| residual.fill(T::lift(0.0)));
        residuals[NODES - 1].copy_from_slice(p0);
        for j in 0..NODES {
            fit.coefficients.place(j, interval.h, unknowns, [point, velocity]);
            system.gradient(point, velocity, fit.time(*interval, j), gradient, momentum);
            for (r, residual) in residuals.iter_mut().enumerate() {
                let [by_point, by_velocity] = fit.coefficients.weighted_direction(j, r);
                for i in 0..residual.len() {
                    residual[i] += interval.h * by_point * gradient[i] + by_velocity * momentum[i];
                }
            }
        }
        statistics.gradients += NODES as u64;
    }

    fn time(&self) -> T {
        self.fit.time(self.interval, self.j)
    }
}

impl<const NODES: usize, S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, T: Real>
    CoupledEquations<NODES, S, T> for Displaced<'_, NODES, S, F, T>
{
    fn unknowns(&mut self) -> &mut [Vector<S, T>; NODES] {
        self.unknowns
    }

    fn evaluate(
        &mut self,
        residuals: &mut [Vector<S, T>; NODES],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        if let Some(fitted) = &mut self.fitted {
            fitted.read(self.fit, self.unknowns, self.node, statistics)?;
        }
        self.differentiate(residuals, statistics);
        Ok(())
    }
}

impl<const NODES: usize, S: Lagrangian<T>, F, T: Real> NodeSum<NODES, T> for Displaced<'_, NODES, S, F, T> {
    const FIRST: usize = 1;

    fn place(&mut self, j: usize) {
        self.j = j;
        let NodeWork { point, velocity, .. } = &mut *self.node;
        self.fit.coefficients.place(j, self.interval.h, self.unknowns, [point, velocity]);
    }

    fn given(&self, i: usize) -> T {
        self.p0[i]
    }

    fn weights(&self, r: usize, k: usize) -> Weights<T> {
        let (h, coefficients) = (self.interval.h, &self.fit.coefficients);
        let [by_point, by_velocity] = coefficients.weighted_direction(self.j, r);
        let [phi, psi] = coefficients.slopes(self.j, k);
        let vv = by_velocity * psi / h;
        Weights { qq: h * by_point * phi, qv: by_point * psi, vq: by_velocity * phi, vv }
    }

    const MIXED_ARE_TRANSPOSED: bool = !S::FORCED;

    fn momentum_by_position(&mut self, vq: &mut impl Sink<T>) {
        let (zero, one) = (T::lift(0.0), T::lift(1.0));
        let (t, NodeWork { point, velocity, gradient, momentum }) = (self.time(), &mut *self.node);
        let w = Weights { qq: zero, qv: zero, vq: one, vv: zero };
        self.system.linearize(point, velocity, t, w, gradient, momentum, vq);
    }

    // Kept out of line, with scratch of its own, so that the compiler sees that what is written is not what
    // is read, and evaluates once what the three have in common.
    #[inline(never)]
    fn second_derivatives(&mut self, qq: &mut impl Sink<T>, qv: &mut impl Sink<T>, vv: &mut impl Sink<T>) {
        let (system, t, zero, one) = (self.system, self.time(), T::lift(0.0), T::lift(1.0));
        let NodeWork { point, velocity, gradient, momentum } = &mut *self.node;
        let none = Weights { qq: zero, qv: zero, vq: zero, vv: zero };
        scratch!(l_q = system, *gradient);
        scratch!(l_v = system, *momentum);
        system.linearize(point, velocity, t, Weights { qq: one, ..none }, l_q, l_v, qq);
        system.linearize(point, velocity, t, Weights { qv: one, ..none }, l_q, l_v, qv);
        system.linearize(point, velocity, t, Weights { vv: one, ..none }, l_q, l_v, vv);
    }
}
