//! f + a(θ²) u × f + b(θ²) u × (u × f), θ = |u|: the exponential map of SO(3) and its derivatives are of
//! this form (Iserles, Munthe-Kaas, Nørsett & Zanna 2000, appendix B).
//!
//! | map | a | b |
//! |---|---|---|
//! | exp(û) | sin θ/θ | (1 − cos θ)/θ² |
//! | J(u) = ∫₀¹ exp(c û) dc | (1 − cos θ)/θ² | (θ − sin θ)/θ³ |
//! | J(u)⁻¹ | −½ | (1 − (θ/2) cot(θ/2))/θ² |
//!
//! exp(û + δû) = exp((J(u) δ)^) exp(û) to first order, and exp(û + δû) = exp(û) exp((J(−u) δ)^).

use nalgebra::{Matrix3, Vector3};

use crate::{Real, Scalar};

/// The coefficients a and b at some u.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Series<T> {
    u: Vector3<T>,
    a: T,
    b: T,
    map: Map<T>,
}

#[derive(Clone, Copy, Debug)]
enum Map<T> {
    Exponential,
    Mean,
    /// With the derivative of b by θ², which comes with b.
    Inverse(T),
}

/// Terms of the power series in θ²: the first that is left out is below 10⁻¹⁷ of the sum for θ² ≤ [`NEAR`].
const TERMS: usize = 11;
/// And the same for θ² ≤ [`VERY_NEAR`].
const FEW: usize = 7;

/// Beyond this θ² closed forms lose no digits.
const NEAR: f64 = 1.0;
const VERY_NEAR: f64 = 0.1;

/// 1/n!, 1/(n + 2)!, …, with alternating signs.
const fn factorials(n: u32) -> [f64; TERMS] {
    let mut terms = [0.0; TERMS];
    let (mut k, mut factorial) = (1, 1.0);
    while k <= n {
        factorial *= k as f64;
        k += 1;
    }
    let (mut term, mut sign) = (0, 1.0);
    while term < TERMS {
        terms[term] = sign / factorial;
        factorial *= (n + 2 * term as u32 + 1) as f64 * (n + 2 * term as u32 + 2) as f64;
        sign = -sign;
        term += 1;
    }
    terms
}

const LAMBDA: [[f64; TERMS]; 5] =
    [factorials(1), factorials(2), factorials(3), factorials(4), factorials(5)];

/// |B₂ₖ|/(2k)!, k = 1, 2, …: the power series of (1 − (θ/2) cot(θ/2))/θ² in θ².
const COTANGENT: [f64; TERMS] = [
    1.0 / 12.0,
    1.0 / 720.0,
    1.0 / 30240.0,
    1.0 / 1_209_600.0,
    1.0 / 47_900_160.0,
    691.0 / 1_307_674_368_000.0,
    1.0 / 74_724_249_600.0,
    3617.0 / 10_670_622_842_880_000.0,
    43867.0 / 5_109_094_217_170_944_000.0,
    174_611.0 / 802_857_662_698_291_200_000.0,
    77683.0 / 14_101_100_039_391_805_440_000.0,
];

/// Σ `terms`ₖ θ²ᵏ and its derivative by θ².
#[inline]
fn power_series<T: Real>(terms: &[f64; TERMS], square: T) -> [T; 2] {
    let sum = |terms: &[f64]| {
        terms.iter().rev().fold([T::lift(0.0); 2], |[value, slope], &term| {
            [T::lift(term) + square * value, value + square * slope]
        })
    };
    if square <= T::lift(VERY_NEAR) { sum(&terms[..FEW]) } else { sum(terms) }
}

/// λₙ(θ²) = Σₖ (−θ²)ᵏ/(2k + n)!, n = 1 to 5: sin θ/θ, (1 − cos θ)/θ², (θ − sin θ)/θ³, …
#[inline]
pub(crate) fn lambda<const FROM: usize, const COUNT: usize, T: Real>(square: T) -> [T; COUNT] {
    if square <= T::lift(NEAR) {
        return core::array::from_fn(|n| power_series(&LAMBDA[FROM - 1 + n], square)[0]);
    }
    far(FROM, square)
}

#[inline(never)]
fn far<const COUNT: usize, T: Real>(from: usize, square: T) -> [T; COUNT] {
    let (theta, mut n) = (Scalar::sqrt(square), 1);
    let (mut value, mut next) = (Scalar::sin(theta) / theta, (T::lift(1.0) - Scalar::cos(theta)) / square);
    core::array::from_fn(|place| {
        while n < from + place {
            // λₙ₊₂ = (1/n! − λₙ)/θ²
            let factorial: u32 = (1..=n as u32).product();
            (value, next) = (next, (T::lift(1.0 / f64::from(factorial)) - value) / square);
            n += 1;
        }
        value
    })
}

#[inline]
fn cotangent<T: Real>(square: T) -> [T; 2] {
    if square <= T::lift(NEAR) { power_series(&COTANGENT, square) } else { cotangent_far(square) }
}

#[inline(never)]
fn cotangent_far<T: Real>(square: T) -> [T; 2] {
    let half = T::lift(0.5) * Scalar::sqrt(square);
    let (sine, cosine) = (Scalar::sin(half), Scalar::cos(half));
    let cotangent = half * cosine / sine;
    let value = (T::lift(1.0) - cotangent) / square;
    // d(x cot x)/d(x²) = (cot x − x/sin² x)/(2x), θ² = 4x².
    let slope = (cotangent - half * half / (sine * sine)) / (T::lift(2.0) * half * half);
    [value, (-T::lift(0.25) * slope - value) / square]
}

impl<T: Real> Series<T> {
    /// exp(û).
    #[inline]
    pub(crate) fn exp(u: Vector3<T>) -> Self {
        let [a, b] = lambda::<1, 2, T>(u.dot(&u));
        Self { u, a, b, map: Map::Exponential }
    }

    /// J(u).
    #[inline]
    pub(crate) fn mean(u: Vector3<T>) -> Self {
        let [a, b] = lambda::<2, 2, T>(u.dot(&u));
        Self { u, a, b, map: Map::Mean }
    }

    /// J(u)⁻¹.
    #[inline]
    pub(crate) fn mean_inverse(u: Vector3<T>) -> Self {
        let [b, slope] = cotangent(u.dot(&u));
        Self { u, a: T::lift(-0.5), b, map: Map::Inverse(slope) }
    }

    /// The derivatives of a and b by θ². Those of λₙ are (n λₙ₊₂ − λₙ₊₁)/2, and b is λₙ₊₁ where a is λₙ.
    #[inline]
    fn slopes(&self) -> [T; 2] {
        let (square, half) = (self.u.dot(&self.u), T::lift(0.5));
        match self.map {
            Map::Exponential => {
                let [third, fourth] = lambda::<3, 2, T>(square);
                [half * (third - self.b), half * (T::lift(2.0) * fourth - third)]
            }
            Map::Mean => {
                let [fourth, fifth] = lambda::<4, 2, T>(square);
                [half * (T::lift(2.0) * fourth - self.b), half * (T::lift(3.0) * fifth - fourth)]
            }
            Map::Inverse(slope) => [T::lift(0.0), slope],
        }
    }

    /// The image of `f`.
    #[inline]
    pub(crate) fn of(&self, f: &Vector3<T>) -> Vector3<T> {
        let once = self.u.cross(f);
        f + (once * self.a + self.u.cross(&once) * self.b)
    }

    /// The matrix of the map.
    #[inline]
    pub(crate) fn matrix(&self) -> Matrix3<T> {
        let &Self { u, a, b, .. } = self;
        Matrix3::identity() * (T::lift(1.0) - b * u.dot(&u)) + u.cross_matrix() * a + u * b * u.transpose()
    }

    /// The derivative of the image of `f` with respect to u.
    #[inline]
    pub(crate) fn derivative(&self, f: &Vector3<T>) -> Matrix3<T> {
        let &Self { u, a, b, .. } = self;
        let [a_slope, b_slope] = self.slopes();
        let once = u.cross(f);
        let twice = u.cross(&once);
        let by_u = (once * a_slope + twice * b_slope - f * b) * T::lift(2.0);
        by_u * u.transpose() + u * b * f.transpose() + Matrix3::identity() * (u.dot(f) * b)
            - f.cross_matrix() * a
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;
    use num_dual::Dual64;

    use super::Series;

    type Map = fn(Vector3<f64>) -> Series<f64>;
    type DualMap = fn(Vector3<Dual64>) -> Series<Dual64>;

    fn lengths() -> impl Iterator<Item = f64> {
        [0.0, 1e-9, 1e-3, 0.5, 0.99, 1.01, 2.0, 3.1].into_iter()
    }

    fn direction() -> Vector3<f64> {
        Vector3::new(0.48, -0.6, 0.64)
    }

    /// Rodrigues' formula, in the plane at right angles to the axis.
    #[test]
    fn the_exponential_turns_by_its_length() {
        for theta in lengths() {
            let u = direction() * theta;
            let f = direction().cross(&Vector3::new(1.0, 2.0, 3.0));
            let turned = f * theta.cos() + direction().cross(&f) * theta.sin();
            assert!((Series::exp(u).of(&f) - turned).norm() < 4e-16 * f.norm() * 4.0, "{theta}");
            assert!((Series::exp(u).of(&u) - u).norm() < 1e-15);
        }
    }

    /// ∫₀¹ exp(cû) f dc by Gauss's rule with many nodes.
    #[test]
    fn the_mean_is_an_integral_and_has_an_inverse() {
        let f = Vector3::new(0.3, -1.2, 0.7);
        for theta in lengths() {
            let u = direction() * theta;
            let steps = 2000;
            let sum = (0..steps).fold(Vector3::zeros(), |sum, k| {
                let [low, high] = [0.5 - 0.75_f64.sqrt() / 3.0, 0.5 + 0.75_f64.sqrt() / 3.0];
                let at = |c: f64| Series::exp(u * ((f64::from(k) + c) / f64::from(steps))).of(&f);
                sum + (at(low) + at(high)) / (2.0 * f64::from(steps))
            });
            assert!((Series::mean(u).of(&f) - sum).norm() < 1e-13, "{theta}");
            let back = Series::mean_inverse(u).of(&Series::mean(u).of(&f));
            assert!((back - f).norm() < 2e-15, "{theta}: {:e}", (back - f).norm());
            assert!((Series::mean(u).matrix() * f - Series::mean(u).of(&f)).norm() < 1e-15);
        }
    }

    #[test]
    fn derivatives_are_those_of_dual_numbers() {
        let f = Vector3::new(0.3, -1.2, 0.7);
        let maps: [(Map, DualMap); 3] = [
            (Series::exp, Series::exp),
            (Series::mean, Series::mean),
            (Series::mean_inverse, Series::mean_inverse),
        ];
        for theta in lengths() {
            let u = direction() * theta;
            for (map, dual) in maps {
                let exact = |column: usize| {
                    let part = |row: usize| Dual64::new(u[row], if row == column { 1.0 } else { 0.0 });
                    dual(Vector3::from_fn(|row, _| part(row))).of(&f.map(Dual64::from))
                };
                let value = map(u).of(&f);
                for (column, derivative) in map(u).derivative(&f).column_iter().enumerate() {
                    let exact = exact(column);
                    let difference = exact.map(|part| part.eps) - derivative;
                    assert!((value - exact.map(|part| part.re)).norm() < 1e-15);
                    assert!(difference.norm() < 2e-14, "{theta}: {:e}", difference.norm());
                }
            }
        }
    }
}
