//! A run ends where its energy goes astray.

use dvi_core::prelude::*;
use dvi_tests::systems::*;
use dvi_tests::zoo::regular::{Kepler, KeplerState};
use dvi_tests::{Outcome, failing};

/// The run ends at the state of the last step within the limit, which is that of a run without one, bit by
/// bit.
fn ends<S: Lagrangian, M: Method<S, f64> + Copy>(
    system: &S,
    method: M,
    [limit, h]: [f64; 2],
    start: S::State<f64>,
) -> Outcome {
    let (run, error) = failing(system, EnergyLimit { method, limit }, h, start.clone())?;
    let mut same = Integrator::new(system, method, h, start)?;
    let begin = same.energy();
    same.take_steps(error.step)?;
    assert!(error.step > 3 && (same.energy() - begin).abs() <= limit);
    assert_eq!((run.q(), &run.v()[..], run.energy()), (same.q(), &same.v()[..], same.energy()));
    same.advance()?;
    let now = same.energy();
    assert!((now - begin).abs() > limit);
    assert_eq!(error.failure, StepFailure::Energy { start: begin, now, limit });
    Ok(())
}

#[test]
fn a_limit_of_the_energy_error_ends_any_run() -> Outcome {
    let leapfrog = Sigma { parasitic_limit: None, ..Sigma::leapfrog() };
    ends(&Oscillator { omega: 1.0 }, leapfrog, [10.0, 1.05], OscillatorState { x: 1.0, y: 0.0 })?;
    // Verlet steps over the centre of a head-on orbit.
    let (kepler, start) = (Kepler { mu: 1.0 }, KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.0 });
    ends(&kepler, Variational::trapezoid(), [0.1, 0.01], start)
}
