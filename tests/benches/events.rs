//! Runs with a condition that never comes true, and with states that are asked for, beside the same runs
//! alone.
//!
//! `cargo bench -p dvi-benches --bench events [-- --markdown]`; the times of a group are to be compared with
//! each other, in one run.

use std::hint::black_box;

use criterion::Criterion;
use dvi_core::prelude::*;
use dvi_tests::configurations::quasi_periodic;
use dvi_tests::zoo::regular::{Kepler, KeplerState};

const STEPS: u64 = 1000;

type StateOf<R> = <<R as Run>::System as System>::State<f64>;

fn compare<R: Run<Scalar = f64>>(
    criterion: &mut Criterion,
    name: &str,
    begin: impl Fn() -> Option<R>,
    far: impl Fn(&StateOf<R>) -> f64,
) {
    let mut group = criterion.benchmark_group(format!("1000 steps, {name}"));
    group.bench_function("alone", |bencher| {
        let mut run = begin().expect("a start");
        bencher.iter(|| run.take_steps(STEPS));
    });
    group.bench_function("each step alone", |bencher| {
        let mut run = begin().expect("a start");
        bencher.iter(|| (0..STEPS).try_for_each(|_| black_box(&mut run).advance()));
    });
    group.bench_function("with a condition", |bencher| {
        let mut run = begin().expect("a start");
        let mut events = run.events([Direction::Either], |_, state| [far(state)]).expect("a start");
        bencher.iter(|| {
            let t = events.run().time() + (STEPS as f64 - 0.5) * events.run().step_size();
            assert!(events.next_until(t).is_ok_and(|event| event.is_none()));
        });
    });
    group.bench_function("a state in ten steps", |bencher| {
        let mut run = begin().expect("a start");
        let mut dense = run.dense().expect("a start");
        bencher.iter(|| {
            for _ in 0..STEPS / 10 {
                let t = dense.time() + 9.5 * dense.step_size();
                black_box(dense.state_at(t)).expect("a state");
            }
        });
    });
}

fn events(criterion: &mut Criterion) {
    let kepler = KeplerState { x: 0.8, y: 0.0, dot_x: 0.0, dot_y: 1.5_f64.sqrt() };
    let verlet = || Integrator::new(&Kepler { mu: 1.0 }, Variational::trapezoid(), 0.05, kepler).ok();
    compare(criterion, "Kepler, Verlet", verlet, |state| state.x - 5.0);
    let (system, start) = quasi_periodic();
    let midpoint = || Integrator::new(&system, Sigma::midpoint(), 0.1, start).ok();
    compare(criterion, "four vortices, midpoint", midpoint, |state| state.x[0] - 50.0);
    let leapfrog = Sigma { parasitic_limit: None, ..Sigma::leapfrog() };
    let explicit = || Integrator::new(&system, leapfrog, 0.01, start).ok();
    compare(criterion, "four vortices, explicit", explicit, |state| state.x[0] - 50.0);
}

fn main() {
    markdown::main(&[events]);
}
