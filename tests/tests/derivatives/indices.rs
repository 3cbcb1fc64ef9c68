//! `check()` names the first index that leaves an array.

use dvi_core::{DegenerateLagrangian, IndexError, System, degenerate_lagrangian, lagrangian};
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
fn a_neighbour_beyond_the_end_or_before_the_beginning() {
    let system = Neighbours { n: 4, table: vec![vec![0.0; 3]; 4] };
    assert_eq!(system.check(), Err(IndexError { array: "y", index: 4, len: 4 }));
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

/// An index along both sides of a table.
#[degenerate_lagrangian(
    coordinates(x[n], y[n]),
    one_form    = sum(0..n, |j| x[j] * d(y[j])),
    hamiltonian = sum(0..n, |j| table[j][j] * x[j] * x[j]) + sum(0..n, |i| sum(0..m, |j| k[i][j] * k[j][i] * x[i])),
)]
struct Diagonal {
    n: usize,
    m: usize,
    table: Vec<Vec<f64>>,
    k: Vec<[f64; 3]>,
}

#[test]
fn rows_of_tables_are_checked_as_their_lengths_are() {
    let system = |rows: &[usize], k| Diagonal {
        n: rows.len(),
        m: 3,
        table: rows.iter().map(|length| vec![1.0; *length]).collect(),
        k: vec![[1.0; 3]; k],
    };
    assert_eq!(system(&[2, 2], 3).check(), Ok(()));
    assert_eq!(system(&[1, 2], 3).check(), Ok(()));
    assert_eq!(system(&[2, 1], 3).check(), Err(IndexError { array: "table", index: 1, len: 1 }));
    assert_eq!(system(&[2, 2], 2).check(), Err(IndexError { array: "k", index: 2, len: 2 }));
}

/// A sum whose end is a field, and entries that do not depend on its index.
#[degenerate_lagrangian(
    coordinates(x[n], y[n], z, w),
    one_form    = sum(0..n, |j| x[j] * d(y[j])) + z * d(w),
    hamiltonian = z * z + sum(0..m, |j| k[j] * k[0] * z) + sum(0..n, |j| x[j] * y[n - 1]) + sum(0..m, |j| k[j] * x[j % n]),
)]
struct Ends {
    n: usize,
    m: usize,
    k: Vec<f64>,
}

#[test]
fn sizes_of_nothing_and_beyond_all_arrays() {
    let system = |n, m, k| Ends { n, m, k: vec![1.0; k] };
    assert_eq!(system(2, 3, 3).check(), Ok(()));
    for m in [4, 1 << 31, (1 << 63) - 1, 1 << 63, usize::MAX] {
        assert_eq!(system(2, m, 3).check(), Err(IndexError { array: "k", index: 3, len: 3 }), "m = {m}");
    }
    // What is read inside of a loop that does not run is not read.
    assert_eq!(system(2, 0, 0).check(), Ok(()));
    assert!(system(2, 0, 0).hamiltonian(&[1.0_f64; 6], 0.0).is_finite());
    // What is read before it is.
    assert_eq!(system(0, 0, 1).check(), Err(IndexError { array: "y", index: -1, len: 0 }));
}

/// Factors that move out of sums which may be empty.
#[lagrangian(
    coordinates(z, x[n]),
    lagrangian = dot(z).powi(2) / 2.0 - z * z + sum(0..n, |j| dot(x[j]).powi(2)) / 2.0
        + sum(0..n, |j| x[j] * x[0]) + sum(0..k.len(), |j| k[0] * k[j] * x[j] * x[j]),
)]
struct Factors {
    n: usize,
    k: Vec<f64>,
}

#[test]
fn what_moves_out_of_an_empty_sum_is_checked() {
    let system = |n, k| Factors { n, k: vec![1.0; k] };
    assert_eq!(system(2, 2).check(), Ok(()));
    assert_eq!(system(2, 3).check(), Err(IndexError { array: "x", index: 2, len: 2 }));
    assert_eq!(system(0, 0).check(), Err(IndexError { array: "x", index: 0, len: 0 }));
    assert_eq!(system(1, 0).check(), Err(IndexError { array: "k", index: 0, len: 0 }));
}
