//! How often a free body turns over: the closed form, and runs.
//!
//! Rotation about the axis of the middle moment of inertia is unstable: the body turns over and back, in a
//! period that grows with the logarithm of the nearness to the axis (Landau & Lifshitz 1976, section 37).

use super::geodesics::Shadow;
use super::turnings::crossing;
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
    amplitude: f64,
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

    pub fn at(&self, t: f64) -> f64 {
        self.amplitude * self.functions.sn(self.rate * t + self.functions.quarter())
    }
}

/// The flips between the steps of a run with steps of one length.
pub struct Flips {
    pub h: f64,
    pub period: f64,
    /// How often ω₂ changes its sign.
    pub count: u32,
    /// The largest difference of ω₂ from the closed form in the first period.
    pub error: f64,
    pub energy: Shadow,
}

impl Flips {
    pub fn new(wave: &Wave, h: f64, periods: f64) -> Result<Self> {
        let mut run = Problem::new(&BODY, begin()).run(Geodesic::trapezoid(), h)?;
        let steps = (periods * wave.period() / h) as u64;
        let all = course(&mut run, steps, |run| (run.time(), run.state(), run.energy()))?;
        // ω₂ with its rate.
        let middle = |state: &RigidBodyState| [state.omega_R[1], BODY.acceleration(state.omega_R)[1]];
        let flips = all.iter().zip(&all[1..]).filter_map(|((t, before, _), (_, now, _))| {
            let [before, now] = [before, now].map(middle);
            (before[0] * now[0] < 0.0).then(|| t + h * crossing(before, now, h))
        });
        let times: Vec<f64> = flips.collect();
        let first = all.iter().take_while(|(t, ..)| *t < wave.period());
        let error = largest(first.map(|(t, state, _)| (state.omega_R[1] - wave.at(*t)).abs()));
        let energy = Shadow::of(h, all.iter().map(|(_, state, energy)| [*energy, BODY.shift(state)]));
        let count = times.len();
        let between = times.last().zip(times.first()).map_or(f64::NAN, |(last, first)| last - first);
        Ok(Self { h, period: 2.0 * between / (count as f64 - 1.0), count: count as u32, error, energy })
    }
}

/// Elliptic functions by the arithmetic–geometric mean (Abramowitz & Stegun 1964, sections 16.4 and 17.6).
#[derive(Clone, Copy)]
pub struct Elliptic {
    /// k and √(1 − k²), each to its own rounding.
    pub modulus: f64,
    pub complementary: f64,
}

/// Means after which a is b up to rounding, for all k up to 1 − 10⁻¹².
const MEANS: usize = 8;

impl Elliptic {
    /// The means aₙ with cₙ = (aₙ₋₁ − bₙ₋₁)/2.
    fn means(&self) -> [[f64; 2]; MEANS] {
        let (mut a, mut b, mut c) = (1.0_f64, self.complementary, self.modulus);
        std::array::from_fn(|n| {
            if n > 0 {
                (a, b, c) = (0.5 * (a + b), (a * b).sqrt(), 0.5 * (a - b));
            }
            [a, c]
        })
    }

    /// The quarter of a period, K.
    pub fn quarter(&self) -> f64 {
        FRAC_PI_2 / self.means()[MEANS - 1][0]
    }

    pub fn sn(&self, u: f64) -> f64 {
        let means = self.means();
        let mut phi = 2f64.powi(MEANS as i32 - 1) * means[MEANS - 1][0] * u;
        for [a, c] in means.into_iter().skip(1).rev() {
            phi = 0.5 * (phi + (c / a * phi.sin()).asin());
        }
        phi.sin()
    }
}
