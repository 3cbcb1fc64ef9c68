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
}
