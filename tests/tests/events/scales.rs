//! Events where the time or the numbers have few digits for a step, and behind conditions without bound.

use approx::assert_abs_diff_eq;
use core::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use dvi_core::Real;
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::zoo::regular::{FREE, SPRING, SpringStateOf};
use num_dual::Dual64;

use super::edges::{Ball, BallState};

/// How many of 40 pairs of crossings are met of which each lies within one step at the top of x = sin t.
fn pairs_met<T: Real>(t0: f64, h: f64) -> Outcome<usize> {
    let mut met = 0;
    for i in 0..40 {
        let [phase, width] = [0.618_034, 0.754_878].map(|irrational| (irrational * f64::from(i)).fract());
        let level = T::lift((h * (0.3 + 0.4 * width) / 2.0).cos());
        let start = SpringStateOf { x: T::lift(phase.sin()), dot_x: T::lift(phase.cos()) };
        let mut run = Integrator::new_at(&SPRING, Gauss::<4>::new(), T::lift(t0), T::lift(h), start)?;
        let mut events = run.events([Direction::Either], |_, state| [state.x - level])?;
        while events.next_until(T::lift(t0 + 3.0))?.is_some() {
            met += 1;
        }
    }
    Ok(met)
}

/// Of a time of 1.7e9, as that of Unix in seconds, a step of 0.01 has 42 000 roundings.
#[test]
fn pairs_within_a_step_are_met() -> Outcome {
    for (t0, h) in [(0.0, 0.01), (1.7e9, 0.01), (1.7e9, 0.05), (-1e12, 0.1)] {
        assert_eq!(pairs_met::<f64>(t0, h)?, 80, "{t0:e}, {h}");
    }
    for h in [0.1, 0.2] {
        assert_eq!(pairs_met::<f32>(0.0, h)?, 80, "{h}");
    }
    Ok(())
}

/// A ball that hops, by its user, in some thousand roundings of the time.
#[test]
fn a_floor_is_met_at_late_times() -> Outcome {
    for (t0, rounding) in [(0.0, 2.4e-7), (1.7e9, 2.4e-7), (1e12, 1.2e-4)] {
        for (roundings, steps) in [(1000.0, 20.0), (2000.0, 20.0), (4000.0, 0.7), (64_000.0, 0.7)] {
            let hop: f64 = rounding * roundings;
            let up = BallState { y: 0.0, dot_y: hop / 2.0 };
            let mut run = Integrator::new_at(&Ball, Variational::trapezoid(), t0, hop / steps, up)?;
            let mut events = run.events([Direction::Falling], |_, ball| [ball.y])?;
            for k in 1..=20 {
                let Event { time, .. } = events.next_until(t0 + 21.0 * hop)?.ok_or("it falls through")?;
                assert_abs_diff_eq!(time, t0 + f64::from(k) * hop, epsilon = 20.0 * rounding);
                events.set_state(time, up)?;
            }
        }
    }
    Ok(())
}

/// A channel between two walls.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    impact = [y, 2.0 - y],
)]
struct Channel;

/// tan x is 1.6e16 at the start, and 1/x is infinite or 1.6e16.
#[test]
fn what_has_been_without_bound_is_no_event_later() -> Outcome {
    let start = ChannelState { x: FRAC_PI_2, y: 1.0, dot_x: -0.2, dot_y: 1.3 };
    let mut run = Integrator::new(&Channel, Impacts::reflecting(Variational::trapezoid()), 0.05, start)?;
    let mut events = run.events([Direction::Falling], |_, state| [state.x.tan() - 1.0])?;
    let met = events.next_until(10.0)?.ok_or("it is met")?;
    assert_abs_diff_eq!(met.time, FRAC_PI_4 / 0.2, epsilon = 1e-12);
    assert!(events.next_until(10.0)?.is_none());

    for x in [0.0, FRAC_PI_2.cos()] {
        let start = SpringStateOf { x: Dual64::from(x), dot_x: Dual64::from(1.0).derivative() };
        let mut run = Integrator::new(&FREE, Gauss::<2>::new(), Dual64::from(0.07), start)?;
        let mut events = run.events([Direction::Either], |_, state| [Dual64::from(1.0) / state.x - 0.4])?;
        let met = events.next_until(Dual64::from(5.0))?.ok_or("it is met")?;
        assert_abs_diff_eq!(met.time.re, 2.5, epsilon = 1e-12);
        assert_abs_diff_eq!(met.time.eps, -2.5, epsilon = 1e-11);
        assert!(events.next_until(Dual64::from(5.0))?.is_none());
    }
    Ok(())
}
