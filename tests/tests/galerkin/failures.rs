//! Failures are values, and the last good state is kept.

use core::f64::consts::PI;
use dvi_core::discrete::FrequencyIn;
use dvi_core::prelude::*;
use dvi_tests::failing;
use dvi_tests::zoo::regular::*;

use super::Outcome;
use super::systems::{double_pendulum, relativistic};

#[test]
fn what_cannot_be_done_is_refused() {
    fn refused<S: RegularLagrangian, F: FrequencyIn<f64>>(
        (system, start): (S, S::State<f64>),
        method: Galerkin<3, F>,
        expected: &str,
    ) {
        let failure = Integrator::new(&system, method, 0.1, start).err();
        assert!(
            matches!(failure, Some(StartError::Unsupported { option, .. }) if option == expected),
            "{expected}: {failure:?}"
        );
    }
    let method = Galerkin::<3>::new();
    let kepler = || (KEPLER, pericentre(0.3));
    for reading in [Reading::LeftFrozen, Reading::Variational] {
        refused(kepler(), method.phase_fitted(Radial(reading)), "this reading of the frequency");
    }
    refused(
        double_pendulum(),
        method.phase_fitted(Radial(Reading::Averaged)),
        "a frequency read from the motion",
    );
    refused(double_pendulum(), Galerkin { solver: Solver::FixedPoint, ..method }, "Solver::FixedPoint");
    let resonant = method.phase_fitted(Constant(PI));
    let failure = Integrator::new(&KEPLER, resonant, 1.0, pericentre(0.3)).err();
    assert!(matches!(failure, Some(StartError::Starter(StepFailure::Resonance { .. }))), "{failure:?}");
    let failure = Integrator::new(&KEPLER, method.phase_fitted(Constant(-1.0)), 1.0, pericentre(0.3)).err();
    assert!(matches!(failure, Some(StartError::Parameter { name: "omega", .. })), "{failure:?}");
    let collision = KeplerState { x: 0.0, y: 0.0, dot_x: 1.0, dot_y: 0.0 };
    let failure = Integrator::new(&KEPLER, method, 0.1, collision).err();
    assert!(
        matches!(failure, Some(StartError::Undefined { quantity: "the force ∂L/∂q", coordinate: Some(x), value })
            if x.to_string() == "x" && value.is_nan()),
        "{failure:?}"
    );
}

#[test]
fn failures_are_values_and_keep_the_last_good_state() -> Outcome {
    let method = Galerkin::<4>::new();
    // At the pole the angle φ has no momentum.
    let pole = SphericalPendulumState { theta: 0.0, phi: 0.3, dot_theta: 0.0, dot_phi: 0.8 };
    let found = Integrator::new(&SphericalPendulum { g: 1.0 }, method, 0.1, pole).err();
    assert!(
        matches!(found, Some(StartError::Singular { matrix: "the mass matrix", entry, .. })
            if entry.to_string() == "phi"),
        "{found:?}"
    );
    // Far beyond the speed of light in the first iterate.
    let ((relativistic, start), (pendulum, begin)) = (relativistic(), double_pendulum());
    let (_, error) = failing(&relativistic, method, 50.0, start)?;
    assert!(matches!(error.failure, StepFailure::NotFinite { .. }), "{error:?}");
    let stopping = Stopping { max_iterations: 2, ..Stopping::default() };
    for solver in [Solver::FixedPoint, Solver::Automatic] {
        let (_, error) = failing(&KEPLER, Galerkin { solver, stopping, ..method }, 0.5, pericentre(0.3))?;
        assert!(
            matches!(error.failure, StepFailure::NotConverged { iterations: 2, .. }),
            "{solver:?}: {error:?}"
        );
    }
    let (_, error) = failing(&pendulum, Galerkin { stopping, ..method }, 0.1, begin)?;
    assert!(matches!(error.failure, StepFailure::NotConverged { iterations: 2, .. }), "{error:?}");
    Ok(())
}
