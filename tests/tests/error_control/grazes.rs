//! Steps where a motion is beyond a seam for less than a step.

use approx::assert_abs_diff_eq;
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
