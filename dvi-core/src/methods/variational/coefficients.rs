//! What the interpolation between q0 and q1 makes of a quadrature rule.
//!
//! With the coefficients bⱼ, b̄ⱼ, Bⱼ, B̄ⱼ of the nodes, the kinetic part of D₁L_d is M(A q0 − K q1)/h and
//! that of D₂L_d is M(C q1 − K q0)/h, A = Σ w B², C = Σ w B̄², K = −Σ w B B̄. On the oscillator of frequency
//! ω, ∂²L_d/∂q0∂q1 = −(M/h)(K + z Σ w b b̄), z = (ωh)², with K + z Σ w b b̄ = S/(sin u/u)².

use super::Variational;
use crate::discrete::basis::{self, Bases, Basis};
use crate::discrete::frequency::{self, Frequency};
use crate::discrete::quadrature::{NODES, Rule};
use crate::discrete::{Node, NodeWork, Nodes, Span};
use crate::error::StepFailure;
use crate::methods::step::Kinetic;
use crate::scalar::norm::reported;
use crate::{NondegenerateLagrangian, Real, Scalar};

/// What a phase-fitted interpolation is made exact for on the oscillator of its frequency.
///
/// ```
/// use dvi_core::prelude::*;
///
/// #[lagrangian(coordinates(x), lagrangian = (dot(x).powi(2) - x * x) / 2.0)]
/// struct Oscillator;
///
/// let start = OscillatorState { x: 0.0, dot_x: 1.0 };
/// let end = |fitting| -> Result<f64, Box<dyn std::error::Error>> {
///     let method = Variational { fitting, ..Variational::midpoint().phase_fitted(Constant(1.0)) };
///     let mut run = Integrator::new(&Oscillator, method, 1.0, start.clone())?;
///     run.advance()?;
///     Ok(run.state().x)
/// };
/// let exact = 1_f64.sin();
/// assert!((end(Fitting::PhaseAndMomentum)? - exact).abs() < 1e-14);
/// assert!((end(Fitting::Phase)? * 1.188 - exact).abs() < 1e-3); // the momentum is 1.188 v
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fitting {
    /// The positions: q_{k+1} = 2 cos(ωh) q_k − q_{k−1}. The momentum is s·v with a factor s near one
    /// (midpoint at ωh = 1: 1.188), so that a run from given velocities has a wrong amplitude for ever.
    #[default]
    Phase,
    /// Positions and momenta: the weights are multiplied by (sin u/u)/S, u = ωh, S = Σ wⱼ cos((1 − 2cⱼ)u).
    /// Not with [`Reading::Variational`](crate::discrete::Reading::Variational).
    PhaseAndMomentum,
}

/// The coefficients of all nodes of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coefficients<T> {
    u: T,
    pub(super) weights: [T; NODES],
    /// b, b̄, B and B̄.
    pub(super) bases: [Basis<T>; NODES],
    /// Sums over the nodes: K = −Σ w B B̄, A − K = Σ w B(B + B̄), C − K = Σ w B̄(B + B̄), and one over
    /// κ = K + z Σ w b b̄ = S/(sin u/u)².
    pub(super) sums: Kinetic<T>,
}

impl<T: Real> Coefficients<T> {
    /// For u = 0, linear interpolation.
    #[inline]
    pub(super) fn linear(rule: &impl Rule) -> Self {
        let zero = T::lift(0.0);
        let (mut weights, mut bases) = ([zero; NODES], [Basis::linear(0.0); NODES]);
        for (j, (&c, &w)) in rule.nodes().iter().zip(rule.weights()).enumerate() {
            (weights[j], bases[j]) = (T::lift(w), Basis::linear(c));
        }
        Self { u: zero, weights, bases, sums: Kinetic::of_mean_velocity() }
    }

    /// Makes these the coefficients for u = ωh.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn fit(&mut self, rule: &impl Rule, fitting: Fitting, u: T) -> Result<(), StepFailure> {
        let (zero, nodes) = (T::lift(0.0), Bases::new(u));
        // The sums times σ².
        let (mut mixed, mut left, mut right, mut inner) = (zero, zero, zero, zero);
        let entries = self.bases.iter_mut().zip(rule.nodes()).zip(rule.weights());
        for ((basis, &c), &w) in entries {
            let pairs = nodes.pairs(c);
            *basis = nodes.basis(c, pairs);
            let [l, r] = pairs;
            let (weight, difference) = (T::lift(w), l.cosine - r.cosine);
            let (at_left, at_right) = (weight * l.cosine, weight * r.cosine);
            mixed += at_left * r.cosine;
            left += at_left * difference;
            right -= at_right * difference;
            inner += T::lift(w * c * (1.0 - c)) * (l.sinc * r.sinc);
        }
        let sinc = nodes.whole.sinc;
        let cosine_sum = mixed + u * u * inner;
        if let Err(resonance) = frequency::determined(u, sinc, cosine_sum) {
            // Not the coefficients of any step.
            self.u = T::lift(f64::NAN);
            return Err(resonance);
        }
        let mut factor = nodes.reciprocal * nodes.reciprocal;
        if fitting == Fitting::PhaseAndMomentum {
            let fitted = sinc / cosine_sum;
            factor *= fitted;
            for (weight, &w) in self.weights.iter_mut().zip(rule.weights()) {
                *weight = T::lift(w) * fitted;
            }
        }
        let per_stiffness = T::lift(1.0) / (cosine_sum * factor);
        let [mixed, left, right] = [mixed, left, right].map(|sum| sum * factor);
        (self.u, self.sums) = (u, Kinetic { mixed, left, right, per_stiffness });
        Ok(())
    }

    /// Where the frequency does not depend on the motion: makes these the coefficients of a step of length
    /// `h`.
    #[inline]
    pub(super) fn fix<F: Frequency, R: Rule>(
        &mut self,
        Variational { rule, frequency, fitting, .. }: &Variational<F, R>,
        h: T,
    ) -> Result<(), StepFailure> {
        let u = frequency.fixed::<T>() * h;
        if self.u == u { Ok(()) } else { self.fit(rule, *fitting, u) }
    }

    /// Makes these the coefficients of a step of length `h` for the frequency `omega`.
    ///
    /// # Errors
    /// [`StepFailure::Resonance`], also if ωh is π or more.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn set<F, R: Rule>(
        &mut self,
        Variational { rule, fitting, .. }: &Variational<F, R>,
        [h, omega]: [T; 2],
    ) -> Result<(), StepFailure> {
        let u = omega * h;
        self.fit(rule, *fitting, u)?;
        // A step over half a turn or more of a motion sees nothing of it.
        if Scalar::abs(u) < T::lift(core::f64::consts::PI) {
            return Ok(());
        }
        self.u = T::lift(f64::NAN);
        let (u, sine) = (reported(u), reported(Scalar::sin(u)));
        Err(StepFailure::Resonance {
            u,
            sine,
            cosine_sum: sine * sine / (u * u * reported(self.sums.per_stiffness)),
        })
    }

    /// Sets `point` to qʲ of a node.
    #[inline]
    pub(super) fn place_point(&self, node: usize, [q0, delta]: [&[T]; 2], point: &mut [T]) {
        let Basis { b, b_bar, .. } = self.bases[node];
        for ((point, &q), &delta) in point.iter_mut().zip(q0).zip(delta) {
            *point = (b + b_bar) * q + b_bar * delta;
        }
    }

    /// ∂ℓ/∂ω between these ends, for ω = `twice_omega`/2, where weights do not depend on it.
    pub(super) fn slope<S: NondegenerateLagrangian<T>, F: Frequency, R: Rule>(
        &self,
        Variational { rule, .. }: &Variational<F, R>,
        Span { system, interval, q0, delta }: Span<'_, S, T>,
        work: &mut NodeWork<S, T>,
        twice_omega: T,
    ) -> T {
        let (z, h) = (self.u * self.u, interval.h);
        let slopes = basis::table_slope(rule, z);
        let per_h = T::lift(1.0) / h;
        let mut by_z = T::lift(0.0);
        for (node, &c) in rule.nodes().iter().enumerate() {
            let NodeWork { point, velocity, gradient, momentum } = &mut *work;
            Placed(rule, self).place(node, h, [q0, delta], [point, velocity]);
            system.gradient(point, velocity, interval.time(T::lift(c)), gradient, momentum);
            let Basis { b, b_bar, d, d_bar } = slopes[node];
            let mut along = T::lift(0.0);
            for i in 0..q0.len() {
                let point_slope = (b + b_bar) * q0[i] + b_bar * delta[i];
                let velocity_slope = ((d + d_bar) * q0[i] + d_bar * delta[i]) * per_h;
                along += gradient[i] * point_slope + momentum[i] * velocity_slope;
            }
            by_z += self.weights[node] * along;
        }
        // z = ω²h², and ℓ = h Σ w L.
        h * by_z * twice_omega * h * h
    }
}

/// The nodes of a rule, with their coefficients.
pub(super) struct Placed<'a, R, T>(pub(super) &'a R, pub(super) &'a Coefficients<T>);

impl<R: Rule, T: Real> Nodes<T> for Placed<'_, R, T> {
    fn count(&self) -> usize {
        self.0.nodes().len()
    }

    fn node(&self, j: usize) -> Node<T> {
        let Self(rule, Coefficients { weights, bases, .. }) = self;
        Node::new(T::lift(rule.nodes()[j]), weights[j], bases[j])
    }
}
