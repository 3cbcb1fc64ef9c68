//! How cubes that do not touch act on each other: the kernel between them as a sum over products of the
//! basis.
//!
//! For u in the cube of the target and v in that of the source, both of half the edge a, and the source t
//! cubes away, K(a² |u − v + 2t|²) ≈ Σ κ_{mn} B_m(u) B_n(v), by interpolation at the Chebyshev nodes. It
//! makes no difference which of the cubes is called the source, κ for −t is the transpose of that for t; so
//! the force on each body is the derivative of one energy.

use alloc::vec::Vec;

use nalgebra::DMatrix;

use super::basis::Basis;
use super::directions::Directions;
use super::interpolant::interpolant;
use super::matrix::Matrix;
use super::packs::Pack;
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

/// The matrices κ between cubes of one size, of the rank that the tolerance asks for: κ ≈ U κ̃ Uᵀ with the
/// same U for all t.
#[derive(Clone, Debug)]
pub(super) struct Transfer {
    /// U
    pub(super) directions: Directions,
    /// κ̃ for each t; of cubes that touch there is none.
    pub(super) matrices: Vec<Matrix>,
}

impl Transfer {
    /// None where K has no numbers at these distances, or where forces to the `tolerance` are differences of
    /// K that rounding does not leave.
    pub(super) fn new<const D: usize>(
        basis: &Basis<D>,
        tolerance: f64,
        edge: i32,
        kernel: &dyn Fn(Pack) -> Pack,
    ) -> Option<Self> {
        let half = Pack::all(exp2(edge - 1));
        let ordered = |t: &[i32; D]| !touch(*t) && t.is_sorted_by(|a, b| a >= b) && t[D - 1] >= 0;
        let all = || (0..offsets::<D>()).map(offset::<D>);
        let (mut known, mut varying, mut size) = (Vec::new(), 0.0, 0.0);
        for t in all().filter(ordered) {
            let (coefficients, largest) = interpolant(basis, t, &|r2| kernel(r2 * half * half));
            // All but that of the constant function.
            varying =
                coefficients.iter().skip(1).fold(varying, |varying, entry| larger(varying, entry.abs()));
            size = larger(size, largest);
            known.push((t, coefficients));
        }
        if size == 0.0 {
            let (directions, matrices) = (Directions::none(basis.len()), Vec::new());
            return Some(Self { directions, matrices });
        }
        let is_above_rounding = varying.is_finite() && varying * tolerance > ROUNDING * size;
        if !is_above_rounding {
            return None;
        }
        let matrix = |t| matrix(basis, &known, t);
        let octant = || all().filter(|t| t.iter().all(|steps| *steps >= 0));
        let directions = range(basis, octant(), matrix, varying, tolerance)?;
        let range = &directions.functions;
        let compressed = |t| matrix(t).map(|matrix| (t, range.transpose() * (matrix * range)));
        let compressed: Vec<([i32; D], DMatrix<f64>)> = octant().filter_map(compressed).collect();
        // The others by reflections.
        let reflected = |t: [i32; D]| {
            let found = compressed.iter().find(|(known, _)| *known == t.map(i32::abs));
            let signs = directions.signs(t.map(|steps| steps < 0));
            found.map_or_else(Matrix::default, |(_, matrix)| {
                let entry = |i: usize, j: usize| signs[i] * signs[j] * matrix[(i, j)];
                Matrix::new(&DMatrix::from_fn(signs.len(), signs.len(), entry))
            })
        };
        let matrices = all().map(reflected).collect();
        Some(Self { directions, matrices })
    }

    pub(super) fn rank(&self) -> usize {
        self.directions.weights.len()
    }
}

/// Rounding errors of the coefficients of an interpolant, over the size of K.
const ROUNDING: f64 = 30.0 * f64::EPSILON;

/// The larger of two numbers; none if one of them is none.
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

/// κ for any t without negative steps, from those with t₁ ≥ … ≥ t_D; none for cubes that touch. K(|u − v +
/// 2t|) is the same with coordinates exchanged.
fn matrix<const D: usize>(
    basis: &Basis<D>,
    known: &[([i32; D], DMatrix<f64>)],
    t: [i32; D],
) -> Option<DMatrix<f64>> {
    let mut from: [usize; D] = core::array::from_fn(|axis| axis);
    from.sort_by_key(|&axis| -t[axis]);
    let (_, coefficients) = known.iter().find(|(known, _)| *known == from.map(|axis| t[axis]))?;
    let exchanged = |degrees: &[usize; D]| basis.place(from.map(|axis| degrees[axis]));
    let functions: Vec<usize> = basis.degrees.iter().map(exchanged).collect();
    Some(coefficients.select_rows(&functions).select_columns(&functions))
}

/// Numbers in [−1, 1) from a linear congruential generator.
pub(super) fn numbers(mut state: u64) -> impl FnMut() -> f64 {
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1_u32 << 30) - 1.0
    }
}

/// Columns that a matrix is sampled by.
const SAMPLES: usize = 8;

/// An orthonormal basis of the columns of all matrices, as far as they are not below the tolerance, by their
/// products with a few vectors that look random (Halko, Martinsson & Tropp 2011).
/// With each κ comes its transpose, that of −t, so the columns are the rows as well. With each t come its
/// reflections: so the functions that are odd along the same axes are taken by themselves, for t without
/// negative steps.
///
/// Columns are measured by what varies: the constant part of a kernel makes no forces. `scale` is about the
/// size of that. None if there is no such basis.
fn range<const D: usize>(
    basis: &Basis<D>,
    offsets: impl Iterator<Item = [i32; D]>,
    matrix: impl Fn([i32; D]) -> Option<DMatrix<f64>>,
    scale: f64,
    tolerance: f64,
) -> Option<Directions> {
    let size = basis.len();
    let mut entry = numbers(2009);
    let mut largest = 0.0;
    let mut samples = Vec::new();
    for t in offsets {
        let Some(matrix) = matrix(t) else { continue };
        let matrix = matrix / scale;
        let mut varying = matrix.clone();
        varying[(0, 0)] = 0.0;
        largest = larger(largest, varying.norm());
        // As many times as it has reflections.
        let reflections = t.iter().filter(|steps| **steps != 0).fold(1.0, |count, _| 2.0 * count);
        let vectors = DMatrix::from_fn(size, SAMPLES.min(size), |_, _| f64::sqrt(reflections) * entry());
        samples.push(matrix * vectors);
    }
    let all: Vec<_> = samples.iter().flat_map(|sample| sample.column_iter()).collect();
    let mut directions = Directions::of_parities(basis, &DMatrix::from_columns(&all), tolerance * largest);
    directions.weights.iter_mut().for_each(|weight| *weight /= largest);
    (!directions.weights.is_empty()).then_some(directions)
}
