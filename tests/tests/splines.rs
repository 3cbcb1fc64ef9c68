//! Splines of a table: they take its values, are smooth, have the derivatives that they say, and know where
//! they end.

use approx::abs_diff_eq;
use dvi_core::Scalar;
use dvi_core::field::{Axis, Expansion, ScalarField, Spline, SplineError};
use dvi_tests::fields::{self, by_dual_numbers};
use dvi_tests::{Numbers, Outcome, larger};
use num_dual::HyperDual64;

/// Points from `from` on whose distances differ by up to a factor of 2.
fn points(numbers: &mut Numbers, from: f64, count: usize, distance: f64) -> Vec<f64> {
    let mut at = from;
    let mut step = || {
        let here = at;
        at += distance * numbers.between([0.7, 1.4]);
        here
    };
    (0..count).map(|_| step()).collect()
}

/// Axes from −1 to 2, uniform and uneven, with a period and without.
fn axes(count: usize) -> Result<[Axis; 4], SplineError> {
    let mut uneven = points(&mut Numbers(7), 0.0, count, 1.0);
    let last = uneven[count - 1];
    uneven.iter_mut().for_each(|x| *x = (3.0 * *x / last - 1.0).min(2.0));
    let uniform = Axis::uniform([-1.0, 2.0], count)?;
    Ok([
        Axis::periodic(&uniform.points()[..count - 1], 3.0)?,
        Axis::periodic(&uneven[..count - 1], 3.0)?,
        uniform,
        Axis::new(&uneven)?,
    ])
}

/// Of period 3, as the axes are.
fn smooth<const D: usize, T: Scalar>(at: [T; D]) -> T {
    fields::smooth(3.0, at)
}

/// What is said of what is refused; nothing of what is not.
fn refusal<T, E: core::fmt::Display>(result: Result<T, E>) -> String {
    result.err().map(|error| error.to_string()).unwrap_or_default()
}

fn all<const D: usize, T: Copy>(expansion: &Expansion<D, T>) -> Vec<T> {
    let second = expansion.hessian.as_flattened();
    [&[expansion.value], &expansion.gradient[..], second].concat()
}

/// The largest difference of two lists, relative to the largest entry of the second, or to 1.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    let size = b.iter().map(|x| x.abs()).fold(1.0, larger);
    a.iter().zip(b).map(|(a, b)| (a - b).abs() / size).fold(0.0, larger)
}

/// Calls `of` with splines in one, two and three variables on each kind of axis.
fn for_each_kind(
    mut one: impl FnMut(&Axis) -> Outcome,
    mut two: impl FnMut([&Axis; 2]) -> Outcome,
    mut three: impl FnMut([&Axis; 3]) -> Outcome,
) -> Outcome {
    let (long, short) = (axes(11)?, axes(8)?);
    for i in 0..4 {
        one(&long[i])?;
        two([&long[i], &short[(i + 1) % 4]])?;
        three([&short[i], &long[(i + 1) % 4], &short[(i + 2) % 4]])?;
    }
    Ok(())
}

macro_rules! for_each_kind {
    ($check:ident) => {
        for_each_kind(|axis| $check([axis]), |axes| $check(axes), |axes| $check(axes))
    };
}

mod refusals;
mod scales;
mod uneven;

/// Both degrees, as one type: the values of the checks below do not depend on it.
fn of_both_degrees<const D: usize>(
    axes: [&Axis; D],
    mut check: impl FnMut(
        &dyn Fn([f64; D]) -> Expansion<D>,
        &dyn Fn([HyperDual64; D]) -> Expansion<D, HyperDual64>,
    ),
) -> Outcome {
    let cubic = Spline::sample(axes.map(Axis::clone), smooth)?;
    check(&|at| cubic.expansion(at), &|at| cubic.expansion(at));
    let quintic = Spline::sample_quintic(axes.map(Axis::clone), smooth)?;
    check(&|at| quintic.expansion(at), &|at| quintic.expansion(at));
    Ok(())
}

#[test]
fn a_spline_takes_the_values_of_the_table() -> Outcome {
    fn check<const D: usize>(axes: [&Axis; D]) -> Outcome {
        of_both_degrees(axes, |spline, _| {
            let count: usize = axes.iter().map(|axis| axis.points().len()).product();
            for mut index in 0..count {
                let at = axes.map(|axis| {
                    let points = axis.points();
                    let x = points[index % points.len()];
                    index /= points.len();
                    x
                });
                let (found, expected) = (spline(at).value, smooth(at));
                assert!(abs_diff_eq!(found, expected, epsilon = 1e-13), "{at:?}: {found} {expected}");
            }
        })
    }
    for_each_kind!(check)
}

#[test]
fn the_smallest_tables() -> Outcome {
    let values = [1.0, -2.0, 0.5, 4.0, -1.0, 0.25];
    for count in 4..=6 {
        let uneven = [-1.0, -0.25, 0.0, 1.0, 1.5, 2.0];
        let points = &uneven[..count];
        for axis in [Axis::new(points)?, Axis::periodic(points, 3.75)?, Axis::uniform([0.0, 2.0], count)?] {
            let cubic = Spline::new([axis.clone()], &values[..count])?;
            let quintic = Spline::quintic([axis.clone()], &values[..count]);
            assert_eq!(quintic.is_ok(), count == 6);
            for (&x, expected) in axis.points().iter().zip(values) {
                let found = cubic.expansion([x]).value;
                assert!(abs_diff_eq!(found, expected, epsilon = 1e-13), "{axis:?} {x}: {found}");
                let found = quintic.as_ref().map_or(expected, |quintic| quintic.expansion([x]).value);
                assert!(abs_diff_eq!(found, expected, epsilon = 1e-13), "{axis:?} {x}: {found}");
            }
        }
    }
    Ok(())
}

#[test]
fn derivatives_are_those_of_the_value() -> Outcome {
    fn check<const D: usize>(axes: [&Axis; D]) -> Outcome {
        let mut numbers = Numbers(D as u64);
        of_both_degrees(axes, |spline, in_dual_numbers| {
            for _ in 0..40 {
                let at = core::array::from_fn(|_| numbers.between([-1.0, 2.0]));
                let found = spline(at);
                let expected = by_dual_numbers(at, |x| in_dual_numbers(x).value);
                let error = difference(&all(&found), &all(&expected));
                assert!(error < 1e-13, "{at:?}: {error:e}");
                // The gradient on dual numbers has the Hessian.
                for i in 0..D {
                    let mut x = at.map(HyperDual64::from);
                    x[i].eps1 = 1.0;
                    let gradient = in_dual_numbers(x).gradient.map(|g| g.eps1);
                    assert!(difference(&gradient, &found.hessian[i]) < 1e-13, "{at:?}");
                }
                // Differences of the value, of fourth order, where the polynomial has no jump of higher
                // derivatives.
                for i in 0..D {
                    let h = 1e-3;
                    let f = |steps: f64| {
                        let mut x = at;
                        x[i] = (x[i] + steps * h).clamp(-1.0, 2.0);
                        spline(x).value
                    };
                    if (at[i] - 0.5).abs() < 1.49 {
                        let slope = (8.0 * (f(1.0) - f(-1.0)) - (f(2.0) - f(-2.0))) / (12.0 * h);
                        assert!((slope - found.gradient[i]).abs() < 1e-4, "{at:?}: {slope} {found:?}");
                    }
                }
            }
        })
    }
    for_each_kind!(check)
}

/// On both sides of each line of the grid the value and all derivatives that are continuous agree. Those
/// above the second are derivatives of the Hessian on dual numbers.
#[test]
fn derivatives_are_continuous() -> Outcome {
    fn check<const D: usize>(axes: [&Axis; D]) -> Outcome {
        let (mut numbers, mut degree) = (Numbers(3), 3);
        of_both_degrees(axes, |spline, in_dual_numbers| {
            for (i, axis) in axes.iter().enumerate() {
                let points = axis.points();
                for &line in &points[1..points.len() - 1] {
                    let mut at: [f64; D] = core::array::from_fn(|_| numbers.between([-1.0, 2.0]));
                    let side = |x: f64| {
                        let mut at = at;
                        at[i] = x;
                        at
                    };
                    let (below, above) = (side(line.next_down()), side(line));
                    let error = difference(&all(&spline(below)), &all(&spline(above)));
                    assert!(error < 1e-12, "{at:?} {i} {line}: {error:e}");
                    // The third and fourth derivatives across the line.
                    let higher = |at: [f64; D]| {
                        let mut at = at.map(HyperDual64::from);
                        (at[i].eps1, at[i].eps2) = (1.0, 1.0);
                        let second = in_dual_numbers(at).hessian[i][i];
                        [second.eps1, second.eps1eps2]
                    };
                    let error = difference(&higher(below), &higher(above));
                    if degree == 5 {
                        assert!(error < 1e-10, "{at:?} {i} {line}: {error:e}");
                    } else if axis.period().is_none()
                        && [points[1], points[points.len() - 2]].contains(&line)
                    {
                        assert!(error < 1e-10, "not a knot: {at:?} {i} {line}: {error:e}");
                    } else {
                        assert!(error > 1e-6, "a cubic spline has jumps of the third derivative: {error:e}");
                    }
                    at[i] = line;
                    assert!(spline(at).value.is_finite());
                }
            }
            degree = 5;
        })
    }
    for_each_kind!(check)
}

/// Across the end of a period too.
#[test]
fn a_period_has_no_ends() -> Outcome {
    for axis in &axes(9)?[..2] {
        of_both_degrees([axis], |spline, _| {
            let first = axis.points()[0];
            for end in [first, first + 3.0, first - 6.0] {
                let error = difference(&all(&spline([end.next_down()])), &all(&spline([end.next_up()])));
                assert!(error < 1e-12, "{error:e}");
            }
            // Steps of 3 · 2ᵏ and binary fractions are added without rounding.
            for (x, periods) in
                [(0.625, 1.0), (-0.875, -1.0), (1.5, 1e9), (0.25, -1e9), (-0.5, 2_f64.powi(45))]
            {
                let (near, far) = (spline([x]), spline([x + 3.0 * periods]));
                assert!(difference(&all(&far), &all(&near)) < 1e-14, "{x} {periods}: {far:?} {near:?}");
            }
            assert!([1e300, f64::MAX, f64::MIN].iter().all(|x| spline([*x]).value.is_finite()));
        })?;
    }
    Ok(())
}

/// Any period and any first point: what is far away is in its place in the first period, to the rounding of
/// the argument.
#[test]
fn periods_are_taken_off() -> Outcome {
    let mut numbers = Numbers(23);
    for _ in 0..200 {
        let (first, period) = (numbers.between([-5.0, 5.0]), numbers.between([0.1, 10.0]));
        let points: Vec<f64> = (0..7).map(|i| first + period * f64::from(i) / 7.0).collect();
        let wave = |x: f64| (std::f64::consts::TAU * (x - first) / period).sin();
        let spline = Spline::sample([Axis::periodic(&points, period)?], |[x]| wave(x))?;
        for turns in [0, 1, -1, 3, -1000, 1_000_000_000] {
            let x = numbers.between([first, first + period]);
            let far = x + f64::from(turns) * period;
            let off = spline.expansion([x]).value - spline.expansion([far]).value;
            let rounding = 1e-14 + 4.0 * f64::EPSILON * far.abs() * std::f64::consts::TAU / period;
            assert!(off.abs() < rounding, "{first} {period} {x} {turns}: {off:e}");
        }
        for end in [first, first + period, first - period, first + 5.0 * period] {
            for x in [end.next_down(), end, end.next_up()] {
                let off: f64 = spline.expansion([x]).value - wave(x);
                assert!(off.abs() < 1e-13, "{first} {period} {x}: {off:e}");
            }
        }
    }
    Ok(())
}

/// x₀ᵃ x₁ᵇ x₂ᶜ with exponents up to the degree, on axes without a period.
#[test]
fn polynomials_are_reproduced() -> Outcome {
    let powers =
        |degree: i32, term: i32| [term % degree + 1, (3 * term + 1) % (degree + 1), degree - term % degree];
    let exact = |at: [HyperDual64; 3], powers: [i32; 3]| {
        (0..3).fold(HyperDual64::from(1.0), |product, i| product * Scalar::powi(at[i], powers[i]))
    };
    let value = |at: [f64; 3], powers: [i32; 3]| exact(at.map(HyperDual64::from), powers).re;
    let [_, _, uniform, uneven] = axes(9)?;
    let short = Axis::new(&[-1.0, -0.75, 0.0, 0.5, 1.0, 2.0])?;
    let axes = [uneven, short, uniform];
    let mut numbers = Numbers(5);
    for term in 0..5 {
        let (three, five) = (powers(3, term), powers(5, term));
        let cubic = Spline::sample(axes.clone(), |at| value(at, three))?;
        let quintic = Spline::sample_quintic(axes.clone(), |at| value(at, five))?;
        for _ in 0..50 {
            let at = core::array::from_fn(|_| numbers.between([-1.0, 2.0]));
            let error =
                difference(&all(&cubic.expansion(at)), &all(&by_dual_numbers(at, |x| exact(x, three))));
            assert!(error < 1e-12, "{three:?} {at:?}: {error:e}");
            let error =
                difference(&all(&quintic.expansion(at)), &all(&by_dual_numbers(at, |x| exact(x, five))));
            assert!(error < 1e-11, "{five:?} {at:?}: {error:e}");
        }
    }
    Ok(())
}
