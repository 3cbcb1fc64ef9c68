//! The generated steps beside the same schemes by hand: four vortices, and Kepler's problem.
//!
//! `cargo bench -p dvi-tests --bench steps`; the times of a pair are to be compared with each
//! other, in one run.

mod kernels;

use criterion::{Criterion, criterion_group, criterion_main};

/// Steps per measured call, so that the call itself does not count.
const STEPS: u64 = 1000;

fn steps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("1000 steps");
    for name in kernels::KERNELS.as_flattened() {
        assert!(kernels::run(name, STEPS).is_finite(), "{name} does not run");
        group.bench_function(*name, |bencher| bencher.iter(|| kernels::run(name, STEPS)));
    }
    group.finish();
}

criterion_group!(benches, steps);
criterion_main!(benches);
