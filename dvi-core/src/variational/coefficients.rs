//! What the interpolation between q0 and q1 makes of a quadrature rule.
//!
//! With the coefficients bⱼ, b̄ⱼ, Bⱼ, B̄ⱼ of the nodes, the kinetic part of D₁L_d is M(A q0 − K q1)/h and that of
//! D₂L_d is M(C q1 − K q0)/h, A = Σ w B², C = Σ w B̄², K = −Σ w B B̄. On the oscillator of frequency ω,
//! ∂²L_d/∂q0∂q1 = −(M/h)(K + z Σ w b b̄), z = (ωh)², with K + z Σ w b b̄ = S/(sin u/u)².

use super::general::place;
use super::memory::{Motion, Work};
use super::{Fitting, Step};
use crate::basis::{self, Bases, Basis};
use crate::error::StepFailure;
use crate::frequency::{Frequency, FrequencyIn};
use crate::norm::reported;
use crate::quadrature::{NODES, Quadrature};
use crate::{Lagrangian, Real, RegularLagrangian, Scalar, Space, Vector};

/// sin u and S count as zero below this.
const RESONANCE: f64 = 1e-4;

/// The coefficients of all nodes of a step, which may differ from coordinate to coordinate.
pub(super) trait Coefficients<T> {
    /// The weight of a node.
    fn weight(&self, node: usize) -> T;
    /// b, b̄, B and B̄ of a node.
    fn basis(&self, node: usize, coordinate: usize) -> Basis<T>;
    /// The sums of the kinetic part.
    fn sums(&self, coordinate: usize) -> Sums<T>;
}

/// Sums over the nodes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sums<T> {
    /// K = −Σ w B B̄
    pub(super) mixed: T,
    /// A − K = Σ w B(B + B̄)
    pub(super) left: T,
    /// C − K = Σ w B̄(B + B̄)
    pub(super) right: T,
    /// S/(sin u/u)²
    pub(super) stiffness: T,
}

/// One frequency for all coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Uniform<T> {
    u: T,
    weights: [T; NODES],
    bases: [Basis<T>; NODES],
    sums: Sums<T>,
}

impl<T: Real> Uniform<T> {
    /// For u = 0, linear interpolation.
    pub(super) fn linear(rule: &Quadrature) -> Self {
        let (zero, one) = (T::lift(0.0), T::lift(1.0));
        let nodes = Bases::new(zero);
        let mut weights = [zero; NODES];
        let mut bases = [nodes.at(0.0); NODES];
        for (j, (&c, &w)) in rule.nodes().iter().zip(rule.weights()).enumerate() {
            (weights[j], bases[j]) = (T::lift(w), nodes.at(c));
        }
        Self { u: zero, weights, bases, sums: Sums { mixed: one, left: zero, right: zero, stiffness: one } }
    }

    /// Makes these the coefficients for u = ωh.
    #[inline]
    pub(super) fn set(&mut self, rule: &Quadrature, fitting: Fitting, u: T) -> Result<(), StepFailure> {
        let (zero, nodes, z) = (T::lift(0.0), Bases::new(u), u * u);
        let mut sums = Sums { mixed: zero, left: zero, right: zero, stiffness: zero };
        for (j, (&c, &weight)) in rule.nodes().iter().zip(rule.weights()).enumerate() {
            let (w, basis) = (T::lift(weight), nodes.at(c));
            let Basis { b, b_bar, d, d_bar } = basis;
            sums.mixed -= w * d * d_bar;
            sums.left += w * d * (d + d_bar);
            sums.right += w * d_bar * (d + d_bar);
            sums.stiffness += z * w * b * b_bar;
            (self.weights[j], self.bases[j]) = (w, basis);
        }
        sums.stiffness += sums.mixed;
        let sinc = nodes.sinc();
        let kernel = sums.stiffness * sinc * sinc;
        let small = T::lift(RESONANCE);
        let determined = Scalar::abs(sinc) > small && Scalar::abs(kernel) > small;
        if !determined {
            // Not the coefficients of any step.
            self.u = T::lift(f64::NAN);
            let u = reported(u);
            return Err(StepFailure::Resonance { u, sine: u * reported(sinc), kernel: reported(kernel) });
        }
        if fitting == Fitting::PhaseAndMomentum {
            let factor = sinc / kernel;
            self.weights.iter_mut().for_each(|weight| *weight *= factor);
            for sum in [&mut sums.mixed, &mut sums.left, &mut sums.right, &mut sums.stiffness] {
                *sum *= factor;
            }
        }
        (self.u, self.sums) = (u, sums);
        Ok(())
    }

    /// Whether these are the coefficients for u = ωh.
    #[inline(always)]
    pub(super) fn is_for(&self, u: T) -> bool {
        self.u == u
    }
}

impl<T: Real> Coefficients<T> for Uniform<T> {
    #[inline(always)]
    fn weight(&self, node: usize) -> T {
        self.weights[node]
    }
    #[inline(always)]
    fn basis(&self, node: usize, _coordinate: usize) -> Basis<T> {
        self.bases[node]
    }
    #[inline(always)]
    fn sums(&self, _coordinate: usize) -> Sums<T> {
        self.sums
    }
}

/// A frequency for each coordinate.
#[derive(Debug)]
pub(super) struct Each<S: Lagrangian, T: Real> {
    /// The step for which these are; zero if there is none.
    h: T,
    weights: [T; NODES],
    b: [Vector<S, T>; NODES],
    b_bar: [Vector<S, T>; NODES],
    d: [Vector<S, T>; NODES],
    d_bar: [Vector<S, T>; NODES],
    mixed: Vector<S, T>,
    left: Vector<S, T>,
    right: Vector<S, T>,
    stiffness: Vector<S, T>,
}

impl<S: RegularLagrangian, T: Real> Each<S, T> {
    pub(super) fn new(system: &S) -> Self {
        let space = system.space();
        let vectors = || core::array::from_fn(|_| space.vector());
        Self {
            h: T::lift(0.0),
            weights: [T::lift(0.0); NODES],
            b: vectors(),
            b_bar: vectors(),
            d: vectors(),
            d_bar: vectors(),
            mixed: space.vector(),
            left: space.vector(),
            right: space.vector(),
            stiffness: space.vector(),
        }
    }

    /// Makes these the coefficients of `step`.
    pub(super) fn fix<F: FrequencyIn<T>>(&mut self, step: &Step<'_, S, F, T>) -> Result<(), StepFailure> {
        if self.h == step.h {
            return Ok(());
        }
        for i in 0..self.mixed.len() {
            let u = step.method.frequency.fixed(i) * step.h;
            let mut uniform = Uniform::linear(&step.method.rule);
            uniform.set(&step.method.rule, step.method.fitting, u)?;
            let Uniform { weights, bases, sums, .. } = uniform;
            // The same for all coordinates, as only the phase is fitted.
            self.weights = weights;
            for (node, basis) in bases.iter().enumerate() {
                self.b[node][i] = basis.b;
                self.b_bar[node][i] = basis.b_bar;
                self.d[node][i] = basis.d;
                self.d_bar[node][i] = basis.d_bar;
            }
            self.mixed[i] = sums.mixed;
            self.left[i] = sums.left;
            self.right[i] = sums.right;
            self.stiffness[i] = sums.stiffness;
        }
        self.h = step.h;
        Ok(())
    }
}

impl<S: RegularLagrangian, T: Real> Coefficients<T> for Each<S, T> {
    fn weight(&self, node: usize) -> T {
        self.weights[node]
    }
    fn basis(&self, node: usize, i: usize) -> Basis<T> {
        Basis {
            b: self.b[node][i],
            b_bar: self.b_bar[node][i],
            d: self.d[node][i],
            d_bar: self.d_bar[node][i],
        }
    }
    fn sums(&self, i: usize) -> Sums<T> {
        let (left, right) = (self.left[i], self.right[i]);
        Sums { mixed: self.mixed[i], left, right, stiffness: self.stiffness[i] }
    }
}

impl<T: Real> Uniform<T> {
    /// ∂ℓ/∂ω, for ω = `twice_omega`/2, at the current Δ.
    pub(super) fn slope<S: RegularLagrangian, F: Frequency>(
        &self,
        step: &Step<'_, S, F, T>,
        motion: &mut Motion<S, T>,
        q: &[T],
        twice_omega: T,
    ) -> T {
        let (z, rule) = (self.u * self.u, &step.method.rule);
        let slopes = basis::table_slope(rule, z);
        let fitted = step.method.fitting == Fitting::PhaseAndMomentum;
        let factor_slope = if fitted { basis::weight_factor_slope(rule, z) } else { T::lift(0.0) };
        let per_h = T::lift(1.0) / step.h;
        let mut by_z = T::lift(0.0);
        for (node, &c) in rule.nodes().iter().enumerate() {
            place(self, node, step, &mut motion.work, q);
            let Work { point, velocity, gradient, momentum, increment, .. } = &mut motion.work;
            let t = step.node_time(c);
            step.system.gradient(point, velocity, t, gradient, momentum);
            let Basis { b, b_bar, d, d_bar } = slopes[node];
            let mut along = T::lift(0.0);
            for i in 0..q.len() {
                let point_slope = (b + b_bar) * q[i] + b_bar * increment[i];
                let velocity_slope = ((d + d_bar) * q[i] + d_bar * increment[i]) * per_h;
                along += gradient[i] * point_slope + momentum[i] * velocity_slope;
            }
            by_z += self.weights[node] * along;
            if fitted {
                let value = step.system.lagrangian(point, velocity, t);
                by_z += T::lift(rule.weights()[node]) * factor_slope * value;
            }
        }
        // z = ω²h², and ℓ = h Σ w L.
        step.h * by_z * twice_omega * step.h * step.h
    }
}
