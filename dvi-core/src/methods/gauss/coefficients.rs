//! The coefficients of Gauss collocation in packs over the stages.

use crate::Real;
use crate::methods::collocation::Collocation;
use crate::methods::collocation::packs::{Nystrom, continuation, lagrange_at};
use crate::scalar::Lanes;

/// Coefficients in packs over the stages that they lead to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coefficients<const STAGES: usize, T> {
    /// Column j of μ.
    pub(super) mu: [Lanes<STAGES, T>; STAGES],
    /// Column j of the continuation into a step of the same length.
    pub(super) continuation: [Lanes<STAGES, T>; STAGES],
    /// The Lagrange polynomials of the stages, row k in terms of the Legendre polynomial of degree k.
    lagrange: [[T; STAGES]; STAGES],
    pub(super) b: Lanes<STAGES, T>,
    pub(super) c: Lanes<STAGES, T>,
    pub(super) nystrom: Nystrom<STAGES, T>,
}

impl<const STAGES: usize, T: Real> Coefficients<STAGES, T> {
    pub(super) fn new() -> Self {
        let tableau = Collocation::<STAGES>::gauss();
        let columns = |rows: [[f64; STAGES]; STAGES]| {
            core::array::from_fn(|j| Lanes(core::array::from_fn(|i| T::lift(rows[i][j]))))
        };
        let [b, c] = [tableau.b, tableau.c].map(|numbers| Lanes(numbers.map(T::lift)));
        let lagrange = tableau.lagrange().map(|row| row.map(T::lift));
        let (nu, beta) = tableau.nystrom();
        let [beta, nodes] = [beta, beta.map(|beta| 1.0 - beta)].map(|numbers| Lanes(numbers.map(T::lift)));
        let nystrom = Nystrom { nu: columns(nu), beta, nodes };
        Self {
            mu: columns(tableau.mu),
            continuation: columns(tableau.continuation()),
            lagrange,
            b,
            c,
            nystrom,
        }
    }

    /// Column j of the continuation into a step whose length is `ratio` times that of the one before.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn continuation_over(&self, ratio: T) -> [Lanes<STAGES, T>; STAGES] {
        continuation(&self.lagrange, self.c, ratio)
    }

    /// The Lagrange polynomials at the start of the step.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn at_start(&self) -> [T; STAGES] {
        lagrange_at(&self.lagrange, Lanes::<STAGES, T>::all(T::lift(0.0))).map(|column| column.0[0])
    }
}

#[cfg(test)]
mod tests {
    use super::Coefficients;

    #[test]
    fn continuation_reproduces_polynomials_of_the_stages() {
        fn check<const STAGES: usize>(polynomial: fn(f64) -> f64, bound: f64) {
            let coefficients = Coefficients::<STAGES, f64>::new();
            let through = coefficients.c.0.map(polynomial);
            for ratio in [1.0, 0.3, 2.0, -1.0] {
                let columns = coefficients.continuation_over(ratio);
                for (i, c) in coefficients.c.0.into_iter().enumerate() {
                    let value: f64 = columns.iter().zip(through).map(|(column, y)| column.0[i] * y).sum();
                    assert!((value - polynomial(1.0 + ratio * c)).abs() < bound, "{ratio}, {c}");
                }
            }
            let value: f64 = coefficients.at_start().iter().zip(through).map(|(l, y)| l * y).sum();
            assert!((value - polynomial(0.0)).abs() < 1e-13);
        }
        check::<1>(|_| 2.0, 1e-15);
        check::<3>(|x| 2.0 - x + 3.0 * x * x, 1e-12);
        // The coefficients of eight stages are as large as 10⁵, and for a step that is twice as long 10⁷.
        check::<8>(|x| (x - 0.25).powi(7), 1e-8);
    }
}
