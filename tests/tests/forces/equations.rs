//! What follows from the discrete equations of Lagrange and d'Alembert.

use approx::abs_diff_eq;
use dvi_core::Space;
use dvi_core::discrete::Interval;
use dvi_core::methods::{Method, VariationalMethod};
use dvi_core::prelude::*;
use dvi_tests::state;
use nalgebra::{Matrix4, Vector4};
use num_dual::Dual64;

use super::Outcome;
use dvi_tests::laws::systems::{Canonical, Damped, Harvested, Pulled};

const DAMPED: Damped = Damped { gamma: 0.3 };
const START: [f64; 4] = [1.2, 0.0, 0.1, 0.9];
const H: f64 = 0.05;

/// The tangent map of a step in (q, p), where p = v, by the second derivatives of the discrete Lagrangian
/// and the derivatives of the forces, against the step in dual numbers. Returns by how much it changes dq ∧
/// dp.
fn tangent_map_is_right<S, M>(system: &S, method: M) -> Outcome<f64>
where
    S: RegularLagrangian + RegularLagrangian<Dual64>,
    M: Method<S, f64> + Method<S, Dual64> + Clone,
    M: VariationalMethod<S, f64>,
{
    let mut by_hand = Matrix4::zeros();
    for column in 0..4 {
        let start: [Dual64; 4] =
            core::array::from_fn(|i| Dual64::new(START[i], if i == column { 1.0 } else { 0.0 }));
        let start = state(system, &start[..2], &start[2..]);
        let mut run = Integrator::new(system, method.clone(), Dual64::from(H), start)?;
        run.advance()?;
        let end: Vec<f64> = run.q().iter().chain(run.v().iter()).map(|x| x.eps).collect();
        by_hand.set_column(column, &Vector4::from_vec(end));
    }
    let mut run = Integrator::new(system, method.clone(), H, state(system, &START[..2], &START[2..]))?;
    run.advance()?;
    let mut map = TangentMap::new(system, &method);
    map.evaluate(system, Interval { t: 0.0, h: H }, &START[..2], run.q())?;
    for column in 0..4 {
        let mut vectors = [system.space().vector(), system.space().vector()];
        vectors[column / 2][column % 2] = 1.0;
        let [dq, dp] = &mut vectors;
        map.apply(dq, dp);
        for (row, found) in dq.iter().chain(dp.iter()).enumerate() {
            let error = (found - by_hand[(row, column)]).abs();
            assert!(error < 1e-12, "({row}, {column}): {error:e}");
        }
    }
    Ok(map.symplectic_defect(system))
}

/// Friction takes volume from the phase space.
#[test]
fn tangent_maps_hold_the_derivatives_of_the_forces() -> Outcome {
    for lost in [
        tangent_map_is_right(&DAMPED, Variational::midpoint())?,
        tangent_map_is_right(&DAMPED, Variational::new(Quadrature::gauss(2)?))?,
        tangent_map_is_right(&DAMPED, Variational::new(Quadrature::sigma(0.3)))?,
    ] {
        assert!(lost > 1e-3, "{lost:e}");
    }
    Ok(())
}

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
