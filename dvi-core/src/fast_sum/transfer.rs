//! How cubes that do not touch act on each other: the kernel between them as a sum over products of the basis.
//!
//! For u in the cube of the target and v in that of the source, both of half the edge a, and the source t cubes away,
//! K(a² |u − v + 2t|²) ≈ Σ κ_{mn} B_m(u) B_n(v), by interpolation at the Chebyshev nodes. It makes no difference which of the cubes is
//! called the source, κ for −t is the transpose of that for t; so the force on each body is the derivative of one energy.

use alloc::vec::Vec;

use nalgebra::DMatrix;

use super::basis::{self, Basis};
use super::tree::exp2;

/// Two cubes of one level that are no further apart than this, and do not touch.
const FARTHEST: i32 = 3;
const SIDE: usize = 2 * FARTHEST as usize + 1;

/// Whether two cubes this far apart have a point in common.
pub(super) fn touch<const D: usize>(offset: [i32; D]) -> bool {
    offset.iter().all(|steps| steps.abs() <= 1)
}

/// All t between cubes whose parents touch, counted through.
pub(super) fn offsets<const D: usize>() -> usize {
    SIDE.pow(D as u32)
}

/// The number of an offset between cubes whose parents touch.
pub(super) fn number<const D: usize>(offset: [i32; D]) -> usize {
    offset.iter().fold(0, |number, steps| number * SIDE + (steps + FARTHEST) as usize)
}

fn offset<const D: usize>(number: usize) -> [i32; D] {
    core::array::from_fn(|axis| (number / SIDE.pow((D - 1 - axis) as u32) % SIDE) as i32 - FARTHEST)
}

/// The matrices κ between cubes of one size, of the rank that the tolerance asks for: κ ≈ U κ̃ Uᵀ with the same U for all t.
#[derive(Clone, Debug)]
pub(super) struct Transfer {
    /// The binary logarithm of the edge.
    pub(super) edge: i32,
    pub(super) rank: usize,
    /// U and its transpose, row by row.
    pub(super) compression: [Vec<f64>; 2],
    /// κ̃ for each t, row by row; of cubes that touch there is none.
    pub(super) matrices: Vec<Vec<f64>>,
}

impl Transfer {
    pub(super) fn new<const D: usize>(
        basis: &Basis<D>,
        tolerance: f64,
        edge: i32,
        kernel: impl Fn(f64) -> f64,
    ) -> Self {
        let half = exp2(edge - 1);
        let full = Full::new(basis, |r2| kernel(r2 * half * half));
        let all: Vec<Option<DMatrix<f64>>> =
            (0..offsets::<D>()).map(|number| full.matrix(basis, offset(number))).collect();
        let range = range(all.iter().flatten(), basis.len(), tolerance);
        let compressed = all.iter().map(|matrix| match matrix {
            Some(matrix) => rows(&(range.transpose() * matrix * &range)),
            None => Vec::new(),
        });
        let matrices = compressed.collect();
        Self { edge, rank: range.ncols(), compression: [rows(&range), rows(&range.transpose())], matrices }
    }
}

fn rows(matrix: &DMatrix<f64>) -> Vec<f64> {
    matrix.transpose().as_slice().to_vec()
}

/// Columns that a matrix is sampled by.
const SAMPLES: usize = 8;

/// An orthonormal basis of the columns of all matrices, as far as they are not below the tolerance, by the singular values of the
/// products with a few vectors that look random (Halko, Martinsson & Tropp 2011). With each κ comes its transpose, that of −t, so the
/// columns are the rows as well.
///
/// They are measured by what varies: the constant part of a kernel makes no forces.
fn range<'m>(
    matrices: impl Iterator<Item = &'m DMatrix<f64>> + Clone,
    size: usize,
    tolerance: f64,
) -> DMatrix<f64> {
    let varying = |matrix: &DMatrix<f64>| (matrix.norm_squared() - matrix[(0, 0)].powi(2)).max(0.0).sqrt();
    let largest = matrices.clone().map(varying).fold(0.0, |a: f64, b| if b > a { b } else { a });
    let mut state = 2009_u64;
    let mut entry = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1_u32 << 30) - 1.0
    };
    let samples: Vec<DMatrix<f64>> =
        matrices.map(|matrix| matrix * DMatrix::from_fn(size, SAMPLES.min(size), |_, _| entry())).collect();
    let columns: Vec<_> = samples.iter().flat_map(|sample| sample.column_iter()).collect();
    let svd = DMatrix::from_columns(&columns).svd(true, false);
    let rank = svd.singular_values.iter().filter(|value| **value > tolerance * largest).count().max(1);
    svd.u.map_or_else(|| DMatrix::identity(size, size), |u| u.columns(0, rank).into_owned())
}

/// The matrices κ of the t with t₁ ≥ … ≥ t_D ≥ 0.
struct Full<const D: usize> {
    representatives: Vec<([i32; D], Vec<f64>)>,
}

impl<const D: usize> Full<D> {
    fn new(basis: &Basis<D>, kernel: impl Fn(f64) -> f64) -> Self {
        let nodes = basis::nodes(basis.order);
        let to_coefficients = basis::coefficients(basis.order);
        let all = (0..offsets::<D>()).map(offset);
        let representatives =
            all.filter(|t: &[i32; D]| !touch(*t) && t.is_sorted_by(|a, b| a >= b) && t[D - 1] >= 0);
        let coefficients = |t| transformed(between(&nodes, t, &kernel), &to_coefficients, basis.order, 2 * D);
        Self { representatives: representatives.map(|t| (t, coefficients(t))).collect() }
    }

    /// κ for any t; none for cubes that touch. K(|u − v + 2t|) is the same with coordinates exchanged and reflected, and T_m is odd or
    /// even.
    fn matrix(&self, basis: &Basis<D>, t: [i32; D]) -> Option<DMatrix<f64>> {
        let mut from: [usize; D] = core::array::from_fn(|axis| axis);
        from.sort_by_key(|&axis| -t[axis].abs());
        let representative = from.map(|axis| t[axis].abs());
        let (_, coefficients) = self.representatives.iter().find(|(known, _)| *known == representative)?;
        let place =
            |degrees: &[usize; D]| from.iter().fold(0, |place, &axis| place * basis.order + degrees[axis]);
        let sign = |degrees: &[usize; D]| {
            let odd = (0..D).filter(|&axis| t[axis] < 0 && degrees[axis] % 2 == 1).count();
            if odd % 2 == 0 { 1.0 } else { -1.0 }
        };
        let all = basis.order.pow(D as u32);
        let entry = |m: usize, n: usize| {
            let [m, n] = [m, n].map(|function| &basis.degrees[function]);
            sign(m) * sign(n) * coefficients[place(m) * all + place(n)]
        };
        Some(DMatrix::from_fn(basis.len(), basis.len(), entry))
    }
}

/// A function of |u − v + 2t|² at all nodes u, v; the last coordinate of v runs fastest.
fn between<const D: usize>(nodes: &[f64], offset: [i32; D], of: &impl Fn(f64) -> f64) -> Vec<f64> {
    let order = nodes.len();
    let all = order.pow(D as u32);
    let coordinate = |place: usize, axis: usize| nodes[place / order.pow((D - 1 - axis) as u32) % order];
    let mut values = Vec::with_capacity(all * all);
    for target in 0..all {
        for source in 0..all {
            let square = |axis: usize| {
                let steps = 2.0 * f64::from(offset[axis]);
                (coordinate(target, axis) - coordinate(source, axis) + steps).powi(2)
            };
            values.push(of((0..D).map(square).sum()));
        }
    }
    values
}

/// Takes a matrix to each of `axes` axes of an array.
fn transformed(mut values: Vec<f64>, matrix: &[f64], order: usize, axes: usize) -> Vec<f64> {
    let mut column = alloc::vec![0.0; order];
    for axis in 0..axes {
        let stride = order.pow(axis as u32);
        for start in (0..values.len()).filter(|place| (place / stride).is_multiple_of(order)) {
            for (m, entry) in column.iter_mut().enumerate() {
                *entry = (0..order).map(|i| matrix[m * order + i] * values[start + i * stride]).sum();
            }
            column.iter().enumerate().for_each(|(m, entry)| values[start + m * stride] = *entry);
        }
    }
    values
}
