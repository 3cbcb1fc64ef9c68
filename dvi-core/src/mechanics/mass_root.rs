//! A matrix A with A Aᵀ = M, by which independent normal numbers become those of the covariance M.

use super::mass::Mass;
use crate::error::StepFailure;
use crate::scalar::norm;
use crate::space::{lines, lines_mut};
use crate::{Matrix, NondegenerateLagrangian, Real, Scalar, Space, System, Vector};

/// A root of a constant mass matrix.
#[derive(Debug)]
pub(crate) enum MassRoot<S: System, T: Real> {
    /// Of a diagonal matrix: its entries.
    Diagonal(Vector<S, T>),
    /// The lower triangle of Cholesky's factorisation, row-major.
    Lower(Matrix<S, T>),
}

impl<S: NondegenerateLagrangian<T>, T: Real> MassRoot<S, T> {
    /// # Errors
    /// [`StepFailure::Singular`] if the matrix is not positive definite.
    pub(crate) fn new(system: &S, mass: &Mass<S, T>) -> Result<Self, StepFailure> {
        let (space, one) = (system.space(), T::lift(1.0));
        let mut unit: Vector<S, T> = space.vector();
        if S::DIAGONAL_MASS {
            let mut root: Vector<S, T> = space.vector();
            unit.fill(one);
            mass.multiply_add(one, &unit, &mut root);
            for (column, entry) in root.iter_mut().enumerate() {
                *entry = positive_root(*entry, column)?;
            }
            return Ok(Self::Diagonal(root));
        }
        let mut matrix = space.matrix();
        let n = unit.len();
        for (j, row) in lines_mut(&mut matrix, n).enumerate() {
            unit.fill(T::lift(0.0));
            unit[j] = one;
            // M is symmetric: its column is its row.
            mass.multiply_add(one, &unit, row);
        }
        factor(&mut matrix, n)?;
        Ok(Self::Lower(matrix))
    }

    /// Sets `out` to A`x`.
    pub(crate) fn multiply(&self, x: &[T], out: &mut [T]) {
        match self {
            Self::Diagonal(root) => {
                for ((out, &x), &root) in out.iter_mut().zip(x).zip(root.iter()) {
                    *out = root * x;
                }
            }
            Self::Lower(rows) => {
                let rows = lines(rows, x.len()).enumerate();
                for (out, (i, row)) in out.iter_mut().zip(rows) {
                    *out = row[..=i].iter().zip(x).fold(T::lift(0.0), |sum, (&a, &x)| sum + a * x);
                }
            }
        }
    }
}

fn positive_root<T: Real>(pivot: T, column: usize) -> Result<T, StepFailure> {
    let is_positive = pivot > T::lift(0.0);
    if is_positive {
        Ok(Scalar::sqrt(pivot))
    } else {
        Err(norm::singular(pivot, column).of(StepFailure::MASS_ROOT))
    }
}

/// Overwrites the lower triangle of a symmetric matrix with that of its factor (Golub & Van Loan 2013,
/// section 4.2.5).
fn factor<T: Real>(matrix: &mut [T], n: usize) -> Result<(), StepFailure> {
    for i in 0..n {
        for j in 0..=i {
            let products = (0..j).map(|k| matrix[i * n + k] * matrix[j * n + k]);
            let rest = products.fold(matrix[i * n + j], |rest, product| rest - product);
            matrix[i * n + j] = if i == j { positive_root(rest, i)? } else { rest / matrix[j * n + j] };
        }
    }
    Ok(())
}
