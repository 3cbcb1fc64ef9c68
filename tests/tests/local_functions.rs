//! Functions and pairs of names inside of a formula are what they stand for.

use approx::{abs_diff_eq, assert_abs_diff_eq};
use dvi_core::prelude::*;
use dvi_tests::Outcome;

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
        let late = |i| (strength.len() - i) as f64 / 4.0;
        let one = |_i| 1.0;
        let x = |i| { let entry = |place| x[place]; entry(i) * entry((i + 1) % 4) };
        sum(0..4, |i| strength[i] * weight(i) * late(i) * x(i) * one(i))
    } + sum(0..4, |i| dot(x[i]).powi(2)) / 2.0,
)]
struct Ring {
    strength: [f64; 4],
}

#[test]
fn indices_are_passed_on() -> Outcome {
    let (system, x) = (Ring { strength: [0.5, -0.25, 2.0, 1.0] }, [0.3, 1.1, -0.7, 0.9]);
    let state = RingState { x, dot_x: [0.0; 4] };
    let weight = |i: usize| (1.0 + i as f64 / 2.0) * (4 - i) as f64 / 4.0;
    let expected: f64 = (0..4).map(|i| system.strength[i] * weight(i) * x[i] * x[(i + 1) % 4]).sum();
    assert!(abs_diff_eq!(system.lagrangian_at(0.0, &state)?, expected, epsilon = 1e-15));
    Ok(())
}
