//! Discrete Lagrangians with nodes that depend on the ends alone:
//!
//! L_d(q0, q1) = h Σ w L(q, q̇, t + ch),   q = b q0 + b̄ q1,   q̇ = (B q0 + B̄ q1)/h
//!
//! D₁L_d = Σ w (h b ∂L/∂q + B ∂L/∂v)      D₂L_d = Σ w (h b̄ ∂L/∂q + B̄ ∂L/∂v)
//! D₁D₂L_d = Σ w (h b b̄ L_qq + b B̄ L_qv + B b̄ L_vq + B B̄ L_vv/h),
//! and D₁D₁L_d, D₂D₂L_d with b, B or b̄, B̄ twice
//!
//! That of one node, q = q0 + σΔ and q̇ = Δ/h, is α(q)·Δ − h H(q) for L = α·v − H (Rowley & Marsden 2002,
//! eqs. 9, 10 and 17).

use super::basis::Basis;
use super::quadrature::Rule;
use super::{Interval, Span};
use crate::space::Sink;
use crate::state::Statistics;
use crate::{Lagrangian, Real, Space, System, Vector, Weights};

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
    #[inline]
    pub(crate) fn new(system: &S) -> Self {
        let vector = || system.space().vector();
        Self { point: vector(), velocity: vector(), gradient: vector(), momentum: vector() }
    }

    /// Adds h b ∂L/∂q + B ∂L/∂v, times a weight.
    #[inline]
    pub(crate) fn add(&self, weight: T, h: T, [b, d]: [T; 2], to: &mut [T]) {
        for (to, (&gradient, &momentum)) in to.iter_mut().zip(self.gradient.iter().zip(self.momentum.iter()))
        {
            *to += weight * (h * b * gradient + d * momentum);
        }
    }
}

/// A node.
#[derive(Clone, Copy, Debug)]
pub struct Node<T> {
    /// c
    pub(crate) time: T,
    pub(crate) weight: T,
    /// b and B, b̄ and B̄, and their sums.
    pub(crate) left: [T; 2],
    pub(crate) right: [T; 2],
    pub(crate) both: [T; 2],
}

impl<T: Real> Node<T> {
    pub(crate) fn new(time: T, weight: T, Basis { b, b_bar, d, d_bar }: Basis<T>) -> Self {
        Self { time, weight, left: [b, d], right: [b_bar, d_bar], both: [b + b_bar, d + d_bar] }
    }

    /// Adds its second derivative by two ends, at which `work` stands; sets ∂L/∂q and ∂L/∂v there.
    #[inline]
    fn add_second<S: Lagrangian<T>, K: Sink<T>>(
        &self,
        [[b, d], [c, e]]: [[T; 2]; 2],
        (system, interval): (&S, Interval<T>),
        NodeWork { point, velocity, gradient, momentum }: &mut NodeWork<S, T>,
        sink: &mut K,
    ) {
        let (w, h) = (self.weight, interval.h);
        let vv = if S::REGULAR { w * d * e / h } else { T::lift(0.0) };
        let weights = Weights { qq: w * h * b * c, qv: w * b * e, vq: w * d * c, vv };
        system.linearize(point, velocity, interval.time(self.time), weights, gradient, momentum, sink);
    }
}

/// The nodes of an interval.
pub trait Nodes<T: Real> {
    /// How many there are.
    fn count(&self) -> usize;

    /// Node `j`.
    fn node(&self, j: usize) -> Node<T>;

    /// Sets `point` and `velocity` to those of node `j`.
    fn place(&self, j: usize, h: T, [q0, delta]: [&[T]; 2], [point, velocity]: [&mut [T]; 2]) {
        let (Node { right: [b_bar, d_bar], both: [b, d], .. }, per_h) = (self.node(j), T::lift(1.0) / h);
        for i in 0..q0.len() {
            point[i] = b * q0[i] + b_bar * delta[i];
            velocity[i] = (d * q0[i] + d_bar * delta[i]) * per_h;
        }
    }
}

/// What one interval contributes to the discrete equations of a system, by a rule with these nodes.
///
/// On a system with [forces](Lagrangian::applied_force) D₁L_d means D₁L_d + F⁻ and D₂L_d means D₂L_d + F⁺,
/// with the discrete forces that the rule of L_d makes of F (Marsden & West 2001, section 3.2): of a rule
/// with nodes qʲ they are F⁻ = h Σ wⱼ bⱼ F(qʲ, q̇ʲ) and F⁺ = h Σ wⱼ b̄ⱼ F(qʲ, q̇ʲ).
///
/// All derivatives are **added** to what is passed. A value of this type has the storage that it needs, so
/// that nothing is allocated.
#[derive(Debug)]
pub struct DiscreteLagrangian<S: System, N, T: Real = f64> {
    nodes: N,
    pub(crate) work: NodeWork<S, T>,
}

impl<S: Lagrangian<T>, N: Nodes<T>, T: Real> DiscreteLagrangian<S, N, T> {
    pub(crate) fn of(system: &S, nodes: N) -> Self {
        Self { nodes, work: NodeWork::new(system) }
    }

    /// Adds D₁L_d to `d1` and D₁L_d + D₂L_d to `sum`, each one entry per coordinate.
    #[inline]
    pub fn derivatives(
        &mut self,
        Span { system, interval, q0, delta }: Span<'_, S, T>,
        d1: &mut [T],
        sum: &mut [T],
        statistics: &mut Statistics,
    ) {
        let (Self { nodes, work }, h) = (self, interval.h);
        for j in 0..nodes.count() {
            let Node { time, weight, left, both, .. } = nodes.node(j);
            nodes.place(j, h, [q0, delta], [&mut work.point, &mut work.velocity]);
            let NodeWork { point, velocity, gradient, momentum } = &mut *work;
            system.gradient(point, velocity, interval.time(time), gradient, momentum);
            statistics.gradients += 1;
            work.add(weight, h, both, sum);
            work.add(weight, h, left, d1);
        }
    }

    /// Adds D₁L_d to `d1` and D₁D₂L_d to `sink`, entry (i, j) of q0ⁱ and q1ʲ.
    #[inline]
    pub fn linearize<K: Sink<T>>(&mut self, span: Span<'_, S, T>, d1: &mut [T], sink: &mut K) {
        linearize(&self.nodes, span, &mut self.work, d1, sink);
    }

    /// Adds D₁D₁L_d, D₁D₂L_d, with a row for each entry of q0 and a column for each of q1, its transpose
    /// D₂D₁L_d and D₂D₂L_d to sinks: tangent maps and the preserved two-form come from these. With forces on
    /// the system these are the derivatives of D₁L_d + F⁻ and D₂L_d + F⁺, and no matrix is the transpose of
    /// another.
    pub fn hessian<K: Sink<T>>(
        &mut self,
        Span { system, interval, q0, delta }: Span<'_, S, T>,
        [d11, d12, d21, d22]: [&mut K; 4],
    ) {
        let Self { nodes, work } = self;
        for j in 0..nodes.count() {
            let node @ Node { left, right, .. } = nodes.node(j);
            nodes.place(j, interval.h, [q0, delta], [&mut work.point, &mut work.velocity]);
            node.add_second([left, left], (system, interval), work, d11);
            node.add_second([left, right], (system, interval), work, d12);
            node.add_second([right, left], (system, interval), work, d21);
            node.add_second([right, right], (system, interval), work, d22);
        }
    }
}

/// Adds D₁L_d and D₁D₂L_d.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn linearize<S: Lagrangian<T>, T: Real, K: Sink<T>>(
    nodes: &impl Nodes<T>,
    Span { system, interval, q0, delta }: Span<'_, S, T>,
    work: &mut NodeWork<S, T>,
    d1: &mut [T],
    sink: &mut K,
) {
    for j in 0..nodes.count() {
        let node = nodes.node(j);
        nodes.place(j, interval.h, [q0, delta], [&mut work.point, &mut work.velocity]);
        node.add_second([node.left, node.right], (system, interval), work, sink);
        work.add(node.weight, interval.h, node.left, d1);
    }
}

/// The discrete Lagrangian h L(q0 + σΔ, Δ/h) of any L, with the storage that it needs.
pub type OneNode<S, T = f64> = DiscreteLagrangian<S, Between<T>, T>;

/// A node at q0 + σΔ.
#[derive(Clone, Copy, Debug)]
pub struct Between<T>(T);

impl<S: Lagrangian<T>, T: Real> OneNode<S, T> {
    /// The discrete Lagrangian with its node at q0 + σΔ.
    pub fn new(system: &S, sigma: T) -> Self {
        Self::of(system, Between(sigma))
    }

    /// Sets `point` to q_σ and `velocity` to Δ/h.
    #[inline]
    pub(crate) fn place(&mut self, h: T, ends: [&[T]; 2]) {
        self.nodes.place(0, h, ends, [&mut self.work.point, &mut self.work.velocity]);
    }
}

impl<T: Real> Nodes<T> for Between<T> {
    #[inline]
    fn count(&self) -> usize {
        1
    }

    #[inline]
    fn node(&self, _j: usize) -> Node<T> {
        let (zero, one) = (T::lift(0.0), T::lift(1.0));
        let (left, right) = ([one - self.0, -one], [self.0, one]);
        Node { time: self.0, weight: one, left, right, both: [one, zero] }
    }

    #[inline]
    fn place(&self, _j: usize, h: T, [q0, delta]: [&[T]; 2], [point, velocity]: [&mut [T]; 2]) {
        let per_h = T::lift(1.0) / h;
        for i in 0..q0.len() {
            point[i] = q0[i] + self.0 * delta[i];
            velocity[i] = delta[i] * per_h;
        }
    }
}

// With linear interpolation.
impl<R: Rule, T: Real> Nodes<T> for R {
    fn count(&self) -> usize {
        self.nodes().len()
    }
    fn node(&self, j: usize) -> Node<T> {
        let (c, weight) = (self.nodes()[j], self.weights()[j]);
        Node::new(T::lift(c), T::lift(weight), Basis::linear(c))
    }
}
