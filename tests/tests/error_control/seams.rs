//! Steps that end where a formula is not smooth: where such places are, that no step sees both sides of one,
//! and what becomes of motions that do not leave it.

use core::f64::consts::{PI, SQRT_2};

use approx::assert_abs_diff_eq;
use dvi_core::methods::VariableStep;
use dvi_core::prelude::*;
use dvi_tests::zoo::regular::{Sliding, SlidingState};

use super::breaks::{Pushed, PushedState};
use super::rough::{Corners, CornersState};
use super::{KEPLER, Outcome, pericentre};

/// All that makes a seam, and what makes none: sums over what differs from term to term, parameters,
/// momenta and events.
#[lagrangian(
    coordinates(x, y, z[3]),
    lagrangian = {
        let gap = |a, b| (a - b).abs();
        (dot(x).powi(2) + dot(y).powi(2) + sum(0..3, |i| dot(z[i]).powi(2))) / 2.0
            - gap(x, y) - gap(y, x) - x.max(k * y) - k.abs() * sum(0..3, |i| z[i].abs())
            - (if x > 1.0 && !(y > 2.0 * t) { x } else { y })
            - sum(0..3, |i| if t > 5.0 { z[i] } else { 2.0 * z[i] })
    },
    force(x) = -dot(x).signum(),
    momenta(weighted = (x - 3.0).abs() * dot(x)),
    events(far = y.abs() - 3.0),
)]
struct Seamed {
    k: f64,
}

/// A gauge changes no motion, and makes no seam.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = (x + y * y.abs()) * d(y),
    hamiltonian = x.min(2.0 * y) + y * y,
    gauge       = (x - 7.0).abs() * y,
)]
struct Gauged;

#[test]
fn seams_are_what_formulas_compare() {
    const { assert!(Seamed::SEAMS == 6 && Gauged::SEAMS == 2) };
    let check = |found: &[f64], expected: &[f64]| {
        for seam in expected {
            let is_there = |value: &f64| (value - seam).abs() < 1e-15 || (value + seam).abs() < 1e-15;
            assert_eq!(found.iter().filter(|value| is_there(value)).count(), 1, "{seam}: {found:?}");
        }
    };
    let (q, v, t) = ([0.3, -0.7, 1.0, 2.0, 3.0], [0.9, 0.1, 0.0, 0.0, 0.0], 0.2);
    let system = Seamed { k: 1.7 };
    let found: Vec<f64> = (0..6).map(|seam| system.seam(seam, &q, &v, t)).collect();
    check(&found, &[0.3 + 0.7, 0.3 + 1.7 * 0.7, 0.3 - 1.0, -0.7 - 0.4, 0.2 - 5.0, 0.9]);
    assert!(system.seam(6, &q, &v, t).is_nan());
    let found = [0, 1].map(|seam| Gauged.seam(seam, &[0.3, -0.7], &[], t));
    check(&found, &[-0.7, 0.3 + 1.4]);
    let report = Seamed::REPORT.to_string();
    let named = report.lines().find(|line| line.trim().starts_with("Not smooth where "));
    assert!(named.is_some_and(|sentence| sentence.contains("dot(x) = 0")), "{report}");
}

#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - x.abs())]
pub(crate) struct Well;

/// From `a` at rest under −|x|: parabolas, a quarter of a period of √(2a) each.
fn well(a: f64, t: f64) -> f64 {
    let quarter = (2.0 * a).sqrt();
    let t = (t + quarter).rem_euclid(4.0 * quarter) - quarter;
    if t < quarter { a - t * t / 2.0 } else { (t - 2.0 * quarter).powi(2) / 2.0 - a }
}

/// The error of x at time `end` in units of the tolerance, the steps taken and those taken back.
fn measured<S: Lagrangian, M: VariableStep<S, f64>>(
    (system, start): (&S, &S::State<f64>),
    (method, control): (M, ErrorControl<'_>),
    (end, exact): (f64, f64),
) -> Outcome<(f64, u64, u64)> {
    let mut run = Integrator::controlled(system, method, control, start.clone())?;
    run.advance_to(end)?;
    let statistics = run.statistics();
    let error = (run.q()[0] - exact).abs() / control.tolerance.relative;
    Ok((error, statistics.steps, statistics.rejected))
}

#[test]
fn a_long_motion_over_a_kink_takes_few_steps() -> Outcome {
    let start = WellState { x: 1.0, dot_x: 0.0 };
    for tolerance in [1e-6, 1e-9, 1e-12] {
        fn check<M: VariableStep<Well, f64>>(start: &WellState, method: M, tolerance: f64) -> Outcome {
            let control = ErrorControl::new(tolerance, 0.01);
            let (error, steps, rejected) =
                measured((&Well, start), (method, control), (50.0, well(1.0, 50.0)))?;
            // The kink is met 18 times.
            assert!(
                error < 10.0 && steps < 80 && rejected < 30,
                "{tolerance:e}: {error} {steps} {rejected}"
            );
            Ok(())
        }
        check(&start, Gauss::<4>::new(), tolerance)?;
        check(&start, Gauss::<8>::new().in_lanes(), tolerance)?;
        // And back.
        let control = ErrorControl::new(tolerance, 0.01);
        let mut run = Integrator::controlled(&Well, Gauss::<8>::new(), control, start)?;
        run.advance_to(50.0)?;
        let control = ErrorControl::new(tolerance, -0.01);
        let mut back =
            Integrator::controlled_at(&Well, Gauss::<8>::new(), control, run.time(), run.state())?;
        back.advance_to(0.0)?;
        assert_abs_diff_eq!(back.state().x, 1.0, epsilon = 30.0 * tolerance);
        assert!(back.steps() < 80, "{}", back.steps());
    }
    // Late by rounding of the time at each of hundreds of seams, it would gain 10⁻⁷ of its place.
    let (method, control) = (Gauss::<4>::new(), ErrorControl::new(1e-9, 0.01));
    let (error, ..) = measured((&Well, &start), (method, control), (1000.0, well(1.0, 1000.0)))?;
    assert!(error < 10.0, "{error}");
    Ok(())
}

/// An oscillator with dry friction.
#[lagrangian(
    coordinates(x),
    lagrangian = (dot(x).powi(2) - x * x) / 2.0,
    force(x) = if dot(x) > 0.0 { -friction } else { friction },
)]
pub(crate) struct Dry {
    pub(crate) friction: f64,
}

/// Two springs.
#[lagrangian(
    coordinates(x),
    lagrangian = dot(x).powi(2) / 2.0 - (if x > 0.0 { 100.0 } else { 1.0 }) * x * x / 2.0,
)]
struct Bilinear;

/// A kink, and a force that is switched on when it is met.
#[lagrangian(
    coordinates(x),
    lagrangian = dot(x).powi(2) / 2.0 - x.abs(),
    force(x) = if t * t > 2.0 { 0.5 } else { 0.0 },
)]
struct Switched;

/// A body that is pushed for a short time.
const PUSHED: Pushed = Pushed { on: 50.0, off: 50.2 };

/// Where less time is left than a seam takes to be left, whose roundings are those of the time.
#[test]
fn a_run_that_begins_at_a_seam_ends_where_it_was_asked_to() -> Outcome {
    for (begin, left) in [(155.0, 1e-12), (-155.0, -1e-12), (155.0, 1e-10), (0.0, 1e-12)] {
        let control = ErrorControl::new(1e-9, 0.1_f64.copysign(left));
        let start = WellState { x: 0.0, dot_x: 1.0 };
        let mut run = Integrator::controlled_at(&Well, Gauss::<4>::new(), control, begin, start)?;
        run.advance_to(begin + left)?;
        assert_abs_diff_eq!(run.time(), begin + left, epsilon = 1e-15 * (begin + left).abs());
    }
    Ok(())
}

/// Crossed 1, 3, 5, … after the start, also where a run is asked to end there.
#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - (x - 0.3 * t).abs())]
struct Relay;

#[test]
fn a_run_ends_at_a_seam_that_moves_where_it_was_asked_to() -> Outcome {
    for start in (0..60).map(|k| 0.3197 * f64::from(k)) {
        for h in [0.1, -0.1] {
            let state = RelayState { x: 0.5 + 0.3 * start, dot_x: 0.3 };
            let control = ErrorControl::new(1e-9, h);
            let mut run = Integrator::controlled_at(&Relay, Gauss::<4>::new(), control, start, state)?;
            for end in (1..=55).map(|k| start + h * f64::from(k)) {
                run.advance_to(end)?;
                assert_abs_diff_eq!(run.time(), end, epsilon = 1e-15 * (end.abs() + h.abs()));
            }
        }
    }
    Ok(())
}

#[test]
fn forces_by_if_are_met_where_they_change() -> Outcome {
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let (method, control) = (Gauss::<8>::new(), ErrorControl::new(tolerance, 0.01));
        let check = |(error, steps, rejected): (f64, u64, u64), most: u64| {
            assert!(error < 10.0 && steps + rejected < most, "{tolerance:e}: {error} {steps} {rejected}");
        };
        // Each half period takes 2μ from the amplitude.
        let (mu, halves) = (0.01, 6.0);
        let exact = mu + (1.0 - mu - 2.0 * mu * halves) * (20.0 - halves * PI).cos();
        let dry = Dry { friction: mu };
        let motion = (&dry, &DryState { x: 1.0, dot_x: 0.0 });
        check(measured(motion, (method, control), (20.0, exact))?, 30);
        // Half periods of π and π/10.
        let since = (20.0 - PI / 2.0) % (1.1 * PI);
        let exact = if since < 0.1 * PI { (10.0 * since).sin() / 10.0 } else { -(since - 0.1 * PI).sin() };
        let motion = (&Bilinear, &BilinearState { x: -1.0, dot_x: 0.0 });
        check(measured(motion, (method, control), (20.0, exact))?, 120);
        // Steps of a body at rest become longer without end, and do not miss the push; with one of its
        // times among the breaks, or as the end of a run, it is met once.
        let motion = (&PUSHED, &PushedState { x: 0.0, dot_x: 0.0 });
        check(measured(motion, (method, control), (100.0, 9.98))?, 20);
        let with_breaks = ErrorControl { breaks: &[50.0, 60.0], ..control };
        check(measured(motion, (method, with_breaks), (100.0, 9.98))?, 24);
        let mut run = Integrator::controlled(motion.0, method, control, *motion.1)?;
        for end in [50.0, 50.2, 100.0] {
            run.advance_to(end)?;
        }
        check(((run.state().x - 9.98).abs() / tolerance, run.steps(), run.statistics().rejected), 30);
        // Two seams at one time.
        let exact = 0.75 * (3.0 - SQRT_2).powi(2) - SQRT_2 * (3.0 - SQRT_2);
        let motion = (&Switched, &SwitchedState { x: 1.0, dot_x: 0.0 });
        check(measured(motion, (method, control), (3.0, exact))?, 20);
    }
    Ok(())
}

#[test]
fn no_step_sees_both_sides() -> Outcome {
    fn check<S: Lagrangian, M: VariableStep<S, f64>>(
        (system, start): (&S, &S::State<f64>),
        (method, first_step, end): (M, f64, f64),
        sides: impl Fn(f64, S::State<f64>) -> Vec<bool>,
    ) -> Outcome {
        let control = ErrorControl::new(1e-9, first_step);
        let mut run = Integrator::controlled(system, method, control, start.clone())?;
        let (mut dense, mut changes) = (run.dense()?, 0);
        let mut before = Vec::new();
        while dense.time().abs() < end {
            let begun = dense.time();
            dense.advance()?;
            // What ends before a seam by rounding goes over it in a step of that length.
            if dense.step_size().abs() < 1e-12 {
                continue;
            }
            let mut look = |part: f64| {
                let t = begun + part * dense.step_size();
                Ok::<_, StepError>(sides(t, dense.state_at(t)?))
            };
            let first = look(1e-6)?;
            for part in [0.3, 0.9, 1.0 - 1e-6] {
                let name = S::REPORT.system;
                assert_eq!(look(part)?, first, "{name} at {begun}, {first_step}, part {part}");
            }
            changes += usize::from(!before.is_empty() && before != first);
            before = first;
        }
        assert!(changes > 1, "{}: {changes}", S::REPORT.system);
        Ok(())
    }
    let well = (&Well, &WellState { x: 1.0, dot_x: 0.0 });
    let of_x = |_, state: WellState| vec![state.x > 0.0];
    check(well, (Gauss::<2>::new(), 0.01, 20.0), of_x)?;
    check(well, (Gauss::<8>::new().in_lanes(), -0.01, 20.0), of_x)?;
    let limited = EnergyLimit { method: Gauss::<4>::new(), limit: 1e-3 };
    check(well, (limited, 0.01, 20.0), of_x)?;
    let dry = (&Dry { friction: 0.01 }, &DryState { x: 1.0, dot_x: 0.0 });
    check(dry, (Gauss::<8>::new(), 0.01, 20.0), |_, state| vec![state.dot_x > 0.0])?;
    let pushed = (&PUSHED, &PushedState { x: 0.0, dot_x: 0.0 });
    check(pushed, (Gauss::<8>::new(), 0.01, 100.0), |t, _| vec![t > 50.0, t < 50.2])?;
    let corners = (&Corners, &CornersState { x: 1.0, y: 0.3 });
    check(corners, (Gauss::<4>::new(), 0.01, 20.0), |_, state| vec![state.x > 0.0, state.y > 0.0])
}

#[test]
fn a_run_over_breaks_and_seams_goes_on_from_a_checkpoint() -> Outcome {
    fn check<S: Lagrangian<State<f64>: PartialEq>>(
        (system, start): (&S, &S::State<f64>),
        control: ErrorControl<'_>,
        end: f64,
    ) -> Outcome<Option<StepFailure>>
    where
        Gauss<4>: VariableStep<S, f64>,
    {
        let method = Gauss::<4>::new();
        let mut run = Integrator::controlled(system, method, control, start.clone())?;
        while run.time() < end {
            let mut again = Integrator::resume_controlled(system, method, control, &run.checkpoint())?;
            let (one, other) = (run.advance(), again.advance());
            assert_eq!(one, other);
            assert_eq!((run.time(), run.state()), (again.time(), again.state()));
            if let Err(error) = one {
                return Ok(Some(error.failure));
            }
        }
        Ok(None)
    }
    let control = ErrorControl::new(1e-9, 0.01);
    let with_breaks = ErrorControl { breaks: &[0.2, 0.25, 1.0, 1.5], ..control };
    assert_eq!(check((&KEPLER, &pericentre(0.5)), with_breaks, 2.0)?, None);
    assert_eq!(check((&Well, &WellState { x: 1.0, dot_x: 0.0 }), control, 20.0)?, None);
    assert_eq!(check((&Corners, &CornersState { x: 1.0, y: 0.3 }), control, 20.0)?, None);
    // The hops before a failure are those of the checkpoint too.
    let failure = check((&Sliding, &SlidingState { x: 0.0, dot_x: 1.0 }), control, 20.0)?;
    assert!(matches!(failure, Some(StepFailure::Seam { seam: 0, .. })), "{failure:?}");
    Ok(())
}

/// A first step that is much too long says nothing of the steps that are taken.
#[test]
fn steps_are_not_short_beside_one_that_was_never_taken() -> Outcome {
    for first_step in [1e6, -1e6] {
        let (end, control) = (400.0_f64.copysign(first_step), ErrorControl::new(1e-9, first_step));
        let start = WellState { x: 1.0, dot_x: 0.0 };
        let mut run = Integrator::controlled(&Well, Gauss::<4>::new(), control, start)?;
        run.advance_to(end)?;
        assert_abs_diff_eq!(run.state().x, well(1.0, end), epsilon = 1e-8);
    }
    Ok(())
}

/// A motion towards a pole leads away from the seam of its drag: v = 1/(1 + t/2), back in time.
#[test]
fn a_pole_is_no_seam() -> Outcome {
    #[lagrangian(
        coordinates(x),
        lagrangian = dot(x).powi(2) / 2.0,
        dissipation = dot(x).abs().powi(3) / 6.0,
    )]
    struct Drag;
    let start = DragState { x: 0.0, dot_x: 1.0 };
    let mut run = Integrator::controlled(&Drag, Gauss::<4>::new(), ErrorControl::new(1e-6, -0.01), start)?;
    let error = run.advance_to(-2.2).err().ok_or("there is a pole")?;
    assert!(!matches!(error.failure, StepFailure::Seam { .. }), "{error}");
    assert_abs_diff_eq!(run.time(), -2.0, epsilon = 1e-6);
    Ok(())
}

/// Numbers of 32 bits, and the derivative of a place by the amplitude: the time at which a seam is met has
/// one too.
#[test]
fn seams_are_met_in_other_numbers() -> Outcome {
    use num_dual::Dual64;
    let control = ErrorControl::new(1e-5, 0.01);
    let start = WellStateOf { x: 1.0_f32, dot_x: 0.0 };
    let mut run = Integrator::controlled(&Well, Gauss::<4>::new(), control, start)?;
    run.advance_to(20.0)?;
    assert!((run.state().x - well(1.0, 20.0) as f32).abs() < 1e-3 && run.steps() < 60, "{}", run.steps());
    let start = WellStateOf { x: Dual64::new(1.0, 1.0), dot_x: Dual64::from(0.0) };
    let control = ErrorControl::new(1e-9, 0.01);
    let mut run = Integrator::controlled(&Well, Gauss::<4>::new(), control, start)?;
    run.advance_to(Dual64::from(4.0))?;
    // x = (t − 2q)²/2 − a with q = √(2a) and dq/da = 1/q.
    let slope = -2.0 * (4.0 - 2.0 * SQRT_2) / SQRT_2 - 1.0;
    assert_abs_diff_eq!(run.state().x.re, well(1.0, 4.0), epsilon = 1e-9);
    assert_abs_diff_eq!(run.state().x.eps, slope, epsilon = 1e-7);
    Ok(())
}
