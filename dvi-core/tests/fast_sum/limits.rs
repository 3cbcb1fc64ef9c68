//! Kernels, places and sizes at which a fast sum cannot be had in the usual way.

use approx::abs_diff_eq;
use dvi_core::DegenerateLagrangian;
use dvi_core::fast_sum::{FastSum, FastSumError};
use dvi_core::prelude::*;

use crate::{Blobs, BlobsState, Gravity, blobs, compare, numbers};

/// Kernels that fall off like a Gaussian, and harmonic springs: a kernel of exactly four products.
#[degenerate_lagrangian(
    coordinates(x[n], y[n]),
    one_form = sum(0..n, |j| x[j] * d(y[j])),
    hamiltonian = sum_pairs(0..n, |j, k|
        height * (-((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2)) / length.powi(2)).exp()
            + stiffness * ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2))),
)]
struct Gaussian {
    n: usize,
    length: f64,
    height: f64,
    stiffness: f64,
}

/// A ring around each body: by the logarithm of the distance to it, and a pole of one over the distance.
#[degenerate_lagrangian(
    coordinates(x[n], y[n]),
    one_form = sum(0..n, |j| x[j] * d(y[j])),
    hamiltonian = sum_pairs(0..n, |j, k|
        soft * ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2) - radius.powi(2)).powi(2).ln()
            + hard / ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2) - radius.powi(2))),
)]
struct Rings {
    n: usize,
    radius: f64,
    soft: f64,
    hard: f64,
}

/// Waves, shorter or longer than cubes are wide.
#[degenerate_lagrangian(
    coordinates(x[n], y[n]),
    one_form = sum(0..n, |j| x[j] * d(y[j])),
    hamiltonian = sum_pairs(0..n, |j, k| (number * (1.0 + (x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2)).sqrt()).cos()),
)]
struct Waves {
    n: usize,
    number: f64,
}

/// Places that are at least 1.05 apart.
fn lattice(n: usize) -> Vec<f64> {
    let side = (n as f64).sqrt().ceil() as usize;
    let place = |number: usize| 1.2 * number as f64;
    let x = (0..n).map(|j| place(j % side)).collect::<Vec<_>>();
    let y = (0..n).map(|j| place(j / side));
    x.into_iter().chain(y).zip(numbers(31)).map(|(place, number)| place + 0.05 * number).collect()
}

/// Beads on springs that do not get longer than 3.
#[test]
fn bodies_are_summed_one_by_one_where_the_kernel_has_no_numbers() {
    let n = 700;
    let q: Vec<f64> = numbers(30).take(2 * n).collect();
    let springs = Blobs { gamma: vec![1.0; n], core: 1.0, scale: -1.0 / 9.0, shear: 0.0 };
    compare::<_, 2>(&springs, &q, &[1e-8], "springs");
}

/// Hard discs of diameter 1.
fn discs(n: usize, strength: f64) -> Blobs {
    let gamma = vec![(4.0 * std::f64::consts::PI * strength).sqrt(); n];
    Blobs { gamma, core: -1.0, scale: 1.0, shear: 0.0 }
}

#[test]
fn the_kernel_need_not_have_a_number_at_any_place_without_a_body() {
    let n = 500;
    compare::<_, 2>(&discs(n, 1.0), &lattice(n), &[1e-8], "discs");
}

#[test]
fn strong_and_weak_forces() {
    let n = 500;
    for strength in [1e155, 1e-160] {
        let discs = discs(n, strength);
        let q = lattice(n);
        let fast = FastSum::<_, 2>::new(&discs, 1e-6).unwrap();
        let [mut found, mut expected] = [vec![0.0; 2 * n], vec![0.0; 2 * n]];
        fast.hamiltonian_gradient(&q, 0.0, &mut found);
        discs.hamiltonian_gradient(&q, 0.0, &mut expected);
        let largest = expected.iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
        for (found, expected) in found.iter().zip(&expected) {
            assert!(
                abs_diff_eq!(found, expected, epsilon = 1e-5 * largest),
                "{strength:e}: {found:e}, {expected:e}"
            );
        }
        let state = BlobsState { x: q[..n].to_vec(), y: q[n..].to_vec() };
        let error = fast.measured_error(&state, n).unwrap();
        assert!(error > 1e-12 && error < 1e-6, "{strength:e}: {error:e}");
    }
}

#[test]
fn deep_inside_of_a_core() {
    let n = 600;
    for (size, core, tolerance) in [(1e-9, 0.05, 1e-8), (1.0, 1e3, 1e-8), (1e-3, 0.05, 1e-10)] {
        let q: Vec<f64> = numbers(32).take(2 * n).map(|number| size * number).collect();
        let system = Blobs { shear: 0.0, ..blobs(n, core) };
        compare::<_, 2>(&system, &q, &[tolerance], &format!("size {size:e}"));
    }
}

/// Between the size of a cluster and the distance of the clusters there are cubes that have none far from
/// them.
#[test]
fn clusters_far_apart() {
    let n = 1200;
    for size in [1e-1, 1e-2, 1e-4] {
        for core in [0.0, 0.05] {
            let clusters: Vec<f64> = numbers(33)
                .take(2 * n)
                .enumerate()
                .map(|(j, number)| size * number + [0.0, 1.0, 1.3][j % n % 3])
                .collect();
            let system = Blobs { shear: 0.0, ..blobs(n, core) };
            compare::<_, 2>(&system, &clusters, &[1e-4, 1e-8], &format!("size {size:e}, core {core}"));
        }
    }
}

#[test]
fn kernels_of_a_low_rank() {
    let n = 3000;
    let place = |j: usize, square: f64| ((j % 7) as f64, square * ((j % 7) as f64).powi(2));
    let x = (0..n).map(|j| place(j, 0.37).0 + 0.01 * (1.7 * j as f64).sin());
    let y = (0..n).map(|j| place(j, 0.37).1 + 0.01 * (2.9 * j as f64).cos());
    let q: Vec<f64> = x.chain(y).collect();
    let springs = Gaussian { n, length: 1.0, height: 0.0, stiffness: 1.0 };
    let tolerances = [1e-3, 1e-4, 1e-5, 3e-6, 1e-7, 2e-10].map(|tolerance| 0.9999999 * tolerance);
    compare::<_, 2>(&springs, &q, &tolerances, "springs");
}

/// In small cubes a Gaussian is nearly 1 − r²/c².
#[test]
fn a_spiral_into_the_middle_of_a_gaussian() {
    let n = 2000;
    let radius = |j: usize| 1e-6_f64.powf(j as f64 / n as f64);
    let x = (0..n).map(|j| radius(j) * (2.4 * j as f64).cos());
    let y = (0..n).map(|j| radius(j) * (2.4 * j as f64).sin());
    let q: Vec<f64> = x.chain(y).collect();
    let gaussian = Gaussian { n, length: 0.3, height: 1.0, stiffness: 0.0 };
    compare::<_, 2>(&gaussian, &q, &[1e-2, 1e-3, 1e-4, 1e-5], "a spiral");
}

/// Forces and energies are those of all pairs there, at the cost of all pairs.
#[test]
fn kernels_that_interpolation_does_not_resolve() {
    let n = 2000;
    let q: Vec<f64> = numbers(34).take(2 * n).collect();
    let tolerances = [1e-3, 1e-6, 1e-8];
    for radius in [0.3, 0.7, 1.1, 2.0] {
        for [soft, hard] in [[1.0, 0.0], [0.0, 1.0]] {
            let case = format!("{soft} and {hard} of a ring at {radius}");
            compare::<_, 2>(&Rings { n, radius, soft, hard }, &q, &tolerances, &case);
        }
    }
    for number in [1.0, 3.0, 10.0, 30.0, 100.0, 1000.0] {
        let waves = Waves { n, number };
        compare::<_, 2>(&waves, &q, &tolerances, &format!("wave number {number}"));
        let state = WavesState { x: q[..n].to_vec(), y: q[n..].to_vec() };
        for tolerance in tolerances {
            let operations = FastSum::<_, 2>::new(&waves, tolerance).unwrap().operations(&state).unwrap();
            let (pairs, is_resolved) = ((n * (n - 1)) as u64, number < 20.0);
            assert_eq!(operations.products > 0, is_resolved, "wave number {number}: {operations:?}");
            assert_eq!(operations.pairs < pairs, is_resolved, "wave number {number}: {operations:?}");
        }
    }
}

#[test]
fn systems_that_are_not_whole_are_errors() {
    let short = Gravity { n: 10, g: 1.0, mass: vec![1.0; 9], core: 0.1 };
    let error = FastSum::<_, 3>::new(&short, 1e-3).unwrap_err();
    assert!(matches!(error, FastSumError::Index(_)), "{error}");
    let huge = Waves { n: usize::MAX / 4, number: 1.0 };
    assert!(matches!(FastSum::<_, 2>::new(&huge, 1e-6), Err(FastSumError::Index(_))));
    let few = Waves { n: 4, number: 1.0 };
    let fast = FastSum::<_, 2>::new(&few, 1e-6).unwrap();
    let state = WavesState { x: vec![0.0; 3], y: vec![0.0; 3] };
    let error = fast.measured_error(&state, 3).unwrap_err();
    assert_eq!((error.array, error.expected, error.found), ("x", 4, 3));
    assert!(fast.operations(&state).is_err());
    let whole = Gravity { n: 10, g: 1.0, mass: vec![1.0; 10], core: 0.1 };
    let error = FastSum::<_, 3>::new(&whole, 1e-7).unwrap_err();
    assert!(error.to_string().contains("between 1e-6 and 1e-2"), "{error}");
}
