//! Events that steps may miss or count twice, and how a search for events, or for a state at a time, ends.

use approx::{abs_diff_eq, assert_abs_diff_eq};
use core::f64::consts::{FRAC_PI_2, FRAC_PI_3, PI};
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::zoo::regular::{FREE, Kepler, KeplerState, PLANE, PlanarState, SPRING, Spring, SpringState};
use num_dual::Dual64;

use super::PLANAR;

#[lagrangian(coordinates(y), lagrangian = dot(y).powi(2) / 2.0 - y)]
pub(super) struct Ball;

/// From `x` with velocity one, by steps that are exact.
fn free(x: f64, h: f64) -> Outcome<impl Run<System = Spring, Scalar = f64>> {
    Ok(Integrator::new(&FREE, Variational::trapezoid(), h, SpringState { x, dot_x: 1.0 })?)
}

#[test]
fn events_at_the_ends_of_steps_count_once() -> Outcome {
    let mut run = free(-0.5, 0.25)?;
    let falls_and_rises = |x: f64| x * (x - 0.1);
    let mut events = run
        .events([Direction::Either, Direction::Falling, Direction::Rising], |_, state| {
            [state.x, falls_and_rises(state.x), falls_and_rises(state.x)]
        })?;
    let mut found = Vec::new();
    while let Some(Event { index, time, .. }) = events.next_until(2.0)? {
        found.push((index, time));
    }
    // At one time in the order of the conditions.
    assert_eq!(found[..2], [(0, 0.5), (1, 0.5)]);
    let [(2, last)] = found[2..] else { panic!("{found:?}") };
    assert_abs_diff_eq!(last, 0.6, epsilon = 1e-15);
    Ok(())
}

/// A zero at the end of a step, or beside it by rounding, hides none within the step, and has the direction
/// that the run comes from.
#[test]
fn a_zero_at_the_end_of_a_step_hides_no_other() -> Outcome {
    let beside = [0.25_f64.next_down(), 0.25_f64.next_up()];
    let at_ends = [(0.1, 0.25), (-0.25, 0.0), (0.6, 1.0), (0.99, 1.0), (0.1, beside[0]), (0.1, beside[1])];
    for (first, last) in at_ends.into_iter().chain([(0.4, 0.4), (0.1, 0.15)]) {
        for sign in [1.0, -1.0] {
            let zeros = |x: f64| sign * (x - first) * (x - last);
            let mut run = free(-0.5, 0.25)?;
            let mut events = run.events([Direction::Rising, Direction::Falling], |_, s| [zeros(s.x); 2])?;
            let mut found = Vec::new();
            while let Some(Event { index, time, .. }) = events.next_until(3.0)? {
                found.push((index, time));
            }
            let [outwards, inwards] = if sign > 0.0 { [1, 0] } else { [0, 1] };
            let expected = [(outwards, first + 0.5), (inwards, last + 0.5)];
            let expected = if first < last { &expected[..] } else { &[] };
            assert_eq!(found.len(), expected.len(), "{first} {last}: {found:?}");
            for (found, expected) in found.iter().zip(expected) {
                assert!(
                    found.0 == expected.0 && (found.1 - expected.1).abs() < 1e-13,
                    "{first} {last}: {found:?}"
                );
            }
        }
    }
    Ok(())
}

/// A run that begins with g = 0 has no event there, and one that follows in the same step is seen.
#[test]
fn a_start_on_a_zero_is_no_event() -> Outcome {
    for (h, x) in [(0.25, 0.0), (-0.25, 0.1)] {
        let mut run = free(x, h)?;
        let mut events = run.events([Direction::Either], |_, state| [state.x * (state.x - 0.1)])?;
        let Some(Event { time, state, .. }) = events.next_until(2.0 * h)? else { panic!("none") };
        assert_abs_diff_eq!(time, 0.1 * h.signum(), epsilon = 1e-15);
        assert!(abs_diff_eq!(state.x, 0.1 - x, epsilon = 1e-15), "{state:?}");
        assert!(events.next_until(2.0 * h)?.is_none());
    }
    Ok(())
}

#[test]
fn directions_are_along_a_run_back_in_time() -> Outcome {
    let mut run = Integrator::new(&PLANE, Gauss::<8>::new(), -0.3, PLANAR)?;
    let conditions = [Direction::Falling, Direction::Rising];
    for (k, event) in run.events(conditions, |_, state| [state.x; 2])?.take(6).enumerate() {
        let Event { index, time, .. } = event?;
        assert_eq!(index, k % 2);
        let exact = -FRAC_PI_2 - PI * k as f64;
        assert_abs_diff_eq!(time, exact, epsilon = 1e-11);
    }
    Ok(())
}

/// A fall into the centre.
#[test]
fn events_before_a_failed_step_are_handed_out() -> Outcome {
    let start = KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.0 };
    let control = ErrorControl::new(1e-9, 0.1);
    let mut run = Integrator::controlled(&Kepler { mu: 1.0 }, Gauss::<8>::new(), control, start)?;
    let levels = [0.9, 0.5, 0.01, 1e-5_f64];
    let mut events = run.events([Direction::Falling; 4], |_, state| levels.map(|level| state.x - level))?;
    for (index, level) in levels.into_iter().enumerate() {
        let event = events.next().ok_or("ended")??;
        assert_eq!(event.index, index);
        // t = √(x (1 − x) / 2) + arccos(√x)/√2
        let exact = (level * (1.0 - level) / 2.0).sqrt() + level.sqrt().acos() / 2_f64.sqrt();
        assert!(abs_diff_eq!(event.time, exact, epsilon = 1e-6), "{level}: {} {exact}", event.time);
    }
    assert!(matches!(events.next(), Some(Err(StepError { .. }))));
    assert!(events.next().is_none());
    Ok(())
}

#[test]
fn a_condition_that_is_no_number_is_an_error() -> Outcome {
    let mut run = free(1.0, -0.25)?;
    let mut events = run.events([Direction::Either; 2], |_, state| [1.0, state.x.sqrt() - 2.0])?;
    let Err(error) = events.next_until(-2.0) else { panic!("a root of what is negative") };
    assert!(matches!(error, StepError { step: 4, failure: StepFailure::UndefinedEvent { event: 1 }, .. }));
    // Until another state is set.
    assert_eq!(events.next_until(-2.0).err(), Some(error));
    events.set_state(0.0, SpringState { x: 9.1, dot_x: 1.0 })?;
    let Some(Event { index: 1, time, .. }) = events.next_until(-6.0)? else { panic!("none") };
    assert_abs_diff_eq!(time, -5.1, epsilon = 1e-13);
    // Set where a condition is none, the run is there, and no events are known.
    assert!(events.set_state(1.0, SpringState { x: -1.0, dot_x: 1.0 }).is_err());
    assert_eq!((events.run().time(), events.run().q()[0]), (1.0, -1.0));
    assert!(matches!(
        events.next_until(-6.0).err(),
        Some(StepError { failure: StepFailure::UndefinedEvent { event: 1 }, .. })
    ));
    let mut run = free(-1.0, 0.25)?;
    let undefined = run.events([Direction::Either], |_, state| [state.x.sqrt()]);
    assert!(matches!(undefined.err(), Some(StartError::Starter(StepFailure::UndefinedEvent { event: 0 }))));
    Ok(())
}

#[test]
fn times_that_are_not_ahead_are_errors_with_both_times() -> Outcome {
    fn check<R: Run<Scalar = f64>>(mut run: R, sign: f64) -> Outcome {
        let mut dense = run.dense()?;
        dense.advance_to(1.03 * sign)?;
        let steps = dense.steps();
        let begun = dense.time() - dense.step_size();
        dense.state_at(1.03 * sign)?;
        for target in [begun - 1e-9 * sign, -3.0 * sign, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for error in [dense.state_at(target).err(), dense.advance_to(target).err()] {
                let Some(StepFailure::Unreachable { now, target: named }) = error.map(|error| error.failure)
                else {
                    panic!("{target}: {error:?}")
                };
                assert_abs_diff_eq!(now, begun, epsilon = 1e-12);
                assert_eq!(named.to_bits(), target.to_bits());
            }
        }
        assert_eq!(dense.steps(), steps);
        let behind = begun - 1e-9 * sign;
        let refused = run.events([Direction::Either], |_, _| [1.0])?.next_until(behind).err();
        assert!(matches!(refused, Some(StepError { failure: StepFailure::Unreachable { .. }, .. })));
        // It may have passed a time by rounding.
        let now = run.time();
        run.dense()?.state_at(now * (1.0 - f64::EPSILON))?;
        Ok(())
    }
    let method = Gauss::<4>::new();
    for sign in [1.0, -1.0] {
        check(Integrator::new(&PLANE, method, 0.1 * sign, PLANAR)?, sign)?;
        let control = ErrorControl::new(1e-9, 0.1 * sign);
        check(Integrator::controlled(&PLANE, method, control, PLANAR)?, sign)?;
    }
    Ok(())
}

/// A condition that comes to zero and stays there is an event where it comes, and is none where it leaves.
#[test]
fn a_condition_may_stay_at_zero() -> Outcome {
    for x in [-1.03, -0.9, -0.5] {
        let mut run = free(x, 0.1)?;
        let mut events = run.events([Direction::Either], |_, state| [state.x.min(0.0)])?;
        let Some(Event { time, .. }) = events.next_until(2.0)? else { panic!("none") };
        assert_abs_diff_eq!(time, -x, epsilon = 1e-14);
        assert!(events.next_until(2.0)?.is_none());
        let mut run = free(x, 0.1)?;
        let mut leaves = run.events([Direction::Either], |_, state| [state.x.max(0.0)])?;
        assert!(leaves.next_until(2.0)?.is_none());
    }
    Ok(())
}

/// Of an oscillator cos t, a condition that is zero in a band about the middle comes there from above and
/// from below, once each in a period.
#[test]
fn a_condition_with_a_band_of_zeros_comes_there_once() -> Outcome {
    let band = |x: f64| if x > 0.5 { x - 0.5 } else { (x + 0.5).min(0.0) };
    for power in [1, 2, 3] {
        let mut run = Integrator::new(&PLANE, Gauss::<4>::new(), 0.1, PLANAR)?;
        let mut events = run.events([Direction::Either], |_, state| [band(state.x).powi(power)])?;
        for turn in [1.0, 4.0, 7.0, 10.0] {
            let Some(Event { time, state, .. }) = events.next_until(12.0)? else { panic!("none at {turn}") };
            assert!(abs_diff_eq!(time, turn * FRAC_PI_3, epsilon = 1e-11), "{power}, {turn}: {time}");
            events.set_state(time, state)?;
        }
        assert!(events.next_until(12.0)?.is_none());
    }
    Ok(())
}

/// What is asked for up to a time is not after it, and comes later.
#[test]
fn events_after_the_end_wait() -> Outcome {
    let mut run = free(-0.3, 0.4)?;
    let mut events = run.events([Direction::Rising], |_, state| [state.x])?;
    assert!(events.next_until(0.25)?.is_none());
    let Some(Event { time, .. }) = events.next_until(0.35)? else { panic!("none") };
    assert_abs_diff_eq!(time, 0.3, epsilon = 1e-15);
    Ok(())
}

/// One zero, as three conditions, in whatever order rounding finds them.
#[test]
fn events_at_one_time_come_in_the_order_of_the_conditions() -> Outcome {
    for k in (0..200).step_by(4) {
        let mut run = Integrator::new(&PLANE, Gauss::<8>::new(), 0.1 + 0.003 * f64::from(k), PLANAR)?;
        let conditions = |_, state: &PlanarState| [state.x, 3.0 * state.x, (2.0 * state.x).exp() - 1.0];
        let events = run.events([Direction::Either; 3], conditions)?.take(6);
        let order = events.map(|event| Ok(event?.index)).collect::<Outcome<Vec<_>>>()?;
        assert_eq!(order, [0, 1, 2, 0, 1, 2], "{k}");
    }
    Ok(())
}

/// The time of a fall from y to the floor, √(2y), at the end of a step and within one: its derivative is
/// 1/√(2y).
#[test]
fn times_of_events_carry_derivatives() -> Outcome {
    for h in [1.0, 0.5, 0.25, 0.2, 0.1, 0.07, 0.05, 0.04] {
        let start = BallStateOf { y: Dual64::from(0.5).derivative(), dot_y: Dual64::from(0.0) };
        let mut run = Integrator::new(&Ball, Variational::trapezoid(), Dual64::from(h), start)?;
        let mut events = run.events([Direction::Falling], |_, state| [state.y])?;
        let Some(event) = events.next_until(Dual64::from(1.5))? else { panic!("none") };
        assert!(abs_diff_eq!(event.time.eps, 1.0, epsilon = 1e-7), "{h}: {}", event.time);
        assert!(abs_diff_eq!(event.state.y.eps, 0.0, epsilon = 1e-7), "{h}: {:?}", event.state);
        // A time that is varied, at a point of the run and between two.
        let fixed = BallStateOf { y: Dual64::from(0.5), dot_y: Dual64::from(0.0) };
        let mut run = Integrator::new(&Ball, Variational::trapezoid(), Dual64::from(h), fixed)?;
        let mut dense = run.dense()?;
        for t in [2.0 * h, 2.3 * h] {
            let state = dense.state_at(Dual64::from(t).derivative())?;
            assert!(abs_diff_eq!(state.y.eps, -t, epsilon = 1e-12), "{h}: {state:?}");
        }
    }
    Ok(())
}

#[test]
fn a_limit_of_the_energy_hides_no_stages() -> Outcome {
    let start = SpringState { x: 1.0, dot_x: 0.0 };
    let method = EnergyLimit { method: Gauss::<8>::new(), limit: 1.0 };
    let mut run = Integrator::new(&SPRING, method, 4.5, start)?;
    let mut events = run.events([Direction::Either], |_, spring| [spring.x - 0.9])?;
    let mut found = 0;
    while events.next_until(40.0)?.is_some() {
        found += 1;
    }
    // cos t = 0.9 at t = 0.45, and at as much before and behind six periods.
    assert_eq!(found, 13);
    Ok(())
}
