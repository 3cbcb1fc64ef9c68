//! The discrete Lagrangian: a function of the two ends of a step, close to the action of the motion between
//! them.
//!
//! ```math
//! L_d(q_0, q_1;\ t, h) \approx \int_t^{t+h} L(q, \dot q, t')\, \mathrm{d}t'
//! ```
//!
//! A step solves the first of the discrete Euler–Lagrange equations in position–momentum form for q1 = q0 +
//! Δ, and evaluates the second (Marsden & West 2001, eqs. 1.5.2 and 1.5.3):
//!
//! ```math
//! p_0 = -D_1 L_d(q_0, q_1), \qquad p_1 = D_2 L_d(q_0, q_1) = p_0 + (D_1 + D_2) L_d(q_0, q_1)
//! ```
//!
//! The second is evaluated in its last form, as a sum of terms of order h, which rounds less.

mod node;

pub(crate) mod basis;
pub(crate) mod frequency;
pub(crate) mod quadrature;

use crate::error::StepFailure;
use crate::solve::Linearize;
use crate::space::Sink;
use crate::state::Statistics;
use crate::{Lagrangian, Real};

pub use crate::mechanics::{Interval, Span};
pub use frequency::{Constant, Curvature, Frequency, Radial, Reading, Unfitted};
pub use node::OneNode;
pub(crate) use node::{Node, NodeWork, Nodes, SumOverNodes, linearize};
pub use quadrature::{Midpoint, Quadrature, Rule, Simpson, Trapezoid};

/// What one interval contributes to the discrete equations of a system.
///
/// On a system with [forces](Lagrangian::applied_force) D₁L_d means D₁L_d + F⁻ and D₂L_d means D₂L_d + F⁺,
/// with the discrete forces that the rule of L_d makes of F (Marsden & West 2001, section 3.2): of a rule
/// with nodes qʲ they are F⁻ = h Σ wⱼ bⱼ F(qʲ, q̇ʲ) and F⁺ = h Σ wⱼ b̄ⱼ F(qʲ, q̇ʲ).
///
/// All derivatives are **added** to what is passed. A value of this type has the storage that it needs, so
/// that nothing is allocated.
pub trait DiscreteLagrangian<S: Lagrangian<T>, T: Real> {
    /// Adds D₁L_d to `d1` and D₁L_d + D₂L_d to `sum`, each one entry per coordinate.
    fn derivatives(
        &mut self,
        span: Span<'_, S, T>,
        d1: &mut [T],
        sum: &mut [T],
        statistics: &mut Statistics,
    );

    /// Adds D₁L_d to `d1` and D₁D₂L_d to `sink`, entry (i, j) of q0ⁱ and q1ʲ.
    fn linearize<K: Sink<T>>(&mut self, span: Span<'_, S, T>, d1: &mut [T], sink: &mut K);

    /// Adds D₁D₁L_d, D₁D₂L_d, with a row for each entry of q0 and a column for each of q1, its transpose
    /// D₂D₁L_d and D₂D₂L_d to sinks: tangent maps and the preserved two-form come from these. With forces on
    /// the system these are the derivatives of D₁L_d + F⁻ and D₂L_d + F⁺, and no matrix is the transpose of
    /// another.
    fn hessian<K: Sink<T>>(&mut self, span: Span<'_, S, T>, sinks: [&mut K; 4]);
}

/// A discrete Lagrangian where a step begins, whose equation p0 + D₁L_d(q0, q0 + Δ) = 0 is to be solved.
pub(crate) struct Departing<'a, S, T, L> {
    pub(crate) l_d: &'a mut L,
    pub(crate) system: &'a S,
    pub(crate) interval: Interval<T>,
    pub(crate) q0: &'a [T],
}

impl<S: Lagrangian<T>, T: Real, L: DiscreteLagrangian<S, T>> Linearize<T> for Departing<'_, S, T, L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn linearize<K: Sink<T>>(
        &mut self,
        delta: &[T],
        d1: &mut [T],
        sink: &mut K,
        _statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { l_d, system, interval, q0 } = self;
        l_d.linearize(Span { system, interval: *interval, q0, delta }, d1, sink);
        Ok(())
    }
}
