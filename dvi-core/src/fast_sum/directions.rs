//! Orthonormal combinations of the functions of a basis.

use alloc::vec::Vec;

use nalgebra::DMatrix;

use super::basis::Basis;

/// Combinations of the basis, of which each is odd or even along each axis.
#[derive(Clone, Debug)]
pub(super) struct Directions {
    /// By columns.
    pub(super) functions: DMatrix<f64>,
    /// How much of each there is.
    pub(super) weights: Vec<f64>,
    /// Along which axes each is odd: bit by bit.
    parities: Vec<usize>,
}

impl Directions {
    pub(super) fn none(size: usize) -> Self {
        Self { functions: DMatrix::zeros(size, 0), weights: Vec::new(), parities: Vec::new() }
    }

    /// Those that columns and their reflections are made of, as far as there is more of them than a bound.
    pub(super) fn of_parities<const D: usize>(basis: &Basis<D>, columns: &DMatrix<f64>, least: f64) -> Self {
        let mut found = Self::none(basis.len());
        for parity in 0..1_usize << D {
            let is_odd = |axis: usize| parity >> axis & 1 == 1;
            let of_parity =
                |m: &usize| (0..D).all(|axis| (basis.degrees[*m][axis] % 2 == 1) == is_odd(axis));
            let functions: Vec<usize> = (0..basis.len()).filter(of_parity).collect();
            if functions.is_empty() || columns.ncols() == 0 {
                continue;
            }
            let (vectors, weights) = leading(&columns.select_rows(&functions), least);
            let mut all = DMatrix::zeros(basis.len(), weights.len());
            for (row, function) in functions.iter().enumerate() {
                all.row_mut(*function).copy_from(&vectors.row(row));
            }
            let parities = alloc::vec![parity; weights.len()];
            found.extend(Self { functions: all, weights, parities });
        }
        found
    }

    /// Adds others, which are orthogonal to these.
    pub(super) fn extend(&mut self, others: Self) {
        let known = self.weights.len();
        let functions = core::mem::replace(&mut self.functions, DMatrix::zeros(0, 0));
        self.functions = functions.resize_horizontally(known + others.weights.len(), 0.0);
        self.functions.columns_mut(known, others.weights.len()).copy_from(&others.functions);
        self.weights.extend(others.weights);
        self.parities.extend(others.parities);
    }

    /// −1 for each that changes its sign where these axes are reflected, and 1 for the others.
    pub(super) fn signs<const D: usize>(&self, reflected: [bool; D]) -> Vec<f64> {
        let sign = |parity: &usize| {
            let odd = (0..D).filter(|&axis| reflected[axis] && parity >> axis & 1 == 1).count();
            if odd % 2 == 0 { 1.0 } else { -1.0 }
        };
        self.parities.iter().map(sign).collect()
    }
}

/// Orthonormal vectors that columns are made of, and how much there is of each, if it is more than a bound:
/// nearly the left singular vectors and their values, by two decompositions with pivots (Stewart 1999).
///
/// The matrices of kernels such as r² have an exact rank far below their size. For such matrices the
/// iteration of a bidiagonal matrix in `nalgebra` was found to lose a direction.
fn leading(columns: &DMatrix<f64>, least: f64) -> (DMatrix<f64>, Vec<f64>) {
    // No more columns than rows, with the same vectors and values: A = P Rᵀ Qᵀ, of which P Rᵀ is kept.
    let decomposed = columns.transpose().col_piv_qr();
    let mut few = decomposed.r().transpose();
    decomposed.p().inv_permute_rows(&mut few);
    let decomposed = few.col_piv_qr();
    let norms: Vec<f64> = decomposed.r().row_iter().map(|row| row.norm()).collect();
    let kept: Vec<usize> = (0..norms.len()).filter(|place| norms[*place] > least).collect();
    (decomposed.q().select_columns(&kept), kept.iter().map(|place| norms[*place]).collect())
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::super::transfer::numbers;
    use super::leading;

    /// Matrices of rank 3 with singular values far apart.
    #[test]
    fn directions_of_a_low_rank_are_found() {
        let mut number = numbers(5);
        let mut entry = |_, _| number();
        for (rows, columns) in [(10, 5), (5, 10), (40, 90), (3, 3), (1, 4)] {
            let mut factor = DMatrix::from_fn(rows, 3, &mut entry);
            factor.column_mut(1).scale_mut(1e-4);
            factor.column_mut(2).scale_mut(1e-8);
            let matrix = factor * DMatrix::from_fn(3, columns, &mut entry);
            for least in [1e-2, 1e-6, 1e-11] {
                let (vectors, values) = leading(&matrix, least);
                assert!(values.iter().all(|value| *value > least));
                assert!(values.len() <= rows.min(3), "{rows}×{columns}: {values:?}");
                let gram = vectors.transpose() * &vectors;
                let apart = (gram - DMatrix::identity(values.len(), values.len())).amax();
                assert!(apart < 1e-13, "{rows}×{columns}: {apart:e}");
                let lost = (&matrix - &vectors * (vectors.transpose() * &matrix)).norm();
                assert!(lost < 3.0 * least, "{rows}×{columns}: {lost:e}");
            }
        }
    }
}
