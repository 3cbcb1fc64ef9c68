//! The functions that fields of far cubes are made of, in cubes of one size: so few that an expansion in
//! them is short.
//!
//! They are orthonormal combinations of the basis. First stand those that [`Transfer`] finds, of cubes that
//! are as large; then follow those that the fields of larger cubes have besides. What a cube and its parts
//! have to do with each other is a small matrix for each side, as in an H²-matrix (Hackbusch & Börm 2002).

use alloc::vec::Vec;

use nalgebra::DMatrix;

use super::basis::{Basis, half};
use super::directions::Directions;
use super::matrix::{Matrix, padded};
use super::transfer::Transfer;

/// The functions for cubes of one size below others.
#[derive(Clone, Debug)]
pub(super) struct Subspace {
    /// From one cube to the next, in the coefficients.
    pub(super) stride: usize,
    directions: Directions,
    /// From moments in the basis to those in these functions, and from coefficients of these functions to
    /// those of the basis.
    pub(super) compress: Matrix,
    pub(super) expand: Matrix,
    /// For each side: from the moments of a part to those of the cube around it, and from the local
    /// expansion of this one to that of the part. None in the largest cubes.
    pub(super) widen: Vec<Matrix>,
    pub(super) narrow: Vec<Matrix>,
}

/// A direction is kept if there is more of it than this times what a [`Transfer`] leaves out: errors on each
/// level add up, and in small clusters the forces of far bodies may be all that there is.
const SLACK: f64 = 0.1;

impl Subspace {
    /// For cubes in larger ones, if these have expansions, that act on others of their size by a matrix, if
    /// they do.
    pub(super) fn new<const D: usize>(
        basis: &Basis<D>,
        above: Option<&Self>,
        own: Option<&Transfer>,
        tolerance: f64,
    ) -> Self {
        let size = basis.len();
        let mut directions = own.map_or_else(|| Directions::none(size), |own| own.directions.clone());
        // The functions of larger cubes in a part on some side.
        let narrowed = |above: &Self, side: usize| narrowing(basis, side) * &above.directions.functions;
        if let Some(above) = above {
            // A force is a slope, and the cubes are half as large. Constants make none, and have a column of
            // their own.
            let mut fields = narrowed(above, 0);
            for (mut field, weight) in fields.column_iter_mut().zip(&above.directions.weights) {
                field *= 2.0 * weight;
                field[0] = 0.0;
            }
            let mut fields = fields.insert_column(0, 0.0);
            fields[(0, 0)] = 1.0;
            // What is in these functions already; twice, for rounding errors.
            for _ in 0..2 {
                let known = directions.functions.transpose() * &fields;
                fields -= &directions.functions * known;
            }
            directions.extend(Directions::of_parities(basis, &fields, SLACK * tolerance));
        }
        let functions = &directions.functions;
        let sides = 0..above.map_or(0, |_| 1_usize << D);
        let links =
            sides.filter_map(|side| above.map(|above| functions.transpose() * narrowed(above, side)));
        let links: Vec<_> = links.collect();
        Self {
            stride: padded(functions.ncols()),
            compress: Matrix::new(&functions.transpose()),
            expand: Matrix::new(functions),
            widen: links.iter().map(|link| Matrix::new(&link.transpose())).collect(),
            narrow: links.iter().map(Matrix::new).collect(),
            directions,
        }
    }
}

/// From the local expansion of a cube to that of its part on a side: Aᵀ, where B_m(u) = Σ_n A_{mn} B_n(c)
/// with u = (c ± 1)/2. It is exact, because the degree of a term does not grow.
fn narrowing<const D: usize>(basis: &Basis<D>, side: usize) -> DMatrix<f64> {
    let is_upper = |axis: usize| side >> axis & 1 == 1;
    let halves: [_; D] =
        core::array::from_fn(|axis| half(basis.order, if is_upper(axis) { 1.0 } else { -1.0 }));
    DMatrix::from_fn(basis.len(), basis.len(), |n, m| {
        let [n, m] = [basis.degrees[n], basis.degrees[m]];
        (0..D).map(|axis| halves[axis][m[axis]][n[axis]]).product()
    })
}
