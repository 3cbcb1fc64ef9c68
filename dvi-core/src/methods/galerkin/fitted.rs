//! Coefficients that are fitted to a frequency, and the fixed point of L = ½ v·M v − V(q, t) with them.
//!
//! rᵣ = h Σⱼ wⱼ φ̂ⱼᵣ F(qʲ) + M Σₖ Kᵣₖ xₖ/h      K = Σⱼ wⱼ ψ̂ⱼ ψⱼᵀ
//!
//! are the equations of [`Displaced`](super::displaced::Displaced) of such an L, in forces only. A fixed point
//! solves them, x ← x − h A⁻¹M⁻¹ r with A = Σⱼ wⱼ (ψ̂ⱼ ψⱼᵀ − u² φ̂ⱼ φⱼᵀ): A contains the oscillator of the
//! fitted frequency, so that only what differs from it is iterated. As b = 0 at the end and no displacement
//! reaches it, an iteration needs the forces of the interior nodes alone.

use super::coefficients::{Fit, weighted};
use crate::discrete::frequency::{FrequencyIn, Local};
use crate::discrete::{Interval, NodeWork};
use crate::error::StepFailure;
use crate::mechanics::mass::Mass;
use crate::mechanics::phase::PhasePoint;
use crate::scalar::norm;
use crate::solve::{Convergence, Stopping, iterate, sizes};
use crate::state::Statistics;
use crate::{NondegenerateLagrangian, Real, System, Vector};

/// Where a step begins, and the frequency.
pub(super) struct Fitted<'a, S: System, F, T: Real> {
    pub(super) system: &'a S,
    pub(super) frequency: &'a F,
    pub(super) interval: Interval<T>,
    pub(super) phase: &'a PhasePoint<S, T>,
    pub(super) mass: &'a Mass<S, T>,
    /// The frequencies at both ends.
    pub(super) ends: &'a mut [Local<S, T>; 2],
}

impl<S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, T: Real> Fitted<'_, S, F, T> {
    /// Makes `fit` that for the frequency at the `unknowns`; `node` is storage.
    ///
    /// # Errors
    /// Those of a frequency.
    pub(super) fn read<const NODES: usize>(
        &mut self,
        fit: &mut Fit<NODES, T>,
        unknowns: &[Vector<S, T>; NODES],
        node: &mut NodeWork<S, T>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { system, frequency, interval, phase, mass, ends } = self;
        if F::UNFITTED || frequency.reading().is_none() {
            return fit.to(frequency.fixed() * interval.h);
        }
        let NodeWork { point: end, velocity, gradient: force, .. } = node;
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

    /// Solves the equations by the fixed point over M, in up to `budget` iterations, and sets the first of
    /// `residuals` to p1 − p0 but for the kick at the end. What comes with them is storage.
    ///
    /// # Errors
    /// [`StepFailure::NotConverged`], [`StepFailure::NotFinite`], or those of a frequency that is read.
    pub(super) fn solve<const NODES: usize>(
        &mut self,
        fit: &mut Fit<NODES, T>,
        unknowns: &mut [Vector<S, T>; NODES],
        (residuals, weights, node): (&mut [Vector<S, T>; NODES], &mut [T], &mut NodeWork<S, T>),
        (stopping, budget): (Stopping, usize),
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        iterate(Convergence::fixed_point(stopping, budget), statistics, |due, statistics| {
            let (start, rest) = unknowns.split_at_mut(1);
            due.prepare_all(self.system, weights, &start[0], rest);
            self.differentiate(1, fit, unknowns, (residuals, node), statistics)?;
            residuals[1..].iter_mut().for_each(|residual| self.mass.solve_in_place(residual));
            let (mut largest, change) = (T::lift(0.0), &mut node.velocity);
            for (unknown, row) in unknowns.iter_mut().zip(&fit.coefficients.inverse).skip(1) {
                for i in 0..change.len() {
                    change[i] = self.interval.h * weighted(&row[1..], &residuals[1..], i, T::lift(0.0));
                }
                largest = norm::larger(largest, sizes::reduce(self.system, weights, unknown, change));
            }
            Ok(largest)
        })?;
        unknowns[1..].iter().try_for_each(|unknown| norm::finite(unknown))?;
        self.differentiate(0, fit, unknowns, (residuals, node), statistics)
    }

    /// Sets `residuals` from the `first`, by the forces at the nodes but for the last, and M Kx/h.
    fn differentiate<const NODES: usize>(
        &mut self,
        first: usize,
        fit: &mut Fit<NODES, T>,
        unknowns: &[Vector<S, T>; NODES],
        (residuals, node): (&mut [Vector<S, T>; NODES], &mut NodeWork<S, T>),
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.read(fit, unknowns, node, statistics)?;
        let Self { system, interval, phase, mass, .. } = self;
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
        Ok(())
    }
}
