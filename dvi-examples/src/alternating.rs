//! The part of an orbit that changes sign from step to step: the parasitic mode in q.
//!
//! d_k = (q_{k−2} − 4q_{k−1} + 6q_k − 4q_{k+1} + q_{k+2})/16. On (−1)ᵏa the filter gives (−1)ᵏa; on a
//! smooth orbit it leaves (h⁴/16) q⁗, and on cubics nothing.

use std::collections::VecDeque;

const WEIGHTS: [f64; 5] = [1.0 / 16.0, -4.0 / 16.0, 6.0 / 16.0, -4.0 / 16.0, 1.0 / 16.0];

/// A fourth-difference filter over five consecutive points of a run.
#[derive(Debug, Default)]
pub struct AlternatingComponent {
    points: VecDeque<Vec<f64>>,
}

impl AlternatingComponent {
    /// Takes the next point, and returns the alternating component at the point two steps before it; `None`
    /// for the first four points.
    pub fn push(&mut self, q: &[f64]) -> Option<Vec<f64>> {
        if self.points.len() == WEIGHTS.len() {
            self.points.pop_front();
        }
        self.points.push_back(q.to_vec());
        let weighted = || WEIGHTS.iter().zip(&self.points);
        let entry = |k: usize| weighted().fold(0.0, |sum, (weight, q)| sum + weight * q[k]);
        (self.points.len() == WEIGHTS.len()).then(|| (0..q.len()).map(entry).collect())
    }

    /// Takes the next point, and returns the largest entry of the alternating component.
    pub fn amplitude(&mut self, q: &[f64]) -> Option<f64> {
        let larger = |a: f64, b: f64| if b.abs() > a || b.is_nan() { b.abs() } else { a };
        self.push(q).map(|component| component.into_iter().fold(0.0, larger))
    }
}
