//! Convergence to the motion.

use approx::abs_diff_eq;
use dvi_core::prelude::*;

use crate::manifold::reference;
use dvi_examples::models::{SphericalPendulum, SphericalPendulumState};
use dvi_tests::zoo::manifold::{
    Body, BodyState, ByConstraints, ByConstraintsState, COUPLED, Coupled, CoupledState, FREE, TOP, UNEVEN,
    coupled, cross, tilted,
};

/// The largest difference of two states, in R and ω.
fn distance(a: &BodyState, b: &[f64; 12]) -> f64 {
    let all = a.R.iter().chain(&a.omega_R);
    all.zip(b).fold(0.0, |largest, (a, b)| largest.max((a - b).abs()))
}

/// Where a body is at t = 4.
fn end(body: Body) -> [f64; 12] {
    let start = tilted([0.7, 1.1, 0.9]);
    let mut y = [0.0; 12];
    y[..9].copy_from_slice(&start.R);
    y[9..].copy_from_slice(&start.omega_R);
    reference::motion(reference::body(body.inertia, body.tip, body.weight), y, 4.0, 4_000)
}

fn errors<M>(body: Body, exact: &[f64; 12], method: M, lengths: [u32; 3]) -> [f64; 3]
where
    M: Copy + dvi_core::methods::Method<Body, f64>,
{
    lengths.map(|steps| {
        let mut run = Integrator::new(&body, method, 4.0 / f64::from(steps), tilted([0.7, 1.1, 0.9]))
            .expect("a step that is short enough");
        run.take_steps(u64::from(steps)).expect("a step that is short enough");
        distance(&run.state(), exact)
    })
}

fn check_order(errors: [f64; 3], order: i32) {
    for pair in errors.windows(2) {
        let rate = (pair[0] / pair[1]).log2();
        assert!(abs_diff_eq!(rate, f64::from(order), epsilon = 0.15), "order {rate}, {errors:?}");
    }
}

#[test]
fn bodies_converge_with_the_order_of_the_rule() {
    for body in [FREE, TOP, UNEVEN] {
        let exact = end(body);
        for rule in [Quadrature::trapezoid(), Quadrature::midpoint(), Quadrature::simpson()] {
            check_order(errors(body, &exact, Geodesic::new(rule), [80, 160, 320]), 2);
        }
        check_order(errors(body, &exact, Composition::suzuki(Geodesic::trapezoid()), [40, 80, 160]), 4);
    }
    let rule = Quadrature::sigma(0.2);
    check_order(errors(UNEVEN, &end(UNEVEN), Geodesic::new(rule), [1280, 2560, 5120]), 1);
}

#[test]
fn a_spherical_pendulum_converges() {
    let (pendulum, start) = (SphericalPendulum { gravity: 2.0 }, [0.6, 0.0, -0.8, 0.4, 0.9, 0.3]);
    let exact = reference::motion(reference::pendulum(2.0), start, 5.0, 4_000);
    let state = SphericalPendulumState { s: [0.6, 0.0, -0.8], dot_s: [0.4, 0.9, 0.3] };
    let errors = |rule: Quadrature| {
        [100, 200, 400].map(|steps| {
            let mut run = Integrator::new(&pendulum, Geodesic::new(rule), 5.0 / f64::from(steps), state)
                .expect("a step that is short enough");
            run.take_steps(steps as u64).expect("a step that is short enough");
            let SphericalPendulumState { s, dot_s } = run.state();
            s.iter().chain(&dot_s).zip(exact).fold(0.0, |largest: f64, (a, b)| largest.max((a - b).abs()))
        })
    };
    for rule in [Quadrature::trapezoid(), Quadrature::midpoint(), Quadrature::simpson()] {
        check_order(errors(rule), 2);
    }
}

/// The same state in numbers: the rows of Ṙ are those of R, times ω.
fn by_constraints(state: &CoupledState) -> ByConstraintsState {
    let mut dot_r = [0.0; 9];
    for (row, rate) in state.R.chunks(3).zip(dot_r.chunks_mut(3)) {
        rate.copy_from_slice(&cross([row[0], row[1], row[2]], state.omega_R));
    }
    let &CoupledState { R: r, s, x, dot_s, dot_x, .. } = state;
    ByConstraintsState { r, s, x, dot_r, dot_s, dot_x }
}

/// What runs of length h and h/2 tend to, if their error is c h².
fn limit([long, short]: [Vec<f64>; 2]) -> Vec<f64> {
    long.iter().zip(&short).map(|(long, short)| (4.0 * short - long) / 3.0).collect()
}

/// A mass matrix that depends on all coordinates, and blocks of each kind: against the same system as
/// numbers on constraints, with which this has neither step nor solver in common.
#[test]
fn a_system_of_all_kinds_moves_as_one_with_constraints() {
    let Coupled { a, length, gravity } = COUPLED;
    let flat = ByConstraints { a, length, gravity };
    let on_manifold = |rule: Quadrature, steps: u32| {
        let mut run = Integrator::new(&COUPLED, Geodesic::new(rule), 1.5 / f64::from(steps), coupled())
            .expect("a step that is short enough");
        run.take_steps(u64::from(steps)).expect("a step that is short enough");
        let CoupledState { R, s, x, .. } = run.state();
        [&R[..], &s, &x].concat()
    };
    let on_constraints = |steps: u32| {
        let method = Constrained::new(Variational::midpoint());
        let start = by_constraints(&coupled());
        let mut run = Integrator::new(&flat, method, 1.5 / f64::from(steps), start)
            .expect("a step that is short enough");
        run.take_steps(u64::from(steps)).expect("a step that is short enough");
        let ByConstraintsState { r, s, x, .. } = run.state();
        [&r[..], &s, &x].concat()
    };
    let exact = limit([400, 800].map(on_constraints));
    for rule in [Quadrature::trapezoid(), Quadrature::midpoint(), Quadrature::simpson()] {
        let found = limit([400, 800].map(|steps| on_manifold(rule, steps)));
        let difference =
            found.iter().zip(&exact).fold(0.0, |largest: f64, (a, b)| largest.max((a - b).abs()));
        assert!(difference < 2e-9, "{rule:?}: {difference:e}");
    }
}
