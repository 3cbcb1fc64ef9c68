//! Kepler's problem with its exact solution, and the outer solar system with data of September 5, 1994.

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
        distance(self.position(t), q)
    }

    /// The same along a run, in less time: `last` is the phase of the step before.
    pub fn error_after(self, last: &mut Phase, t: f64, q: &[f64]) -> f64 {
        let t = within_half_an_orbit(t);
        // Ė = 1/(1 − e cos E), Ë = −e sin E Ė³
        let Phase { anomaly, sine, rate, .. } = *last;
        let advance = (t - last.t) * rate;
        let guess = anomaly + advance * (1.0 - 0.5 * self.e * sine * rate * advance);
        *last = self.phase(t, guess);
        distance(self.position_in(*last), q)
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
        let (mut sine, mut cosine) = (0.0, 1.0);
        for _ in 0..60 {
            (sine, cosine) = anomaly.sin_cos();
            let excess = anomaly - e * sine - m;
            if excess > 0.0 {
                high = anomaly;
            } else {
                low = anomaly;
            }
            let newton = anomaly - excess / (1.0 - e * cosine);
            let next = if (low..=high).contains(&newton) { newton } else { 0.5 * (low + high) };
            let change = next - anomaly;
            anomaly = next;
            (sine, cosine) = (sine + cosine * change, cosine - sine * change);
            // After so small a change the next one is lost in rounding, and so is its square.
            if change.abs() <= 1e-9 * anomaly {
                break;
            }
        }
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

fn distance([x, y]: [f64; 2], q: &[f64]) -> f64 {
    ((q[0] - x).powi(2) + (q[1] - y).powi(2)).sqrt()
}

fn within_half_an_orbit(t: f64) -> f64 {
    t - TAU * (t / TAU).round()
}

/// Bodies that attract each other by Newton's law.
#[lagrangian(
    coordinates(r[N][3]),
    lagrangian = sum(0..N, |j| mass[j] * dot(r[j]).norm_squared()) / 2.0
        + g * sum_pairs(0..N, |j, k| mass[j] * mass[k] / (r[j] - r[k]).norm()),
    momenta(
        p_x = sum(0..N, |j| mass[j] * dot(r[j][0])),
        p_y = sum(0..N, |j| mass[j] * dot(r[j][1])),
        p_z = sum(0..N, |j| mass[j] * dot(r[j][2])),
        l_z = sum(0..N, |j| mass[j] * r[j].cross(dot(r[j])))[2],
    ),
)]
#[derive(Clone, Debug, PartialEq)]
pub struct Bodies<const N: usize> {
    pub g: f64,
    pub mass: [f64; N],
}

/// The sun, Jupiter, Saturn, Uranus, Neptune and Pluto.
pub type OuterSolarSystem = Bodies<6>;
pub type OuterPlanets = BodiesState<6>;

/// The outer solar system in astronomical units, days and masses of the sun, on September 5, 1994, at 0h00.
/// The inner planets are counted with the sun (Hairer, Lubich & Wanner 2006, section I.2.4 and table I.2.2).
#[rustfmt::skip]
pub fn outer_solar_system() -> (OuterSolarSystem, OuterPlanets) {
    let system = Bodies {
        g: 2.959_122_082_86e-4,
        mass: [
            1.000_005_976_82,
            9.547_861_040_43e-4,
            2.855_837_331_51e-4,
            4.372_731_645_46e-5,
            5.177_591_384_49e-5,
            1.0 / 1.3e8,
        ],
    };
    let start = BodiesState {
        r: [
            [0.0; 3],
            [ -3.502_365_3,  -3.816_984_7,  -1.550_796_3],
            [  9.075_531_4,  -3.045_835_3,  -1.648_370_8],
            [  8.310_142_0, -16.290_108_6,  -7.252_127_8],
            [ 11.470_766_6, -25.729_482_9, -10.816_945_6],
            [-15.538_735_7, -25.222_559_4,  -3.190_238_2],
        ],
        dot_r: [
            [0.0; 3],
            [0.005_654_29, -0.004_124_90, -0.001_905_89],
            [0.001_683_18,  0.004_835_25,  0.001_924_62],
            [0.003_541_78,  0.001_371_02,  0.000_550_29],
            [0.002_889_30,  0.001_145_27,  0.000_396_77],
            [0.002_767_25, -0.001_707_02, -0.001_365_04],
        ],
    };
    (system, start)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The period of planet `j` if there were but the sun and it: 2π √(a³/μ), 1/a = 2/r − v²/μ.
    fn period(j: usize) -> f64 {
        let (Bodies { g, mass }, at) = outer_solar_system();
        let square = |of: [[f64; 3]; 6]| (0..3).map(|axis| (of[j][axis] - of[0][axis]).powi(2)).sum::<f64>();
        let mu = g * (mass[0] + mass[j]);
        let inverse = 2.0 / square(at.r).sqrt() - square(at.dot_r) / mu;
        TAU / (mu * inverse.powi(3)).sqrt()
    }

    #[test]
    fn the_planets_have_their_periods() {
        // In days (NASA planetary fact sheet). The sun goes around the centre of mass with Jupiter, by which
        // the orbit of a planet around the sun alone changes, and most that of Pluto.
        let bounds = [0.01, 0.01, 0.01, 0.01, 0.02];
        let days = [4332.6, 10_759.2, 30_685.4, 60_189.0, 90_560.0];
        for (j, (days, bound)) in (1..).zip(days.into_iter().zip(bounds)) {
            let relative = period(j) / days - 1.0;
            assert!(relative.abs() < bound, "planet {j}: {} days", period(j));
        }
    }
}
