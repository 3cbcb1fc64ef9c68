//! Times at which formulas break: steps end there, to the rounding of the time, forward, backward and after
//! a checkpoint.

use dvi_core::prelude::*;

use super::{KEPLER, Outcome, pericentre};

/// A mass that is pushed from `on` to `off`.
#[lagrangian(
    coordinates(x),
    lagrangian = dot(x).powi(2) / 2.0,
    force(x) = if t > on { if t < off { 1.0 } else { 0.0 } } else { 0.0 },
)]
pub(super) struct Pushed {
    pub(super) on: f64,
    pub(super) off: f64,
}

fn is_near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 2.0 * f64::EPSILON * b.abs()
}

/// The ends of the steps up to `end`, by an iteration that knows of no end.
fn ends(breaks: &[f64], first_step: f64, end: f64) -> Outcome<Vec<f64>> {
    let control = ErrorControl { breaks, ..ErrorControl::new(1e-9, first_step) };
    let mut run = Integrator::controlled(&KEPLER, Gauss::<4>::new(), control, pericentre(0.5))?;
    let mut ends = Vec::new();
    while run.time().abs() < end {
        run.advance()?;
        ends.push(run.time());
    }
    Ok(ends)
}

#[test]
fn steps_end_at_breaks() -> Outcome {
    let breaks = [-7.3, -0.3, -0.1, 0.0, 0.1, 0.3, 0.3, 0.31, 7.3, 1e6];
    for direction in [1.0, -1.0] {
        let found = ends(&breaks, 0.5 * direction, 10.0)?;
        let ahead: Vec<f64> =
            breaks.into_iter().filter(|time| time * direction > 0.0 && time.abs() < 10.0).collect();
        for time in &ahead {
            assert!(found.iter().any(|&end| is_near(end, *time)), "{time}: {found:?}");
        }
        // None is met twice, and the steps are not short on their account: each break makes one more.
        assert!(found.windows(2).all(|ends| (ends[1] - ends[0]).abs() > 1e-3), "{found:?}");
        let free = ends(&[], 0.5 * direction, 10.0)?;
        assert!(found.len() <= free.len() + ahead.len(), "{} {}", found.len(), free.len());
    }
    Ok(())
}

/// On each side of its jump a force is smooth: a step that begins or ends there sees one side of it.
#[test]
fn steps_at_breaks_do_not_see_the_jump() -> Outcome {
    let start = |x, dot_x| PushedState { x, dot_x };
    // Times that no sum of steps meets exactly.
    for (on, off) in [(50.0, 50.2), (33.3, 33.4), (1e5 + 0.1, 1e5 + 0.3)] {
        let system = Pushed { on, off };
        let length = off - on;
        let after = length * (100.0 - length / 2.0);
        for tolerance in [1e-6, 1e-9, 1e-12] {
            let breaks = [on, off];
            let control = ErrorControl { breaks: &breaks, ..ErrorControl::new(tolerance, 0.01) };
            let mut run = Integrator::controlled(&system, Gauss::<8>::new(), control, start(0.0, 0.0))?;
            run.advance_to(on + 100.0)?;
            let error = (run.state().x - after).abs();
            assert!(error < 30.0 * tolerance * (1.0 + after), "{on}, {tolerance:e}: {error:e}");
            assert!(run.steps() < 40 && run.statistics().rejected < 3, "{on}: {:?}", run.statistics());
            // And back.
            let control = ErrorControl { breaks: &breaks, ..ErrorControl::new(tolerance, -0.01) };
            let (t, state) = (run.time(), run.state());
            let mut back = Integrator::controlled_at(&system, Gauss::<8>::new(), control, t, state)?;
            back.advance_to(on - 1.0)?;
            let error = back.state().x.abs();
            assert!(error < 60.0 * tolerance * (1.0 + after), "{on}, {tolerance:e}: {error:e}");
            assert!(back.steps() < 40 && back.statistics().rejected < 3, "{on}: {:?}", back.statistics());
        }
    }
    Ok(())
}

#[test]
fn breaks_that_are_not_in_order_are_refused() {
    let refusal = |breaks: &[f64]| {
        let control = ErrorControl { breaks, ..ErrorControl::new(1e-9, 0.1) };
        let run = Integrator::controlled(&KEPLER, Gauss::<4>::new(), control, pericentre(0.5));
        match run.err() {
            Some(StartError::Parameter { name: "breaks", value, .. }) => Some(value),
            _ => None,
        }
    };
    assert_eq!(refusal(&[1.0, 3.0, 2.0, 5.0]), Some(2.0));
    assert_eq!(refusal(&[1.0, f64::INFINITY]), Some(f64::INFINITY));
    assert_eq!(refusal(&[f64::NEG_INFINITY, 1.0]), Some(f64::NEG_INFINITY));
    assert!(refusal(&[0.0, f64::NAN, 1.0]).is_some_and(f64::is_nan));
    assert_eq!(refusal(&[-1.0, 0.0, 0.0, 2.0]), None);
}
