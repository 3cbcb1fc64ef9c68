//! Matrices in each storage beside dense ones of `nalgebra`.

use alloc::vec;
use alloc::vec::Vec;

use nalgebra::{DMatrix, DVector};

use super::fronts::Front;
use super::{Layout, Pattern, RunTimeSquare, SquareMatrix};
use crate::error::StepFailure;
use crate::scalar::norm::singular;
use crate::space::{Sink, numbers};

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

/// A ring of n/2 sites with two coordinates each, of reach `reach`, declared block by block or shuffled.
fn ring((n, reach, shuffled): (usize, usize, bool)) -> (usize, Places) {
    let sites = n / 2;
    let number = |site: usize, block: usize| {
        let declared = block * sites + site % sites;
        // 37 is prime to the sizes below.
        if shuffled { declared * 37 % n } else { declared }
    };
    let mut places = Vec::new();
    for (site, other) in (0..sites).flat_map(|site| (site..=site + reach).map(move |other| (site, other))) {
        for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let [here, there] = [number(site, a), number(other, b)];
            places.extend([(here, there), (there, here)]);
        }
    }
    (n, places)
}

fn pattern(n: usize, places: &Places) -> Pattern {
    let mut pattern = Pattern::new(n);
    places.iter().for_each(|&(i, j)| pattern.add(i, j));
    pattern
}

/// Zeros in this pattern, in the storage for sparse matrices.
fn sparse(n: usize, places: &Places) -> RunTimeSquare<f64> {
    let Some(rows) = pattern(n, places).rows() else { panic!("it is sparse") };
    let Some(fronts) = Front::of(rows.clone(), usize::MAX) else { panic!("any number will do") };
    RunTimeSquare::in_layout(n, Layout::Sparse(rows, fronts))
}

/// The same in that for banded ones.
fn banded(n: usize, places: &Places) -> RunTimeSquare<f64> {
    let Some(order) = pattern(n, places).banded() else { panic!("there is a band") };
    RunTimeSquare::in_layout(n, Layout::Banded(order))
}

/// In which all entries have room.
fn full(n: usize, _places: &Places) -> RunTimeSquare<f64> {
    RunTimeSquare::in_layout(n, Layout::Full)
}

type Storage = fn(usize, &Places) -> RunTimeSquare<f64>;

/// The matrix with these entries, and the same of `nalgebra`.
fn filled(
    storage: Storage,
    (n, places): (usize, &Places),
    mut entry: impl FnMut(usize, usize) -> f64,
) -> (RunTimeSquare<f64>, DMatrix<f64>) {
    let (mut matrix, mut reference) = (storage(n, places), DMatrix::zeros(n, n));
    for &(i, j) in places {
        let entry = entry(i, j);
        matrix.add(i, j, entry);
        reference[(i, j)] += entry;
    }
    (matrix, reference)
}

/// Holds a matrix of random entries against that of `nalgebra`.
fn compare(storage: Storage, (n, places): (usize, &Places), seed: u64) {
    let mut next = numbers(seed);
    // Small diagonals, so that rows are exchanged.
    let entry = |i, j| if i == j { 1e-3 * next() } else { next() };
    let (mut matrix, reference) = filled(storage, (n, places), entry);
    let x = DVector::from_fn(n, |_, _| next());
    let mut product = vec![0.5; n];
    matrix.multiply_add(2.0, x.as_slice(), &mut product);
    let expected = (&reference * &x * 2.0).add_scalar(0.5);
    assert!((DVector::from_vec(product) - expected).amax() < 1e-13);

    let lu = reference.clone().lu();
    let Some(expected) = lu.solve(&x) else { panic!("nalgebra found no solution") };
    let Some(inverse) = lu.try_inverse() else { panic!("nalgebra found no inverse") };
    let condition = inverse.norm() * reference.norm();
    let (mut found, mut again, mut eliminated) = (x.clone(), x, matrix.clone());
    assert_eq!(matrix.factor(), Ok(()));
    matrix.solve(found.as_mut_slice());
    assert_eq!(eliminated.eliminate(&mut [], again.as_mut_slice()), Ok(()));
    for found in [found, again] {
        let error = (found - &expected).amax() / expected.amax();
        assert!(error < 1e-15 * condition, "{n}, seed {seed}: {error:e} of {condition:e}");
    }
    let signs = lu.u().diagonal().iter().filter(|&&u| u < 0.0).count();
    let permuted: f64 = lu.p().determinant();
    assert_eq!(matrix.is_positive(), (permuted > 0.0) ^ (signs % 2 == 1), "{n}, seed {seed}");
}

#[test]
fn solutions_products_and_signs_agree_with_nalgebra() {
    let networks =
        [lattice(16, 1), lattice(20, 2), lattice(9, 3), network(150, 1), network(400, 2), parts()];
    for (n, places) in &networks {
        (0..6).for_each(|seed| compare(sparse, (*n, places), seed));
    }
    let rings = [(40, 1, false), (60, 1, true), (90, 2, true), (200, 3, false), (8, 0, true)];
    for (n, places) in &rings.map(ring) {
        for storage in [full as Storage, banded, sparse] {
            (0..6).for_each(|seed| compare(storage, (*n, places), seed));
        }
    }
}

/// Along canonical pairs the entries on the diagonal of Newton's matrix may all be zero.
#[test]
fn pairs_with_a_zero_diagonal_are_solved() {
    let (n, places) = lattice(20, 2);
    for storage in [full as Storage, banded, sparse] {
        let (sites, mut next) = (n / 2, numbers(3));
        let entry = |i: usize, j: usize| match i.abs_diff(j) {
            0 => 0.0,
            apart if apart == sites && i < j => 1.0,
            apart if apart == sites => -1.0,
            _ => 0.2 * next(),
        };
        let (mut matrix, reference) = filled(storage, (n, &places), entry);
        let x = DVector::from_fn(n, |i, _| (i as f64).sin());
        let mut found = &reference * &x;
        assert_eq!(matrix.factor(), Ok(()));
        matrix.solve(found.as_mut_slice());
        assert!((found - x).amax() < 1e-12);
    }
}

#[test]
fn a_column_without_entries_is_named_and_one_that_others_give_is_found() {
    let (n, places) = lattice(16, 1);
    for storage in [full as Storage, banded, sparse] {
        let entry = |i, j| if j == 77 { 0.0 } else { 1.0 / (2 + i + j) as f64 };
        assert_eq!(filled(storage, (n, &places), entry).0.factor(), Err(singular(0.0, 77)));
        // The rows of a sum over neighbours of differences add up to zero.
        for scale in [1e-200, 1.0, 1e200] {
            let mut degrees = vec![0.0; n];
            places.iter().filter(|(i, j)| i != j).for_each(|&(i, _)| degrees[i] += 1.0);
            // The diagonal is named twice.
            let entry = |i: usize, j: usize| scale * if i == j { degrees[i] / 2.0 } else { -1.0 } / 3.0;
            let failure = filled(storage, (n, &places), entry).0.factor();
            assert!(matches!(failure, Err(StepFailure::Singular { .. })), "{scale:e}: {failure:?}");
        }
    }
}

#[test]
fn an_entry_outside_of_the_pattern_and_one_that_is_no_number_are_errors() {
    let n = 80;
    for storage in [banded as Storage, sparse] {
        let diagonal = (0..n).map(|i| (i, i)).collect();
        let (mut matrix, _) = filled(storage, (n, &diagonal), |_, _| 1.0);
        matrix.add(3, 5, 1.0);
        assert_eq!(matrix.factor(), Err(StepFailure::Pattern { row: 3, column: 5 }));
        let (mut matrix, _) = filled(storage, (n, &diagonal), |_, j| if j == 9 { f64::NAN } else { 4.0 });
        assert!(matches!(matrix.factor(), Err(StepFailure::Singular { .. })));
        matrix.cleared();
        (0..n).for_each(|i| matrix.add(i, i, 2.0));
        let mut x = vec![1.0; n];
        assert_eq!(matrix.eliminate(&mut [], &mut x), Ok(()));
        assert_eq!(x, vec![0.5; n]);
    }
}
