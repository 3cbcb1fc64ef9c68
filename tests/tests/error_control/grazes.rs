//! Steps where a motion is beyond a seam for less than a step, and where it stays on one.

use approx::assert_abs_diff_eq;
use dvi_core::methods::VariableStep;
use dvi_core::prelude::*;

use super::Outcome;

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
        let mut run = ControlledIntegrator::new(&Walled, Gauss::<4>::new(), control, start)?;
        run.advance_to(4.89)?;
        let at_wall = (4.0 + start.x).sqrt();
        let since = 4.89 - 2.0 * (2.0 - at_wall) - 2.0 * at_wall / (1e6 + 0.5);
        let exact = -at_wall * since - since * since / 4.0;
        assert_abs_diff_eq!(run.state().x, exact, epsilon = 30.0 * tolerance);

        // Beyond x = 1 it swings about −1: on the ellipse through (1, v) until it comes back with −v, which
        // is 2 arctan(v/2) later and not 2 arctan(v).
        let (velocity, end) = (1.000_001_f64, 3.0);
        let start = ReachingState { x: 0.0, dot_x: velocity };
        let mut run = ControlledIntegrator::new(&Reaching, Gauss::<8>::new(), control, start)?;
        run.advance_to(end)?;
        let at_seam = (velocity * velocity - 1.0).sqrt();
        let since = end - (1.0 / velocity).asin() - 2.0 * (at_seam / 2.0).atan();
        let exact = since.cos() - at_seam * since.sin();
        assert_abs_diff_eq!(run.state().x, exact, epsilon = 30.0 * tolerance.max(1e-11));
    }
    Ok(())
}

/// A motion over |x| that meets its seam hundreds of times: late by rounding of the time each time, it would
/// gain 10⁻⁷ of its place.
#[test]
fn seams_give_a_long_motion_no_energy() -> Outcome {
    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - x.abs())]
    struct Wedge;
    let start = WedgeState { x: 1.0, dot_x: 0.0 };
    let control = ErrorControl::new(1e-9, 0.01);
    let mut run = ControlledIntegrator::new(&Wedge, Gauss::<4>::new(), control, start)?;
    run.advance_to(1000.0)?;
    // A quarter of a period is √2: parabolas, one down and one up.
    let quarter = 2.0_f64.sqrt();
    let part = 1000.0 % (4.0 * quarter);
    let parabola = |s: f64| 1.0 - s * s / 2.0;
    let exact = if part < quarter {
        parabola(part)
    } else if part < 3.0 * quarter {
        -parabola(part - 2.0 * quarter)
    } else {
        parabola(part - 4.0 * quarter)
    };
    assert_abs_diff_eq!(run.state().x, exact, epsilon = 1e-8);
    Ok(())
}

/// A force that pushes the velocity to ½ from both sides.
#[lagrangian(
    coordinates(x),
    lagrangian = dot(x).powi(2) / 2.0,
    force(x) = if dot(x) > 0.5 { -1.0 } else { 0.5 },
)]
struct Pushing;

#[test]
fn a_motion_along_a_seam_ends_soon() -> Outcome {
    fn check(method: impl VariableStep<Pushing, f64>, tolerance: f64) -> Outcome {
        let start = PushingState { x: 0.0, dot_x: 0.0 };
        let control = ErrorControl::new(tolerance, 0.01);
        let mut run = ControlledIntegrator::new(&Pushing, method, control, start)?;
        let failure = (0..300).find_map(|_| run.advance().err()).map(|error| error.failure);
        assert!(matches!(failure, Some(StepFailure::Seam { seam: 0, .. })), "{failure:?}");
        assert_abs_diff_eq!(run.time(), 1.0, epsilon = 100.0 * tolerance);
        Ok(())
    }
    for tolerance in [1e-3, 1e-6, 1e-9, 1e-12] {
        check(Gauss::<4>::new(), tolerance)?;
        check(Gauss::<8>::new(), tolerance)?;
    }
    Ok(())
}
