//! Orthonormal combinations of the functions of a basis.

use alloc::vec::Vec;

use nalgebra::DMatrix;

use super::basis::Basis;
use super::singular::singular;

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

    /// The singular vectors of columns and of their reflections, of values above a bound; none if they are
    /// not found.
    pub(super) fn of_parities<const D: usize>(
        basis: &Basis<D>,
        columns: &DMatrix<f64>,
        least: f64,
    ) -> Option<Self> {
        let mut found = Self::none(basis.len());
        for parity in 0..1_usize << D {
            let is_odd = |axis: usize| parity >> axis & 1 == 1;
            let of_parity =
                |m: &usize| (0..D).all(|axis| (basis.degrees[*m][axis] % 2 == 1) == is_odd(axis));
            let functions: Vec<usize> = (0..basis.len()).filter(of_parity).collect();
            if functions.is_empty() || columns.ncols() == 0 {
                continue;
            }
            let (vectors, weights) = singular(&columns.select_rows(&functions), least)?;
            let mut all = DMatrix::zeros(basis.len(), weights.len());
            for (row, function) in functions.iter().enumerate() {
                all.row_mut(*function).copy_from(&vectors.row(row));
            }
            let parities = alloc::vec![parity; weights.len()];
            found.extend(Self { functions: all, weights, parities });
        }
        Some(found)
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
