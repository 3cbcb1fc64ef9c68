//! How cubes that do not touch act on each other: the kernel between them as a sum over products of the basis.
//!
//! For u in the cube of the target and v in that of the source, both of half the edge a, and the source t cubes away,
//! K(a² |u − v + 2t|²) ≈ Σ κ_{mn} B_m(u) B_n(v), by interpolation at the Chebyshev nodes. It makes no difference which of the cubes is
//! called the source, κ for −t is the transpose of that for t; so the force on each body is the derivative of one energy.

use alloc::vec::Vec;

use nalgebra::DMatrix;

use super::basis::Basis;
use super::interpolant::Interpolant;
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
    pub(super) rank: usize,
    /// U and its transpose, row by row.
    pub(super) compression: [Vec<f64>; 2],
    /// κ̃ for each t, row by row; of cubes that touch there is none.
    pub(super) matrices: Vec<Vec<f64>>,
}

impl Transfer {
    /// None where K has no numbers at these distances, or where forces to the `tolerance` are differences of K that rounding does not
    /// leave.
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
            let (compression, matrices) = (Default::default(), all().map(|_| Vec::new()).collect());
            return Some(Self { rank: 0, compression, matrices });
        }
        let is_above_rounding = varying.is_finite() && varying * tolerance > ROUNDING * size;
        if !is_above_rounding {
            return None;
        }
        let matrix = |t| matrix(basis, &known, t);
        let octant = all().filter(|t| t.iter().all(|steps| *steps >= 0));
        let range = range(basis, octant, matrix, varying, tolerance)?;
        let compressed = all().map(|t| match matrix(t) {
            Some(matrix) => rows(&(range.transpose() * (matrix * &range))),
            None => Vec::new(),
        });
        let matrices = compressed.collect();
        Some(Self { rank: range.ncols(), compression: [rows(&range), rows(&range.transpose())], matrices })
    }
}

/// Rounding errors of the coefficients of an interpolant, over the size of K.
const ROUNDING: f64 = 30.0 * f64::EPSILON;

/// The larger of two numbers; none if one of them is none.
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

fn rows(matrix: &DMatrix<f64>) -> Vec<f64> {
    matrix.transpose().as_slice().to_vec()
}

/// κ for any t, from those with t₁ ≥ … ≥ t_D ≥ 0; none for cubes that touch. K(|u − v + 2t|) is the same with coordinates exchanged and
/// reflected, and T_m is odd or even.
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

/// An orthonormal basis of the columns of all matrices, as far as they are not below the tolerance, by the singular values of the
/// products with a few vectors that look random (Halko, Martinsson & Tropp 2011). With each κ comes its transpose, that of −t, so the
/// columns are the rows as well. With each t come its reflections: so the functions that are odd along the same axes are taken by
/// themselves, for t without negative steps.
///
/// Columns are measured by what varies: the constant part of a kernel makes no forces. `scale` is about the size of that. None if there
/// are no singular values.
fn range<const D: usize>(
    basis: &Basis<D>,
    offsets: impl Iterator<Item = [i32; D]>,
    matrix: impl Fn([i32; D]) -> Option<DMatrix<f64>>,
    scale: f64,
    tolerance: f64,
) -> Option<DMatrix<f64>> {
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
        largest = larger(largest, (matrix.norm_squared() - matrix[(0, 0)].powi(2)).max(0.0).sqrt());
        // As many times as it has reflections.
        let reflections = t.iter().filter(|steps| **steps != 0).fold(1.0, |count, _| 2.0 * count);
        let vectors = DMatrix::from_fn(size, SAMPLES.min(size), |_, _| f64::sqrt(reflections) * entry());
        samples.push(matrix * vectors);
    }
    let mut columns = Vec::new();
    for parity in 0..1_usize << D {
        let is_odd = |axis: usize| parity >> axis & 1 == 1;
        let of_parity = |m: &usize| (0..D).all(|axis| (basis.degrees[*m][axis] % 2 == 1) == is_odd(axis));
        let functions: Vec<usize> = (0..size).filter(of_parity).collect();
        if functions.is_empty() {
            continue;
        }
        let parts: Vec<_> = samples.iter().map(|sample| sample.select_rows(&functions)).collect();
        let all: Vec<_> = parts.iter().flat_map(|part| part.column_iter()).collect();
        for direction in directions(DMatrix::from_columns(&all), tolerance * largest)?.column_iter() {
            let mut column = alloc::vec![0.0; size];
            functions.iter().zip(direction.iter()).for_each(|(function, entry)| column[*function] = *entry);
            columns.extend(column);
        }
    }
    let rank = columns.len() / size;
    (rank > 0).then(|| DMatrix::from_vec(size, rank, columns))
}

/// The singular vectors of values above a bound; none if the iteration for them does not end.
fn directions(columns: DMatrix<f64>, least: f64) -> Option<DMatrix<f64>> {
    const ITERATIONS: usize = 10_000;
    let svd = columns.try_svd(true, false, 5.0 * f64::EPSILON, ITERATIONS)?;
    let kept: Vec<usize> =
        (0..svd.singular_values.len()).filter(|place| svd.singular_values[*place] > least).collect();
    svd.u.map(|vectors| vectors.select_columns(&kept))
}
