//! The coefficients of Gauss collocation in packs over the stages, and what is combined with them.
//!
//! Σⱼ aⱼ xⱼ, where a number x of each stage has a lane, is a sum of columns aⱼ. It is taken of several numbers at once, so that each
//! column is read once for all of them while their sums stay in registers.

use crate::Real;
use crate::methods::collocation::Collocation;
use crate::scalar::{Lanes, norm};

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

/// The same for equations of second order, of which the velocities of the stages have been eliminated.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nystrom<const STAGES: usize, T> {
    /// Column j of ν.
    pub(super) nu: [Lanes<STAGES, T>; STAGES],
    pub(super) beta: Lanes<STAGES, T>,
    /// 1 − β.
    pub(super) nodes: Lanes<STAGES, T>,
}

/// So far the polynomial of a step is continued, in units of that step: to the end of one that is twice as long, and back over it and
/// as far beyond.
const REACH: [f64; 2] = [-3.0, 2.0];

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
    #[inline(always)]
    pub(super) fn continuation_over(&self, ratio: T) -> [Lanes<STAGES, T>; STAGES] {
        let [back, ahead] = REACH.map(T::lift);
        let ratio = if ratio > ahead { ahead } else { norm::larger(back, ratio) };
        self.lagrange_at(Lanes::all(T::lift(1.0)) + Lanes::all(ratio) * self.c)
    }

    /// The Lagrange polynomials at the start of the step.
    #[inline(always)]
    pub(super) fn at_start(&self) -> [T; STAGES] {
        self.lagrange_at(Lanes::all(T::lift(0.0))).map(|column| column.0[0])
    }

    /// The Lagrange polynomials at points `x` of the step, whose ends are 0 and 1, or beyond.
    #[inline(always)]
    fn lagrange_at(&self, x: Lanes<STAGES, T>) -> [Lanes<STAGES, T>; STAGES] {
        let number = |value: f64| Lanes::all(T::lift(value));
        let z = number(2.0) * x - number(1.0);
        let (mut last, mut legendre) = (number(0.0), number(1.0));
        let mut columns = [number(0.0); STAGES];
        for k in 0..STAGES {
            for j in 0..STAGES {
                columns[j] += Lanes::all(self.lagrange[k][j]) * legendre;
            }
            let degree = k as f64;
            let next = number((2.0 * degree + 1.0) / (degree + 1.0)) * z * legendre
                - number(degree / (degree + 1.0)) * last;
            (last, legendre) = (legendre, next);
        }
        columns
    }
}

/// How many numbers of a point are combined at once.
const BLOCK: usize = 4;

/// Sets pack k of `out` to y + (e + Σⱼ `columns`ⱼ xⱼ), for the numbers x in the lanes of that pack of `packs` and `from`(k) = (y, e), where y is
/// the same for all stages.
#[inline(always)]
pub(super) fn combine<const STAGES: usize, T: Real>(
    columns: &[Lanes<STAGES, T>; STAGES],
    packs: &[Lanes<STAGES, T>],
    from: impl Fn(usize) -> (T, Lanes<STAGES, T>),
    out: &mut [Lanes<STAGES, T>],
) {
    let (blocks, left) = packs.as_chunks::<BLOCK>();
    let (outs, out_left) = out.as_chunks_mut::<BLOCK>();
    let mut first = 0;
    for (packs, out) in blocks.iter().zip(outs) {
        *out = combine_block(columns, packs, core::array::from_fn(|k| from(first + k)));
        first += BLOCK;
    }
    for (k, (pack, out)) in left.iter().zip(out_left).enumerate() {
        [*out] = combine_block(columns, &[*pack], [from(first + k)]);
    }
}

#[inline(always)]
fn combine_block<const STAGES: usize, const N: usize, T: Real>(
    columns: &[Lanes<STAGES, T>; STAGES],
    packs: &[Lanes<STAGES, T>; N],
    from: [(T, Lanes<STAGES, T>); N],
) -> [Lanes<STAGES, T>; N] {
    let mut sums = [Lanes::all(T::lift(0.0)); N];
    for k in 0..N {
        sums[k] = from[k].1;
    }
    for j in 0..STAGES {
        for k in 0..N {
            sums[k] += columns[j] * Lanes::all(packs[k].0[j]);
        }
    }
    for k in 0..N {
        sums[k] = Lanes::all(from[k].0) + sums[k];
    }
    sums
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
