//! Linear equations from products with vectors alone: the generalised minimal residual method, restarted,
//! with the preconditioner on the right (Saad & Schultz 1986, SIAM J. Sci. Stat. Comput. 7, 856; Saad 2003,
//! section 9.3.2).
//!
//! The preconditioner keeps the largest entry of each row, if these stand in columns of their own: the
//! diagonal of a mass matrix, or the entries by which Ω couples coordinates in pairs.

use alloc::vec;
use alloc::vec::Vec;

use super::{LinearEquations, LinearSolver, scale, set_scales};
use crate::error::StepFailure;
use crate::scalar::norm::{self, reported};
use crate::scalar::passes::dot;
use crate::{Real, Scalar};

/// The dimension of the spaces that residuals are minimised in.
const BASIS: usize = 40;

/// How often the method begins again from what it has.
const RESTARTS: usize = 5;

/// By this factor the residual is to become smaller. Newton's method, which asks for a correction, does the
/// rest.
const REDUCTION: f64 = 1e-10;

/// A residual that is larger than this part of what it was is no progress.
const PROGRESS: f64 = 0.1;

/// [`Krylov::multiply`] by the matrix of some equations.
type Multiply<'a, T> = dyn FnMut(&mut Krylov<T>, usize) -> Result<(), StepFailure> + 'a;

/// Storage for the method.
#[derive(Debug)]
pub struct Krylov<T> {
    /// Orthonormal vectors, one after the other.
    basis: Vec<T>,
    /// The columns of the Hessenberg matrix, made triangular by the rotations.
    columns: Vec<[T; BASIS + 1]>,
    rotations: [[T; 2]; BASIS],
    /// The column of the largest entry of each row, and one over that entry.
    pivots: Vec<(usize, T)>,
    /// b, which is overwritten at each evaluation of the equations.
    unused: Vec<T>,
    solution: Vec<T>,
    work: [Vec<T>; 2],
    /// The sizes of the unknowns: in units of these, unknowns and equations are about one.
    scales: Vec<T>,
}

impl<T: Scalar> Krylov<T> {
    pub(super) fn new(dimension: usize) -> Self {
        let zero = T::lift(0.0);
        let vector = || vec![zero; dimension];
        Self {
            basis: vec![zero; (BASIS + 1) * dimension],
            columns: vec![[zero; BASIS + 1]; BASIS],
            rotations: [[zero; 2]; BASIS],
            pivots: vec![(0, zero); dimension],
            unused: vector(),
            solution: vector(),
            work: [vector(), vector()],
            scales: vector(),
        }
    }
}

impl<T: Real> LinearSolver<T> for Krylov<T> {
    fn solve(
        &mut self,
        equations: &mut impl LinearEquations<T>,
        weights: &[T],
        x: &mut [T],
    ) -> Result<(), StepFailure> {
        set_scales(&mut self.scales, weights);
        self.find_pivots(equations, x)?;
        self.solution.fill(T::lift(0.0));
        let begin = length(x);
        let (mut left, mut products) = (begin, 0);
        let target = T::lift(REDUCTION) * begin;
        for _ in 0..RESTARTS {
            // Of a residual that is zero, or no number at all, nothing is left to do.
            let unfinished = left > target;
            if !unfinished {
                break;
            }
            let multiply = &mut |krylov: &mut Self, begin| krylov.multiply(equations, begin);
            products += self.minimise(multiply, x, [left, target])?;
            left = length(x);
        }
        x.copy_from_slice(&self.solution);
        norm::finite(x)?;
        if left > T::lift(PROGRESS) * begin {
            let [correction, tolerance] = [left, target].map(reported);
            return Err(StepFailure::NotConverged { iterations: products, correction, tolerance });
        }
        Ok(())
    }
}

impl<T: Real> Krylov<T> {
    /// Sets `b`, and the preconditioner: the identity if two rows have their largest entry in one column.
    fn find_pivots(
        &mut self,
        equations: &mut impl LinearEquations<T>,
        b: &mut [T],
    ) -> Result<(), StepFailure> {
        let (zero, one) = (T::lift(0.0), T::lift(1.0));
        let Self { pivots, unused, work: [diagonal, taken], scales, .. } = self;
        let (pivots, diagonal, scales) = (&mut pivots[..], &mut diagonal[..], &scales[..]);
        pivots.iter_mut().enumerate().for_each(|(row, pivot)| *pivot = (row, zero));
        diagonal.fill(zero);
        // Beside the diagonal, the largest part of an entry has to do for the entry.
        let mut largest = |row: usize, column: usize, entry: T| {
            let entry = scales[row] * scales[column] * entry;
            if row == column {
                diagonal[row] += entry;
            } else if Scalar::abs(entry) > Scalar::abs(pivots[row].1) {
                pivots[row] = (column, entry);
            }
        };
        equations.evaluate(b, &mut largest)?;
        scale(b, scales);
        norm::finite(b)?;
        taken.fill(zero);
        for (row, pivot) in pivots.iter_mut().enumerate() {
            if T::lift(2.0) * Scalar::abs(diagonal[row]) >= Scalar::abs(pivot.1) {
                pivot.0 = row;
            }
            pivot.1 = zero;
            taken[pivot.0] += one;
        }
        if taken.iter().any(|&count| count != one) {
            pivots.iter_mut().enumerate().for_each(|(row, pivot)| *pivot = (row, one));
            return Ok(());
        }
        let mut sum = |row: usize, column: usize, entry: T| {
            if column == pivots[row].0 {
                pivots[row].1 += scales[row] * scales[column] * entry;
            }
        };
        equations.evaluate(unused, &mut sum)?;
        let usable = pivots.iter().all(|pivot| (one / pivot.1).is_finite());
        for (row, pivot) in pivots.iter_mut().enumerate() {
            *pivot = if usable { (pivot.0, one / pivot.1) } else { (row, one) };
        }
        Ok(())
    }

    /// Adds to `solution` what makes the `residual` of length `left` smallest, down to the target, and takes
    /// it off there; returns the number of products.
    fn minimise(
        &mut self,
        multiply: &mut Multiply<'_, T>,
        residual: &mut [T],
        [left, target]: [T; 2],
    ) -> Result<usize, StepFailure> {
        let n = residual.len();
        let mut rhs = [T::lift(0.0); BASIS + 1];
        rhs[0] = left;
        for (v, &r) in self.basis.iter_mut().zip(residual.iter()) {
            *v = r / left;
        }
        let mut size = 0;
        while size < BASIS && Scalar::abs(rhs[size]) > target {
            multiply(self, size * n)?;
            let Self { basis, columns, rotations, work: [_, product], .. } = &mut *self;
            let column = &mut columns[size];
            for (v, entry) in basis.chunks_exact(n).zip(column.iter_mut()).take(size + 1) {
                *entry = dot(v, product);
                for (p, &v) in product.iter_mut().zip(v) {
                    *p -= *entry * v;
                }
            }
            let rest = length(product);
            for (v, &p) in basis[(size + 1) * n..].iter_mut().zip(product.iter()) {
                *v = p / rest;
            }
            for (i, &[cos, sin]) in rotations[..size].iter().enumerate() {
                (column[i], column[i + 1]) =
                    (cos * column[i] + sin * column[i + 1], cos * column[i + 1] - sin * column[i]);
            }
            let radius = Scalar::sqrt(column[size] * column[size] + rest * rest);
            // Where neither the product nor anything before it leads on, A is singular.
            let leads_on = radius > T::lift(0.0);
            if !leads_on {
                return Err(norm::singular(radius, size));
            }
            let [cos, sin] = [column[size] / radius, rest / radius];
            rotations[size] = [cos, sin];
            column[size] = radius;
            (rhs[size], rhs[size + 1]) = (cos * rhs[size], -(sin * rhs[size]));
            size += 1;
            // The space is A's own: nothing is left.
            if rest <= T::default_epsilon() * radius {
                break;
            }
        }
        self.combine(multiply, residual, &mut rhs, size)?;
        Ok(size + 1)
    }

    /// Adds the combination of the first `size` vectors that the triangle asks for.
    fn combine(
        &mut self,
        multiply: &mut Multiply<'_, T>,
        residual: &mut [T],
        rhs: &mut [T; BASIS + 1],
        size: usize,
    ) -> Result<(), StepFailure> {
        let n = residual.len();
        for k in (0..size).rev() {
            let value = rhs[k] / self.columns[k][k];
            rhs[k] = value;
            for i in 0..k {
                rhs[i] -= self.columns[k][i] * value;
            }
        }
        // In the place of the last vector, which is not part of it.
        let (vectors, place) = self.basis.split_at_mut(BASIS * n);
        place.fill(T::lift(0.0));
        for (v, &factor) in vectors.chunks_exact(n).zip(&rhs[..size]) {
            for (sum, &v) in place.iter_mut().zip(v) {
                *sum += factor * v;
            }
        }
        multiply(self, BASIS * n)?;
        let Self { solution, work: [direction, product], .. } = self;
        for i in 0..n {
            solution[i] += direction[i];
            residual[i] -= product[i];
        }
        Ok(())
    }

    /// Sets the direction to S M⁻¹ of the vector that begins at `begin` in the basis, with the preconditioner
    /// M and the scales S, and the product to S A times that.
    fn multiply(
        &mut self,
        equations: &mut impl LinearEquations<T>,
        begin: usize,
    ) -> Result<(), StepFailure> {
        let Self { basis, pivots, unused, work: [direction, product], scales, .. } = self;
        for (&(column, reciprocal), &v) in pivots.iter().zip(&basis[begin..]) {
            direction[column] = scales[column] * (reciprocal * v);
        }
        // Slices, whose lengths do not stand behind a pointer.
        let (direction, product) = (&direction[..], &mut product[..]);
        product.fill(T::lift(0.0));
        let mut add = |row: usize, column: usize, entry: T| product[row] += entry * direction[column];
        equations.evaluate(unused, &mut add)?;
        scale(product, scales);
        Ok(())
    }
}

fn length<T: Real>(x: &[T]) -> T {
    Scalar::sqrt(dot(x, x))
}

#[cfg(test)]
mod tests {
    use super::{BASIS, Krylov};
    use crate::error::StepFailure;
    use crate::space::Sink;
    use crate::space::linear::{LinearEquations, LinearSolver};
    use crate::space::numbers;
    use alloc::vec;
    use alloc::vec::Vec;
    use nalgebra::{DMatrix, DVector};

    struct Given<'a> {
        matrix: &'a DMatrix<f64>,
        b: &'a [f64],
    }

    impl LinearEquations<f64> for Given<'_> {
        fn evaluate<K: Sink<f64>>(&mut self, b: &mut [f64], sink: &mut K) -> Result<(), StepFailure> {
            b.copy_from_slice(self.b);
            for i in 0..b.len() {
                for j in 0..b.len() {
                    sink.add(i, j, self.matrix[(i, j)]);
                }
            }
            Ok(())
        }
    }

    fn entries(count: usize, seed: u64) -> Vec<f64> {
        core::iter::repeat_with(numbers(seed)).take(count).collect()
    }

    fn solve(matrix: &DMatrix<f64>, b: &[f64]) -> Result<Vec<f64>, StepFailure> {
        let mut x = vec![0.0; b.len()];
        Krylov::new(b.len()).solve(&mut Given { matrix, b }, &vec![1.0; b.len()], &mut x)?;
        Ok(x)
    }

    /// Of masses that differ a thousandfold, and of pairs as in Ω, with a full matrix added.
    #[test]
    fn solutions_agree_with_nalgebra() {
        for n in [1, 2, 7, BASIS, 120] {
            for paired in [false, true] {
                let b = entries(n, 5);
                let scale = 0.2 / n as f64;
                let full = DMatrix::from_row_slice(n, n, &entries(n * n, 3)) * scale;
                let matrix = DMatrix::from_fn(n, n, |i, j| {
                    let pivot = if paired && n % 2 == 0 { (i + n / 2) % n } else { i };
                    let mass = if j == pivot { 10.0_f64.powi(i as i32 % 4) } else { 0.0 };
                    full[(i, j)] + if i < n / 2 { mass } else { -mass }
                });
                let expected = matrix.clone().lu().solve(&DVector::from_column_slice(&b));
                let Some(expected) = expected else { panic!("nalgebra found no solution") };
                let found = solve(&matrix, &b).map(DVector::from_vec);
                let error = found.map(|found| (found - &expected).amax() / expected.amax());
                assert!(matches!(error, Ok(error) if error < 1e-6), "n = {n}, {paired}: {error:?}");
            }
        }
    }

    #[test]
    fn a_singular_matrix_is_an_error() {
        let zero = DMatrix::zeros(3, 3);
        assert!(matches!(solve(&zero, &[1.0; 3]), Err(StepFailure::Singular { .. })));
        let rank_one = DMatrix::from_element(3, 3, 1.0);
        let failure = solve(&rank_one, &[1.0, 0.0, -1.0]);
        assert!(failure.is_err(), "{failure:?}");
        assert_eq!(solve(&zero, &[0.0; 3]), Ok(vec![0.0; 3]));
    }

    #[test]
    fn numbers_that_are_none_are_an_error() {
        let matrix = DMatrix::identity(2, 2);
        assert!(matches!(solve(&matrix, &[f64::NAN, 1.0]), Err(StepFailure::NotFinite { .. })));
        let failure = solve(&DMatrix::from_element(2, 2, f64::NAN), &[1.0, 1.0]);
        assert!(failure.is_err(), "{failure:?}");
    }
}
