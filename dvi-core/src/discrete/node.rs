//! One node: L_d(q0, q1) = h L(q_σ, Δ/h, t + σh), q_σ = q0 + σΔ.
//!
//! D₁L_d = (1−σ)h ∂L/∂q − ∂L/∂v      D₂L_d = σh ∂L/∂q + ∂L/∂v
//! D₁D₂L_d = σ(1−σ)h L_qq + (1−σ)L_qv − σL_vq − L_vv/h
//!
//! For L = α·v − H it is L_d = α(q_σ)·Δ − h H(q_σ) (Rowley & Marsden 2002, eqs. 9, 10 and 17).

use super::{DiscreteLagrangian, Ends, Interval, Span, TwiceDifferentiable};
use crate::error::StepFailure;
use crate::space::sink::Sink;
use crate::state::Statistics;
use crate::{Lagrangian, Real, Space, System, Vector, Weights};

/// The discrete Lagrangian h L(q_σ, Δ/h) of any L, with the storage that it needs.
#[derive(Debug)]
pub struct OneNode<S: System, T: Real = f64> {
    sigma: T,
    pub(crate) work: NodeWork<S, T>,
}

/// Where L is evaluated, and its derivatives there.
#[derive(Debug)]
pub(crate) struct NodeWork<S: System, T: Real> {
    pub(crate) point: Vector<S, T>,
    pub(crate) velocity: Vector<S, T>,
    /// ∂L/∂q
    pub(crate) gradient: Vector<S, T>,
    /// ∂L/∂v
    pub(crate) momentum: Vector<S, T>,
}

impl<S: Lagrangian<T>, T: Real> NodeWork<S, T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn new(system: &S) -> Self {
        let vector = || system.space().vector();
        Self { point: vector(), velocity: vector(), gradient: vector(), momentum: vector() }
    }
}

impl<S: Lagrangian<T>, T: Real> OneNode<S, T> {
    /// The discrete Lagrangian with its node at q0 + σΔ.
    pub fn new(system: &S, sigma: T) -> Self {
        Self { sigma, work: NodeWork::new(system) }
    }

    /// Sets `point` to q_σ and `velocity` to Δ/h.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn place(&mut self, interval: Interval<T>, Ends { q0, delta }: Ends<'_, T>) {
        let NodeWork { point, velocity, .. } = &mut self.work;
        let per_h = T::lift(1.0) / interval.h;
        for i in 0..q0.len() {
            point[i] = q0[i] + self.sigma * delta[i];
            velocity[i] = delta[i] * per_h;
        }
    }

    /// Adds D₁L_d, from the derivatives of L.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_first(&self, h: T, d1: &mut [T]) {
        let left_h = (T::lift(1.0) - self.sigma) * h;
        let NodeWork { gradient, momentum, .. } = &self.work;
        for i in 0..d1.len() {
            d1[i] = d1[i] - momentum[i] + left_h * gradient[i];
        }
    }
}

impl<S: Lagrangian<T>, T: Real> DiscreteLagrangian<S, T> for OneNode<S, T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn derivatives(
        &mut self,
        Span { system, interval, ends }: Span<'_, S, T>,
        d1: &mut [T],
        sum: &mut [T],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.place(interval, ends);
        let NodeWork { point, velocity, gradient, momentum } = &mut self.work;
        system.gradient(point, velocity, interval.time(self.sigma), gradient, momentum);
        statistics.gradients += 1;
        for (sum, &gradient) in sum.iter_mut().zip(gradient.iter()) {
            *sum += interval.h * gradient;
        }
        self.add_first(interval.h, d1);
        Ok(())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn linearize<K: Sink<T>>(
        &mut self,
        Span { system, interval, ends }: Span<'_, S, T>,
        d1: &mut [T],
        sink: &mut K,
        _statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.place(interval, ends);
        let NodeWork { point, velocity, gradient, momentum } = &mut self.work;
        let (h, sigma, left) = (interval.h, self.sigma, T::lift(1.0) - self.sigma);
        let vv = if S::REGULAR { -T::lift(1.0) / h } else { T::lift(0.0) };
        let weights = Weights { qq: sigma * left * h, qv: left, vq: -sigma, vv };
        system.linearize(point, velocity, interval.time(sigma), weights, gradient, momentum, sink);
        self.add_first(h, d1);
        Ok(())
    }
}

impl<S: Lagrangian<T>, T: Real> TwiceDifferentiable<S, T> for OneNode<S, T> {
    fn hessian<K: Sink<T>>(
        &mut self,
        Span { system, interval, ends }: Span<'_, S, T>,
        [d11, d12, d21, d22]: [&mut K; 4],
    ) -> Result<(), StepFailure> {
        self.place(interval, ends);
        let NodeWork { point, velocity, gradient, momentum } = &mut self.work;
        let (h, right, left) = (interval.h, self.sigma, T::lift(1.0) - self.sigma);
        let per_h = T::lift(1.0) / h;
        let weights = [
            (Weights { qq: h * left * left, qv: -left, vq: -left, vv: per_h }, d11),
            (Weights { qq: h * left * right, qv: left, vq: -right, vv: -per_h }, d12),
            (Weights { qq: h * left * right, qv: -right, vq: left, vv: -per_h }, d21),
            (Weights { qq: h * right * right, qv: right, vq: right, vv: per_h }, d22),
        ];
        for (weights, sink) in weights {
            let t = interval.time(right);
            system.linearize(point, velocity, t, weights, gradient, momentum, sink);
        }
        Ok(())
    }
}
