//! Steps where a motion is beyond a seam for less than a step, or touches it, and many seams in a step.

use approx::assert_abs_diff_eq;
use core::f64::consts::PI;
use dvi_core::prelude::*;

use super::{Outcome, apart};

/// A stone below a stiff wall.
#[lagrangian(
    coordinates(x),
    lagrangian = dot(x).powi(2) / 2.0 - x / 2.0 - 1e6 * x.max(0.0),
)]
struct Walled;

/// An oscillator with a second force beyond x = 1.
#[lagrangian(
    coordinates(x),
    lagrangian = (dot(x).powi(2) - x * x) / 2.0 - (x - 1.0).max(0.0),
)]
struct Reaching;

#[test]
fn a_seam_that_is_crossed_twice_within_a_step_is_found() -> Outcome {
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let control = ErrorControl::new(tolerance, 0.01);
        // Up to the wall with v = √(v₀² + x₀), back from it at once, and down.
        let start = WalledState { x: -3.99688, dot_x: 2.0 };
        let mut run = Integrator::controlled(&Walled, Gauss::<4>::new(), control, start)?;
        run.advance_to(4.89)?;
        let at_wall = (4.0 + start.x).sqrt();
        let since = 4.89 - 2.0 * (2.0 - at_wall) - 2.0 * at_wall / (1e6 + 0.5);
        let exact = -at_wall * since - since * since / 4.0;
        assert_abs_diff_eq!(run.state().x, exact, epsilon = 30.0 * tolerance);

        // Beyond x = 1 it swings about −1: on the ellipse through (1, v) until it comes back with −v, which
        // is 2 arctan(v/2) later and not 2 arctan(v).
        let (velocity, end) = (1.000_001_f64, 3.0);
        let start = ReachingState { x: 0.0, dot_x: velocity };
        let mut run = Integrator::controlled(&Reaching, Gauss::<8>::new(), control, start)?;
        run.advance_to(end)?;
        let at_seam = (velocity * velocity - 1.0).sqrt();
        let since = end - (1.0 / velocity).asin() - 2.0 * (at_seam / 2.0).atan();
        let exact = since.cos() - at_seam * since.sin();
        assert_abs_diff_eq!(run.state().x, exact, epsilon = 30.0 * tolerance.max(1e-11));
    }
    Ok(())
}

/// A force that is greater beyond x = 0 and leads back from there.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2) - y * y) / 2.0 + x - x.abs() / 2.0 - y.abs(),
)]
struct Touching;

/// A motion that comes to one seam and turns there, all along another one that does not push it away.
#[test]
fn seams_that_are_touched_are_no_obstacle() -> Outcome {
    for above in [0.0, 1e-16, 1e-14, 1e-11, 1e-8, 1e-5] {
        let start = TouchingState { x: 0.25 + above, y: 0.0, dot_x: -0.5, dot_y: 0.0 };
        for tolerance in [1e-6, 1e-9, 1e-12] {
            for first_step in [0.01, 0.9, 1.0] {
                let control = ErrorControl::new(tolerance, first_step);
                let mut run = Integrator::controlled(&Touching, Gauss::<8>::new(), control, start)?;
                run.advance_to(2.0)?;
                // To the height above and back again.
                assert_abs_diff_eq!(run.state().x, start.x, epsilon = tolerance);
                assert_eq!((run.state().y, run.state().dot_y), (0.0, 0.0));
                assert!(run.steps() + run.statistics().rejected < 20, "{above:e}: {:?}", run.statistics());
            }
        }
    }
    Ok(())
}

/// A force that changes its side a thousand times within a step is no motion that does not leave a seam.
#[test]
fn many_seams_in_a_step_are_met_one_by_one() -> Outcome {
    #[lagrangian(
        coordinates(x),
        lagrangian = dot(x).powi(2) / 2.0,
        force(x) = if (1000.0 * t).sin() > 0.0 { 1.0 } else { -1.0 },
    )]
    struct Shaken;
    let control = ErrorControl::new(1e-9, 0.01);
    let start = ShakenState { x: 0.0, dot_x: 0.0 };
    let mut run = Integrator::controlled(&Shaken, Gauss::<4>::new(), control, start)?;
    // Whole periods, in each of which it moves by the square of a half.
    let half = PI / 1000.0;
    run.advance_to(100.0 * half)?;
    let error = apart(run.q(), &[50.0 * half * half]);
    assert!(error < 1e-9, "{error:e}");
    Ok(())
}
