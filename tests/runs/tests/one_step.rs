//! One-step schemes in many steps: one-forms with several branches; momenta that are rounded more than
//! coordinates.

use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::zoo::gauges::{OneSided, OneSidedState};

const PREY: OneSided = OneSided { a: [1.0, 1.0], b: [-1.0, -2.0] };

/// ϑ = y³ − y has three branches, which end where y² = 1/3.
#[degenerate_lagrangian(coordinates(x, y), one_form = (y.powi(3) - y) * d(x), hamiltonian = x + y * y / 2.0)]
struct Fold;

/// Towards the end of a branch a run ends with an error, whatever the step; away from it the run goes on.
#[test]
fn no_step_changes_the_branch() -> Outcome {
    fn check<M: Method<Fold, f64> + Copy>(method: M) -> Outcome {
        for k in 1..=200 {
            let (h, start) = (f64::from(k) * 5e-4, FoldState { x: 0.0, y: 0.9 });
            let mut run = Integrator::new(&Fold, method, h, start)?;
            let ended = run.take_steps((1.0 / h) as u64 + 1).err();
            assert!(ended.is_some() && run.state().y > 0.5, "h = {h}: {:?}, {ended:?}", run.state());
        }
        for k in 0..100 {
            let start = FoldState { x: 0.2, y: 0.58 + 0.003 * f64::from(k) };
            for h in [-0.001, -0.003, -0.01, -0.03] {
                let mut run = Integrator::new(&Fold, method, h, start)?;
                // It may not find the first steps so close to the fold, but it never lands elsewhere.
                let _ = run.take_steps(20);
                assert!(run.state().y > 0.57, "h = {h}, {start:?}: {:?}", run.state());
            }
        }
        Ok(())
    }
    check(OneStep::midpoint())?;
    check(OneStep::trapezoid())?;
    check(OneStepGauss::<1>::new())?;
    check(OneStepGauss::<2>::new())?;
    check(OneStepGauss::<4>::new())
}

/// A constant added to ϑ changes no motion, but momenta are then rounded more than coordinates.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = (y + y.powi(3) / 5.0 + c) * d(x),
    hamiltonian = (x * x + y * y) / 2.0,
)]
struct Shifted {
    c: f64,
}

#[test]
fn rounding_of_momenta_ends_no_run() -> Outcome {
    fn check<M: Method<Shifted, f64> + Method<OneSided, f64> + Copy>(method: M) -> Outcome {
        for c in [1.0, 10.0, 1e3, 1e6] {
            let system = Shifted { c };
            for size in [1.0, 1e-3] {
                let start = ShiftedState { x: 0.3 * size, y: 0.4 * size };
                let mut run = Integrator::new(&system, method, 0.1, start)?;
                run.take_steps(2000).map_err(|error| format!("c = {c}, size {size}: {error}"))?;
            }
        }
        let start = OneSidedState { x: 0.1, y: 0.1 };
        for h in [0.01, 0.0106, 0.0118] {
            Integrator::new(&PREY, method, h, start)?
                .take_steps(20_000)
                .map_err(|error| format!("h = {h}: {error}"))?;
        }
        Ok(())
    }
    check(OneStep::midpoint())?;
    check(OneStep::trapezoid())?;
    check(OneStepGauss::<2>::new())?;
    check(OneStepGauss::<3>::new())?;
    check(OneStepGauss::<4>::new())
}
