//! The part of an orbit that changes sign from step to step: the parasitic mode in q.
//!
//! d_k = (q_{k−2} − 4q_{k−1} + 6q_k − 4q_{k+1} + q_{k+2})/16. On (−1)ᵏa the filter gives (−1)ᵏa; on a
//! smooth orbit it leaves (h⁴/16) q⁗, and on cubics nothing.

use std::collections::VecDeque;

use crate::numbers::largest;

const WEIGHTS: [f64; 5] = [1.0 / 16.0, -4.0 / 16.0, 6.0 / 16.0, -4.0 / 16.0, 1.0 / 16.0];

/// A fourth-difference filter over five consecutive points of a run.
#[derive(Debug, Default)]
pub struct AlternatingComponent {
    points: VecDeque<Vec<f64>>,
}

impl AlternatingComponent {
    /// Takes the next point, and returns the largest entry of the alternating component at the point two
    /// steps before it; `None` for the first four points.
    pub fn amplitude(&mut self, q: &[f64]) -> Option<f64> {
        if self.points.len() == WEIGHTS.len() {
            self.points.pop_front();
        }
        self.points.push_back(q.to_vec());
        let weighted = || WEIGHTS.iter().zip(&self.points);
        let entry = |k: usize| weighted().fold(0.0, |sum, (weight, q)| sum + weight * q[k]);
        (self.points.len() == WEIGHTS.len()).then(|| largest((0..q.len()).map(|k| entry(k).abs())))
    }
}
