//! The second derivatives of the discrete Lagrangian L_d(q0, q1) = h L(q_σ, Δ/h).
//!
//! With q_σ = b q0 + b̄ q1, b = 1 − σ, b̄ = σ, and v = (q1 − q0)/h:
//!
//! D₁D₁ = h b² L_qq − b (L_qv + L_vq) + L_vv/h
//! D₁D₂ = h b b̄ L_qq + b L_qv − b̄ L_vq − L_vv/h
//! D₂D₂ = h b̄² L_qq + b̄ (L_qv + L_vq) + L_vv/h

use crate::{Lagrangian, Matrix, Real, Space, Vector, Weights};

/// D₁D₁L_d, D₁D₂L_d and D₂D₂L_d at a pair of points, row-major.
///
/// D₁D₂ with entries ∂²L_d/∂q0ⁱ∂q1ʲ is the matrix of the two-form D₁D₂ dq0 ∧ dq1 on Q×Q that each step
/// preserves (Rowley & Marsden 2002, eq. 17).
#[derive(Debug)]
pub struct DiscreteHessian<S: Lagrangian, T: Real = f64> {
    /// D₁D₁L_d.
    pub d11: Matrix<S, T>,
    /// D₁D₂L_d: row i belongs to q0ⁱ, column j to q1ʲ.
    pub d12: Matrix<S, T>,
    /// D₂D₂L_d.
    pub d22: Matrix<S, T>,
    point: Vector<S, T>,
    velocity: Vector<S, T>,
    gradients: [Vector<S, T>; 2],
}

impl<S: Lagrangian, T: Real> DiscreteHessian<S, T> {
    /// Storage for `system`, with zeros.
    pub fn new(system: &S) -> Self {
        let space = system.space();
        Self {
            d11: space.matrix(),
            d12: space.matrix(),
            d22: space.matrix(),
            point: space.vector(),
            velocity: space.vector(),
            gradients: [space.vector(), space.vector()],
        }
    }

    /// Evaluates the three matrices for the step of length `h` from (`q0`, `t`) to `q1`. Slices shorter
    /// than the dimension count as continued by zeros.
    pub fn evaluate(&mut self, system: &S, sigma: T, t: T, h: T, q0: &[T], q1: &[T]) {
        for (i, (&q0, &q1)) in q0.iter().zip(q1).enumerate().take(self.point.len()) {
            self.point[i] = q0 + sigma * (q1 - q0);
            self.velocity[i] = (q1 - q0) / h;
        }
        let (b, b_bar, per_h) = (T::lift(1.0) - sigma, sigma, T::lift(1.0) / h);
        let weights = [
            Weights { qq: h * b * b, qv: -b, vq: -b, vv: per_h },
            Weights { qq: h * b * b_bar, qv: b, vq: -b_bar, vv: -per_h },
            Weights { qq: h * b_bar * b_bar, qv: b_bar, vq: b_bar, vv: per_h },
        ];
        let [l_q, l_v] = &mut self.gradients;
        for (w, matrix) in weights.into_iter().zip([&mut self.d11, &mut self.d12, &mut self.d22]) {
            matrix.fill(T::lift(0.0));
            system.linearize(&self.point, &self.velocity, t + sigma * h, w, l_q, l_v, matrix);
        }
    }
}
