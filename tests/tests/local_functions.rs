//! Functions and pairs of names inside of a formula are what they stand for, to the bit and to the operation.

use approx::{abs_diff_eq, assert_abs_diff_eq};
use dvi_core::Report;
use dvi_core::prelude::*;
use dvi_tests::Outcome;

/// Vortices, with a function of two indices.
#[degenerate_lagrangian(
    coordinates(x[n], y[n]),
    one_form = sum(0..n, |j| gamma[j] / 2.0 * (x[j] * d(y[j]) - y[j] * d(x[j]))),
    hamiltonian = {
        let gap = |j, k| (x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2);
        sum_pairs(0..n, |j, k| gamma[j] * gamma[k] * gap(j, k).ln()) / (4.0 * PI)
    },
)]
struct Named {
    n: usize,
    gamma: Vec<f64>,
}

/// The same written out.
#[degenerate_lagrangian(
    coordinates(x[n], y[n]),
    one_form = sum(0..n, |j| gamma[j] / 2.0 * (x[j] * d(y[j]) - y[j] * d(x[j]))),
    hamiltonian = sum_pairs(0..n, |j, k| gamma[j] * gamma[k]
        * ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2)).ln()) / (4.0 * PI),
)]
struct WrittenOut {
    n: usize,
    gamma: Vec<f64>,
}

#[test]
fn a_sum_over_pairs_by_a_function_of_indices_is_the_same_sum() {
    let gamma = vec![1.0, -0.5, 2.0, 0.7, 1.3];
    let named = Named { n: 5, gamma: gamma.clone() };
    let written = WrittenOut { n: 5, gamma };
    let entries = |of: fn(f64) -> f64| (1..=5).map(f64::from).map(of).collect::<Vec<f64>>();
    let [x, y] = [entries(|j| (1.7 * j).sin()), entries(|j| (2.3 * j).cos())];
    let (q, [mut a, mut b]) = ([x, y].concat(), [[0.0; 10]; 2]);
    named.hamiltonian_gradient(&q, 0.0, &mut a);
    written.hamiltonian_gradient(&q, 0.0, &mut b);
    assert_eq!(a, b);
    let seen = |report: &Report| format!("{:?}", (report.structure, report.residual, report.jacobian));
    assert_eq!(seen(&Named::REPORT), seen(&WrittenOut::REPORT));
}

/// A potential as a formula, and as Rust that is run.
macro_rules! potential {
    ($depth:ident, $x:ident, $y:ident; $($potential:tt)*) => {
        #[lagrangian(
            coordinates($x, $y),
            lagrangian = (dot($x).powi(2) + dot($y).powi(2)) / 2.0 - { $($potential)* },
        )]
        struct Well {
            $depth: f64,
        }

        fn by_rust($depth: f64, $x: f64, $y: f64) -> f64 {
            $($potential)*
        }
    };
}

potential! {
    depth, x, y;
    let shift = 0.25;
    // It sees the shift above, whatever stands below.
    let from = |a: f64, b: f64| ((a - shift) * (a - shift) + b * b + depth).sqrt();
    let twice = |a: f64| from(a, a) + from(a, 1.0);
    let shift = 7.0;
    let (s, c) = x.sin_cos();
    let (inner, outer) = (twice(s), { let twice = |b: f64| b * shift; twice(c) });
    // The right sides are those before.
    let (s, c) = (c, s);
    let from = |a: f64, b: f64| from(a * c, b + s);
    if x < y { inner * outer } else { from(inner, outer) }
}

#[test]
fn a_formula_with_functions_is_what_rust_makes_of_it() -> Outcome {
    let system = Well { depth: 0.75 };
    for (x, y) in [(0.3, 0.4), (0.4, 0.3), (-1.2, 2.0), (2.5, -0.1)] {
        let found = system.energy_at(0.0, &WellState { x, y, dot_x: 0.0, dot_y: 0.0 })?;
        let expected = by_rust(system.depth, x, y);
        assert_abs_diff_eq!(found, expected, epsilon = 1e-14 * expected.abs());
    }
    Ok(())
}

/// Indices that a function passes on, that it makes numbers of, and that it does not read.
#[lagrangian(
    coordinates(x[4]),
    lagrangian = {
        let number = |i| i as f64;
        let next = |i| (i + 1) as f64;
        let weight = |i| (number(i) + next(i) + 3.0) / 4.0;
        let one = |_i| 1.0;
        let x = |i| { let entry = |place| x[place]; entry(i) * entry((i + 1) % 4) };
        sum(0..4, |i| strength[i] * weight(i) * x(i) * one(i))
    } + sum(0..4, |i| dot(x[i]).powi(2)) / 2.0,
)]
struct Ring {
    strength: [f64; 4],
}

#[test]
fn indices_are_passed_on() -> Outcome {
    let (system, x) = (Ring { strength: [0.5, -0.25, 2.0, 1.0] }, [0.3, 1.1, -0.7, 0.9]);
    let state = RingState { x, dot_x: [0.0; 4] };
    let terms = (0..4).map(|i| system.strength[i] * (1.0 + i as f64 / 2.0) * x[i] * x[(i + 1) % 4]);
    let expected: f64 = terms.sum();
    assert!(abs_diff_eq!(system.lagrangian_at(0.0, &state)?, expected, epsilon = 1e-15));
    Ok(())
}
