//! The discrete Lagrangian of a rule and an interpolation, for any L and any frequency.
//!
//! D₁L_d = Σ w (h b ∂L/∂q + B ∂L/∂v)      D₂L_d = Σ w (h b̄ ∂L/∂q + B̄ ∂L/∂v)
//! D₁D₂L_d = Σ w (h b b̄ L_qq + b B̄ L_qv + B b̄ L_vq + B B̄ L_vv/h)
//!
//! With a variational frequency, L_d = ℓ(q0, q1, ω(q0, q1)) and D₁L_d = ∂ℓ/∂q0 + ∂ℓ/∂ω ∂ω/∂q0: the first derivatives are
//! exact, and D₁D₂L_d is that of ω held constant.

use super::coefficients::Adjustable;
use super::{Step, Variational};
use crate::basis::Basis;
use crate::discrete::{DiscreteLagrangian, Ends, Interval, NodeWork};
use crate::error::StepFailure;
use crate::frequency::{FrequencyIn, Local, Reading};
use crate::mass::Mass;
use crate::quadrature::Rule;
use crate::statistics::Statistics;
use crate::{Real, RegularLagrangian, Vector, Weights};

/// Rule and interpolation, where the step begins, and storage.
pub(super) struct Interpolated<'a, S: RegularLagrangian, F, R, C, T: Real> {
    pub(super) method: &'a Variational<F, R>,
    pub(super) coefficients: &'a mut C,
    /// The frequencies at both ends.
    pub(super) ends: &'a mut [Local<S, T>; 2],
    /// If L is separable, as it is wherever a frequency is read.
    pub(super) mass: Option<&'a Mass<S, T>>,
    pub(super) p: &'a [T],
    pub(super) force: &'a [T],
    pub(super) node: &'a mut NodeWork<S, T>,
    pub(super) next: &'a mut Vector<S, T>,
}

impl<S: RegularLagrangian, F: FrequencyIn<T>, R: Rule, C: Adjustable<S, T>, T: Real>
    Interpolated<'_, S, F, R, C, T>
{
    /// The coefficients for the frequency at these ends.
    fn read_frequency(&mut self, step: &Step<'_, S, F, R, T>, at: Ends<'_, T>) -> Result<(), StepFailure> {
        let Some(reading) = self.method.frequency.reading() else { return self.coefficients.fix(step) };
        // Where L is not separable, a frequency that is read has been refused.
        let Some(mass) = self.mass else { return Err(StepFailure::Frequency { omega: f64::NAN }) };
        let (frequency, per_h) = (&self.method.frequency, T::lift(1.0) / step.h);
        let NodeWork { velocity, gradient, .. } = &mut *self.node;
        let ([start, end], next) = (&mut *self.ends, &mut *self.next);
        for i in 0..at.q0.len() {
            next[i] = at.q0[i] + at.delta[i];
            velocity[i] = at.delta[i] * per_h;
        }
        let (t0, t1) = (step.t, step.node_time(1.0));
        match reading {
            Reading::LeftFrozen => {
                mass.solve(self.p, velocity);
                start.evaluate(frequency, mass, at.q0, velocity, self.force)?;
                return self.coefficients.set(step, start.omega);
            }
            Reading::Averaged => {
                start.evaluate(frequency, mass, at.q0, velocity, self.force)?;
                step.system.force(next, &[], t1, gradient);
                end.evaluate(frequency, mass, next, velocity, gradient)?;
            }
            Reading::Variational => {
                start.differentiate(frequency, mass, step.system, at.q0, velocity, t0)?;
                end.differentiate(frequency, mass, step.system, next, velocity, t1)?;
            }
        }
        self.coefficients.set(step, T::lift(0.5) * (start.omega + end.omega))
    }

    /// Adds ∂ℓ/∂ω ∂ω/∂q0 to `d1`, and with it ∂ℓ/∂ω ∂ω/∂q1 to `sum`, if the frequency is variational.
    fn vary_frequency(
        &mut self,
        step: &Step<'_, S, F, R, T>,
        at: Ends<'_, T>,
        d1: &mut [T],
        sum: Option<&mut [T]>,
    ) {
        if self.method.frequency.reading() != Some(Reading::Variational) {
            return;
        }
        let [start, end] = &*self.ends;
        let half = T::lift(0.5) * self.coefficients.slope(step, self.node, at, start.omega + end.omega);
        for (i, d1) in d1.iter_mut().enumerate() {
            let by_velocity = (start.dv[i] + end.dv[i]) / step.h;
            *d1 += half * (start.dq[i] - by_velocity);
        }
        if let Some(sum) = sum {
            for (i, sum) in sum.iter_mut().enumerate() {
                *sum += half * (start.dq[i] + end.dq[i]);
            }
        }
    }

    /// Adds the part of D₁L_d that a node has.
    fn add_first(&self, node: usize, h: T, d1: &mut [T]) {
        let (weight, NodeWork { gradient, momentum, .. }) = (self.coefficients.weight(node), &*self.node);
        for (i, d1) in d1.iter_mut().enumerate() {
            let Basis { b, d, .. } = self.coefficients.basis(node, i);
            *d1 += weight * (h * b * gradient[i] + d * momentum[i]);
        }
    }
}

impl<S: RegularLagrangian, F: FrequencyIn<T>, R: Rule, C: Adjustable<S, T>, T: Real> DiscreteLagrangian<S, T>
    for Interpolated<'_, S, F, R, C, T>
{
    fn derivatives(
        &mut self,
        system: &S,
        Interval { t, h }: Interval<T>,
        ends: Ends<'_, T>,
        d1: &mut [T],
        sum: &mut [T],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let step = Step { system, method: self.method, t, h };
        self.read_frequency(&step, ends)?;
        for (node, &c) in self.method.rule.nodes().iter().enumerate() {
            place(self.coefficients, node, h, ends, self.node);
            let NodeWork { point, velocity, gradient, momentum } = &mut *self.node;
            system.gradient(point, velocity, step.node_time(c), gradient, momentum);
            statistics.gradients += 1;
            let weight = self.coefficients.weight(node);
            for (i, sum) in sum.iter_mut().enumerate() {
                let Basis { b, b_bar, d, d_bar } = self.coefficients.basis(node, i);
                *sum += weight * (h * (b + b_bar) * gradient[i] + (d + d_bar) * momentum[i]);
            }
            self.add_first(node, h, d1);
        }
        self.vary_frequency(&step, ends, d1, Some(sum));
        Ok(())
    }

    fn linearize(
        &mut self,
        system: &S,
        Interval { t, h }: Interval<T>,
        ends: Ends<'_, T>,
        d1: &mut [T],
        matrix: &mut [T],
        _statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let step = Step { system, method: self.method, t, h };
        self.read_frequency(&step, ends)?;
        for (node, &c) in self.method.rule.nodes().iter().enumerate() {
            place(self.coefficients, node, h, ends, self.node);
            self.coefficients.add_mixed(node, system, [step.node_time(c), h], self.node, matrix);
            self.add_first(node, h, d1);
        }
        self.vary_frequency(&step, ends, d1, None);
        Ok(())
    }
}

/// Sets `point` to qʲ and `velocity` to q̇ʲ.
pub(super) fn place<S: RegularLagrangian, C: Adjustable<S, T>, T: Real>(
    coefficients: &C,
    node: usize,
    h: T,
    Ends { q0, delta }: Ends<'_, T>,
    NodeWork { point, velocity, .. }: &mut NodeWork<S, T>,
) {
    let per_h = T::lift(1.0) / h;
    for i in 0..q0.len() {
        let Basis { b, b_bar, d, d_bar } = coefficients.basis(node, i);
        point[i] = (b + b_bar) * q0[i] + b_bar * delta[i];
        velocity[i] = ((d + d_bar) * q0[i] + d_bar * delta[i]) * per_h;
    }
}

/// The weights of the second derivatives of L in D₁D₂L_d, for a node of weight `w`.
pub(super) fn mixed_weights<T: Real>(w: T, h: T, Basis { b, b_bar, d, d_bar }: Basis<T>) -> Weights<T> {
    Weights { qq: w * h * b * b_bar, qv: w * b * d_bar, vq: w * d * b_bar, vv: w * d * d_bar / h }
}
