//! Forces that push away from a seam: the equations of a step that leads there have a solution on either
//! side of it, and only one of them is on the motion.

use approx::assert_abs_diff_eq;
use dvi_core::methods::VariableStep;
use dvi_core::prelude::*;
use dvi_tests::Outcome;

/// A force that pushes away from a place, and another one from a time on.
#[lagrangian(
    coordinates(x),
    lagrangian = dot(x).powi(2) / 2.0 + push * x.abs(),
    force(x) = if t > on { -kick } else { 0.0 },
)]
#[derive(Debug)]
struct Ridge {
    push: f64,
    on: f64,
    kick: f64,
}

/// Where parts of a motion begin: the time, the place, the velocity and the acceleration.
type Parabolas = Vec<[f64; 4]>;

impl Ridge {
    /// The motion from x = 1 up to time `end`. None that nearly turns at the ridge, where a digit decides on
    /// which side it goes on.
    fn parabolas(&self, velocity: f64, end: f64) -> Option<Parabolas> {
        let ([mut t, mut x, mut v, mut side], mut parabolas) = ([0.0, 1.0, velocity, 1.0], Vec::new());
        while t < end {
            let is_on = t >= self.on;
            let a = self.push * side - if is_on { self.kick } else { 0.0 };
            parabolas.push([t, x, v, a]);
            let left = if is_on { end - t } else { self.on - t };
            // x + vτ + aτ²/2 = 0 for a τ > 0 at which it goes to the other side.
            let at_ridge = v * v - 2.0 * a * x;
            let speed = at_ridge.abs().sqrt();
            let to_ridge = (-side * speed - v) / a;
            if at_ridge > 0.0 && to_ridge > 0.0 && to_ridge < left {
                (t, x, v, side) = (t + to_ridge, 0.0, -side * speed, -side);
            } else {
                (t, x, v) = (t + left, x + left * (v + a * left / 2.0), v + a * left);
            }
            if speed < 0.05 {
                return None;
            }
        }
        Some(parabolas)
    }
}

fn at(parabolas: &Parabolas, t: f64) -> f64 {
    let began = parabolas.iter().rev().find(|[begin, ..]| *begin <= t);
    let &[begin, x, v, a] = began.unwrap_or(&parabolas[0]);
    x + (t - begin) * (v + a * (t - begin) / 2.0)
}

/// Steps end on the motion, and so do parts of them.
fn check<M: VariableStep<Ridge, f64>>(method: M, tolerance: f64, ridge: &Ridge, velocity: f64) -> Outcome {
    let end = 3.0;
    let Some(parabolas) = ridge.parabolas(velocity, 4.0 * end) else { return Ok(()) };
    let start = RidgeState { x: 1.0, dot_x: velocity };
    let mut run = Integrator::controlled(ridge, method, ErrorControl::new(tolerance, 0.1), start)?;
    let mut dense = run.dense()?;
    while dense.time() < end {
        let begun = dense.time();
        dense.advance()?;
        for part in [0.5, 0.7, 0.85, 1.0] {
            let t = if part < 1.0 { begun + part * (dense.time() - begun) } else { dense.time() };
            let (x, exact) = (dense.state_at(t)?.x, at(&parabolas, t));
            assert!(
                (x - exact).abs() < 30.0 * tolerance,
                "{ridge:?} from {velocity} at {t}: {x} for {exact}"
            );
        }
    }
    Ok(())
}

#[test]
fn a_ridge_is_crossed_and_left_on_the_other_side() -> Outcome {
    // In that of number 152 parts of a step have been off the motion, and in the last one a step that goes
    // over the ridge and back before the force changes.
    for k in (0..200).chain([4478]) {
        // Numbers that fill a cube evenly: the fractional parts of multiples.
        let [a, b, c, d] = [0.8566748838545, 0.7338918566271, 0.6287067210378, 0.5385972572236]
            .map(|irrational| (0.5 + f64::from(k) * irrational).fract());
        let ridge = Ridge { push: 0.2 + 1.8 * a, on: 0.8 + 0.8 * b, kick: 2.0 * c - 1.0 };
        let velocity = -(2.0 * ridge.push).sqrt() * (0.9 + 0.3 * d);
        check(Gauss::<2>::new(), [1e-6, 1e-9, 1e-12][k as usize % 3], &ridge, velocity)?;
    }
    Ok(())
}

/// An oscillator with dry friction, and a force from a time on.
#[lagrangian(
    coordinates(x),
    lagrangian = (dot(x).powi(2) - x * x) / 2.0,
    force(x) = -friction * dot(x).signum() - 0.1 * dot(x).abs() * dot(x) + if t > on { 0.5 } else { 0.0 },
)]
struct Tide {
    friction: f64,
    on: f64,
}

#[test]
fn what_friction_pushes_away_from_rest_comes_back() -> Outcome {
    // Back in time dry friction pushes away from rest; the force of the tide changes just before.
    let sliding = Tide { friction: 0.2, on: 3.3 };
    let control = ErrorControl::new(1e-10, 0.1);
    let start = TideState { x: 1.0, dot_x: 0.0 };
    let mut there = Integrator::controlled(&sliding, Gauss::<4>::new(), control, start)?;
    there.advance_to(5.0)?;
    let control = ErrorControl::new(1e-10, -0.1);
    let mut back = Integrator::controlled_at(&sliding, Gauss::<4>::new(), control, 5.0, there.state())?;
    back.advance_to(0.0)?;
    assert_abs_diff_eq!(back.state().x, 1.0, epsilon = 1e-9);
    assert_abs_diff_eq!(back.state().dot_x, 0.0, epsilon = 1e-9);
    Ok(())
}
