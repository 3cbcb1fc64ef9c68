//! Events that a step may miss.

use core::f64::consts::{PI, TAU};
use dvi_core::prelude::*;
use dvi_tests::zoo::regular::{FREE, KEPLER, KeplerState, PLANE, PlanarState, SpringState};
use dvi_tests::{Numbers, Outcome};

/// A condition with `depth` dips a little below zero once in each period of x, `half_width` to each side of
/// its middle, or comes as near to it from above: so many periods at all places within steps of all lengths,
/// a hundred times.
fn graze(
    (seed, deepest, periods): (u64, f64, u32),
    condition: impl Fn(f64, f64) -> f64,
    half_width: impl Fn(f64) -> f64,
) -> Outcome {
    let mut numbers = Numbers(seed);
    let mut within = |low: f64, high: f64| low + (high - low) * (1.0 + numbers.next()) / 2.0;
    for k in 0..100 {
        let (h, depth) = (within(0.1, 1.5), 10_f64.powf(within(deepest, -1.0)));
        let depth = if k % 2 == 0 { depth } else { -depth };
        let start = SpringState { x: -PI - within(0.0, h), dot_x: 1.0 };
        let mut run = Integrator::new(&FREE, Variational::trapezoid(), h, start)?;
        let mut events = run.events([Direction::Either], |_, state| [condition(state.x, depth)])?;
        let (mut falling, mut count) = (true, 0);
        while let Some(Event { state: SpringState { x, .. }, .. }) =
            events.next_until(TAU * f64::from(periods))?
        {
            // Left and right of the middle of a period.
            let place = x - TAU * (x / TAU).round();
            assert_eq!(place < 0.0, falling, "{x}, h = {h}, depth {depth:e}");
            let off = place.abs() - half_width(depth);
            assert!(off.abs() < 1e-8, "{off:e} at {x}, h = {h}, depth {depth:e}");
            (falling, count) = (!falling, count + 1);
        }
        assert_eq!(count, if depth > 0.0 { 2 * periods } else { 0 }, "h = {h}, depth {depth:e}");
    }
    Ok(())
}

/// 10⁶ times.
#[test]
fn no_graze_is_missed_and_none_is_made_up() -> Outcome {
    graze((11, -14.0, 10_000), |x, depth| 1.0 - depth - x.cos(), |depth| (1.0 - depth).acos())
}

/// One that is flat in the middle of each period to the fourth order.
#[test]
fn no_flat_graze_is_missed_and_none_is_made_up() -> Outcome {
    let condition = |x: f64, depth| (1.0 - x.cos()).powi(2) - depth;
    graze((13, -8.0, 300), condition, |depth| (1.0 - depth.sqrt()).acos())
}

/// Steps of eight stages over up to 1.4 periods, with several turns in each: every change of sign that is
/// seen between 40 places to the radian of the same steps is an event, and each event is a zero.
#[test]
fn turns_within_long_steps_are_seen() -> Outcome {
    let mut numbers = Numbers(12);
    let mut within = |low: f64, high: f64| low + (high - low) * (1.0 + numbers.next()) / 2.0;
    let (steps, mut count) = (20_u32, 0);
    for _ in 0..200 {
        let (h, level, phase) = (within(0.5, 9.0), within(-1.0, 1.0), within(0.0, TAU));
        let (sin, cos) = phase.sin_cos();
        let start = PlanarState { x: cos, y: sin, dot_x: -sin, dot_y: cos };
        let run = || Integrator::new(&PLANE, Gauss::<8>::new(), h, start);
        let (mut found, mut searched) = (Vec::new(), run()?);
        let mut events = searched.events([Direction::Either], |_, state| [state.x - level])?;
        while events.run().steps() < u64::from(steps) {
            if let Some(Event { time, state, .. }) = events.advance()? {
                assert!((state.x - level).abs() < 1e-13, "{state:?}, h = {h}, level {level}");
                found.push(time);
            }
        }
        let (mut sampled, mut expected, places) = (run()?, Vec::new(), (40.0 * h).ceil());
        let mut states = sampled.dense()?;
        let mut last = [0.0, cos - level];
        for k in 1..(f64::from(steps - 1) * places) as u32 {
            let t = f64::from(k) * h / places;
            let next = [t, states.state_at(t)?.x - level];
            if (last[1] < 0.0) != (next[1] < 0.0) {
                expected.push([last[0], next[0]]);
            }
            last = next;
        }
        for &[before, after] in &expected {
            let is_seen = found.iter().any(|t| (before..=after).contains(t));
            assert!(is_seen, "between {before} and {after}, h = {h}, level {level}, phase {phase}");
        }
        count += expected.len();
    }
    // Twenty steps of 4.75 on average are fifteen periods, with two in each.
    assert!((4000..8000).contains(&count), "{count}");
    Ok(())
}

/// g is flat at most of the points, and steep where it crosses.
#[test]
fn a_condition_that_is_flat_before_is_not_missed() -> Outcome {
    let start = KeplerState { x: 0.5, y: 0.0, dot_x: 0.0, dot_y: 3.0_f64.sqrt() };
    for h in [0.1, 0.2, 0.3, 0.4] {
        let mut run = Integrator::new(&KEPLER, Gauss::<8>::new(), h, start)?;
        run.take_steps((1.5 / h) as u64)?;
        let flat = |_, state: &KeplerState| [state.x.hypot(state.y).powi(-6) - 55.0];
        let mut events = run.events([Direction::Rising], flat)?;
        let mut count = 0;
        while events.next_until(800.0 * PI + 3.0)?.is_some() {
            count += 1;
        }
        assert_eq!(count, 400, "{h}");
    }
    Ok(())
}
