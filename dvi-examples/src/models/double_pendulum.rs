//! The double pendulum: a mass matrix that depends on the angles, and chaos.

use dvi_core::prelude::*;

/// Two pendulums of unit mass, the second hung from the first, in angles from the vertical.
#[lagrangian(
    coordinates(a, b),
    lagrangian = {
        let first = length * dot(a);
        let second = length * dot(b);
        let kinetic = first.powi(2) + second.powi(2) / 2.0 + first * second * (a - b).cos();
        kinetic + g * length * (2.0 * a.cos() + b.cos())
    },
)]
#[derive(Clone, Debug)]
pub struct DoublePendulum {
    /// The length of either rod.
    pub length: f64,
    /// Gravity.
    pub g: f64,
}

impl DoublePendulum {
    /// Where the lower mass is, x to the right and y upwards from the support.
    pub fn lower_mass(&self, &[a, b]: &[f64; 2]) -> [f64; 2] {
        [self.length * (a.sin() + b.sin()), -self.length * (a.cos() + b.cos())]
    }

    /// The rates of (a, b, a', b') in the motion, solved from 2a'' + b'' cos δ + b'² sin δ + 2(g/l) sin a =
    /// 0 and b'' + a'' cos δ − a'² sin δ + (g/l) sin b = 0, δ = a − b.
    pub fn motion(&self, &[a, b, da, db]: &[f64; 4]) -> [f64; 4] {
        let (sin, cos) = (a - b).sin_cos();
        let gravity = self.g / self.length;
        let first = -db * db * sin - 2.0 * gravity * a.sin();
        let second = da * da * sin - gravity * b.sin();
        let determinant = 2.0 - cos * cos;
        [da, db, (first - cos * second) / determinant, (2.0 * second - cos * first) / determinant]
    }

    /// The energy of (a, b, a', b').
    pub fn energy_of(&self, &[a, b, da, db]: &[f64; 4]) -> f64 {
        let Self { length, g } = self;
        length * length * (da * da + 0.5 * db * db + da * db * (a - b).cos())
            - g * length * (2.0 * a.cos() + b.cos())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_equations_by_hand_conserve_the_energy() {
        let (system, y) = (DoublePendulum { length: 1.0, g: 9.81 }, [0.3, -1.1, 2.0, -0.7]);
        let rates = system.motion(&y);
        let energy = |h: f64| system.energy_of(&std::array::from_fn(|i| y[i] + h * rates[i]));
        let rate = (energy(1e-5) - energy(-1e-5)) / 2e-5;
        assert!(rate.abs() < 1e-6, "{rate}");
    }
}
