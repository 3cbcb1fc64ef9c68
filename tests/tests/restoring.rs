//! A run ends where its energy goes astray.

use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::systems::*;
use dvi_tests::zoo::regular::{Kepler, KeplerState};

const KEPLER: Kepler = Kepler { mu: 1.0 };

/// The run ends at the state of the last step within the limit, which is that of a run without one, bit by
/// bit.
#[test]
fn a_limit_of_the_energy_error_ends_any_run() -> Outcome {
    let method = Sigma { parasitic_limit: None, ..Sigma::leapfrog() };
    let start = ObliqueState { x: 1.0, y: 0.0 };
    let mut run = Integrator::new(&Oblique, EnergyLimit { method, limit: 0.01 }, 0.1, start)?;
    let error = run.take_steps(1000).err();
    let Some(StepError { step, failure: StepFailure::Energy { start: 0.5, now, limit: 0.01 }, .. }) = error
    else {
        return Err(format!("{error:?}").into());
    };
    let mut same = Integrator::new(&Oblique, method, 0.1, start)?;
    same.take_steps(step)?;
    assert!(step > 3);
    assert_eq!((run.steps(), run.q(), run.energy()), (step, same.q(), same.energy()));
    assert_eq!(run.memory().inner().defect(), same.memory().defect());
    same.advance()?;
    assert_eq!(now, same.energy());
    assert_eq!(run.advance().err(), error);

    // β = 0 is Verlet, which steps over the centre of a head-on orbit.
    let start = KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.0 };
    let limited = EnergyLimit { method: Newmark::new(0.0), limit: 0.1 };
    let error = Integrator::new(&KEPLER, limited, 0.01, start)?.take_steps(300).err();
    assert!(
        matches!(error, Some(StepError { failure: StepFailure::Energy { start: -1.0, .. }, .. })),
        "{error:?}"
    );
    Ok(())
}
