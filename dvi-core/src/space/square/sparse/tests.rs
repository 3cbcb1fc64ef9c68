//! Sparse matrices beside dense ones of `nalgebra`.

use alloc::vec::Vec;

use nalgebra::{DMatrix, DVector};

use super::super::fronts::Fronts;
use super::super::ordering::Pattern;
use super::Sparse;
use crate::error::StepFailure;

/// Numbers in (−1, 1) from a linear congruential generator.
fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

type Places = Vec<(usize, usize)>;

/// A square lattice of `side`² sites with `blocks` coordinates each, declared block by block, whose
/// neighbours couple.
fn lattice(side: usize, blocks: usize) -> (usize, Places) {
    let sites = side * side;
    let mut places = Vec::new();
    for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
        let around = [(i, j), (i + 1, j), (i, j + 1)];
        for (k, l) in around.into_iter().filter(|&(k, l)| k < side && l < side) {
            for (a, b) in (0..blocks).flat_map(|a| (0..blocks).map(move |b| (a, b))) {
                let [here, there] = [a * sites + i * side + j, b * sites + k * side + l];
                places.extend([(here, there), (there, here)]);
            }
        }
    }
    (blocks * sites, places)
}

/// A network in which each of `n` coordinates couples to few others anywhere.
fn network(n: usize, seed: u64) -> (usize, Places) {
    let mut next = numbers(seed);
    let mut any = || ((next() + 1.0) / 2.0 * n as f64) as usize % n;
    let mut places: Places = (0..n).map(|i| (i, i)).collect();
    for _ in 0..5 * n / 4 {
        let (i, j) = (any(), any());
        places.extend([(i, j), (j, i)]);
    }
    (n, places)
}

/// A network in parts that do not know of each other.
fn parts() -> (usize, Places) {
    let (n, mut places) = network(90, 5);
    let (_, others) = lattice(12, 1);
    places.extend(others.into_iter().map(|(i, j)| (n + i, n + j)));
    (n + 144, places)
}

/// The matrix with this pattern, and the same of `nalgebra`.
fn filled(
    n: usize,
    places: &Places,
    mut entry: impl FnMut(usize, usize) -> f64,
) -> (Sparse<f64>, DMatrix<f64>) {
    let mut pattern = Pattern::new(n);
    places.iter().for_each(|&(i, j)| pattern.add(i, j));
    let Some(rows) = pattern.rows() else { panic!("it is sparse") };
    let Some(fronts) = Fronts::new(rows.clone(), usize::MAX) else { panic!("any number will do") };
    let mut matrix = Sparse::new(&rows, fronts);
    let mut reference = DMatrix::zeros(n, n);
    for &(i, j) in places {
        let entry = entry(i, j);
        matrix.add(i, j, entry);
        reference[(i, j)] += entry;
    }
    (matrix, reference)
}

#[test]
fn solutions_products_and_signs_agree_with_nalgebra() {
    let cases = [lattice(16, 1), lattice(20, 2), lattice(9, 3), network(150, 1), network(400, 2), parts()];
    for (case, (n, places)) in cases.into_iter().enumerate() {
        for seed in 0..6 {
            let mut next = numbers(seed);
            // Small diagonals, so that rows are exchanged.
            let entry = |i, j| if i == j { 1e-3 * next() } else { next() };
            let (mut matrix, reference) = filled(n, &places, entry);
            let x = DVector::from_fn(n, |_, _| next());
            let mut product = alloc::vec![0.5; n];
            matrix.multiply_add(2.0, x.as_slice(), &mut product);
            let expected = (&reference * &x * 2.0).add_scalar(0.5);
            assert!((DVector::from_vec(product) - expected).amax() < 1e-13);

            let lu = reference.clone().lu();
            let Some(expected) = lu.solve(&x) else { panic!("nalgebra found no solution") };
            let Some(inverse) = lu.try_inverse() else { panic!("nalgebra found no inverse") };
            let condition = inverse.norm() * reference.norm();
            assert_eq!(matrix.factor(), Ok(()));
            let mut found = x.clone();
            matrix.solve(found.as_mut_slice());
            let error = (found - &expected).amax() / expected.amax();
            assert!(error < 1e-15 * condition, "case {case}, seed {seed}: {error:e} of {condition:e}");

            let signs = lu.u().diagonal().iter().filter(|&&u| u < 0.0).count();
            let is_odd = signs % 2 == 1;
            let permuted: f64 = lu.p().determinant();
            assert_eq!(matrix.is_positive(), (permuted > 0.0) ^ is_odd, "case {case}, seed {seed}");
        }
    }
}

/// Along canonical pairs the entries on the diagonal of Newton's matrix may all be zero.
#[test]
fn pairs_with_a_zero_diagonal_are_solved() {
    let (n, places) = lattice(20, 2);
    let (sites, mut next) = (n / 2, numbers(3));
    let entry = |i: usize, j: usize| match i.abs_diff(j) {
        0 => 0.0,
        apart if apart == sites => {
            if i < j {
                1.0
            } else {
                -1.0
            }
        }
        _ => 0.2 * next(),
    };
    let (mut matrix, reference) = filled(n, &places, entry);
    let x = DVector::from_fn(n, |i, _| (i as f64).sin());
    let mut found = &reference * &x;
    assert_eq!(matrix.factor(), Ok(()));
    matrix.solve(found.as_mut_slice());
    assert!((found - x).amax() < 1e-12);
}

#[test]
fn a_column_without_entries_is_named_and_one_that_others_give_is_found() {
    let (n, places) = lattice(16, 1);
    let (mut matrix, _) = filled(n, &places, |i, j| if j == 77 { 0.0 } else { 1.0 / (2 + i + j) as f64 });
    let failure = matrix.factor();
    assert_eq!(failure, Err(crate::scalar::norm::singular(0.0, 77)));

    // The rows of a sum over neighbours of differences add up to zero.
    for scale in [1e-200, 1.0, 1e200] {
        let mut degrees = alloc::vec![0.0; n];
        places.iter().filter(|(i, j)| i != j).for_each(|&(i, _)| degrees[i] += 1.0);
        // The diagonal is named twice.
        let entry = |i: usize, j: usize| scale * if i == j { degrees[i] / 2.0 } else { -1.0 } / 3.0;
        let (mut matrix, _) = filled(n, &places, entry);
        let failure = matrix.factor();
        assert!(matches!(failure, Err(StepFailure::Singular { .. })), "{scale:e}: {failure:?}");
    }
}

#[test]
fn an_entry_outside_of_the_pattern_and_one_that_is_no_number_are_errors() {
    let (n, places) = lattice(16, 1);
    let (mut matrix, _) = filled(n, &places, |_, _| 1.0);
    matrix.add(3, 5, 1.0);
    let failure = matrix.factor();
    assert_eq!(failure, Err(StepFailure::Pattern { row: 3, column: 5 }));
    let (mut matrix, _) = filled(n, &places, |i, j| if i == j { 4.0 } else { f64::NAN });
    assert!(matches!(matrix.factor(), Err(StepFailure::Singular { .. })));
    matrix.clear();
    (0..n).for_each(|i| matrix.add(i, i, 2.0));
    let mut x = alloc::vec![1.0; n];
    assert_eq!(matrix.factor(), Ok(()));
    matrix.solve(&mut x);
    assert_eq!(x, alloc::vec![0.5; n]);
}
