//! Failures are values, and the last good state is kept.

mod said;
mod starts;

use dvi_core::prelude::*;
use dvi_tests::systems::*;
use dvi_tests::zoo::regular::{Kepler, KeplerState};
use dvi_tests::{Outcome, failing};

use crate::error_control::seams::{Dry, DryState};

/// Two equal vortices at distance `d`.
fn pair(d: f64) -> (PointVortices<2>, PointVorticesState<2>) {
    (PointVortices { gamma: [1.0, 1.0] }, PointVorticesState { x: [-d / 2.0, d / 2.0], y: [0.0, 0.0] })
}

/// At rest, where the spring pulls less than friction holds, no velocity has the sign that its friction asks
/// for.
#[test]
fn dry_friction_at_rest_is_not_told_that_a_smaller_step_helps() -> Outcome {
    for h in [1e-1, 1e-3, 1e-6] {
        let start = DryState { x: 0.2, dot_x: 0.0 };
        let (run, error) = failing(&Dry { friction: 0.5 }, Variational::midpoint(), h, start)?;
        assert!(run.steps() == 0 && matches!(error.failure, StepFailure::NotConverged { .. }), "{error}");
        let message = error.failure.to_string();
        assert!(
            message.contains("; a smaller step helps, unless a formula jumps there, as dry friction does")
        );
    }
    Ok(())
}

#[test]
fn a_pair_cannot_be_stepped_beyond_its_limit() -> Outcome {
    let d = 0.5;
    let limit = core::f64::consts::PI * d * d;
    for solver in [Solver::Automatic, Solver::Newton] {
        ends_at_the_limit(Sigma { solver, ..Sigma::midpoint() }, d, limit)?;
        // The same method.
        ends_at_the_limit(Gauss { solver, ..Gauss::<1>::new() }, d, limit)?;
    }
    Ok(())
}

fn ends_at_the_limit<M: Method<PointVortices<2>, f64> + Copy>(method: M, d: f64, limit: f64) -> Outcome {
    let (system, start) = pair(d);
    let mut run = Integrator::new(&system, method, 0.9 * limit, start)?;
    run.take_steps(100)?;
    let (run, error) = failing(&system, method, 1.1 * limit, start)?;
    let StepFailure::NotConverged { iterations, correction, tolerance } = error.failure else {
        return Err(error.into());
    };
    assert!(iterations > 0 && correction > tolerance && tolerance > 0.0, "{error}");
    assert_eq!((run.steps(), run.state()), (0, start));
    Ok(())
}

/// Ω = x: the motion x² = 1 − 2t ends at x = 0.
#[dvi_core::degenerate_lagrangian(
    coordinates(x, y),
    one_form    = x * x / 2.0 * d(y),
    hamiltonian = y,
)]
#[derive(Clone, Debug)]
struct Vanishing;

/// The same beside an oscillator, with a form that couples all coordinates.
#[dvi_core::degenerate_lagrangian(
    coordinates(x, y, u, w),
    one_form    = [0.1 * u, x * x / 2.0 + 0.1 * w, 0.1 * y, u],
    hamiltonian = y + (u * u + w * w) / 2.0,
)]
#[derive(Clone, Debug)]
struct Coupled;

fn crossing<S: DegenerateLagrangian, M: dvi_core::methods::Method<S, f64> + core::fmt::Debug>(
    system: &S,
    method: M,
    h: f64,
    start: S::State<f64>,
) -> Outcome {
    let name = format!("{method:?}");
    let (run, error) = failing(system, method, h, start)?;
    assert!(run.q()[0] > 0.0, "{name}: {:?}", run.q());
    let StepFailure::Orientation { matrix: "Ω", before, after } = error.failure else {
        return Err(format!("{name}: {error}").into());
    };
    assert!(before * after < 0.0, "{name}: {error}");
    Ok(())
}

#[test]
fn a_step_over_a_place_where_the_form_is_singular_is_an_error() -> Outcome {
    let start = VanishingState { x: 1.0, y: 0.0 };
    for h in [0.3, 0.07, 0.03] {
        crossing(&Vanishing, RungeKutta::midpoint(), h, start)?;
        crossing(&Vanishing, RungeKutta::classical(), h, start)?;
        let start = CoupledState { x: 1.0, y: 0.0, u: 0.3, w: 0.1 };
        crossing(&Coupled, RungeKutta::classical(), h, start)?;
    }
    Ok(())
}

/// From rest at the origin all numbers are zero but the force; the first correction says how large they
/// become.
#[test]
fn steps_from_rest_at_the_origin_succeed() -> Outcome {
    #[lagrangian(coordinates(x), lagrangian = (dot(x).powi(2) - x * x) / 2.0 - x.powi(4) / 4.0 + g * x)]
    struct Weight {
        g: f64,
    }
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = x * d(y),
        hamiltonian = ((x - g).powi(2) + (y + g).powi(2)) / 2.0 + x.powi(3)
    )]
    struct Shifted {
        g: f64,
    }
    fn succeeds<S: Lagrangian, M: dvi_core::methods::Method<S, f64> + core::fmt::Debug>(
        system: &S,
        method: M,
        start: S::State<f64>,
        h: f64,
    ) -> Outcome {
        let name = format!("{method:?}, h = {h}");
        let mut run = Integrator::new(system, method, h, start)?;
        let energy = run.energy();
        run.take_steps(3).map_err(|error| format!("{name}: {error}"))?;
        let moved = run.q().iter().fold(0.0, |m: f64, q| dvi_tests::larger(m, q.abs()));
        let change = (run.energy() - energy).abs();
        // Of the square of what has moved, which the kinetic energy is at least.
        assert!(moved > h * h && change < 0.01 * moved * moved / (h * h), "{name}: {moved:e} {change:e}");
        Ok(())
    }
    for g in 1..=10 {
        let g = 0.3 * f64::from(g);
        for h in [0.01, 0.03, 0.05, 0.1, 0.2] {
            let (system, start) = (Weight { g }, WeightState { x: 0.0, dot_x: 0.0 });
            for solver in [Solver::Automatic, Solver::Newton] {
                succeeds(&system, Variational { solver, ..Variational::midpoint() }, start, h)?;
                succeeds(&system, Galerkin { solver, ..Galerkin::<3>::new() }, start, h)?;
                succeeds(&system, Newmark { solver, ..Newmark::new(0.25) }, start, h)?;
                let (system, start) = (Shifted { g }, ShiftedState { x: 0.0, y: 0.0 });
                succeeds(&system, Sigma { solver, ..Sigma::midpoint() }, start, h)?;
            }
        }
    }
    Ok(())
}

/// A fall into the centre: whether states in between were asked for before makes no difference.
#[test]
fn states_within_the_last_good_step_are_known_after_a_failure() -> Outcome {
    fn check<R: Run<System = Kepler, Scalar = f64>>(begun: impl Fn() -> Outcome<R>) -> Outcome {
        let (mut asked, mut last) = (Dense::new(begun()?)?, None);
        loop {
            let begun = asked.time();
            if asked.advance().is_err() {
                break;
            }
            let t = 0.5 * (begun + asked.time());
            last = Some((t, asked.state_at(t)?));
        }
        let (t, state) = last.ok_or("no step was taken")?;
        let mut silent = Dense::new(begun()?)?;
        while silent.advance().is_ok() {}
        assert!(asked.steps() > 5 && silent.steps() == asked.steps());
        assert_eq!((asked.state_at(t)?, silent.state_at(t)?), (state, state));
        Ok(())
    }
    let (kepler, start) = (Kepler { mu: 1.0 }, KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.0 });
    check(|| {
        Ok(Integrator::controlled(kepler.clone(), Gauss::<8>::new(), ErrorControl::new(1e-9, 0.1), start)?)
    })?;
    let method = EnergyLimit { method: Variational::midpoint(), limit: 0.1 };
    check(|| Ok(Integrator::new(kepler.clone(), method, 0.02, start)?))
}
