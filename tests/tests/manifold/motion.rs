//! The motion on constraints.

use dvi_core::prelude::*;
use dvi_tests::apart;
use dvi_tests::zoo::manifold::{
    ByConstraints, ByConstraintsState, COUPLED, Coupled, CoupledState, coupled, cross,
};

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
        let method = Constrained::new(Midpoint);
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
        let difference = apart(&found, &exact);
        assert!(difference < 2e-9, "{rule:?}: {difference:e}");
    }
}
