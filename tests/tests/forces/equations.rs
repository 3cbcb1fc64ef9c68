//! What follows from the discrete equations of Lagrange and d'Alembert.

use approx::abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::state;

use super::Outcome;
use dvi_tests::laws::systems::{Canonical, Damped, Harvested, Pulled};

const DAMPED: Damped = Damped { gamma: 0.3 };
const START: [f64; 4] = [1.2, 0.0, 0.1, 0.9];

/// The integral of the power is of order four in the step.
#[test]
fn the_energy_changes_by_the_work_of_the_forces() -> Outcome {
    fn balance<S, M>(system: &S, method: M, [q, v]: [&[f64]; 2], steps: u64) -> Outcome<f64>
    where
        S: Lagrangian + System<Kind: dvi_core::mechanics::Rates<S, f64> + dvi_core::system::Smooth>,
        M: Method<S, f64>,
    {
        let mut run = Integrator::new(system, method, 2.0 / steps as f64, state(system, q, v))?;
        let (begin, mut work) = (run.energy(), Work::new(&run));
        for _ in 0..steps {
            run.advance()?;
            work.record(&run);
        }
        Ok((run.energy() - begin - work.total()).abs())
    }
    let mut errors = Vec::new();
    for steps in [160, 240, 320, 480] {
        errors.push((
            2.0 / steps as f64,
            balance(&DAMPED, Galerkin::<5>::new(), [&START[..2], &START[2..]], steps)?,
        ));
    }
    let order = convergence_order(&errors).ok_or("no slope")?;
    assert!(abs_diff_eq!(order, 4.0, epsilon = 0.3), "{order}: {errors:?}");
    let dragged: [&[f64]; 2] = [&[0.3, -0.2, 0.5], &[0.4, 0.6, 0.7]];
    assert!(balance(&Pulled { drag: [0.5, 0.8] }, Galerkin::<4>::new(), dragged, 200)? < 1e-8);
    let canonical = Canonical { n: 1, k: 1.0, gamma: 0.2 };
    assert!(balance(&canonical, OneStepGauss::<3>::new(), [&[1.0, 0.4], &[]], 200)? < 1e-8);
    assert!(balance(&Harvested { harvest: 0.1 }, Gauss::<3>::new(), [&[1.4, 1.7], &[]], 200)? < 1e-8);
    Ok(())
}
