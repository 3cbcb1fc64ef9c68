//! The equations of a path for its displacements and Δ, of any L.
//!
//! rᵣ = Σⱼ wⱼ (h φ̂ⱼᵣ ∂L/∂q + ψ̂ⱼᵣ ∂L/∂v), for Δ with p0 added
//! ∂rᵣ/∂xₖ = Σⱼ wⱼ (h φ̂ⱼᵣφⱼₖ L_qq + φ̂ⱼᵣψⱼₖ L_qv + ψ̂ⱼᵣφⱼₖ L_vq + ψ̂ⱼᵣψⱼₖ L_vv/h)
//!
//! Where the frequency is read from the motion, the residual is exact, and the matrix is that of ω held
//! constant, which is close enough for Newton's method to contract.
//!
//! Of L = ½ v·M v − V(q, t) only forces are evaluated, beside M Σₖ Kᵣₖ xₖ/h with K = Σⱼ wⱼ ψ̂ⱼ ψⱼᵀ, and a
//! fixed point solves the same equations, x ← x − h A⁻¹M⁻¹ r with A = K − u² Σⱼ wⱼ φ̂ⱼ φⱼᵀ: A contains the
//! oscillator of the fitted frequency, so that only what differs from it is iterated. As b = 0 at the end
//! and no displacement reaches it, an iteration needs the forces of the interior nodes alone.

use super::coefficients::{Fit, weighted};
use crate::discrete::frequency::{Frequency, Local};
use crate::discrete::{Interval, NodeWork};
use crate::error::StepFailure;
use crate::methods::step::Begin;
use crate::scalar::norm;
use crate::solve::{CoupledEquations, Stopping, sizes, solve_by_fixed_point};
use crate::space::{NodeSum, Sink, scratch};
use crate::state::Statistics;
use crate::{NondegenerateLagrangian, Real, Scalar, System, Vector, Weights};

/// The path of a step from the first of the unknowns.
pub(super) struct Displaced<'a, const NODES: usize, S: System, F, T: Real> {
    pub(super) at: Begin<'a, S, T>,
    pub(super) frequency: &'a F,
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

impl<const NODES: usize, S: NondegenerateLagrangian<T>, F: Frequency, T: Real>
    Displaced<'_, NODES, S, F, T>
{
    /// Makes the coefficients those for the frequency at the unknowns.
    ///
    /// # Errors
    /// Those of a frequency.
    fn read_frequency(&mut self, statistics: &mut Statistics) -> Result<(), StepFailure> {
        let Self {
            at: Begin { system, interval, q, phase, mass },
            frequency,
            fit,
            ends,
            unknowns,
            node,
            ..
        } = self;
        if F::UNFITTED || frequency.reading().is_none() {
            return fit.to(frequency.fixed::<T>() * interval.h);
        }
        let NodeWork { point: end, velocity, gradient: force, .. } = &mut **node;
        let delta = &unknowns[NODES - 1];
        for i in 0..q.len() {
            end[i] = q[i] + delta[i];
            velocity[i] = delta[i] / interval.h;
        }
        system.force(end, &[], interval.time(T::lift(1.0)), force);
        statistics.gradients += 1;
        let [first, last] = &mut **ends;
        first.evaluate(*frequency, mass, q, velocity, &phase.force);
        last.evaluate(*frequency, mass, end, velocity, force);
        let omega = T::lift(0.5) * (first.omega + last.omega);
        fit.to(omega * interval.h)
    }

    /// Solves the equations of a separable L by the fixed point over its mass matrix M, in up to `budget`
    /// iterations. What comes with `residuals` is storage.
    ///
    /// # Errors
    /// [`StepFailure::NotConverged`], [`StepFailure::NotFinite`], or those of a frequency that is read.
    pub(super) fn iterate(
        &mut self,
        (residuals, [delta, change, weights]): (&mut [Vector<S, T>; NODES], [&mut [T]; 3]),
        limits: (Stopping, usize),
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Begin { system, interval: Interval { h, .. }, q, mass, .. } = self.at;
        let last = NODES - 1;
        delta.copy_from_slice(&self.unknowns[last]);
        solve_by_fixed_point(
            (system, q),
            [&mut *delta, change, weights],
            Some(limits),
            statistics,
            |[delta, change], weights, statistics| {
                self.unknowns[last].copy_from_slice(delta);
                self.evaluate(residuals, statistics)?;
                residuals[1..].iter_mut().for_each(|residual| mass.solve_in_place(residual));
                change.fill(T::lift(0.0));
                for (unknown, row) in self.unknowns.iter_mut().zip(&self.fit.inverse).skip(1) {
                    for i in 0..change.len() {
                        let correction = h * weighted(&row[1..], &residuals[1..], i);
                        unknown[i] -= correction;
                        change[i] = norm::larger(change[i], Scalar::abs(correction));
                    }
                }
                delta.copy_from_slice(&self.unknowns[last]);
                Ok(sizes::size_of(system, weights, change))
            },
        )?;
        self.evaluate(residuals, statistics)
    }

    fn time(&self) -> T {
        self.fit.time(self.at.interval, self.j)
    }
}

impl<const NODES: usize, S: NondegenerateLagrangian<T>, F: Frequency, T: Real> CoupledEquations<NODES, S, T>
    for Displaced<'_, NODES, S, F, T>
{
    fn unknowns(&mut self) -> &mut [Vector<S, T>; NODES] {
        self.unknowns
    }

    // Of the ends it is (D₁ + D₂)L_d; in a step of a separable L from the forces, but for that at the end.
    fn evaluate(
        &mut self,
        residuals: &mut [Vector<S, T>; NODES],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.read_frequency(statistics)?;
        let Self { at: Begin { system, interval, phase, mass, .. }, fit, unknowns, node, .. } = self;
        let NodeWork { point, velocity, gradient, momentum } = &mut **node;
        let (h, last) = (interval.h, NODES - 1);
        if S::SEPARABLE {
            scratch!(point = *system, *point);
            scratch!(force = *system, *gradient);
            scratch!(velocity = *system, *velocity);
            for i in 0..force.len() {
                residuals[0][i] = h * fit.weights[0] * phase.force[i];
                residuals[last][i] = phase.p[i] + residuals[0][i];
            }
            for j in 1..last {
                fit.set_point(j, unknowns, point);
                system.force(point, &[], fit.time(*interval, j), force);
                for i in 0..force.len() {
                    let impulse = h * fit.weights[j] * force[i];
                    residuals[0][i] += fit.point[j][0] * impulse;
                    residuals[last][i] += fit.left[j][0] * impulse;
                    residuals[j][i] = impulse;
                }
            }
            statistics.gradients += (NODES - 2) as u64;
            for (residual, row) in residuals.iter_mut().zip(&fit.kinetic) {
                for i in 0..velocity.len() {
                    velocity[i] = weighted(row, &unknowns[..], i);
                }
                mass.multiply_add(T::lift(1.0) / h, velocity, residual);
            }
            return Ok(());
        }
        residuals.iter_mut().for_each(|residual| residual.fill(T::lift(0.0)));
        residuals[last].copy_from_slice(&phase.p);
        for j in 0..NODES {
            fit.place(j, h, unknowns, [point, velocity]);
            system.gradient(point, velocity, fit.time(*interval, j), gradient, momentum);
            for (r, residual) in residuals.iter_mut().enumerate() {
                let [by_point, by_velocity] = fit.weighted_direction(j, r);
                for i in 0..residual.len() {
                    residual[i] += h * by_point * gradient[i] + by_velocity * momentum[i];
                }
            }
        }
        statistics.gradients += NODES as u64;
        Ok(())
    }
}

impl<const NODES: usize, S: NondegenerateLagrangian<T>, F: Frequency, T: Real> NodeSum<NODES, T>
    for Displaced<'_, NODES, S, F, T>
{
    const FIRST: usize = 1;

    fn place(&mut self, j: usize) {
        self.j = j;
        let NodeWork { point, velocity, .. } = &mut *self.node;
        self.fit.place(j, self.at.interval.h, self.unknowns, [point, velocity]);
    }

    fn given(&self, i: usize) -> T {
        self.at.phase.p[i]
    }

    fn weights(&self, r: usize, k: usize) -> Weights<T> {
        let (h, fit) = (self.at.interval.h, &*self.fit);
        let [by_point, by_velocity] = fit.weighted_direction(self.j, r);
        let [phi, psi] = fit.slopes(self.j, k);
        let vv = by_velocity * psi / h;
        Weights { qq: h * by_point * phi, qv: by_point * psi, vq: by_velocity * phi, vv }
    }

    const MIXED_ARE_TRANSPOSED: bool = !S::FORCED;

    fn momentum_by_position(&mut self, vq: &mut impl Sink<T>) {
        let (t, NodeWork { point, velocity, gradient, momentum }) = (self.time(), &mut *self.node);
        let w = Weights { vq: T::lift(1.0), ..Weights::none() };
        self.at.system.linearize(point, velocity, t, w, gradient, momentum, vq);
    }

    // Kept out of line, with scratch of its own, so that the compiler sees that what is written is not what
    // is read, and evaluates once what the three have in common.
    #[inline(never)]
    fn second_derivatives(&mut self, qq: &mut impl Sink<T>, qv: &mut impl Sink<T>, vv: &mut impl Sink<T>) {
        let (system, t, one) = (self.at.system, self.time(), T::lift(1.0));
        let NodeWork { point, velocity, gradient, momentum } = &mut *self.node;
        let none = Weights::none();
        scratch!(l_q = system, *gradient);
        scratch!(l_v = system, *momentum);
        system.linearize(point, velocity, t, Weights { qq: one, ..none }, l_q, l_v, qq);
        system.linearize(point, velocity, t, Weights { qv: one, ..none }, l_q, l_v, qv);
        system.linearize(point, velocity, t, Weights { vv: one, ..none }, l_q, l_v, vv);
    }
}
