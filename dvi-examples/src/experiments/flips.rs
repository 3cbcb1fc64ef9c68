//! How often a free body turns over: the closed form, and runs.
//!
//! Rotation about the axis of the middle moment of inertia is unstable: the body turns over and back, in a
//! period that grows with the logarithm of the nearness to the axis (Landau & Lifshitz 1976, section 37).

use super::elliptic::Elliptic;
use super::geodesics::{Shadow, crossing};
use crate::vocabulary::*;

pub const BODY: RigidBody = RigidBody { inertia: [1.0, 2.0, 3.0] };
/// Close to the middle axis; the first component is zero where the second is largest.
pub const OMEGA: [f64; 3] = [0.0, 1.0, 0.02];

pub fn begin() -> RigidBodyState {
    RigidBody::turning(OMEGA)
}

/// ω₂ = Ω sn(λt + K), which is Ω at t = 0 (Landau & Lifshitz 1976, section 37).
#[derive(Clone, Copy)]
pub struct Wave {
    /// Ω
    amplitude: f64,
    /// λ
    rate: f64,
    functions: Elliptic,
}

impl Wave {
    /// Of a body with growing moments that begins with ω₁ = 0, so close to the second axis that I₃ω₃ takes
    /// it around the third.
    pub fn new(body: &RigidBody, omega: [f64; 3]) -> Self {
        let [a, b, c] = body.inertia;
        let [_, y, z] = omega.map(|x| x * x);
        // With M² = I₂²ω₂² + I₃²ω₃² and 2E = I₂ω₂² + I₃ω₃²: M² − 2E I₁, 2E I₃ − M² and M² − 2E I₂, without
        // differences of large numbers.
        let above = b * (b - a) * y + c * (c - a) * z;
        let below = b * (c - b) * y;
        let apart = c * (c - b) * z;
        let divisor = (c - b) * above;
        Self {
            amplitude: (below / (b * (c - b))).sqrt(),
            rate: (divisor / (a * b * c)).sqrt(),
            functions: Elliptic {
                modulus: ((b - a) * below / divisor).sqrt(),
                complementary: ((c - a) * apart / divisor).sqrt(),
            },
        }
    }

    /// The time of two flips.
    pub fn period(&self) -> f64 {
        4.0 * self.functions.quarter() / self.rate
    }

    /// ω₂ at time t.
    pub fn at(&self, t: f64) -> f64 {
        self.amplitude * self.functions.sn(self.rate * t + self.functions.quarter())
    }
}

/// The flips between the steps of a run with steps of one length.
pub struct Flips {
    pub h: f64,
    /// The mean time of two flips.
    pub period: f64,
    /// How often ω₂ changes its sign.
    pub count: u32,
    /// The largest difference of ω₂ from the closed form in the first period.
    pub error: f64,
    pub energy: Shadow,
}

impl Flips {
    pub fn new(wave: &Wave, h: f64, periods: f64) -> Result<Self> {
        let start = begin();
        let mut run = Problem::new(&BODY, start).run(Geodesic::trapezoid(), h)?;
        let mut energy = Shadow::new(h, run.energy(), BODY.shift(&start));
        let (mut before, mut times, mut error) = ([start.omega_R[1], 0.0], Vec::new(), 0.0);
        for _ in 0..(periods * wave.period() / h) as u64 {
            let t = run.time();
            run.advance()?;
            let state = run.state();
            let now = [state.omega_R[1], BODY.acceleration(state.omega_R)[1]];
            if before[0] * now[0] < 0.0 {
                times.push(t + h * crossing(before, now, h));
            }
            if run.time() < wave.period() {
                error = larger(error, (now[0] - wave.at(run.time())).abs());
            }
            energy.push(run.energy(), BODY.shift(&state));
            before = now;
        }
        let count = times.len();
        let between = times.last().zip(times.first()).map_or(f64::NAN, |(last, first)| last - first);
        Ok(Self { h, period: 2.0 * between / (count as f64 - 1.0), count: count as u32, error, energy })
    }
}

#[cfg(test)]
mod tests {
    use super::super::geodesics::reference;
    use super::*;

    #[test]
    fn the_closed_form_is_the_motion() {
        let wave = Wave::new(&BODY, OMEGA);
        let omega = reference(BODY, &begin(), [4.0, 2e-3])[10];
        assert!((wave.at(4.0) - omega).abs() < 1e-11);
        assert!((wave.at(0.0) - OMEGA[1]).abs() < 1e-15);
        assert!((wave.at(0.5 * wave.period()) + OMEGA[1]).abs() < 1e-13);
    }
}
