//! Events that a step may miss.

use core::f64::consts::{PI, TAU};
use dvi_core::prelude::*;
use dvi_tests::{Numbers, Outcome};

/// Free motion, whose steps are exact.
#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0)]
#[derive(Debug)]
struct Free;

/// 1 − cos x dips a little below zero once in each period, or comes as near to it from above: 10⁶ times, at
/// all places within steps of all lengths.
#[test]
fn no_graze_is_missed_and_none_is_made_up() -> Outcome {
    const PERIODS: u32 = 10_000;
    let mut numbers = Numbers(11);
    let mut within = |low: f64, high: f64| low + (high - low) * (1.0 + numbers.next()) / 2.0;
    for k in 0..100 {
        let (h, depth) = (within(0.1, 1.5), 10_f64.powf(within(-14.0, -1.0)));
        let depth = if k % 2 == 0 { depth } else { -depth };
        let start = FreeState { x: -PI - within(0.0, h), dot_x: 1.0 };
        let mut run = Integrator::new(&Free, Variational::trapezoid(), h, start)?;
        let mut events = run.events([Direction::Either], |_, state| [1.0 - depth - state.x.cos()])?;
        let (mut falling, mut count) = (true, 0);
        while let Some(Event { state: FreeState { x, .. }, .. }) =
            events.next_until(TAU * f64::from(PERIODS))?
        {
            // Left and right of the middle of a period.
            let place = x - TAU * (x / TAU).round();
            assert_eq!(place < 0.0, falling, "{x}, h = {h}, depth {depth:e}");
            let off = place.abs() - (1.0 - depth).acos();
            assert!(off.abs() < 1e-8, "{off:e} at {x}, h = {h}, depth {depth:e}");
            (falling, count) = (!falling, count + 1);
        }
        assert_eq!(count, if depth > 0.0 { 2 * PERIODS } else { 0 }, "h = {h}, depth {depth:e}");
    }
    Ok(())
}
