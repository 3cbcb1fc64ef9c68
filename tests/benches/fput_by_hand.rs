//! The chain of Fermi, Pasta, Ulam and Tsingou by hand: its force, and an iteration of the midpoint rule.

const LANES: usize = 8;

/// −∂V/∂q of masses between walls.
pub(crate) fn force(alpha: f64, q: &[f64], force: &mut [f64]) {
    let between = |before: f64, at: f64, after: f64| {
        let (left, right) = (at - before, after - at);
        (right - left) * (1.0 + alpha * (left + right))
    };
    let last = q.len() - 1;
    force[0] = between(0.0, q[0], q[1]);
    force[last] = between(q[last - 1], q[last], 0.0);
    for (q, force) in q.windows(3).zip(&mut force[1..last]) {
        *force = between(q[0], q[1], q[2]);
    }
}

/// The point in the middle of a step, m = q + h/2 p + h²/4 f(m), as it is iterated.
pub(crate) struct Midpoint {
    alpha: f64,
    /// h²/4
    factor: f64,
    /// q + h/2 p
    fixed: Vec<f64>,
    middle: Vec<f64>,
    force: Vec<f64>,
}

impl Midpoint {
    pub(crate) fn new(alpha: f64, h: f64, q: &[f64], p: &[f64]) -> Self {
        let fixed: Vec<f64> = q.iter().zip(p).map(|(q, p)| q + 0.5 * h * p).collect();
        Self { alpha, factor: 0.25 * h * h, middle: fixed.clone(), force: vec![0.0; q.len()], fixed }
    }

    /// Iterates once, and returns the largest change.
    pub(crate) fn improve(&mut self) -> f64 {
        force(self.alpha, &self.middle, &mut self.force);
        let mut largest = [0.0; LANES];
        let packs =
            self.middle.chunks_mut(LANES).zip(self.fixed.chunks(LANES)).zip(self.force.chunks(LANES));
        for ((middle, fixed), force) in packs {
            for (lane, middle) in middle.iter_mut().enumerate() {
                let next = fixed[lane] + self.factor * force[lane];
                let change = (next - *middle).abs();
                largest[lane] = if change > largest[lane] { change } else { largest[lane] };
                *middle = next;
            }
        }
        largest.into_iter().fold(0.0, f64::max)
    }
}
