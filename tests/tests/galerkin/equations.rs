//! A step solves the equations that define it, whose derivatives are taken here by dual numbers from the
//! value of L alone, however it solves them.

use approx::abs_diff_eq;
use dvi_core::discrete::{FrequencyIn, Unfitted};
use dvi_core::prelude::*;
use dvi_tests::oracle::{self, displaced_lagrangian};
use dvi_tests::zoo::regular::*;
use dvi_tests::{apart, larger, run};
use nalgebra::DVector;
use num_dual::Dual64;

use crate::galerkin::systems::{
    KEPLER, Outcome, chain, double_pendulum, driven, dual, growing, magnetic, pericentre, relativistic,
    spherical,
};

/// The displacements of the interior nodes that make L_d(q0, q1) stationary.
fn stationary<S: Lagrangian<Dual64>, const NODES: usize>(
    system: &S,
    u: f64,
    [t, h]: [f64; 2],
    ends: [&[f64]; 2],
) -> Vec<f64> {
    let [q0, q1] = ends.map(|q| dual(q, None));
    let size = q0.len() * (NODES - 2);
    let gradient = |x: &DVector<f64>| {
        let of = |i| {
            displaced_lagrangian::<S, Dual64, NODES>(
                system,
                u,
                [t, h],
                [&q0, &q1],
                &dual(x.as_slice(), Some(i)),
            )
        };
        DVector::from_fn(size, |i, _| of(i).eps)
    };
    oracle::stationary(size, gradient).expect("a regular matrix")
}

/// The largest residual of p0 = −D₁L_d and p1 = D₂L_d, from the value of L alone.
fn check_equations<S: RegularLagrangian + Lagrangian<Dual64>, const NODES: usize>(
    (system, start): (S, S::State<f64>),
    omega: f64,
) -> Outcome {
    let h = 0.1;
    for solver in [Solver::Automatic, Solver::Newton] {
        let method = Galerkin { solver, ..Galerkin::<NODES>::new() }.phase_fitted(Constant(omega));
        let mut run = Integrator::new(&system, method, h, start.clone())?;
        for step in 0..4 {
            let (q0, p0, t) = (run.q().to_vec(), run.memory().p().to_vec(), run.time());
            run.advance()?;
            let (q1, p1) = (run.q().to_vec(), run.memory().p().to_vec());
            let x = stationary::<S, NODES>(&system, omega * h, [t, h], [&q0, &q1]);
            let value = |a: Option<usize>, b: Option<usize>| {
                let ends = [&dual(&q0, a)[..], &dual(&q1, b)];
                displaced_lagrangian::<S, Dual64, NODES>(&system, omega * h, [t, h], ends, &dual(&x, None))
                    .eps
            };
            for i in 0..q0.len() {
                let residual =
                    larger((p0[i] + value(Some(i), None)).abs(), (p1[i] - value(None, Some(i))).abs());
                let size = p0.iter().chain(&p1).fold(1.0, |m: f64, p| larger(m, p.abs()));
                let name = S::REPORT.system;
                assert!(
                    residual < 4e-14 * size / h,
                    "{name}, {NODES} nodes, {solver:?}, step {step}: {residual:e}"
                );
            }
        }
    }
    Ok(())
}

/// Without a frequency and fitted to one.
fn check_both<S: RegularLagrangian + Lagrangian<Dual64> + Clone, const NODES: usize>(
    (system, start): (S, S::State<f64>),
) -> Outcome {
    check_equations::<S, NODES>((system.clone(), start.clone()), 0.0)?;
    check_equations::<S, NODES>((system, start), 1.3)
}

// All numbers of nodes on one system, and each kind of system with one of them.

#[test]
fn steps_of_separable_systems_solve_their_equations() -> Outcome {
    check_both::<_, 3>((KEPLER, pericentre(0.3)))?;
    check_both::<_, 4>((KEPLER, pericentre(0.3)))?;
    check_both::<_, 5>((KEPLER, pericentre(0.3)))?;
    check_both::<_, 4>(driven())?;
    check_both::<_, 3>(chain())
}

#[test]
fn steps_of_other_systems_solve_their_equations() -> Outcome {
    check_both::<_, 3>(double_pendulum())?;
    check_both::<_, 4>(double_pendulum())?;
    check_both::<_, 5>(double_pendulum())?;
    check_both::<_, 4>(spherical())?;
    check_both::<_, 3>(magnetic())?;
    check_both::<_, 4>(relativistic())?;
    check_both::<_, 5>(growing())
}

#[test]
fn all_solvers_find_the_same_steps() -> Outcome {
    fn check<F: FrequencyIn<f64> + Copy>(frequency: F) -> Outcome {
        let by = |solver| {
            let method = Galerkin { solver, ..Galerkin::<4>::new() }.phase_fitted(frequency);
            run(&KEPLER, method, pericentre(0.3), 6.0, 60)
        };
        let automatic = by(Solver::Automatic)?;
        assert!(apart(&automatic, &by(Solver::FixedPoint)?) < 1e-12, "{frequency:?}");
        assert!(apart(&automatic, &by(Solver::Newton)?) < 1e-12, "{frequency:?}");
        Ok(())
    }
    check(Unfitted)?;
    check(Constant(1.1))?;
    check(Radial(Reading::Averaged))?;
    check(Curvature(Reading::Averaged))
}

#[test]
fn a_fixed_point_step_needs_forces_only_and_newton_stands_by() -> Outcome {
    let mut run = Integrator::new(&KEPLER, Galerkin::<4>::new(), 0.05, pericentre(0.3))?;
    run.take_steps(200)?;
    let statistics = run.statistics();
    // Two interior nodes an iteration, and the end.
    assert_eq!(statistics.gradients, 2 * statistics.iterations + statistics.steps);
    assert_eq!((statistics.linearizations, statistics.factorisations), (0, 0));
    let (system, start) = (Spring { stiffness: 100.0 }, SpringState { x: 1.0, dot_x: 0.0 });
    let mut stiff = Integrator::new(&system, Galerkin::<4>::new(), 0.5, start)?;
    stiff.take_steps(20)?;
    assert!(stiff.statistics().factorisations > 0);
    Ok(())
}

#[test]
fn single_precision_steps_to_its_own_rounding() -> Outcome {
    let start = KeplerState { x: 1.0, y: 0.1, dot_x: -0.2, dot_y: 1.1 };
    let narrow = KeplerState { x: 1.0_f32, y: 0.1, dot_x: -0.2, dot_y: 1.1 };
    let mut single = Integrator::new(&KEPLER, Galerkin::<5>::new(), 0.1_f32, narrow)?;
    let mut double = Integrator::new(&KEPLER, Galerkin::<5>::new(), 0.1, start)?;
    single.take_steps(50)?;
    double.take_steps(50)?;
    for (a, b) in single.q().iter().zip(double.q()) {
        assert!(abs_diff_eq!(f64::from(*a), b, epsilon = 1e-4), "{a} and {b}");
    }
    Ok(())
}
