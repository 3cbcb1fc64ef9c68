//! The motion between impacts by the classical Runge–Kutta method in short steps, and impacts by bisection.

use dvi_tests::oracle;

/// Equations of motion by hand.
pub(crate) trait ByHand<const N: usize> {
    fn acceleration(&self, q: [f64; N], v: [f64; N], t: f64) -> [f64; N];
    /// The least of all gaps.
    fn gap(&self, q: [f64; N], t: f64) -> f64;
    /// The velocity after an elastic impact at q.
    fn reflected(&self, q: [f64; N], v: [f64; N], t: f64) -> [f64; N];
}

fn step<const N: usize>(system: &impl ByHand<N>, state: [[f64; N]; 2], t: f64, h: f64) -> [[f64; N]; 2] {
    let halves = |y: &[f64]| [0, 1].map(|part| core::array::from_fn(|i| y[part * N + i]));
    let rates = |y: &[f64], t: f64| {
        let [q, v] = halves(y);
        [v, system.acceleration(q, v, t)].concat()
    };
    halves(&oracle::runge_kutta(rates, &state.concat(), [t, h]))
}

/// The state at `end` of the motion from `begin`, and how many impacts there were.
pub(crate) fn motion<const N: usize>(
    system: &impl ByHand<N>,
    mut state: [[f64; N]; 2],
    [begin, end]: [f64; 2],
    steps: u64,
) -> ([[f64; N]; 2], u64) {
    let (mut t, h, mut impacts) = (begin, (end - begin) / steps as f64, 0);
    for k in 1..=steps {
        let until = begin + k as f64 * h;
        loop {
            let next = step(system, state, t, until - t);
            if system.gap(next[0], until) >= 0.0 {
                (state, t) = (next, until);
                break;
            }
            let [mut open, mut closed] = [0.0, until - t];
            while open < 0.5 * (open + closed) && 0.5 * (open + closed) < closed {
                let middle = 0.5 * (open + closed);
                if system.gap(step(system, state, t, middle)[0], t + middle) >= 0.0 {
                    open = middle;
                } else {
                    closed = middle;
                }
            }
            let [q, v] = step(system, state, t, open);
            t += open;
            state = [q, system.reflected(q, v, t)];
            impacts += 1;
        }
    }
    (state, impacts)
}
