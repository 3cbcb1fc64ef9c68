//! Lobatto collocation with S nodes, both ends among them: nodes, weights and matrices.
//!
//! c are 0, 1 and the zeros of the derivative of the shifted Legendre polynomial P_{S−1}, and the rule is
//! exact to degree 2S − 3 (Davis & Rabinowitz 1984, section 2.7.1). The pair IIIA–IIIB has the matrices
//! aᵢⱼ = ∫₀^cᵢ lⱼ and âᵢⱼ = bⱼ(1 − aⱼᵢ/bᵢ), so that bᵢâᵢⱼ + bⱼaⱼᵢ = bᵢbⱼ (Hairer, Lubich & Wanner 2006, section
//! II.2.2). With the momenta of the nodes eliminated, only
//!
//! νᵢⱼ = Σₖ aᵢₖ âₖⱼ/bⱼ = cᵢ − gᵢⱼ,   gᵢⱼ = Σₖ aᵢₖ aⱼₖ/bₖ = cᵢcⱼ + ¼ Σₖ dₖ(cᵢ) dₖ(cⱼ)/(2k+1),   k = 1 … S−2
//!
//! is left of both, where dₖ = Pₖ₊₁ − Pₖ₋₁ is (2k+1) times twice the integral of Pₖ. Since g is symmetric,
//! νᵢⱼ − νⱼᵢ = cᵢ − cⱼ, by which steps are symplectic (Suris 1989). They are symmetric since a node and its
//! mirror image i', cᵢ' = 1 − cᵢ, have gᵢ'ⱼ' = gᵢⱼ + 1 − cᵢ − cⱼ.

use super::legendre;

/// The largest number of nodes that there are tables for.
pub(in crate::methods) const MOST: usize = 9;

/// The nodes from the centre on, and their weights, for 2 to 9 nodes; computed in 60 digits as the zeros of
/// P'_{S−1} and as 1/(S(S−1)P_{S−1}(c)²).
#[rustfmt::skip]
const UPPER: [&[[f64; 2]]; MOST - 1] = [
    &[[1.0,                   0.5]],
    &[[0.5,                   2.0 / 3.0],             [1.0,                   1.0 / 6.0]],
    &[[0.723_606_797_749_978_9, 5.0 / 12.0],          [1.0,                   1.0 / 12.0]],
    &[[0.5,                   16.0 / 45.0],           [0.827_326_835_353_988_5, 49.0 / 180.0],          [1.0, 1.0 / 20.0]],
    &[[0.642_615_758_240_322_6, 0.277_429_188_517_743_2], [0.882_527_661_964_732_3, 0.189_237_478_148_923_5],
      [1.0, 1.0 / 30.0]],
    &[[0.5,                   128.0 / 525.0],         [0.734_424_396_735_357_1, 0.215_872_690_604_931_3],
      [0.915_111_948_139_283_4, 0.138_413_023_680_782_98], [1.0, 1.0 / 42.0]],
    &[[0.604_649_608_951_239_4, 0.206_229_397_329_351_94], [0.795_850_090_716_571_2, 0.170_561_346_241_752_18],
      [0.935_870_074_254_803_3, 0.105_352_113_571_753_02], [1.0, 1.0 / 56.0]],
    &[[0.5,                   2048.0 / 11025.0],      [0.681_558_731_913_089_1, 0.173_214_255_486_523_17],
      [0.838_593_139_755_368_9, 0.137_269_356_250_080_85], [0.949_878_997_705_73, 0.082_747_680_780_402_76],
      [1.0, 1.0 / 72.0]],
];

/// Node number `place` of `count` ≤ [`MOST`], and its weight.
fn node(count: usize, place: usize) -> [f64; 2] {
    let upper = UPPER[count - 2];
    if let Some(from_centre) = (place + upper.len()).checked_sub(count) {
        return upper[from_centre];
    }
    // Below the centre a node would have finer digits than 2⁻⁵³; it is what that above leaves of 1.
    let [c, b] = upper[upper.len() - 1 - place];
    [1.0 - c, b]
}

/// The nodes and weights of the rule with S + 1 nodes, but for the first, which is 0 and has the weight of
/// the last. They are the extrema of P_S: each gap between two of its zeros has one.
pub(in crate::methods) fn extrema<const S: usize>() -> [[f64; 2]; S] {
    core::array::from_fn(|i| node(S + 1, i + 1))
}

/// Nodes and weights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::methods) struct Lobatto<const S: usize> {
    pub(in crate::methods) c: [f64; S],
    pub(in crate::methods) b: [f64; S],
}

impl<const S: usize> Lobatto<S> {
    pub(in crate::methods) fn new() -> Self {
        const { assert!(S >= 3 && S <= MOST, "interior displacements are available with 3 to 9 nodes") };
        let nodes: [[f64; 2]; S] = core::array::from_fn(|place| node(S, place));
        Self { c: nodes.map(|[c, _]| c), b: nodes.map(|[_, b]| b) }
    }

    /// ν of the nodes. All entries, as the nodes, are multiples of 2⁻⁵³ and at most 1 in size, whose
    /// differences are not rounded: νᵢⱼ − νⱼᵢ = cᵢ − cⱼ and νᵢ'ⱼ' = νⱼᵢ hold exactly in the arithmetic.
    pub(in crate::methods) fn nystrom(&self) -> [[f64; S]; S] {
        let (c, p) = (self.c, self.c.map(legendre));
        let slope = |i: usize, k: usize| p[i][k + 1] - p[i][k - 1];
        let mut g = [[0.0; S]; S];
        for i in 0..S {
            for j in 0..=i {
                if i + j + 1 < S {
                    continue;
                }
                let terms = (1..S - 1).map(|k| slope(i, k) * slope(j, k) / (2 * k + 1) as f64);
                let exact = c[i] * c[j] + 0.25 * terms.sum::<f64>();
                // On the grid of 2⁻⁵³.
                let entry = if exact < 0.5 { (exact + 0.5) - 0.5 } else { exact };
                let mirrored = entry + ((1.0 - c[i]) - c[j]);
                let [k, l] = [S - 1 - i, S - 1 - j];
                (g[i][j], g[j][i], g[k][l], g[l][k]) = (entry, entry, mirrored, mirrored);
            }
        }
        core::array::from_fn(|i| core::array::from_fn(|j| c[i] - g[i][j]))
    }

    /// Entry (k, j): the coefficient of Pₖ in the j-th Lagrange polynomial. The rule is one degree short of
    /// P_{S−1}², of which it gives 1/(S−1).
    pub(in crate::methods) fn lagrange(&self) -> [[f64; S]; S] {
        let p = self.c.map(legendre);
        core::array::from_fn(|k| {
            let square = if k + 1 < S { 2 * k + 1 } else { k };
            core::array::from_fn(|j| self.b[j] * square as f64 * p[j][k])
        })
    }

    /// Entry (j, k): the derivative at node j of the Lagrange polynomial of node k.
    pub(in crate::methods) fn differentiation(&self) -> [[f64; S]; S] {
        let c = self.c;
        let others = |k: usize| (0..S).filter(move |&m| m != k);
        let scale = |k: usize| others(k).fold(1.0, |product, m| product * (c[k] - c[m]));
        core::array::from_fn(|j| {
            core::array::from_fn(|k| {
                if j == k {
                    others(k).fold(0.0, |sum, m| sum + 1.0 / (c[k] - c[m]))
                } else {
                    scale(j) / (scale(k) * (c[j] - c[k]))
                }
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Lobatto;

    /// A number as a sum of two, so that its rounding errors are those of the second: what the tables are
    /// held against.
    #[derive(Clone, Copy, Debug)]
    struct Double(f64, f64);

    impl Double {
        fn of(x: f64) -> Self {
            Self(x, 0.0)
        }
        fn plus(self, other: Self) -> Self {
            let sum = self.0 + other.0;
            let part = sum - self.0;
            let error = (self.0 - (sum - part)) + (other.0 - part) + (self.1 + other.1);
            let total = sum + error;
            Self(total, error - (total - sum))
        }
        fn times(self, other: Self) -> Self {
            let product = self.0 * other.0;
            let error = self.0.mul_add(other.0, -product) + (self.0 * other.1 + self.1 * other.0);
            let total = product + error;
            Self(total, error - (total - product))
        }
        fn over(self, divisor: f64) -> Self {
            let quotient = self.0 / divisor;
            let rest = self.plus(Self::of(-quotient).times(Self::of(divisor)));
            Self::of(quotient).plus(Self::of(rest.0 / divisor))
        }
        fn power(self, degree: usize) -> Self {
            (0..degree).fold(Self::of(1.0), |power, _| power.times(self))
        }
    }

    /// A zero of P'_{S−1} close to `c`, by Newton's method on the polynomial with integer coefficients, and
    /// the weight there.
    fn refined<const S: usize>(c: f64) -> [Double; 2] {
        // P_n(x) = Σₖ (−1)ⁿ⁺ᵏ (n over k)(n+k over k) xᵏ
        let n = S - 1;
        let mut coefficient = if n.is_multiple_of(2) { 1.0 } else { -1.0 };
        let coefficients: [f64; S] = core::array::from_fn(|k| {
            if k > 0 {
                coefficient *= -(((n + k) * (n + 1 - k)) as f64) / (k * k) as f64;
            }
            coefficient
        });
        let derivative = |x: Double, times: usize| {
            (times..=n).fold(Double::of(0.0), |sum, k| {
                let factor: usize = (0..times).map(|t| k - t).product();
                sum.plus(x.power(k - times).times(Double::of(factor as f64 * coefficients[k])))
            })
        };
        let mut x = Double::of(c);
        // The end is known.
        for _ in 0..if c < 1.0 { 3 } else { 0 } {
            x = x.plus(derivative(x, 1).over(-derivative(x, 2).0));
        }
        let value = derivative(x, 0);
        let square = value.times(value).times(Double::of((S * n) as f64));
        // One step of Newton's method for the reciprocal.
        let weight = 1.0 / square.0;
        let rest = Double::of(1.0).plus(square.times(Double::of(-weight)));
        [x, Double::of(weight).plus(rest.times(Double::of(weight)))]
    }

    fn nodes_weights_and_nu<const S: usize>() {
        let rule = Lobatto::<S>::new();
        let Lobatto { c, b } = rule;
        assert!(c.is_sorted() && (c[0], c[S - 1]) == (0.0, 1.0));
        assert!((0..S).all(|i| (1.0 - c[i], b[i]) == (c[S - 1 - i], b[S - 1 - i])));
        // From the centre on, nodes and weights are those of the polynomial, rounded once.
        let exact: [[Double; 2]; S] = core::array::from_fn(|i| refined::<S>(c[i.max(S - 1 - i)]));
        for i in S / 2..S {
            let [node, weight] = exact[i];
            assert_eq!((c[i], b[i]), (node.0, weight.0), "{S} nodes, {i}");
        }
        let c_exact: [Double; S] = core::array::from_fn(|i| {
            let [node, _] = exact[i];
            if 2 * i + 1 < S { Double::of(1.0).plus(node.times(Double::of(-1.0))) } else { node }
        });
        let b_exact = exact.map(|[_, weight]| weight);
        // B(2S−2), in exact nodes and weights to twice the precision, and no more.
        for k in 0..2 * S - 1 {
            let sum = (0..S).fold(Double::of(0.0), |sum, j| sum.plus(b_exact[j].times(c_exact[j].power(k))));
            let error = sum.plus(Double::of(-1.0).over((k + 1) as f64));
            assert_eq!(error.0.abs() < 1e-26, k < 2 * S - 2, "{S} nodes, degree {k}: {:e}", error.0);
        }
        let nu = rule.nystrom();
        for i in 0..S {
            // C(S) of IIIA, twice: Σⱼ νᵢⱼ bⱼ cⱼᵏ is the integral of the integral, in which that of IIIB is
            // exact to degree S − 3.
            for k in 0..S - 2 {
                let sum = (0..S).fold(Double::of(0.0), |sum, j| {
                    sum.plus(Double::of(nu[i][j]).times(b_exact[j]).times(c_exact[j].power(k)))
                });
                let exact = c_exact[i].power(k + 2).over(((k + 1) * (k + 2)) as f64);
                let error = sum.plus(exact.times(Double::of(-1.0)));
                assert!(error.0.abs() < 2e-16, "{S} nodes, row {i}, degree {k}: {:e}", error.0);
            }
            for j in 0..S {
                // Without rounding: each is a multiple of 2⁻⁵³, and so in integers.
                let [ij, ji, mirrored, of_i, of_j] =
                    [nu[i][j], nu[j][i], nu[S - 1 - i][S - 1 - j], c[i], c[j]].map(|x| x * 2_f64.powi(53));
                assert!([ij, ji, of_i, of_j].iter().all(|x| x.fract() == 0.0), "{S} nodes, ({i}, {j})");
                assert_eq!(ij as i64 - ji as i64, of_i as i64 - of_j as i64, "{S} nodes, ({i}, {j})");
                assert_eq!(mirrored, ji, "{S} nodes, ({i}, {j})");
            }
            // The first node does not move, and the force at the last one moves none.
            assert!(nu[0][i] == 0.0 && nu[i][S - 1] == 0.0, "{S} nodes, {i}");
        }
    }

    fn polynomials_are_differentiated<const S: usize>() {
        let rule = Lobatto::<S>::new();
        let (a, Lobatto { c, b }) = (rule.differentiation(), rule);
        for (row, &at) in a.iter().zip(&c) {
            // Equation 28: exact on polynomials of degree S − 1, and on no others.
            for n in 0..=S as i32 {
                let sum: f64 = row.iter().zip(&c).map(|(a, c)| a * c.powi(n)).sum();
                let exact = if n == 0 { 0.0 } else { f64::from(n) * at.powi(n - 1) };
                assert_eq!((sum - exact).abs() < 1e-13, n < S as i32, "{S}: c = {at}, degree {n}");
            }
        }
        for j in 0..S {
            for k in 0..S {
                // Summation by parts: the rule is exact on products of a polynomial and a derivative.
                let boundary = if j != k || (j > 0 && j < S - 1) { 0.0 } else { 2.0 * c[j] - 1.0 };
                assert!((b[j] * a[j][k] + b[k] * a[k][j] - boundary).abs() < 1e-14, "{S}: ({j}, {k})");
            }
        }
    }

    #[test]
    fn tableaus_are_those_of_lobatto() {
        fn check<const S: usize>() {
            nodes_weights_and_nu::<S>();
            polynomials_are_differentiated::<S>();
        }
        let rules: [fn(); 7] =
            [check::<3>, check::<4>, check::<5>, check::<6>, check::<7>, check::<8>, check::<9>];
        rules.iter().for_each(|check| check());
    }
}
