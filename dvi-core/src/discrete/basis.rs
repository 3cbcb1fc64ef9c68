//! The interpolation between two points by the solutions of an oscillator.
//!
//! q(c) = b q0 + b̄ q1, q̇(c) = (B q0 + B̄ q1)/h with (Kosmas & Vlachos, eqs. 11 and 15), for u = ωh and z =
//! u²,
//!
//! b = (1−c) σ((1−c)²z)/σ(z)    b̄ = c σ(c²z)/σ(z)    B = −κ((1−c)²z)/σ(z)    B̄ = κ(c²z)/σ(z)
//!
//! where κ(z) = cos √z and σ(z) = sin √z/√z are entire functions of z. So z = 0, linear interpolation, is no
//! special case, and nothing cancels near it; only the derivative σ' = (κ − σ)/(2z) needs its series there.

use crate::discrete::quadrature::{NODES, Rule};
use crate::{Real, Scalar};

/// The coefficients of one node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Basis<T> {
    pub(crate) b: T,
    pub(crate) b_bar: T,
    pub(crate) d: T,
    pub(crate) d_bar: T,
}

impl<T: Real> Basis<T> {
    /// Those of node `c` for u = 0, linear interpolation.
    #[inline]
    pub(crate) fn linear(c: f64) -> Self {
        let one = T::lift(1.0);
        Self { b: T::lift(1.0 - c), b_bar: T::lift(c), d: -one, d_bar: one }
    }
}

/// κ and σ at one point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair<T> {
    pub(crate) cosine: T,
    pub(crate) sinc: T,
}

/// Up to here the series are as accurate as the functions, and faster; beyond, doubling would lose digits
/// near the zeros of sin u.
const SERIES_TO: f64 = 0.25;

/// (−1)ᵏ/(2k)! and (−1)ᵏ/(2k + 1)!.
#[rustfmt::skip]
const SERIES: [[f64; 8]; 2] = {
    let mut table = [[0.0; 8]; 2];
    let (mut even, mut k) = (1.0, 0);
    while k < 8 {
        let odd = even / (2 * k + 1) as f64;
        table[0][k] = even;
        table[1][k] = odd;
        even = -odd / (2 * k + 2) as f64;
        k += 1;
    }
    table
};

/// Σ cₖ zᵏ, by pairs of pairs, so that the terms do not wait for one another.
#[inline]
fn sum_series<T: Real>(c: &[f64; 8], z: T) -> T {
    let (square, c) = (z * z, |k: usize| T::lift(c[k]));
    let fourth = square * square;
    let pair = |k: usize| c(k) + c(k + 1) * z;
    let four = |k: usize| pair(k) + pair(k + 2) * square;
    four(0) + four(4) * fourth
}

impl<T: Real> Pair<T> {
    /// κ(z) and σ(z), z = u².
    #[inline]
    fn at(u: T) -> Self {
        let z = u * u;
        if z <= T::lift(SERIES_TO) {
            return Self::series(z);
        }
        let (sine, cosine) = nalgebra::ComplexField::sin_cos(u);
        Self { cosine, sinc: sine / u }
    }

    #[inline]
    fn series(z: T) -> Self {
        Self { cosine: sum_series(&SERIES[0], z), sinc: sum_series(&SERIES[1], z) }
    }

    /// The pair at 2u.
    #[inline]
    fn doubled(self, u: T) -> Self {
        let sine = u * self.sinc;
        Self { cosine: T::lift(1.0) - T::lift(2.0) * sine * sine, sinc: self.sinc * self.cosine }
    }
}

/// The bases of all nodes for one u, with as few sines and cosines as the nodes allow: none for 0, ½ and 1
/// if u is small.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bases<T> {
    u: T,
    half: Pair<T>,
    pub(crate) whole: Pair<T>,
    /// 1/σ.
    pub(crate) reciprocal: T,
}

impl<T: Real> Bases<T> {
    /// For u = ωh.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn new(u: T) -> Self {
        let middle = u * T::lift(0.5);
        let half = Pair::at(middle);
        let whole = if middle * middle <= T::lift(SERIES_TO) { half.doubled(middle) } else { Pair::at(u) };
        Self { u, half, whole, reciprocal: T::lift(1.0) / whole.sinc }
    }

    /// κ and σ at (1 − c)u and at cu.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn pairs(&self, c: f64) -> [Pair<T>; 2] {
        let one = Pair { cosine: T::lift(1.0), sinc: T::lift(1.0) };
        if c == 0.5 {
            [self.half, self.half]
        } else if c == 0.0 {
            [self.whole, one]
        } else if c == 1.0 {
            [one, self.whole]
        } else {
            [Pair::at(T::lift(1.0 - c) * self.u), Pair::at(T::lift(c) * self.u)]
        }
    }

    /// The coefficients of a node with these pairs.
    #[inline]
    pub(crate) fn basis(&self, c: f64, [left, right]: [Pair<T>; 2]) -> Basis<T> {
        Basis {
            b: T::lift(1.0 - c) * left.sinc * self.reciprocal,
            b_bar: T::lift(c) * right.sinc * self.reciprocal,
            d: -left.cosine * self.reciprocal,
            d_bar: right.cosine * self.reciprocal,
        }
    }
}

/// κ(z) and σ(z). Near z = 0 without a root, which has no derivative there.
fn pair<T: Real>(z: T) -> Pair<T> {
    if z <= T::lift(SERIES_TO) { Pair::series(z) } else { Pair::at(Scalar::sqrt(z)) }
}

/// The derivatives with respect to z of the coefficients of all nodes of `rule`.
pub(crate) fn table_slope<T: Real>(rule: &impl Rule, z: T) -> [Basis<T>; NODES] {
    let (whole, slope) = (pair(z).sinc, sinc_slope(z));
    // (f/σ)' for f' = `df`.
    let ratio = |f: T, df: T| (df - f * slope / whole) / whole;
    let half = T::lift(0.5);
    let parts = |c: f64| {
        let (c, square) = (T::lift(c), T::lift(c * c));
        let Pair { cosine, sinc } = pair(square * z);
        (ratio(c * sinc, c * square * sinc_slope(square * z)), ratio(cosine, -half * square * sinc))
    };
    let zero = T::lift(0.0);
    let mut table = [Basis { b: zero, b_bar: zero, d: zero, d_bar: zero }; NODES];
    for (entry, &c) in table.iter_mut().zip(rule.nodes()) {
        let ((b, d), (b_bar, d_bar)) = (parts(1.0 - c), parts(c));
        *entry = Basis { b, b_bar, d: -d, d_bar };
    }
    table
}

/// σ'(z) = Σₖ (−1)ᵏ k zᵏ⁻¹/(2k + 1)!.
fn sinc_slope<T: Real>(z: T) -> T {
    // Below this, the closed form has lost too many digits.
    if z > T::lift(1.0) {
        let Pair { cosine, sinc } = pair(z);
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
    use super::{Bases, Basis, pair, sinc_slope, table_slope};
    use crate::discrete::quadrature::{Quadrature, Rule};
    use crate::{Real, Scalar};
    use num_dual::Dual64;

    fn rules() -> impl Iterator<Item = Quadrature> {
        let own = Quadrature::new(&[0.1, 0.4, 0.95], &[0.3, 0.5, 0.2]).ok();
        let gauss = (1..=5).filter_map(|s| Quadrature::gauss(s).ok());
        gauss.chain((2..=5).filter_map(|s| Quadrature::lobatto(s).ok())).chain(own)
    }

    /// The bases of all nodes for z = u².
    fn table<T: Real>(rule: &impl Rule, z: T) -> alloc::vec::Vec<Basis<T>> {
        let bases = Bases::new(Scalar::sqrt(z));
        rule.nodes().iter().map(|&c| bases.basis(c, bases.pairs(c))).collect()
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
            }
        }
    }

    #[test]
    fn series_and_closed_form_of_the_slope_meet() {
        for z in [0.999_999_f64, 1.000_001] {
            let u: f64 = Scalar::sqrt(z);
            let closed = (Scalar::cos(u) - pair(z).sinc) / (2.0 * z);
            assert!(Scalar::abs(sinc_slope(z) - closed) < 1e-15);
        }
        assert_eq!(sinc_slope(0.0), -1.0 / 6.0);
        assert!(Scalar::abs(pair(1e-300_f64).sinc - 1.0) < 1e-16);
    }
}
