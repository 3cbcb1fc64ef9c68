//! Events of steps in which a velocity jumps.

use approx::assert_abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use num_dual::{Dual64, DualNum};

/// A ball above a floor.
#[lagrangian(coordinates(y), lagrangian = dot(y).powi(2) / 2.0 - y, impact = y)]
struct Ball;

/// Steps of these methods are exact in free fall.
fn method() -> Impacts<Variational<Unfitted, Trapezoid>> {
    Impacts::reflecting(Variational::trapezoid())
}

#[test]
fn a_level_near_the_floor_is_met_on_the_way_down_and_up() -> Outcome {
    for k in 0..300 {
        // Numbers that fill a cube evenly: the fractional parts of multiples.
        let [a, b, c] = [0.8191725133961, 0.6710436067038, 0.5497004779019]
            .map(|irrational| (0.5 + f64::from(k) * irrational).fract());
        let (h, y, dot_y) = (0.02 + 0.28 * a, 0.8 + 0.7 * b, c - 0.5);
        let speed = (dot_y * dot_y + 2.0 * y).sqrt();
        for level in [1e-6, 1e-4, 1e-2] {
            let there = (speed * speed - 2.0 * level).sqrt();
            let mut run = Integrator::new(&Ball, method(), h, BallState { y, dot_y })?;
            let mut events = run.events([Direction::Either], |_, ball| [ball.y - level])?;
            for exact in [dot_y + there, dot_y + 2.0 * speed - there] {
                let event = events.next_until(dot_y + 2.0 * speed)?;
                let Event { time, .. } = event.ok_or(format!("h = {h}, from {y}, {dot_y} to {level}"))?;
                assert_abs_diff_eq!(time, exact, epsilon = 1e-9);
            }
        }
    }
    Ok(())
}

/// By the height of the start: of the time of the impact and of the state behind it, and of the time at
/// which a level is met behind the impact, in the same step or another.
#[test]
fn times_of_jumps_carry_derivatives() -> Outcome {
    let (y, dot_y) = (Dual64::from(1.2753).derivative(), Dual64::from(-0.2));
    let speed = (dot_y * dot_y + y * 2.0).sqrt();
    for h in [0.02, 0.176, 0.5, 1.1] {
        let start = BallStateOf::<Dual64> { y, dot_y };
        let mut run = Integrator::new(&Ball, method(), Dual64::from(h), start)?;
        let mut events = run.events([Direction::Rising], |_, ball| [ball.dot_y])?;
        let Event { time, state, .. } = events.next_until(Dual64::from(3.0))?.ok_or("it bounces")?;
        for (found, exact) in [(time, dot_y + speed), (state.dot_y, speed), (state.y, Dual64::from(0.0))] {
            assert_abs_diff_eq!(found.re, exact.re, epsilon = 1e-12);
            assert_abs_diff_eq!(found.eps, exact.eps, epsilon = 1e-12);
        }
        for level in [0.01, 0.125, 0.5] {
            let mut run = Integrator::new(&Ball, method(), Dual64::from(h), start)?;
            let mut events = run.events([Direction::Rising], |_, ball| [ball.y - level])?;
            let Event { time, .. } = events.next_until(Dual64::from(3.0))?.ok_or("it bounces")?;
            let exact = dot_y + speed * 2.0 - (speed * speed - level * 2.0).sqrt();
            assert_abs_diff_eq!(time.re, exact.re, epsilon = 1e-12);
            assert_abs_diff_eq!(time.eps, exact.eps, epsilon = 1e-10);
        }
    }
    Ok(())
}
