//! Projected schemes in many steps, on the guiding centre in a magnetic mirror.

use dvi_core::prelude::*;
use dvi_tests::larger;
use dvi_tests::zoo::particles::{Mirror, MirrorState};

/// The largest energy error within the first tenth of the steps, and within all.
fn errors(method: Projected, steps: u64) -> Result<[f64; 2], StepError> {
    let start: MirrorState = MirrorState { x: 0.4, y: 0.3, z: 0.2, u: 0.5 };
    let mut run = Integrator::new(&Mirror, method, 0.1, start).expect("starts");
    let (energy, mut largest, mut early) = (run.energy(), 0.0, 0.0);
    for step in 0..steps {
        run.advance()?;
        largest = larger(largest, (run.energy() - energy).abs());
        if step == steps / 10 {
            early = largest;
        }
    }
    Ok([early, largest])
}

#[test]
fn the_symmetric_projection_keeps_the_energy_and_the_standard_one_does_not() -> Result<(), StepError> {
    let [early, all] = errors(Projected::symmetric(), 200_000)?;
    assert!(all < 1.01 * early, "{early:e} and {all:e}");
    let [early, all] = errors(Projected::standard(), 200_000)?;
    assert!(all > 8.0 * early, "{early:e} and {all:e}");
    Ok(())
}
