//! The interpolation between two points by the solutions of an oscillator.
//!
//! q(c) = b q0 + b̄ q1, q̇(c) = (B q0 + B̄ q1)/h with (Kosmas & Vlachos, eqs. 11 and 15), for u = ωh and z = u²,
//!
//! b = (1−c) σ((1−c)²z)/σ(z)    b̄ = c σ(c²z)/σ(z)    B = −κ((1−c)²z)/σ(z)    B̄ = κ(c²z)/σ(z)
//!
//! where κ(z) = cos √z and σ(z) = sin √z/√z are entire functions of z. So z = 0, linear interpolation, is no
//! special case, and nothing cancels near it; only the derivative σ' = (κ − σ)/(2z) needs its series there.

use crate::quadrature::Quadrature;
use crate::{Real, Scalar};

/// The coefficients of one node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Basis<T> {
    pub(crate) b: T,
    pub(crate) b_bar: T,
    pub(crate) d: T,
    pub(crate) d_bar: T,
}

/// κ(z) and σ(z).
#[derive(Clone, Copy, Debug)]
struct Pair<T> {
    cosine: T,
    sinc: T,
}

impl<T: Real> Pair<T> {
    #[inline(always)]
    fn at(z: T) -> Self {
        if z == T::lift(0.0) {
            return Self { cosine: T::lift(1.0), sinc: T::lift(1.0) };
        }
        let u = Scalar::sqrt(z);
        let (sine, cosine) = nalgebra::ComplexField::sin_cos(u);
        Self { cosine, sinc: sine / u }
    }

    /// The pair at 4z.
    #[inline(always)]
    fn doubled(self, z: T) -> Self {
        let square = z * self.sinc * self.sinc;
        Self { cosine: T::lift(1.0) - (square + square), sinc: self.sinc * self.cosine }
    }
}

/// κ and σ at c²z for the nodes that occur most, and at any other.
#[derive(Clone, Copy, Debug)]
struct Pairs<T> {
    z: T,
    half: Pair<T>,
    whole: Pair<T>,
}

impl<T: Real> Pairs<T> {
    #[inline(always)]
    fn new(z: T) -> Self {
        let quarter = z * T::lift(0.25);
        let half = Pair::at(quarter);
        Self { z, half, whole: half.doubled(quarter) }
    }

    #[inline(always)]
    fn at(&self, c: f64) -> Pair<T> {
        if c == 0.0 {
            Pair { cosine: T::lift(1.0), sinc: T::lift(1.0) }
        } else if c == 0.5 {
            self.half
        } else if c == 1.0 {
            self.whole
        } else {
            Pair::at(T::lift(c * c) * self.z)
        }
    }
}

/// σ(z).
pub(crate) fn sinc<T: Real>(z: T) -> T {
    Pair::at(z).sinc
}

/// S = Σ w cos((1 − 2c)u).
pub(crate) fn kernel<T: Real>(rule: &Quadrature, z: T) -> T {
    let terms = rule.nodes().iter().zip(rule.weights());
    terms.fold(T::lift(0.0), |sum, (&c, &w)| {
        let angle = (1.0 - 2.0 * c) * (1.0 - 2.0 * c);
        sum + T::lift(w) * Pair::at(T::lift(angle) * z).cosine
    })
}

/// The coefficients of all nodes of `rule`; what lies beyond them is of no use.
#[inline]
pub(crate) fn table<T: Real>(rule: &Quadrature, z: T) -> [Basis<T>; 5] {
    let pairs = Pairs::new(z);
    let reciprocal = T::lift(1.0) / pairs.whole.sinc;
    per_node(rule, |c| {
        let (left, right) = (pairs.at(1.0 - c), pairs.at(c));
        Basis {
            b: T::lift(1.0 - c) * left.sinc * reciprocal,
            b_bar: T::lift(c) * right.sinc * reciprocal,
            d: -left.cosine * reciprocal,
            d_bar: right.cosine * reciprocal,
        }
    })
}

/// The derivatives with respect to z of the coefficients of all nodes of `rule`.
pub(crate) fn table_slope<T: Real>(rule: &Quadrature, z: T) -> [Basis<T>; 5] {
    let (whole, slope) = (sinc(z), sinc_slope(z));
    // (f/σ)' for f' = `df`.
    let ratio = |f: T, df: T| (df - f * slope / whole) / whole;
    let half = T::lift(0.5);
    let parts = |c: f64| {
        let (c, square) = (T::lift(c), T::lift(c * c));
        let Pair { cosine, sinc } = Pair::at(square * z);
        (ratio(c * sinc, c * square * sinc_slope(square * z)), ratio(cosine, -half * square * sinc))
    };
    per_node(rule, |c| {
        let ((b, d), (b_bar, d_bar)) = (parts(1.0 - c), parts(c));
        Basis { b, b_bar, d: -d, d_bar }
    })
}

/// The derivative with respect to z of σ(z)/S(z).
pub(crate) fn weight_factor_slope<T: Real>(rule: &Quadrature, z: T) -> T {
    let terms = rule.nodes().iter().zip(rule.weights());
    let kernel_slope = terms.fold(T::lift(0.0), |sum, (&c, &w)| {
        let angle = T::lift((1.0 - 2.0 * c) * (1.0 - 2.0 * c));
        sum - T::lift(0.5 * w) * angle * sinc(angle * z)
    });
    let kernel = kernel(rule, z);
    (sinc_slope(z) - sinc(z) * kernel_slope / kernel) / kernel
}

#[inline(always)]
fn per_node<T: Real>(rule: &Quadrature, basis: impl Fn(f64) -> Basis<T>) -> [Basis<T>; 5] {
    let zero = T::lift(0.0);
    let mut table = [Basis { b: zero, b_bar: zero, d: zero, d_bar: zero }; 5];
    for (entry, &c) in table.iter_mut().zip(rule.nodes()) {
        *entry = basis(c);
    }
    table
}

/// Below this, (κ − σ)/(2z) has lost too many digits.
const SERIES: f64 = 1.0;

/// σ'(z) = Σₖ (−1)ᵏ k zᵏ⁻¹/(2k + 1)!.
fn sinc_slope<T: Real>(z: T) -> T {
    if z > T::lift(SERIES) {
        let Pair { cosine, sinc } = Pair::at(z);
        return (cosine - sinc) / (z + z);
    }
    let (mut sum, mut term) = (T::lift(0.0), T::lift(-1.0 / 6.0));
    for k in 1..11 {
        sum += T::lift(f64::from(k)) * term;
        term *= -z / T::lift(f64::from((2 * k + 2) * (2 * k + 3)));
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::{Basis, kernel, sinc, sinc_slope, table, table_slope, weight_factor_slope};
    use crate::quadrature::Quadrature;
    use crate::{Real, Scalar};
    use num_dual::Dual64;

    fn rules() -> impl Iterator<Item = Quadrature> {
        let own = Quadrature::new(&[0.1, 0.4, 0.95], &[0.3, 0.5, 0.2]).ok();
        let gauss = (1..=5).filter_map(|s| Quadrature::gauss(s).ok());
        gauss.chain((2..=5).filter_map(|s| Quadrature::lobatto(s).ok())).chain(own)
    }

    fn entries<T: Real>(Basis { b, b_bar, d, d_bar }: Basis<T>) -> [T; 4] {
        [b, b_bar, d, d_bar]
    }

    #[test]
    fn without_frequency_the_interpolation_is_linear() {
        for rule in rules() {
            for (&c, basis) in rule.nodes().iter().zip(table(&rule, 0.0)) {
                assert_eq!(entries(basis), [1.0 - c, c, -1.0, 1.0]);
            }
        }
    }

    #[test]
    fn the_basis_is_that_of_the_paper() {
        for rule in rules() {
            for u in [1e-3_f64, 0.1, 0.7, 1.5, 2.5] {
                for (&c, basis) in rule.nodes().iter().zip(table(&rule, u * u)) {
                    let (s, cotangent) = (u.sin(), u.cos() / u.sin());
                    let printed = [
                        (c * u).cos() - cotangent * (c * u).sin(),
                        (c * u).sin() / s,
                        -u * (c * u).sin() - u * cotangent * (c * u).cos(),
                        u * (c * u).cos() / s,
                    ];
                    for (found, expected) in entries(basis).iter().zip(printed) {
                        assert!((found - expected).abs() < 4e-13, "c = {c}, u = {u}: {found} {expected}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_oscillator_is_solved_exactly_wherever_its_step_is_determined() {
        for rule in rules() {
            for u in (1..=30).map(|k| 0.1 * f64::from(k)) {
                let z = u * u;
                if kernel(&rule, z).abs() < 0.05 {
                    continue;
                }
                let (mut numerator, mut denominator) = (0.0, 0.0);
                for (&w, basis) in rule.weights().iter().zip(table(&rule, z)) {
                    let [b, b_bar, d, d_bar] = entries(basis);
                    numerator += w * (d * d + d_bar * d_bar - z * (b * b + b_bar * b_bar));
                    denominator += w * (z * b * b_bar - d * d_bar);
                }
                let error = numerator / denominator - 2.0 * u.cos();
                // Each of the sums is accurate to rounding of its largest term.
                let size = (z / (u.sin() * u.sin())).max(1.0) / denominator.abs().min(1.0);
                assert!(error.abs() < 1e-14 * size.max(1.0), "{rule:?}, u = {u}: {error:e}");
            }
        }
    }

    #[test]
    fn slopes_agree_with_dual_numbers() {
        // Where dual numbers divide by z they lose digits for small z.
        for z in [0.3, 0.9, 1.1, 4.0] {
            let dual = Dual64::from_re(z).derivative();
            for rule in rules() {
                let expected = table(&rule, dual);
                for (slope, expected) in table_slope(&rule, z).into_iter().zip(expected) {
                    for (slope, expected) in entries(slope).iter().zip(entries(expected)) {
                        assert!((slope - expected.eps).abs() < 1e-13, "z = {z}: {slope} {}", expected.eps);
                    }
                }
                let factor = sinc(dual) / kernel(&rule, dual);
                let found = weight_factor_slope(&rule, z);
                let size = factor.re.abs().max(1.0) / kernel(&rule, z).abs().min(1.0);
                assert!((found - factor.eps).abs() < 1e-13 * size * size, "z = {z}: {found} {}", factor.eps);
            }
        }
    }

    #[test]
    fn series_and_closed_form_of_the_slope_meet() {
        for z in [0.999_999_f64, 1.000_001] {
            let u: f64 = Scalar::sqrt(z);
            let closed = (Scalar::cos(u) - sinc(z)) / (2.0 * z);
            assert!(Scalar::abs(sinc_slope(z) - closed) < 1e-15);
        }
        assert_eq!(sinc_slope(0.0), -1.0 / 6.0);
        assert!(Scalar::abs(sinc(1e-300_f64) - 1.0) < 1e-16);
    }
}
