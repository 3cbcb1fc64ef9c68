//! Long runs of one-step schemes on Lotka–Volterra, where the two-step midpoint fails (reference numbers of an independent
//! program).

use dvi_core::methods::Method;
use dvi_core::prelude::*;
use dvi_tests::larger;
use dvi_tests::systems::{LotkaVolterra, LotkaVolterraState};
use dvi_tests::zoo::gauges::{OneSided, OneSidedState};

type Outcome = Result<(), Box<dyn core::error::Error>>;

const PREY: OneSided = OneSided { a: [1.0, 1.0], b: [-1.0, -2.0] };

/// The largest energy error within the first thousand steps and within all.
fn errors<M: Method<OneSided, f64>>(method: M, h: f64, steps: u64) -> Result<[f64; 2], StepError> {
    let start = OneSidedState { x: 2.0, y: 1.0 };
    let mut run = Integrator::new(&PREY, method, h, start).expect("starts");
    let (energy, mut largest, mut early) = (run.energy(), 0.0, 0.0);
    for step in 0..steps {
        run.advance()?;
        largest = larger(largest, (run.energy() - energy).abs());
        if step == 1000 {
            early = largest;
        }
    }
    Ok([early, largest])
}

#[test]
fn energy_is_flat_for_a_million_steps() -> Outcome {
    // Of the midpoint scheme an independent program has 1.04e-2 and 2.56e-3.
    for (h, expected) in [(0.1, 1.04e-2), (0.05, 2.56e-3)] {
        let [early, all] = errors(OneStep::midpoint(), h, 1_000_000)?;
        assert!((all / expected - 1.0).abs() < 2e-3, "h = {h}: {all:e}");
        assert!(all < 1.001 * early, "h = {h}: {early:e} and {all:e}");
    }
    for [early, all] in [
        errors(OneStep::trapezoid(), 0.1, 1_000_000)?,
        errors(OneStep::scheme_a(), 0.05, 1_000_000)?,
        errors(OneStep::scheme_b(), 0.05, 1_000_000)?,
        errors(OneStepGauss::<2>::new(), 0.1, 1_000_000)?,
    ] {
        assert!(all < 1.001 * early, "{early:e} and {all:e}");
    }
    Ok(())
}

/// In the symmetric gauge the same motion has no one-step scheme, and the two-step one loses it. Its parasitic mode is seen
/// before.
#[test]
fn the_two_step_midpoint_fails_and_says_so() -> Outcome {
    let system = LotkaVolterra { a: PREY.a, b: PREY.b };
    let start: LotkaVolterraState = LotkaVolterraState { x: 2.0, y: 1.0 };
    let unwatched = Sigma { parasitic_limit: None, ..Sigma::midpoint() };
    let failed =
        Integrator::new(&system, unwatched, 0.1, start)?.take_steps(1000).err().ok_or("no failure")?;
    let seen = Integrator::new(&system, Sigma::midpoint(), 0.1, start)?.take_steps(1000).err();
    let seen = seen.ok_or("not seen")?;
    assert!(failed.step < 120, "{failed}");
    assert!(matches!(seen.failure, StepFailure::ParasiticMode { .. }), "{seen}");
    assert!(seen.step < failed.step, "{seen}, and {failed}");
    Ok(())
}
