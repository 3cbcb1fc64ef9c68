//! The interpolant of a kernel between two cubes at their Chebyshev nodes, in products of the basis.

use alloc::vec::Vec;

use nalgebra::{DMatrix, Dyn};

use super::basis::{self, Basis};
use super::packs::{LANES, Pack};
use super::transfer::larger;
use crate::scalar::Lanes;

/// Nodes of the target that are taken at once, so that little memory is needed.
const AT_ONCE: usize = 128;

/// The coefficients κ of K(|u − v + 2t|²), and the largest |K| at the nodes, which is no number if K is none
/// somewhere.
pub(super) fn interpolant<const D: usize>(
    basis: &Basis<D>,
    t: [i32; D],
    kernel: &dyn Fn(Pack) -> Pack,
) -> (DMatrix<f64>, f64) {
    let order = basis.order;
    let line = basis::nodes(order);
    let part = |place: usize, axis: usize| place / order.pow((D - 1 - axis) as u32) % order;
    let nodes: Vec<[f64; D]> =
        (0..order.pow(D as u32)).map(|place| core::array::from_fn(|axis| line[part(place, axis)])).collect();
    let matrix = DMatrix::from_row_slice(order, order, &basis::coefficients(order));
    let mut largest = 0.0;
    // First for each node of the target in the functions of the source, then these functions in those of the
    // target.
    let mut half = DMatrix::zeros(nodes.len(), basis.len());
    for (first, targets) in (0..).step_by(AT_ONCE).zip(nodes.chunks(AT_ONCE)) {
        let mut values = DMatrix::zeros(nodes.len(), targets.len());
        for (target, mut values) in targets.iter().zip(values.column_iter_mut()) {
            let chunks = values.as_mut_slice().chunks_mut(LANES);
            for (values, sources) in chunks.zip(nodes.chunks(LANES)) {
                let square = |source: &[f64; D], axis: usize| {
                    (target[axis] - source[axis] + 2.0 * f64::from(t[axis])).powi(2)
                };
                let r2 = |source: &[f64; D]| (0..D).map(|axis| square(source, axis)).sum();
                let r2 = core::array::from_fn(|lane| r2(&sources[lane.min(sources.len() - 1)]));
                values.copy_from_slice(&kernel(Lanes(r2)).0[..values.len()]);
                largest = values.iter().fold(largest, |largest, value| larger(largest, value.abs()));
            }
        }
        half.rows_mut(first, targets.len()).copy_from(&transformed(basis, &matrix, values));
    }
    (transformed(basis, &matrix, half).transpose(), largest)
}

/// From values at all nodes, one function a column, to coefficients in the basis, one function a row.
fn transformed<const D: usize>(
    basis: &Basis<D>,
    matrix: &DMatrix<f64>,
    mut values: DMatrix<f64>,
) -> DMatrix<f64> {
    let (order, all, count) = (basis.order, values.nrows(), values.ncols());
    // Each time the last of the axes becomes the first one.
    for _ in 0..D {
        let others = values.len() / order;
        values = (matrix * values.reshape_generic(Dyn(order), Dyn(others))).transpose();
    }
    let place = |degrees: &[usize; D]| degrees.iter().fold(0, |place, degree| place * order + degree);
    let kept: Vec<usize> = basis.degrees.iter().map(place).collect();
    values.reshape_generic(Dyn(count), Dyn(all)).select_columns(&kept)
}
