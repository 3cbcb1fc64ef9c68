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
use super::interpolant::Interpolant;
use super::matrix::Matrix;
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
        kernel: impl Fn(f64) -> f64,
    ) -> Option<Self> {
        let half = exp2(edge - 1);
        let ordered = |t: &[i32; D]| !touch(*t) && t.is_sorted_by(|a, b| a >= b) && t[D - 1] >= 0;
        let all = || (0..offsets::<D>()).map(offset::<D>);
        let of = |t| (t, Interpolant::new(basis, t, |r2| kernel(r2 * half * half)));
        let known: Vec<([i32; D], Interpolant)> = all().filter(ordered).map(of).collect();
        let most = |of: fn(&Interpolant) -> f64| known.iter().map(|(_, found)| of(found)).fold(0.0, larger);
        let [varying, size] = [most(Interpolant::varying), most(Interpolant::size)];
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

/// κ for any t, from those with t₁ ≥ … ≥ t_D ≥ 0; none for cubes that touch. K(|u − v + 2t|) is the same
/// with coordinates exchanged and reflected, and T_m is odd or even.
fn matrix<const D: usize>(
    basis: &Basis<D>,
    known: &[([i32; D], Interpolant)],
    t: [i32; D],
) -> Option<DMatrix<f64>> {
    let mut from: [usize; D] = core::array::from_fn(|axis| axis);
    from.sort_by_key(|&axis| -t[axis].abs());
    let representative = from.map(|axis| t[axis].abs());
    let (_, interpolant) = known.iter().find(|(known, _)| *known == representative)?;
    let functions: Vec<(usize, f64)> = basis
        .degrees
        .iter()
        .map(|degrees| {
            let odd = (0..D).filter(|&axis| t[axis] < 0 && degrees[axis] % 2 == 1).count();
            let sign = if odd % 2 == 0 { 1.0 } else { -1.0 };
            (interpolant.place(from.map(|axis| degrees[axis])), sign)
        })
        .collect();
    let entry = |m: usize, n: usize| {
        let [(m, one), (n, other)] = [functions[m], functions[n]];
        one * other * interpolant.coefficient(m, n)
    };
    Some(DMatrix::from_fn(basis.len(), basis.len(), entry))
}

/// Columns that a matrix is sampled by.
const SAMPLES: usize = 8;

/// An orthonormal basis of the columns of all matrices, as far as they are not below the tolerance, by the
/// singular values of the products with a few vectors that look random (Halko, Martinsson & Tropp 2011).
/// With each κ comes its transpose, that of −t, so the columns are the rows as well. With each t come its
/// reflections: so the functions that are odd along the same axes are taken by themselves, for t without
/// negative steps.
///
/// Columns are measured by what varies: the constant part of a kernel makes no forces. `scale` is about the
/// size of that. None if there are no singular values.
fn range<const D: usize>(
    basis: &Basis<D>,
    offsets: impl Iterator<Item = [i32; D]>,
    matrix: impl Fn([i32; D]) -> Option<DMatrix<f64>>,
    scale: f64,
    tolerance: f64,
) -> Option<Directions> {
    let size = basis.len();
    let mut state = 2009_u64;
    let mut entry = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1_u32 << 30) - 1.0
    };
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
    let mut directions = Directions::of_parities(basis, &DMatrix::from_columns(&all), tolerance * largest)?;
    directions.weights.iter_mut().for_each(|weight| *weight /= largest);
    (!directions.weights.is_empty()).then_some(directions)
}
