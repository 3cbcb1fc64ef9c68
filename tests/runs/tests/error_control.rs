//! Steps chosen by their error, many of them: forces that are switched on, pulses, and motions that do not
//! leave a seam.

use core::f64::consts::PI;

use approx::assert_abs_diff_eq;
use dvi_core::methods::VariableStep;
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::zoo::regular::{Sliding, SlidingState};

/// A body at rest, free or on a spring, that is pushed with (t − t₀)ⁿ from some time on. The first step from
/// there makes all of the momentum, and is as wrong in it however short it is, where the power is beyond the
/// degree of the stages.
#[test]
fn forces_are_switched_on_at_rest() -> Outcome {
    #[lagrangian(
        coordinates(x),
        lagrangian = dot(x).powi(2) / 2.0 - w * x * x / 2.0,
        force(x) = if t > t0 { (t - t0).powf(n) } else { 0.0 },
    )]
    #[derive(Debug)]
    struct Pushed {
        w: f64,
        n: f64,
        t0: f64,
    }
    fn check<M: VariableStep<Pushed, f64> + Copy + core::fmt::Debug>(
        method: M,
        tolerances: &[f64],
    ) -> Outcome {
        for (w, n, t0) in [0.0, 1.0].into_iter().flat_map(|w| {
            [0.0, 1.0, 2.0, 3.0]
                .into_iter()
                .flat_map(move |n| [0.1, 0.77, 1.0, 3.2, 5.0].map(|t0| (w, n, t0)))
        }) {
            let system = Pushed { w, n, t0 };
            let start = PushedState { x: 0.0, dot_x: 0.0 };
            let mut fine = Integrator::new_at(&system, Gauss::<8>::new(), t0, 0.01, start)?;
            fine.take_steps(200)?;
            for (&tolerance, h) in
                tolerances.iter().flat_map(|tolerance| [0.01, 0.1, 1.0].map(|h| (tolerance, h)))
            {
                let mut run =
                    Integrator::controlled(&system, method, ErrorControl::new(tolerance, h), start)?;
                run.advance_to(t0 + 2.0)?;
                let error = (run.state().x - fine.state().x).abs();
                assert!(error < 30.0 * tolerance, "{system:?}, {method:?}, {tolerance:e}, {h}: {error:e}");
                let mut run =
                    Integrator::controlled(&system, method, ErrorControl::new(tolerance, h), start)?;
                run.advance_to(t0)?;
                run.advance_to(t0 + 2.0)?;
                let error = (run.state().x - fine.state().x).abs();
                assert!(error < 30.0 * tolerance, "{system:?}, {method:?}, {tolerance:e}, {h}: {error:e}");
                assert!(
                    run.steps() + run.statistics().rejected < 6000,
                    "{system:?}, {method:?}, {tolerance:e}, {h}"
                );
            }
        }
        Ok(())
    }
    check(Gauss::<1>::new(), &[1e-3, 1e-5])?;
    check(Gauss::<2>::new(), &[1e-3, 1e-6, 1e-10])?;
    check(Gauss::<3>::new(), &[1e-3, 1e-6, 1e-10])?;
    check(Gauss::<8>::new(), &[1e-3, 1e-6, 1e-10])
}

/// A body, free or on a spring, that is pushed while a sine is above c: for parts of its period that are
/// shorter than steps would be.
#[test]
fn pulses_are_not_passed_over() -> Outcome {
    #[lagrangian(
        coordinates(x),
        lagrangian = dot(x).powi(2) / 2.0 - k * x * x / 2.0,
        force(x) = if (w * t).sin() > c { 1.0 } else { 0.0 },
    )]
    #[derive(Debug)]
    struct Pulsed {
        k: f64,
        w: f64,
        c: f64,
    }
    fn check<M: VariableStep<Pulsed, f64> + Copy>(method: M, tolerance: f64) -> Outcome {
        for (k, w, c) in
            [(0.0, 1.0, 0.99), (0.0, 5.0, 0.9), (1.0, 7.0, 0.9), (1.0, 1.0, 0.9999), (1.0, 20.0, 0.5)]
        {
            let (end, system) = (60.0, Pulsed { k, w, c });
            let start = PulsedState { x: 1.0, dot_x: 0.0 };
            let mut run = Integrator::controlled(&system, method, ErrorControl::new(tolerance, 0.1), start)?;
            run.advance_to(end)?;
            // What a push up to time t adds to x at the end.
            let pushed = |t: f64| if k == 0.0 { -(end - t).powi(2) / 2.0 } else { (end - t).cos() };
            let mut exact = if k == 0.0 { 1.0 } else { end.cos() };
            for turn in 0..200 {
                let [on, off] = [c.asin(), PI - c.asin()]
                    .map(|phase| ((phase + 2.0 * PI * f64::from(turn)) / w).min(end));
                exact += pushed(off) - pushed(on);
            }
            let error = (run.state().x - exact).abs();
            assert!(error < 100.0 * tolerance, "{system:?}, {tolerance:e}: {error:e}");
        }
        Ok(())
    }
    for tolerance in [1e-6, 1e-8, 1e-10] {
        check(Gauss::<2>::new(), tolerance)?;
        check(Gauss::<4>::new(), tolerance)?;
        check(Gauss::<8>::new(), tolerance)?;
    }
    Ok(())
}

/// A groove, along which a spring moves the body.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2) - y * y) / 2.0,
    force(x) = if x > 0.0 { -1.0 } else { 1.0 },
)]
struct Groove;

#[test]
fn motions_that_do_not_leave_a_seam_end_soon() -> Outcome {
    fn check<S: Lagrangian, M: VariableStep<S, f64>>(
        (system, start): (&S, S::State<f64>),
        (method, tolerance): (M, f64),
        stops: f64,
    ) -> Outcome {
        let control = ErrorControl::new(tolerance, 0.01);
        let mut run = Integrator::controlled(system, method, control, start)?;
        let error = run.advance_to(10.0).err().ok_or("it does not leave the seam")?;
        let (name, statistics) = (S::REPORT.system, run.statistics());
        println!("{name}, {tolerance:e}: {} + {}, {error}", statistics.steps, statistics.rejected);
        assert!(statistics.steps + statistics.rejected < 1200, "{name}: {statistics:?}");
        assert!(matches!(error.failure, StepFailure::Seam { seam: 0, .. }), "{error}");
        assert_abs_diff_eq!(run.time(), stops, epsilon = 100.0 * tolerance);
        // It stays where it was.
        let (steps, state) = (run.steps(), run.q().to_vec());
        assert!(run.advance().is_err() && run.steps() == steps && run.q() == state);
        Ok(())
    }
    for tolerance in [1e-3, 1e-6, 1e-9, 1e-12] {
        for dot_x in [1.0, 0.0] {
            let stops = dot_x / 0.3;
            let start = SlidingState { x: 0.0, dot_x };
            check((&Sliding, start), (Gauss::<2>::new(), tolerance), stops)?;
            check((&Sliding, start), (Gauss::<8>::new().in_lanes(), tolerance), stops)?;
        }
        let groove = GrooveState { x: 0.0, y: 1.0, dot_x: 0.0, dot_y: 0.0 };
        check((&Groove, groove), (Gauss::<2>::new(), tolerance), 0.0)?;
        check((&Groove, groove), (Gauss::<8>::new(), tolerance), 0.0)?;
    }
    Ok(())
}
