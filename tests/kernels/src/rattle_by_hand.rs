//! RATTLE on a sphere, L = Σ (m vᵢ² − kᵢ rᵢ²)/2 and |r| = 1, by hand, with the guess and the criterion of
//! the library.

use super::predators_by_hand::Tolerance;

pub(crate) struct Rattle {
    h: f64,
    m: f64,
    k: [f64; 3],
    pub(crate) r: [f64; 3],
    p: [f64; 3],
    /// ι0 of the last step; the force of the constraint is 2ι r.
    impulse: f64,
}

impl Rattle {
    pub(crate) fn new(h: f64, (m, k): (f64, [f64; 3]), r: [f64; 3], v: [f64; 3]) -> Self {
        Self { h, m, k, r, p: v.map(|v| m * v), impulse: 0.0 }
    }

    #[inline(always)]
    pub(crate) fn step(&mut self) {
        let Self { h, m, k, r: start, p, mut impulse } = *self;
        let (half, drift) = (-0.5 * h, h / m);
        let p = [0, 1, 2].map(|i| p[i] + half * k[i] * start[i]);
        let mut increment = [0, 1, 2].map(|i| drift * (p[i] + 2.0 * impulse * start[i]));
        let mut tolerance = Tolerance::new(largest(start) + largest(increment));
        let end = loop {
            let r = [0, 1, 2].map(|i| start[i] + increment[i]);
            let change = (dot(r, r) - 1.0) / (4.0 * drift * dot(r, start));
            impulse -= change;
            let change = [0, 1, 2].map(|i| -2.0 * drift * change * start[i]);
            increment = [0, 1, 2].map(|i| increment[i] + change[i]);
            if tolerance.is_met(largest(change)) {
                break [0, 1, 2].map(|i| start[i] + increment[i]);
            }
        };
        let p = [0, 1, 2].map(|i| p[i] + 2.0 * impulse * start[i] + half * k[i] * end[i]);
        let across = dot(end, p) / dot(end, end);
        *self = Self { h, m, k, r: end, p: [0, 1, 2].map(|i| p[i] - across * end[i]), impulse };
    }
}

#[inline(always)]
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn largest(a: [f64; 3]) -> f64 {
    a.into_iter().map(f64::abs).fold(0.0, f64::max)
}
