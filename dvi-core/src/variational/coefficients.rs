//! What the interpolation between q0 and q1 makes of a quadrature rule.
//!
//! With the coefficients bⱼ, b̄ⱼ, Bⱼ, B̄ⱼ of the nodes, the kinetic part of D₁L_d is M(A q0 − K q1)/h and that of
//! D₂L_d is M(C q1 − K q0)/h, A = Σ w B², C = Σ w B̄², K = −Σ w B B̄. On the oscillator of frequency ω,
//! ∂²L_d/∂q0∂q1 = −(M/h)(K + z Σ w b b̄), z = (ωh)², with K + z Σ w b b̄ = uS/sin u.

use super::general::place;
use super::memory::{Motion, Work};
use super::{Fitting, Step};
use crate::basis::{self, Basis};
use crate::error::StepFailure;
use crate::frequency::{Frequency, FrequencyIn};
use crate::norm::reported;
use crate::quadrature::Quadrature;
use crate::{Lagrangian, Real, RegularLagrangian, Scalar, Space, Vector};

/// How many nodes a rule has at most.
pub(super) const NODES: usize = 5;

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
    /// uS/sin u
    pub(super) stiffness: T,
}

impl<T: Real> Sums<T> {
    fn new(weights: &[T; NODES], bases: &[Basis<T>; NODES], len: usize, z: T) -> Self {
        let zero = T::lift(0.0);
        let mut sums = Self { mixed: zero, left: zero, right: zero, stiffness: zero };
        for (&w, basis) in weights.iter().zip(bases).take(len) {
            let Basis { b, b_bar, d, d_bar } = *basis;
            sums.mixed -= w * d * d_bar;
            sums.left += w * d * (d + d_bar);
            sums.right += w * d_bar * (d + d_bar);
            sums.stiffness += z * w * b * b_bar;
        }
        sums.stiffness += sums.mixed;
        sums
    }
}

/// One frequency for all coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Uniform<T> {
    z: T,
    weights: [T; NODES],
    bases: [Basis<T>; NODES],
    sums: Sums<T>,
}

impl<T: Real> Uniform<T> {
    /// For z = (ωh)².
    #[inline]
    pub(super) fn new(rule: &Quadrature, fitting: Fitting, z: T) -> Result<Self, StepFailure> {
        let (sinc, kernel) = (basis::sinc(z), basis::kernel(rule, z));
        let small = T::lift(RESONANCE);
        let resonant = Scalar::abs(sinc) * Scalar::sqrt(z) < small && z > T::lift(1.0);
        let determined = Scalar::abs(kernel) > small;
        if resonant || !determined || !z.is_finite() {
            let u = reported(Scalar::sqrt(z));
            return Err(StepFailure::Resonance { u, sine: u * reported(sinc), kernel: reported(kernel) });
        }
        let mut weights = [T::lift(0.0); NODES];
        let factor = match fitting {
            Fitting::Phase => T::lift(1.0),
            Fitting::PhaseAndMomentum => sinc / kernel,
        };
        for (weight, &w) in weights.iter_mut().zip(rule.weights()) {
            *weight = T::lift(w) * factor;
        }
        let bases = basis::table(rule, z);
        Ok(Self { z, weights, bases, sums: Sums::new(&weights, &bases, rule.nodes().len(), z) })
    }

    /// Whether these are the coefficients for `z`.
    #[inline(always)]
    pub(super) fn is_for(&self, z: T) -> bool {
        self.z == z
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
            let Uniform { weights, bases, sums, .. } =
                Uniform::new(&step.method.rule, step.method.fitting, u * u)?;
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
        let rule = &step.method.rule;
        let slopes = basis::table_slope(rule, self.z);
        let fitted = step.method.fitting == Fitting::PhaseAndMomentum;
        let factor_slope = if fitted { basis::weight_factor_slope(rule, self.z) } else { T::lift(0.0) };
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
