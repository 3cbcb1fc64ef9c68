//! A chain of springs that are stiff and soft in turn.

use std::f64::consts::FRAC_1_SQRT_2;

use dvi_core::prelude::*;

/// 2m equal masses between two walls (Hairer, Lubich & Wanner 2006, section I.5.1). Masses 2i and 2i + 1 are
/// joined by a stiff linear spring; the springs between these pairs and to the walls are soft, with the
/// potential r⁴. So x = (q_{2i+1} − q_{2i})/√2 is an oscillator of frequency ω but for the soft springs.
#[lagrangian(
    coordinates(q[2 * m]),
    lagrangian = sum(0..2 * m, |i| dot(q[i]).powi(2)) / 2.0
        - omega.powi(2) / 4.0 * sum(0..m, |i| (q[2 * i + 1] - q[2 * i]).powi(2))
        - q[0].powi(4) - sum(1..m, |i| (q[2 * i] - q[2 * i - 1]).powi(4)) - q[2 * m - 1].powi(4),
)]
#[derive(Clone, Debug)]
pub struct SpringChain {
    /// m, the number of stiff springs.
    pub m: usize,
    /// ω
    pub omega: f64,
}

impl SpringChain {
    /// All energy is in the first pair: its centre (q₀ + q₁)/√2 is at `centre` with velocity 1, and its
    /// spring has the energy 1.
    pub fn first_pair(&self, centre: f64) -> SpringChainState {
        let (mut q, mut dot_q) = (vec![0.0; 2 * self.m], vec![0.0; 2 * self.m]);
        if let ([q0, q1, ..], [v0, v1, ..]) = (&mut q[..], &mut dot_q[..]) {
            let x = 1.0 / self.omega;
            [*q0, *q1] = [FRAC_1_SQRT_2 * (centre - x), FRAC_1_SQRT_2 * (centre + x)];
            [*v0, *v1] = [0.0, FRAC_1_SQRT_2 * 2.0];
        }
        SpringChainState { q, dot_q }
    }

    /// ½(x'² + sω²x²) of each stiff spring, for a factor s.
    pub fn oscillatory(&self, state: &SpringChainState, s: f64) -> Vec<f64> {
        let pairs = state.q.chunks_exact(2).zip(state.dot_q.chunks_exact(2));
        let energy = |(q, dot_q): (&[f64], &[f64])| {
            0.25 * ((dot_q[1] - dot_q[0]).powi(2) + s * (self.omega * (q[1] - q[0])).powi(2))
        };
        pairs.map(energy).collect()
    }
}
