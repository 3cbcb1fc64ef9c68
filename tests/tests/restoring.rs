//! A run goes on from a copy of what another one carries, bit by bit, and ends where its energy goes astray.

use dvi_core::methods::Method;
use dvi_core::prelude::*;
use dvi_core::state::{Memory, Statistics};
use dvi_core::{Lagrangian, Space};
use dvi_tests::bits;
use dvi_tests::configurations::quasi_periodic;
use dvi_tests::systems::*;
use dvi_tests::zoo::gauges::OneSided;
use dvi_tests::zoo::regular::{Kepler, KeplerState};

type Outcome = Result<(), Box<dyn core::error::Error>>;

const KEPLER: Kepler = Kepler { mu: 1.0 };

/// A mass that depends on the place.
#[lagrangian(
    coordinates(r, phi),
    lagrangian = (dot(r).powi(2) + r * r * dot(phi).powi(2)) / 2.0 + 1.0 / r,
)]
#[derive(Clone, Debug)]
struct Polar;

/// Restores the memory of a run, made another way, from one that has taken `before` steps, and goes on with
/// both.
fn check<S: Lagrangian, M: Method<S, f64>>(system: &S, method: M, q0: &[f64], v0: &[f64]) -> Outcome {
    let (h, t) = (0.05, 0.3);
    for before in [0, 1, 3, 40] {
        let mut q = system.space().vector();
        q.copy_from_slice(q0);
        let mut statistics = Statistics::default();
        let mut kept = method.begin(system, &q, v0, t, h)?;
        let mut other = method.begin(system, &q, v0, t, h)?;
        let mut elsewhere = q.clone();
        for step in 0..17 {
            method.step(system, &mut other, &mut elsewhere, t + f64::from(step) * h, h, &mut statistics)?;
        }
        for step in 0..before {
            method.step(system, &mut kept, &mut q, t + f64::from(step) * h, h, &mut statistics)?;
        }
        other.restore(&kept);
        let mut same = q.clone();
        for step in before..before + 20 {
            let now = t + f64::from(step) * h;
            method.step(system, &mut kept, &mut q, now, h, &mut statistics)?;
            method.step(system, &mut other, &mut same, now, h, &mut statistics)?;
            assert_eq!(bits(&q), bits(&same), "step {step} after {before}");
        }
    }
    Ok(())
}

#[test]
fn degenerate_runs_go_on_from_a_copy() -> Outcome {
    let (vortices, start) = quasi_periodic();
    let start = [start.x, start.y].concat();
    for sigma in [0.0, 0.25, 0.5, 1.0] {
        for solver in [Solver::Automatic, Solver::FixedPoint, Solver::Newton] {
            let method = Sigma { solver, parasitic_limit: None, ..Sigma::new(sigma) };
            check(&vortices, method, &start, &[])?;
            check(&Curved { kappa: 0.3 }, method, &[0.4, 0.1], &[])?;
        }
    }
    check(&vortices, Gauss::<2>::new(), &start, &[])?;
    check(&vortices, Gauss { solver: Solver::Newton, ..Gauss::<2>::new() }, &start, &[])?;
    check(&vortices, RungeKutta::midpoint(), &start, &[])?;
    let prey = OneSided { a: [1.0, 1.0], b: [-1.0, -2.0] };
    for method in [OneStep::midpoint(), OneStep::trapezoid(), OneStep::scheme_a(), OneStep::scheme_b()] {
        check(&prey, method, &[1.2, 0.9], &[])?;
    }
    check(&prey, OneStepGauss::<2>::new(), &[1.2, 0.9], &[])?;
    check(&prey, Projected::standard(), &[1.2, 0.9], &[])?;
    let compensated = Sigma { summation: Summation::Compensated, ..Sigma::midpoint() };
    check(&vortices, compensated, &start, &[])?;
    check(&vortices, EnergyLimit { method: Sigma::leapfrog(), limit: 1.0 }, &start, &[])
}

#[test]
fn regular_runs_go_on_from_a_copy() -> Outcome {
    let (q, v) = ([0.7, 0.2], [0.3, 1.1]);
    for beta in [0.0, 0.25] {
        check(&KEPLER, Newmark::new(beta), &q, &v)?;
        check(&KEPLER, EnergyLimit { method: Newmark::new(beta), limit: 1.0 }, &q, &v)?;
    }
    check(&KEPLER, Variational::trapezoid(), &q, &v)?;
    check(&KEPLER, Variational::simpson(), &q, &v)?;
    check(&Polar, Variational::midpoint(), &q, &v)?;
    check(&Polar, Galerkin::<3>::new(), &q, &v)?;
    check(&KEPLER, Gauss::<2>::new(), &q, &v)?;
    check(&Polar, Gauss::<2>::new(), &q, &[0.1, 1.9])?;
    check(&Polar, Gauss { solver: Solver::Newton, ..Gauss::<2>::new() }, &q, &[0.1, 1.9])?;
    check(&Polar, RungeKutta::midpoint(), &q, &v)?;
    let summation = Summation::Compensated;
    check(&KEPLER, Newmark { summation, ..Newmark::new(0.25) }, &q, &v)?;
    check(&KEPLER, Variational { summation, ..Variational::trapezoid() }, &q, &v)?;
    check(&KEPLER, Variational { summation, ..Variational::simpson() }, &q, &v)?;
    check(&Polar, Variational { summation, ..Variational::midpoint() }, &q, &v)?;
    check(&Polar, Galerkin::<3> { summation, ..Galerkin::new() }, &q, &v)
}

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
