//! Energies of runs that independent programs have computed in double precision.

use approx::assert_abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::configurations::{chaotic, leapfrogging, quasi_periodic};
use dvi_tests::systems::{PointVortices, PointVorticesState};

/// H after 10, 100 and 1000 steps.
fn energies<M>(
    (system, state): (PointVortices<4>, PointVorticesState<4>),
    method: M,
    h: f64,
) -> Outcome<[f64; 3]>
where
    M: dvi_core::methods::Method<PointVortices<4>, f64>,
{
    let mut run = Integrator::new(&system, method, h, state)?;
    let mut energies = [0.0; 3];
    for (energy, steps) in energies.iter_mut().zip([10, 100, 1000]) {
        while run.steps() < steps {
            run.advance()?;
        }
        *energy = run.energy();
    }
    Ok(energies)
}

#[track_caller]
fn assert_close(found: [f64; 3], expected: [f64; 3]) {
    for (found, expected) in found.iter().zip(expected) {
        assert_abs_diff_eq!(*found, expected, epsilon = 1e-11);
    }
}

#[test]
fn initial_energies() -> Outcome {
    let expected = [-0.697_421_199_668_691, 0.432_172_186_162_708, 0.571_774_897_847_477];
    for ((system, state), expected) in [leapfrogging(), quasi_periodic(), chaotic()].iter().zip(expected) {
        let run = Integrator::new(system, Sigma::midpoint(), 0.1, *state)?;
        assert_abs_diff_eq!(run.energy(), expected, epsilon = 1e-14);
    }
    Ok(())
}

#[test]
fn leapfrog_with_the_start_of_the_paper() -> Outcome {
    let method = Sigma { start: Start::RungeKutta(RungeKutta::midpoint()), ..Sigma::leapfrog() };
    let found = energies(leapfrogging(), method, 2.0)?;
    assert_close(found, [-0.695_128_251_325, -0.697_494_290_472, -0.695_110_618_491]);
    Ok(())
}

#[test]
fn runge_kutta_midpoint() -> Outcome {
    let found = energies(leapfrogging(), RungeKutta::midpoint(), 1.0)?;
    assert_close(found, [-0.697_368_839_232, -0.697_332_580_193, -0.696_530_459_904]);
    Ok(())
}

#[test]
fn sigma_midpoint_with_consistent_start() -> Outcome {
    let expected = [0.432_195_207_408, 0.432_160_796_535, 0.432_167_236_784];
    for solver in [Solver::Automatic, Solver::FixedPoint, Solver::Newton] {
        let method = Sigma { solver, ..Sigma::midpoint() };
        assert_close(energies(quasi_periodic(), method, 0.1)?, expected);
    }
    Ok(())
}

#[test]
fn runge_kutta_classical() -> Outcome {
    let found = energies(quasi_periodic(), RungeKutta::classical(), 0.1)?;
    assert_close(found, [0.432_172_119_616, 0.432_172_299_401, 0.432_172_878_318]);
    Ok(())
}
