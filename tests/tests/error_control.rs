//! Steps chosen by their error: that errors fall with the tolerance, that steps which are taken back leave
//! no trace, how runs end, and that the long-time behaviour of the method is lost.

use approx::{abs_diff_eq, assert_abs_diff_eq};
use core::f64::consts::{PI, TAU};
use dvi_core::methods::{Carries, VariableStep};
use dvi_core::prelude::*;
use dvi_core::run::ControlledRun;
use dvi_tests::configurations::chaotic;
use dvi_tests::zoo::regular::*;
use dvi_tests::{Outcome, apart, larger, refused_option};

mod breaks;
mod grazes;
pub(crate) mod problems;
mod ridges;
mod rough;
pub(crate) mod seams;
mod sums;

const TOLERANCES: [f64; 9] = [1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12];

/// The errors at time `end` for each tolerance, against steps of one length that are `fine`.
fn errors<S: Lagrangian, M: VariableStep<S, f64> + Copy>(
    system: &S,
    method: M,
    start: &S::State<f64>,
    end: f64,
    fine: &[f64],
) -> Outcome<Vec<f64>> {
    let error = |&tolerance: &f64| {
        let control = ErrorControl::new(tolerance, 0.01);
        let mut run = Integrator::controlled(system, method, control, start.clone())?;
        run.advance_to(end)?;
        assert!(abs_diff_eq!(run.time(), end, epsilon = 1e-15 * end.abs()), "{:e}", run.time() - end);
        assert!(run.control_memory().error() <= 1.0);
        Ok(apart(run.q(), fine))
    };
    TOLERANCES.iter().map(error).collect()
}

/// Coordinates and velocities at time `end`.
fn values_at<S: Lagrangian, M: VariableStep<S, f64>>(
    (system, start): (&S, &S::State<f64>),
    (method, control): (M, ErrorControl<'_>),
    end: f64,
) -> Outcome<Vec<f64>> {
    let mut run = Integrator::controlled(system, method, control, start.clone())?;
    run.advance_to(end)?;
    Ok(system.values(&run.state())?.collect())
}

/// Errors are within `most` tolerances, smaller for a tolerance that is a hundredth, and fall with it as the
/// local error of this order lets expect: error and steps of one length are as hᵖ where the tolerance is as
/// hᵖ⁺¹.
fn check(errors: &[f64], order: f64, most: f64, band: f64) {
    for (error, tolerance) in errors.iter().zip(TOLERANCES) {
        assert!(error / tolerance < most, "{error:e} at {tolerance:e}");
    }
    assert!(errors.windows(3).all(|errors| errors[2] < 0.2 * errors[0]), "{errors:?}");
    let pairs: Vec<(f64, f64)> = TOLERANCES.into_iter().zip(errors.iter().copied()).collect();
    let slope = convergence_order(&pairs).unwrap_or(f64::NAN);
    let expected = order / (order + 1.0);
    assert!(abs_diff_eq!(slope, expected, epsilon = band), "{slope}, expected {expected}: {errors:?}");
}

#[test]
fn errors_fall_with_the_tolerance_on_an_eccentric_orbit() -> Outcome {
    // After one and a half periods the comet is at its apocentre.
    let (start, end, fine) = (pericentre(0.9), 1.5 * TAU, [-1.9, 0.0]);
    check(&errors(&KEPLER, Gauss::<2>::new(), &start, end, &fine)?, 4.0, 4000.0, 0.1);
    check(&errors(&KEPLER, Gauss::<4>::new().in_lanes(), &start, end, &fine)?, 8.0, 60.0, 0.1);
    check(&errors(&KEPLER, Gauss::<8>::new().in_lanes(), &start, end, &fine)?, 16.0, 60.0, 0.4);
    Ok(())
}

/// The smallest and the largest ratio of the error of a step, in units of the tolerance, to its estimate.
fn estimates<S: Lagrangian, M: VariableStep<S, f64> + Copy>(
    system: &S,
    method: M,
    start: &S::State<f64>,
    [end, tolerance]: [f64; 2],
) -> Outcome<[f64; 2]>
where
    Gauss<8>: Method<S, f64>,
{
    let mut run = Integrator::controlled(system, method, ErrorControl::new(tolerance, 0.01), start.clone())?;
    let mut range = [f64::INFINITY, 0.0];
    while run.time() < end {
        let (before, t) = (run.state(), run.time());
        run.advance()?;
        let mut fine = Integrator::new_at(system, Gauss::<8>::new(), t, run.step_size() / 2.0, before)?;
        fine.take_steps(2)?;
        let errors = run.q().iter().zip(fine.q());
        let error = errors.fold(0.0, |most, (q, exact)| {
            larger(most, (q - exact).abs() / (tolerance * (1.0 + exact.abs())))
        });
        // A first step that is much too short has no error but rounding.
        if error * tolerance > 1e-13 {
            let ratio = error / run.control_memory().error();
            range = [if ratio < range[0] { ratio } else { range[0] }, larger(range[1], ratio)];
        }
    }
    Ok(range)
}

#[test]
fn estimates_are_near_the_error_of_a_step() -> Outcome {
    let (vortices, start) = chaotic();
    for [least, most] in [
        estimates(&vortices, Gauss::<2>::new(), &start, [20.0, 1e-7])?,
        estimates(&vortices, Gauss::<8>::new(), &start, [20.0, 1e-7])?,
        estimates(&KEPLER, Gauss::<1>::new(), &pericentre(0.5), [TAU, 1e-6])?,
        estimates(&KEPLER, Gauss::<8>::new(), &pericentre(0.9), [TAU, 1e-7])?,
    ] {
        assert!(least > 2e-3 && most < 8.0, "{least:e} {most:e}");
    }
    Ok(())
}

/// Steps of one length, before each of which a longer one is taken back, or is resonant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Detour {
    pub(crate) h: f64,
    pub(crate) long: Option<f64>,
}

impl<S: System> Carries<S, f64> for Detour {
    type Memory = ();
}

impl<S: Lagrangian> StepControl<S, f64> for Detour {
    type Suited<C> = C;
    const REJECTS: bool = true;
    fn begin(&self, _system: &S, _q: &[f64], _v: &[f64], _t: f64) -> Result<((), f64), StartError> {
        Ok(((), self.h))
    }
    fn step<M: Method<S, f64>>(
        &self,
        _memory: &mut (),
        run: &mut ControlledRun<'_, S, M, f64>,
        t: f64,
    ) -> Result<f64, StepFailure> {
        if let Some(long) = self.long {
            let tolerance = Tolerance { relative: 1e-9, absolute: 0.0 };
            match run.step(t, long) {
                Ok(()) => {
                    let error = run.local_error(t, [long, self.h], tolerance)?;
                    assert!(error > 0.0 && error.is_finite(), "{error}");
                    run.go_back();
                }
                Err(failure) => assert!(matches!(failure, StepFailure::Resonance { .. }), "{failure}"),
            }
        }
        run.step(t, self.h).map(|()| self.h)
    }
}

#[test]
fn steps_that_are_taken_back_leave_no_trace() -> Outcome {
    fn check<S: Lagrangian<State<f64>: PartialEq>, M: VariableStep<S, f64> + Copy>(
        system: &S,
        method: M,
        start: &S::State<f64>,
    ) -> Outcome {
        let run = |long| {
            let mut run = Integrator::controlled(system, method, Detour { h: 0.01, long }, start.clone())?;
            run.take_steps(100)?;
            Ok::<_, Box<dyn core::error::Error>>((run.state(), run.checkpoint()))
        };
        let [(state, straight), (again, detour)] = [run(None)?, run(Some(0.1))?];
        assert_eq!(state, again);
        // All but what it has cost is the same.
        let text = |run| format!("{run:?}").split("statistics").next().map(str::to_owned);
        assert_eq!(text(straight), text(detour));
        Ok(())
    }
    let (vortices, points) = chaotic();
    check(&vortices, Gauss::<2>::new(), &points)?;
    check(&KEPLER, Gauss::<3>::new().in_lanes(), &pericentre(0.6))?;
    // A first step that is much too long comes to the same as the one that is found in its place.
    let first = |h| {
        let method = Gauss::<8>::new().in_lanes();
        let mut run = Integrator::controlled(&KEPLER, method, ErrorControl::new(1e-9, h), pericentre(0.9))?;
        run.advance()?;
        Ok::<_, Box<dyn core::error::Error>>((run.step_size(), run.state(), run.statistics().rejected))
    };
    let (length, state, rejected) = first(1000.0)?;
    assert!(rejected > 3 && length < 0.1, "{rejected} {length}");
    assert_eq!(first(length)?, (length, state, 0));
    Ok(())
}

#[test]
fn a_head_on_collision_ends_with_an_error_at_the_last_good_state() -> Outcome {
    let start = KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.0 };
    for tolerance in [1e-4, 1e-8, 1e-12] {
        let method = Gauss::<8>::new().in_lanes();
        let mut run = Integrator::controlled(&KEPLER, method, ErrorControl::new(tolerance, 0.1), start)?;
        let error = run.advance_to(3.0).err().ok_or("it collides")?;
        // Half the period of the orbit of semi-axis ½.
        let fall = PI * 0.5_f64.powf(1.5);
        assert_eq!((error.step, error.time), (run.steps(), run.time()));
        assert!(abs_diff_eq!(run.time(), fall, epsilon = 10.0 * tolerance), "{} {}", run.time(), error);
        assert!(run.state().x.is_finite());
        assert!(
            matches!(
                error.failure,
                StepFailure::Tolerance { .. }
                    | StepFailure::StepLength { .. }
                    | StepFailure::NotConverged { .. }
            ),
            "{error}"
        );
    }
    Ok(())
}

#[test]
fn options_and_methods_out_of_range_are_refused() {
    let refused = |control| {
        refused_option(Integrator::controlled(&KEPLER, Gauss::<2>::new(), control, pericentre(0.5)))
    };
    let of_tolerance = |relative, absolute| {
        let control =
            ErrorControl { tolerance: Tolerance { relative, absolute }, ..ErrorControl::new(1.0, 0.1) };
        refused(control)
    };
    for relative in [0.0, -1.0, 1e-17, f64::NAN, f64::INFINITY] {
        assert_eq!(of_tolerance(relative, 0.0), "relative");
    }
    for absolute in [-1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(of_tolerance(1e-3, absolute), "absolute");
    }
    for longest_step in [0.0, -1.0, f64::NAN] {
        assert_eq!(refused(ErrorControl { longest_step, ..ErrorControl::new(1e-3, 0.1) }), "longest_step");
    }
    let control = ErrorControl::new(1e-6, 0.1);
    let error = Integrator::controlled(&KEPLER, Variational::trapezoid(), control, pericentre(0.5)).err();
    assert!(matches!(error, Some(StartError::Unsupported { option: "ErrorControl", .. })), "{error:?}");
    // `Gauss` is no way out for every system.
    assert!(error.is_some_and(|error| error.to_string().contains("no method for constraints")));
}

/// A checkpoint has a direction, and the first step of a control is none of the run that goes on.
#[test]
fn a_run_goes_on_in_the_direction_of_its_checkpoint() -> Outcome {
    let control = |first_step| ErrorControl::new(1e-9, first_step);
    for direction in [1.0, -1.0] {
        let run = |control| Integrator::controlled(&KEPLER, Gauss::<4>::new(), control, pericentre(0.5));
        let mut whole = run(control(0.3 * direction))?;
        whole.advance_to(3.0 * direction)?;
        let (method, other) = (Gauss::<4>::new(), control(-0.3 * direction));
        let mut resumed = Integrator::resume_controlled(&KEPLER, method, other, &whole.checkpoint())?;
        assert!(resumed.advance_to(2.0 * direction).is_err());
        whole.advance_to(9.0 * direction)?;
        resumed.advance_to(9.0 * direction)?;
        assert_eq!((whole.steps(), whole.state()), (resumed.steps(), resumed.state()));
        assert_abs_diff_eq!(resumed.time(), 9.0 * direction, epsilon = 1e-14);
    }
    Ok(())
}

#[test]
fn times_that_do_not_lie_ahead_are_refused() -> Outcome {
    for direction in [1.0, -1.0] {
        let control = ErrorControl::new(1e-9, 0.1 * direction);
        let mut run = Integrator::controlled(&KEPLER, Gauss::<4>::new(), control, pericentre(0.5))?;
        run.advance_to(0.0)?;
        assert_eq!(run.steps(), 0);
        run.advance_to(2.0 * direction)?;
        let (steps, state) = (run.steps(), run.state());
        for target in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1.999 * direction, -3.0 * direction] {
            let error = run.advance_to(target).err().ok_or("it is no time ahead")?;
            assert_eq!((error.step, error.time), (steps, run.time()));
            let StepFailure::Unreachable { now, target: named } = error.failure else {
                return Err(error.into());
            };
            assert_eq!((now, named.to_bits()), (run.time(), target.to_bits()));
        }
        // Where it is, there is no step to take; and the run goes on.
        run.advance_to(2.0 * direction)?;
        assert_eq!((run.steps(), run.state()), (steps, state));
        assert!(run.next().is_some_and(|state| state.is_ok()));
        run.advance_to(7.0 * direction)?;
        assert_abs_diff_eq!(run.time(), 7.0 * direction, epsilon = 1e-14);
    }
    Ok(())
}

/// Steps without an error become twice as long each time.
#[test]
fn a_run_ends_before_the_end_of_the_numbers() -> Outcome {
    let start = SpringState { x: 1.0, dot_x: 1.0 };
    let mut run = Integrator::controlled(&FREE, Gauss::<3>::new(), ErrorControl::new(1e-10, 0.1), start)?;
    let error = run.take_steps(3000).err().ok_or("it ends")?;
    assert!(matches!(error.failure, StepFailure::StepLength { .. }), "{error}");
    assert!(run.time().is_finite() && run.state().x.is_finite() && run.time() > 1e300, "{}", run.time());
    assert_eq!((error.step, error.time), (run.steps(), run.time()));
    Ok(())
}

#[test]
fn an_energy_limit_lets_the_estimate_through() -> Outcome {
    let control = ErrorControl::new(1e-3, 0.1);
    let free = Gauss::<2>::new();
    let mut run = Integrator::controlled(&KEPLER, free, control, pericentre(0.9))?;
    run.advance_to(50.0)?;
    let limited = EnergyLimit { method: free, limit: 1e-5 };
    let mut run = Integrator::controlled(&KEPLER, limited, control, pericentre(0.9))?;
    let energy = run.energy();
    // A step that changes the energy too much is a failure, after which a shorter one is tried.
    while run.time() < 50.0 && run.advance().is_ok() {
        assert_abs_diff_eq!(run.energy(), energy, epsilon = 1e-5);
    }
    assert!(run.steps() > 10 && run.statistics().rejected > 0);
    Ok(())
}
