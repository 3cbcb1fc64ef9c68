//! Matrices a Dα + b (Dα)ᵀ, ready to be solved with.
//!
//! Where the matrix couples each coordinate to one partner only, its inverse is one reciprocal per
//! coordinate. Dα itself has that shape if the system is `MATCHING`; the antisymmetric combinations
//! a = −b, which are multiples of Ω, have it already if the system is `CANONICAL`. Any other matrix is
//! factored.

use crate::error::StepFailure;
use crate::statistics::Statistics;
use crate::{
    DegenerateLagrangian, Lagrangian, Matrix, Permutation, Real, Scalar, Space, Vector, elimination, norm,
};

/// The coefficients of a combination a Dα + b (Dα)ᵀ.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Combination<T> {
    pub(crate) a: T,
    pub(crate) b: T,
}

impl<T: Real> Combination<T> {
    fn is_matching<S: DegenerateLagrangian>(self) -> bool {
        S::MATCHING || (S::CANONICAL && self.a == -self.b)
    }
}

/// The inverse of a combination.
#[derive(Debug)]
pub(crate) enum Form<S: Lagrangian, T: Real> {
    /// Entry j is one over the only entry of column j.
    Reciprocals(Vector<S, T>),
    /// The factors of the matrix.
    Factors(Matrix<S, T>, Permutation<S>),
}

impl<S: Lagrangian, T: Real> Clone for Form<S, T> {
    fn clone(&self) -> Self {
        match self {
            Self::Reciprocals(reciprocals) => Self::Reciprocals(reciprocals.clone()),
            Self::Factors(matrix, permutation) => Self::Factors(matrix.clone(), permutation.clone()),
        }
    }
}

impl<S: DegenerateLagrangian, T: Real> Form<S, T> {
    /// Storage for the inverse of `combination`; its value comes from [`prepare`](Self::prepare).
    pub(crate) fn new(system: &S, combination: Combination<T>) -> Self {
        let space = system.space();
        if combination.is_matching::<S>() {
            Self::Reciprocals(space.vector())
        } else {
            Self::Factors(space.matrix(), space.permutation())
        }
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
        let Combination { a, b } = combination;
        match self {
            Self::Reciprocals(reciprocals) => {
                system.partner_entries(q, t, a, b, entries);
                for j in 0..entries.len() {
                    reciprocals[j] = norm::reciprocal(entries[system.partner(j)], j)?;
                }
                Ok(())
            }
            Self::Factors(matrix, permutation) => {
                statistics.factorisations += 1;
                matrix.fill(T::lift(0.0));
                system.one_form_jacobian(q, t, a, b, matrix);
                elimination::factor(matrix, permutation)
            }
        }
    }

    /// Sets `x` to the solution of (a Dα + b (Dα)ᵀ) x = `rhs`.
    #[inline(always)]
    pub(crate) fn solve(&self, system: &S, rhs: &[T], x: &mut [T]) {
        match self {
            Self::Reciprocals(reciprocals) => {
                for (j, (x, &reciprocal)) in x.iter_mut().zip(reciprocals.iter()).enumerate() {
                    *x = rhs[system.partner(j)] * reciprocal;
                }
            }
            // Never built for such a system; saying so keeps elimination out of its steps.
            Self::Factors(..) if S::MATCHING => {}
            Self::Factors(matrix, permutation) => {
                x.copy_from_slice(rhs);
                elimination::solve(matrix, permutation, x);
            }
        }
    }
}

/// A constant combination, ready to be multiplied with.
#[derive(Debug)]
pub(crate) enum Product<S: Lagrangian, T: Real> {
    /// Entry i is the only entry of row i.
    Entries(Vector<S, T>),
    /// All entries.
    Dense(Matrix<S, T>),
}

impl<S: Lagrangian, T: Real> Clone for Product<S, T> {
    fn clone(&self) -> Self {
        match self {
            Self::Entries(entries) => Self::Entries(entries.clone()),
            Self::Dense(matrix) => Self::Dense(matrix.clone()),
        }
    }
}

impl<S: DegenerateLagrangian, T: Real> Product<S, T> {
    /// The combination at (`q`, `t`).
    pub(crate) fn new(system: &S, q: &[T], t: T, combination: Combination<T>) -> Self {
        let (space, Combination { a, b }) = (system.space(), combination);
        if combination.is_matching::<S>() {
            let mut entries = space.vector();
            system.partner_entries(q, t, a, b, &mut entries);
            Self::Entries(entries)
        } else {
            let mut matrix = space.matrix();
            system.one_form_jacobian(q, t, a, b, &mut matrix);
            Self::Dense(matrix)
        }
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
    #[inline(always)]
    pub(crate) fn apply(&self, system: &S, x: &[T], out: &mut [T]) {
        match self {
            Self::Entries(entries) => {
                for (i, (out, &entry)) in out.iter_mut().zip(entries.iter()).enumerate() {
                    *out = x[system.partner(i)] * entry;
                }
            }
            Self::Dense(_) if S::MATCHING => {}
            Self::Dense(matrix) => {
                out.fill(T::lift(0.0));
                elimination::multiply_add(matrix, x, out);
            }
        }
    }
}
