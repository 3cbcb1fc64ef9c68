//! Matrices a Dα + b (Dα)ᵀ, ready to be solved with.
//!
//! Where the matrix couples each coordinate to one conjugate only, its inverse is one reciprocal per
//! coordinate. Dα itself has that shape if the system is `MATCHING`; the antisymmetric combinations
//! a = −b, which are multiples of Ω, have it already if the system is `CANONICAL`. Any other matrix is
//! factored.

use core::ops::Range;

use crate::error::StepFailure;
use crate::scalar::passes::blocks;
use crate::scalar::{Lanes, norm};
use crate::solve::sizes;
use crate::space::linear::{power_below, set_scales};
use crate::space::square::SquareMatrix;
use crate::state::Statistics;
use crate::{DegenerateLagrangian, Real, Scalar, Space, Square, System, Vector};

/// The coefficients of a combination a Dα + b (Dα)ᵀ.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Combination<T> {
    pub(crate) a: T,
    pub(crate) b: T,
}

impl<T: Real> Combination<T> {
    fn is_matching<S: DegenerateLagrangian<T>>(self) -> bool {
        S::MATCHING || (S::CANONICAL && self.a == -self.b)
    }
}

/// The inverse of a combination.
#[derive(Debug)]
pub(crate) struct Inverse<S: System, T: Real> {
    /// Entry j is one over the only entry of column j; of other matrices, what row j is multiplied by.
    scales: Vector<S, T>,
    /// The factors of other matrices, and work space.
    factors: Option<(Square<S, T>, Vector<S, T>)>,
}

impl<S: DegenerateLagrangian<T>, T: Real> Inverse<S, T> {
    /// Storage for the inverse of `combination`, which is evaluated at (`q`, `t`); its value comes from
    /// [`prepare`](Self::prepare).
    pub(crate) fn new(system: &S, q: &[T], t: T, combination: Combination<T>) -> Self {
        let (space, Combination { a, b }) = (system.space(), combination);
        let square = || {
            space.square(|visit| {
                let mut places = |row: usize, column: usize, _| visit(row, column);
                system.one_form_jacobian(q, t, a, b, &mut places);
            })
        };
        let factors = (!combination.is_matching::<S>()).then(|| (square(), space.vector()));
        Self { scales: space.vector(), factors }
    }

    /// The factors: none where all combinations match, so that no elimination is compiled into their steps.
    fn factors(&self) -> Option<&Square<S, T>> {
        if S::MATCHING { None } else { self.factors.as_ref().map(|(matrix, _)| matrix) }
    }

    /// Evaluates the combination at (`q`, `t`) and inverts it. `entries` is work space.
    #[inline]
    pub(crate) fn prepare(
        &mut self,
        system: &S,
        q: &[T],
        t: T,
        combination: Combination<T>,
        entries: &mut [T],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let (Self { scales, factors }, Combination { a, b }) = (self, combination);
        let Some((matrix, work)) = factors else {
            system.conjugate_entries(q, t, a, b, entries);
            for j in 0..entries.len() {
                scales[j] = norm::reciprocal(entries[system.conjugate(j)], j)?;
            }
            return Ok(());
        };
        statistics.factorisations += 1;
        // A row has the unit of the action over that of its coordinate, and is compared in its size.
        for block in sizes::blocks(system) {
            entries[block.clone()].fill(sizes::weight_of(norm::largest(&q[block])));
        }
        set_scales(scales, entries);
        scales.iter_mut().for_each(|scale| *scale = power_below(*scale));
        let evaluate = |matrix: &mut Square<S, T>| {
            system.one_form_jacobian(q, t, a, b, matrix.cleared());
            matrix.scale_rows(scales);
        };
        evaluate(matrix);
        matrix.factor().or_else(|_| {
            evaluate(matrix);
            matrix.factor_with_care([entries, work])
        })
    }

    /// Sets `x` to the solution of (a Dα + b (Dα)ᵀ) x = `rhs`.
    #[inline]
    pub(crate) fn solve(&self, system: &S, rhs: &[T], x: &mut [T]) {
        let Some(matrix) = self.factors() else { return divide(system, &self.scales, rhs, (0, x)) };
        for ((x, &rhs), &scale) in x.iter_mut().zip(rhs).zip(self.scales.iter()) {
            *x = rhs * scale;
        }
        matrix.solve(x);
    }
}

/// Sets `x`, which begins with coordinate `first`, to the products of the reciprocals with the entries of
/// the conjugates.
#[inline]
fn divide<S: DegenerateLagrangian<T>, T: Real>(
    system: &S,
    reciprocals: &[T],
    rhs: &[T],
    (first, x): (usize, &mut [T]),
) {
    if <S::Space as Space>::ON_STACK {
        for (j, (x, &reciprocal)) in (first..).zip(x.iter_mut().zip(&reciprocals[first..])) {
            *x = rhs[system.conjugate(j)] * reciprocal;
        }
        return;
    }
    let (mut j, past) = (first, first + x.len());
    while j < past {
        let (end, conjugate) = (system.conjugates_end(j).min(past), system.conjugate(j));
        let x = &mut x[j - first..end - first];
        let conjugates = &rhs[conjugate..conjugate + x.len()];
        for ((x, &entry), &reciprocal) in x.iter_mut().zip(conjugates).zip(&reciprocals[j..end]) {
            *x = entry * reciprocal;
        }
        j = end;
    }
}

impl<S: DegenerateLagrangian<T>, T: Real> Inverse<S, T> {
    /// Gives the solution x, as of [`solve`](Self::solve), to `take`, block by block.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn solve_in_blocks(
        &self,
        system: &S,
        rhs: &[T],
        x: &mut [T],
        mut take: impl FnMut(Range<usize>, &[T]),
    ) {
        if <S::Space as Space>::ON_STACK || self.factors().is_some() {
            self.solve(system, rhs, x);
            return take(0..x.len(), x);
        }
        for block in blocks(x.len()) {
            let x = &mut x[..block.len()];
            divide(system, &self.scales, rhs, (block.start, x));
            take(block, x);
        }
    }

    /// One over the only entry of each column, if that is what the inverse is.
    pub(crate) fn reciprocals(&self) -> Option<&[T]> {
        self.factors().is_none().then_some(&*self.scales)
    }

    /// Sets `x` to the solution, as of [`solve`](Self::solve), with another matrix in each lane: entry i of
    /// `entries` is the only one of row i.
    pub(crate) fn of_entries_in_lanes<const W: usize>(
        system: &S,
        entries: &[Lanes<W, T>],
        rhs: &[Lanes<W, T>],
        x: &mut [Lanes<W, T>],
    ) -> Result<(), StepFailure> {
        let (zero, one) = (Lanes::all(T::lift(0.0)), Lanes::all(T::lift(1.0)));
        let mut finite = zero;
        for j in 0..rhs.len() {
            let conjugate = system.conjugate(j);
            let reciprocal = one / entries[conjugate];
            finite += reciprocal * zero;
            x[j] = rhs[conjugate] * reciprocal;
        }
        if finite == zero { Ok(()) } else { Self::first_singular(system, entries) }
    }

    /// The error of the first lane that has one.
    #[cold]
    fn first_singular<const W: usize>(system: &S, entries: &[Lanes<W, T>]) -> Result<(), StepFailure> {
        for lane in 0..W {
            for j in 0..entries.len() {
                norm::reciprocal(entries[system.conjugate(j)].0[lane], j)?;
            }
        }
        Ok(())
    }
}

/// A constant combination, ready to be multiplied with.
#[derive(Debug)]
pub(crate) struct Product<S: System, T: Real> {
    /// Entry i is the only one of row i.
    entries: Vector<S, T>,
    /// Other matrices, which are evaluated for each product.
    evaluated: Option<Combination<T>>,
}

impl<S: DegenerateLagrangian<T>, T: Real> Product<S, T> {
    /// The combination at (`q`, `t`).
    pub(crate) fn new(system: &S, q: &[T], t: T, combination: Combination<T>) -> Self {
        let mut entries = system.space().vector();
        let evaluated = if combination.is_matching::<S>() {
            system.conjugate_entries(q, t, combination.a, combination.b, &mut entries);
            None
        } else {
            Some(combination)
        };
        Self { entries, evaluated }
    }

    /// Whether the combination is zero, seen from its product with a vector without pattern.
    pub(crate) fn vanishes(&self, system: &S) -> bool {
        let [mut x, mut product]: [Vector<S, T>; 2] = [system.space().vector(), system.space().vector()];
        for (i, x) in x.iter_mut().enumerate() {
            *x = T::lift(1.0) + Scalar::sin(T::lift(i as f64));
        }
        self.apply(system, &x, &mut product);
        product.iter().all(|&entry| entry == T::lift(0.0))
    }

    /// Sets `out` to (a Dα + b (Dα)ᵀ) x.
    pub(crate) fn apply(&self, system: &S, x: &[T], out: &mut [T]) {
        // Not compiled where all combinations match.
        if let (false, Some(Combination { a, b })) = (S::MATCHING, self.evaluated) {
            out.fill(T::lift(0.0));
            // Dα is the same at every point.
            let mut sink = |i: usize, j: usize, entry: T| out[i] += entry * x[j];
            return system.one_form_jacobian(x, T::lift(0.0), a, b, &mut sink);
        }
        for (i, (out, &entry)) in out.iter_mut().zip(self.entries.iter()).enumerate() {
            *out = x[system.conjugate(i)] * entry;
        }
    }
}
