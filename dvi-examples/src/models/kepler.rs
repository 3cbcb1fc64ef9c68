//! Kepler's problem, and its exact solution.

use core::f64::consts::{PI, TAU};

use dvi_core::prelude::*;

/// A planet around a fixed sun, in units in which an orbit of semi-major axis 1 has the period 2π
/// (Kosmas & Vlachos, eq. 24).
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + 1.0 / (x * x + y * y).sqrt(),
    momenta(angular = x * dot(y) - y * dot(x)),
)]
#[derive(Clone, Copy, Debug)]
pub struct Kepler {}

/// Kepler's problem with q = u² as complex numbers and dt = |u|² ds (Levi-Civita 1920): at energy −½ an
/// oscillator of frequency ½, also through a collision.
#[lagrangian(
    coordinates(u[2]),
    lagrangian = (dot(u[0]).powi(2) + dot(u[1]).powi(2)) / 2.0 - (u[0].powi(2) + u[1].powi(2)) / 8.0,
)]
#[derive(Clone, Copy, Debug)]
pub struct LeviCivita {}

/// An orbit of semi-major axis 1 that is at its pericentre, on the positive x axis, at t = 0.
#[derive(Clone, Copy, Debug)]
pub struct Orbit {
    /// The eccentricity, 0 ≤ e < 1.
    pub e: f64,
}

impl Orbit {
    /// Position and velocity at t = 0 (eq. 25).
    pub fn pericentre(self) -> KeplerState {
        let Self { e } = self;
        KeplerState { x: 1.0 - e, y: 0.0, dot_x: 0.0, dot_y: ((1.0 + e) / (1.0 - e)).sqrt() }
    }

    /// The position at time `t`, by Kepler's equation E − e sin E = t.
    pub fn position(self, t: f64) -> [f64; 2] {
        let t = within_half_an_orbit(t);
        self.position_in(self.phase(t, t + 0.5 * self.e.copysign(t)))
    }

    /// The distance of (x, y) from where the planet is at time `t`.
    pub fn error(self, t: f64, q: &[f64]) -> f64 {
        let [x, y] = self.position(t);
        (q[0] - x).hypot(q[1] - y)
    }

    /// The same, in half of the time, along a run: `last` is the phase of the step before.
    pub fn error_after(self, last: &mut Phase, t: f64, q: &[f64]) -> f64 {
        let t = within_half_an_orbit(t);
        *last = self.phase(t, last.anomaly + (t - last.t) * last.rate);
        let [x, y] = self.position_in(*last);
        (q[0] - x).hypot(q[1] - y)
    }

    fn position_in(self, Phase { sine, cosine, .. }: Phase) -> [f64; 2] {
        [cosine - self.e, (1.0 - self.e * self.e).sqrt() * sine]
    }

    /// From a guess of the eccentric anomaly, by Newton's method inside of a bracket.
    fn phase(self, t: f64, guess: f64) -> Phase {
        let Self { e } = self;
        // On half an orbit, −π to π, the root lies between t and t + e in magnitude.
        let m = t.abs();
        let (mut low, mut high) = (m, (m + e).min(PI));
        let guess = guess.copysign(guess * t);
        let mut anomaly = if (low..high).contains(&guess) { guess } else { 0.5 * (low + high) };
        for _ in 0..60 {
            let (sine, cosine) = anomaly.sin_cos();
            let excess = anomaly - e * sine - m;
            if excess > 0.0 {
                high = anomaly;
            } else {
                low = anomaly;
            }
            let newton = anomaly - excess / (1.0 - e * cosine);
            let next = if (low..=high).contains(&newton) { newton } else { 0.5 * (low + high) };
            let change = (next - anomaly).abs();
            anomaly = next;
            // After so small a change the next one is lost in rounding.
            if change <= 1e-9 * anomaly {
                break;
            }
        }
        let (sine, cosine) = anomaly.sin_cos();
        Phase {
            t,
            anomaly: anomaly.copysign(t),
            sine: sine.copysign(t),
            cosine,
            rate: 1.0 / (1.0 - e * cosine),
        }
    }
}

/// A time within half an orbit of the pericentre, and the eccentric anomaly then.
#[derive(Clone, Copy, Debug, Default)]
pub struct Phase {
    t: f64,
    anomaly: f64,
    sine: f64,
    cosine: f64,
    rate: f64,
}

fn within_half_an_orbit(t: f64) -> f64 {
    t - TAU * (t / TAU).round()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_solve_kepler_s_equation() {
        for e in [0.0, 0.2, 0.95, 0.999] {
            let (orbit, mut phase) = (Orbit { e }, Phase::default());
            for k in 0..1000 {
                let anomaly = TAU * f64::from(k) / 1000.0;
                let t = anomaly - e * anomaly.sin();
                let q = [anomaly.cos() - e, (1.0 - e * e).sqrt() * anomaly.sin()];
                assert!(orbit.error(t, &q) < 2e-14 / (1.0 - e), "e = {e}, t = {t}");
                assert!(orbit.error_after(&mut phase, t, &q) < 2e-14 / (1.0 - e), "e = {e}, t = {t}");
                // Times of this size are rounded to 1e-12.
                assert!(orbit.error(t + 1000.0 * TAU, &q) < 1e-11 / (1.0 - e), "e = {e}, t = {t}");
            }
        }
    }
}
