//! Runs that go on from another state, at an event or anywhere.

use approx::abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::zoo::regular::{PLANE, Planar, PlanarState};
use dvi_tests::{Outcome, bits};

use super::PLANAR;
use super::edges::{Ball, BallState};
use crate::error_control::seams::{Well, WellState};

/// From the state of an event on, a run is one that begins there; one that cannot begin stays where it was.
#[test]
fn a_run_goes_on_from_another_state() -> Outcome {
    fn check<R: Run<System = Planar, Scalar = f64>>(
        mut run: R,
        begin: impl Fn(f64, PlanarState) -> Outcome<R>,
    ) -> Outcome {
        run.take_steps(7)?;
        let (before, time) = (bits(run.q()), run.time());
        let nowhere = PlanarState { x: f64::NAN, ..PLANAR };
        assert!(run.set_state(2.0, nowhere).is_err());
        assert_eq!((bits(run.q()), run.time()), (before, time));
        let at = PlanarState { x: 0.3, y: 0.4, dot_x: -1.0, dot_y: 0.2 };
        run.set_state(2.0, at)?;
        let mut other = begin(2.0, at)?;
        for _ in 0..5 {
            run.advance()?;
            other.advance()?;
            assert_eq!((bits(run.q()), run.time().to_bits()), (bits(other.q()), other.time().to_bits()));
        }
        assert_eq!(run.steps(), other.steps() + 7);
        Ok(())
    }
    let verlet = Variational::trapezoid();
    let fixed = |t, at| Ok(Integrator::new_at(&PLANE, verlet, t, 0.1, at)?);
    check(fixed(0.0, PLANAR)?, fixed)?;
    let (gauss, control) = (Gauss::<4>::new(), ErrorControl::new(1e-9, 0.1));
    let controlled = |t, at| Ok(Integrator::controlled_at(&PLANE, gauss, control, t, at)?);
    check(controlled(0.0, PLANAR)?, controlled)
}

/// A run that is set to the state of an event goes on from there as if nothing had been set.
#[test]
fn an_event_is_left_behind_where_the_same_state_is_set() -> Outcome {
    for direction in [Direction::Rising, Direction::Falling, Direction::Either] {
        let [mut run, mut untouched] = [
            Integrator::new(&PLANE, Gauss::<4>::new(), 0.1, PLANAR)?,
            Integrator::new(&PLANE, Gauss::<4>::new(), 0.1, PLANAR)?,
        ];
        let jumps = |_: f64, state: &PlanarState| [state.x.signum() - 0.5, state.dot_x];
        let mut events = run.events([direction; 2], jumps)?;
        let mut others = untouched.events([direction; 2], jumps)?;
        while let Some(Event { index, time, state }) = others.next_until(20.0)? {
            let event = events.next_until(20.0)?;
            let Some(event) = event.filter(|event| event.index == index) else { panic!("{index} {time}") };
            assert!(abs_diff_eq!(event.time, time, epsilon = 1e-8), "{event:?} {time}");
            assert!(index == 1 || event.state.x.signum() == state.x.signum(), "{event:?}");
            events.set_state(event.time, event.state)?;
        }
        assert!(events.next_until(20.0)?.is_none());
    }
    Ok(())
}

/// Two parabolas, at whose seam steps end: those that begin or end there may be as short as the rounding of
/// the time.
#[test]
fn a_change_at_a_seam_is_made_once() -> Outcome {
    for factor in [1.0, 0.9, -1.0] {
        for x in (0..40).map(|k| 0.3 + 0.0355 * f64::from(k)) {
            let start = WellState { x, dot_x: 0.0 };
            let control = ErrorControl::new(1e-9, 0.1);
            let mut run = Integrator::controlled(&Well, Gauss::<4>::new(), control, start)?;
            let mut events = run.events([Direction::Either], |_, state| [state.x])?;
            let mut speed = (2.0 * x).sqrt();
            let mut expected = speed;
            for _ in 0..12 {
                let Some(Event { time, state, .. }) = events.next_until(60.0)? else { panic!("{expected}") };
                assert!(abs_diff_eq!(time, expected, epsilon = 1e-11), "{x} {factor}: {time} {expected}");
                events.set_state(time, WellState { dot_x: factor * state.dot_x, ..state })?;
                speed *= factor.abs();
                expected += 2.0 * speed;
            }
        }
    }
    Ok(())
}

/// A ball that comes into corners of a box meets both walls, whatever rounding says of their order.
#[test]
fn a_corner_reflects_twice() -> Outcome {
    for k in 0..200 {
        let speed = 0.3 + 0.007_13 * f64::from(k);
        let start = PlanarState { x: 0.5, y: 0.5, dot_x: speed, dot_y: speed };
        let mut run = Integrator::new(&Planar { stiffness: 0.0 }, Variational::trapezoid(), 0.13, start)?;
        let walls = |_, s: &PlanarState| [s.x, s.y, 1.0 - s.x, 1.0 - s.y];
        let mut events = run.events([Direction::Falling; 4], walls)?;
        let mut count = [0; 4];
        while let Some(Event { index, time, state }) = events.next_until(20.0)? {
            count[index] += 1;
            let state = match index {
                0 | 2 => PlanarState { dot_x: -state.dot_x, ..state },
                _ => PlanarState { dot_y: -state.dot_y, ..state },
            };
            events.set_state(time, state)?;
        }
        let PlanarState { x, y, .. } = run.state();
        assert!(abs_diff_eq!(x, y, epsilon = 1e-11) && x > -0.3 && x < 1.3, "{speed}: {x} {y}");
        let expected = (20.0 * speed + 0.5).floor() as i32;
        assert_eq!((count[0] + count[2], count[1] + count[3]), (expected, expected), "{speed}");
    }
    Ok(())
}

/// Hops become shorter until they are none, and do not fall through the floor.
#[test]
fn a_ball_that_comes_to_rest_does_not_fall_through_the_floor() -> Outcome {
    for restitution in [0.2, 0.5, 0.8, 0.9] {
        for (h, floor) in [(0.01, 0.0), (0.1, 0.0), (0.7, 0.0), (0.1, 5.0), (0.1, -3.7)] {
            let start = BallState { y: floor + 0.5, dot_y: 0.0 };
            let mut run = Integrator::new(&Ball, Variational::trapezoid(), h, start)?;
            let mut events = run.events([Direction::Falling], |_, state| [state.y - floor])?;
            let error = loop {
                match events.next_until(100.0) {
                    Ok(Some(Event { time, state, .. })) => {
                        events.set_state(time, BallState { dot_y: -restitution * state.dot_y, ..state })?;
                    }
                    Ok(None) => panic!("{restitution}, {h}, {floor}: below the floor"),
                    Err(error) => break error,
                }
            };
            // 1 + 2 e/(1 − e) units of time, but for the last hops.
            let rest = 1.0 + 2.0 * restitution / (1.0 - restitution);
            let StepFailure::Hops { event: 0, time, .. } = error.failure else { panic!("{error:?}") };
            assert!((time - rest).abs() < 0.1 * h, "{restitution}, {h}, {floor}: {time} {rest}");
        }
    }
    Ok(())
}
