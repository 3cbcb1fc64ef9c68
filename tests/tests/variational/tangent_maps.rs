//! Tangent maps of steps against the steps in dual numbers, and exponents of runs on regular systems.

use super::Outcome;
use approx::assert_abs_diff_eq;
use dvi_core::Space;
use dvi_core::discrete::Interval;
use dvi_core::prelude::*;
use dvi_tests::laws::formula::dual;
use dvi_tests::laws::systems::{Damped, Magnetic};
use dvi_tests::zoo::regular::RunTimeChain;
use dvi_tests::{larger, state};
use num_dual::Dual64;

use crate::pages::{Pendulum, PendulumState};

/// By how far the map of a step in (q, p) is off the derivative of the step, and by how much it changes
/// dq ∧ dp.
fn check<S>(system: &S, rule: Quadrature, [q, v]: [&[f64]; 2]) -> Outcome<[f64; 2]>
where
    S: RegularLagrangian + RegularLagrangian<Dual64>,
{
    let (t, h, n, method) = (0.4, 0.07, q.len(), Variational::new(rule));
    let mut run = Integrator::new_at(system, method, t, h, state(system, q, v))?;
    run.advance()?;
    let mut map = TangentMap::new(system, &method);
    map.evaluate(system, Interval { t, h }, q, run.q())?;
    let mut off = 0.0;
    for column in 0..2 * n {
        let start = dual(&[q, v].concat(), Some(column));
        let start = state(system, &start[..n], &start[n..]);
        let mut run = Integrator::new_at(system, method, Dual64::from(t), Dual64::from(h), start)?;
        let mut vectors = [system.space().vector(), system.space().vector()];
        for i in 0..n {
            (vectors[0][i], vectors[1][i]) = (run.q()[i].eps, run.memory().p()[i].eps);
        }
        run.advance()?;
        let [dq, dp] = &mut vectors;
        map.apply(dq, dp);
        let expected = run.q().iter().chain(run.memory().p());
        for (found, expected) in dq.iter().chain(dp.iter()).zip(expected) {
            off = larger(off, (found - expected.eps).abs() / larger(1.0, expected.eps.abs()));
        }
    }
    Ok([off, map.symplectic_defect(system)])
}

/// Masses that depend on the place and on time, a size that the run knows, and friction, which takes volume
/// from the phase space.
#[test]
fn tangent_maps_are_derivatives_of_steps() -> Outcome {
    let chain = RunTimeChain { mass: vec![1.0, 2.0, 1.5], coupling: 0.2 };
    for rule in
        [Quadrature::sigma(0.4), Quadrature::lobatto(2)?, Quadrature::lobatto(3)?, Quadrature::gauss(3)?]
    {
        for [off, defect] in [
            check(&Magnetic { b: 0.7 }, rule, [&[0.5, 0.2], &[0.4, -0.7]])?,
            check(&chain, rule, [&[0.1, -0.2, 0.3, 0.0], &[0.5, 0.1, -0.4, 0.2]])?,
        ] {
            assert!(off < 1e-12 && defect < 1e-12, "{rule:?}: {off:e} {defect:e}");
        }
        let [off, defect] = check(&Damped { gamma: 0.3 }, rule, [&[1.2, 0.0], &[0.1, 0.9]])?;
        assert!(off < 1e-12 && defect > 1e-3, "{rule:?}: {off:e} {defect:e}");
    }
    Ok(())
}

#[test]
fn an_unstable_equilibrium_has_its_own_exponent() -> Outcome {
    // Störmer–Verlet on a'' = a: 2 cosh(λh) = 2 + h².
    let (h, start) = (0.1_f64, PendulumState { angle: core::f64::consts::PI, dot_angle: 0.0 });
    let pendulum = Pendulum { g: 1.0, length: 1.0 };
    let mut run = Integrator::new(&pendulum, Variational::trapezoid(), h, start)?;
    let mut lyapunov = LyapunovExponent::new(&run);
    let mut settled = 0.0;
    for step in 0..250 {
        lyapunov.advance(&mut run)?;
        if step == 149 {
            settled = lyapunov.growth();
        }
    }
    let rate = (lyapunov.growth() - settled) / (100.0 * h);
    let exact = (1.0 + h * h / 2.0).acosh() / h;
    assert_abs_diff_eq!(rate, exact, epsilon = 1e-9);
    Ok(())
}
