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

use super::coefficients::{Coefficients, weighted};
use crate::discrete::frequency::{FrequencyIn, Local};
use crate::discrete::{Interval, NodeWork, Rule};
use crate::error::StepFailure;
use crate::mechanics::mass::Mass;
use crate::mechanics::phase::PhasePoint;
use crate::methods::collocation::lobatto::Lobatto;
use crate::scalar::norm;
use crate::solve::{Convergence, CoupledEquations, Stopping, iterate, sizes};
use crate::space::{NodeSum, Sink, scratch};
use crate::state::Statistics;
use crate::{NondegenerateLagrangian, Real, System, Vector, Weights};

/// The coefficients for the frequency of a step.
#[derive(Debug)]
pub(super) struct Fit<const NODES: usize, S: System, T: Real> {
    rule: Lobatto<NODES>,
    differentiation: [[f64; NODES]; NODES],
    pub(super) coefficients: Coefficients<NODES, T>,
    /// The frequencies at both ends of the step.
    ends: [Local<S, T>; 2],
}

impl<const NODES: usize, S: NondegenerateLagrangian<T>, T: Real> Fit<NODES, S, T> {
    /// For steps of length `h`, as far as the frequency is known before them.
    ///
    /// # Errors
    /// Those of [`Coefficients::new`].
    pub(super) fn new<F: FrequencyIn<T>>(system: &S, frequency: &F, h: T) -> Result<Self, StepFailure> {
        let (rule, reading) = (Lobatto::new(), frequency.reading());
        let differentiation = rule.differentiation();
        let u = if reading.is_none() { frequency.fixed() * h } else { T::lift(0.0) };
        let coefficients = Coefficients::new(&rule, &differentiation, u)?;
        let ends = [Local::new(system, reading), Local::new(system, reading)];
        Ok(Self { rule, differentiation, coefficients, ends })
    }

    /// Makes the coefficients those for `u` = ωh, if they are not.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn to(&mut self, u: T) -> Result<(), StepFailure> {
        if !self.coefficients.is_for(u) {
            self.coefficients = Coefficients::new(&self.rule, &self.differentiation, u)?;
        }
        Ok(())
    }
}

/// A step from the point `phase` has, whose coordinates are the first of the unknowns.
pub(super) struct Displaced<'a, const NODES: usize, S: System, F, T: Real> {
    pub(super) system: &'a S,
    pub(super) frequency: &'a F,
    pub(super) interval: Interval<T>,
    pub(super) phase: &'a PhasePoint<S, T>,
    /// M, if it is constant.
    pub(super) mass: Option<&'a Mass<S, T>>,
    pub(super) fit: &'a mut Fit<NODES, S, T>,
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
    /// Solves the equations by the fixed point over M, in up to `budget` iterations. What comes with `residuals`
    /// is storage.
    ///
    /// # Errors
    /// [`StepFailure::NotConverged`], [`StepFailure::NotFinite`], or those of a frequency that is read.
    pub(super) fn iterate(
        &mut self,
        (residuals, weights): (&mut [Vector<S, T>; NODES], &mut [T]),
        (stopping, budget): (Stopping, usize),
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        // Of another L steps are Newton's.
        let (true, Some(mass)) = (S::SEPARABLE, self.mass) else { return Err(StepFailure::NO_MATRIX) };
        let convergence = Convergence::fixed_point(stopping, budget);
        iterate(convergence, statistics, |due, statistics| {
            let (start, unknowns) = self.unknowns.split_at_mut(1);
            due.prepare_all(self.system, weights, &start[0], unknowns);
            self.evaluate(residuals, statistics)?;
            for residual in &mut residuals[1..] {
                mass.displace(self.interval.h, residual, &mut self.node.velocity);
                residual.copy_from_slice(&self.node.velocity);
            }
            let (mut largest, inverse) = (T::lift(0.0), &self.fit.coefficients.inverse);
            let change = &mut self.node.velocity;
            for (unknown, row) in self.unknowns.iter_mut().zip(inverse).skip(1) {
                for i in 0..change.len() {
                    change[i] = weighted(&row[1..], &residuals[1..], i, T::lift(0.0));
                }
                largest = norm::larger(largest, sizes::reduce(self.system, weights, unknown, change));
            }
            Ok(largest)
        })?;
        self.unknowns[1..].iter().try_for_each(|unknown| norm::finite(unknown))
    }

    /// The coefficients for the frequency at the current unknowns.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn read_frequency(&mut self, statistics: &mut Statistics) -> Result<(), StepFailure> {
        let Self { system, frequency, interval, phase, mass, fit, unknowns, node, .. } = self;
        let (false, Some(mass), Some(_)) = (F::UNFITTED, mass, frequency.reading()) else {
            return fit.to(frequency.fixed() * interval.h);
        };
        let NodeWork { point: end, velocity, gradient: force, .. } = &mut **node;
        let (q, delta) = (&unknowns[0], &unknowns[NODES - 1]);
        for i in 0..q.len() {
            end[i] = q[i] + delta[i];
            velocity[i] = delta[i] / interval.h;
        }
        system.force(end, &[], interval.time(T::lift(1.0)), force);
        statistics.gradients += 1;
        let [first, last] = &mut fit.ends;
        first.evaluate(*frequency, mass, q, velocity, &phase.force)?;
        last.evaluate(*frequency, mass, end, velocity, force)?;
        let omega = T::lift(0.5) * (first.omega + last.omega);
        fit.to(omega * interval.h)
    }

    /// Adds the forces at the nodes but for the last, which is in none of the unknowns' equations, and M Kx/h.
    fn add_forces(
        &mut self,
        mass: &Mass<S, T>,
        residuals: &mut [Vector<S, T>; NODES],
        statistics: &mut Statistics,
    ) {
        let (per_h, Coefficients { kinetic, .. }) = (T::lift(1.0) / self.interval.h, &self.fit.coefficients);
        for (residual, row) in residuals.iter_mut().zip(kinetic) {
            let sum = &mut self.node.velocity;
            for i in 0..sum.len() {
                sum[i] = weighted(row, self.unknowns, i, T::lift(0.0));
            }
            mass.multiply_add(per_h, sum, residual);
        }
        for j in 0..NODES - 1 {
            if j > 0 {
                let NodeWork { point, gradient, .. } = &mut *self.node;
                self.fit.coefficients.set_point(j, self.unknowns, point);
                let t = self.interval.time(T::lift(self.fit.rule.nodes()[j]));
                self.system.force(point, &[], t, gradient);
                statistics.gradients += 1;
            }
            let force = if j > 0 { &self.node.gradient } else { &self.phase.force };
            let Coefficients { weights, .. } = &self.fit.coefficients;
            for (r, residual) in residuals.iter_mut().enumerate() {
                let [along, _] = self.fit.coefficients.direction(j, r);
                // A force moves the displacement of its own node only.
                if r == 0 || r == j || r == NODES - 1 {
                    let by = self.interval.h * weights[j] * along;
                    residual.iter_mut().zip(force.iter()).for_each(|(residual, &f)| *residual += by * f);
                }
            }
        }
    }

    fn time(&self) -> T {
        self.interval.time(T::lift(self.fit.rule.nodes()[self.j]))
    }
}

impl<const NODES: usize, S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, T: Real>
    CoupledEquations<NODES, S, T> for Displaced<'_, NODES, S, F, T>
{
    fn unknowns(&mut self) -> &mut [Vector<S, T>; NODES] {
        self.unknowns
    }

    /// The first of `residuals` is (D₁ + D₂)L_d; of a separable L, but for the force at the end.
    fn evaluate(
        &mut self,
        residuals: &mut [Vector<S, T>; NODES],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.read_frequency(statistics)?;
        residuals.iter_mut().for_each(|residual| residual.fill(T::lift(0.0)));
        if let (true, Some(mass)) = (S::SEPARABLE, self.mass) {
            self.add_forces(mass, residuals, statistics);
        } else {
            for j in 0..NODES {
                self.place(j);
                let (t, NodeWork { point, velocity, gradient, momentum }) = (self.time(), &mut *self.node);
                self.system.gradient(point, velocity, t, gradient, momentum);
                self.fit.coefficients.add(j, self.interval.h, [gradient, momentum], residuals);
            }
            statistics.gradients += NODES as u64;
        }
        for (residual, &p) in residuals[NODES - 1].iter_mut().zip(self.phase.p.iter()) {
            *residual += p;
        }
        Ok(())
    }
}

impl<const NODES: usize, S: NondegenerateLagrangian<T>, F: FrequencyIn<T>, T: Real> NodeSum<NODES, T>
    for Displaced<'_, NODES, S, F, T>
{
    const FIRST: usize = 1;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place(&mut self, j: usize) {
        self.j = j;
        let NodeWork { point, velocity, .. } = &mut *self.node;
        self.fit.coefficients.place(j, self.interval.h, self.unknowns, [point, velocity]);
    }

    fn given(&self, i: usize) -> T {
        self.phase.p[i]
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn weights(&self, r: usize, k: usize) -> Weights<T> {
        self.fit.coefficients.second(self.j, self.interval.h, r, k)
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
        let (zero, one) = (T::lift(0.0), T::lift(1.0));
        let none = Weights { qq: zero, qv: zero, vq: zero, vv: zero };
        let (system, t) = (self.system, self.time());
        let NodeWork { point, velocity, gradient, momentum } = &mut *self.node;
        scratch!(l_q = system, *gradient);
        scratch!(l_v = system, *momentum);
        system.linearize(point, velocity, t, Weights { qq: one, ..none }, l_q, l_v, qq);
        system.linearize(point, velocity, t, Weights { qv: one, ..none }, l_q, l_v, qv);
        system.linearize(point, velocity, t, Weights { vv: one, ..none }, l_q, l_v, vv);
    }
}
