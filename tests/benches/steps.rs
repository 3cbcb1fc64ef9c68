//! The generated steps beside the same schemes by hand: four vortices, Kepler's problem, predators and prey.
//!
//! `cargo bench -p dvi-benches --bench steps`; the times of a pair are to be compared with each
//! other, in one run.

use criterion::{Criterion, criterion_group, criterion_main};
use dvi_kernels as kernels;

/// Steps per measured call, so that the call itself does not count.
const STEPS: u64 = 1000;

/// How many steps a kernel by hand takes before it is asked to: to a second point, or to fill what it
/// extrapolates from.
fn steps_ahead(name: &str) -> u64 {
    match name {
        _ if ["Verlet", "RATTLE", "matrix", "top"].iter().any(|scheme| name.contains(scheme)) => 0,
        _ if name.contains("explicit") => 1,
        _ => 7,
    }
}

fn steps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("1000 steps");
    for [ours, theirs] in kernels::KERNELS {
        // Both compute the same; later the explicit scheme tells rounding errors apart.
        let difference = kernels::run(ours, 100) - kernels::run(theirs, 100 - steps_ahead(theirs));
        assert!(difference.abs() < 1e-6, "{ours} and {theirs} differ by {difference:e}");
    }
    for name in kernels::KERNELS.as_flattened() {
        group.bench_function(*name, |bencher| bencher.iter(|| kernels::run(name, STEPS)));
    }
    group.finish();
}

criterion_group!(benches, steps);
criterion_main!(benches);
