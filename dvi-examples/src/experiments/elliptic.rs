//! Elliptic functions by the arithmetic–geometric mean (Abramowitz & Stegun 1964, sections 16.4 and 17.6).

use std::f64::consts::FRAC_PI_2;

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

#[cfg(test)]
mod tests {
    use super::*;

    fn with(complementary: f64) -> Elliptic {
        Elliptic { modulus: (1.0 - complementary * complementary).sqrt(), complementary }
    }

    /// ∫₀^π/2 dθ/√(1 − k² sin² θ) by the trapezoidal rule, which is exact to rounding for periodic
    /// functions.
    #[test]
    fn the_quarter_period_is_the_integral() {
        for complementary in [0.9, 0.3, 0.05] {
            let elliptic = with(complementary);
            let count = 1000;
            let value = |i: u32| {
                let sine = (std::f64::consts::PI * f64::from(i) / f64::from(count)).sin();
                1.0 / (1.0 - (elliptic.modulus * sine).powi(2)).sqrt()
            };
            let integral = FRAC_PI_2 / f64::from(count) * (0..count).map(value).sum::<f64>();
            assert!((elliptic.quarter() / integral - 1.0).abs() < 1e-14);
        }
    }

    /// sn' = √((1 − sn²)(1 − k² sn²)) up to the first maximum, which is at K.
    #[test]
    fn sn_solves_its_equation() {
        for complementary in [0.9, 0.3, 0.01] {
            let elliptic = with(complementary);
            assert!((elliptic.sn(elliptic.quarter()) - 1.0).abs() < 1e-15);
            for part in [0.1, 0.5, 0.8] {
                let u = part * elliptic.quarter();
                let rate = (elliptic.sn(u + 1e-5) - elliptic.sn(u - 1e-5)) / 2e-5;
                let square = elliptic.sn(u).powi(2);
                let expected = ((1.0 - square) * (1.0 - elliptic.modulus.powi(2) * square)).sqrt();
                assert!((rate - expected).abs() < 1e-9, "{complementary}, {part}");
            }
        }
    }
}
