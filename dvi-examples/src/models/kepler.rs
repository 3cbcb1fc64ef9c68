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
        let Self { e } = self;
        let [cos, sin] = self.anomaly(t);
        [cos - e, (1.0 - e * e).sqrt() * sin]
    }

    /// The distance of (x, y) from where the planet is at time `t`.
    pub fn error(self, t: f64, q: &[f64]) -> f64 {
        let [x, y] = self.position(t);
        (q[0] - x).hypot(q[1] - y)
    }

    /// Cosine and sine of the eccentric anomaly, by Newton's method inside of a bracket. It begins at the root of a
    /// cubic equation (Markley 1995, eq. 15–20), which is near enough for two or three iterations: long runs ask
    /// for the position after each step.
    fn anomaly(self, t: f64) -> [f64; 2] {
        let Self { e } = self;
        // On half an orbit, −π to π, the root lies between t and t + e in magnitude.
        let t = t - TAU * (t / TAU).round();
        let m = t.abs();
        let (mut low, mut high) = (m, (m + e).min(PI));
        let alpha = (3.0 * PI * PI + 1.6 * PI * (PI - m) / (1.0 + e)) / (PI * PI - 6.0);
        let d = 3.0 * (1.0 - e) + alpha * e;
        let (q, r) = (2.0 * alpha * d * (1.0 - e) - m * m, (3.0 * alpha * d * (d - 1.0 + e) + m * m) * m);
        let root = (r + (q.powi(3) + r * r).sqrt()).cbrt().powi(2);
        let start = (2.0 * r * root / (root * root + root * q + q * q) + m) / d;
        let mut anomaly = start.max(low).min(high);
        for _ in 0..60 {
            let excess = anomaly - e * anomaly.sin() - m;
            if excess > 0.0 {
                high = anomaly;
            } else {
                low = anomaly;
            }
            let newton = anomaly - excess / (1.0 - e * anomaly.cos());
            let next = if (low..=high).contains(&newton) { newton } else { 0.5 * (low + high) };
            let change = (next - anomaly).abs();
            anomaly = next;
            // What rounding leaves of the change need not become smaller.
            if change <= 4e-16 * anomaly {
                break;
            }
        }
        [anomaly.cos(), anomaly.sin().copysign(t)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_solve_kepler_s_equation() {
        for e in [0.0, 0.2, 0.95, 0.999] {
            let orbit = Orbit { e };
            for k in 0..1000 {
                let anomaly = TAU * f64::from(k) / 1000.0;
                let t = anomaly - e * anomaly.sin();
                let q = [anomaly.cos() - e, (1.0 - e * e).sqrt() * anomaly.sin()];
                assert!(orbit.error(t, &q) < 2e-14 / (1.0 - e), "e = {e}, t = {t}");
                // Times of this size are rounded to 1e-12.
                assert!(orbit.error(t + 1000.0 * TAU, &q) < 1e-11 / (1.0 - e), "e = {e}, t = {t}");
            }
        }
    }
}
