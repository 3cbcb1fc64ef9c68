//! The error function erf(x) = 2/√π ∫₀ˣ e^(−s²) ds, on every scalar.
//!
//! For |x| ≤ 1 it is its power series. Beyond, erf = 1 − erfc, where erfc is the trapezoidal rule for
//! ∫ e^(−s²)/(x² + s²) ds with the pole at s = ix taken out (Chiarella and Reichel 1968; Hunter and Regan
//! 1972): with steps of h = ½ its error is e^(−(π/h)²) < 10⁻¹⁷.
//! ```text
//! erfc(x) = (h·x/π)·e^(−x²)·(1/x² + 2·Σ e^(−(n·h)²)/(x² + (n·h)²)) − 2/(e^(2πx/h) − 1)
//! ```
//! Both parts are evaluated and one is chosen, so that there is no branch for lanes to diverge on. All
//! coefficients are computed by the compiler.

use core::f64::consts::{FRAC_2_SQRT_PI, PI};

use crate::Scalar;
use crate::scalar::Comparison;

/// Terms of the power series: the first that is left out is below 10⁻²⁰.
const TERMS: usize = 20;

/// Points of the trapezoidal rule: the first that is left out weighs less than 10⁻¹⁸.
const POINTS: usize = 13;

/// Beyond this, erf is 1 to the last digit of `f64`.
const LARGEST: f64 = 6.5;

/// (−1)ⁿ/(n!·(2n + 1)): erf(x) = 2/√π·x·Σ of these times x²ⁿ.
const SERIES: [f64; TERMS] = {
    let mut coefficients = [0.0; TERMS];
    let (mut n, mut factor) = (0, 1.0);
    while n < TERMS {
        coefficients[n] = factor / (2 * n + 1) as f64;
        n += 1;
        factor /= -(n as f64);
    }
    coefficients
};

/// 2·e^(−(n·h)²) for n = 1, 2, …, h = ½.
const WEIGHTS: [f64; POINTS] = {
    // e^(−¼), by its series; then e^(−n²/4) = e^(−(n−1)²/4)·e^(−(2n−1)/4).
    let (mut quarter, mut term, mut k) = (1.0, 1.0, 1);
    while k < 20 {
        term *= -0.25 / k as f64;
        quarter += term;
        k += 1;
    }
    let mut weights = [0.0; POINTS];
    let (mut n, mut weight, mut ratio) = (0, 2.0, quarter);
    while n < POINTS {
        weight *= ratio;
        ratio *= quarter * quarter;
        weights[n] = weight;
        n += 1;
    }
    weights
};

/// erf(x).
pub(crate) fn erf<T: Scalar>(x: T) -> T {
    let (zero, one, size) = (T::lift(0.0), T::lift(1.0), x.abs());
    // Not a number is on neither side of a comparison and stays what it is.
    let clamped = T::choose(size, Comparison::Greater, T::lift(LARGEST), T::lift(LARGEST), size);
    let clamped = T::choose(clamped, Comparison::Less, one, one, clamped);
    let far = one - complement(clamped);
    let far = T::choose(x, Comparison::Less, zero, -far, far);
    T::choose(size, Comparison::LessOrEqual, one, near(x), far)
}

fn near<T: Scalar>(x: T) -> T {
    let square = x * x;
    let sum = SERIES.iter().rev().fold(T::lift(0.0), |sum, c| sum * square + T::lift(*c));
    T::lift(FRAC_2_SQRT_PI) * x * sum
}

/// erfc(x) for 1 ≤ x ≤ [`LARGEST`].
fn complement<T: Scalar>(x: T) -> T {
    let (square, step) = (x * x, 0.5);
    let mut sum = T::lift(1.0) / square;
    for (n, weight) in WEIGHTS.iter().enumerate() {
        let node = step * (n + 1) as f64;
        sum += T::lift(*weight) / (square + T::lift(node * node));
    }
    let pole = T::lift(2.0) / (x * T::lift(2.0 * PI / step)).exp_m1();
    x * T::lift(step / PI) * (-square).exp() * sum - pole
}

#[cfg(test)]
mod tests {
    use super::erf;

    /// 2/√π·e^(−x²)·Σ 2ⁿx²ⁿ⁺¹/(2n + 1)!!: another series, in which no term is negative.
    fn by_positive_series(x: f64) -> f64 {
        let (mut term, mut sum, mut odd) = (x, x, 1.0);
        while term.abs() > f64::EPSILON * f64::EPSILON * sum.abs() {
            odd += 2.0;
            term *= 2.0 * x * x / odd;
            sum += term;
        }
        core::f64::consts::FRAC_2_SQRT_PI * (-x * x).exp() * sum
    }

    #[test]
    fn two_methods_agree_everywhere() {
        for step in -700..=700 {
            let x = f64::from(step) / 100.0;
            let (value, expected) = (erf(x), by_positive_series(x));
            // The rounding of x² in the exponential of the series counts x² times.
            let allowed = f64::EPSILON * (4.0 + x * x) * expected.abs();
            assert!((value - expected).abs() <= allowed, "erf({x}) = {value}, expected {expected}");
            assert!(value.abs() <= 1.0 + f64::EPSILON, "erf({x}) = {value}");
        }
    }

    /// Abramowitz and Stegun (1964), table 7.1, and the limits.
    #[test]
    fn tabulated_values_and_ends() {
        for (x, expected) in [(0.5_f64, 0.520_499_877_8_f64), (1.0, 0.842_700_792_9), (2.0, 0.995_322_265_0)]
        {
            assert!((erf(x) - expected).abs() < 0.6e-10, "erf({x})");
        }
        for x in [6.5, 30.0, 1e200, f64::INFINITY] {
            assert_eq!((erf(x), erf(-x)), (1.0, -1.0));
        }
        assert_eq!(erf(1e-300), 1e-300 * core::f64::consts::FRAC_2_SQRT_PI);
        assert_eq!(erf(0.0), 0.0);
        assert!(erf(f64::NAN).is_nan());
        assert!((erf(0.7_f32) - erf(0.7_f64) as f32).abs() < 2.0 * f32::EPSILON);
    }
}
