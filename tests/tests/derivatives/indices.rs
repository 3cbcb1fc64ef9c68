//! `check()` names the first index that leaves an array.

use dvi_core::{IndexError, System, degenerate_lagrangian};
use dvi_tests::zoo::language::Neighbours as Correlated;
use dvi_tests::zoo::shapes::{Borrowing, Chain};

/// A neighbour without a wrap.
#[degenerate_lagrangian(
    coordinates(x[n], y[n]),
    one_form    = sum(0..n, |j| x[j] * d(y[j])),
    hamiltonian = sum(0..n, |j| x[j] * y[j + 1]) + sum(0..n, |j| table[j][2] * x[j]),
)]
struct Neighbours {
    n: usize,
    table: Vec<Vec<f64>>,
}

/// A neighbour on the other side.
#[degenerate_lagrangian(
    coordinates(x[n], y[n]),
    one_form    = sum(0..n, |j| x[j] * d(y[j])),
    hamiltonian = sum(1..n, |j| x[j] * y[j - 2]),
)]
struct Predecessors {
    n: usize,
}

/// An index that only a momentum uses.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = x * d(y),
    hamiltonian = x * y,
    momenta(weighted = g[3] * x),
)]
struct Weighted {
    g: Vec<f64>,
}

/// A sum over the length of another array.
#[degenerate_lagrangian(
    coordinates(x[n], y[n]),
    one_form    = sum(0..n, |j| x[j] * d(y[j])),
    hamiltonian = sum(0..k.len(), |j| k[j] * x[j] * y[0]),
)]
struct OtherRange {
    n: usize,
    k: Vec<f64>,
}

#[test]
fn a_range_that_is_not_of_the_coordinates() {
    let system = |k: usize| OtherRange { n: 3, k: vec![1.0; k] };
    assert_eq!(system(3).check(), Ok(()));
    assert_eq!(system(5).check(), Err(IndexError { array: "x", index: 3, len: 3 }));
}

#[test]
fn a_short_parameter_array() {
    let chain = |n: usize, springs: usize| Chain { n, k: vec![1.0; springs], mass: 1.0 };
    assert_eq!(chain(5, 4).check(), Ok(()));
    assert_eq!(chain(5, 7).check(), Ok(()));
    assert_eq!(chain(5, 2).check(), Err(IndexError { array: "k", index: 2, len: 2 }));
    assert_eq!(chain(1, 0).check(), Ok(()));
    assert_eq!(chain(0, 0).check(), Ok(()));
}

#[test]
fn a_short_matrix_behind_a_reference() {
    let borrowing = |weights| Borrowing { weights, coupling: &[[1.0; 3]; 3], scale: &1.0 };
    assert_eq!(borrowing(&[1.0; 3]).check(), Ok(()));
    // Pairs (j, k) with j < k: row 0, column 3 is the first to go wrong.
    assert_eq!(borrowing(&[1.0; 4]).check(), Err(IndexError { array: "coupling", index: 3, len: 3 }));
}

#[test]
fn a_neighbour_beyond_the_end() {
    let system = Neighbours { n: 4, table: vec![vec![0.0; 3]; 4] };
    assert_eq!(system.check(), Err(IndexError { array: "y", index: 4, len: 4 }));
}

#[test]
fn a_neighbour_before_the_beginning() {
    assert_eq!(Predecessors { n: 3 }.check(), Err(IndexError { array: "y", index: -1, len: 3 }));
    assert_eq!(Predecessors { n: 1 }.check(), Ok(()));
}

#[test]
fn an_index_of_a_momentum() {
    assert_eq!(Weighted { g: vec![0.0; 3] }.check(), Err(IndexError { array: "g", index: 3, len: 3 }));
    assert_eq!(Weighted { g: vec![0.0; 4] }.check(), Ok(()));
}

#[test]
fn an_index_that_a_pair_keeps_in_range() {
    let system = |g: usize| Correlated::<4> { g: vec![1.0; g].into() };
    assert_eq!(system(4).check(), Ok(()));
    assert_eq!(system(3).check(), Err(IndexError { array: "g", index: 3, len: 3 }));
    assert_eq!(Correlated::<1> { g: Box::default() }.check(), Ok(()));
    assert_eq!(Correlated::<0> { g: Box::default() }.check(), Ok(()));
}
