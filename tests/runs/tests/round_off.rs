//! Round-off: what a step leaves over has no direction, and no coordinate pays for the size of another.

use dvi_core::prelude::*;
use dvi_examples::models::{Rotation, RotationState};
use dvi_tests::configurations::quasi_periodic;
use dvi_tests::{Outcome, apart};

/// ½ΣΓ|z|², which σ = ½ conserves but for rounding.
const ANGULAR: usize = 2;

/// The slope of ΣΓ|z|² against the number of the step, by least squares.
fn drift(method: Sigma, h: f64, steps: u64) -> Outcome<f64> {
    let (system, start) = quasi_periodic();
    let mut run = Integrator::new(&system, method, h, start)?;
    let value = |run: &Integrator<&_, Sigma>| 2.0 * run.momentum(ANGULAR).unwrap_or(f64::NAN);
    let initial = value(&run);
    let (samples, mut covariance, mut variance) = (1000, 0.0, 0.0);
    for sample in 0..samples {
        run.take_steps(steps / samples)?;
        let centred = sample as f64 - (samples - 1) as f64 / 2.0;
        covariance += centred * (value(&run) - initial);
        variance += centred * centred;
    }
    Ok(covariance / variance / (steps / samples) as f64)
}

#[test]
fn the_fixed_point_leaves_no_bias() -> Outcome {
    let mean = |tolerance: f64| -> Outcome<f64> {
        let method = Sigma { stopping: Stopping { tolerance, ..Stopping::default() }, ..Sigma::midpoint() };
        let slopes = (0..8).map(|run| drift(method, 0.1 + 0.0003 * f64::from(run), 200_000));
        Ok(slopes.sum::<Result<f64, _>>()? / 8.0)
    };
    // Rounding errors walk at random, by 4e-19 on this average.
    let [exhaustive, predicted] = [mean(1e-17)?, mean(2.3e-16)?];
    assert!(exhaustive.abs() < 1.2e-18, "{exhaustive:e} a step");
    // What stops where a small error is predicted is seen by this test.
    assert!(predicted.abs() > 3e-18, "{predicted:e} a step");
    Ok(())
}

/// x² + y² of an oscillator, which σ = ½ conserves but for rounding: the mean over eight starts of what it
/// has changed by after `n` steps, and the root of the mean square, both relative and in units of εh√n.
fn rounding(h: f64, radius: f64, n: u64) -> Outcome<[f64; 2]> {
    let method = Sigma { summation: Summation::Compensated, ..Sigma::midpoint() };
    let unit = f64::EPSILON * h * (n as f64).sqrt();
    let (mut mean, mut square) = (0.0, 0.0);
    for start in 0..8 {
        let (sin, cos) = (0.2 + 1.1 * f64::from(start)).sin_cos();
        let start = RotationState { x: radius * cos, y: radius * sin };
        let mut run = Integrator::new(&Rotation { omega: 1.0 }, method, h, start)?;
        let initial = run.energy();
        run.take_steps(n)?;
        let error = (run.energy() / initial - 1.0) / unit;
        (mean, square) = (mean + error / 8.0, square + error * error / 8.0);
    }
    Ok([mean, square.sqrt()])
}

#[test]
fn compensated_steps_round_in_no_direction() -> Outcome {
    // Without what rounding of the node leaves out of s the means are 0.4, −1.0 and 2.4.
    for [h, radius] in [[0.1, 1.0], [0.0931, 1.7], [0.12345, 1.3]] {
        let [mean, root] = rounding(h, radius, 1_000_000)?;
        assert!(mean.abs() < 0.35 && root < 0.6, "h = {h}: {mean:.2}, {root:.2}");
    }
    Ok(())
}

/// A nonlinear oscillator (x, y) and, beside it, an angle that winds.
#[dvi_core::degenerate_lagrangian(
    coordinates(x, y, angle, spin),
    one_form    = (x * d(y) - y * d(x) + angle * d(spin) - spin * d(angle)) / 2.0,
    hamiltonian = (x * x + y * y) / 2.0 + x.powi(4) / 4.0 + spin * spin / 2.0,
)]
#[derive(Clone, Debug)]
struct Winding;

fn end<M: Method<Winding, f64>>(method: M, angle: f64) -> Outcome<[f64; 2]> {
    let start = WindingState { x: 1.0, y: 0.3, angle, spin: 1.0 };
    let mut run = Integrator::new(&Winding, method, 0.1, start)?;
    run.take_steps(1000)?;
    Ok([run.q()[0], run.q()[1]])
}

fn compare<M: Method<Winding, f64> + Copy + core::fmt::Debug>(method: M) -> Outcome {
    let [small, large] = [end(method, 0.0)?, end(method, 1e9)?];
    let error = apart(&small, &large);
    assert!(error < 1e-12, "{method:?}: {error:e}");
    Ok(())
}

#[test]
fn a_large_coordinate_does_not_spoil_the_others() -> Outcome {
    for solver in [Solver::Automatic, Solver::FixedPoint, Solver::Newton] {
        compare(Sigma { solver, ..Sigma::midpoint() })?;
    }
    compare(Gauss::<1>::new())?;
    compare(Gauss::<2>::new())
}

/// The same oscillator as a regular system, and a body far away.
#[dvi_core::lagrangian(
    coordinates(x, y, far),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2) + dot(far).powi(2)) / 2.0
        - (x * x + y * y) / 2.0 - x.powi(4) / 4.0 - x * y / 5.0,
)]
#[derive(Clone, Debug)]
struct Distant;

#[test]
fn a_far_body_does_not_spoil_the_others() -> Outcome {
    fn check<M: Method<Distant, f64> + Copy + core::fmt::Debug>(method: M) -> Outcome {
        let end = |far| -> Outcome<[f64; 2]> {
            let start = DistantState { x: 1.0, y: 0.3, far, dot_x: 0.2, dot_y: 0.0, dot_far: 1.0 };
            let mut run = Integrator::new(&Distant, method, 0.1, start)?;
            run.take_steps(1000)?;
            Ok([run.q()[0], run.q()[1]])
        };
        let [near, far] = [end(0.3)?, end(1e9)?];
        let error = apart(&near, &far);
        assert!(error < 2e-12, "{method:?}: {error:e}");
        Ok(())
    }
    for solver in [Solver::Automatic, Solver::FixedPoint, Solver::Newton] {
        check(Variational { solver, ..Variational::midpoint() })?;
        check(Variational { solver, ..Variational::simpson() })?;
        check(Galerkin::<3> { solver, ..Galerkin::new() })?;
        check(Newmark { solver, ..Newmark::new(0.25) })?;
    }
    Ok(())
}
