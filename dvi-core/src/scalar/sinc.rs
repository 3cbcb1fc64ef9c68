//! λₙ(x) = jₙ(x)/xⁿ for the spherical Bessel functions j₀ to j₃, on every scalar: sinc x = λ₀, and λₙ' =
//! −xλₙ₊₁ (Abramowitz & Stegun 1964, 10.1.2, 10.1.19 and 10.1.24).
//!
//! For |x| ≤ 2 it is the power series, beyond that the recursion from λ₋₁ = cos x, which loses digits
//! near 0. Both are evaluated and one is chosen, so that there is no branch for lanes to diverge on.

use crate::Scalar;
use crate::scalar::Comparison;

/// Terms of the power series: the first that is left out is below 10⁻²⁰ for |x| ≤ 2.
const TERMS: usize = 14;

/// λ_N(x).
pub(crate) fn bessel<const N: usize, T: Scalar>(x: T) -> T {
    T::choose(x.abs(), Comparison::LessOrEqual, T::lift(2.0), near::<N, T>(x), far::<N, T>(x))
}

/// Σ (−x²/2)ᵏ/(k!·(2n + 2k + 1)!!)
fn near<const N: usize, T: Scalar>(x: T) -> T {
    let square = x * x;
    // The ratio of term k to the one before is −x²/(2k·(2n + 2k + 1)).
    let sum = (1..TERMS).rev().fold(T::lift(1.0), |sum, k| {
        T::lift(1.0) - square * sum / T::lift((2 * k * (2 * N + 2 * k + 1)) as f64)
    });
    let first: usize = (1..=N).map(|k| 2 * k + 1).product();
    sum / T::lift(first as f64)
}

/// λₙ₊₁ = ((2n + 1)λₙ − λₙ₋₁)/x²
fn far<const N: usize, T: Scalar>(x: T) -> T {
    let square = x * x;
    let (mut before, mut value) = (x.cos(), x.sin() / x);
    for n in 0..N {
        (before, value) = (value, (T::lift((2 * n + 1) as f64) * value - before) / square);
    }
    value
}

#[cfg(test)]
mod tests {
    use super::{bessel, far, near};

    #[test]
    fn both_ways_agree_where_they_meet() {
        for step in -40..=40 {
            let x = f64::from(step) / 40.0 + 2.0;
            let pairs = [
                (near::<0, f64>(x), far::<0, f64>(x)),
                (near::<1, f64>(x), far::<1, f64>(x)),
                (near::<2, f64>(x), far::<2, f64>(x)),
                (near::<3, f64>(x), far::<3, f64>(x)),
            ];
            for (n, (near, far)) in pairs.into_iter().enumerate() {
                assert!((near - far).abs() < 4e-15, "λ{n}({x}) = {near} or {far}");
            }
        }
    }

    /// Abramowitz and Stegun (1964), table 10.1; and the ends.
    #[test]
    fn tabulated_values_and_ends() {
        let x = 1.0_f64;
        for (value, expected) in [
            (bessel::<0, f64>(x), 0.841_470_985),
            (bessel::<1, f64>(x), 0.301_168_679),
            (bessel::<2, f64>(x), 0.062_035_052),
            (bessel::<3, f64>(x), 0.009_006_581),
            (bessel::<0, f64>(10.0), -0.054_402_111),
            (bessel::<1, f64>(10.0) * 10.0, 0.078_466_942),
            (bessel::<2, f64>(10.0) * 100.0, 0.077_942_194),
        ] {
            assert!((value - expected).abs() < 1e-9, "{value} {expected}");
        }
        assert_eq!((bessel::<0, f64>(0.0), bessel::<0, f64>(1e-200)), (1.0, 1.0));
        assert_eq!((bessel::<1, f64>(0.0), bessel::<2, f64>(0.0)), (1.0 / 3.0, 1.0 / 15.0));
        assert!(bessel::<0, f64>(f64::NAN).is_nan());
        assert!(bessel::<2, f64>(1e300).abs() < 1e-300);
        assert!((bessel::<0, f32>(0.7) - bessel::<0, f64>(0.7) as f32).abs() < 2.0 * f32::EPSILON);
    }
}
