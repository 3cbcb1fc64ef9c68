//! Runs taken together in lanes beside the same runs alone, and the stages of Gauss collocation and interior
//! nodes of `Galerkin` in lanes beside the same one by one.
//!
//! `cargo bench -p dvi-benches --bench lanes [-- --markdown]`. Times are those of 512 steps of eight
//! runs, and of 64 steps of Gauss collocation or `Galerkin`. Ratios of neighbouring rows are what
//! counts.

use criterion::{Criterion, Throughput};
use dvi_core::Lagrangian;
use dvi_core::methods::{InStep, Method};
use dvi_core::prelude::*;
use dvi_core::run::Together;
use dvi_examples::models::outer_solar_system;
use dvi_tests::configurations::quasi_periodic;
use dvi_tests::zoo::regular::{Kepler, KeplerState};

const RUNS: usize = 8;
const STEPS: u64 = 512;

fn beside<S: Lagrangian + PartialEq, M: InStep<RUNS, S> + PartialEq + Clone>(
    criterion: &mut Criterion,
    name: &str,
    system: &S,
    method: &M,
    h: f64,
    start: impl Fn(usize) -> S::State<f64>,
) {
    let mut group = criterion.benchmark_group(name);
    group.throughput(Throughput::Elements(RUNS as u64 * STEPS));
    let begin = || {
        let run = |j| Integrator::new(system, method.clone(), h, start(j));
        let Ok(runs) = (0..RUNS).map(run).collect::<Result<Vec<_>, _>>() else { panic!("they start") };
        runs
    };
    let mut runs = begin();
    group.bench_function("alone", |bencher| {
        bencher.iter(|| {
            for run in &mut runs {
                assert!(run.take_steps(STEPS).is_ok());
            }
        });
    });
    let mut runs = begin();
    let mut packs = Together::<RUNS, _, _>::new(&runs[0]);
    group.bench_function("together", |bencher| {
        bencher.iter(|| assert!(packs.take_steps(&mut runs, STEPS).iter().all(Result::is_ok)));
    });
    group.finish();
}

fn runs_together(criterion: &mut Criterion) {
    let (vortices, start) = quasi_periodic();
    let near = |j: usize| {
        let mut start = start;
        start.x[0] += 0.01 * j as f64;
        start
    };
    let leapfrog = Sigma { parasitic_limit: None, ..Sigma::leapfrog() };
    beside(criterion, "vortices, σ = 0", &vortices, &leapfrog, 0.01, near);
    beside(criterion, "vortices, σ = ½", &vortices, &Sigma::midpoint(), 0.1, near);
    let planet = |j: usize| KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.8 + 0.02 * j as f64 };
    beside(criterion, "Kepler, Verlet", &Kepler { mu: 1.0 }, &Variational::trapezoid(), 0.01, planet);
}

fn long_steps<S: Lagrangian, M: Method<S, f64>>(
    criterion: &mut Criterion,
    [group, how]: [&str; 2],
    (method, h): (M, f64),
    (system, start): (S, S::State<f64>),
) {
    let Ok(mut run) = Integrator::new(&system, method, h, start) else { panic!("it starts") };
    let mut group = criterion.benchmark_group(group);
    group.bench_function(how, |bencher| bencher.iter(|| assert!(run.take_steps(64).is_ok())));
}

fn stages(criterion: &mut Criterion) {
    macro_rules! gauss {
        ($($stages:literal)*) => {$(
            let group = concat!("vortices, Gauss, ", $stages, " stages");
            let method = Gauss::<$stages>::new();
            long_steps(criterion, [group, "one by one"], (method, 0.5), quasi_periodic());
            long_steps(criterion, [group, "in lanes"], (method.in_lanes(), 0.5), quasi_periodic());
        )*};
    }
    macro_rules! galerkin {
        ($($nodes:literal)*) => {$(
            let group = concat!("outer solar system, Galerkin, ", $nodes, " nodes");
            let method = Galerkin { summation: Summation::Compensated, ..Galerkin::<$nodes>::new() };
            long_steps(criterion, [group, "one by one"], (method, 200.0), outer_solar_system());
            long_steps(criterion, [group, "in lanes"], (method.in_lanes(), 200.0), outer_solar_system());
        )*};
    }
    gauss!(4 8);
    galerkin!(4 9);
}

fn main() {
    markdown::main(&[runs_together, stages]);
}
