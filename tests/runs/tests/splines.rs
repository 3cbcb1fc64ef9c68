//! The orders with which splines and their derivatives come near to the functions that they were sampled
//! from.

use dvi_core::Scalar;
use dvi_core::field::{Axis, Expansion, ScalarField, Spline};
use dvi_tests::Outcome;
use dvi_tests::larger;
use num_dual::HyperDual64;

/// Numbers in [0, 1), the same in each run: Weyl's sequence to an irrational number for each dimension.
fn scattered(k: usize, dimension: usize) -> f64 {
    (k as f64 * [0.819_172_513_396_164_4, 0.671_043_606_703_789_2, 0.549_700_477_901_970_3][dimension])
        .fract()
}

/// How the points of an axis lie.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Grid {
    Uniform,
    Graded,
    Periodic,
    GradedPeriodic,
}

/// From `s` in [0, 1] to a place on an axis from 1 to 3, with smoothly varying distances if the grid is
/// graded.
fn graded(s: f64) -> f64 {
    1.0 + 2.0 * s + 0.1 * (std::f64::consts::TAU * s).sin()
}

fn axis(grid: Grid, cells: usize) -> Result<Axis, dvi_core::field::SplineError> {
    let points = |count: usize| (0..count).map(|i| graded(i as f64 / cells as f64)).collect::<Vec<f64>>();
    match grid {
        Grid::Uniform => Axis::uniform([1.0, 3.0], cells + 1),
        Grid::Graded => Axis::new(&points(cells + 1)),
        // One with the end of the period among the points, one without.
        Grid::Periodic => Axis::periodic(Axis::uniform([1.0, 3.0], cells + 1)?.points(), 2.0),
        Grid::GradedPeriodic => Axis::periodic(&points(cells), 2.0),
    }
}

/// A function of D variables, of period 2 in each, that is no product of functions of one variable.
fn smooth<const D: usize, T: Scalar>(at: [T; D]) -> T {
    let wave = |i: usize| (at[i] * T::lift(std::f64::consts::PI) + T::lift(0.3 + i as f64)).sin();
    let sum = (0..D).fold(T::lift(0.0), |sum, i| sum + wave(i) * T::lift(0.5 + 0.25 * i as f64));
    sum + wave(0) * wave(D - 1) * T::lift(0.5)
}

/// Value, gradient and Hessian by dual numbers.
fn by_dual_numbers<const D: usize>(
    at: [f64; D],
    function: impl Fn([HyperDual64; D]) -> HyperDual64,
) -> Expansion<D> {
    let zero = Expansion { value: 0.0, gradient: [0.0; D], hessian: [[0.0; D]; D] };
    (0..D * D).fold(zero, |mut expansion, entry| {
        let (i, j) = (entry / D, entry % D);
        let mut x = at.map(HyperDual64::from);
        x[i].eps1 = 1.0;
        x[j].eps2 = 1.0;
        let f = function(x);
        expansion.value = f.re;
        expansion.gradient[i] = f.eps1;
        expansion.hessian[i][j] = f.eps1eps2;
        expansion
    })
}

/// The largest differences of value, gradient and Hessian.
fn difference<const D: usize>(a: &Expansion<D>, b: &Expansion<D>) -> [f64; 3] {
    let largest = |x: &[f64], y: &[f64]| x.iter().zip(y).fold(0.0, |m, (x, y)| larger(m, (x - y).abs()));
    [
        (a.value - b.value).abs(),
        largest(&a.gradient, &b.gradient),
        largest(a.hessian.as_flattened(), b.hessian.as_flattened()),
    ]
}

/// The largest differences from the function at scattered points of the domain, many of them within a cell
/// of its ends, where the differences are largest.
fn errors<const D: usize>(spline: &impl ScalarField<D>, cells: usize) -> [f64; 3] {
    (0..3000).fold([0.0; 3], |errors, k| {
        let at = core::array::from_fn(|i| {
            let part = scattered(k, i);
            match (k >> (2 * i)) % 4 {
                0 => 1.0 + 2.0 * part / cells as f64,
                1 => 3.0 - 2.0 * part / cells as f64,
                _ => 1.0 + 2.0 * part,
            }
        });
        let found = difference(&spline.expansion(at), &by_dual_numbers(at, smooth));
        core::array::from_fn(|i| larger(errors[i], found[i]))
    })
}

/// The exponents of 1/cells with which the errors of value, gradient and Hessian fall, by least squares.
fn orders(errors: &[(usize, [f64; 3])]) -> [f64; 3] {
    let logarithms = errors.iter().map(|(cells, _)| (*cells as f64).ln());
    let mean = logarithms.clone().sum::<f64>() / errors.len() as f64;
    core::array::from_fn(|i| {
        let (mut covariance, mut variance) = (0.0, 0.0);
        for (logarithm, (_, errors)) in logarithms.clone().zip(errors) {
            covariance += (logarithm - mean) * errors[i].ln();
            variance += (logarithm - mean) * (logarithm - mean);
        }
        -covariance / variance
    })
}

/// Compares the orders of both degrees with those of the literature on all kinds of grids.
fn assert_orders<const D: usize>(cells: &[usize]) -> Outcome {
    for grid in [Grid::Uniform, Grid::Graded, Grid::Periodic, Grid::GradedPeriodic] {
        let (mut cubic, mut quintic) = (Vec::new(), Vec::new());
        for &cells in cells {
            let axis = axis(grid, cells)?;
            let axes: [Axis; D] = core::array::from_fn(|_| axis.clone());
            cubic.push((cells, errors(&Spline::sample(axes.clone(), smooth)?, cells)));
            quintic.push((cells, errors(&Spline::sample_quintic(axes, smooth)?, cells)));
        }
        for (errors, expected) in [(cubic, [4.0, 3.0, 2.0]), (quintic, [6.0, 5.0, 4.0])] {
            let orders = orders(&errors);
            let is_near =
                orders.iter().zip(expected).all(|(order, expected)| (order - expected).abs() < 0.35);
            assert!(is_near, "{D} {grid:?}: {orders:.2?} {errors:?}");
        }
    }
    Ok(())
}

#[test]
fn orders_in_one_variable() -> Outcome {
    assert_orders::<1>(&[32, 48, 64, 96])
}

#[test]
fn orders_in_two_variables() -> Outcome {
    assert_orders::<2>(&[32, 48, 64])
}

#[test]
fn orders_in_three_variables() -> Outcome {
    assert_orders::<3>(&[32, 48, 64])
}
