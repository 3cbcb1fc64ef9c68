//! The equations of a step for the displacements and Δ, of any L.
//!
//! rᵣ = Σⱼ wⱼ (h φ̂ⱼᵣ ∂L/∂q + ψ̂ⱼᵣ ∂L/∂v), for Δ with p0 added
//! ∂rᵣ/∂xₖ = Σⱼ wⱼ (h φ̂ⱼᵣφⱼₖ L_qq + φ̂ⱼᵣψⱼₖ L_qv + ψ̂ⱼᵣφⱼₖ L_vq + ψ̂ⱼᵣψⱼₖ L_vv/h)
//!
//! Where the frequency is read from the motion, the residual is exact, and the matrix is that of ω held
//! constant, which is close enough for Newton's method to contract. For L = ½ v·M v − V(q, t) it is forces
//! only that are evaluated,
//!
//! rᵣ = h Σⱼ wⱼ φ̂ⱼᵣ F(qʲ) + M Σₖ Kᵣₖ xₖ/h      K = Σⱼ wⱼ ψ̂ⱼ ψⱼᵀ
//!
//! and a fixed point solves the same equations, x ← x − h A⁻¹M⁻¹ r with A = Σⱼ wⱼ (ψ̂ⱼ ψⱼᵀ − u² φ̂ⱼ φⱼᵀ): A
//! contains the oscillator of the fitted frequency, so that only what differs from it is iterated. As b = 0
//! at the end and no displacement reaches it, an iteration needs the forces of the interior nodes alone.

use super::coefficients::{Fit, weighted};
use crate::discrete::frequency::{FrequencyIn, Local};
use crate::discrete::{Interval, NodeWork};
use crate::error::StepFailure;
use crate::mechanics::mass::Mass;
use crate::mechanics::phase::PhasePoint;
use crate::scalar::norm;
use crate::solve::{Convergence, CoupledEquations, Stopping, iterate, sizes};
use crate::space::{NodeSum, Sink, scratch};
use crate::state::Statistics;
use crate::{Lagrangian, NondegenerateLagrangian, Real, System, Vector, Weights};

/// A step from the point `phase` has, whose coordinates are the first of the unknowns.
pub(super) struct Displaced<'a, const NODES: usize, S: System, F, T: Real> {
    pub(super) system: &'a S,
    pub(super) frequency: &'a F,
    pub(super) interval: Interval<T>,
    pub(super) phase: &'a PhasePoint<S, T>,
    pub(super) mass: &'a Mass<S, T>,
    pub(super) fit: &'a mut Fit<NODES, T>,
    /// The frequencies at both ends.
    pub(super) ends: &'a mut [Local<S, T>; 2],
    /// q0, the displacements of the interior nodes, and Δ.
    pub(super) unknowns: &'a mut [Vector<S, T>; NODES],
    /// Work space.
    pub(super) node: &'a mut NodeWork<S, T>,
    /// Where second derivatives are taken.
    pub(super) j: usize,
}

impl<const NODES: usize, S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, T: Real>
    Displaced<'_, NODES, S, F, T>
{
    /// Solves the equations by the fixed point over M, in up to `budget` iterations. What comes with
    /// `residuals` is storage.
    ///
    /// # Errors
    /// [`StepFailure::NotConverged`], [`StepFailure::NotFinite`], or those of a frequency that is read.
    pub(super) fn iterate(
        &mut self,
        (residuals, weights): (&mut [Vector<S, T>; NODES], &mut [T]),
        (stopping, budget): (Stopping, usize),
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        iterate(Convergence::fixed_point(stopping, budget), statistics, |due, statistics| {
            let (start, unknowns) = self.unknowns.split_at_mut(1);
            due.prepare_all(self.system, weights, &start[0], unknowns);
            self.differentiate(Self::FIRST, residuals, statistics)?;
            residuals[1..].iter_mut().for_each(|residual| self.mass.solve_in_place(residual));
            let (mut largest, inverse) = (T::lift(0.0), &self.fit.coefficients.inverse);
            let change = &mut self.node.velocity;
            for (unknown, row) in self.unknowns.iter_mut().zip(inverse).skip(1) {
                for i in 0..change.len() {
                    change[i] = self.interval.h * weighted(&row[1..], &residuals[1..], i, T::lift(0.0));
                }
                largest = norm::larger(largest, sizes::reduce(self.system, weights, unknown, change));
            }
            Ok(largest)
        })?;
        self.unknowns[1..].iter().try_for_each(|unknown| norm::finite(unknown))
    }

    /// The coefficients for the frequency at the current unknowns.
    fn read_frequency(&mut self, statistics: &mut Statistics) -> Result<(), StepFailure> {
        let Self { system, frequency, interval, phase, mass, fit, ends, unknowns, node, .. } = self;
        if F::UNFITTED || frequency.reading().is_none() {
            return fit.to(frequency.fixed() * interval.h);
        }
        let NodeWork { point: end, velocity, gradient: force, .. } = &mut **node;
        let (q, delta) = (&unknowns[0], &unknowns[NODES - 1]);
        for i in 0..q.len() {
            end[i] = q[i] + delta[i];
            velocity[i] = delta[i] / interval.h;
        }
        system.force(end, &[], interval.time(T::lift(1.0)), force);
        statistics.gradients += 1;
        let [first, last] = &mut **ends;
        first.evaluate(*frequency, mass, q, velocity, &phase.force)?;
        last.evaluate(*frequency, mass, end, velocity, force)?;
        let omega = T::lift(0.5) * (first.omega + last.omega);
        fit.to(omega * interval.h)
    }

    /// Sets `residuals` from the `first`, of which that of the ends is (D₁ + D₂)L_d; of a separable L, but
    /// for the force at the end.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn differentiate(
        &mut self,
        first: usize,
        residuals: &mut [Vector<S, T>; NODES],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.read_frequency(statistics)?;
        if S::SEPARABLE {
            self.set_forces(first, residuals, statistics);
            return Ok(());
        }
        let (step, x) = ((self.system, self.interval), &*self.unknowns);
        self.fit.differentiate(step, x, self.node, residuals, statistics);
        for (residual, &p) in residuals[NODES - 1].iter_mut().zip(self.phase.p.iter()) {
            *residual += p;
        }
        Ok(())
    }

    /// The same by the forces at the nodes but for the last, and M Kx/h.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn set_forces(
        &mut self,
        first: usize,
        residuals: &mut [Vector<S, T>; NODES],
        statistics: &mut Statistics,
    ) {
        let Self { system, interval, phase, mass, fit, unknowns, node, .. } = self;
        let (h, coefficients, last) = (interval.h, &fit.coefficients, NODES - 1);
        let begin = h * coefficients.weights[0];
        for i in 0..phase.p.len() {
            residuals[0][i] = begin * phase.force[i];
            residuals[last][i] = phase.p[i] + residuals[0][i];
        }
        for j in 1..last {
            coefficients.set_point(j, unknowns, &mut node.point);
            system.force(&node.point, &[], fit.time(*interval, j), &mut node.gradient);
            let ([both, _], [left, _]) = (coefficients.direction(j, 0), coefficients.direction(j, last));
            for i in 0..node.gradient.len() {
                let impulse = h * coefficients.weights[j] * node.gradient[i];
                residuals[j][i] = impulse;
                residuals[last][i] += left * impulse;
                residuals[0][i] += both * impulse;
            }
        }
        for (residual, row) in residuals.iter_mut().zip(&coefficients.kinetic).skip(first) {
            for i in 0..node.velocity.len() {
                node.velocity[i] = weighted(row, &unknowns[..], i, T::lift(0.0));
            }
            mass.multiply_add(T::lift(1.0) / h, &node.velocity, residual);
        }
        statistics.gradients += (NODES - 2) as u64;
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
        self.differentiate(Self::FIRST, residuals, statistics)
    }
}

impl<const NODES: usize, S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, T: Real> NodeSum<NODES, T>
    for Displaced<'_, NODES, S, F, T>
{
    const FIRST: usize = 1;

    fn place(&mut self, j: usize) {
        self.j = j;
        let NodeWork { point, velocity, .. } = &mut *self.node;
        self.fit.coefficients.place(j, self.interval.h, self.unknowns, [point, velocity]);
    }

    fn given(&self, i: usize) -> T {
        self.phase.p[i]
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

    fn second_derivatives(&mut self, qq: &mut impl Sink<T>, qv: &mut impl Sink<T>, vv: &mut impl Sink<T>) {
        second_derivatives((self.system, self.time()), self.node, qq, qv, vv);
    }
}

/// Adds the second derivatives of L where `node` is.
// Kept out of line, with scratch of its own, so that the compiler sees that what is written is not what is
// read, and evaluates once what the three have in common.
#[inline(never)]
pub(super) fn second_derivatives<S: Lagrangian<T>, T: Real>(
    (system, t): (&S, T),
    NodeWork { point, velocity, gradient, momentum }: &mut NodeWork<S, T>,
    qq: &mut impl Sink<T>,
    qv: &mut impl Sink<T>,
    vv: &mut impl Sink<T>,
) {
    let (zero, one) = (T::lift(0.0), T::lift(1.0));
    let none = Weights { qq: zero, qv: zero, vq: zero, vv: zero };
    scratch!(l_q = system, *gradient);
    scratch!(l_v = system, *momentum);
    system.linearize(point, velocity, t, Weights { qq: one, ..none }, l_q, l_v, qq);
    system.linearize(point, velocity, t, Weights { qv: one, ..none }, l_q, l_v, qv);
    system.linearize(point, velocity, t, Weights { vv: one, ..none }, l_q, l_v, vv);
}
