//! The scale of an axis and of values does not show, but for rounding.

use approx::assert_abs_diff_eq;
use dvi_core::field::{Axis, Expansion, ScalarField, Spline};

use super::{Numbers, Outcome, all, axes, difference, smooth};

/// Far from zero, in tiny units, with one cell: the scale of an axis does not show.
#[test]
fn scales_of_axes() -> Outcome {
    let f = |x: f64| (3.0 * x).sin() + x * x;
    let points = |count: usize| (0..count).map(|i| i as f64 / (count - 1) as f64).collect::<Vec<f64>>();
    for count in [4, 5, 9, 33] {
        let values: Vec<f64> = points(count).into_iter().map(f).collect();
        let reference = Spline::new([Axis::new(&points(count))?], &values)?;
        // Powers of two and sums with few digits, so that the axes are the same but for their scale.
        for (origin, scale) in [
            (0.0, 2_f64.powi(-500)),
            (0.0, 2_f64.powi(500)),
            (-7.0, 1.0),
            (-1048576.0, 1.0),
            (1e6, 0.03125),
            (2_f64.powi(40), 1.0),
        ] {
            let axis: Vec<f64> = points(count).iter().map(|x| origin + scale * x).collect();
            let spline = Spline::new([Axis::new(&axis)?], &values)?;
            for k in 0..=64 {
                let x = f64::from(k) / 64.0;
                let at = origin + scale * x;
                let (found, expected) = (spline.expansion([at]), reference.expansion([x]));
                let found = [found.value, found.gradient[0] * scale, found.hessian[0][0] * scale * scale];
                // The points of the axis are rounded where it is far from zero.
                let rounding = 1e-13 + 1e3 * f64::EPSILON * origin.abs() / scale;
                assert!(difference(&found, &all(&expected)) < rounding, "{count} {origin} {scale:e} {x}");
            }
        }
    }
    // Values at the end of the range of numbers.
    for size in [f64::from_bits(1), 1e-310, 1e300] {
        let values: Vec<f64> = points(9).into_iter().map(|x| size * f(x)).collect();
        let spline = Spline::new([Axis::new(&points(9))?], &values)?;
        for k in 0..=64 {
            let there: Expansion<1> = spline.expansion([f64::from(k) / 64.0]);
            assert!(all(&there).iter().all(|part| part.is_finite()));
        }
    }
    Ok(())
}

/// On an axis from a million to a million and one, a table of exact values is met to the rounding of the
/// argument.
#[test]
fn accuracy_far_from_zero() -> Outcome {
    let f = |x: f64| (x - 1e6).sin();
    let spline = Spline::sample([Axis::uniform([1e6, 1e6 + 1.0], 1001)?], |[x]| f(x))?;
    let mut numbers = Numbers(9);
    for _ in 0..1000 {
        let x = numbers.between([1e6, 1e6 + 1.0]);
        let there = spline.expansion([x]);
        let (sin, cos) = (x - 1e6).sin_cos();
        assert_abs_diff_eq!(there.value, sin, epsilon = 1e-13);
        assert_abs_diff_eq!(there.gradient[0], cos, epsilon = 1e-9);
        assert_abs_diff_eq!(there.hessian[0][0], -sin, epsilon = 2e-6);
    }
    Ok(())
}

/// Points that are numbers are met exactly, so that a table of hourly values stands at the hours.
#[test]
fn uniform_points_far_from_zero_are_not_rounded_twice() -> Outcome {
    for (from, step) in [(1.7e9, 1.0), (1.7e9, 0.25), (-1.7e9, 0.5)] {
        let axis = Axis::uniform([from, from + 100.0 * step], 101)?;
        assert!((0..101).all(|k| axis.points()[k] == from + step * k as f64), "{from} {step}");
    }
    Ok(())
}

/// In single precision the spline is the same to its rounding.
#[test]
fn single_precision() -> Outcome {
    let [_, periodic, uniform, _] = axes(9)?;
    let spline = Spline::sample([periodic, uniform], smooth)?;
    let mut numbers = Numbers(13);
    for _ in 0..100 {
        let at: [f32; 2] = core::array::from_fn(|_| numbers.between([-1.0, 2.0]) as f32);
        let single: Vec<f64> = all(&spline.expansion(at)).into_iter().map(f64::from).collect();
        let error = difference(&single, &all(&spline.expansion(at.map(f64::from))));
        assert!(error < 1e-5, "{at:?}: {error:e}");
    }
    Ok(())
}
