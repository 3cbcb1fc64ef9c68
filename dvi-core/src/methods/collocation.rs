//! Gauss collocation with S stages: nodes, weights and the matrix of the stages.
//!
//! c are the zeros of the shifted Legendre polynomial of degree S, bᵢ = ∫₀¹ lᵢ and aᵢⱼ = ∫₀^cᵢ lⱼ with the Lagrange
//! polynomials lⱼ of the nodes (Hairer, Lubich & Wanner 2006, section II.1.3). The integrals are taken by the rule itself,
//! which is exact for them; the lower half of the matrix follows from bᵢaᵢⱼ + bⱼaⱼᵢ = bᵢbⱼ, the condition for symplectic
//! steps (Sanz-Serna 1988), so that it holds to rounding.

/// The largest number of stages.
pub(super) const MOST: usize = 4;

/// The zeros of the Legendre polynomial of degree S that are not negative, with their weights on [−1, 1] (Abramowitz & Stegun
/// 1964, table 25.4).
#[rustfmt::skip]
const ZEROS: [&[[f64; 2]]; MOST] = [
    &[[0.0, 2.0]],
    &[[0.577_350_269_189_625_8, 1.0]],
    &[[0.0, 8.0 / 9.0], [0.774_596_669_241_483_4, 5.0 / 9.0]],
    &[[0.339_981_043_584_856_26, 0.652_145_154_862_546_1], [0.861_136_311_594_052_6, 0.347_854_845_137_453_86]],
];

/// Nodes, weights and matrix.
#[derive(Clone, Copy, Debug)]
pub(super) struct Collocation<const S: usize> {
    pub(super) a: [[f64; S]; S],
    pub(super) b: [f64; S],
    pub(super) c: [f64; S],
}

impl<const S: usize> Collocation<S> {
    pub(super) fn gauss() -> Self {
        const { assert!(S >= 1 && S <= MOST, "Gauss collocation is available with 1, 2, 3 or 4 stages") };
        let zeros = ZEROS[S - 1];
        let of = |i: usize| {
            // In the order of the nodes: those below the centre are mirror images.
            let from_centre = (2 * i + 1).abs_diff(S) / 2;
            let [zero, weight] =
                zeros[if S % 2 == 1 { from_centre } else { from_centre.min(zeros.len() - 1) }];
            let sign = if 2 * i + 1 < S { -1.0 } else { 1.0 };
            [0.5 + 0.5 * sign * zero, 0.5 * weight]
        };
        let (b, c) = (core::array::from_fn(|i| of(i)[1]), core::array::from_fn(|i| of(i)[0]));
        let mut new = Self { a: [[0.0; S]; S], b, c };
        for i in 0..S {
            new.a[i][i] = 0.5 * b[i];
            for j in i + 1..S {
                let integral = (0..S).map(|k| b[k] * new.lagrange(j, c[i] * c[k])).sum::<f64>();
                new.a[i][j] = c[i] * integral;
                new.a[j][i] = b[i] * (1.0 - new.a[i][j] / b[j]);
            }
        }
        new
    }

    /// The j-th Lagrange polynomial of the nodes at `x`.
    fn lagrange(&self, j: usize, x: f64) -> f64 {
        let others = (0..S).filter(|&k| k != j);
        others.fold(1.0, |product, k| product * (x - self.c[k]) / (self.c[j] - self.c[k]))
    }

    /// Entry (i, j): the j-th Lagrange polynomial at 1 + cᵢ, to continue a polynomial through the stages into the next step.
    pub(super) fn continuation(&self) -> [[f64; S]; S] {
        core::array::from_fn(|i| core::array::from_fn(|j| self.lagrange(j, 1.0 + self.c[i])))
    }
}

#[cfg(test)]
mod tests {
    use super::Collocation;

    /// The simplifying assumptions that define collocation at the zeros of the Legendre polynomial:
    /// C(s): Σⱼ aᵢⱼ cⱼᵏ⁻¹ = cᵢᵏ/k for k ≤ s, and B(2s): Σᵢ bᵢ cᵢᵏ⁻¹ = 1/k for k ≤ 2s.
    fn check<const S: usize>() {
        let Collocation::<S> { a, b, c } = Collocation::gauss();
        assert!(c.is_sorted());
        let moment = |w: &[f64; S], k: i32| w.iter().zip(&c).map(|(w, c)| w * c.powi(k - 1)).sum::<f64>();
        for k in 1..=2 * S as i32 {
            assert!((moment(&b, k) * f64::from(k) - 1.0).abs() < 1e-14, "B({k}) of {S} stages");
        }
        let beyond = 2 * S as i32 + 1;
        assert!((moment(&b, beyond) * f64::from(beyond) - 1.0).abs() > 1e-4, "{S} stages");
        for i in 0..S {
            for k in 1..=S as i32 {
                assert!((moment(&a[i], k) * f64::from(k) - c[i].powi(k)).abs() < 1e-15, "C({k}), row {i}");
            }
            for j in 0..S {
                let symplectic = b[i] * a[i][j] + b[j] * a[j][i] - b[i] * b[j];
                assert!(symplectic.abs() < 1e-16, "{S} stages, ({i}, {j})");
            }
        }
    }

    #[test]
    fn tableaus_are_those_of_gauss() {
        check::<1>();
        check::<2>();
        check::<3>();
        check::<4>();
    }

    #[test]
    fn continuation_reproduces_polynomials_of_the_stages() {
        let tableau = Collocation::<3>::gauss();
        let cubic_free = |x: f64| 2.0 - x + 3.0 * x * x;
        for (row, c) in tableau.continuation().iter().zip(tableau.c) {
            let value: f64 = row.iter().zip(tableau.c).map(|(l, c)| l * cubic_free(c)).sum();
            assert!((value - cubic_free(1.0 + c)).abs() < 1e-12);
        }
    }
}
