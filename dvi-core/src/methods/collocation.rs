//! Gauss collocation with S stages: nodes, weights and the matrix of the stages.
//!
//! c are the zeros of the shifted Legendre polynomial P_S, bᵢ = ∫₀¹ lᵢ and aᵢⱼ = ∫₀^cᵢ lⱼ with the Lagrange
//! polynomials lⱼ of the nodes (Hairer, Lubich & Wanner 2006, section II.1.3). In Legendre polynomials,
//! whose values at the nodes are at most 1,
//!
//! lⱼ = bⱼ Σₖ (2k+1) Pₖ(cⱼ) Pₖ,   1/bⱼ = Σₖ (2k+1) Pₖ(cⱼ)²,   k = 0 … S−1
//! μᵢⱼ = aᵢⱼ/bⱼ = cᵢ + ½ Σₖ Pₖ(cⱼ) (Pₖ₊₁(cᵢ) − Pₖ₋₁(cᵢ)),   k = 1 … S−1
//!
//! Steps are symplectic if bᵢaᵢⱼ + bⱼaⱼᵢ = bᵢbⱼ (Sanz-Serna 1988). With the numbers μ this is μᵢⱼ + μⱼᵢ = 1,
//! which holds exactly in the arithmetic: of each pair the larger number is rounded, and the other is what
//! it leaves of 1 (Antoñana, Makazaga & Murua 2017, section 3).

pub(super) mod lobatto;
pub(super) mod packs;
pub(super) mod stages;

/// The largest number of stages.
pub(super) const MOST: usize = 8;

/// The zeros of the Legendre polynomial of degree S that are not negative (Abramowitz & Stegun 1964, table
/// 25.4).
#[rustfmt::skip]
const ZEROS: [&[f64]; MOST] = [
    &[0.0],
    &[0.577_350_269_189_625_7],
    &[0.0, 0.774_596_669_241_483_4],
    &[0.339_981_043_584_856_26, 0.861_136_311_594_052_6],
    &[0.0, 0.538_469_310_105_683_1, 0.906_179_845_938_664],
    &[0.238_619_186_083_196_9, 0.661_209_386_466_264_5, 0.932_469_514_203_152],
    &[0.0, 0.405_845_151_377_397_2, 0.741_531_185_599_394_5, 0.949_107_912_342_758_5],
    &[0.183_434_642_495_649_8, 0.525_532_409_916_329, 0.796_666_477_413_626_7, 0.960_289_856_497_536_3],
];

/// Nodes, weights and matrix.
#[derive(Clone, Copy, Debug)]
pub(super) struct Collocation<const S: usize> {
    /// μᵢⱼ = aᵢⱼ/bⱼ
    pub(super) mu: [[f64; S]; S],
    pub(super) a: [[f64; S]; S],
    pub(super) b: [f64; S],
    pub(super) c: [f64; S],
}

/// P₀, P₁, … at a point of [0, 1], or beyond; those above degree S are not used.
pub(super) fn legendre(x: f64) -> [f64; MOST + 1] {
    let z = 2.0 * x - 1.0;
    let mut p = [1.0; MOST + 1];
    p[1] = z;
    for k in 1..MOST {
        let degree = k as f64;
        p[k + 1] = ((2.0 * degree + 1.0) * z * p[k] - degree * p[k - 1]) / (degree + 1.0);
    }
    p
}

/// Σₖ (2k+1) pₖ rₖ, k = 0 … S−1.
fn sum<const S: usize>(p: &[f64], r: &[f64]) -> f64 {
    (0..S).map(|k| (2 * k + 1) as f64 * p[k] * r[k]).sum()
}

impl<const S: usize> Collocation<S> {
    pub(super) fn gauss() -> Self {
        const { assert!(S >= 1 && S <= MOST, "Gauss collocation is available with 1 to 8 stages") };
        let zeros = ZEROS[S - 1];
        let c = core::array::from_fn(|i| {
            // In the order of the nodes: those below the centre are mirror images.
            let from_centre = (2 * i + 1).abs_diff(S) / 2;
            let zero = zeros[if S % 2 == 1 { from_centre } else { from_centre.min(zeros.len() - 1) }];
            0.5 + if 2 * i + 1 < S { -0.5 } else { 0.5 } * zero
        });
        let p = c.map(legendre);
        let b: [f64; S] = core::array::from_fn(|j| 1.0 / sum::<S>(&p[j], &p[j]));
        let mut mu = [[0.5; S]; S];
        for i in 0..S {
            // Below the diagonal stand the larger numbers, between ½ and 2.
            for j in 0..i {
                let terms = (1..S).map(|k| p[j][k] * (p[i][k + 1] - p[i][k - 1]));
                mu[i][j] = c[i] + 0.5 * terms.sum::<f64>();
                mu[j][i] = 1.0 - mu[i][j];
            }
        }
        let a = core::array::from_fn(|i| core::array::from_fn(|j| mu[i][j] * b[j]));
        Self { mu, a, b, c }
    }

    /// ν and β of the method on q'' = f(q, t), with the velocities of the stages eliminated: aᵢⱼ = νᵢⱼbⱼ in
    /// Qᵢ and bⱼβⱼ in q⁺, where
    ///
    /// νᵢⱼ = Σₖ μᵢₖ bₖ μₖⱼ,   βⱼ = Σₖ bₖ μₖⱼ = 1 − cⱼ
    ///
    /// Steps are symplectic if νᵢⱼ − νⱼᵢ = βⱼ − βᵢ (Suris 1989). This holds exactly in the arithmetic, since
    /// all these numbers are multiples of 2⁻⁵³ below 1, whose differences are not rounded (Antoñana,
    /// Makazaga & Murua 2025).
    pub(super) fn nystrom(&self) -> ([[f64; S]; S], [f64; S]) {
        let Self { mu, b, c, .. } = self;
        // Below the centre a node has finer digits than 2⁻⁵³, and is what that above leaves of 1.
        let beta: [f64; S] = core::array::from_fn(|j| if 2 * j < S { c[S - 1 - j] } else { 1.0 - c[j] });
        let mut nu = [[0.0; S]; S];
        for i in 0..S {
            for j in 0..=i {
                let exact: f64 = (0..S).map(|k| mu[i][k] * b[k] * mu[k][j]).sum();
                nu[i][j] = if exact < 0.5 { (exact + 0.5) - 0.5 } else { exact };
                nu[j][i] = nu[i][j] - (beta[j] - beta[i]);
            }
        }
        (nu, beta)
    }

    /// Entry (k, j): the coefficient of Pₖ in the j-th Lagrange polynomial, bⱼ (2k+1) Pₖ(cⱼ).
    pub(super) fn lagrange(&self) -> [[f64; S]; S] {
        let within = self.c.map(legendre);
        core::array::from_fn(|k| core::array::from_fn(|j| self.b[j] * (2 * k + 1) as f64 * within[j][k]))
    }

    /// Entry (i, j): the integral of the j-th Lagrange polynomial from 0 to point i.
    pub(super) fn integrals<const N: usize>(&self, points: [f64; N]) -> [[f64; S]; N] {
        let lagrange = self.lagrange();
        points.map(|x| {
            let p = legendre(x);
            let integral = |k: usize| if k == 0 { x } else { (p[k + 1] - p[k - 1]) / (4 * k + 2) as f64 };
            core::array::from_fn(|j| (0..S).map(|k| lagrange[k][j] * integral(k)).sum())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Collocation;

    /// The simplifying assumptions that define collocation at the zeros of the Legendre polynomial:
    /// C(s): Σⱼ aᵢⱼ cⱼᵏ⁻¹ = cᵢᵏ/k for k ≤ s, and B(2s): Σᵢ bᵢ cᵢᵏ⁻¹ = 1/k for k ≤ 2s.
    fn check<const S: usize>() {
        let tableau = Collocation::<S>::gauss();
        let Collocation { mu, a, b, c } = tableau;
        assert!(c.is_sorted());
        let moment = |w: &[f64; S], k: i32| w.iter().zip(&c).map(|(w, c)| w * c.powi(k - 1)).sum::<f64>();
        for k in 1..=2 * S as i32 {
            assert!((moment(&b, k) * f64::from(k) - 1.0).abs() < 1e-14, "B({k}) of {S} stages");
        }
        let beyond = 2 * S as i32 + 1;
        assert!((moment(&b, beyond) * f64::from(beyond) - 1.0).abs() > 1e-9, "{S} stages");
        for i in 0..S {
            for k in 1..=S as i32 {
                assert!((moment(&a[i], k) * f64::from(k) - c[i].powi(k)).abs() < 1e-15, "C({k}), row {i}");
            }
            for j in 0..S {
                assert_eq!(mu[i][j] + mu[j][i], 1.0, "{S} stages, ({i}, {j})");
                let symplectic = b[i] * a[i][j] + b[j] * a[j][i] - b[i] * b[j];
                assert!(symplectic.abs() < 1e-16, "{S} stages, ({i}, {j})");
            }
        }
        let (nu, beta) = tableau.nystrom();
        for i in 0..S {
            assert!((beta[i] + c[i] - 1.0).abs() < 1e-15);
            for j in 0..S {
                // Without rounding: each is a multiple of 2⁻⁵³, and so in integers.
                let [ij, ji, of_i, of_j] =
                    [nu[i][j], nu[j][i], beta[i], beta[j]].map(|x| x * 2_f64.powi(53));
                assert!([ij, ji, of_i, of_j].iter().all(|x| x.fract() == 0.0), "{S} stages, ({i}, {j})");
                assert_eq!(ij as i64 - ji as i64, of_j as i64 - of_i as i64, "{S} stages, ({i}, {j})");
            }
            // Σⱼ aᵢⱼ cⱼᵏ = cᵢᵏ⁺²/((k+1)(k+2)) for k < S − 1, of the quadrature twice.
            for k in 0..S as i32 - 1 {
                let sum: f64 = (0..S).map(|j| nu[i][j] * b[j] * c[j].powi(k)).sum();
                let exact = c[i].powi(k + 2) / f64::from((k + 1) * (k + 2));
                assert!((sum - exact).abs() < 1e-15, "{S} stages, row {i}, degree {k}");
            }
        }
    }

    #[test]
    fn tableaus_are_those_of_gauss() {
        check::<1>();
        check::<2>();
        check::<3>();
        check::<4>();
        check::<5>();
        check::<6>();
        check::<7>();
        check::<8>();
    }
}
