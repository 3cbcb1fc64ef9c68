//! Failures are values, and the last good state is kept.

use super::Outcome;
use approx::abs_diff_eq;
use dvi_core::discrete::Frequency;
use dvi_core::prelude::*;
use dvi_core::{Real, Scalar};
use dvi_tests::zoo::regular::*;
use dvi_tests::{failing, refused_option};

fn state(x: f64, dot_y: f64) -> KeplerState {
    KeplerState { x, y: 0.0, dot_x: 0.0, dot_y }
}

#[test]
fn starts_that_are_none_are_refused() {
    let error = Integrator::new(&KEPLER, Variational::trapezoid(), 0.1, state(1.0, f64::NAN)).err();
    assert!(
        matches!(error, Some(StartError::NotFinite { entry, .. }) if entry.to_string() == "dot_y"),
        "{error:?}"
    );
    let collided = Integrator::new(&KEPLER, Variational::simpson(), 0.1, state(0.0, 1.0)).err();
    let message = collided.map(|error| error.to_string()).unwrap_or_default();
    assert!(message.starts_with("the force ∂L/∂q along `x` is NaN at the initial state: "), "{message}");
    for omega in [-1.0, f64::NAN, f64::INFINITY] {
        let method = Variational::simpson().phase_fitted(Constant(omega));
        assert_eq!(refused_option(Integrator::new(&KEPLER, method, 0.1, state(1.0, 1.0))), "omega");
    }
    let outside = Integrator::new(&KEPLER, Variational::sigma(1.5), 0.1, state(1.0, 1.0)).err();
    assert!(matches!(outside, Some(StartError::Parameter { name: "node", value: 1.5, .. })), "{outside:?}");
}

#[test]
fn options_that_do_not_go_together_are_refused() {
    let pendulums = DoublePendulum { mass: [1.0, 0.7], length: [1.0, 0.8], g: 1.0 };
    let start = DoublePendulumState { a: 1.0, b: 0.5, dot_a: 0.0, dot_b: 0.0 };
    let unsupported = |error: Option<StartError>| matches!(error, Some(StartError::Unsupported { .. }));
    let fitted = Variational::simpson().phase_fitted(Radial(Reading::Averaged));
    assert!(unsupported(Integrator::new(&pendulums, fitted, 0.1, start).err()));
    let fixed = Variational { solver: Solver::FixedPoint, ..Variational::simpson() };
    assert!(unsupported(Integrator::new(&pendulums, fixed, 0.1, start).err()));
    let fitting = Fitting::PhaseAndMomentum;
    let both = Variational { fitting, ..Variational::simpson() }.phase_fitted(Radial(Reading::Variational));
    assert!(unsupported(Integrator::new(&KEPLER, both, 0.1, state(1.0, 1.0)).err()));
}

/// Symmetric data meet at the origin after one step of 1.
#[test]
fn a_collision_ends_the_run_at_the_last_good_state() -> Outcome {
    // x = 1, F = −1: p½ = −½ + p, and with p = −½ the first step arrives at 0.
    let start = KeplerState { x: 1.0, y: 0.0, dot_x: -0.5, dot_y: 0.0 };
    for count in [1, 10] {
        let mut run = Integrator::new(&KEPLER, Variational::trapezoid(), 1.0, start)?;
        let error = run.take_steps(count).err();
        assert!(
            matches!(error, Some(StepError { step: 0, failure: StepFailure::NotFinite { .. }, .. })),
            "{error:?}"
        );
        assert_eq!((run.q(), run.memory().p()), ([1.0, 0.0].as_slice(), [-0.5, 0.0].as_slice()));
    }
    Ok(())
}

#[test]
fn a_step_over_half_a_turn_of_the_motion_is_refused() -> Outcome {
    for (reading, rule) in
        [(Reading::LeftFrozen, Quadrature::lobatto(3)?), (Reading::Averaged, Quadrature::lobatto(4)?)]
    {
        let method = Variational::new(rule).phase_fitted(Radial(reading));
        // The frequency of the circular orbit is one.
        let (run, error) = failing(&KEPLER, method, 3.5, state(1.0, 1.0))?;
        let StepFailure::Resonance { u, .. } = error.failure else { return Err(error.into()) };
        assert!(run.steps() == 0 && u >= core::f64::consts::PI, "{u}");
    }
    Ok(())
}

/// A frequency that is defined where x > 0.9 only.
#[derive(Clone, Copy, Debug)]
struct Partial(Reading);

impl Frequency for Partial {
    fn reading(&self) -> Option<Reading> {
        Some(self.0)
    }

    fn at<T: Real>(&self, q: &[T], _v: &[T], _a: &[T]) -> T {
        Scalar::sqrt(q[0] - T::lift(0.9))
    }

    fn derivatives<T: Real>(&self, [q, v, a]: [&[T]; 3], [dq, dv, da]: [&mut [T]; 3]) -> Option<T> {
        let (omega, zero) = (self.at(q, v, a), T::lift(0.0));
        dq.copy_from_slice(&[T::lift(0.5) / omega, zero]);
        dv.fill(zero);
        da.fill(zero);
        Some(omega)
    }
}

#[test]
fn a_frequency_that_is_not_defined_is_an_error_of_its_own() -> Outcome {
    fn check<M: Method<Kepler, f64>>(method: M) -> Outcome {
        let (run, error) = failing(&KEPLER, method, 0.05, state(1.0, 1.0))?;
        assert!(run.q()[0] > 0.85 && run.steps() > 3, "{error}");
        assert!(matches!(error.failure, StepFailure::Frequency { omega } if omega.is_nan()), "{error}");
        Ok(())
    }
    for reading in [Reading::LeftFrozen, Reading::Averaged, Reading::Variational] {
        check(Variational::simpson().phase_fitted(Partial(reading)))?;
    }
    check(Galerkin::<3>::new().phase_fitted(Partial(Reading::Averaged)))
}

/// A relativistic particle at nearly the speed of light: p = v/√(1 − v²) leads Newton's method beyond it.
#[test]
fn momenta_of_a_bounded_velocity_have_one() -> Outcome {
    for (h, v) in [(0.5, 0.99), (0.5, 0.9), (0.2, 0.99)] {
        let start = FastState { x: 0.0, dot_x: v };
        let mut run = Integrator::new(&Fast, Variational::midpoint(), h, start)?;
        for _ in 0..40 {
            if run.advance().is_err() {
                break;
            }
            let p: f64 = run.memory().p()[0];
            let (found, exact): (f64, f64) = (run.state().dot_x, p / (1.0 + p * p).sqrt());
            let step = run.steps();
            assert!(abs_diff_eq!(found, exact, epsilon = 1e-12), "h = {h}, step {step}: {found} {exact}");
        }
        assert!(run.steps() >= 5, "h = {h}: {} steps", run.steps());
    }
    Ok(())
}

#[lagrangian(coordinates(x), lagrangian = -(1.0 - dot(x).powi(2)).sqrt() - x * x / 2.0)]
#[derive(Clone, Debug)]
pub(crate) struct Fast;
