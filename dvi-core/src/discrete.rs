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
use crate::{Lagrangian, Real, System};

pub use crate::mechanics::{Interval, Span};
pub use frequency::{Constant, Curvature, Frequency, Radial, Reading, Unfitted};
pub(crate) use node::{Between, Node, NodeWork, Nodes, linearize};
pub use node::{DiscreteLagrangian, OneNode};
pub use quadrature::{Midpoint, Quadrature, Rule, Simpson, Trapezoid};

/// A discrete Lagrangian where a step begins, whose equation p0 + D₁L_d(q0, q0 + Δ) = 0 is to be solved.
pub(crate) struct Departing<'a, S: System, T: Real, N> {
    pub(crate) l_d: &'a mut DiscreteLagrangian<S, N, T>,
    pub(crate) system: &'a S,
    pub(crate) interval: Interval<T>,
    pub(crate) q0: &'a [T],
}

impl<S: Lagrangian<T>, T: Real, N: Nodes<T>> Linearize<T> for Departing<'_, S, T, N> {
    #[inline]
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
