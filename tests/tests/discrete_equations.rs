//! Every step solves the discrete Euler–Lagrange equations D₂L_d(q0, q1) + D₁L_d(q1, q2) = 0, whose
//! derivatives are taken here by dual numbers from the value of L alone.

use approx::abs_diff_eq;
use dvi_core::prelude::*;
use dvi_core::{DegenerateLagrangian, Lagrangian};
use dvi_tests::configurations::quasi_periodic;
use dvi_tests::larger;
use dvi_tests::oracle::discrete_lagrangian;
use dvi_tests::systems::*;
use num_dual::Dual64;

type Outcome = Result<(), Box<dyn core::error::Error>>;

fn dual(q: &[f64], direction: Option<usize>) -> Vec<Dual64> {
    let unit = |i| if Some(i) == direction { 1.0 } else { 0.0 };
    q.iter().enumerate().map(|(i, &q)| Dual64::new(q, unit(i))).collect()
}

/// The largest component of the residual of the discrete equations.
fn residual<S: Lagrangian<Dual64>>(
    system: &S,
    sigma: f64,
    t: f64,
    h: f64,
    [q0, q1, q2]: [&[f64]; 3],
) -> f64 {
    (0..q0.len())
        .map(|i| {
            let left = discrete_lagrangian(system, sigma, t, h, &dual(q0, None), &dual(q1, Some(i)));
            let right = discrete_lagrangian(system, sigma, t + h, h, &dual(q1, Some(i)), &dual(q2, None));
            (left.eps + right.eps).abs()
        })
        .fold(0.0, larger)
}

#[track_caller]
fn check<S: DegenerateLagrangian + Lagrangian<Dual64>>(
    system: &S,
    start: S::State<f64>,
    h: f64,
    steps: u64,
    tolerance: f64,
) -> Outcome {
    for sigma in [0.0, 0.2, 0.5, 0.7, 1.0] {
        for solver in [Solver::Automatic, Solver::FixedPoint, Solver::Newton] {
            let method = Sigma { solver, parasitic_limit: None, ..Sigma::new(sigma) };
            let mut run = Integrator::new(system, method, h, start.clone())?;
            let mut points = vec![run.q().to_vec()];
            while run.steps() < steps {
                run.advance()?;
                points.push(run.q().to_vec());
            }
            for (k, window) in points.windows(3).enumerate() {
                let [q0, q1, q2] = window else { return Err("a window of three".into()) };
                let found = residual(system, sigma, k as f64 * h, h, [q0, q1, q2]);
                let name = S::REPORT.system;
                assert!(found < tolerance, "{name}, sigma = {sigma}, {solver:?}, step {k}: {found:e}");
            }
        }
    }
    Ok(())
}

#[test]
fn matching_affine_form() -> Outcome {
    let (system, start) = quasi_periodic();
    check(&system, start, 0.05, 40, 2e-15)
}

#[test]
fn run_time_size() -> Outcome {
    let system = ManyVortices { gamma: vec![1.0, 2.0, -0.5] };
    let start = ManyVorticesState { x: vec![0.0, 1.0, 0.3], y: vec![0.0, 0.2, 1.5] };
    check(&system, start, 0.05, 40, 2e-15)
}

#[test]
fn dense_affine_form() -> Outcome {
    let (system, start) = quadratic();
    check(&system, start, 0.02, 10, 4e-15)
}

/// Where σ = 0 only reverses the defect, though no coordinate has one conjugate.
#[test]
fn dense_antisymmetric_form() -> Outcome {
    let (mut system, start) = quadratic();
    let a = system.a;
    for (i, row) in system.a.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            *entry = (a[i][j] - a[j][i]) / 2.0;
        }
    }
    check(&system, start, 0.02, 10, 4e-15)
}

fn quadratic() -> (Quadratic, QuadraticState) {
    let system = Quadratic {
        a: [[0.3, 1.1, -0.4, 0.2], [-0.7, 0.1, 0.5, 0.9], [0.2, -0.6, 0.4, 1.3], [0.8, -0.1, -1.0, -0.2]],
        s: [[1.0, 0.2, 0.0, 0.1], [0.2, 1.5, -0.3, 0.0], [0.0, -0.3, 0.8, 0.2], [0.1, 0.0, 0.2, 1.2]],
        quartic: 0.3,
    };
    (system, QuadraticState { z: [0.5, -0.3, 0.4, 0.2] })
}

#[test]
fn nonlinear_form_with_one_entry_in_a_row() -> Outcome {
    check(&Curved { kappa: 0.2 }, CurvedState { x: 0.6, y: -0.4 }, 0.05, 20, 4e-15)
}

#[test]
fn nonlinear_form_with_diagonal_entries() -> Outcome {
    let system = LotkaVolterra { a: [1.0, 1.0], b: [-1.0, -2.0] };
    check(&system, LotkaVolterraState { x: 1.3, y: 1.6 }, 0.02, 8, 4e-15)
}

#[test]
fn a_form_that_degenerates_at_the_ends_only() -> Outcome {
    let (system, start) = (SphereForm { gamma: 1.5 }, SphereFormState { phi: 0.4, z: 0.3 });
    // In this gauge the parasitic mode is multiplied by σ/(1−σ) or its inverse in each step.
    for (sigma, steps) in [(0.4, 6), (0.5, 30), (0.6, 6)] {
        let method = Sigma { parasitic_limit: None, ..Sigma::new(sigma) };
        let mut run = Integrator::new(&system, method, 0.05, start)?;
        let mut points = vec![run.q().to_vec()];
        for _ in 0..steps {
            run.advance()?;
            points.push(run.q().to_vec());
        }
        for window in points.windows(3) {
            let [q0, q1, q2] = window else { return Err("a window of three".into()) };
            assert!(residual(&system, sigma, 0.0, 0.05, [q0, q1, q2]) < 2e-15);
        }
    }
    Ok(())
}

#[test]
fn sizes_fixed_and_at_run_time_agree() -> Outcome {
    let (fixed, state) = quasi_periodic();
    let many = ManyVortices { gamma: fixed.gamma.to_vec() };
    let start = ManyVorticesState { x: state.x.to_vec(), y: state.y.to_vec() };
    for sigma in [0.0, 0.5, 0.3] {
        let mut a = Integrator::new(&fixed, Sigma::new(sigma), 0.05, state)?;
        let mut b = Integrator::new(&many, Sigma::new(sigma), 0.05, start.clone())?;
        for _ in 0..50 {
            a.advance()?;
            b.advance()?;
        }
        let apart = a.q().iter().zip(b.q()).map(|(a, b)| (a - b).abs()).fold(0.0, larger);
        assert!(apart < 1e-13, "sigma = {sigma}: {apart:e}");
    }
    Ok(())
}

#[test]
fn single_precision_steps_to_its_own_rounding() -> Outcome {
    let (system, state) = quasi_periodic();
    let narrow = PointVorticesState { x: state.x.map(|x| x as f32), y: state.y.map(|y| y as f32) };
    let mut single = Integrator::new(&system, Sigma::<f32>::midpoint(), 0.05, narrow)?;
    let mut double = Integrator::new(&system, Sigma::midpoint(), 0.05, state)?;
    for _ in 0..40 {
        single.advance()?;
        double.advance()?;
    }
    for (a, b) in single.q().iter().zip(double.q()) {
        assert!(abs_diff_eq!(f64::from(*a), b, epsilon = 2e-5), "{a} and {b}");
    }
    Ok(())
}

#[test]
fn a_given_second_point_is_reached() -> Outcome {
    let (system, first) = quasi_periodic();
    let mut exact = Integrator::new(&system, Gauss::<3>::new(), 0.05, first)?;
    exact.advance()?;
    for sigma in [0.0, 0.3, 0.5, 1.0] {
        let method = Sigma::new(sigma);
        let mut run = Integrator::from_two_points(&system, method, 0.05, first, exact.state())?;
        run.advance()?;
        let apart = run.q().iter().zip(exact.q()).map(|(a, b)| (a - b).abs()).fold(0.0, larger);
        assert!(apart < 4e-15, "sigma = {sigma}: {apart:e}");
    }
    Ok(())
}

#[test]
fn an_explicit_step_costs_one_gradient_and_nothing_else() -> Outcome {
    let (system, start) = quasi_periodic();
    for sigma in [0.0, 1.0] {
        let mut run = Integrator::new(&system, Sigma::new(sigma), 0.01, start)?;
        for _ in 0..100 {
            run.advance()?;
        }
        let expected = dvi_core::state::Statistics { steps: 100, gradients: 100, ..Default::default() };
        assert_eq!(run.statistics(), expected, "sigma = {sigma}");
    }
    Ok(())
}

#[test]
fn an_implicit_step_by_fixed_point_needs_no_matrix() -> Outcome {
    let (system, start) = quasi_periodic();
    // To the end, where corrections no longer shrink, it takes 10.2 iterations; 8.3 leave a bias behind.
    for (tolerance, limit) in [(1e-12, 5), (Stopping::default().tolerance, 11)] {
        let stopping = Stopping { tolerance, ..Stopping::default() };
        let mut run = Integrator::new(&system, Sigma { stopping, ..Sigma::midpoint() }, 0.1, start)?;
        for _ in 0..1000 {
            run.advance()?;
        }
        let statistics = run.statistics();
        assert_eq!((statistics.linearizations, statistics.factorisations), (0, 0));
        assert_eq!(statistics.gradients, statistics.iterations);
        assert!(statistics.iterations < limit * statistics.steps, "{statistics:?}");
    }
    Ok(())
}

#[test]
fn newton_takes_over_where_the_fixed_point_is_slow() -> Outcome {
    let (system, start) = quasi_periodic();
    let fixed_point = Sigma { solver: Solver::FixedPoint, ..Sigma::midpoint() };
    let mut slow = Integrator::new(&system, fixed_point, 0.5, start)?;
    let mut automatic = Integrator::new(&system, Sigma::midpoint(), 0.5, start)?;
    for _ in 0..100 {
        slow.advance()?;
        automatic.advance()?;
    }
    assert!(slow.statistics().iterations > 20 * 100);
    assert!(automatic.statistics().factorisations > 100);
    let apart = slow.q().iter().zip(automatic.q()).map(|(a, b)| (a - b).abs()).fold(0.0, larger);
    assert!(apart < 1e-10, "{apart:e}");
    Ok(())
}
