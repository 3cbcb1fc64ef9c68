//! What is refused.

use core::f64::consts::PI;
use dvi_core::discrete::Frequency;
use dvi_core::prelude::*;
use dvi_tests::zoo::regular::*;

use super::systems::double_pendulum;

#[test]
fn what_cannot_be_done_is_refused() {
    fn refused<S: RegularLagrangian, F: Frequency>(
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
