//! The outer solar system: sun and planets that attract each other, with data of September 5, 1994.

use dvi_core::prelude::*;

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
    /// Newton's constant.
    pub g: f64,
    /// Masses.
    pub mass: [f64; N],
}

/// The sun, Jupiter, Saturn, Uranus, Neptune and Pluto.
pub type OuterSolarSystem = Bodies<6>;
/// A state of these.
pub type OuterPlanets = BodiesState<6>;

/// The outer solar system in astronomical units, days and masses of the sun, on September 5, 1994, at 0h00.
/// The inner planets are counted with the sun (Hairer, Lubich & Wanner 2006, section I.2.4 and table I.2.2).
#[rustfmt::skip]
pub fn outer_solar_system() -> (OuterSolarSystem, OuterPlanets) {
    let system = Bodies {
        g: 2.959_122_082_86e-4,
        mass: [1.000_005_976_82, 9.547_861_040_43e-4, 2.855_837_331_51e-4, 4.372_731_645_46e-5, 5.177_591_384_49e-5, 1.0 / 1.3e8],
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
    use core::f64::consts::TAU;

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
        let within = [
            (1, 4332.6, 0.01),
            (2, 10_759.2, 0.01),
            (3, 30_685.4, 0.01),
            (4, 60_189.0, 0.01),
            (5, 90_560.0, 0.02),
        ];
        for (j, days, bound) in within {
            let relative = period(j) / days - 1.0;
            assert!(relative.abs() < bound, "planet {j}: {} days", period(j));
        }
    }

    #[test]
    fn the_energy_is_that_of_the_formula() {
        let (system, at) = outer_solar_system();
        let Bodies { g, mass } = &system;
        let mut energy = 0.0;
        for j in 0..6 {
            energy += 0.5 * mass[j] * at.dot_r[j].iter().map(|v| v * v).sum::<f64>();
            for k in 0..j {
                let square = (0..3).map(|axis| (at.r[j][axis] - at.r[k][axis]).powi(2)).sum::<f64>();
                energy -= g * mass[j] * mass[k] / square.sqrt();
            }
        }
        let generated = system.energy_at(&at).expect("defined");
        assert!((generated / energy - 1.0).abs() < 1e-14, "{generated} and {energy}");
    }
}
