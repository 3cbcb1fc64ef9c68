//! The orders with which splines and their derivatives come near to the functions that they were sampled
//! from.

use dvi_core::field::{Axis, ScalarField, Spline, SplineError};
use dvi_core::prelude::convergence_order;
use dvi_tests::fields::{by_dual_numbers, smooth};
use dvi_tests::{Numbers, Outcome, apart, larger};

/// Axes from 1 to 3, uniform and with smoothly varying distances, with a period and without.
fn axes(cells: usize) -> Result<[Axis; 4], SplineError> {
    let graded = |s: f64| 1.0 + 2.0 * s + 0.1 * (core::f64::consts::TAU * s).sin();
    let points = |count: usize| (0..count).map(|i| graded(i as f64 / cells as f64)).collect::<Vec<f64>>();
    let uniform = Axis::uniform([1.0, 3.0], cells + 1)?;
    Ok([
        Axis::periodic(&uniform.points()[..cells], 2.0)?,
        Axis::periodic(&points(cells), 2.0)?,
        uniform,
        Axis::new(&points(cells + 1))?,
    ])
}

/// The largest differences of value, gradient and Hessian from the function at scattered points of the
/// domain, many of them within a cell of its ends, where the differences are largest.
fn errors<const D: usize>(spline: &impl ScalarField<D>, cells: usize) -> [f64; 3] {
    let (mut numbers, mut errors, cell) = (Numbers(1), [0.0; 3], 2.0 / cells as f64);
    for k in 0..3000 {
        let at = core::array::from_fn(|i| {
            numbers.between(match (k >> (2 * i)) % 4 {
                0 => [1.0, 1.0 + cell],
                1 => [3.0 - cell, 3.0],
                _ => [1.0, 3.0],
            })
        });
        let (found, exact) = (spline.expansion(at), by_dual_numbers(at, |at| smooth(2.0, at)));
        let off = [
            apart(&[found.value], &[exact.value]),
            apart(&found.gradient, &exact.gradient),
            apart(found.hessian.as_flattened(), exact.hessian.as_flattened()),
        ];
        errors = core::array::from_fn(|i| larger(errors[i], off[i]));
    }
    errors
}

/// Compares the orders of both degrees with those of the literature on all kinds of grids.
fn assert_orders<const D: usize>(cells: &[usize]) -> Outcome {
    for kind in 0..4 {
        let mut series = [const { Vec::new() }; 6];
        for &cells in cells {
            let axis = &axes(cells)?[kind];
            let axes: [Axis; D] = core::array::from_fn(|_| axis.clone());
            let cubic = Spline::sample(axes.clone(), |at| smooth(2.0, at))?;
            let quintic = Spline::sample_quintic(axes, |at| smooth(2.0, at))?;
            let found = [errors(&cubic, cells), errors(&quintic, cells)];
            for (series, &error) in series.iter_mut().zip(found.as_flattened()) {
                series.push((1.0 / cells as f64, error));
            }
        }
        for (errors, expected) in series.iter().zip([4.0, 3.0, 2.0, 6.0, 5.0, 4.0]) {
            let order = convergence_order(errors).ok_or("no slope")?;
            assert!(
                (order - expected).abs() < 0.35,
                "{D}, axis {kind}: {order}, not {expected}: {errors:?}"
            );
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
