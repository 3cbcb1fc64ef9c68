//! Motion by hand: the equations of motion as they stand in textbooks, by the classical method of Runge and
//! Kutta with short steps.

use dvi_tests::oracle;
use dvi_tests::zoo::manifold::cross;

/// The state after `time`, by `steps` steps.
pub(crate) fn motion<const N: usize>(
    rates: impl Fn(&[f64; N]) -> [f64; N],
    start: [f64; N],
    time: f64,
    steps: u32,
) -> [f64; N] {
    let h = time / f64::from(steps);
    (0..steps).fold(start, |y, _| {
        let rates = |y: &[f64], _| rates(y.try_into().expect("as many numbers")).to_vec();
        oracle::runge_kutta(rates, &y, [0.0, h]).try_into().expect("as many numbers")
    })
}

/// Euler's equations of a heavy body for (R, ω): Ṙ = R ω̂ and 𝕀ω̇ = 𝕀ω × ω + tip × (−weight Rᵀe₃).
pub(crate) fn body(inertia: [f64; 3], tip: [f64; 3], weight: f64) -> impl Fn(&[f64; 12]) -> [f64; 12] {
    move |y| {
        let omega = [y[9], y[10], y[11]];
        let mut rates = [0.0; 12];
        for row in 0..3 {
            let r = [y[3 * row], y[3 * row + 1], y[3 * row + 2]];
            // The rows of R ω̂ are r × ω.
            rates[3 * row..3 * row + 3].copy_from_slice(&cross(r, omega));
        }
        let momentum = core::array::from_fn(|k| inertia[k] * omega[k]);
        let gyroscopic = cross(momentum, omega);
        let gravity = cross(tip, [0, 1, 2].map(|k| -weight * y[6 + k]));
        for k in 0..3 {
            rates[9 + k] = (gyroscopic[k] + gravity[k]) / inertia[k];
        }
        rates
    }
}

/// s̈ = −g e₃ − (|ṡ|² − g s₃) s for (s, ṡ).
pub(crate) fn pendulum(gravity: f64) -> impl Fn(&[f64; 6]) -> [f64; 6] {
    move |y| {
        let square = y[3] * y[3] + y[4] * y[4] + y[5] * y[5];
        let tension = square - gravity * y[2];
        [y[3], y[4], y[5], -tension * y[0], -tension * y[1], -gravity - tension * y[2]]
    }
}
