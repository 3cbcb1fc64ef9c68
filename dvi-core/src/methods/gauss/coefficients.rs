//! The coefficients of Gauss collocation in packs over the stages.

use crate::Real;
use crate::methods::collocation::lobatto::extrema;
use crate::methods::collocation::packs::{Nystrom, continuation, lagrange_at};
use crate::methods::collocation::{Collocation, legendre};
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
    pub(super) extrema: Extrema<STAGES, T>,
}

/// The extrema of P_S in a step: its start, its end, and a point in each gap between two nodes. Packs are
/// over all of them but the start, or over the moments mₖ with k < S.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extrema<const STAGES: usize, T> {
    pub(super) c: Lanes<STAGES, T>,
    /// Column j: the Lagrange polynomial of node j.
    pub(super) values: [Lanes<STAGES, T>; STAGES],
    /// Column j: its integral from the start of the step.
    pub(super) integrals: [Lanes<STAGES, T>; STAGES],
    /// The Lagrange polynomials at the start of the step.
    pub(super) at_start: Lanes<STAGES, T>,
    /// Column i: what a defect at point i contributes to the moments.
    pub(super) moments: [Lanes<STAGES, T>; STAGES],
    /// What the defect at the start does.
    pub(super) moments_of_start: Lanes<STAGES, T>,
    /// What the defects at all points contribute to m_S, and that at the start.
    pub(super) last_moment: (Lanes<STAGES, T>, T),
}

impl<const STAGES: usize, T: Real> Extrema<STAGES, T> {
    fn new(tableau: &Collocation<STAGES>) -> Self {
        let extrema = extrema::<STAGES>();
        let c = extrema.map(|[c, _]| c);
        let lagrange = tableau.lagrange().map(|row| row.map(T::lift));
        let share = STAGES as f64 / (2 * STAGES + 1) as f64;
        let contributions = extrema.map(|[c, b]| legendre(c).map(|p| share * b * p));
        // The start is the mirror image of the end, where all Legendre polynomials are 1.
        let of_start =
            |k: usize| if k.is_multiple_of(2) { 1.0 } else { -1.0 } * contributions[STAGES - 1][k];
        let lanes = |number: &dyn Fn(usize) -> f64| Lanes(core::array::from_fn(|k| T::lift(number(k))));
        let points = lanes(&|i| c[i]);
        Self {
            c: points,
            values: lagrange_at(&lagrange, points),
            integrals: columns(tableau.integrals(c)),
            at_start: Lanes(lagrange_at::<1, _, _>(&lagrange, Lanes::all(T::lift(0.0))).map(|l| l.0[0])),
            moments: core::array::from_fn(|i| lanes(&|k| contributions[i][k])),
            moments_of_start: lanes(&of_start),
            last_moment: (lanes(&|i| contributions[i][STAGES]), T::lift(of_start(STAGES))),
        }
    }
}

/// The columns of a matrix.
fn columns<const STAGES: usize, T: Real>(rows: [[f64; STAGES]; STAGES]) -> [Lanes<STAGES, T>; STAGES] {
    core::array::from_fn(|j| Lanes(core::array::from_fn(|i| T::lift(rows[i][j]))))
}

impl<const STAGES: usize, T: Real> Coefficients<STAGES, T> {
    pub(super) fn new() -> Self {
        let tableau = Collocation::<STAGES>::gauss();
        let [b, c] = [tableau.b, tableau.c].map(|numbers| Lanes(numbers.map(T::lift)));
        let lagrange = tableau.lagrange().map(|row| row.map(T::lift));
        let (nu, beta) = tableau.nystrom();
        let [beta, nodes] = [beta, beta.map(|beta| 1.0 - beta)].map(|numbers| Lanes(numbers.map(T::lift)));
        let nystrom = Nystrom { nu: columns(nu), beta, nodes };
        Self {
            mu: columns(tableau.mu),
            continuation: continuation(&lagrange, c, T::lift(1.0)),
            lagrange,
            b,
            c,
            nystrom,
            extrema: Extrema::new(&tableau),
        }
    }

    /// Column j of the continuation into a step whose length is `ratio` times that of the one before.
    pub(super) fn continuation_over(&self, ratio: T) -> [Lanes<STAGES, T>; STAGES] {
        continuation(&self.lagrange, self.c, ratio)
    }

    /// Column j of the values in a `part` of the step from its beginning.
    pub(super) fn within(&self, part: T) -> [Lanes<STAGES, T>; STAGES] {
        lagrange_at(&self.lagrange, Lanes::all(part) * self.c)
    }
}

#[cfg(test)]
mod tests {
    use super::{Coefficients, legendre};

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
            let value: f64 = coefficients.extrema.at_start.0.iter().zip(through).map(|(l, y)| l * y).sum();
            assert!((value - polynomial(0.0)).abs() < 1e-13);
            for (i, c) in coefficients.extrema.c.0.into_iter().enumerate() {
                let columns = coefficients.extrema.values.iter().zip(through);
                let value: f64 = columns.map(|(column, y)| column.0[i] * y).sum();
                assert!((value - polynomial(c)).abs() < 1e-13, "{c}");
            }
        }
        check::<1>(|_| 2.0, 1e-15);
        check::<3>(|x| 2.0 - x + 3.0 * x * x, 1e-12);
        // The coefficients of eight stages are as large as 10⁵, and for a step that is twice as long 10⁷.
        check::<8>(|x| (x - 0.25).powi(7), 1e-8);
    }

    /// Extrema of P_S lie between its zeros, which are the nodes; a rule of both sets of points, weighted by
    /// S + 1 and S, is exact to degree 2S, one more than each alone is.
    #[test]
    fn extrema_and_nodes_are_a_rule_of_one_degree_more() {
        fn check<const STAGES: usize>() {
            let Coefficients { b, c, extrema, .. } = Coefficients::<STAGES, f64>::new();
            let s = STAGES as f64;
            for j in 0..STAGES {
                let before = if j == 0 { 0.0 } else { extrema.c.0[j - 1] };
                assert!(before < c.0[j] && c.0[j] < extrema.c.0[j], "{STAGES}, {j}");
            }
            for degree in 0..=2 * STAGES as i32 {
                // m₀ of a function that vanishes at the nodes is its integral: here with the mean of the
                // Gauss rule taken for these.
                let power = |x: f64| x.powi(degree);
                let gauss: f64 = b.0.iter().zip(c.0).map(|(b, c)| b * power(c)).sum();
                let points =
                    extrema.moments.iter().zip(extrema.c.0).map(|(column, c)| column.0[0] * power(c));
                let moment = points.sum::<f64>() + extrema.moments_of_start.0[0] * power(0.0);
                let whole = (s + 1.0) / (2.0 * s + 1.0) * gauss + moment;
                assert!((whole * f64::from(degree + 1) - 1.0).abs() < 1e-14, "{STAGES}, {degree}");
            }
            // m_S of P_S, which is 1 at the end, and m₀ … of it.
            let (mut moments, mut last) = ([0.0; STAGES], 0.0);
            let places = extrema.c.0.into_iter().zip(extrema.moments).zip(extrema.last_moment.0.0);
            let start = ((0.0, extrema.moments_of_start), extrema.last_moment.1);
            for ((c, column), of_last) in places.chain([start]) {
                let value = legendre(c)[STAGES];
                last += of_last * value;
                for (moment, of_point) in moments.iter_mut().zip(column.0) {
                    *moment += of_point * value;
                }
            }
            assert!((last * (2.0 * s + 1.0) - 1.0).abs() < 1e-14, "{STAGES}: {last}");
            assert!(moments.iter().all(|moment| moment.abs() < 1e-15), "{STAGES}: {moments:?}");
            for (j, (b, node)) in b.0.into_iter().zip(c.0).enumerate() {
                assert!((extrema.integrals[j].0[STAGES - 1] - b).abs() < 1e-15, "{STAGES}, {node}");
            }
            for (i, c) in extrema.c.0.into_iter().enumerate() {
                let sum: f64 = extrema.integrals.iter().map(|column| column.0[i]).sum();
                assert!((sum - c).abs() < 1e-15, "{STAGES}, {c}");
            }
        }
        check::<1>();
        check::<2>();
        check::<3>();
        check::<5>();
        check::<8>();
    }
}
