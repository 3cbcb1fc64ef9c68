//! The part of an orbit that changes sign from step to step: the parasitic mode in q.
//!
//! d_k = (q_{k−2} − 4q_{k−1} + 6q_k − 4q_{k+1} + q_{k+2})/16. On (−1)ᵏa the filter gives (−1)ᵏa; on a
//! smooth orbit it leaves (h⁴/16) q⁗, and on cubics nothing.

use crate::scalar::norm;
use crate::{Lagrangian, Real, Space, System, Vector};

const WINDOW: usize = 5;
const WEIGHTS: [f64; WINDOW] = [1.0 / 16.0, -4.0 / 16.0, 6.0 / 16.0, -4.0 / 16.0, 1.0 / 16.0];

/// A fourth-difference filter over five consecutive points of a run.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// // A straight path with a part that alternates between 0.01 and −0.01 on it.
/// let mut filter = AlternatingComponent::new(&Pendulum);
/// let mut found = None;
/// for k in 0..5 {
///     let alternating = if k % 2 == 0 { 0.01 } else { -0.01 };
///     found = filter.amplitude(&[0.3 * f64::from(k) + alternating]);
/// }
/// assert!((found.unwrap() - 0.01).abs() < 1e-15);
/// ```
#[derive(Debug)]
pub struct AlternatingComponent<S: System, T: Real = f64> {
    ring: [Vector<S, T>; WINDOW],
    filtered: Vector<S, T>,
    seen: usize,
}

impl<S: Lagrangian<T>, T: Real> AlternatingComponent<S, T> {
    /// A filter for the points of `system` that has seen none.
    pub fn new(system: &S) -> Self {
        let space = system.space();
        Self { ring: space.vectors(), filtered: space.vector(), seen: 0 }
    }

    /// Takes the next point, as [`Run::q`](crate::run::Run::q) gives it, and returns the
    /// alternating component at the point two steps before it, one entry per coordinate; `None` for the
    /// first four points.
    pub fn push(&mut self, q: &[T]) -> Option<&[T]> {
        for (kept, &q) in self.ring[self.seen % WINDOW].iter_mut().zip(q) {
            *kept = q;
        }
        self.seen += 1;
        if self.seen < WINDOW {
            return None;
        }
        self.filtered.fill(T::lift(0.0));
        for (i, &weight) in WEIGHTS.iter().enumerate() {
            // `seen` is one past the newest point, so it is the place of the oldest.
            let point = &self.ring[(self.seen + i) % WINDOW];
            for (sum, &q) in self.filtered.iter_mut().zip(point.iter()) {
                *sum += T::lift(weight) * q;
            }
        }
        Some(&self.filtered)
    }

    /// Takes the next point and returns the largest entry of the alternating component.
    pub fn amplitude(&mut self, q: &[T]) -> Option<T> {
        self.push(q).map(norm::largest)
    }
}
