//! What tops and spherical pendulums have in common: heights between which they go up and down, and states
//! on a manifold.

use std::f64::consts::TAU;

use dvi_core::prelude::ManifoldLagrangian;

/// What the height u of a top depends on: (A u̇)² = (1 − u²) 2A(E − weight u) − (vertical − spin u)², by its
/// integrals (Goldstein 1980, section 5.7). A mass of 1 on a rod of length 1 has A = 1 and no spin.
#[derive(Clone, Copy, Debug)]
pub struct Heights {
    /// A, the moment of inertia across the axis.
    pub across: f64,
    /// The weight times the distance from the point of support.
    pub weight: f64,
    /// E, without the energy of the spin.
    pub energy: f64,
    /// The angular momentum about the axis.
    pub spin: f64,
    /// The angular momentum about the vertical.
    pub vertical: f64,
}

impl Heights {
    /// The roots of the cubic between −1 and 1, the lower one first. The third root is above 1, or is 1.
    pub fn extremes(&self) -> [f64; 2] {
        // u³ + a u² + b u + c = 0
        let Self { across, weight, energy, spin, vertical } = self;
        let leading = 2.0 * across * weight;
        let a = -(2.0 * across * energy + spin * spin) / leading;
        let b = (2.0 * spin * vertical - leading) / leading;
        let c = (2.0 * across * energy - vertical * vertical) / leading;
        // Viète: three real roots −a/3 + 2r cos((φ + 2πk)/3), the largest with k = 0.
        let r = ((a * a - 3.0 * b) / 9.0).max(0.0).sqrt();
        let cosine = -(2.0 * a.powi(3) - 9.0 * a * b + 27.0 * c) / (54.0 * r.powi(3));
        let phi = cosine.clamp(-1.0, 1.0).acos();
        [1.0, 2.0].map(|k| self.polished(2.0 * r * ((phi + TAU * k) / 3.0).cos() - a / 3.0))
    }

    /// Newton's method from a root up to rounding.
    fn polished(&self, mut u: f64) -> f64 {
        for _ in 0..3 {
            let change = self.value(u) / self.slope(u);
            if change.is_finite() {
                u -= change;
            }
        }
        u
    }

    /// How much the energy changes with an extreme that is near `u`, for the same momenta.
    pub fn stiffness(&self, u: f64) -> f64 {
        // The cubic is 2A (1 − u²) (E − V(u)), and V(u) = E at its roots.
        -self.slope(u) / (2.0 * self.across * (1.0 - u * u))
    }

    fn value(&self, u: f64) -> f64 {
        let turning = self.vertical - self.spin * u;
        (1.0 - u * u) * 2.0 * self.across * (self.energy - self.weight * u) - turning * turning
    }

    fn slope(&self, u: f64) -> f64 {
        let kinetic = self.energy - self.weight * u;
        let turning = self.vertical - self.spin * u;
        2.0 * self.spin * turning - 2.0 * self.across * (2.0 * u * kinetic + (1.0 - u * u) * self.weight)
    }
}

/// A system on a manifold whose states are so many numbers, for methods that know nothing of the manifold.
pub trait OnManifold<const D: usize>: ManifoldLagrangian + Copy {
    /// The entries of a state, coordinates first.
    fn entries(state: &Self::State<f64>) -> [f64; D];

    /// The state with these entries.
    fn state(y: &[f64; D]) -> Self::State<f64>;

    /// The rates of the entries in the motion.
    fn motion(&self, y: &[f64; D]) -> [f64; D];
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extremes_are_roots_between_which_the_cubic_is_positive() {
        for (energy, spin, vertical) in [(1.1, 2.5, 2.2), (0.9, 1.0, -0.4), (0.3, 0.0, 0.5), (5.0, 3.0, 1.0)]
        {
            let heights = Heights { across: 1.3, weight: 0.8, energy, spin, vertical };
            let [low, high] = heights.extremes();
            assert!(-1.0 < low && low < high && high < 1.0, "{heights:?}: {low}, {high}");
            assert!(heights.value(low).abs() < 1e-14 && heights.value(high).abs() < 1e-14);
            assert!(heights.value(0.5 * (low + high)) > 0.0);
        }
    }

    #[test]
    fn the_stiffness_is_the_change_of_the_energy_with_an_extreme() {
        let heights = Heights { across: 1.3, weight: 0.8, energy: 1.1, spin: 2.5, vertical: 2.2 };
        let more = Heights { energy: 1.1 + 1e-6, ..heights };
        for (before, after) in heights.extremes().into_iter().zip(more.extremes()) {
            let middle = 0.5 * (before + after);
            assert!((heights.stiffness(middle) * (after - before) / 1e-6 - 1.0).abs() < 1e-5);
        }
    }
}
