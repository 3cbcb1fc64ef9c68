//! Names that all formulas of a system share are what they stand for, to the bit and to the operation, and
//! so are functions and pairs of names inside of a formula.

use approx::{abs_diff_eq, assert_abs_diff_eq};
use dvi_core::Report;
use dvi_core::prelude::*;
use dvi_tests::Outcome;

/// Two balls on springs between walls, with names for what stands in several formulas.
#[lagrangian(
    coordinates(x[2]),
    lagrangian = sum(0..2, |i| m[i] * dot(x[i]).powi(2) / 2.0 - m[i] * spring(x[i])),
    force(x) = |i| -drag * p(i),
    impact = [gap, 2.0 - x[1]],
    momenta(total = p(0) + p(1)),
    events(level = spring(x[0]) - spring(x[1]), closing = dot(x[1]) - v),
    let = {
        let v = dot(x[0]);
        let gap = x[1] - x[0] - d;
        let spring = |a| k * a * a / 2.0;
        let p = |i| m[i] * dot(x[i]);
    },
)]
struct Named {
    m: [f64; 2],
    k: f64,
    d: f64,
    drag: f64,
}

/// The same written out.
#[lagrangian(
    coordinates(x[2]),
    lagrangian = sum(0..2, |i| m[i] * dot(x[i]).powi(2) / 2.0 - m[i] * (k * x[i] * x[i] / 2.0)),
    force(x) = |i| -drag * (m[i] * dot(x[i])),
    impact = [x[1] - x[0] - d, 2.0 - x[1]],
    momenta(total = m[0] * dot(x[0]) + m[1] * dot(x[1])),
    events(level = k * x[0] * x[0] / 2.0 - k * x[1] * x[1] / 2.0, closing = dot(x[1]) - dot(x[0])),
)]
struct WrittenOut {
    m: [f64; 2],
    k: f64,
    d: f64,
    drag: f64,
}

#[test]
fn a_system_with_shared_names_is_the_same_system() -> Outcome {
    let (m, k, d, drag) = ([1.0, 2.5], 3.0, 0.25, 0.1);
    let (named, written) = (Named { m, k, d, drag }, WrittenOut { m, k, d, drag });
    let ([mut one, mut other], q, v) = ([[0.0; 2]; 2], [0.3, 0.8], [0.2, -0.5]);
    named.gap_rate(&q, &v, 0.0, &mut one);
    written.gap_rate(&q, &v, 0.0, &mut other);
    assert_eq!(one, other);
    let state = NamedState { x: q, dot_x: v };
    let same = WrittenOutState { x: q, dot_x: v };
    for event in 0..2 {
        let rates: [f64; 2] =
            [named.event_rate(0.0, event, &state)?, written.event_rate(0.0, event, &same)?];
        assert_eq!(rates[0], rates[1]);
    }
    let seen = |report: &Report| format!("{:?}", (report.structure, report.residual, report.jacobian));
    assert_eq!(seen(&Named::REPORT), seen(&WrittenOut::REPORT));
    Ok(())
}

/// A name that no formula uses costs nothing, and one with velocities may stand beside formulas without.
#[degenerate_lagrangian(
    coordinates(x, p),
    lagrangian = action - energy,
    gauge = -half,
    momenta(squares = squares(x) + squares(p)),
    let = {
        let action = p * dot(x);
        let half = x * p / 2.0;
        let squares = |a| a * a;
        let energy = (squares(p) + squares(x)) / 2.0;
        let _unused = energy.sqrt().ln();
    },
)]
struct Oscillator;

#[test]
fn a_degenerate_system_shares_names_too() -> Outcome {
    let state = OscillatorState { x: 0.6, p: -0.8 };
    assert!(abs_diff_eq!(Oscillator.energy_at(0.0, &state)?, 0.5, epsilon = 1e-15));
    let mut one_form = [0.0; 2];
    Oscillator.one_form(&[0.6, -0.8], 0.0, &mut one_form);
    // α + d(−½xp) = ½ (p dx − x dp)
    assert_eq!(one_form, [-0.4, -0.3]);
    let of_name = |name: &str| Oscillator::REPORT.formulas.iter().find(|formula| formula.name == name);
    assert_eq!(of_name("squares(a)").map(|formula| formula.text), Some("a * a"));
    assert_eq!(of_name("half").map(|formula| formula.text), Some("x * p / 2.0"));
    Ok(())
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
