//! The symmetrised family: L_d(q0, q1) = ½ (L_d^α + L_d^{1−α}),   L_d^α = h L((1−α)q0 + αq1, Δ/h, t + αh)
//!
//! Its own adjoint, and so of second order, for every α (Marsden & West 2001, section 2.3.2 and theorem 2.4.1).

use crate::discrete::{DiscreteLagrangian, OneNode, Span, TwiceDifferentiable};
use crate::error::{StartError, StepFailure};
use crate::methods::{InnerScheme, VariationalMethod};
use crate::methods::{PreservedForm, Scheme};
use crate::scalar::norm;
use crate::space::sink::{Scaled, Sink};
use crate::state::Statistics;
use crate::{Lagrangian, Real, Space, System, Vector};

/// The symmetrised family, for systems of either kind (Marsden & West 2001, section 2.3.2).
///
/// ```math
/// L_d = \tfrac12 \left( L_d^{\alpha} + L_d^{1 - \alpha} \right), \qquad
/// L_d^{\alpha}(q_0, q_1) = h\, L\!\left((1 - \alpha) q_0 + \alpha q_1,\ \tfrac{q_1 - q_0}{h},\ t + \alpha h\right)
/// ```
///
/// It has no steps of its own: [`General`](crate::methods::General) makes a method of it. With α = 0 it is Störmer–Verlet where
/// that exists, and with α = ½ the midpoint rule. On degenerate systems it is a two-step map with a parasitic mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Symmetrised<T = f64> {
    /// α, in \[0, 1\].
    pub alpha: T,
}

/// ½ (L_d^α + L_d^{1−α}), with the storage that it needs.
#[derive(Debug)]
pub struct SymmetrisedLagrangian<S: System, T: Real = f64> {
    nodes: [OneNode<S, T>; 2],
    /// Twice D₁L_d and D₁L_d + D₂L_d.
    twice: [Vector<S, T>; 2],
}

impl<T: Real> Scheme for Symmetrised<T> {
    fn order(&self) -> usize {
        2
    }
    fn is_symmetric(&self) -> bool {
        true
    }
    fn preserved_form(&self) -> PreservedForm {
        PreservedForm::Discrete
    }
}

impl<S: Lagrangian<T>, T: Real> VariationalMethod<S, T> for Symmetrised<T> {
    type DiscreteLagrangian = SymmetrisedLagrangian<S, T>;

    fn admit(&self, _system: &S) -> Result<(), StartError> {
        let in_range = self.alpha >= T::lift(0.0) && self.alpha <= T::lift(1.0);
        let value = norm::reported(self.alpha);
        if in_range {
            Ok(())
        } else {
            Err(StartError::Parameter { name: "alpha", value, range: "0 <= alpha <= 1" })
        }
    }

    fn discrete_lagrangian(&self, system: &S) -> SymmetrisedLagrangian<S, T> {
        let nodes = [self.alpha, T::lift(1.0) - self.alpha].map(|node| OneNode::new(system, node));
        SymmetrisedLagrangian { nodes, twice: [system.space().vector(), system.space().vector()] }
    }
}

impl<S: Lagrangian<T>, T: Real> InnerScheme<S, T> for Symmetrised<T> {}

impl<S: Lagrangian<T>, T: Real> DiscreteLagrangian<S, T> for SymmetrisedLagrangian<S, T> {
    fn derivatives(
        &mut self,
        span: Span<'_, S, T>,
        d1: &mut [T],
        sum: &mut [T],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { nodes, twice: [first, both] } = self;
        first.fill(T::lift(0.0));
        both.fill(T::lift(0.0));
        for node in nodes {
            node.derivatives(span, first, both, statistics)?;
        }
        for i in 0..d1.len() {
            d1[i] += T::lift(0.5) * first[i];
            sum[i] += T::lift(0.5) * both[i];
        }
        Ok(())
    }

    fn linearize<K: Sink<T>>(
        &mut self,
        span: Span<'_, S, T>,
        d1: &mut [T],
        sink: &mut K,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Self { nodes, twice: [first, _] } = self;
        first.fill(T::lift(0.0));
        let mut half = Scaled { sink, factor: |_, _| T::lift(0.5) };
        for node in nodes {
            node.linearize(span, first, &mut half, statistics)?;
        }
        for (d1, &first) in d1.iter_mut().zip(first.iter()) {
            *d1 += T::lift(0.5) * first;
        }
        Ok(())
    }
}

impl<S: Lagrangian<T>, T: Real> TwiceDifferentiable<S, T> for SymmetrisedLagrangian<S, T> {
    fn hessian<K: Sink<T>>(&mut self, span: Span<'_, S, T>, sinks: [&mut K; 4]) -> Result<(), StepFailure> {
        let mut halves = sinks.map(|sink| Scaled { sink, factor: |_, _| T::lift(0.5) });
        for node in &mut self.nodes {
            node.hessian(span, halves.each_mut())?;
        }
        Ok(())
    }
}
